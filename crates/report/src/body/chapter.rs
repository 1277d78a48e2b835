//! The chapter: what was asked, tables, plots.

use anyhow::{Context as _, Result};

use super::findings::findings;
use super::{LAMP, Measured, SPOT, SUN, Summary, library, own};
use crate::chapter::{Axis, Chapter, Figure, Part, Plot, Point, Raw, Series, Table, percent};

/// The chapter made from what was measured.
///
/// # Errors
///
/// Where nothing was measured, or the raw figures cannot be put in words.
pub fn chapter(measured: &Measured) -> Result<Chapter> {
    let of = |light: &str| -> Vec<&Summary> {
        measured.summaries.iter().filter(|summary| summary.light == light).collect()
    };
    let sun = of(SUN);
    let mut parts: Vec<Part> = [window_plot(&sun), missing_plot(&sun), drawn_plot(&sun)].map(Part::Plot).into();
    for light in [SUN, SPOT, LAMP] {
        parts.push(Part::Table(table(light, &of(light)).with_context(|| format!("no figures of a {light}"))?));
    }
    Ok(Chapter {
        title: "Body".to_owned(),
        opening: opening(measured),
        findings: findings(measured),
        parts,
        raw: vec![Raw::new("body", &measured.summaries)?],
    })
}

/// Whether Bevy took part.
fn has_bevy(measured: &Measured) -> bool {
    measured.summaries.iter().any(|summary| summary.contender.starts_with("Bevy"))
}

fn opening(measured: &Measured) -> String {
    let bevy = if has_bevy(measured) {
        "**Bevy's cascade** is Bevy's own system, run on a world with a thousand lights or more, the time divided by \
         their number; one cascade from the view's near plane to its far plane. Bevy culls casters with the near plane \
         left out, and its renderer, which is not part of this, draws them with unclipped depth, so its near side is \
         open; the second row closes it, which shows what the clip volume alone would hold."
    } else {
        "**Bevy's cascade** is not in this report: it was made without the feature `bevy`."
    };
    format!(
        "What does the body that a map is fitted to, and casters are culled by, cost and give? All contenders have the \
         same views, lights and casters: somebody who looks around in a town of boxes, lights at random, and no view \
         in which nothing receives.\n\
         \n\
         - **Box around V** is the box around the view's eight corners in the light's own axes; **ball around V** is the \
         box around the ball around them, which stays as large as it is while the camera turns. Their near planes stand \
         where V begins as the light sees it, or at the scene's bounds. **Whole cone** is a spot's own frustum.\n\
         - {bevy}\n\
         - **parry3d** is H by a general-purpose library: the convex hull of the view's corners and the light, or of \
         the corners swept towards the sun, cut by the half-spaces of scene and light; in f32 and in f64. Its window \
         is the box around H, not around R. Under a light at a position it has H alone, to cull by.\n\
         - **shadowfit** fits R's uniform map (a border of a texel included) and culls by H: as the paper has it, \
         `hull(V, l) ∩ S ∩ L`, or tight, `hull(V ∩ S ∩ L, l) ∩ S ∩ L`; S is one box, or lists of casters and receivers.\n\
         \n\
         What is true is decided in integers: R is the part of V and L in the box around all receivers that are \
         visible and lit, H is `hull(R, l) ∩ S ∩ L`, and a caster is **needed** that meets it. It is **missing** where it is \
         needed and not drawn, or where some of its part in H lies outside of the clip volume by more than a thousandth of \
         the scene's diameter. Windows are measured against the least rectangle around R, turned as it likes, as the \
         light sees it. The time is that of one fit on one core, without testing the casters; lists are read in it.\n\
         \n\
         The hard cases are those of the property tests (flat, tiny, huge, far from the origin, lit along the view's own \
         planes) with perspective views and suns; an infinite far plane is drawn in to the scene's end for those who \
         need corners. There S is one box or convex body, and something is **lost** where a vertex of the exact R or H \
         lies outside of what is culled by or drawn by more than the same tolerance and what f32 rounds there."
    )
}

/// Which of the legend's three a contender belongs to.
fn family(contender: &str) -> &'static str {
    if own::NAMES.contains(&contender) {
        "shadowfit"
    } else if library::NAMES.contains(&contender) {
        "general-purpose library"
    } else {
        "box or ball around the view"
    }
}

/// A plot of a figure of each contender over its time.
fn over_time(
    [name, title, caption]: [&str; 3],
    y: Axis,
    summaries: &[&Summary],
    value: impl Fn(&Summary) -> Option<f64>,
) -> Plot {
    let mut series: Vec<Series> = Vec::new();
    for summary in summaries {
        let Some(y) = value(summary) else { continue };
        let point = Point { x: summary.nanoseconds * 1e-3, y, label: Some(summary.contender.to_owned()) };
        let family = family(summary.contender);
        match series.iter_mut().find(|series| series.name == family) {
            Some(series) => series.points.push(point),
            None => series.push(Series { name: family.to_owned(), points: vec![point], joined: false }),
        }
    }
    Plot {
        name: name.to_owned(),
        title: title.to_owned(),
        caption: caption.to_owned(),
        x: Axis::logarithmic("time of a fit [µs]"),
        y,
        series,
        front: true,
    }
}

fn window_plot(sun: &[&Summary]) -> Plot {
    let text = [
        "body-window",
        "Window area over the least there is, under a sun",
        "The window's area over that of the least rectangle around what is visible, the median of all views: texels for the \
         same sharpness. Whether casters are missing is in the next plot.",
    ];
    over_time(text, Axis::logarithmic("window area / least rectangle around R"), sun, |one| one.over_least)
}

fn missing_plot(sun: &[&Summary]) -> Plot {
    let text = [
        "body-missing",
        "Views with a missing caster, under a sun",
        "The part of the views in which a caster that is needed is not drawn, or is clipped. At 0 no shadow is lost.",
    ];
    over_time(text, Axis::linear("views with a missing caster [%]"), sun, |one| Some(100.0 * one.missing_cases))
}

fn drawn_plot(sun: &[&Summary]) -> Plot {
    let text = [
        "body-casters",
        "Casters drawn over casters needed, under a sun",
        "How many casters pass the culling, over how many meet the exact H, on average. Below 1 some are missing for sure.",
    ];
    over_time(text, Axis::logarithmic("casters drawn / needed"), sun, |one| Some(one.drawn / one.needed))
}

fn table(light: &str, summaries: &[&Summary]) -> Option<Table> {
    let first = summaries.first()?;
    let or_none = |value: Option<f64>, write: fn(f64) -> String| value.map_or_else(|| "–".to_owned(), write);
    let figure = |value: f64| Figure(value).to_string();
    let mut columns: Vec<String> = [
        "contender",
        "window / least",
        "in 90 %",
        "texels without R",
        "without a receiver",
        "casters drawn",
        "casters missing",
        "views with one",
        "views with R cut",
        "failed",
        "µs a fit",
    ]
    .map(str::to_owned)
    .into();
    let with_hard = summaries.iter().any(|summary| summary.hard_lost.is_some());
    if with_hard {
        columns.extend(["hard cases: lost", "failed"].map(str::to_owned));
    }
    let has_windows = |summary: &Summary| summary.windows > 0;
    let line = |summary: &&Summary| {
        let mut line = vec![
            summary.contender.to_owned(),
            or_none(summary.over_least, figure),
            or_none(summary.over_least_90, figure),
            or_none(summary.wasted, percent),
            or_none(summary.without_receivers, percent),
            figure(summary.drawn),
            percent(summary.missing),
            percent(summary.missing_cases),
            or_none(has_windows(summary).then_some(summary.receivers_cut), percent),
            summary.failed.to_string(),
            figure(summary.nanoseconds * 1e-3),
        ];
        if with_hard {
            line.extend([or_none(summary.hard_lost, percent), or_none(summary.hard_failed, percent)]);
        }
        line
    };
    let caption = format!(
        "Under a {light}: {} views, medians of windows, means of casters ({} in all, {} needed). {}",
        first.cases,
        first.casters,
        Figure(first.needed),
        if light == SUN {
            "Window and texels are those of one uniform map."
        } else {
            "A window is that of one uniform map, where one can hold R: a dash says that there is none."
        }
    );
    Some(Table { caption, columns, lines: summaries.iter().map(line).collect() })
}
