//! Runs: one light with one technique, fitted, culled, drawn, tested, judged and reported.

mod cut;
mod fitted_maps;
mod frames;
mod map_run;
mod options;
pub mod planned;
mod prediction;
mod report;
mod timing;

pub use cut::{Cut, Cutting};
pub use fitted_maps::{Drawn, FittedMap, FittedMaps};
pub use frames::{Frame, Frames};
pub use map_run::{MapRun, Times, run, run_fitted};
pub use options::Options;
pub use prediction::Prediction;
pub use report::{CameraReport, MapReport, MapsReport, RunReport, RunResult};
pub use timing::median_time;
