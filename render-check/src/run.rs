//! One run: one light, fitted in one way, drawn on the card and held against the truth.

use std::time::Duration;

use anyhow::{Context, Result};
use serde::Serialize;
use shadowfit::glam::DVec3;
use shadowfit::{DepthFormat, Settings};

use crate::args::ClipArg;
use crate::cut::Cutting;
use crate::fitted_maps::{Drawn, FittedMaps};
use crate::fitting::{NoMap, median_time};
use crate::frames::{Frame, Frames};
use crate::gpu::{Bias, Filter, MapPass, Points, Shadows};
use crate::layout::Layout;
use crate::prediction::Prediction;
use crate::slicing::Slicing;
use crate::stage::{Stage, StageLight};
use crate::technique::Technique;
use crate::trace::Faces;
use crate::verdict::{self, DrawnMap, Projection, Rendered, Verdict};

/// How a light's maps are fitted, drawn and read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// How its texels are spread.
    pub technique: Technique,
    /// Texels along each side.
    pub map_size: u32,
    /// How the view is cut into slices with a map each; not at all without.
    pub slicing: Option<Slicing>,
    /// Whose clip space its matrix is for.
    pub clip: ClipArg,
    /// The depth buffer's format.
    pub format: DepthFormat,
    /// Which sides of triangles are drawn.
    pub faces: Faces,
    /// How it is read.
    pub filter: Filter,
    /// What is drawn for the points of clouds.
    pub points: Points,
    /// How casters are cut for paraboloids.
    pub cut: Cutting,
    /// What is added to depth; `None` for what the map says that the filter needs, see [`Layout::bias`].
    pub bias: Option<Bias>,
    /// How often it is drawn and read, for the median of the times.
    pub frames: u32,
}

impl Options {
    /// An unwarped or warped map for wgpu's clip space, 24 bits deep, its nearest texel read, drawn once.
    #[must_use]
    pub fn new(technique: Technique, map_size: u32) -> Self {
        Self {
            technique,
            map_size,
            slicing: None,
            clip: ClipArg::Wgpu,
            format: DepthFormat::Unorm24,
            faces: Faces::All,
            filter: Filter::Nearest,
            points: Points::default(),
            cut: Cutting::default(),
            bias: None,
            frames: 1,
        }
    }

    /// The technique and the size of its maps in words.
    #[must_use]
    pub fn name(&self) -> String {
        let times = self.slicing.map_or_else(String::new, |slicing| format!("{} x ", slicing.count));
        format!("{} {times}{}", self.technique, self.map_size)
    }

    /// How a map is drawn: without a bias for second depth, layers and virtual samples, which do without.
    ///
    /// # Errors
    ///
    /// When the filter reaches nowhere.
    pub fn pass(&self, map: &Layout) -> Result<MapPass> {
        let (bias, (receiver, relative)) = match (self.bias, self.faces, self.filter) {
            (Some(bias), ..) => (bias, (0.0, 0.0)),
            (None, Faces::Second | Faces::Layers, _) | (None, _, Filter::Virtual(_)) => (Bias::NONE, (0.0, 0.0)),
            _ => {
                let enough = map.bias(self.format, self.filter.reach())?;
                (Bias::away(&enough), (enough.receiver, enough.relative))
            }
        };
        Ok(MapPass { format: self.format, faces: self.faces, bias, receiver, relative, points: self.points })
    }

    /// As many texels around what is visible as the filter reaches.
    #[must_use]
    pub fn border(&self) -> u32 {
        self.filter.reach().ceil() as u32
    }

    /// How a map is fitted.
    ///
    /// # Errors
    ///
    /// When the sizes cannot be used, or the border leaves no room.
    pub fn settings(&self, stage: &Stage<'_>) -> Result<Settings> {
        let settings = Settings::new(self.map_size, stage.size[1]).context("the sizes cannot be used")?;
        let settings = settings.with_border(self.border()).context("the filter is too wide for so small a map")?;
        Ok(self.technique.settings(settings).with_clip(self.clip.into()).with_origin(stage.origin))
    }
}

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
        fitted.maps.iter().map(|map| map.as_ref().map(|map| map.map.projection())).collect();
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
