//! Counts of flickering pixels.

use comfy_table::Table;
use serde::Serialize;

use crate::maps::{Cascading, Technique};
use crate::output::table::{self, percent};
use crate::verdict::share;

/// Flicker of one light with one kind of map.
#[derive(Clone, Debug, Serialize)]
pub struct Flicker {
    /// The light, in the command line's spelling.
    pub light: String,
    /// The technique.
    pub technique: Technique,
    /// Texels along each side.
    pub map_size: u32,
    /// How the view is split into cascades; `None` where it is not.
    pub cascading: Option<Cascading>,
    /// Technique and sizes in words.
    #[serde(skip)]
    pub name: String,
    /// Whether each fit is warm-started from the previous step's map.
    pub warm: bool,
    /// Median CPU time of a fit, in microseconds.
    pub fit_us: f64,
    /// How often a warm-started fit jumped to another map.
    pub jumps: usize,
    /// The changes of each step; `None` where one of its two cameras has no map.
    pub steps: Vec<Option<Step>>,
}

/// Flicker in one step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Step {
    /// Pixels that changed between light and shadow.
    pub changed: usize,
    /// Of these, pixels that moved from one cascade to another.
    pub over_a_cut: usize,
    /// Pixels whose surface point is in both views and in reach of the light.
    pub compared: usize,
}

impl Step {
    /// The share of pixels that changed; 0 where none was compared.
    #[must_use]
    pub fn share(&self) -> f64 {
        share(self.changed, self.compared)
    }
}

impl Flicker {
    /// The mean share of pixels that changed in a step.
    #[must_use]
    pub fn mean(&self) -> f64 {
        let shares = self.steps.iter().flatten().map(Step::share);
        shares.clone().sum::<f64>() / shares.count().max(1) as f64
    }

    /// The same for pixels that moved from one cascade to another.
    #[must_use]
    pub fn mean_over_cuts(&self) -> f64 {
        let shares = self.steps.iter().flatten().map(|step| share(step.over_a_cut, step.compared));
        shares.clone().sum::<f64>() / shares.count().max(1) as f64
    }

    /// The largest share that changed in a step.
    #[must_use]
    pub fn worst(&self) -> f64 {
        self.steps.iter().flatten().map(Step::share).fold(0.0, f64::max)
    }
}

/// A row for each kind of map of each light.
pub(super) fn summary(flickers: &[Flicker]) -> Table {
    let header =
        ["light", "map", "change in a step", "over a cut", "at worst", "steps without a map", "fit", "jumps"];
    let mut table = table::new(header, 2..header.len());
    for flicker in flickers {
        table.add_row([
            flicker.light.clone(),
            format!("{}{}", flicker.name, if flicker.warm { ", warm" } else { "" }),
            percent(flicker.mean()),
            if flicker.cascading.is_some() { percent(flicker.mean_over_cuts()) } else { "-".into() },
            percent(flicker.worst()),
            flicker.steps.iter().filter(|step| step.is_none()).count().to_string(),
            format!("{:.1} µs", flicker.fit_us),
            if flicker.warm { flicker.jumps.to_string() } else { "-".into() },
        ]);
    }
    table
}
