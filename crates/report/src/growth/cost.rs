//! What some work costs with so many of something, timed in turn for each number.

use std::fmt;
use std::hint::black_box;
use std::time::Duration;

use anyhow::Result;
use serde::Serialize;

use crate::size::Size;
use crate::timing::{in_turn, taken};

/// What there is more and more of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Counted {
    /// Lamps and other lights.
    Lights,
    /// Boxes of what casts.
    Casters,
    /// Planes that bound S.
    Planes,
    /// Texels of a map: the square of its side.
    Texels,
    /// Triangles drawn into a map.
    Triangles,
    /// Cascades of a view.
    Cascades,
}

impl fmt::Display for Counted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Lights => "lights",
            Self::Casters => "casters",
            Self::Planes => "planes of S",
            Self::Texels => "texels",
            Self::Triangles => "triangles",
            Self::Cascades => "cascades",
        })
    }
}

/// What is done.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Work {
    /// A uniform fit.
    FitUniform,
    /// A light-space fit.
    FitLightSpace,
    /// A search for the best matrix, with good effort.
    FitBest,
    /// The focus body H, tight.
    Body,
    /// A plan.
    Plan,
    /// Boxes against H, several at a time.
    CullInBulk,
    /// Boxes against H, one at a time.
    CullOneByOne,
    /// Objects sorted for the planner.
    Sort,
    /// A scene of lists made, and a uniform fit to it.
    FitLists,
    /// A view cut into cascades.
    Cut,
    /// The same, and a uniform fit of each.
    CutAndFitUniform,
    /// The same, and a search for the best matrix of each.
    CutAndFitBest,
    /// The map's pass on the card.
    MapPass,
    /// The shadow test on the card.
    ShadowTest,
}

impl Work {
    /// Whether the card does it, by whose clock it is timed then.
    #[must_use]
    pub const fn is_on_card(self) -> bool {
        matches!(self, Self::MapPass | Self::ShadowTest)
    }
}

impl fmt::Display for Work {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::FitUniform => "uniform fit",
            Self::FitLightSpace => "light-space fit",
            Self::FitBest => "best fit",
            Self::Body => "tight H",
            Self::Plan => "planning",
            Self::CullInBulk => "culling in bulk",
            Self::CullOneByOne => "culling one by one",
            Self::Sort => "sorting for the planner",
            Self::FitLists => "making a scene of lists and its uniform fit",
            Self::Cut => "cutting",
            Self::CutAndFitUniform => "cutting and uniform fits",
            Self::CutAndFitBest => "cutting and best fits",
            Self::MapPass => "the map's pass",
            Self::ShadowTest => "the shadow test",
        })
    }
}

/// What some work costs with so many of something.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Cost {
    /// What is done.
    pub work: Work,
    /// What there is more and more of.
    pub counted: Counted,
    /// How many there are.
    pub count: u64,
    /// How long it takes with all of them, in seconds: the median.
    pub seconds: f64,
    /// How many times as long as with the fewest: the median over rounds.
    pub times: f64,
    /// A tenth of the rounds have less.
    pub times_low: f64,
    /// A tenth of the rounds have more.
    pub times_high: f64,
}

/// A turn says how long so many calls take, as a [`Duration`] rounds to nanoseconds, and some calls take few of them.
const CALLS: f64 = 1000.0;

/// Times some work on the processor, in turn for each number of things. `work_with` makes it for a number; it is called as
/// often in a turn as fills one.
///
/// # Errors
///
/// When work cannot be made.
pub(super) fn on_processor<T, F: FnMut() -> T>(
    work: Work,
    counted: Counted,
    counts: &[usize],
    size: Size,
    mut work_with: impl FnMut(usize) -> Result<F>,
) -> Result<Vec<Cost>> {
    let turn = Duration::from_micros(size.of(50, 3_000)).as_secs_f64();
    let mut round = 0.0;
    let mut contenders: Vec<(u64, Contender<'_>)> = Vec::new();
    for &count in counts {
        let mut call = work_with(count)?;
        // As often as fills a part of a turn, and once at least: it says how many fill all of it.
        let (mut spent, mut tried) = (0.0, 0.0);
        while spent < 0.3 * turn {
            spent += taken(&mut call).as_secs_f64();
            tried += 1.0;
        }
        let once = spent / tried;
        let calls = (turn / once).ceil();
        round += calls * once;
        let all = move || {
            let time = taken(|| (0..calls as u64).for_each(|_| drop(black_box(call()))));
            Ok(time.mul_f64(CALLS / calls))
        };
        contenders.push((count as u64, Box::new(all)));
    }
    // Where rounds are short there are many: the median then bears what else the machine does.
    let rounds = (size.of(0.0, 3.0) / round).clamp(size.of(3.0, 7.0), 101.0) as usize;
    timed(work, counted, rounds, CALLS, contenders)
}

/// What takes a turn.
pub(super) type Contender<'a> = Box<dyn FnMut() -> Result<Duration> + 'a>;

/// Times contenders, each of which says how long so many calls take with so many things, in turn for so many rounds.
///
/// # Errors
///
/// The first that a contender makes.
pub(super) fn timed(
    work: Work,
    counted: Counted,
    rounds: usize,
    calls: f64,
    contenders: Vec<(u64, Contender<'_>)>,
) -> Result<Vec<Cost>> {
    let (counts, mut contenders): (Vec<u64>, Vec<Contender<'_>>) = contenders.into_iter().unzip();
    let times = in_turn(rounds, &mut contenders)?;
    let cost = |(count, time): (u64, crate::timing::Time)| {
        let [times_low, times_high] = time.spread;
        Cost { work, counted, count, seconds: time.seconds / calls, times: time.ratio, times_low, times_high }
    };
    Ok(counts.into_iter().zip(times).map(cost).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_those_of_a_call_and_relative_to_the_first() -> Result<()> {
        let takes =
            |count: u64| -> (u64, Contender<'_>) { (count, Box::new(move || Ok(Duration::from_secs(2 * count)))) };
        let costs = timed(Work::Sort, Counted::Casters, 3, CALLS, vec![takes(5), takes(10)])?;
        let of = |cost: &Cost| (cost.count, cost.seconds, cost.times);
        assert_eq!(costs.iter().map(of).collect::<Vec<_>>(), [(5, 0.01, 1.0), (10, 0.02, 2.0)]);
        Ok(())
    }

    #[test]
    fn work_that_cannot_be_made_is_an_error() {
        let work = |count: usize| if count < 2 { Ok(move || count) } else { anyhow::bail!("too many") };
        let costs = on_processor(Work::Sort, Counted::Casters, &[1, 2], Size::Smoke, work);
        assert_eq!(costs.expect_err("it cannot be made").to_string(), "too many");
    }
}
