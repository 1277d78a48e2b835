//! Matrices in the report: a table and a plot for each set, and what they say in words.

use super::Set;
use super::matrices::{Kind, MatrixRecord, Precision};
use super::words::{microseconds, percent, spread};
use crate::chapter::{Axis, Figure, Part, Plot, Point, Series, Table};

/// The order of tables, from the least exact on.
const ORDER: [Precision; 5] =
    [Precision::F32, Precision::Uploaded, Precision::F64, Precision::Ours, Precision::Big];

/// The records of one kind in one set in the order of tables.
fn ordered(records: &[MatrixRecord], set: Set, kind: Kind) -> Vec<&MatrixRecord> {
    let is =
        |record: &&MatrixRecord, precision| (record.set, record.kind, record.precision) == (set, kind, precision);
    ORDER.into_iter().filter_map(|precision| records.iter().find(|record| is(record, precision))).collect()
}

/// A table and a plot of a set.
pub(super) fn parts(records: &[MatrixRecord], set: Set) -> Vec<Part> {
    let mut parts = vec![Part::Plot(plot(&ordered(records, set, Kind::Perspective), set))];
    parts.extend(Kind::ALL.map(|kind| Part::Table(table(&ordered(records, set, kind), set, kind))));
    parts
}

fn table(records: &[&MatrixRecord], set: Set, kind: Kind) -> Table {
    let columns = [
        "matrix in",
        "µs a matrix",
        "over the crate's time (10–90 %)",
        "error, median",
        "error, worst",
        "not usable",
    ];
    let line = |record: &&MatrixRecord| {
        vec![
            record.precision.name().to_owned(),
            microseconds(record.time.seconds),
            spread(record.time.ratio, record.time.ratio_low, record.time.ratio_high),
            Figure(record.error_median).to_string(),
            Figure(record.error_worst).to_string(),
            percent(record.unusable_share),
        ]
    };
    let (cases, passed_over) = records.first().map_or((0, 0), |record| (record.cases, record.passed_over));
    let made = match kind {
        Kind::Uniform => "By hand: the crate's formulas for a sun, around points that are given.",
        Kind::Perspective => {
            "By hand: the textbook's construction for suns and lamps, which divides by the light's w. Of it some \
             matrices are not usable in 512 bits either: points lie behind a light that is beside the unit cube."
        }
    };
    Table {
        caption: format!(
            "**{} maps, {} cases.** {cases} matrices in every line. {made} Errors are after the division by w, in \
             parts of the clip volume, at the vertices of what is visible and points between, each construction \
             against itself in 512 bits; those of usable matrices. Not usable: not finite, or w ≤ 0 at a point \
             that is visible. The crate's time is that of a whole fit, what is visible, window and depth range \
             included; by hand it is the matrix alone. {passed_over} more cases of the set, of whatever light, were \
             passed over: there is no one map of them, or its depth range has no end.",
            capitalised(kind.name()),
            set.name(),
        ),
        columns: columns.map(str::to_owned).into(),
        lines: records.iter().map(line).collect(),
    }
}

fn capitalised(word: &str) -> String {
    let mut letters = word.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

fn plot(records: &[&MatrixRecord], set: Set) -> Plot {
    let series = |record: &&MatrixRecord| Series {
        name: record.precision.name().to_owned(),
        points: vec![Point { x: 1e6 * record.time.seconds, y: record.error_worst, label: None }],
        joined: false,
    };
    Plot {
        name: format!("arithmetic-matrix-{}", set.name()),
        title: format!("Perspective matrices, {} cases: the worst error, over time", set.name()),
        caption: "The worst error of any usable matrix over the time of one. 512 bits, which the others are held \
                  against, are drawn at the lower edge. How many are not usable is in the table. The crate's time is \
                  that of a whole fit, by hand it is the matrix alone."
            .to_owned(),
        x: Axis::logarithmic("time of a matrix, µs"),
        y: Axis::logarithmic("worst error, in parts of the clip volume"),
        series: records.iter().map(series).collect(),
        front: true,
    }
}

/// What the figures of a set say.
pub(super) fn findings(records: &[MatrixRecord], set: Set) -> Vec<String> {
    Kind::ALL.into_iter().filter_map(|kind| finding(&ordered(records, set, kind), set, kind)).collect()
}

fn finding(records: &[&MatrixRecord], set: Set, kind: Kind) -> Option<String> {
    let of = |precision| records.iter().find(|record| record.precision == precision);
    let [single, double, ours, uploaded, exact] =
        [Precision::F32, Precision::F64, Precision::Ours, Precision::Uploaded, Precision::Big].map(of);
    let (single, double, ours, uploaded, exact) = (single?, double?, ours?, uploaded?, exact?);
    let share = |record: &MatrixRecord| match record.unusable_share {
        0.0 => "none".to_owned(),
        share => percent(share),
    };
    let usable = if records.iter().all(|record| record.unusable_share == 0.0) {
        format!("All {} {} matrices of {} cases are usable in any arithmetic.", ours.cases, kind.name(), set.name())
    } else {
        format!(
            "Of {} {} matrices of {} cases are not usable: in f32 {}, in f64 {}, in 512 bits {}, of the crate's {}.",
            ours.cases,
            kind.name(),
            set.name(),
            share(single),
            share(double),
            share(exact),
            share(uploaded),
        )
    };
    Some(format!(
        "{usable} The worst errors of those that are: {} in f32, {} in f64, {} of the crate in f64 and {} as it \
         is uploaded.",
        Figure(single.error_worst),
        Figure(double.error_worst),
        Figure(ours.error_worst),
        Figure(uploaded.error_worst),
    ))
}
