//! Options of `walk`.

use clap::builder::RangedU64ValueParser;

use crate::cli::values::{parse_angle, parse_finite_distance};
use crate::cli::{MapArgs, ViewArgs};

/// The help text after the options.
pub(crate) const HELP: &str = "\
What is counted: pixels of each step that change between light and shadow when the next step's map replaces this step's.
Only the camera has moved, so the truth is the same. Only points in both views count; points that move from one cascade
to another are also counted separately. A best map is fitted a second time warm-started from the previous step's map;
for it the number of jumps to another map is given, at which shadow edges jump too. Written to --out: walk.json.";

/// Options of `walk`.
#[derive(Clone, Debug, clap::Args)]
pub struct WalkArgs {
    /// Scene, camera and lights.
    #[command(flatten)]
    pub view: ViewArgs,

    /// The maps.
    #[command(flatten)]
    pub map: MapArgs,

    /// Number of steps
    #[arg(long, default_value_t = 24, value_parser = RangedU64ValueParser::<u32>::new().range(1..=10000))]
    pub steps: u32,

    /// Distance per step, in world units: this far ahead and half as far to the side [default: a hundredth of the
    /// distance to the surface in the middle of the image]
    #[arg(long, value_name = "DISTANCE", value_parser = parse_finite_distance)]
    pub pace: Option<f64>,

    /// Rotation per step, in degrees
    #[arg(long, value_name = "DEGREES", default_value_t = 0.25, value_parser = parse_angle, allow_hyphen_values = true)]
    pub turn: f64,
}
