//! One run: one light, fitted in one way, drawn on the card and held against the truth.

use std::ops::Range;
use std::time::Duration;

use anyhow::{Context, Result};
use serde::Serialize;
use shadowfit::{DepthFormat, Focus, Form, Light, Map, Origin, Settings, fit};

use crate::args::ClipArg;
use crate::fitting::{NoMap, map_or_reason, median_time};
use crate::gpu::{Bias, Filter, MapPass, Points, ShadowMap, Shadows, shadow_test};
use crate::scene::Mesh;
use crate::stage::{Stage, StageLight};
use crate::technique::Technique;
use crate::trace::Faces;
use crate::verdict::{self, Rendered, Verdict};

/// How a light's map is fitted, drawn and read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// How its texels are spread.
    pub technique: Technique,
    /// Texels along each side.
    pub map_size: u32,
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
    /// What is added to depth; `None` for what the filter needs, see [`enough_bias`].
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
            clip: ClipArg::Wgpu,
            format: DepthFormat::Unorm24,
            faces: Faces::All,
            filter: Filter::Nearest,
            points: Points::default(),
            bias: None,
            frames: 1,
        }
    }

    fn pass(&self, map: &Map) -> MapPass {
        let bias = self.bias.unwrap_or_else(|| enough_bias(self.format, self.filter, map.depth().rounding));
        MapPass { format: self.format, faces: self.faces, bias, points: self.points }
    }

    /// A border as wide as the filter reaches.
    fn settings(&self, image_height: u32) -> Result<Settings> {
        let settings = Settings::new(self.map_size, image_height).context("the sizes cannot be used")?;
        let border = self.filter.reach().ceil() as u32;
        let settings = settings.with_border(border).context("the filter is too wide for so small a map")?;
        Ok(self.technique.settings(settings).with_clip(self.clip.into()).with_origin(Origin::Eye))
    }
}

/// The bias with which a plane does not shadow itself.
///
/// A filter compares a point's depth with that of texels whose middles are up to [`Filter::reach`] away, across and
/// down; the hardware's slope is the greater of the two changes of depth a texel, so the plane's depth differs by at most
/// twice the reach times it. The rasteriser places vertices to a 256th of a texel and interpolates across small triangles
/// with that error, for which an eighth of a texel is added. The constant is for rounding: of the stored value, half a
/// step; and of the two depths compared in f32, as the map says.
#[must_use]
pub fn enough_bias(format: DepthFormat, filter: Filter, rounding: f64) -> Bias {
    let constant = (0.5 + 2.0 * rounding / Bias::steps(format).least).ceil() as i32;
    Bias { constant, slope: 2.0 * filter.reach() as f32 + 0.125 }
}

/// What culling against H left to draw.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Drawn {
    /// Objects drawn.
    pub objects: usize,
    /// Objects there are.
    pub of_objects: usize,
    /// Triangles drawn.
    pub triangles: usize,
    /// Triangles there are.
    pub of_triangles: usize,
}

/// A map, and the casters that belong in it.
pub struct FittedMap {
    map: Map,
    pass: MapPass,
    /// The triangles of the objects that meet H.
    casters: Vec<Range<u32>>,
}

impl FittedMap {
    /// Fits a map as a renderer does and culls the casters against H; or says why there is no map.
    ///
    /// # Errors
    ///
    /// When the settings cannot be used.
    pub fn new(stage: &Stage<'_>, light: &Light, options: &Options) -> Result<Result<Self, NoMap>> {
        let focus = Focus::new(&stage.fitted_view, light, &stage.bounds);
        let map = match map_or_reason(focus.fit(&options.settings(stage.size[1])?)) {
            Ok(map) => map,
            Err(none) => return Ok(Err(none)),
        };
        let body = focus.body(Form::Tight);
        let objects = &stage.tracer.mesh().objects;
        let meets = objects.iter().filter(|object| body.meets_box(object.min, object.max));
        let casters = meets.map(|object| object.triangles.clone()).collect();
        Ok(Ok(Self { map, pass: options.pass(&map), casters }))
    }

    /// Draws the casters.
    ///
    /// # Errors
    ///
    /// When the card refuses.
    pub fn draw(&self, stage: &Stage<'_>) -> Result<ShadowMap> {
        ShadowMap::draw(stage.gpu, &stage.geometry, &self.casters, &self.map, &self.pass)
    }

    fn drawn(&self, mesh: &Mesh) -> Drawn {
        Drawn {
            objects: self.casters.len(),
            of_objects: mesh.objects.len(),
            triangles: self.casters.iter().map(Range::len).sum(),
            of_triangles: mesh.triangles.len(),
        }
    }
}

/// Median times.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Times {
    /// Of the fit, on the processor, in microseconds.
    pub fit_us: f64,
    /// Of the shadow map's pass, by the card's clock, in milliseconds; nothing where it has none.
    pub shadow_map_ms: Option<f64>,
    /// Of the camera's pass.
    pub camera_ms: Option<f64>,
    /// Of the shadow test.
    pub shadow_test_ms: Option<f64>,
}

/// What came of a run with a map.
pub struct MapRun {
    /// The map.
    pub map: Map,
    /// Its depths as stored, row by row from the top.
    pub depths: Vec<f32>,
    /// The share of light that reaches each pixel.
    pub lit: Vec<f32>,
    /// What was drawn.
    pub drawn: Drawn,
    /// What the bias was.
    pub pass: MapPass,
    /// How long it took.
    pub times: Times,
    /// How it compares with the truth.
    pub verdict: Verdict,
}

/// Runs one light through one technique; or says why there is no map.
///
/// # Errors
///
/// When the settings cannot be used or the card refuses.
pub fn run(stage: &Stage<'_>, light: &StageLight, options: &Options) -> Result<Result<MapRun, NoMap>> {
    let fitted = match FittedMap::new(stage, &light.light, options)? {
        Ok(fitted) => fitted,
        Err(none) => return Ok(Err(none)),
    };
    let FittedMap { map, pass, .. } = fitted;
    let frame = || -> Result<(ShadowMap, Shadows)> {
        let shadow_map = fitted.draw(stage)?;
        let shadows = shadow_test(stage.gpu, &stage.surfaces, &shadow_map, options.filter)?;
        Ok((shadow_map, shadows))
    };
    let (shadow_map, Shadows { lit, time }) = frame()?;
    let (mut shadow_map_times, mut shadow_test_times) = (vec![shadow_map.time], vec![time]);
    for _ in 1..options.frames {
        let (shadow_map, shadows) = frame()?;
        shadow_map_times.push(shadow_map.time);
        shadow_test_times.push(shadows.time);
    }
    let depths = shadow_map.depths(stage.gpu)?;
    // A fit takes a few hundred times less than a frame.
    let fits = 300 * options.frames as usize - 299;
    let fit_time = median_time(fits, || fit(&stage.fitted_view, &light.light, &stage.bounds, map.settings()));
    let rendered = Rendered {
        map: &map,
        lit: &lit,
        depths: &depths,
        faces: pass.faces,
        bias: verdict::Bias::most(&pass),
        depth_step: pass.format.step(1.0),
        reach: options.filter.reach(),
    };
    let verdict = verdict::judge(&light.truth, &rendered, stage.tracer)?;
    let times = Times {
        fit_us: fit_time.as_secs_f64() * 1e6,
        shadow_map_ms: median_ms(shadow_map_times),
        camera_ms: median_ms(vec![stage.surfaces.time]),
        shadow_test_ms: median_ms(shadow_test_times),
    };
    let drawn = fitted.drawn(stage.tracer.mesh());
    Ok(Ok(MapRun { map, depths, lit, drawn, pass, times, verdict }))
}

/// Nothing where the card has no clock.
fn median_ms(times: Vec<Option<Duration>>) -> Option<f64> {
    let mut times: Vec<Duration> = times.into_iter().flatten().collect();
    times.sort_unstable();
    times.get(times.len() / 2).map(|time| time.as_secs_f64() * 1e3)
}
