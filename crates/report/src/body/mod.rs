//! The body that a map is fitted to and casters are culled by: what it costs, and what it gives.
//!
//! | module | what it holds |
//! |---|---|
//! | `town`, `case` | what every contender is given |
//! | `naive` | a box or a ball around the view, and the whole cone of a spot |
//! | `cascade` | Bevy's own system (with the feature `bevy`) |
//! | `library` | H by parry, in f32 and in f64 |
//! | `own` | the crate |
//! | `contender` | what they have in common |
//! | `truth` | R, H and the casters needed, decided in integers |
//! | `window` | areas, as the light sees them |
//! | `judge` | a fit against the truth |
//! | `hard` | the hard cases of the property tests |
//! | `summary` | figures of a contender over all cases |
//! | `findings`, `chapter` | sentences, tables and plots |

#[cfg(feature = "bevy")]
mod cascade;
mod case;
mod chapter;
mod contender;
mod findings;
mod hard;
mod judge;
mod library;
mod naive;
mod own;
mod summary;
mod town;
mod truth;
mod window;

pub use chapter::chapter;
pub use judge::Fit;
pub use summary::Summary;

use std::convert::Infallible;
use std::time::Duration;

use anyhow::{Context as _, Result};
use rand::SeedableRng as _;
use rand::rngs::StdRng;
use render_check::output::progress::bar;
use shadowfit::Scene;

use crate::size::Size;
use crate::timing::{Time, in_turn};
use case::Case;
use contender::Contender;
use judge::Bench;
use testkit::outdoors::{self, Kind};
use town::Town;
use truth::TownTruth;

/// All that was measured.
#[derive(Clone, Debug)]
pub struct Measured {
    /// What the judge said of each fit in the town.
    pub fits: Vec<Fit>,
    /// Each contender over all cases of a kind of light.
    pub summaries: Vec<Summary>,
}

/// Measures all contenders on the same cases.
///
/// # Errors
///
/// Where a case cannot be made, or a contender cannot be set up.
pub fn measure(size: Size) -> Result<Measured> {
    let hard = hard::measure(size)?;
    let town = Town::new(1);
    let lists = Scene::new(&town.casters, &town.receivers).context("the town is no scene")?;
    let (mut fits, mut summaries) = (Vec::new(), Vec::new());
    for kind in Kind::ALL {
        let (cases, truths) = cases(kind, size, &town, &lists)?;
        let contenders = contenders(kind, &cases)?;
        let progress = bar(&format!("bodies of a {}", kind.name()), cases.len());
        let first = fits.len();
        for (index, (case, truth)) in cases.iter().zip(&truths).enumerate() {
            let mut bench = Bench::new(kind.name(), index, case, &town, truth);
            fits.extend(
                contenders.iter().map(|contender| bench.judge(contender.name, contender.fitted(case).as_ref())),
            );
            progress.inc(1);
        }
        progress.finish_and_clear();
        let times = times(size, &cases, &contenders);
        for (contender, time) in contenders.iter().zip(times) {
            let own: Vec<&Fit> = fits[first..].iter().filter(|fit| fit.contender == contender.name).collect();
            summaries.push(Summary::new(kind.name(), contender.name, &own, &time, cases.len(), &hard));
        }
    }
    Ok(Measured { fits, summaries })
}

/// The names of the lights.
const SUN: &str = Kind::Sun.name();
const LAMP: &str = Kind::Lamp.name();
const SPOT: &str = Kind::Spot.name();

/// Random views and lights that have something to cast on something visible, and what is true of them.
fn cases<'a>(kind: Kind, size: Size, town: &Town, lists: &Scene<'a>) -> Result<(Vec<Case<'a>>, Vec<TownTruth>)> {
    let wanted = size.of(6, 800);
    let progress = bar(&format!("what is true under a {}", kind.name()), wanted);
    let bounds = town.bounds();
    let scene = Scene::from_box(bounds.0, bounds.1).context("the town has no bounds")?;
    let mut random = StdRng::seed_from_u64(2 + kind as u64);
    let (mut cases, mut truths) = (Vec::new(), Vec::new());
    while cases.len() < wanted {
        let (view, light) = (outdoors::view(&mut random), kind.light(&mut random));
        let case = Case::new(view, light, scene, bounds, Vec::new())?.with_lists(*lists);
        if let Some(truth) = TownTruth::new(&case, town)? {
            cases.push(case);
            truths.push(truth);
            progress.inc(1);
        }
    }
    progress.finish_and_clear();
    Ok((cases, truths))
}

/// All that take a kind of light.
fn contenders<'a>(kind: Kind, cases: &[Case<'_>]) -> Result<Vec<Contender<'a>>> {
    let mut contenders = match kind {
        Kind::Sun => {
            let mut contenders = naive::boxes_and_balls();
            contenders.extend(cascades(cases)?);
            contenders
        }
        Kind::Lamp => Vec::new(),
        Kind::Spot => vec![naive::whole_cone()],
    };
    contenders.extend(library::libraries());
    contenders.extend(own::of_bounds());
    contenders.extend(own::of_lists());
    Ok(contenders)
}

/// Bevy's contenders, where they are built.
#[cfg(feature = "bevy")]
fn cascades<'a>(cases: &[Case<'_>]) -> Result<Vec<Contender<'a>>> {
    cascade::cascades(cases)
}

/// Bevy is not built.
#[cfg(not(feature = "bevy"))]
fn cascades<'a>(_: &[Case<'_>]) -> Result<Vec<Contender<'a>>> {
    Ok(Vec::new())
}

/// All contenders timed in turn, all cases a turn.
fn times(size: Size, cases: &[Case<'_>], contenders: &[Contender<'_>]) -> Vec<Time> {
    let mut turns: Vec<Box<dyn FnMut() -> Result<Duration, Infallible> + '_>> = Vec::new();
    for contender in contenders {
        turns.push(Box::new(move || Ok(contender.turn(cases))));
    }
    match in_turn(size.of(3, 101), &mut turns) {
        Ok(times) => times,
        Err(never) => match never {},
    }
}

#[cfg(test)]
mod tests;
