//! Cost over what a fit is set up with: planes of S, texels of the map, cascades of the view.

use std::hint::black_box;

use anyhow::{Result, ensure};
use render_check::maps::Technique;
use shadowfit::glam::DVec3;
use shadowfit::{
    Focus, FocusForm, InputError, Scene, Settings,
    cascades::{CascadeSplits, Cascades, SplitScheme},
    fit,
    focus::Plane,
    input::ConvexScene,
};

use super::cost::{Cost, Counted, Work, on_processor};
use super::town;
use crate::size::Size;

/// The planes of a box.
const BOX_PLANES: usize = 6;

/// How many planes S has; the last is the most it can have.
const PLANES: [usize; 5] = [BOX_PLANES, 9, 12, 15, BOX_PLANES + ConvexScene::MAX_CUTS];

/// Texels along each side of a map.
pub(super) const SIDES: [usize; 7] = [128, 256, 512, 1024, 2048, 4096, 8192];

/// What is fitted.
const FITS: [(Work, Technique); 2] = [(Work::FitUniform, Technique::Uniform), (Work::FitBest, Technique::Best)];

/// Measures.
pub(super) fn measure(size: Size) -> Result<Vec<Cost>> {
    Ok([planes(size)?, texels(size)?, cascades(size)?].concat())
}

fn planes(size: Size) -> Result<Vec<Cost>> {
    let (view, sun, mut costs) = (town::view()?, town::sun()?, Vec::new());
    for (work, technique) in FITS {
        let settings = town::settings(technique)?;
        costs.extend(on_processor(work, Counted::Planes, &PLANES, size, |count| {
            let (body, view, sun) = (cut_town(count)?, &view, &sun);
            ensure!(fit(view, sun, &Scene::from_convex(&body), &settings).map().is_some(), "S has been cut away");
            Ok(move || fit(black_box(view), sun, &Scene::from_convex(&body), &settings))
        })?);
    }
    costs.extend(on_processor(Work::Body, Counted::Planes, &PLANES, size, |count| {
        let (body, view, sun) = (cut_town(count)?, &view, &sun);
        let planes = Focus::new(view, sun, &Scene::from_convex(&body))
            .caster_volume(FocusForm::ReceiverHull)
            .planes()
            .count();
        ensure!(planes > BOX_PLANES, "H has {planes} planes");
        Ok(move || {
            Focus::new(black_box(view), sun, &Scene::from_convex(&body)).caster_volume(FocusForm::ReceiverHull)
        })
    })?);
    Ok(costs)
}

/// The bounds of the town with so many planes: the box, cut by others all around, each of which cuts a little off.
fn cut_town(planes: usize) -> Result<ConvexScene, InputError> {
    let (half, height) = (f64::from(town::HALF), f64::from(town::HEIGHT));
    let cut = |index: usize| {
        let angle = 0.4 + index as f64;
        let inwards = DVec3::new(angle.cos(), 0.1, angle.sin());
        Plane::through(inwards, -0.95 * half * inwards)
    };
    let cuts: Vec<Plane> = (BOX_PLANES..planes).map(cut).collect();
    ConvexScene::new((-half, 0.0, -half), (half, height, half), &cuts)
}

fn texels(size: Size) -> Result<Vec<Cost>> {
    let (view, sun, bounds, mut costs) = (town::view()?, town::sun()?, town::bounds()?, Vec::new());
    let counts: Vec<usize> = SIDES[..size.of(3, SIDES.len())].iter().map(|side| side * side).collect();
    for (work, technique) in FITS {
        costs.extend(on_processor(work, Counted::Texels, &counts, size, |texels| {
            let settings = technique.settings(Settings::new(texels.isqrt() as u32, 1080)?);
            let (view, sun, bounds) = (&view, &sun, &bounds);
            ensure!(fit(view, sun, bounds, &settings).map().is_some(), "the town has no map");
            Ok(move || fit(black_box(view), sun, bounds, &settings))
        })?);
    }
    Ok(costs)
}

fn cascades(size: Size) -> Result<Vec<Cost>> {
    let counts: Vec<usize> = (1..=Cascades::MAX).collect();
    let (view, sun, bounds) = (town::view()?, town::sun()?, town::bounds()?);
    let cut = |count| {
        let cuts = CascadeSplits::Visible { count, split: SplitScheme::Practical(0.5) };
        Cascades::new(black_box(&view), &sun, &bounds, cuts, 0.1)
    };
    let mut costs = on_processor(Work::Cut, Counted::Cascades, &counts, size, |count| Ok(move || cut(count)))?;
    for (work, technique) in [(Work::CutAndFitUniform, Technique::Uniform), (Work::CutAndFitBest, Technique::Best)]
    {
        let settings = &town::settings(technique)?;
        costs.extend(on_processor(work, Counted::Cascades, &counts, size, |count| {
            let maps = cut(count)?.fit(settings).maps().count();
            ensure!(maps == count, "{maps} of {count} cascades have a map");
            Ok(move || cut(count).map(|cascades| cascades.fit(settings).maps().count()))
        })?);
    }
    Ok(costs)
}
