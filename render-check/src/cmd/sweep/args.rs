//! What to sweep.

use std::path::PathBuf;

/// What a sweep does.
pub(crate) const HELP: &str = "\
Each case is a small picture of a built-in scene, drawn with every technique and held against ray-traced truth. The
table has a line for each group of cases, with the worst that was found in it; --out gets all of it as sweep.json.
The command fails when a caster is missing anywhere.";

/// What to sweep.
#[derive(Clone, Debug, clap::Args)]
pub struct SweepArgs {
    /// Only groups whose name contains this; may be given several times
    #[arg(value_name = "GROUP")]
    pub groups: Vec<String>,

    /// Instead of the groups: a lamp that goes through every object of this scene, at the middle of its largest triangle
    #[arg(long, value_name = "SCENE", conflicts_with = "groups")]
    pub through: Option<PathBuf>,

    /// The directory for sweep.json, made where it is missing
    #[arg(long, value_name = "DIR", default_value = "out/sweep")]
    pub out: PathBuf,
}
