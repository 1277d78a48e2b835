//! The report as Markdown.

use std::fmt::Write as _;

use anyhow::{Result, ensure};

use super::Report;
use crate::chapter::{Chapter, Part, Raw, Table};
use crate::size::Size;

/// The report's text.
pub(super) fn document(report: &Report) -> Result<String> {
    let mut text = String::from("# What accuracy costs in time\n\n");
    if report.size == Size::Smoke {
        text += "**The figures mean nothing: next to nothing was measured, to see whether everything works.**\n\n";
    }
    if report.machine.debug_assertions {
        text += "**The times are those of a build for development, with debug assertions.**\n\n";
    }
    writeln!(
        text,
        "Made by `{}` on: {}. All raw figures are in [report.json](report.json).\n",
        report.command, report.machine
    )?;
    for chapter in &report.chapters {
        let finding = chapter.findings.first().map(|finding| format!(": {finding}")).unwrap_or_default();
        writeln!(text, "- [{}](#{}){finding}", chapter.title, anchor(&chapter.title))?;
    }
    for chapter in &report.chapters {
        text += "\n";
        text += &written(chapter)?;
    }
    Ok(text)
}

/// A chapter's text.
fn written(chapter: &Chapter) -> Result<String> {
    let mut paragraphs = vec![format!("## {}", chapter.title), chapter.opening.trim().to_owned()];
    let findings: Vec<String> = chapter.findings.iter().map(|finding| format!("- {finding}")).collect();
    paragraphs.push(findings.join("\n"));
    for part in &chapter.parts {
        match part {
            Part::Table(table) => paragraphs.extend([table.caption.trim().to_owned(), table_lines(table)?]),
            Part::Plot(plot) => {
                paragraphs
                    .extend([format!("![{}]({}.svg)", plot.title, plot.name), plot.caption.trim().to_owned()]);
            }
        }
    }
    let link = |raw: &Raw| format!("[{0}]({0}.csv)", raw.name);
    let links: Vec<String> = chapter.raw.iter().map(link).collect();
    if !links.is_empty() {
        paragraphs.push(format!("Raw figures: {}.", links.join(", ")));
    }
    paragraphs.retain(|paragraph| !paragraph.is_empty());
    Ok(paragraphs.join("\n\n") + "\n")
}

/// A table as Markdown, columns of numbers at the right.
fn table_lines(table: &Table) -> Result<String> {
    let columns = table.columns.len();
    for line in &table.lines {
        ensure!(line.len() == columns, "{} cells in a line of the table '{}'", line.len(), table.caption);
    }
    let rule = (0..columns).map(|column| {
        let mut cells = table.lines.iter().map(|line| &*line[column]).filter(|cell| !cell.is_empty()).peekable();
        if cells.peek().is_some() && cells.all(is_number) { "---:" } else { "---" }.to_owned()
    });
    let cells = |line: &Vec<String>| line.iter().map(|cell| escaped(cell)).collect::<Vec<_>>();
    let mut lines = vec![cells(&table.columns), rule.collect()];
    lines.extend(table.lines.iter().map(cells));
    let lines: Vec<String> = lines.iter().map(|cells| format!("| {} |", cells.join(" | "))).collect();
    Ok(lines.join("\n"))
}

/// Whether a cell begins with a number.
fn is_number(cell: &str) -> bool {
    cell.trim_start_matches(['-', '−', '+', '×', '<', '≤', '~', ' '])
        .starts_with(|letter: char| letter.is_ascii_digit())
        || cell == "inf"
}

/// Words that stay in their cell.
fn escaped(cell: &str) -> String {
    cell.replace('|', "\\|").split_whitespace().collect::<Vec<_>>().join(" ")
}

/// What a heading is linked by.
fn anchor(title: &str) -> String {
    let is_kept = |letter: &char| letter.is_alphanumeric() || matches!(letter, ' ' | '-' | '_');
    title.chars().filter(is_kept).flat_map(char::to_lowercase).collect::<String>().replace(' ', "-")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(lines: &[[&str; 3]]) -> Table {
        let words = |words: &[&str]| words.iter().map(|&word| word.to_owned()).collect();
        Table {
            caption: "What | it costs".into(),
            columns: words(&["way", "time", "a|b"]),
            lines: lines.iter().map(|line| words(line)).collect(),
        }
    }

    /// The bars that divide cells.
    fn bars(line: &str) -> usize {
        line.replace("\\|", "").matches('|').count()
    }

    #[test]
    fn every_line_of_a_table_has_as_many_cells() {
        let lines =
            table_lines(&table(&[["f32", "1.5 µs", "|H|"], ["two\nlines", "-3", ""]])).expect("it is whole");
        assert_eq!(lines.lines().count(), 4);
        assert!(lines.lines().all(|line| bars(line) == 4), "{lines}");
        assert!(lines.contains("| --- | ---: | --- |") && lines.contains("| two lines |"), "{lines}");
    }

    #[test]
    fn tables_with_gaps_are_refused() {
        let mut gap = table(&[["f32", "1", "2"]]);
        gap.lines[0].pop();
        let error = table_lines(&gap).expect_err("a cell is missing").to_string();
        assert!(error.contains("2 cells") && error.contains(&gap.caption), "{error}");
    }

    #[test]
    fn headings_are_found_by_their_anchors() {
        assert_eq!(anchor("Arithmetic: what f32 costs"), "arithmetic-what-f32-costs");
    }
}
