//! The report's files: Markdown, plots, raw figures.

mod markdown;
mod raw;

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use anyhow::{Context, Result, ensure};
use render_check::output::make_directory;

use crate::chapter::{Chapter, Part, Plot, Raw};
use crate::machine::Machine;
use crate::plot::{png, svg};
use crate::size::Size;

/// A report.
#[derive(Clone, Debug)]
pub struct Report {
    /// What it ran on.
    pub machine: Machine,
    /// The command that made it.
    pub command: String,
    /// How much was measured.
    pub size: Size,
    /// What it says.
    pub chapters: Vec<Chapter>,
}

impl Report {
    fn plots(&self) -> impl Iterator<Item = &Plot> {
        self.chapters.iter().flat_map(|chapter| &chapter.parts).filter_map(|part| match part {
            Part::Plot(plot) => Some(plot),
            Part::Table(_) => None,
        })
    }

    fn raw(&self) -> impl Iterator<Item = &Raw> {
        self.chapters.iter().flat_map(|chapter| &chapter.raw)
    }
}

/// Writes a report into a directory, which is made where it is missing: `REPORT.md`, an SVG and a PNG for each plot, a CSV
/// for each list of raw figures, and all of those in `report.json`.
///
/// # Errors
///
/// When a file cannot be written, a name is taken twice, or a table or a list has gaps.
pub fn write(report: &Report, out: &Path) -> Result<()> {
    check_names(report)?;
    make_directory(out)?;
    let save = |name: &str, bytes: &[u8]| {
        let path = out.join(name);
        fs::write(&path, bytes).with_context(|| format!("cannot write '{}'", path.display()))
    };
    save("REPORT.md", markdown::document(report)?.as_bytes())?;
    for plot in report.plots() {
        save(&format!("{}.svg", plot.name), svg(plot).as_bytes())?;
        save(&format!("{}.png", plot.name), &png(plot)?)?;
    }
    for raw in report.raw() {
        let csv = raw::csv(raw).with_context(|| format!("the raw figures '{}'", raw.name))?;
        save(&format!("{}.csv", raw.name), &csv)?;
    }
    save("report.json", raw::json(report)?.as_bytes())
}

/// Files must have names of their own, which links can hold as they are.
fn check_names(report: &Report) -> Result<()> {
    let plots: Vec<&str> = report.plots().map(|plot| &*plot.name).collect();
    let raw: Vec<&str> = report.raw().map(|raw| &*raw.name).chain(["report"]).collect();
    for names in [plots, raw] {
        let mut taken = BTreeSet::new();
        for name in names {
            let is_plain = |letter: char| letter.is_ascii_lowercase() || letter.is_ascii_digit() || letter == '-';
            ensure!(
                !name.is_empty() && name.chars().all(is_plain),
                "'{name}' is no name for a file of the report: a-z, 0-9 and - only"
            );
            ensure!(taken.insert(name), "two files of the report are called '{name}'");
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests;
