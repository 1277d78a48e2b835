//! Contenders whose turn is all of the cases, one after another.

use std::time::Duration;

use anyhow::Result;
use serde::Serialize;

use crate::timing::{Time, in_turn};

/// A contender's turn.
pub(super) type Turn<'a> = Box<dyn FnMut() -> Result<Duration> + 'a>;

/// The time of one case, as a record has it.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct CaseTime {
    /// How many of the cases time was taken of.
    pub timed_cases: usize,
    /// How often.
    pub rounds: usize,
    /// Median time of one case, in seconds.
    pub seconds: f64,
    /// Median of its time over the crate's, of the same cases in the same round.
    pub ratio: f64,
    /// A tenth of those ratios.
    pub ratio_low: f64,
    /// And nine tenths.
    pub ratio_high: f64,
}

/// Times of one case each, of contenders of which the first is compared with. Each has a turn beforehand, for the caches.
pub(super) fn times(rounds: usize, cases: usize, mut turns: Vec<Turn<'_>>) -> Result<Vec<CaseTime>> {
    for turn in &mut turns {
        turn()?;
    }
    let of_case = |time: Time| CaseTime {
        timed_cases: cases,
        rounds,
        seconds: time.seconds / cases as f64,
        ratio: time.ratio,
        ratio_low: time.spread[0],
        ratio_high: time.spread[1],
    };
    Ok(in_turn(rounds, &mut turns)?.into_iter().map(of_case).collect())
}
