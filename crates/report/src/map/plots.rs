//! The chapter's plots.

use render_check::maps::Technique;

use super::Measured;
use super::cases::{ALL_WARPS, CASCADES_OF_SAME_SUM, KINDS, PLOTTED};
use super::summary::Mean;
use super::tables::fitted_to;
use crate::chapter::{Axis, Plot, Point, Series};
use crate::statistics::geometric_mean;

/// What cascades are plotted beside the single maps.
const PLOTTED_SLICES: [(Technique, usize); 2] = [(Technique::Uniform, 4), (Technique::Best, 4)];

/// Wrong pixels over time, of maps that are fitted to what is seen or not.
pub(super) fn of_warps(measured: &Measured, narrowed: bool) -> Plot {
    let name = if narrowed { "map-warps" } else { "map-warps-whole" };
    let fitted_to = fitted_to(narrowed);
    let single = PLOTTED.map(|technique| (technique, 1));
    Plot {
        name: name.to_owned(),
        title: format!("What fewer wrong pixels cost: maps fitted to {fitted_to}"),
        caption: format!(
            "Each line is one way to spread texels; along it maps grow, from left to right, by the sizes that are written at \
             the uniform map. × 4 is four cascades of the view, of which each has a map of so many texels. Down is better, left \
             is cheaper, and 1 on both axes is the uniform map of {0}². Means over scenes and lights.",
            measured.middle_size
        ),
        x: Axis::logarithmic("time of a frame's shadows: fit, maps and test (uniform map = 1)"),
        y: Axis::logarithmic("wrong pixels (uniform map = 1)"),
        series: single
            .into_iter()
            .chain(PLOTTED_SLICES)
            .filter_map(|(technique, cascades)| of_sizes(measured, narrowed, technique, cascades))
            .collect(),
        front: true,
    }
}

/// One way to spread texels in all sizes, those of the uniform map written beside it; nothing where it was not drawn.
fn of_sizes(measured: &Measured, narrowed: bool, technique: Technique, cascades: usize) -> Option<Series> {
    let own = measured.sizes(narrowed, technique, cascades);
    let is_labelled = (technique, cascades) == (Technique::Uniform, 1);
    Some(Series {
        name: own.first()?.contender.to_string(),
        points: own.iter().map(|it| point(it, is_labelled.then(|| format!("{}²", it.contender.size)))).collect(),
        joined: true,
    })
}

fn point(mean: &Mean, label: Option<String>) -> Point {
    Point { x: mean.time_ratio, y: mean.wrong_ratio, label }
}

/// Worst aliasing over the limit, over fit time, on random views, narrowed and not.
pub(super) fn of_fits(measured: &Measured) -> Vec<Plot> {
    let plot = |(narrowed, name, views): (bool, &str, &str)| {
        let at = |&technique: &Technique| {
            let own = || measured.survey.iter().filter(|it| (it.technique, it.narrowed) == (technique, narrowed));
            Point {
                x: geometric_mean(&own().map(|it| it.fit_us).collect::<Vec<_>>()),
                y: geometric_mean(&own().map(|it| it.over_limit_50).collect::<Vec<_>>()),
                label: Some(technique.to_string()),
            }
        };
        let series = |name: &str, searched: bool| Series {
            name: name.to_owned(),
            points: ALL_WARPS.iter().filter(|it| it.is_searched() == searched).map(at).collect(),
            joined: searched,
        };
        Plot {
            name: name.to_owned(),
            title: format!("What better matrices cost: random outdoor views {views}"),
            caption: "Worst aliasing over the least that any spread of the same texels could have, the median over views, and the \
                      geometric mean over suns, lamps and spots; over the time of a fit. 1 is what no map can beat."
                .to_owned(),
            x: Axis::logarithmic("time of a fit, µs"),
            y: Axis::logarithmic("worst aliasing over the limit"),
            series: vec![series("closed forms", false), series("searched, by effort", true)],
            front: true,
        }
    };
    let narrowed = (true, "map-fits", "narrowed to the ground that is seen");
    [narrowed, (false, "map-fits-whole", "from the near plane on")].map(plot).to_vec()
}

/// One cascade to eight, with as many texels in all.
pub(super) fn of_cascades(measured: &Measured) -> Plot {
    let means = measured.means(CASCADES_OF_SAME_SUM, true);
    let series = |technique| {
        let own = means.iter().filter(|it| it.contender.technique == technique);
        let label = |it: &Mean| Some(it.contender.cascades.to_string());
        Series { name: technique.to_string(), points: own.map(|it| point(it, label(it))).collect(), joined: true }
    };
    Plot {
        name: "map-cascades".to_owned(),
        title: "What cascades give: one to eight, with the same texels in all".to_owned(),
        caption: format!(
            "{}² texels, in so many cascades as is written beside each point; maps fitted to what is seen. The uniform map of one \
             cascade is 1 on both axes.",
            2 * measured.middle_size
        ),
        x: Axis::logarithmic("time of a frame's shadows (uniform map = 1)"),
        y: Axis::logarithmic("wrong pixels (uniform map = 1)"),
        series: [Technique::Uniform, Technique::LightSpace, Technique::Best].map(series).to_vec(),
        front: true,
    }
}

/// Maps of a lamp among what it lights, a plot for each lamp.
pub(super) fn of_kinds(measured: &Measured) -> Vec<Plot> {
    let records = || measured.records.iter().filter(|it| it.comparison == KINDS);
    let mut lamps: Vec<(&str, &str)> = Vec::new();
    for record in records() {
        if !lamps.contains(&(record.scene, record.light)) {
            lamps.push((record.scene, record.light));
        }
    }
    let plot = |(index, (scene, light)): (usize, (&str, &str))| {
        let own = || records().filter(move |it| (it.scene, it.light) == (scene, light));
        let mut series: Vec<Series> = Vec::new();
        let mut sorted: Vec<_> = own().collect();
        sorted.sort_by_key(|it| it.contender.size);
        for record in sorted {
            let name = record.contender.technique.to_string();
            let is_labelled = record.contender.size == measured.middle_size;
            let label = is_labelled.then(|| format!("{} × {}²", record.passes, record.contender.size));
            let point = Point { x: record.time_ratio, y: 100.0 * record.wrong_share, label };
            match series.iter_mut().find(|series| series.name == name) {
                Some(series) => series.points.push(point),
                None => series.push(Series { name, points: vec![point], joined: true }),
            }
        }
        Plot {
            name: format!("map-kinds-{}", index + 1),
            title: format!("Kinds of maps for a lamp in a room: {light}"),
            caption: "Each line is one kind; along it maps grow. How many were drawn stands beside the largest size. A kind that is missing has no map for this lamp."
                .to_owned(),
            x: Axis::logarithmic("time of a frame's shadows (faces of a cube of the largest size = 1)"),
            y: Axis::logarithmic("wrong pixels, % of those compared"),
            series,
            front: true,
        }
    };
    lamps.into_iter().enumerate().map(plot).collect()
}
