//! What to use: the settings that follow from the figures by rules, held against the crate's defaults.

use anyhow::Result;
use render_check::gpu::Filter;
use render_check::maps::Technique;
use serde::Serialize;
use shadowfit::{Settings, plan::Budget};

use crate::chapter::{Chapter, Figure, Part, Raw, Table, percent};
use crate::front::front;
use crate::map::cases::{ALL_WARPS, FILTERS, FORMATS};
use crate::map::record::format_name;
use crate::map::summary::Mean;
use crate::map::survey::SurveyRecord;
use crate::map::{Measured, main_plot};
use crate::statistics::{exponent, geometric_mean, quantile};

/// What differs by less is the same.
const SAME: f64 = 1.05;
/// No frame is shorter, in milliseconds.
const LEAST_FRAME: f64 = 0.01;

/// A warp on every kind of light, view and scene.
#[derive(Clone, Debug, Serialize)]
struct Worth {
    warp: String,
    #[serde(skip)]
    technique: Technique,
    /// Time of a fit on random views, in microseconds: the geometric mean over the kinds of light.
    fit_us: f64,
    /// Wrong pixels over the uniform map's of the same size: where maps are fitted to what is seen, and where they are not.
    wrong_narrowed: f64,
    wrong_whole: f64,
    /// The same in the time of the uniform map, whatever the size.
    in_same_time_narrowed: f64,
    in_same_time_whole: f64,
    /// Worst aliasing over the limit on random views, half and nine tenths of which have no more: geometric means.
    over_limit: f64,
    over_uniform_90: f64,
    /// The part of the random views where it is coarser than the uniform map, for the kind of light where it is most often.
    coarser: f64,
    /// The frame from which on the search's time is worth it against a larger map, in milliseconds, over the warp before.
    worth_from_ms: Option<f64>,
}

impl Worth {
    /// Wrong pixels in the time of the uniform map, of both manners of fitting.
    fn wrong(&self) -> f64 {
        geometric_mean(&[self.in_same_time_narrowed, self.in_same_time_whole])
    }
}

/// The chapter.
///
/// # Errors
///
/// When the raw figures cannot be put in words.
pub fn chapter(measured: &Measured) -> Result<Chapter> {
    let worths = worths(measured);
    let lines = [warp(&worths), format(measured), filter(measured)];
    let lines: Vec<Advice> = lines.into_iter().flatten().collect();
    let mut findings: Vec<String> = free(&worths, measured.middle_size).into_iter().collect();
    findings.extend(price(measured));
    findings.extend(lines.iter().map(Advice::sentence));
    let parts = vec![
        Part::Plot(main_plot(measured)),
        Part::Table(settings(&lines)),
        Part::Table(prices(&worths, measured)),
    ];
    Ok(Chapter {
        title: "What to use, and what it costs".to_owned(),
        opening: opening(measured),
        findings,
        parts,
        raw: vec![Raw::new("advice", &worths)?],
    })
}

fn opening(measured: &Measured) -> String {
    format!(
        "What follows from the chapters below, by rules. Warps are compared in the time that a frame's shadows (fit, map and test) take with \
         the uniform map of {0}²: a better map that takes longer has to be smaller. Those count as good that have at most {1} times the \
         wrong pixels of the least then, where maps are fitted to what is seen and where they are not, in the geometric mean, and on random \
         views at most {1} times the least worst aliasing in nine views of ten; of these the one that is fitted most quickly is recommended, or the nearest to them where there is none. \
         Of formats and filters the first is, in the order of what they read, that has at most {1} times the wrong pixels of the least.",
        measured.middle_size, SAME
    )
}

/// The warps in the order of their fit times.
fn worths(measured: &Measured) -> Vec<Worth> {
    let means = |narrowed| move |technique: Technique| measured.warp(narrowed, technique, 1, measured.middle_size);
    let worth = |&technique: &Technique| {
        let (narrowed, whole) = (means(true)(technique)?, means(false)(technique)?);
        let survey: Vec<_> = measured.survey.iter().filter(|it| it.technique == technique).collect();
        let over = |of: fn(&SurveyRecord) -> f64| survey.iter().map(|it| of(it)).collect::<Vec<f64>>();
        Some(Worth {
            warp: technique.to_string(),
            technique,
            fit_us: geometric_mean(&over(|it| it.fit_us)),
            wrong_narrowed: narrowed.wrong_ratio,
            wrong_whole: whole.wrong_ratio,
            in_same_time_narrowed: measured.wrong_in_same_time(true, technique),
            in_same_time_whole: measured.wrong_in_same_time(false, technique),
            over_limit: geometric_mean(&over(|it| it.over_limit_50)),
            over_uniform_90: geometric_mean(&over(|it| it.worst_90)),
            coarser: quantile(&over(|it| it.coarser_share), 1.0),
            worth_from_ms: None,
        })
    };
    let mut worths: Vec<Worth> = ALL_WARPS.iter().filter_map(worth).collect();
    worths.sort_by(|a, b| a.fit_us.total_cmp(&b.fit_us));
    let points: Vec<(f64, f64)> = worths.iter().map(|it| (it.fit_us, it.over_limit)).collect();
    let on_front = front(&points);
    let power = growth_with_size(measured);
    for pair in on_front.windows(2) {
        let (before, after) = (&worths[pair[0]], &worths[pair[1]]);
        // A larger map is as fine again when its sides have grown by this factor, and its frame by a power of it.
        let finer = before.over_limit / after.over_limit;
        let from = 1e-3 * (after.fit_us - before.fit_us) / (finer.powf(power) - 1.0);
        worths[pair[1]].worth_from_ms = Some(from);
    }
    worths
}

/// The power of a map's sides that the time of a frame's shadows goes with.
fn growth_with_size(measured: &Measured) -> f64 {
    let best = measured.sizes(true, Technique::Best, 1);
    exponent(&best.iter().map(|it| (f64::from(it.contender.size), it.time_ratio)).collect::<Vec<_>>())
}

/// The recommended warp: the one that is fitted most quickly of the good ones or, where none is good, the one that is nearest
/// to it.
fn recommended(worths: &[Worth]) -> Option<&Worth> {
    let least = |of: &dyn Fn(&Worth) -> f64| worths.iter().map(of).fold(f64::INFINITY, f64::min);
    let (wrong, worst) = (least(&Worth::wrong), least(&|it| it.over_uniform_90));
    let shortfall = |it: &Worth| (it.wrong() / wrong).max(it.over_uniform_90 / worst);
    let nearest = || worths.iter().min_by(|a, b| shortfall(a).total_cmp(&shortfall(b)));
    worths.iter().find(|it| shortfall(it) <= SAME).or_else(nearest)
}

/// Up to where accuracy costs nothing.
fn free(worths: &[Worth], middle_size: u32) -> Option<String> {
    let best = recommended(worths)?;
    let uniform = worths.iter().find(|it| it.technique == Technique::Uniform)?;
    if best.wrong() >= uniform.wrong() {
        return Some(format!(
            "Nothing is free: in the time of a uniform map of {middle_size}² and its test, '{}' has no fewer wrong pixels.",
            best.warp
        ));
    }
    Some(format!(
        "Up to here accuracy is free: in the time of a uniform map of {middle_size}² and its test, '{}' has {} of its wrong pixels where maps \
         are fitted to what is seen, and {} where they are not. On random views its worst aliasing is {} times the least that any spread of \
         texels could have; the uniform map's is {} times.",
        best.warp,
        percent(best.in_same_time_narrowed),
        percent(best.in_same_time_whole),
        Figure(best.over_limit),
        Figure(uniform.over_limit),
    ))
}

/// What accuracy costs beyond.
fn price(measured: &Measured) -> Option<String> {
    let power = measured.power_along_front();
    (power < 0.0).then(|| {
        format!(
            "Past here each halving of wrong pixels costs {} times the time: along the front they go with time to the power of {}.",
            Figure(2_f64.powf(-1.0 / power)),
            Figure(power)
        )
    })
}

/// A setting: what is recommended, what the crate's default is, and why.
struct Advice {
    setting: &'static str,
    recommended: String,
    default: String,
    evidence: String,
}

impl Advice {
    fn sentence(&self) -> String {
        let agreement = if self.recommended == self.default {
            "which is the crate's default".to_owned()
        } else {
            format!("the crate's default is {}", self.default)
        };
        format!("{}: {}, {agreement}. {}", self.setting, self.recommended, self.evidence)
    }
}

fn warp(worths: &[Worth]) -> Option<Advice> {
    let best = recommended(worths)?;
    let others = worths.iter().map(|it| format!("{} {}", it.warp, percent(it.wrong())));
    Some(Advice {
        setting: "Warp",
        recommended: best.warp.clone(),
        default: Technique::of(&Settings::default()).to_string(),
        evidence: format!(
            "Wrong pixels in the time of the uniform map: {}. Its fit takes {} µs; it is coarser than the uniform map in {} of the random \
             views of a kind of light at most.",
            others.collect::<Vec<_>>().join(", "),
            Figure(best.fit_us),
            percent(best.coarser)
        ),
    })
}

/// The first of a comparison's means, in some order, that is as good as the best but for what is the same.
fn first_good(mut means: Vec<Mean>, order: impl Fn(&Mean) -> f64) -> Option<(Mean, Vec<Mean>)> {
    means.sort_by(|a, b| order(a).total_cmp(&order(b)));
    let least = means.iter().map(|it| it.wrong_ratio).fold(f64::INFINITY, f64::min);
    let good = means.iter().find(|it| it.wrong_ratio <= SAME * least).copied()?;
    Some((good, means))
}

fn format(measured: &Measured) -> Option<Advice> {
    let bits = |it: &Mean| {
        let digits = it.contender.format.trim_start_matches(char::is_alphabetic);
        digits.parse().unwrap_or(f64::INFINITY)
    };
    let (good, all) = first_good(measured.means(FORMATS, true), bits)?;
    let others =
        all.iter().map(|it| format!("{} {}", it.contender.format, Figure(it.wrong_ratio))).collect::<Vec<_>>();
    Some(Advice {
        setting: "Depth format",
        recommended: good.contender.format.to_owned(),
        default: format_name(Budget::new(Settings::default()).format()).to_owned(),
        evidence: format!(
            "Wrong pixels over those of {}: {}.",
            measured.means(FORMATS, true).first()?.contender.format,
            others.join(", ")
        ),
    })
}

fn filter(measured: &Measured) -> Option<Advice> {
    let means = measured.means(FILTERS, true);
    let is_plain = |it: &Mean| !matches!(it.contender.filter, Filter::Virtual(_));
    let (good, all) = first_good(means.into_iter().filter(is_plain).collect(), |it| it.contender.filter.reach())?;
    let others = all
        .iter()
        .map(|it| format!("{} {} in {} ms", it.contender.filter, percent(it.wrong_share), Figure(it.test_ms)))
        .collect::<Vec<_>>();
    let default = render_check::run::planned::filter(Budget::new(Settings::default()).filter(), false);
    Some(Advice {
        setting: "Filter",
        recommended: good.contender.filter.to_string(),
        default: default.to_string(),
        evidence: format!("Wrong pixels, and the shadow test's time: {}.", others.join(", ")),
    })
}

fn settings(lines: &[Advice]) -> Table {
    let cells = |it: &Advice| [it.setting, &it.recommended, &it.default, &it.evidence].map(str::to_owned).to_vec();
    Table {
        caption: "What is recommended, and what the crate does where nobody says.".to_owned(),
        columns: ["setting", "recommended", "default", "evidence"].map(str::to_owned).to_vec(),
        lines: lines.iter().map(cells).collect(),
    }
}

fn prices(worths: &[Worth], measured: &Measured) -> Table {
    let cells = |it: &Worth| {
        let from = match it.worth_from_ms {
            Some(ms) if ms < LEAST_FRAME => "any".to_owned(),
            Some(ms) => Figure(ms).to_string(),
            None => String::new(),
        };
        vec![
            it.warp.clone(),
            Figure(it.fit_us).to_string(),
            percent(it.wrong_narrowed),
            percent(it.wrong_whole),
            percent(it.in_same_time_narrowed),
            percent(it.in_same_time_whole),
            Figure(it.over_limit).to_string(),
            Figure(it.over_uniform_90).to_string(),
            percent(it.coarser),
            from,
        ]
    };
    let columns = [
        "warp",
        "fit, µs",
        "wrong pixels over uniform's at the same size, fitted to what is seen",
        "and to all",
        "in the same time, fitted to what is seen",
        "and to all",
        "worst aliasing over the limit, random views",
        "over uniform's, nine views of ten have no more",
        "coarser than uniform, at most",
        "worth its time in frames from … ms on",
    ];
    Table {
        caption: format!(
            "Warps in the order of the time of a fit; frames with maps of {}². A fit is worth its time where a larger map would buy less: \
             in frames whose shadows take longer than the last column says, against the next quicker warp on the front.",
            measured.middle_size
        ),
        columns: columns.map(str::to_owned).to_vec(),
        lines: worths.iter().map(cells).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn worth(technique: Technique, fit_us: f64, wrong: f64, over_uniform_90: f64) -> Worth {
        Worth {
            warp: technique.to_string(),
            technique,
            fit_us,
            wrong_narrowed: wrong,
            wrong_whole: wrong,
            in_same_time_narrowed: wrong,
            in_same_time_whole: wrong,
            over_limit: 10.0 * over_uniform_90,
            over_uniform_90,
            coarser: 0.0,
            worth_from_ms: None,
        }
    }

    #[test]
    fn the_quickest_of_the_good_ones_is_recommended() {
        let mut worths = vec![
            worth(Technique::Uniform, 1.0, 1.0, 1.0),
            worth(Technique::LightSpace, 1.1, 0.71, 0.6),
            worth(Technique::BestRough, 9.0, 0.70, 0.34),
            worth(Technique::Best, 25.0, 0.70, 0.31),
            worth(Technique::BestThorough, 40.0, 0.69, 0.30),
        ];
        let recommended = |worths: &[Worth]| recommended(worths).expect("there is one").technique;
        assert_eq!(recommended(&worths), Technique::Best);
        // As good in nine views of ten, and quicker.
        worths[2].over_uniform_90 = 0.312;
        assert_eq!(recommended(&worths), Technique::BestRough);
        // But not where it is drawn.
        worths[2].in_same_time_whole = 0.85;
        assert_eq!(recommended(&worths), Technique::Best);
        // None is good then, and the one that is left out by least is nearest.
        worths[3].over_uniform_90 = 0.32;
        worths[4].in_same_time_whole = 0.85;
        assert_eq!(recommended(&worths), Technique::Best);
    }

    #[test]
    fn only_what_is_better_in_the_same_time_is_free() {
        let found = |wrong| {
            let worths = [worth(Technique::Uniform, 1.0, 1.0, 1.0), worth(Technique::Best, 25.0, wrong, 0.3)];
            free(&worths, 1024).expect("both are there")
        };
        assert!(found(0.75).contains("accuracy is free") && found(0.75).contains("75.0 %"), "{}", found(0.75));
        assert!(found(1.02).contains("Nothing is free"), "{}", found(1.02));
    }

    #[test]
    fn settings_say_whether_they_are_the_defaults() {
        let worths = [worth(Technique::Uniform, 1.0, 1.0, 1.0), worth(Technique::Best, 25.0, 0.5, 0.3)];
        let advice = warp(&worths).expect("there is one");
        assert_eq!((&*advice.recommended, &*advice.default), ("best", "best"));
        assert!(advice.sentence().contains("which is the crate's default"));
        let other = Advice { recommended: "uniform".to_owned(), ..advice };
        assert!(other.sentence().contains("the crate's default is best"));
    }
}
