//! Options of `sweep`.

use std::path::PathBuf;

/// The help text after the options.
pub(crate) const HELP: &str = "\
Each case is a small image of a built-in scene, drawn with every technique and compared with ray-traced truth. The table
has a row for each group of cases, with its worst case; all results are written to --out as sweep.json. The command
fails if a caster is missing in any case, or if false light reaches farther behind a caster than the map's bias does.";

/// Options of `sweep`.
#[derive(Clone, Debug, clap::Args)]
pub struct SweepArgs {
    /// Only groups whose name contains this; may be given several times
    #[arg(value_name = "GROUP")]
    pub groups: Vec<String>,

    /// Instead of the groups: move a point light through every object of this scene, at the middle of its largest
    /// triangle
    #[arg(long, value_name = "SCENE", conflicts_with = "groups")]
    pub through: Option<PathBuf>,

    /// Output directory for sweep.json, created where it is missing
    #[arg(long, value_name = "DIR", default_value = "out/sweep")]
    pub out: PathBuf,
}
