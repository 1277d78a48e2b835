//! One run: one light, fitted in one way, drawn on the card and held against the truth.

use std::time::Duration;

use anyhow::Result;
use serde::Serialize;
use shadowfit::glam::DVec3;

use super::fitted_maps::{Drawn, FittedMaps};
use super::frames::{Frame, Frames};
use super::options::Options;
use super::prediction::Prediction;
use super::timing::median_time;
use crate::gpu::{Filter, Shadows};
use crate::maps::NoMap;
use crate::stage::{Stage, StageLight};
use crate::verdict::{self, DrawnMap, Projection, Rendered, Verdict};

/// Median times.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Times {
    /// Of the fits of all maps, on the processor, in microseconds.
    pub fit_us: f64,
    /// Of the shadow maps' passes, by the card's clock, in milliseconds; nothing where it has none.
    pub shadow_map_ms: Option<f64>,
    /// Of the camera's pass.
    pub camera_ms: Option<f64>,
    /// Of the shadow test.
    pub shadow_test_ms: Option<f64>,
}

/// What came of a run with maps.
pub struct MapRun {
    /// The maps, and which answers for which points.
    pub fitted: FittedMaps,
    /// The depths of each map that is drawn, as stored, row by row from the top.
    pub depths: Vec<Vec<f32>>,
    /// The share of light that reaches each pixel.
    pub lit: Vec<f32>,
    /// The share of the compared pixels where virtual samples decided; nothing with a filter that has none.
    pub used_plane: Option<f64>,
    /// What was drawn.
    pub drawn: Drawn,
    /// How long it took.
    pub times: Times,
    /// What the fit says of it.
    pub prediction: Prediction,
    /// How it compares with the truth.
    pub verdict: Verdict,
}

impl MapRun {
    /// How much larger a texel is than a pixel at a point, in the map that answers for it; `None` where none does.
    #[must_use]
    pub fn aliasing(&self, point: DVec3) -> Option<f64> {
        let fitted = self.fitted.maps[self.fitted.split.part_of(point)].as_ref()?;
        Some(fitted.map.aliasing(point).unwrap_or(f64::INFINITY))
    }
}

/// Runs one light through one technique; or says why there is no map.
///
/// # Errors
///
/// When the settings cannot be used or the card refuses.
pub fn run(stage: &Stage<'_>, light: &StageLight, options: &Options) -> Result<Result<MapRun, NoMap>> {
    let fitted = match FittedMaps::new(stage, &light.light, options)? {
        Ok(fitted) => fitted,
        Err(none) => return Ok(Err(none)),
    };
    let settings = options.settings(stage)?;
    let fit_all = || fitted.fit_again(None, stage, &settings);
    // A fit takes a few hundred times less than a frame.
    let fit_time = median_time(300 * options.frames as usize - 299, fit_all);
    Ok(Ok(run_fitted(stage, light, options, fitted, fit_time)?))
}

/// Draws, tests and judges maps that are fitted already, in the time that is given.
///
/// # Errors
///
/// When the card refuses.
pub fn run_fitted(
    stage: &Stage<'_>,
    light: &StageLight,
    options: &Options,
    fitted: FittedMaps,
    fit_time: Duration,
) -> Result<MapRun> {
    let mut frames = Frames::new(stage, &fitted, options.filter)?;
    let Frame { shadow_maps, shadows: Shadows { lit, used_plane, time } } = frames.draw()?;
    let (mut shadow_map_times, mut shadow_test_times) = (vec![shadow_maps], vec![time]);
    for _ in 1..options.frames {
        let frame = frames.draw()?;
        shadow_map_times.push(frame.shadow_maps);
        shadow_test_times.push(frame.shadows.time);
    }
    let depths = frames.depths()?;
    let verdict = judged(stage, light, options, &fitted, &depths, &lit)?;
    let times = Times {
        fit_us: fit_time.as_secs_f64() * 1e6,
        shadow_map_ms: median_ms(shadow_map_times),
        camera_ms: median_ms(vec![stage.surfaces.time]),
        shadow_test_ms: median_ms(shadow_test_times),
    };
    let (drawn, prediction) = (fitted.drawn(stage), Prediction::new(&fitted, stage, &light.light));
    let used_plane = matches!(options.filter, Filter::Virtual(_)).then(|| light.truth.share(&used_plane));
    Ok(MapRun { fitted, depths, lit, used_plane, drawn, times, prediction, verdict })
}

/// Holds what was drawn against the truth.
fn judged(
    stage: &Stage<'_>,
    light: &StageLight,
    options: &Options,
    fitted: &FittedMaps,
    depths: &[Vec<f32>],
    lit: &[f32],
) -> Result<Verdict> {
    let projections: Vec<Option<Box<dyn Projection>>> =
        fitted.maps.iter().map(|map| map.as_ref().map(|map| verdict::projection(&map.map))).collect();
    let mut depths = depths.iter();
    let maps: Vec<Option<DrawnMap<'_>>> = fitted
        .maps
        .iter()
        .zip(&projections)
        .map(|(map, projection)| {
            Some(DrawnMap {
                projection: projection.as_deref()?,
                depths: depths.next()?,
                is_reversed: map.as_ref()?.map.settings().clip().depth.is_reversed(),
                bias: verdict::Bias::most(&map.as_ref()?.pass),
            })
        })
        .collect();
    let rendered = Rendered {
        split: &fitted.split,
        maps: &maps,
        lit,
        faces: options.faces,
        depth_step: options.format.step(1.0),
        reach: options.filter.reach(),
    };
    verdict::judge(&light.truth, &rendered, stage.tracer)
}

/// Nothing where the card has no clock.
fn median_ms(times: Vec<Option<Duration>>) -> Option<f64> {
    let mut times: Vec<Duration> = times.into_iter().flatten().collect();
    times.sort_unstable();
    times.get(times.len() / 2).map(|time| time.as_secs_f64() * 1e3)
}
