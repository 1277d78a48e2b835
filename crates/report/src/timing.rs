//! Contenders timed in turn, so that whatever else the machine does meets all of them alike.

use std::time::{Duration, Instant};

use serde::Serialize;

use crate::statistics::{median, quantile};

/// What timing said of one contender.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Time {
    /// The median over all rounds, in seconds.
    pub seconds: f64,
    /// The median, over all rounds, of its time over that of the first contender in the same round.
    pub ratio: f64,
    /// A tenth and nine tenths of those ratios.
    pub spread: [f64; 2],
}

/// Times contenders in turn, round after round. A contender does its work once and says how long it took, by whatever clock is
/// right for it.
///
/// # Errors
///
/// The first that a contender makes.
pub fn in_turn<E>(
    rounds: usize,
    contenders: &mut [Box<dyn FnMut() -> Result<Duration, E> + '_>],
) -> Result<Vec<Time>, E> {
    let mut times = vec![Vec::with_capacity(rounds); contenders.len()];
    for round in 0..rounds {
        for turn in 0..contenders.len() {
            // Each begins as often as any other: what comes after something else finds its caches.
            let index = (turn + round) % contenders.len();
            times[index].push(contenders[index]()?.as_secs_f64());
        }
    }
    let first = times.first().cloned().unwrap_or_default();
    let time = |times: &Vec<f64>| {
        let ratios: Vec<f64> = times.iter().zip(&first).map(|(time, first)| time / first).collect();
        let spread = [quantile(&ratios, 0.1), quantile(&ratios, 0.9)];
        Time { seconds: median(times), ratio: median(&ratios), spread }
    };
    Ok(times.iter().map(time).collect())
}

/// How long some work takes by the processor's clock. What it returns is used, so that it is not left out.
pub fn taken<T>(work: impl FnOnce() -> T) -> Duration {
    let start = Instant::now();
    std::hint::black_box(work());
    start.elapsed()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::Cell;
    use std::convert::Infallible;

    #[test]
    fn everyone_has_as_many_turns_and_ratios_are_those_of_a_round() {
        let round = Cell::new(0_u32);
        // The machine is a hundred times slower in every other round, which no ratio sees.
        let slow = || if round.get().is_multiple_of(2) { 1.0 } else { 100.0 };
        let turns = Cell::new([0; 2]);
        let turn = |index: usize, seconds: f64| {
            let mut count = turns.get();
            count[index] += 1;
            let time = Duration::from_secs_f64(seconds * slow());
            turns.set(count);
            if count[0] == count[1] {
                round.set(count[0]);
            }
            Ok::<_, Infallible>(time)
        };
        let times = in_turn(4, &mut [Box::new(|| turn(0, 0.25)), Box::new(|| turn(1, 0.5))]);
        let times = times.expect("they do not fail");
        assert_eq!(turns.get(), [4, 4]);
        assert!((times[0].ratio - 1.0).abs() < 1e-9 && (times[1].ratio - 2.0).abs() < 1e-9, "{times:?}");
        assert!(times[1].spread.iter().all(|ratio| (ratio - 2.0).abs() < 1e-9), "{times:?}");
    }
}
