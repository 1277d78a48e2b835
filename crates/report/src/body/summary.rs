//! A contender over all cases of a kind of light.

use serde::Serialize;

use super::SUN;
use super::hard::HardFit;
use super::judge::Fit;
use crate::statistics::{median, quantile};
use crate::timing::Time;

/// A contender over all cases of a kind of light.
#[derive(Clone, Debug, Serialize)]
pub struct Summary {
    /// The kind of light.
    pub light: &'static str,
    /// Who fitted.
    pub contender: &'static str,
    /// Views and lights.
    pub cases: usize,
    /// Of these, how many have a window that can be measured.
    pub windows: usize,
    /// Of these, in how many nothing finite came of the fit.
    pub failed: usize,
    /// The window's area over that of the least rectangle around R, in the middle; none without windows.
    pub over_least: Option<f64>,
    /// The same in nine cases of ten at most.
    pub over_least_90: Option<f64>,
    /// The part of the window without R, in the middle.
    pub wasted: Option<f64>,
    /// The part of the window without a receiver, in the middle.
    pub without_receivers: Option<f64>,
    /// Casters drawn, on average.
    pub drawn: f64,
    /// Casters needed, on average.
    pub needed: f64,
    /// Casters in all.
    pub casters: usize,
    /// Missing casters over needed ones, in all cases together.
    pub missing: f64,
    /// The part of the cases in which a caster is missing.
    pub missing_cases: f64,
    /// The part of the cases in which something visible lies outside of the map.
    pub receivers_cut: f64,
    /// Time of a fit in nanoseconds.
    pub nanoseconds: f64,
    /// Its time over that of the first contender in the same round: a tenth of the rounds are below this.
    pub ratio_10: f64,
    /// The same, and nine tenths are below this.
    pub ratio_90: f64,
    /// The part of the hard cases in which something is lost; none where it took no part.
    pub hard_lost: Option<f64>,
    /// The part of the hard cases in which nothing finite came of the fit.
    pub hard_failed: Option<f64>,
}

impl Summary {
    pub(crate) fn new(
        light: &'static str,
        contender: &'static str,
        fits: &[&Fit],
        time: &Time,
        fits_a_turn: usize,
        hard: &[HardFit],
    ) -> Self {
        let all = |of: fn(&Fit) -> Option<f64>| fits.iter().filter_map(|fit| of(fit)).collect::<Vec<_>>();
        let middle = |values: Vec<f64>| (!values.is_empty()).then(|| median(&values));
        let over_least = all(|fit| fit.over_least);
        let sum = |of: fn(&Fit) -> usize| fits.iter().map(|fit| of(fit)).sum::<usize>() as f64;
        let part = |of: fn(&Fit) -> bool| fits.iter().filter(|fit| of(fit)).count() as f64 / fits.len() as f64;
        let hard: Vec<&HardFit> = hard.iter().filter(|fit| light == SUN && fit.contender == contender).collect();
        let hard_part = |of: fn(&HardFit) -> bool| {
            (!hard.is_empty()).then(|| hard.iter().filter(|fit| of(fit)).count() as f64 / hard.len() as f64)
        };
        Self {
            light,
            contender,
            cases: fits.len(),
            windows: over_least.len(),
            failed: fits.iter().filter(|fit| fit.failed).count(),
            over_least_90: (!over_least.is_empty()).then(|| quantile(&over_least, 0.9)),
            over_least: middle(over_least),
            wasted: middle(all(|fit| fit.wasted)),
            without_receivers: middle(all(|fit| fit.without_receivers)),
            drawn: sum(|fit| fit.drawn) / fits.len() as f64,
            needed: sum(|fit| fit.needed) / fits.len() as f64,
            casters: fits.first().map_or(0, |fit| fit.casters),
            missing: sum(Fit::missing) / sum(|fit| fit.needed).max(1.0),
            missing_cases: part(|fit| fit.missing() > 0),
            receivers_cut: part(|fit| fit.receivers_cut),
            nanoseconds: time.seconds / fits_a_turn as f64 * 1e9,
            ratio_10: time.spread[0],
            ratio_90: time.spread[1],
            hard_lost: hard_part(|fit| fit.lost),
            hard_failed: hard_part(|fit| fit.failed),
        }
    }
}
