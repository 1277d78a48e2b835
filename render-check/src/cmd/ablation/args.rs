//! Options of `ablation`.

use std::path::PathBuf;

use clap::builder::RangedU64ValueParser;

/// The help text after the options.
pub(crate) const HELP: &str = "\
Each row is one light of a built-in scene, drawn with an effect and without it. Where the plan does without the effect,
that may cost at most 0.2 % of the compared pixels. Where the plan uses it, leaving it out must increase wrong pixels,
texel size or work by a factor of at least 1.1. Otherwise the command fails.

The table (with / without):
  wrong       all wrong pixels, those at edges included, in percent of the compared pixels
  false       those away from edges, missing casters included
  aliasing    95th percentile of the longest side of a texel over that of a pixel
  passes, Mtexels, triangles
  map, test   GPU times of the passes in milliseconds, medians over --frames

Written to --out: ablation.json.";

/// Options of `ablation`.
#[derive(Clone, Debug, clap::Args)]
pub struct AblationArgs {
    /// Only effects whose name contains this; may be given several times
    #[arg(value_name = "EFFECT")]
    pub effects: Vec<String>,

    /// Output directory for ablation.json, created where it is missing
    #[arg(long, value_name = "DIR", default_value = "out/ablation")]
    pub out: PathBuf,

    /// Width of the camera's image, in pixels; its height is 5/8 of that
    #[arg(long, value_name = "PIXELS", default_value_t = 480, value_parser = RangedU64ValueParser::<u32>::new().range(32..=8192))]
    pub width: u32,

    /// Frames drawn per map; times are medians over them
    #[arg(long, default_value_t = 5, value_parser = RangedU64ValueParser::<u32>::new().range(1..=1000))]
    pub frames: u32,
}
