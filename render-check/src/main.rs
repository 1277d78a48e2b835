//! `render-check`: see the library's front page, or `render-check --help`.

use std::process::ExitCode;

use clap::Parser;
use render_check::cmd::Args;
use render_check::output::complain;

fn main() -> ExitCode {
    match Args::parse().run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            complain(&format!("error: {error:#}"));
            ExitCode::FAILURE
        }
    }
}
