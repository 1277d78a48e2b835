//! A report made: part by part, then written.

use anyhow::{Context, Result};
use render_check::gpu::Gpu;
use render_check::output::{complain, make_directory, say};

use crate::args::Args;
use crate::machine::Machine;
use crate::write::{Report, write};

/// Makes the report that the arguments ask for.
///
/// # Errors
///
/// When a part cannot be made, or draws and there is no graphics card.
pub fn make(args: &Args) -> Result<Report> {
    let entries = args.entries();
    // First, so that a machine without a card says so before it has measured for minutes.
    let card = if entries.iter().any(|entry| entry.draws) { Some(Gpu::new()?.name().to_owned()) } else { None };
    let mut chapters = Vec::new();
    for (index, entry) in entries.iter().enumerate() {
        complain(&format!("{}/{}: {}", index + 1, entries.len(), entry.name));
        chapters.extend((entry.make)(args.size()).with_context(|| format!("the part '{}'", entry.name))?);
    }
    Ok(Report { machine: Machine::this(card), command: args.command_line(), size: args.size(), chapters })
}

/// Makes the report, writes it, and prints what was found first of all and where it is.
///
/// # Errors
///
/// When it cannot be made or written.
pub fn run(args: &Args) -> Result<()> {
    if cfg!(debug_assertions) && !args.smoke {
        complain("warning: the times will be those of a build for development; --release gives those that count");
    }
    // First, so that nobody measures for minutes what cannot be written.
    make_directory(&args.out)?;
    let report = make(args)?;
    write(&report, &args.out)?;
    for chapter in &report.chapters {
        if let Some(finding) = chapter.findings.first() {
            say(&format!("{}: {finding}", chapter.title));
        }
    }
    say(&format!("the report: {}", args.out.join("REPORT.md").display()));
    Ok(())
}
