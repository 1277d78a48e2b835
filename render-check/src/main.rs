//! `render-check`: see the library's front page, or `render-check --help`.

use std::process::ExitCode;

use clap::Parser;
use render_check::args::{Args, Command};
use render_check::{ablation, check, draw, opening, plan, sweep, walk};

fn main() -> ExitCode {
    let args = Args::parse();
    let result = match &args.command {
        None => check::check(&args.check),
        Some(Command::Draw(args)) => draw::draw(args),
        Some(Command::Walk(args)) => walk::walk(args),
        Some(Command::Sweep(args)) => sweep::sweep(args),
        Some(Command::Plan(args)) => plan::plan(args),
        Some(Command::Ablation(args)) => ablation::ablation(args),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            opening::complain(&format!("error: {error:#}"));
            ExitCode::FAILURE
        }
    }
}
