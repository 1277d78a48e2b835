//! The rules that findings are made by, and the whole chapter in small.

use super::cost::{Counted, Work};
use super::curve::Curve;
use super::*;
use crate::chapter::Part;

/// What work that grows with an exponent costs, with 1, 10, 100 and 1000 things.
fn costs(work: Work, counted: Counted, exponent: f64) -> Vec<Cost> {
    let of = |count: u64| {
        let times = (count as f64).powf(exponent);
        Cost { work, counted, count, seconds: 1e-6 * times, times, times_low: times, times_high: times }
    };
    [1, 10, 100, 1_000].map(of).to_vec()
}

/// The findings of costs.
fn said(costs: &[Vec<Cost>]) -> Vec<String> {
    findings::findings(&costs.concat())
}

#[test]
fn lamps_are_said_to_cost_what_they_cost() {
    let fits = |exponents: [f64; 3]| {
        let works = [Work::FitUniform, Work::FitLightSpace, Work::FitBest];
        said(&[0, 1, 2].map(|index| costs(works[index], Counted::Lights, exponents[index])))
    };
    let begins = |exponents, words: &str| fits(exponents)[0].starts_with(words);
    let same = "Among 1000 a lamp costs the same as alone: uniform fit 1.00 µs alone, 1.00 times that among them";
    assert!(begins([1.0, 1.01, 0.99], same));
    assert!(begins([1.2, 1.1, 1.4], "Among 1000 a lamp costs more than alone"));
    assert!(begins([0.9, 0.8, 0.6], "Among 1000 a lamp costs less than alone"));
    assert!(begins([0.9, 1.0, 1.3], "Among 1000 a lamp does not cost the same as alone"));
    assert_eq!(fits([1.0; 3]).len(), 1, "nothing is said of what was not measured");
}

#[test]
fn growth_is_named_by_its_exponent() {
    let pass = |exponent| said(&[costs(Work::MapPass, Counted::Triangles, exponent)])[0].clone();
    for (exponent, words) in [
        (-0.5, "falls as they become more"),
        (0.01, "does not change with them"),
        (0.5, "grows more slowly than they do"),
        (1.0, "grows in proportion: 1.00 µs with 1, 1.00 ms with 1000 (exponent 1.00 over the upper half)"),
        (1.5, "grows faster than they do"),
    ] {
        assert!(pass(exponent).contains(words), "{exponent}: {}", pass(exponent));
    }
}

#[test]
fn a_fit_that_asks_for_the_maps_size_is_said_to() {
    let fits = |exponent| {
        let works = [Work::FitUniform, Work::FitBest];
        said(&works.map(|work| costs(work, Counted::Texels, exponent)))[0].clone()
    };
    assert!(fits(0.0).starts_with("The time of a fit does not depend on the map's size"), "{}", fits(0.0));
    assert!(fits(0.5).starts_with("The time of a fit depends on the map's size"), "{}", fits(0.5));
}

#[test]
fn the_faster_way_to_cull_is_named() {
    let cull = |bulk: f64| {
        let mut in_bulk = costs(Work::CullInBulk, Counted::Casters, 1.0);
        in_bulk.iter_mut().for_each(|cost| cost.seconds *= bulk);
        said(&[in_bulk, costs(Work::CullOneByOne, Counted::Casters, 1.0)])[0].clone()
    };
    assert!(cull(0.25).contains("bulk is 4.00 times as fast"), "{}", cull(0.25));
    assert!(cull(2.0).contains("bulk is 2.00 times as slow"), "{}", cull(2.0));
}

#[test]
fn software_drivers_are_named_as_such() -> Result<()> {
    let on_a_card = |is_software, costs| chapter(&Measured { card: "a card".into(), is_software, costs });
    let passes = || costs(Work::MapPass, Counted::Texels, 1.0);
    assert!(on_a_card(true, passes())?.opening.contains("on the processor"));
    assert!(!on_a_card(false, passes())?.opening.contains("on the processor"));
    let without_clock = on_a_card(false, Vec::new())?;
    assert!(without_clock.opening.contains("has no clock") && without_clock.findings.is_empty());
    Ok(())
}

#[test]
fn everything_is_measured_and_shown() -> Result<()> {
    let measured = measure(Size::Smoke)?;
    let curves = Curve::all(&measured.costs);
    let on_card = curves.iter().filter(|curve| curve.first().work.is_on_card()).count();
    assert!(on_card == 0 || on_card == 3, "{on_card} curves are the card's");
    assert_eq!(curves.len() - on_card, 17);
    for cost in &measured.costs {
        assert!(cost.seconds > 0.0 && cost.times_low <= cost.times && cost.times <= cost.times_high, "{cost:?}");
    }
    let chapter = chapter(&measured)?;
    assert_eq!(chapter.raw[0].records.len(), measured.costs.len());
    assert_eq!(chapter.findings.len(), 9 + on_card);
    // Each curve is a line of the table, and a series of one plot.
    let (mut lines, mut series) = (0, 0);
    for part in &chapter.parts {
        match part {
            Part::Table(table) => {
                assert!(table.lines.iter().all(|line| line.len() == table.columns.len()));
                lines += table.lines.len();
            }
            Part::Plot(plot) => {
                series += plot.series.iter().filter(|series| series.name != "in proportion").count()
            }
        }
    }
    assert_eq!((lines, series), (curves.len(), curves.len()));
    Ok(())
}
