//! Worst aliasing over fit time, on random outdoor views: needs no card.

use std::convert::Infallible;

use anyhow::{Context, Result};
use rand::SeedableRng;
use rand::rngs::StdRng;
use render_check::maps::Technique;
use render_check::output::progress::bar;
use serde::Serialize;
use shadowfit::{Focus, Light, Scene, Settings, View, fit};

use super::cases::ALL_WARPS;
use crate::size::Size;
use crate::statistics::quantile;
use crate::timing::{in_turn, taken};
use testkit::outdoors::{self, Kind};

/// A map counts as coarser than the uniform one from here on: both have roundings of their own.
const COARSER: f64 = 1.001;

/// What came of one warp under lights of one kind. Ratios of aliasing are over those of the uniform map of the same view.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SurveyRecord {
    /// The kind of light.
    pub kind: &'static str,
    /// Whether the view was narrowed to the depths that its ground is seen in.
    pub narrowed: bool,
    /// The warp.
    pub technique: Technique,
    /// Views that have a map.
    pub views: usize,
    /// Views that have none, whatever the warp: the light stands among what is visible, or nothing is.
    pub without_map: usize,
    /// Focus body and map, the mean over all views, the median over rounds.
    pub fit_us: f64,
    /// That over the uniform map's in the same round.
    pub fit_ratio: f64,
    /// Worst aliasing over the uniform map's: a tenth of views, half, nine tenths have no more.
    pub worst_10: f64,
    /// See above.
    pub worst_50: f64,
    /// See above.
    pub worst_90: f64,
    /// The part of views where it is coarser than the uniform map at worst.
    pub coarser_share: f64,
    /// Mean aliasing over the uniform map's: half of the views have no more.
    pub mean_50: f64,
    /// Worst aliasing over the limit, the least that any spread of the same texels could have: half of the views.
    pub over_limit_50: f64,
    /// Nine tenths of them.
    pub over_limit_90: f64,
}

/// Fits maps of every warp to random views.
///
/// # Errors
///
/// When a warp has no map where the uniform one has.
pub fn survey(size: Size) -> Result<Vec<SurveyRecord>> {
    let (views, rounds) = (size.of(5, 250), size.of(3, 15));
    let scene = outdoors::town();
    let ground = Scene::from_box((-200.0, 0.0, -200.0), (200.0, 0.0, 200.0)).context("the ground is a box")?;
    let bar = bar("aliasing over fit time", 2 * Kind::ALL.len());
    let mut records = Vec::new();
    for narrowed in [true, false] {
        for kind in Kind::ALL {
            let mut random = StdRng::seed_from_u64(1);
            let mut cases = Vec::new();
            for _ in 0..views {
                let (view, light) = (outdoors::view(&mut random), kind.light(&mut random));
                cases.push((if narrowed { on_ground(&view, &light, &ground) } else { view }, light));
            }
            records.extend(of_kind(kind, narrowed, &cases, &scene, rounds)?);
            bar.inc(1);
        }
    }
    Ok(records)
}

/// The view narrowed to the depths that lit ground is seen in; the whole view where there is none.
fn on_ground(view: &View, light: &Light, ground: &Scene<'_>) -> View {
    let visible = Focus::new(view, light, ground).receiver_volume();
    let depths = || visible.vertices().iter().map(|&point| view.depth(point));
    let (near, far) = (depths().fold(f64::INFINITY, f64::min), depths().fold(0.0, f64::max));
    view.narrowed(near, far).unwrap_or(*view)
}

fn of_kind(
    kind: Kind,
    narrowed: bool,
    cases: &[(View, Light)],
    scene: &Scene<'_>,
    rounds: usize,
) -> Result<Vec<SurveyRecord>> {
    let settings = ALL_WARPS.map(|technique| technique.settings(Settings::default()));
    // Of each warp, for each view: worst and mean over the uniform map's, and worst over the limit.
    let mut ratios = ALL_WARPS.map(|_| [const { Vec::new() }; 3]);
    for (view, light) in cases {
        let focus = Focus::new(view, light, scene);
        let aliasing = |settings: &Settings| focus.fit(settings).map()?.aliasing_over(&focus);
        let Some(uniform) = aliasing(&settings[0]) else { continue };
        let limit = focus.aliasing_lower_bound(&settings[0]);
        for (ratios, settings) in ratios.iter_mut().zip(&settings) {
            let found = aliasing(settings).context("a view has a uniform map and none with a warp")?;
            let of_view = [found.worst / uniform.worst, found.mean / uniform.mean, found.worst / limit];
            ratios.iter_mut().zip(of_view).for_each(|(ratios, ratio)| ratios.push(ratio));
        }
    }
    let fits = |settings: Settings| {
        move || {
            let found = || cases.iter().filter(|(view, light)| fit(view, light, scene, &settings).map().is_some());
            Ok::<_, Infallible>(taken(|| found().count()) / cases.len().max(1) as u32)
        }
    };
    let mut contenders: Vec<Box<dyn FnMut() -> _>> = Vec::new();
    for settings in settings {
        contenders.push(Box::new(fits(settings)));
    }
    let times = in_turn(rounds, &mut contenders)?;
    let records = ALL_WARPS.iter().zip(&ratios).zip(&times).map(|((&technique, [worst, mean, limit]), time)| {
        let coarser = worst.iter().filter(|&&ratio| ratio > COARSER).count();
        SurveyRecord {
            kind: kind.name(),
            narrowed,
            technique,
            views: worst.len(),
            without_map: cases.len() - worst.len(),
            fit_us: 1e6 * time.seconds,
            fit_ratio: time.ratio,
            worst_10: quantile(worst, 0.1),
            worst_50: quantile(worst, 0.5),
            worst_90: quantile(worst, 0.9),
            coarser_share: coarser as f64 / worst.len() as f64,
            mean_50: quantile(mean, 0.5),
            over_limit_50: quantile(limit, 0.5),
            over_limit_90: quantile(limit, 0.9),
        }
    });
    Ok(records.collect())
}
