//! Cost over the number of casters: of culling them against H, sorting them, planning a sun among them, and bounding them for a
//! fit.

use std::hint::black_box;

use anyhow::{Result, ensure};
use render_check::maps::Technique;
use shadowfit::{
    Focus, FocusForm, Scene, fit,
    plan::{Budget, Objects, plan},
};

use super::cost::{Cost, Counted, Work, on_processor};
use super::town;
use crate::size::Size;

/// How many casters.
const COUNTS: [usize; 5] = [10, 100, 1_000, 10_000, 100_000];

/// Measures.
///
/// # Errors
///
/// When culling in bulk loses a box that culling one by one draws.
pub(super) fn measure(size: Size) -> Result<Vec<Cost>> {
    let counts = &COUNTS[..size.of(3, COUNTS.len())];
    let most = COUNTS[counts.len() - 1];
    let (view, sun, boxes) = (town::view()?, town::sun()?, town::boxes(most));
    let body = Focus::new(&view, &sun, &town::bounds()?).caster_volume(FocusForm::ReceiverHull);
    let culler = body.culler();
    let mut meets = vec![false; most];
    culler.boxes(&boxes, &mut meets);
    let lost =
        boxes.iter().zip(&meets).filter(|(one, meets)| body.intersects_aabb(one.min, one.max) && !**meets).count();
    ensure!(lost == 0, "culling in bulk loses {lost} of {most} boxes that meet H one by one");

    let counted = Counted::Casters;
    let mut costs = on_processor(Work::CullInBulk, counted, counts, size, |count| {
        let (boxes, culler, mut meets) = (&boxes[..count], &culler, vec![false; count]);
        Ok(move || {
            culler.boxes(black_box(boxes), &mut meets);
            black_box(&meets);
        })
    })?;
    costs.extend(on_processor(Work::CullOneByOne, counted, counts, size, |count| {
        let (boxes, body) = (&boxes[..count], &body);
        Ok(move || black_box(boxes).iter().filter(|one| body.intersects_aabb(one.min, one.max)).count())
    })?);
    costs.extend(on_processor(Work::Sort, counted, counts, size, |count| {
        let objects = town::objects(count);
        Objects::new(&objects)?;
        Ok(move || Objects::new(black_box(&objects)))
    })?);
    let budget = Budget::new(town::settings(Technique::Best)?);
    costs.extend(on_processor(Work::Plan, counted, counts, size, |count| {
        let (objects, view, suns, budget) = (Objects::new(&town::objects(count))?, &view, [sun], &budget);
        Ok(move || plan(black_box(view), &suns, &objects, budget))
    })?);
    let settings = town::settings(Technique::Uniform)?;
    costs.extend(on_processor(Work::FitLists, counted, counts, size, |count| {
        let (boxes, view, sun, settings) = (&boxes[..count], &view, &sun, &settings);
        Scene::new(boxes, boxes)?;
        Ok(move || Scene::new(black_box(boxes), boxes).map(|scene| fit(view, sun, &scene, settings)))
    })?);
    Ok(costs)
}
