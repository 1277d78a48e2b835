//! `report`: see the library's front page, or `report --help`.

use std::process::ExitCode;

use clap::Parser;
use render_check::output::complain;
use report::args::Args;
use report::run::run;

fn main() -> ExitCode {
    match run(&Args::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            complain(&format!("error: {error:#}"));
            ExitCode::FAILURE
        }
    }
}
