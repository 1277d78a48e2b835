//! What to compare.

use std::path::PathBuf;

use clap::builder::RangedU64ValueParser;

/// What is told after the options.
pub(crate) const HELP: &str = "\
Each line is one light of a built-in scene, once with an effect and once without. The plan asks for the effect or leaves
it out. Where it leaves it out, no more than 0.2 % of the pixels compared may be lost; where it asks for it, there must
be 1.1 times as many wrong pixels without it, or texels as much larger, or as much more work. Else the command fails.

The table (with / without):
  wrong       all wrong pixels, those at edges too, in percent of what is compared
  false       those of them that no edge explains, missing ones too
  aliasing    the longer side of a texel over that of a pixel, that 95 of 100 pixels do not exceed
  passes, Mtexels, triangles
  map, test   times of the card's passes in milliseconds, medians over --frames

Written to --out: ablation.json.";

/// What to compare.
#[derive(Clone, Debug, clap::Args)]
pub struct AblationArgs {
    /// Only effects whose name contains this; may be given several times
    #[arg(value_name = "EFFECT")]
    pub effects: Vec<String>,

    /// The directory for ablation.json, made where it is missing
    #[arg(long, value_name = "DIR", default_value = "out/ablation")]
    pub out: PathBuf,

    /// Width of the camera's image, in pixels; it is five eighths as high
    #[arg(long, value_name = "PIXELS", default_value_t = 480, value_parser = RangedU64ValueParser::<u32>::new().range(32..=8192))]
    pub width: u32,

    /// How often each map is drawn and read, for the median of the times
    #[arg(long, default_value_t = 5, value_parser = RangedU64ValueParser::<u32>::new().range(1..=1000))]
    pub frames: u32,
}
