//! The chapter: tables and plots of the curves.

use anyhow::Result;

use super::cost::{Cost, Counted};
use super::curve::Curve;
use super::words::{Exponent, Seconds, count};
use super::{Measured, findings};
use crate::chapter::{Axis, Chapter, Figure, Part, Plot, Point, Raw, Series, Table};

/// Makes the chapter.
///
/// # Errors
///
/// When the figures are no records.
pub fn chapter(measured: &Measured) -> Result<Chapter> {
    let curves = Curve::all(&measured.costs);
    let over = |counted: &[Counted]| -> Vec<&Curve<'_>> {
        curves.iter().filter(|curve| counted.contains(&curve.first().counted)).collect()
    };
    let mut parts = vec![
        Part::Table(table(&curves)),
        Part::Plot(absolute(
            "growth-lights",
            "Time over the number of lights",
            "Lamps that have a map each, fitted one after another, and street lamps all over the town, planned together. \
             A line that climbs a decade in each decade is a cost in proportion.",
            Counted::Lights,
            &over(&[Counted::Lights]),
        )),
        Part::Plot(absolute(
            "growth-casters",
            "Time over the number of casters",
            "Boxes all over the town: culled against H, sorted for the planner, planned for one sun, and as lists of casters and \
             receivers of a fit.",
            Counted::Casters,
            &over(&[Counted::Casters]),
        )),
        Part::Plot(relative(
            "growth-setup",
            "Time over planes of S and cascades, relative to the fewest",
            "Both axes relative to the first point: the planes of a box, and one cascade. The steeper, the more one more \
             costs.",
            &over(&[Counted::Planes, Counted::Cascades]),
        )),
    ];
    parts.push(Part::Plot(relative(
        "growth-texels",
        "Time over texels and triangles, relative to the fewest",
        "Both axes relative to the first point. The fits are on the processor; the map's pass and the shadow test are on \
         the card, by its own clock, where it has one.",
        &over(&[Counted::Texels, Counted::Triangles]),
    )));
    Ok(Chapter {
        title: "Growth".into(),
        opening: opening(measured),
        findings: findings::findings(&measured.costs),
        parts,
        raw: vec![Raw::new("growth", &measured.costs)?],
    })
}

fn opening(measured: &Measured) -> String {
    let card = &measured.card;
    let on_card = if !measured.costs.iter().any(|cost| cost.work.is_on_card()) {
        format!("The card, {card}, has no clock, and nothing is said of its passes.")
    } else if measured.is_software {
        format!(
            "What is said of the card is said of {card}, a driver that draws on the processor: a graphics card has other \
             times, and other exponents where it has room for more at once."
        )
    } else {
        format!("The card is {card}; its passes are timed by its own clock.")
    };
    format!(
        "How does cost grow with the number of lights, casters, planes of S, texels, triangles and cascades? Each kind of \
         work is timed in turn for each number of things, round after round, in one town and one view. Times are medians; \
         how many times as long is the median, over the rounds, of a time over that of the fewest things in the same \
         round. An exponent k says that twice as many things take 2ᵏ times as long: it is the slope of the line of least \
         squares through the logarithms. {on_card}"
    )
}

fn table(curves: &[Curve<'_>]) -> Table {
    let columns = ["work", "over", "fewest", "most", "with the fewest", "with the most"];
    let exponents = ["exponent", "upper half", "times as long", "a tenth to nine tenths of rounds"];
    let line = |curve: &Curve<'_>| {
        let (first, last) = (curve.first(), curve.last());
        vec![
            first.work.to_string(),
            first.counted.to_string(),
            count(first),
            count(last),
            Seconds(first.seconds).to_string(),
            Seconds(last.seconds).to_string(),
            Exponent(curve.whole()).to_string(),
            Exponent(curve.upper()).to_string(),
            Figure(last.times).to_string(),
            format!("{} to {}", Figure(last.times_low), Figure(last.times_high)),
        ]
    };
    Table {
        caption: "What grows, over what, and how. The exponent of the upper half leaves out the lower half of the points, \
                  where what is done once for all things counts most. The last two columns are of the most things over \
                  the fewest."
            .into(),
        columns: columns.iter().chain(&exponents).map(|&column| column.to_owned()).collect(),
        lines: curves.iter().map(line).collect(),
    }
}

/// A plot of times over numbers of things.
fn absolute(name: &str, title: &str, caption: &str, counted: Counted, curves: &[&Curve<'_>]) -> Plot {
    let point = |cost: &&Cost| (cost.count as f64, 1e3 * cost.seconds);
    let series = curves.iter().map(|curve| series(curve.first().work.to_string(), curve, point));
    plot(name, title, caption, [&counted.to_string(), "milliseconds"], series.collect())
}

/// A plot of how many times as long over how many times as many.
fn relative(name: &str, title: &str, caption: &str, curves: &[&Curve<'_>]) -> Plot {
    let widest = curves.iter().map(|curve| curve.range()).fold(1.0, f64::max);
    let end = |x| Point { x, y: x, label: None };
    let proportion = Series { name: "in proportion".into(), points: vec![end(1.0), end(widest)], joined: true };
    let series = curves.iter().map(|curve| {
        let first = curve.first();
        let point = |cost: &&Cost| (cost.count as f64 / first.count as f64, cost.times);
        series(format!("{}, over {}", first.work, first.counted), curve, point)
    });
    let series = series.chain([proportion]).collect();
    plot(name, title, caption, ["times as many", "times as long"], series)
}

fn series(name: String, curve: &Curve<'_>, point: impl Fn(&&Cost) -> (f64, f64)) -> Series {
    let points = curve.costs().iter().map(point).map(|(x, y)| Point { x, y, label: None });
    Series { name, points: points.collect(), joined: true }
}

fn plot(name: &str, title: &str, caption: &str, [x, y]: [&str; 2], series: Vec<Series>) -> Plot {
    let (x, y) = (Axis::logarithmic(x), Axis::logarithmic(y));
    Plot { name: name.into(), title: title.into(), caption: caption.into(), x, y, series, front: false }
}
