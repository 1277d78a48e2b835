//! The smallest report there is, of every chapter: each file that it links is there, and each plot has something in it.

use std::collections::BTreeSet;
use std::fs;

use clap::Parser;
use report::args::Args;
use report::chapter::Part;
use report::run::make;
use report::write::write;

/// What a text links, but for its own headings.
fn links(text: &str) -> BTreeSet<&str> {
    let links = text.split("](").skip(1).filter_map(|rest| rest.split_once(')')).map(|(link, _)| link);
    links.filter(|link| !link.starts_with('#') && !link.contains("://")).collect()
}

#[test]
fn every_chapter_is_whole() {
    let report = make(&Args::parse_from(["report", "--smoke"])).expect("every chapter can be made");
    assert_eq!(report.chapters.len(), 5);
    for chapter in &report.chapters {
        assert!(!chapter.findings.is_empty() && !chapter.raw.is_empty(), "{}", chapter.title);
        for part in &chapter.parts {
            match part {
                Part::Table(table) => assert!(!table.lines.is_empty(), "{}", table.caption),
                Part::Plot(plot) => {
                    let points = plot.series.iter().flat_map(|series| &series.points);
                    let shown = points.filter(|point| point.x.is_finite() && point.y.is_finite());
                    assert!(shown.count() > 0, "{}", plot.name);
                }
            }
        }
        assert!(chapter.raw.iter().all(|raw| !raw.records.is_empty()), "{}", chapter.title);
    }
    let out = tempfile::tempdir().expect("there is room");
    write(&report, out.path()).expect("the chapters are sound");

    let text = fs::read_to_string(out.path().join("REPORT.md")).expect("it was written");
    assert!(text.contains("mean nothing"));
    for link in links(&text) {
        let size = fs::metadata(out.path().join(link)).expect(link).len();
        assert!(size > 0, "{link}");
    }
    for chapter in &report.chapters {
        assert!(text.contains(&format!("\n## {}\n", chapter.title)));
    }
    assert!(links(&text).contains("report.json"));
}
