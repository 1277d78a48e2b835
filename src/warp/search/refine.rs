//! Refining a map: steps from soft sides of the window to sharp ones.

use super::step::{Aim, step};
use super::surfaces::Power;
use super::{Candidate, Search};

/// A schedule of refinement.
#[derive(Clone, Copy, Debug)]
pub(super) struct Refinement {
    /// The first and the last sharpness.
    from: u32,
    to: u32,
    /// The damping of the first step.
    damping: f64,
    /// The largest number of steps.
    steps: u32,
}

/// The least gain of a successful step, as a part of the summed powers.
const LEAST_GAIN: f64 = 1e-3;
/// A gain below this exhausts the current sharpness: a sharper maximum is next.
const ENOUGH: f64 = 0.05;

impl Refinement {
    pub(super) const ROUGH: Self = Self { from: 2, to: 5, damping: 0.3, steps: 8 };
    pub(super) const SOFT: Self = Self { from: 2, to: 4, damping: 0.3, steps: 6 };
    pub(super) const SHARP: Self = Self { from: 5, to: 8, damping: 0.1, steps: 12 };
    /// For the choice of cascades, which compares many.
    pub(super) const OF_RANGE: Self = Self { from: 3, to: 5, damping: 0.3, steps: 2 };
    /// From the previous frame's map, which was sharp.
    pub(super) const NEXT_FRAME: Self = Self { from: 7, to: 8, damping: 0.1, steps: 8 };
}

impl Search {
    /// The best map on the way from a start.
    pub(super) fn refined(&self, start: &Candidate, refinement: &Refinement) -> Candidate {
        let Refinement { from: mut sharpness, to, mut damping, steps } = *refinement;
        let (mut here, mut best, mut failed) = (*start, *start, 0);
        for _ in 0..steps {
            let power = Power::new(self.objective, sharpness);
            let aim = Aim { sharpness, power, damping };
            let change = step(&self.surfaces, &self.chart, &here.map, here.error, &aim);
            let next = self.chart.changed(&here.map, &change).and_then(|map| self.candidate(map));
            let gain = next
                .as_ref()
                .map_or(0.0, |next| self.surfaces.gain((&next.map, next.error), (&here.map, here.error), power));
            if let Some(next) = next.filter(|_| gain > LEAST_GAIN) {
                here = next;
                best = best.or(Some(here));
                damping = (damping * 0.3).max(1e-3);
                failed = 0;
            } else {
                damping *= 20.0;
                failed += 1;
            }
            if sharpness < to && (failed == 2 || failed == 0 && gain < ENOUGH) {
                sharpness += 1;
                failed = 0;
            } else if failed == 3 {
                break;
            }
        }
        best
    }
}
