//! Reports written to disk and read again.

use serde::{Deserialize, Serialize};

use serde_json::Value;

use super::*;
use crate::chapter::{Axis, Point, Series, Table};

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Record {
    way: String,
    time: f64,
    error: Option<f64>,
    count: u64,
}

fn records() -> Vec<Record> {
    let record = |way: &str, time, error, count| Record { way: way.to_owned(), time, error, count };
    vec![
        record("f32, \"fast\"", 0.1 + 0.2, Some(1e-300), u64::MAX),
        record("two\nlines | é", 1.0 / 3.0, None, 0),
        record("", 5e-324, Some(-0.0), 1),
    ]
}

fn plot(name: &str) -> Plot {
    Plot {
        name: name.to_owned(),
        title: "Error over time".to_owned(),
        caption: "The more the later.".to_owned(),
        x: Axis::logarithmic("time, s"),
        y: Axis::linear("error, %"),
        series: vec![Series {
            name: "f32".to_owned(),
            points: vec![Point { x: 1.0, y: 2.0, label: None }],
            joined: false,
        }],
        front: true,
    }
}

fn report() -> Report {
    let table = Table {
        caption: "Times.".to_owned(),
        columns: vec!["way".to_owned(), "time".to_owned()],
        lines: vec![vec!["f32".to_owned(), "1.5 s".to_owned()]],
    };
    let chapter = Chapter {
        title: "Made up".to_owned(),
        opening: "What is asked.".to_owned(),
        findings: vec!["The first of them.".to_owned(), "The second of them.".to_owned()],
        parts: vec![Part::Table(table), Part::Plot(plot("errors"))],
        raw: vec![Raw::new("records", &records()).expect("they are flat")],
    };
    Report {
        machine: Machine::this(None),
        command: "report made-up".to_owned(),
        size: Size::Full,
        chapters: vec![chapter],
    }
}

fn written(report: &Report) -> tempfile::TempDir {
    let out = tempfile::tempdir().expect("there is room");
    write(report, out.path()).expect("it is sound");
    out
}

fn read(out: &tempfile::TempDir, name: &str) -> String {
    fs::read_to_string(out.path().join(name)).expect(name)
}

#[test]
fn records_are_the_same_when_read_again() {
    let out = written(&report());
    let mut csv = csv::Reader::from_path(out.path().join("records.csv")).expect("it was written");
    let from_csv: Vec<Record> = csv.deserialize().collect::<Result<_, _>>().expect("they are records");
    assert_eq!(from_csv, records());
    let all: Value = serde_json::from_str(&read(&out, "report.json")).expect("it is JSON");
    let from_all: Vec<Record> = serde_json::from_value(all["raw"]["records"].clone()).expect("they are records");
    assert_eq!(from_all, records());
    assert_eq!(all["machine"]["threads"], report().machine.threads);
}

#[test]
fn everything_in_a_chapter_is_in_the_report() {
    let report = report();
    let out = written(&report);
    let text = read(&out, "REPORT.md");
    let parts = [
        "## Made up\n",
        "- [Made up](#made-up): The first of them.\n",
        "What is asked.",
        "- The second of them.\n",
        "Times.\n\n| way | time |\n| --- | ---: |\n| f32 | 1.5 s |\n",
        "![Error over time](errors.svg)\n\nThe more the later.\n",
        "Raw figures: [records](records.csv).",
        "`report made-up`",
        &report.machine.processor,
    ];
    for part in parts {
        assert!(text.contains(part), "{part} in\n{text}");
    }
    assert!(out.path().join("errors.png").exists());
}

#[test]
fn a_report_is_the_same_each_time() {
    let [a, b] = [written(&report()), written(&report())];
    for file in fs::read_dir(a.path()).expect("it is there") {
        let name = file.expect("it is there").file_name();
        let [a, b] = [&a, &b].map(|out| fs::read(out.path().join(&name)).expect("both have it"));
        assert_eq!(a, b, "{name:?}");
    }
}

#[test]
fn only_a_smoke_sized_report_says_that_it_means_nothing() {
    let warns = |size| read(&written(&Report { size, ..report() }), "REPORT.md").contains("mean nothing");
    assert!(warns(Size::Smoke) && !warns(Size::Full));
}

#[test]
fn files_have_names_of_their_own() {
    let refused = |change: fn(&mut Chapter)| {
        let mut report = report();
        change(&mut report.chapters[0]);
        let out = tempfile::tempdir().expect("there is room");
        let error = write(&report, out.path()).expect_err("the names are wrong");
        assert!(fs::read_dir(out.path()).expect("it is there").next().is_none(), "nothing is written");
        error.to_string()
    };
    assert!(refused(|chapter| chapter.parts.push(Part::Plot(plot("errors")))).contains("two files"));
    assert!(refused(|chapter| chapter.parts.push(Part::Plot(plot("../errors")))).contains("no name"));
    assert!(refused(|chapter| chapter.raw[0].name = "report".to_owned()).contains("two files"));
}

#[test]
fn records_of_two_kinds_are_refused() {
    let mut report = report();
    report.chapters[0].raw[0].records[1].remove("time");
    let out = tempfile::tempdir().expect("there is room");
    let error = format!("{:#}", write(&report, out.path()).expect_err("a field is missing"));
    assert!(error.contains("records") && error.contains("record 1"), "{error}");
}
