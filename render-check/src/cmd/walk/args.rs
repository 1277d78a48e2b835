//! Where to walk.

use clap::builder::RangedU64ValueParser;

use crate::cli::values::{parse_angle, parse_finite_distance};
use crate::cli::{MapArgs, ViewArgs};

/// What a walk counts.
pub(crate) const HELP: &str = "\
What is counted: pixels of each step that change between light and shadow when the map fitted for the next step takes
the place of this step's, though nothing moved but the camera, so that the truth is the same. Only points that both
cameras have in view count, and those apart that pass over a cut between slices and so to another map. A best map is also found from the one of the step before (warm), and then says when it left that
for another one, so that what is visible jumps about in the map. Written to --out: walk.json.";

/// Where to walk.
#[derive(Clone, Debug, clap::Args)]
pub struct WalkArgs {
    /// The camera, the scene, the lights.
    #[command(flatten)]
    pub view: ViewArgs,

    /// The maps.
    #[command(flatten)]
    pub map: MapArgs,

    /// Steps of the walk
    #[arg(long, default_value_t = 24, value_parser = RangedU64ValueParser::<u32>::new().range(1..=10000))]
    pub steps: u32,

    /// How far the camera goes in a step, ahead and half as far aside, in world units
    /// [default: a hundredth of the distance to what is in the middle of the picture]
    #[arg(long, value_name = "DISTANCE", value_parser = parse_finite_distance)]
    pub pace: Option<f64>,

    /// How far the camera turns in a step, in degrees
    #[arg(long, value_name = "DEGREES", default_value_t = 0.25, value_parser = parse_angle, allow_hyphen_values = true)]
    pub turn: f64,
}
