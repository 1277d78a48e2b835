//! A run: one light with one technique, drawn on the GPU and compared with ray-traced truth.

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
    /// CPU time of fitting all maps, in microseconds.
    pub fit_us: f64,
    /// GPU time of the shadow maps' passes, in milliseconds; `None` without timestamps.
    pub shadow_map_ms: Option<f64>,
    /// GPU time of the camera pass.
    pub camera_ms: Option<f64>,
    /// GPU time of the shadow test.
    pub shadow_test_ms: Option<f64>,
}

/// The results of a run with maps.
pub struct MapRun {
    /// The maps, and which answers for which points.
    pub fitted: FittedMaps,
    /// The stored depths of each map, row by row from the top.
    pub depths: Vec<Vec<f32>>,
    /// The lit fraction of each pixel.
    pub lit: Vec<f32>,
    /// The share of the compared pixels that virtual samples decided; `None` with filters that use none.
    pub used_plane: Option<f64>,
    /// The numbers of casters drawn.
    pub drawn: Drawn,
    /// The times.
    pub times: Times,
    /// The predicted aliasing.
    pub prediction: Prediction,
    /// The comparison with ray-traced truth.
    pub verdict: Verdict,
}

impl MapRun {
    /// The aliasing at a point, in the map that covers it; `None` where there is no map.
    #[must_use]
    pub fn aliasing(&self, point: DVec3) -> Option<f64> {
        let fitted = self.fitted.maps[self.fitted.split.part_of(point)].as_ref()?;
        Some(fitted.map.aliasing(point).unwrap_or(f64::INFINITY))
    }
}

/// Runs one light with one technique; or returns the reason for no map.
///
/// # Errors
///
/// When the settings are invalid or the GPU reports an error.
pub fn run(stage: &Stage<'_>, light: &StageLight, options: &Options) -> Result<Result<MapRun, NoMap>> {
    let fitted = match FittedMaps::new(stage, &light.light, options)? {
        Ok(fitted) => fitted,
        Err(none) => return Ok(Err(none)),
    };
    let settings = options.settings(stage)?;
    let fit_all = || fitted.fit_again(None, stage, &settings);
    // A fit is a few hundred times faster than a frame, so it is repeated more often.
    let fit_time = median_time(300 * options.frames as usize - 299, fit_all);
    Ok(Ok(run_fitted(stage, light, options, fitted, fit_time)?))
}

/// Draws, tests and judges fitted maps; `fit_time` is the time that their fit took.
///
/// # Errors
///
/// When the GPU reports an error.
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

/// Compares the rendered image with the truth.
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
                derived: map.as_ref()?.bias,
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

/// `None` without timestamps.
fn median_ms(times: Vec<Option<Duration>>) -> Option<f64> {
    let mut times: Vec<Duration> = times.into_iter().flatten().collect();
    times.sort_unstable();
    times.get(times.len() / 2).map(|time| time.as_secs_f64() * 1e3)
}
