//! The maps on the command line.

use clap::ValueEnum;
use clap::builder::RangedU64ValueParser;
use shadowfit::{DepthFormat, cascades::Cascades};

use super::values::parse_bias;
use crate::gpu::{Bias, Filter, Points};
use crate::maps::{ClipConvention, Slicing, SplitArg, Technique};
use crate::run::{Cutting, Options};
use crate::trace::Faces;

/// How maps are fitted, drawn and read.
#[derive(Clone, Debug, clap::Args)]
pub struct MapArgs {
    /// A way to spread the texels; may be given several times [default: uniform, psm, light-space, best]
    #[arg(long = "technique", value_name = "TECHNIQUE", value_enum)]
    pub techniques: Vec<Technique>,

    /// Texels along each side of a map; may be given several times [default: 1024]
    #[arg(long = "size", value_name = "TEXELS", value_parser = RangedU64ValueParser::<u32>::new().range(16..=16384))]
    pub sizes: Vec<u32>,

    /// Cut the view into so many slices in depth, each with a map of its own; may be given several times. Of stable maps
    /// between the camera's planes, of others between the depths of what may be seen
    #[arg(long, value_name = "COUNT", value_parser = RangedU64ValueParser::<u32>::new().range(1..=Cascades::MAX as u64))]
    pub slices: Vec<u32>,

    /// How depths are shared out among slices: uniform, log, or blended:PART with the logarithmic part
    #[arg(long, value_name = "SPLIT", default_value_t, requires = "slices")]
    pub split: SplitArg,

    /// Bits of depth
    #[arg(long, value_enum, default_value_t = FormatArg::Unorm24)]
    pub format: FormatArg,

    /// Which sides of triangles are drawn into the map, as the light sees them; second draws the far sides of solids and both
    /// sides of sheets, layers the first two surfaces, read halfway between them; neither is given a bias
    #[arg(long, value_enum, default_value_t = Faces::All)]
    pub faces: Faces,

    /// What is drawn into the map for a point of a cloud
    #[arg(long, value_enum, default_value_t = Points::Discs)]
    pub points: Points,

    /// How the map is read: nearest, hardware (2 x 2, blended), pcfN for the mean over N x N texels, or virtualN for the same
    /// with virtual samples, which need no bias on planes
    #[arg(long, value_name = "FILTER", default_value_t = Filter::Nearest)]
    pub filter: Filter,

    /// How casters are cut before they are drawn into paraboloids, which bend lines
    #[arg(long, value_enum, default_value_t = Cutting::Bound)]
    pub cut: Cutting,

    /// Whose clip space the matrix is for; what another API's driver does with it is imitated
    #[arg(long, value_enum, default_value_t = ClipConvention::Wgpu)]
    pub clip: ClipConvention,

    /// What is added to depth: steps of the format, and times the slope [default: what the filter needs]
    #[arg(long, value_name = "STEPS,SLOPE", value_parser = parse_bias, allow_hyphen_values = true)]
    pub bias: Option<Bias>,
}

impl MapArgs {
    /// The options of every map that is asked for, each drawn so many times.
    #[must_use]
    pub fn options(&self, frames: u32) -> Vec<Options> {
        let techniques = Technique::or_compared(&self.techniques);
        let sizes = if self.sizes.is_empty() { &[1024][..] } else { &self.sizes };
        let slicing = |&count: &u32| Some(Slicing { count: count as usize, split: self.split });
        let slicings = if self.slices.is_empty() { vec![None] } else { self.slices.iter().map(slicing).collect() };
        let of = |map_size: u32, slicing: Option<Slicing>, technique: Technique| Options {
            slicing,
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
            for &slicing in &slicings {
                all.extend(techniques.iter().map(|&technique| of(size, slicing, technique)));
            }
        }
        all
    }
}

/// A depth format, as a word.
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
