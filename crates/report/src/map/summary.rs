//! Means over all scenes and lights of a comparison, and what the settings that the report recommends are chosen by.

use render_check::maps::Technique;

use super::Measured;
use super::cases::WARPS;
use super::record::{Contender, Record};
use super::survey::SurveyRecord;
use crate::front::front;
use crate::statistics::{between, exponent, geometric_mean};

/// A contender over all scenes and lights of a comparison.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mean {
    /// The contender.
    pub contender: Contender,
    /// Scenes and lights.
    pub shots: usize,
    /// Wrong pixels over those of the comparison's first contender: the geometric mean.
    pub wrong_ratio: f64,
    /// Time of a frame, likewise.
    pub time_ratio: f64,
    /// Worst aliasing of all that may be visible, likewise; NaN of paraboloids.
    pub aliasing_ratio: f64,
    /// The same over the limit: the geometric mean.
    pub over_limit: f64,
    /// Median aliasing of what is seen: the geometric mean.
    pub aliasing_median: f64,
    /// Wrong pixels as a part of those compared: the mean.
    pub wrong_share: f64,
    /// Those that no edge explains, likewise.
    pub false_share: f64,
    /// The geometric mean of fit times, in microseconds.
    pub fit_us: f64,
    /// That of the maps' passes, in milliseconds.
    pub map_ms: f64,
    /// That of the shadow test.
    pub test_ms: f64,
}

impl Measured {
    /// The means of a comparison's contenders, in their order.
    #[must_use]
    pub fn means(&self, comparison: &str, narrowed: bool) -> Vec<Mean> {
        let records: Vec<&Record> =
            self.records.iter().filter(|it| it.comparison == comparison && it.narrowed == narrowed).collect();
        let mut contenders: Vec<Contender> = Vec::new();
        for record in &records {
            if !contenders.contains(&record.contender) {
                contenders.push(record.contender);
            }
        }
        let Some(&first) = contenders.first() else { return Vec::new() };
        let base = |of: &Record| {
            let is_it = |it: &&&Record| it.contender == first && (it.scene, it.light) == (of.scene, of.light);
            records.iter().find(is_it).and_then(|it| it.predicted).unwrap_or(f64::NAN)
        };
        let mean = |contender: Contender| {
            let own: Vec<&Record> = records.iter().copied().filter(|it| it.contender == contender).collect();
            let values = |of: &dyn Fn(&Record) -> f64| own.iter().map(|it| of(it)).collect::<Vec<f64>>();
            let geometric = |of: &dyn Fn(&Record) -> f64| geometric_mean(&values(of));
            let arithmetic = |of: &dyn Fn(&Record) -> f64| values(of).iter().sum::<f64>() / own.len() as f64;
            let predicted = |it: &Record| it.predicted.unwrap_or(f64::NAN);
            Mean {
                contender,
                shots: own.len(),
                wrong_ratio: geometric(&|it| it.wrong_ratio),
                time_ratio: geometric(&|it| it.time_ratio),
                aliasing_ratio: geometric(&|it| predicted(it) / base(it)),
                over_limit: geometric(&|it| predicted(it) / it.limit),
                aliasing_median: geometric(&|it| it.aliasing_median),
                wrong_share: arithmetic(&|it| it.wrong_share),
                false_share: arithmetic(&Record::false_share),
                fit_us: geometric(&|it| it.fit_us),
                map_ms: geometric(&|it| it.map_ms),
                test_ms: geometric(&|it| it.test_ms),
            }
        };
        contenders.into_iter().map(mean).collect()
    }

    /// The warps' means: single maps of every warp and size, and cascades. Ratios are to the uniform map of the middle size.
    #[must_use]
    pub fn warps(&self, narrowed: bool) -> Vec<Mean> {
        self.means(WARPS, narrowed)
    }

    /// One of them.
    #[must_use]
    pub fn warp(&self, narrowed: bool, technique: Technique, cascades: usize, size: u32) -> Option<Mean> {
        self.sizes(narrowed, technique, cascades).into_iter().find(|it| it.contender.size == size)
    }

    /// The power of time that wrong pixels go with along the front of all maps that are fitted to what is seen.
    #[must_use]
    pub fn power_along_front(&self) -> f64 {
        let points: Vec<(f64, f64)> = self.warps(true).iter().map(|it| (it.time_ratio, it.wrong_ratio)).collect();
        exponent(&front(&points).into_iter().map(|index| points[index]).collect::<Vec<_>>())
    }

    /// Single maps or cascades by a warp, in the order of their sizes.
    #[must_use]
    pub fn sizes(&self, narrowed: bool, technique: Technique, cascades: usize) -> Vec<Mean> {
        let mut means = self.warps(narrowed);
        means.retain(|it| (it.contender.technique, it.contender.cascades) == (technique, cascades));
        means.sort_by_key(|it| it.contender.size);
        means
    }

    /// Wrong pixels of single maps by a warp that take as long as the uniform map of the middle size, over that map's: read off
    /// the line between the two sizes that are nearest to that time. NaN with fewer than two sizes.
    #[must_use]
    pub fn wrong_in_same_time(&self, narrowed: bool, technique: Technique) -> f64 {
        let sizes = self.sizes(narrowed, technique, 1);
        let mut points: Vec<(f64, f64)> = sizes.iter().map(|it| (it.time_ratio, it.wrong_ratio)).collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        let after = points.partition_point(|point| point.0 < 1.0).clamp(1, points.len().max(2) - 1);
        match points.get(after - 1..=after) {
            Some(&[a, b]) => between(a, b, 1.0),
            _ => f64::NAN,
        }
    }

    /// What one warp costs and gives, on random views under one kind of light and where it was drawn; nothing where either
    /// was not measured.
    #[must_use]
    pub fn price(&self, technique: Technique, kind: &str, narrowed: bool) -> Option<Price> {
        let is_it = |it: &&SurveyRecord| (it.technique, it.kind, it.narrowed) == (technique, kind, narrowed);
        let fits = self.survey.iter().find(is_it)?;
        let drawn = self.warp(narrowed, technique, 1, self.middle_size)?;
        Some(Price {
            fit_us: fits.fit_us,
            worst_median: fits.worst_50,
            worst_90: fits.worst_90,
            coarser_share: fits.coarser_share,
            over_limit: fits.over_limit_50,
            wrong_ratio: drawn.wrong_ratio,
        })
    }
}

/// What a warp costs and gives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Price {
    /// The fit, in microseconds, on random views.
    pub fit_us: f64,
    /// Worst aliasing over the uniform map's: half of the views have no more.
    pub worst_median: f64,
    /// Nine tenths of the views have no more.
    pub worst_90: f64,
    /// The part of views where it is coarser than the uniform map.
    pub coarser_share: f64,
    /// Worst aliasing over the limit: half of the views have no more.
    pub over_limit: f64,
    /// Wrong pixels over the uniform map's of the same size, in the scenes that are drawn: the geometric mean.
    pub wrong_ratio: f64,
}
