//! What is written down of each contender before each scene and light.

use std::fmt;

use render_check::gpu::Filter;
use render_check::maps::{ClipConvention, Technique};
use render_check::run::Options;
use render_check::trace::Faces;
use serde::Serialize;
use shadowfit::DepthFormat;

/// A way to fit, draw and read a light's maps.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Contender {
    /// How texels are spread.
    pub technique: Technique,
    /// How many cascades the view is cut into; one where it is not.
    pub cascades: usize,
    /// Texels along each side of each map.
    pub size: u32,
    /// The depth buffer's format.
    pub format: &'static str,
    /// Whose clip space the matrix is for.
    pub clip: ClipConvention,
    /// Which sides of triangles are drawn.
    pub faces: Faces,
    /// How the map is read.
    pub filter: Filter,
    /// Whether depths have the bias that the crate derives, in the tests that need one.
    pub biased: bool,
}

impl From<&Options> for Contender {
    fn from(options: &Options) -> Self {
        Self {
            technique: options.technique,
            cascades: options.cascading.map_or(1, |cascading| cascading.count),
            size: options.map_size,
            format: format_name(options.format),
            clip: options.clip,
            faces: options.faces,
            filter: options.filter,
            biased: options.bias.is_none(),
        }
    }
}

/// What figures call a depth buffer's format.
#[must_use]
pub const fn format_name(format: DepthFormat) -> &'static str {
    match format {
        DepthFormat::Unorm8 => "unorm8",
        DepthFormat::Unorm16 => "unorm16",
        DepthFormat::Unorm24 => "unorm24",
        DepthFormat::Float32 => "float32",
    }
}

/// A contender before one scene under one light. Times are medians over all rounds.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Record {
    /// The adapter that drew it.
    pub adapter: String,
    /// What is compared with it.
    pub comparison: &'static str,
    /// The scene.
    pub scene: &'static str,
    /// The light, as `render-check` spells it.
    pub light: &'static str,
    /// Whether maps were fitted to the depths that something is seen in, not to all between the camera's planes.
    pub narrowed: bool,
    /// How it was fitted, drawn and read.
    #[serde(flatten)]
    pub contender: Contender,
    /// Maps that were drawn.
    pub passes: usize,
    /// Texels of all of them.
    pub texels: u64,
    /// Triangles drawn into all of them.
    pub triangles: usize,
    /// Pixels held against rays.
    pub compared: usize,
    /// Those that are wrong.
    pub wrong: usize,
    /// Those that are dark, and ought to be lit, without an edge nearby.
    pub false_shadow: usize,
    /// Those that are lit, and ought to be dark, without an edge nearby.
    pub false_light: usize,
    /// Those next to the edge of a true shadow.
    pub edge: usize,
    /// Those that are lit because the map does not hold a caster.
    pub missing: usize,
    /// The wrong ones as a part of those compared.
    pub wrong_share: f64,
    /// The wrong ones over those of the first contender, one added to both.
    pub wrong_ratio: f64,
    /// Texel over pixel, the largest of all that is seen.
    pub aliasing_worst: f64,
    /// The one that half of what is seen has no more than.
    pub aliasing_median: f64,
    /// The largest of all that may be visible, as the fit predicts it; nothing for paraboloids.
    pub predicted: Option<f64>,
    /// What that could be at least with as many texels, however they were spread.
    pub limit: f64,
    /// The fit of all maps, on the processor.
    pub fit_us: f64,
    /// The maps' passes, by the card's clock.
    pub map_ms: f64,
    /// The shadow test, by the card's clock.
    pub test_ms: f64,
    /// All three.
    pub frame_ms: f64,
    /// That over the first contender's in the same round.
    pub time_ratio: f64,
    /// A tenth of the rounds have a smaller ratio.
    pub time_ratio_low: f64,
    /// A tenth of the rounds have a larger one.
    pub time_ratio_high: f64,
}

impl Record {
    /// Wrong pixels that no edge explains, as a part of those compared.
    #[must_use]
    pub fn false_share(&self) -> f64 {
        (self.false_shadow + self.false_light) as f64 / self.compared as f64
    }
}

/// A contender that has no map before one scene under one light.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Refused {
    /// What is compared.
    pub comparison: &'static str,
    /// The scene.
    pub scene: &'static str,
    /// The light.
    pub light: &'static str,
    /// Whether maps are fitted to the depths that something is seen in.
    pub narrowed: bool,
    /// How it was to be fitted.
    #[serde(flatten)]
    pub contender: Contender,
    /// The crate's own words.
    pub why: String,
}

/// How texels are spread, and over how many cascades.
impl fmt::Display for Contender {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { technique, cascades, .. } = self;
        if *cascades == 1 { write!(f, "{technique}") } else { write!(f, "{technique} × {cascades}") }
    }
}
