//! Bodies in the report: a table and a plot for each set, and what they say in words.

use super::Set;
use super::bodies::{Arithmetic, BodyRecord, MUCH};
use super::words::{microseconds, percent, spread};
use crate::chapter::{Axis, Figure, Part, Plot, Point, Series, Table};

/// The order of tables, from the least exact on.
const ORDER: [Arithmetic; 6] = [
    Arithmetic::F32,
    Arithmetic::F32Grown,
    Arithmetic::F64,
    Arithmetic::F64Grown,
    Arithmetic::Certified,
    Arithmetic::Exact,
];

/// The records of one set in the order of tables.
fn ordered(records: &[BodyRecord], set: Set) -> Vec<&BodyRecord> {
    let of = |arithmetic| records.iter().find(|record| record.set == set && record.arithmetic == arithmetic);
    ORDER.into_iter().filter_map(of).collect()
}

/// A table and a plot of a set.
pub(super) fn parts(records: &[BodyRecord], set: Set) -> Vec<Part> {
    let records = ordered(records, set);
    vec![Part::Plot(plot(&records, set)), Part::Table(table(&records, set))]
}

fn table(records: &[&BodyRecord], set: Set) -> Table {
    let columns = [
        "H in",
        "µs a body",
        "over the crate's time (10–90 %)",
        "loses anything",
        "loses more than 10⁻⁶",
        "empty, and should not be",
        "lost, median where any is",
        "lost, worst",
        "gained, median",
        "gained, 99 %",
        "gained, worst",
        "no body",
    ];
    let line = |record: &&BodyRecord| {
        vec![
            record.arithmetic.name().to_owned(),
            microseconds(record.time.seconds),
            spread(record.time.ratio, record.time.ratio_low, record.time.ratio_high),
            percent(record.lost_share),
            percent(record.lost_much_share),
            percent(record.emptied_share),
            Figure(record.lost_median).to_string(),
            Figure(record.lost_worst).to_string(),
            Figure(record.gained_median).to_string(),
            Figure(record.gained_99).to_string(),
            Figure(record.gained_worst).to_string(),
            record.failures.to_string(),
        ]
    };
    let cases = records.first().map_or(0, |record| record.cases);
    let timed = records.iter().find(|record| record.arithmetic == Arithmetic::Exact);
    let timed = timed.map_or(0, |record| record.time.timed_cases);
    Table {
        caption: format!(
            "**The paper's H, {} cases.** All {cases} are counted in every line. Lost: how far vertices of the \
             exact body lie outside of the hull of the computed ones, whether anything does decided exactly; a \
             body that is empty and should not be has lost 1, which is all. Gained: how far computed vertices are \
             from the exact body. Both in parts of the scene's diagonal. Of the rationals, which are the oracle's \
             body in every case, {timed} cases were timed.",
            set.name()
        ),
        columns: columns.map(str::to_owned).into(),
        lines: records.iter().map(line).collect(),
    }
}

fn plot(records: &[&BodyRecord], set: Set) -> Plot {
    let series = |record: &&BodyRecord| Series {
        name: record.arithmetic.name().to_owned(),
        points: vec![Point { x: 1e6 * record.time.seconds, y: record.lost_worst, label: None }],
        joined: false,
    };
    Plot {
        name: format!("arithmetic-body-{}", set.name()),
        title: format!("The same H, {} cases: the most that is lost, over time", set.name()),
        caption:
            "The most that any case loses of the exact body, over the time of one body. What loses nothing at all \
                  is drawn at the lower edge. Which half-spaces cut, and in which order, is the same for all."
                .to_owned(),
        x: Axis::logarithmic("time of a body, µs"),
        y: Axis::logarithmic("most that is lost, in parts of the scene"),
        series: records.iter().map(series).collect(),
        front: true,
    }
}

/// What the figures of a set say.
pub(super) fn findings(records: &[BodyRecord], set: Set) -> Vec<String> {
    let of = |arithmetic| records.iter().find(|record| record.set == set && record.arithmetic == arithmetic);
    let all = (
        of(Arithmetic::F32),
        of(Arithmetic::F64),
        of(Arithmetic::F64Grown),
        of(Arithmetic::Certified),
        of(Arithmetic::Exact),
    );
    let (Some(single), Some(double), Some(grown), Some(certified), Some(exact)) = all else { return Vec::new() };
    let loses = |record: &BodyRecord| format!("in {}", some(record.lost_share));
    vec![
        format!(
            "On {} {} cases f32 loses part of H {}, f64 {}, the crate {}. The most that is lost is {}, {} and {} \
             of the scene's size.",
            single.cases,
            set.name(),
            loses(single),
            loses(double),
            loses(certified),
            Figure(single.lost_worst),
            Figure(double.lost_worst),
            Figure(certified.lost_worst),
        ),
        time(set, double, grown, certified, exact),
        enough(set, double, certified),
        growth(set, grown),
    ]
}

fn time(set: Set, double: &BodyRecord, grown: &BodyRecord, certified: &BodyRecord, exact: &BodyRecord) -> String {
    let growth = match grown.time.ratio / double.time.ratio {
        ratio if ratio > 1.05 => format!("makes it take {} times as long", Figure(ratio)),
        _ => "costs it no time that can be told".to_owned(),
    };
    format!(
        "A body of the {} cases takes the crate {} µs; plain f64, whose polyhedron is made of lists, takes {} \
         times as long, and moving its planes outwards {growth}. Exact rationals take {} times as long as the \
         crate.",
        set.name(),
        microseconds(certified.time.seconds),
        Figure(double.time.ratio),
        Figure(exact.time.ratio),
    )
}

/// Whether plain f64 would do.
fn enough(set: Set, double: &BodyRecord, certified: &BodyRecord) -> String {
    let gained = format!(
        "What the crate gains for that is {} of the scene in the median, {} or less in 99 % and {} at worst.",
        Figure(certified.gained_median),
        Figure(certified.gained_99),
        Figure(certified.gained_worst),
    );
    if double.lost_worst <= MUCH && double.failures == 0 {
        return format!(
            "On the {} cases plain f64 is nearly as good as the crate: what it loses is never more than {} of the \
             scene. {gained}",
            set.name(),
            Figure(double.lost_worst),
        );
    }
    format!(
        "On the {} cases plain f64 is not enough: it loses more than a millionth of the scene in {} of them, and \
         finds H empty that is not in {}. {gained}",
        set.name(),
        some(double.lost_much_share),
        some(double.emptied_share),
    )
}

/// What is left to do for exact signs where f64 has its planes moved outwards.
fn growth(set: Set, grown: &BodyRecord) -> String {
    if grown.lost_share == 0.0 && grown.failures == 0 {
        return format!(
            "On none of the {} cases are the crate's exact signs needed: f64 whose planes are moved outwards by \
             96 ε loses nothing either. Growth is what does it; exact signs make it certain.",
            set.name()
        );
    }
    format!(
        "Planes that are moved outwards by 96 ε do not do it alone: with f64's own signs {} of the {} cases lose \
         something, {} at worst. What the crate has beside them is exact signs at the light.",
        percent(grown.lost_share),
        set.name(),
        Figure(grown.lost_worst),
    )
}

/// A share in a sentence.
fn some(share: f64) -> String {
    if share > 0.0 { percent(share) } else { "none".to_owned() }
}
