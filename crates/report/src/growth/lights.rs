//! Cost over the number of lights: of fitting each of them, and of planning them all.

use std::hint::black_box;

use anyhow::Result;
use render_check::maps::Technique;
use shadowfit::{
    Light, fit,
    plan::{Budget, Objects, plan},
};

use super::cost::{Cost, Counted, Work, on_processor};
use super::town;
use crate::size::Size;

/// How many lights.
const COUNTS: [usize; 6] = [1, 10, 100, 1_000, 10_000, 100_000];

/// Measures.
pub(super) fn measure(size: Size) -> Result<Vec<Cost>> {
    let counts = &COUNTS[..size.of(3, COUNTS.len())];
    let most = COUNTS[counts.len() - 1];
    let (view, bounds, lamps) = (town::view()?, town::bounds()?, town::lamps(most)?);
    let mut costs = Vec::new();
    for (work, technique) in [
        (Work::FitUniform, Technique::Uniform),
        (Work::FitLightSpace, Technique::LightSpace),
        (Work::FitBest, Technique::Best),
    ] {
        let settings = &town::settings(technique)?;
        costs.extend(on_processor(work, Counted::Lights, counts, size, |count| {
            let mut sets = Sets::new(&lamps, count);
            let fitted = |lamp: &&Light| fit(black_box(&view), lamp, &bounds, settings).map().is_some();
            Ok(move || sets.take().iter().filter(fitted).count())
        })?);
    }
    let objects = Objects::new(&town::objects(size.of(100, 10_000)))?;
    let budget = Budget::new(town::settings(Technique::Best)?);
    let lamps = town::street_lamps(most)?;
    costs.extend(on_processor(Work::Plan, Counted::Lights, counts, size, |count| {
        let mut sets = Sets::new(&lamps, count);
        let (view, objects, budget) = (&view, &objects, &budget);
        Ok(move || plan(black_box(view), sets.take(), objects, budget))
    })?);
    Ok(costs)
}

/// As many sets of so many lights as there are, one after another: one light may cost more than another, and what it costs
/// alone is the mean over many.
struct Sets<'a> {
    lights: &'a [Light],
    count: usize,
    first: usize,
}

impl<'a> Sets<'a> {
    fn new(lights: &'a [Light], count: usize) -> Self {
        Self { lights, count, first: 0 }
    }

    fn take(&mut self) -> &'a [Light] {
        let set = &self.lights[self.first..][..self.count];
        self.first += self.count;
        if self.first + self.count > self.lights.len() {
            self.first = 0;
        }
        set
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_light_is_in_one_set() -> Result<()> {
        let lights = town::street_lamps(10)?;
        let mut sets = Sets::new(&lights, 5);
        let [first, second, again] = [(); 3].map(|()| sets.take());
        assert_eq!([first, second].concat(), lights);
        assert_eq!(first, again);
        assert_eq!(Sets::new(&lights, 10).take(), lights);
        Ok(())
    }

    #[test]
    fn every_lamp_has_a_map() -> Result<()> {
        let (view, bounds, lamps) = (town::view()?, town::bounds()?, town::lamps(20)?);
        let settings = town::settings(Technique::Best)?;
        assert_eq!(lamps.len(), 20);
        assert!(lamps.iter().all(|lamp| fit(&view, lamp, &bounds, &settings).map().is_some()));
        Ok(())
    }
}
