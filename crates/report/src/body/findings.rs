//! What was found, in sentences made from the figures.

use super::{LAMP, Measured, SPOT, SUN, Summary, library, naive, own};
use crate::chapter::{Figure, percent};

/// What was found.
pub(crate) fn findings(measured: &Measured) -> Vec<String> {
    let of = |light: &str, contender: &str| {
        measured.summaries.iter().find(|summary| summary.light == light && summary.contender == contender)
    };
    let sun = |contender: &str| of(SUN, contender);
    let mut found = Vec::new();
    if let (Some(one), Some(other)) = (sun(naive::BOX_TO_SCENE), sun(own::TIGHT)) {
        found.extend(windows(one, other));
    }
    found.extend(whole(measured));
    found.extend(near_planes(measured));
    for (one, other) in [(own::PAPER, own::PAPER_LISTS), (own::TIGHT, own::TIGHT_LISTS)] {
        if let (Some(one), Some(other)) = (sun(one), sun(other)) {
            found.extend(lists(one, other));
        }
    }
    if let (Some(one), Some(other)) = (sun(own::PAPER), sun(own::TIGHT)) {
        found.push(tightness(one, other));
    }
    for name in library::NAMES {
        if let (Some(one), Some(other)) = (sun(name), sun(own::PAPER)) {
            found.push(general(one, other));
        }
    }
    found.extend(hard(measured));
    for (light, contender) in [(SPOT, naive::WHOLE_CONE), (LAMP, own::PAPER)] {
        if let (Some(one), Some(other)) = (of(light, contender), of(light, own::TIGHT)) {
            found.push(local(one, other));
        }
    }
    found
}

/// Whether nothing was ever missing.
fn is_whole(summary: &Summary) -> bool {
    summary.failed == 0 && summary.missing_cases == 0.0 && summary.receivers_cut == 0.0
}

fn microseconds(summary: &Summary) -> String {
    format!("{} µs", Figure(summary.nanoseconds * 1e-3))
}

/// Names in a sentence.
fn listed(names: &[&str]) -> String {
    match names {
        [] => "none".to_owned(),
        [one] => (*one).to_owned(),
        [rest @ .., last] => format!("{} and {last}", rest.join("; ")),
    }
}

/// Who never loses anything under a sun, and who of them has the least window and draws the fewest casters.
fn whole(measured: &Measured) -> Option<String> {
    let whole: Vec<&Summary> =
        measured.summaries.iter().filter(|summary| summary.light == SUN && is_whole(summary)).collect();
    let names: Vec<&str> = whole.iter().map(|summary| summary.contender).collect();
    let least = whole.iter().filter(|summary| summary.over_least.is_some());
    let least =
        least.min_by(|a, b| a.over_least.unwrap_or_default().total_cmp(&b.over_least.unwrap_or_default()))?;
    let fewest = whole.iter().min_by(|a, b| a.drawn.total_cmp(&b.drawn))?;
    let quickest = whole.iter().min_by(|a, b| a.nanoseconds.total_cmp(&b.nanoseconds))?;
    Some(format!(
        "Under a sun no caster is missing and nothing visible is cut with: {}. Of these the quickest is {} with {}; the \
         least window has {} ({} times the least rectangle), and {} draws the fewest casters ({} where {} are needed).",
        listed(&names),
        quickest.contender,
        microseconds(quickest),
        least.contender,
        Figure(least.over_least?),
        fewest.contender,
        Figure(fewest.drawn),
        Figure(fewest.needed),
    ))
}

/// What a window costs that is fitted to the view alone.
fn windows(one: &Summary, other: &Summary) -> Option<String> {
    let (large, small) = (one.over_least?, other.over_least?);
    Some(format!(
        "Under a sun, {} takes {} and has a window of {} times the least, {} takes {} and has one of {} times: {} times the texels \
         for the same sharpness against {} more time.",
        one.contender,
        microseconds(one),
        Figure(large),
        other.contender,
        microseconds(other),
        Figure(small),
        Figure(large / small),
        microseconds_between(one, other),
    ))
}

fn microseconds_between(one: &Summary, other: &Summary) -> String {
    format!("{} µs", Figure((other.nanoseconds - one.nanoseconds) * 1e-3))
}

/// What is lost where the near plane stands at V.
fn near_planes(measured: &Measured) -> Option<String> {
    let find = |name: &str| measured.summaries.iter().find(|summary| summary.contender == name);
    let pairs = [(naive::BOX, naive::BOX_TO_SCENE), (naive::BALL, naive::BALL_TO_SCENE)];
    let sentences: Vec<String> = pairs
        .iter()
        .filter_map(|(closed, open)| {
            let (closed, open) = (find(closed)?, find(open)?);
            Some(format!(
                "{} lacks a caster in {} of the views, and in {} with its near plane at the scene's bounds",
                closed.contender,
                percent(closed.missing_cases),
                percent(open.missing_cases)
            ))
        })
        .collect();
    (!sentences.is_empty()).then(|| format!("Under a sun, {}.", sentences.join("; ")))
}

/// What lists of boxes give.
fn lists(one: &Summary, other: &Summary) -> Option<String> {
    let (before, after) = (one.over_least?, other.over_least?);
    let change = |before: f64, after: f64| {
        if after < 0.99 * before {
            format!("falls from {} to {}", Figure(before), Figure(after))
        } else {
            format!("stays at {}", Figure(after))
        }
    };
    Some(format!(
        "Under a sun, with lists instead of one box, the number of casters that {} draws {}, and its window over the least {}; reading \
         {} casters and the receivers takes {} more.",
        one.contender,
        change(one.drawn, other.drawn),
        change(before, after),
        other.casters,
        microseconds_between(one, other),
    ))
}

/// What the tight form gives over the paper's.
fn tightness(paper: &Summary, tight: &Summary) -> String {
    format!(
        "Under a sun, tight H has {} casters drawn in {} a fit, the paper's H {} in {}.",
        Figure(tight.drawn),
        microseconds(tight),
        Figure(paper.drawn),
        microseconds(paper),
    )
}

/// A general-purpose library against the crate.
fn general(library: &Summary, own: &Summary) -> String {
    let times = library.nanoseconds / own.nanoseconds;
    let speed = if times > 1.0 {
        format!("{} times as long as", Figure(times))
    } else {
        format!("{} of the time of", percent(times))
    };
    format!(
        "{} takes {speed} {} ({} against {}) and lacks a caster in {} of the views; it loses \
         something in {} of the hard cases.",
        library.contender,
        own.contender,
        microseconds(library),
        microseconds(own),
        percent(library.missing_cases),
        percent(library.hard_lost.unwrap_or_default()),
    )
}

/// What the hard cases say.
fn hard(measured: &Measured) -> Option<String> {
    let with_hard: Vec<(&Summary, f64)> =
        measured.summaries.iter().filter_map(|summary| Some((summary, summary.hard_lost?))).collect();
    let sound: Vec<&str> =
        with_hard.iter().filter(|(_, lost)| *lost == 0.0).map(|(summary, _)| summary.contender).collect();
    let (worst, lost) = with_hard.iter().max_by(|a, b| a.1.total_cmp(&b.1))?;
    Some(format!(
        "In the hard cases nothing is lost with: {}. The most is lost with {}, in {} of the cases.",
        listed(&sound),
        worst.contender,
        percent(*lost)
    ))
}

/// What culling by H saves under a light at a position.
fn local(one: &Summary, tight: &Summary) -> String {
    let more = if tight.missing_cases == 0.0 { "and lacks none that is needed" } else { "and lacks some" };
    format!(
        "Under a {}, {} draws {} casters on average in {}, {} draws {} in {} {more}; {} are needed.",
        one.light,
        one.contender,
        Figure(one.drawn),
        microseconds(one),
        tight.contender,
        Figure(tight.drawn),
        microseconds(tight),
        Figure(tight.needed),
    )
}
