//! What the curves say, in sentences.

use super::cost::{Cost, Counted, Work};
use super::curve::Curve;
use super::words::{Exponent, Seconds, count};
use crate::chapter::Figure;

/// What costs no more than so many times as much, and no less, costs the same.
const SAME: f64 = 1.1;

/// An exponent no farther from 1 than this is called one.
const IN_PROPORTION: f64 = 0.05;

/// An exponent no farther from 0 than this is called none.
const NONE: f64 = 0.03;

/// All of them; of what was not measured, as by a card without a clock, nothing is said.
pub(super) fn findings(costs: &[Cost]) -> Vec<String> {
    let of = |counted, work| Curve::new(costs, counted, work);
    let several = |counted, works: &[Work]| works.iter().map(|&work| of(counted, work)).collect::<Option<Vec<_>>>();
    let fits = [Work::FitUniform, Work::FitLightSpace, Work::FitBest];
    let setup = [Work::FitUniform, Work::FitBest, Work::Body];
    let cascades = [Work::Cut, Work::CutAndFitUniform, Work::CutAndFitBest];
    let cull = (of(Counted::Casters, Work::CullInBulk), of(Counted::Casters, Work::CullOneByOne));
    let one = |counted, work| of(counted, work).map(|curve| grows(&curve));
    [
        several(Counted::Lights, &fits).map(|fits| lamps(&fits)),
        one(Counted::Lights, Work::Plan),
        cull.0.zip(cull.1).map(|(bulk, one)| culling(&bulk, &one)),
        one(Counted::Casters, Work::Sort),
        one(Counted::Casters, Work::Plan),
        one(Counted::Casters, Work::FitLists),
        several(Counted::Planes, &setup).map(|works| narrow(&works)),
        several(Counted::Cascades, &cascades).map(|works| narrow(&works)),
        several(Counted::Texels, &setup[..2]).map(|fits| map_size(&fits)),
        one(Counted::Texels, Work::MapPass),
        one(Counted::Texels, Work::ShadowTest),
        one(Counted::Triangles, Work::MapPass),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// How cost grows at such an exponent, as words.
fn words(exponent: f64) -> &'static str {
    if exponent.abs() <= NONE {
        "does not change with them"
    } else if exponent < 0.0 {
        "falls as they become more"
    } else if (exponent - 1.0).abs() <= IN_PROPORTION {
        "grows in proportion"
    } else if exponent < 1.0 {
        "grows more slowly than they do"
    } else {
        "grows faster than they do"
    }
}

/// Whether a lamp costs as much among many as alone.
fn lamps(fits: &[Curve<'_>]) -> String {
    let among_them = |fit: &Curve<'_>| fit.last().times / fit.range();
    let all = |are: fn(f64) -> bool| fits.iter().map(among_them).all(are);
    let costs = if all(|times| (1.0 / SAME..=SAME).contains(&times)) {
        "costs the same as alone"
    } else if all(|times| times > 1.0) {
        "costs more than alone"
    } else if all(|times| times < 1.0) {
        "costs less than alone"
    } else {
        "does not cost the same as alone"
    };
    let most = fits.first().map_or_else(String::new, |fit| count(fit.last()));
    let of = |fit: &Curve<'_>| {
        let (first, times) = (fit.first(), Figure(among_them(fit)));
        let alone = Seconds(first.seconds / first.count as f64);
        format!("{} {alone} alone, {times} times that among them (exponent {})", first.work, Exponent(fit.whole()))
    };
    format!("Among {most} a lamp {costs}: {}.", listed(fits.iter().map(of)))
}

/// Culling in bulk against culling one by one.
fn culling(bulk: &Curve<'_>, one: &Curve<'_>) -> String {
    let each = |curve: &Curve<'_>| curve.last().seconds / curve.last().count as f64;
    let (in_bulk, one_by_one) = (each(bulk), each(one));
    let better = if in_bulk < one_by_one {
        format!("{} times as fast", Figure(one_by_one / in_bulk))
    } else {
        format!("{} times as slow", Figure(in_bulk / one_by_one))
    };
    format!(
        "Culled in bulk, a box costs {}, among {}; one by one it costs {}: bulk is {better}. The exponents are {} and {}.",
        Seconds(in_bulk),
        count(bulk.last()),
        Seconds(one_by_one),
        Exponent(bulk.telling()),
        Exponent(one.telling())
    )
}

/// How one work grows, and what one more thing costs among the most.
fn grows(curve: &Curve<'_>) -> String {
    let (first, last) = (curve.first(), curve.last());
    let part = if curve.is_wide() { " over the upper half" } else { "" };
    let each = curve.each();
    let further = if curve.telling().abs() > NONE && each > 0.0 {
        format!(" One more costs {} among the most.", Seconds(each))
    } else {
        String::new()
    };
    format!(
        "Over {}, the time for {} {}: {} with {}, {} with {} (exponent {}{part}).{further}",
        first.counted,
        first.work,
        words(curve.telling()),
        Seconds(first.seconds),
        count(first),
        Seconds(last.seconds),
        count(last),
        Exponent(curve.telling())
    )
}

/// How several works grow over a few things.
fn narrow(curves: &[Curve<'_>]) -> String {
    let Some(one) = curves.first() else { return String::new() };
    let of = |curve: &Curve<'_>| {
        format!("{} {} (exponent {})", curve.first().work, Figure(curve.last().times), Exponent(curve.whole()))
    };
    let are_less = curves.iter().all(|curve| curve.last().times < curve.range());
    let range = Figure(one.range());
    let take = if are_less {
        format!("take less than {range} times as long")
    } else {
        "take so many times as long".into()
    };
    format!(
        "{} {} instead of {}, {range} times as many, {take}: {}.",
        count(one.last()),
        one.first().counted,
        count(one.first()),
        listed(curves.iter().map(of))
    )
}

/// Whether a fit asks for the size of the map.
fn map_size(fits: &[Curve<'_>]) -> String {
    let depends = if fits.iter().all(|fit| fit.whole().abs() <= NONE) { "does not depend" } else { "depends" };
    let of = |fit: &Curve<'_>| {
        let (first, last) = (fit.first(), fit.last());
        let [few, many] = [first, last].map(|cost| Seconds(cost.seconds));
        format!(
            "{} {few} for {} texels and {many} for {} (exponent {})",
            first.work,
            count(first),
            count(last),
            Exponent(fit.whole())
        )
    };
    format!("The time of a fit {depends} on the map's size: {}.", listed(fits.iter().map(of)))
}

/// Things one after another, with semicolons and an "and".
fn listed(things: impl Iterator<Item = String>) -> String {
    let things: Vec<String> = things.collect();
    match &things[..] {
        [] => String::new(),
        [one] => one.clone(),
        [others @ .., last] => format!("{}; and {last}", others.join("; ")),
    }
}
