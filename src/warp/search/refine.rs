//! Refining a map: steps from a soft maximum to a sharp one.

use super::draft::Rows;
use super::step::{Sharpness, step};
use super::{Candidate, Search};
use core::mem;

/// A schedule of refinement.
#[derive(Clone, Copy, Debug)]
pub(super) struct Refinement {
    /// The first and the last sharpness.
    from: Sharpness,
    to: Sharpness,
    /// The damping of the first step.
    damping: f64,
    /// The largest number of steps.
    steps: u32,
}

/// The least gain of a successful step, as a part of the summed powers.
const LEAST_GAIN: f64 = 1e-3;
/// A gain below this exhausts the current sharpness: a sharper maximum is next.
const ENOUGH: f64 = 0.25;

impl Refinement {
    pub(super) const ROUGH: Self = Self { from: Sharpness(2), to: Sharpness(5), damping: 0.3, steps: 8 };
    pub(super) const SOFT: Self = Self { from: Sharpness(2), to: Sharpness(4), damping: 0.3, steps: 8 };
    pub(super) const SHARP: Self = Self { from: Sharpness(5), to: Sharpness(8), damping: 0.1, steps: 16 };
    /// From the previous frame's map, which was sharp.
    pub(super) const NEXT_FRAME: Self = Self { from: Sharpness(7), to: Sharpness(8), damping: 0.1, steps: 8 };
}

impl Search {
    /// The best map at the watched points, refined from the one with these rows; `None` where that is no map for R.
    pub(super) fn refined(&mut self, start: &Rows, refinement: &Refinement) -> Option<Candidate> {
        let (mut draft, mut next) = (&mut self.draft, &mut self.next);
        if !draft.set_rows(&self.watched, start) {
            return None;
        }
        let mut best = Candidate { rows: draft.rows, worst: draft.worst };
        let Refinement { from: mut sharpness, to, mut damping, steps } = *refinement;
        let mut failed = 0;
        for _ in 0..steps {
            let valid = next.set_changed(draft, &step(draft, sharpness, damping));
            let gain = if valid { sharpness.gain(next, draft) } else { 0.0 };
            if gain > LEAST_GAIN {
                mem::swap(&mut draft, &mut next);
                best = best.or(Some(Candidate { rows: draft.rows, worst: draft.worst }));
                damping = (damping * 0.3).max(1e-3);
                failed = 0;
            } else {
                damping *= 20.0;
                failed += 1;
            }
            if sharpness < to && (failed == 2 || failed == 0 && gain < ENOUGH) {
                sharpness = sharpness.next();
                failed = 0;
            } else if failed == 3 {
                break;
            }
        }
        Some(best)
    }
}
