//! `render-check`: see the library's front page, or `render-check --help`.

use std::process::ExitCode;

use clap::Parser;
use render_check::{args::Args, check};

fn main() -> ExitCode {
    match check::run(&Args::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            check::complain(&format!("error: {error:#}"));
            ExitCode::FAILURE
        }
    }
}
