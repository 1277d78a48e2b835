//! What was found, in sentences made from the figures.

use render_check::maps::Technique;

use super::Measured;
use super::cases::{ALL_WARPS, CASCADES_OF_SAME_SUM, FILTERS, FORMATS, KINDS, PLOTTED, TESTS};
use super::record::Record;
use super::summary::Mean;
use super::survey::SurveyRecord;
use super::tables::{fitted_to, format_name, test_name};
use crate::chapter::Figure;
use crate::statistics::{between, geometric_mean, quantile};

/// All of them.
pub(super) fn all(measured: &Measured) -> Vec<String> {
    let mut found = Vec::new();
    for narrowed in [true, false] {
        found.extend(of_warps(measured, narrowed));
        found.extend(size_that_matches(measured, narrowed));
    }
    found.extend(price_of_accuracy(measured));
    found.extend(share_of_fit(measured));
    found.extend(of_fits(measured));
    found.extend(of_cascades(measured));
    found.extend(of_kinds(measured));
    found.extend(of_formats(measured));
    found.extend(of_tests(measured));
    found.extend(of_filters(measured));
    found.push(format!(
        "No caster was missing from any map, in {} times that a scene was drawn and held against rays.",
        measured.records.len()
    ));
    found
}

/// How many wrong pixels there are over others, in words.
fn as_many(ratio: f64) -> String {
    if ratio < 1.0 {
        format!("{} times fewer", Figure(1.0 / ratio))
    } else {
        format!("{} times as many", Figure(ratio))
    }
}

/// The one with the fewest wrong pixels.
fn fewest(means: &[Mean]) -> Option<&Mean> {
    means.iter().min_by(|a, b| a.wrong_ratio.total_cmp(&b.wrong_ratio))
}

/// Which warp has the fewest wrong pixels at one size, and how the others fare.
fn of_warps(measured: &Measured, narrowed: bool) -> Option<String> {
    let at_middle = |technique: &Technique| measured.warp(narrowed, *technique, 1, measured.middle_size);
    let means: Vec<Mean> = ALL_WARPS.iter().filter_map(at_middle).collect();
    let best = fewest(&means)?;
    let others: Vec<String> = means
        .iter()
        .filter(|it| PLOTTED.contains(&it.contender.technique) && it.contender != best.contender)
        .filter(|it| it.contender.technique != Technique::Uniform)
        .map(|it| format!("{} has {}", it.contender, as_many(it.wrong_ratio)))
        .collect();
    Some(format!(
        "Fitted to {}, of single maps of {}² {} has the fewest wrong pixels, {} than the uniform map; {}.",
        fitted_to(narrowed),
        measured.middle_size,
        best.contender,
        as_many(best.wrong_ratio),
        others.join(", ")
    ))
}

/// How large a uniform map must be to have as few wrong pixels as the best matrix at the middle size.
fn size_that_matches(measured: &Measured, narrowed: bool) -> Option<String> {
    let best = measured.warp(narrowed, Technique::Best, 1, measured.middle_size)?;
    let uniform = measured.sizes(narrowed, Technique::Uniform, 1);
    let best_is = format!("Fitted to {}, the best matrix at {}²", fitted_to(narrowed), measured.middle_size);
    let crossing = uniform
        .iter()
        .zip(uniform.iter().skip(1))
        .find(|(coarse, fine)| coarse.wrong_ratio > best.wrong_ratio && fine.wrong_ratio <= best.wrong_ratio);
    if let Some((coarse, fine)) = crossing {
        let at = |value: fn(&Mean) -> f64| {
            between((coarse.wrong_ratio, value(coarse)), (fine.wrong_ratio, value(fine)), best.wrong_ratio)
        };
        let (size, time) = (at(|it| it.contender.size.into()), at(|it| it.time_ratio) / best.time_ratio);
        return Some(format!(
            "{best_is} is matched by a uniform map of about {size:.0}², {} times the texels and {} times the time.",
            Figure((size / f64::from(measured.middle_size)).powi(2)),
            Figure(time)
        ));
    }
    let last = uniform.last()?;
    (last.wrong_ratio > best.wrong_ratio)
        .then(|| format!("{best_is} has fewer wrong pixels than the uniform map even of {}².", last.contender.size))
}

/// What each halving of wrong pixels costs along the front.
fn price_of_accuracy(measured: &Measured) -> Option<String> {
    let power = measured.power_along_front();
    let halving = 2_f64.powf(-1.0 / power);
    (power < 0.0).then(|| {
        format!(
            "Along the front of all maps fitted to what is seen, wrong pixels go with time to the power of {}: each halving costs \
             {} times the time.",
            Figure(power),
            Figure(halving)
        )
    })
}

/// How much of a frame the search takes.
fn share_of_fit(measured: &Measured) -> Option<String> {
    let best = measured.warp(true, Technique::Best, 1, measured.middle_size)?;
    let frame_us = 1e3 * (best.map_ms + best.test_ms) + best.fit_us;
    let by = if measured.is_software { ", in frames that a driver in software draws" } else { "" };
    Some(format!(
        "The search for the best matrix takes {} µs, {} % of the time of its map of {}² and the test{by}.",
        Figure(best.fit_us),
        Figure(100.0 * best.fit_us / frame_us),
        measured.middle_size
    ))
}

/// What fit time buys on random views, and what warps risk there.
fn of_fits(measured: &Measured) -> Vec<String> {
    [true, false].into_iter().flat_map(|narrowed| of_fits_to(measured, narrowed)).collect()
}

fn of_fits_to(measured: &Measured, narrowed: bool) -> [String; 3] {
    let over = |technique: Technique, value: fn(&SurveyRecord) -> f64| -> Vec<f64> {
        let is_it = |it: &&SurveyRecord| (it.technique, it.narrowed) == (technique, narrowed);
        measured.survey.iter().filter(is_it).map(value).collect()
    };
    let price = |technique: Technique| {
        let [fit, limit] = [over(technique, |it| it.fit_us), over(technique, |it| it.over_limit_50)];
        format!("{technique} {} in {} µs", Figure(geometric_mean(&limit)), Figure(geometric_mean(&fit)))
    };
    let risk = |technique: Technique| {
        let coarser = over(technique, |it| it.coarser_share);
        let [least, most] = [quantile(&coarser, 0.0), quantile(&coarser, 1.0)].map(|share| Figure(100.0 * share));
        format!("{technique} in {least} to {most} %")
    };
    let mean =
        |technique: Technique| format!("{technique} {}", Figure(geometric_mean(&over(technique, |it| it.mean_50))));
    let list =
        |of: &dyn Fn(Technique) -> String| ALL_WARPS[1..].iter().map(|&it| of(it)).collect::<Vec<_>>().join(", ");
    let views = if narrowed { "narrowed to the ground that is seen" } else { "from the near plane on" };
    [
        format!(
            "On random outdoor views {views}, worst aliasing over the limit, and the time of a fit: {}, {}.",
            price(Technique::Uniform),
            list(&price)
        ),
        format!(
            "On the same views {views} a map is coarser at worst than the uniform one, by the kind of light: {}.",
            list(&risk)
        ),
        format!(
            "On the same views {views}, mean aliasing of all that may be visible, the air too, over the uniform map's: {}.",
            list(&mean)
        ),
    ]
}

/// One cascade to eight.
fn of_cascades(measured: &Measured) -> Option<String> {
    let means = measured.means(CASCADES_OF_SAME_SUM, true);
    let of = |technique, cascades| {
        means.iter().find(|it| (it.contender.technique, it.contender.cascades) == (technique, cascades))
    };
    let (cascades, best, both) = (of(Technique::Uniform, 4)?, of(Technique::Best, 1)?, of(Technique::Best, 4)?);
    Some(format!(
        "With the same texels in all and fitted to what is seen, four uniform cascades have {} wrong pixels than one uniform map, in {} \
         times the time; one map by the best matrix {}, in {}; four by the best matrix {}, in {}.",
        as_many(cascades.wrong_ratio),
        Figure(cascades.time_ratio),
        as_many(best.wrong_ratio),
        Figure(best.time_ratio),
        as_many(both.wrong_ratio),
        Figure(both.time_ratio)
    ))
}

/// Which kind of map of a lamp has the fewest wrong pixels, and which is the cheapest.
fn of_kinds(measured: &Measured) -> Vec<String> {
    let is_it = |it: &&Record| it.comparison == KINDS && it.contender.size == measured.middle_size;
    let mut lamps: Vec<&str> = measured.records.iter().filter(is_it).map(|it| it.light).collect();
    lamps.dedup();
    let of_lamp = |light: &str| {
        let own = || measured.records.iter().filter(is_it).filter(|it| it.light == light);
        let best = own().min_by_key(|it| it.wrong)?;
        let cheapest = own().min_by(|a, b| a.time_ratio.total_cmp(&b.time_ratio))?;
        Some(format!(
            "For the lamp at `{light}` with maps of {}², {} has the fewest wrong pixels, {} %, in {} times the time of the faces of a \
             cube; {} takes the least time, {} times as much, with {} %.",
            measured.middle_size,
            best.contender,
            Figure(100.0 * best.wrong_share),
            Figure(best.time_ratio),
            cheapest.contender,
            Figure(cheapest.time_ratio),
            Figure(100.0 * cheapest.wrong_share)
        ))
    };
    lamps.into_iter().filter_map(of_lamp).collect()
}

/// How much depth formats matter.
fn of_formats(measured: &Measured) -> Option<String> {
    let means = measured.means(FORMATS, true);
    let (first, others) = means.split_first()?;
    let words = others.iter().map(|it| {
        format!(
            "{} {} times in {} times the time",
            format_name(&it.contender),
            Figure(it.wrong_ratio),
            Figure(it.time_ratio)
        )
    });
    Some(format!(
        "Wrong pixels by depth format, over those of {}: {}.",
        format_name(&first.contender),
        words.collect::<Vec<_>>().join("; ")
    ))
}

/// Which depth test has the fewest wrong pixels that no edge explains.
fn of_tests(measured: &Measured) -> Option<String> {
    let means = measured.means(TESTS, true);
    let words = means.iter().map(|it| {
        format!(
            "{} {} % without an edge, {} % in all",
            test_name(&it.contender),
            Figure(100.0 * it.false_share),
            Figure(100.0 * it.wrong_share)
        )
    });
    let least = means.iter().min_by(|a, b| a.wrong_share.total_cmp(&b.wrong_share))?;
    Some(format!(
        "Of depth tests, {} has the fewest wrong pixels. Wrong pixels: {}.",
        test_name(&least.contender),
        words.collect::<Vec<_>>().join("; ")
    ))
}

/// What filters cost.
fn of_filters(measured: &Measured) -> Option<String> {
    let means = measured.means(FILTERS, true);
    let first = means.first()?;
    let words = means.iter().skip(1).map(|it| {
        format!(
            "{} {} times the test's time, {} times the wrong pixels",
            it.contender.filter,
            Figure(it.test_ms / first.test_ms),
            Figure(it.wrong_ratio)
        )
    });
    Some(format!(
        "Filters against the nearest texel, a pixel counted as lit from half of its light on: {}.",
        words.collect::<Vec<_>>().join("; ")
    ))
}
