//! Timing of calls.

use std::hint::black_box;
use std::time::{Duration, Instant};

/// The time limit for repeated calls.
const TIMING_BUDGET: Duration = Duration::from_millis(100);

/// The median time of `most` calls, or of fewer where they take long.
#[must_use]
pub fn median_time<T>(most: usize, call: impl Fn() -> T) -> Duration {
    let begin = Instant::now();
    let mut times = Vec::new();
    while times.is_empty() || (times.len() < most && begin.elapsed() < TIMING_BUDGET) {
        let start = Instant::now();
        black_box(call());
        times.push(start.elapsed());
    }
    times.sort_unstable();
    times[times.len() / 2]
}
