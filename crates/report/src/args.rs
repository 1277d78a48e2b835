//! The command line.

use std::path::PathBuf;

use clap::Parser;
use clap::builder::PossibleValuesParser;

use crate::contents::{ENTRIES, Entry};
use crate::size::Size;

/// Measures what accuracy costs in time, and writes it down: a report in Markdown with plots, tables and raw figures.
#[derive(Clone, Debug, Parser)]
#[command(name = "report", version, max_term_width = 110)]
pub struct Args {
    /// Only these parts [default: all]
    #[arg(value_name = "PART", value_parser = PossibleValuesParser::new(ENTRIES.map(|entry| entry.name)))]
    pub parts: Vec<String>,

    /// Measure next to nothing, to see whether everything works: the figures mean nothing
    #[arg(long)]
    pub smoke: bool,

    /// The directory for the report, made where it is missing
    #[arg(long, value_name = "DIR", default_value = "out/report")]
    pub out: PathBuf,
}

impl Args {
    /// How much to measure.
    #[must_use]
    pub fn size(&self) -> Size {
        if self.smoke { Size::Smoke } else { Size::Full }
    }

    /// The parts to make, in the report's order.
    #[must_use]
    pub fn entries(&self) -> Vec<Entry> {
        let is_asked = |name: &str| self.parts.is_empty() || self.parts.iter().any(|asked| asked == name);
        ENTRIES.into_iter().filter(|entry| is_asked(entry.name)).collect()
    }

    /// The command that makes the same report, wherever it is written.
    #[must_use]
    pub fn command_line(&self) -> String {
        let profile = if cfg!(debug_assertions) { "" } else { "--release " };
        let features = if cfg!(feature = "bevy") { " --features bevy" } else { "" };
        let mut command = format!("cargo run {profile}-p report{features}");
        let options = self.parts.iter().map(String::as_str).chain(self.smoke.then_some("--smoke"));
        for (index, option) in options.enumerate() {
            command += if index == 0 { " -- " } else { " " };
            command += option;
        }
        command
    }
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::*;

    #[test]
    fn the_command_is_sound() {
        Args::command().debug_assert();
    }

    #[test]
    fn without_a_name_all_parts_are_made() {
        let args = Args::parse_from(["report"]);
        assert_eq!(args.entries().len(), ENTRIES.len());
        assert_eq!((args.size(), args.out.as_path()), (Size::Full, "out/report".as_ref()));
        assert!(
            args.command_line().ends_with("bevy") || args.command_line().ends_with("-p report"),
            "{}",
            args.command_line()
        );
    }

    #[test]
    fn named_parts_are_made_in_the_order_of_the_report() {
        let names = ENTRIES.map(|entry| entry.name);
        for (index, &name) in names.iter().enumerate() {
            let args = Args::parse_from(["report", name, names[0], "--smoke"]);
            let made: Vec<&str> = args.entries().iter().map(|entry| entry.name).collect();
            assert_eq!(made, if index == 0 { vec![name] } else { vec![names[0], name] });
            assert!(
                args.command_line().ends_with(&format!(" -- {name} {} --smoke", names[0])),
                "{}",
                args.command_line()
            );
        }
    }

    #[test]
    fn an_unknown_part_names_the_known_ones() {
        let error = Args::try_parse_from(["report", "philosophy"]).expect_err("there is no such part").to_string();
        assert!(error.contains("philosophy") && ENTRIES.iter().all(|entry| error.contains(entry.name)), "{error}");
    }
}
