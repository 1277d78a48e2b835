//! Options for shadow maps.

use clap::ValueEnum;
use clap::builder::RangedU64ValueParser;
use shadowfit::{DepthFormat, cascades::Cascades};

use super::values::parse_bias;
use crate::gpu::{Bias, Filter, Points};
use crate::maps::{Cascading, ClipConvention, SplitArg, Technique};
use crate::run::{Cutting, Options};
use crate::trace::Faces;

/// How maps are fitted, drawn and filtered.
#[derive(Clone, Debug, clap::Args)]
pub struct MapArgs {
    /// A warp, or another parameterization of the map; may be given several times [default: uniform, psm,
    /// light-space, best]
    #[arg(long = "technique", value_name = "TECHNIQUE", value_enum)]
    pub techniques: Vec<Technique>,

    /// Map resolution: texels per side; may be given several times [default: 1024]
    #[arg(long = "size", value_name = "TEXELS", value_parser = RangedU64ValueParser::<u32>::new().range(16..=16384))]
    pub sizes: Vec<u32>,

    /// Number of cascades, one map each; may be given several times. Stable maps split the range between the
    /// camera's near and far planes, others the depth range of the receivers
    #[arg(long, value_name = "COUNT", value_parser = RangedU64ValueParser::<u32>::new().range(1..=Cascades::MAX as u64))]
    pub cascades: Vec<u32>,

    /// Split scheme of the cascades: uniform, log, or practical:PART, where PART is the weight of the logarithmic
    /// splits, 0 to 1
    #[arg(long, value_name = "SPLIT", default_value_t, requires = "cascades")]
    pub split: SplitArg,

    /// Depth format
    #[arg(long, value_enum, default_value_t = FormatArg::Unorm24)]
    pub format: FormatArg,

    /// Which faces are drawn into the map, as seen from the light; second draws the back faces of solids and both
    /// faces of open sheets (second-depth mapping), layers the first two surfaces and tests against the midpoint;
    /// both do without a bias
    #[arg(long, value_enum, default_value_t = Faces::All)]
    pub faces: Faces,

    /// How points of a cloud are drawn into the map
    #[arg(long, value_enum, default_value_t = Points::Discs)]
    pub points: Points,

    /// The filter: nearest, hardware (2 x 2 bilinear PCF), pcfN (PCF over N x N texels), or virtualN (N x N virtual
    /// samples, which compare with the receiver's plane and need no bias on planes)
    #[arg(long, value_name = "FILTER", default_value_t = Filter::Nearest)]
    pub filter: Filter,

    /// How casters are tessellated for paraboloid maps, which bend straight edges
    #[arg(long, value_enum, default_value_t = Cutting::Bound)]
    pub cut: Cutting,

    /// The clip space of the matrix; for APIs other than wgpu their viewport transform is emulated
    #[arg(long, value_enum, default_value_t = ClipConvention::Wgpu)]
    pub clip: ClipConvention,

    /// Depth bias: constant in steps of the depth format, and slope scale [default: the smallest that the filter
    /// needs against acne]
    #[arg(long, value_name = "STEPS,SLOPE", value_parser = parse_bias, allow_hyphen_values = true)]
    pub bias: Option<Bias>,
}

impl MapArgs {
    /// One set of options for each map that the arguments ask for, with this number of frames.
    #[must_use]
    pub fn options(&self, frames: u32) -> Vec<Options> {
        let techniques = Technique::or_compared(&self.techniques);
        let sizes = if self.sizes.is_empty() { &[1024][..] } else { &self.sizes };
        let cascading = |&count: &u32| Some(Cascading { count: count as usize, split: self.split });
        let cascadings =
            if self.cascades.is_empty() { vec![None] } else { self.cascades.iter().map(cascading).collect() };
        let of = |map_size: u32, cascading: Option<Cascading>, technique: Technique| Options {
            cascading,
            clip: self.clip,
            format: self.format.into(),
            faces: self.faces,
            filter: self.filter,
            points: self.points,
            cut: self.cut,
            bias: self.bias,
            frames,
            ..Options::new(technique, map_size)
        };
        let mut all = Vec::new();
        for &size in sizes {
            for &cascading in &cascadings {
                all.extend(techniques.iter().map(|&technique| of(size, cascading, technique)));
            }
        }
        all
    }
}

/// A depth format, by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum FormatArg {
    /// 16 bits, fixed point
    Unorm16,
    /// 24 bits, fixed point
    Unorm24,
    /// 32 bits, floating point
    Float32,
}

impl From<FormatArg> for DepthFormat {
    fn from(format: FormatArg) -> Self {
        match format {
            FormatArg::Unorm16 => Self::Unorm16,
            FormatArg::Unorm24 => Self::Unorm24,
            FormatArg::Float32 => Self::Float32,
        }
    }
}
