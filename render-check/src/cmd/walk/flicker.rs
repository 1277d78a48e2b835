//! What flickered.

use comfy_table::Table;
use serde::Serialize;

use crate::maps::{Slicing, Technique};
use crate::output::table::{self, percent};
use crate::verdict::share;

/// What flickered under one light through one kind of map.
#[derive(Clone, Debug, Serialize)]
pub struct Flicker {
    /// The light, as the command line spells it.
    pub light: String,
    /// How the texels are spread.
    pub technique: Technique,
    /// Texels along each side.
    pub map_size: u32,
    /// How the view is cut into slices; nothing where it is not.
    pub slicing: Option<Slicing>,
    /// The technique and the sizes in words.
    #[serde(skip)]
    pub name: String,
    /// Whether each map is found from the one of the step before.
    pub warm: bool,
    /// The median over the steps of the time of a fit, on the processor, in microseconds.
    pub fit_us: f64,
    /// How often one found so was another than the one before.
    pub switches: usize,
    /// What changed in each step; nothing where one of its two cameras has no map.
    pub steps: Vec<Option<Step>>,
}

/// What flickered in a step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Step {
    /// Pixels that changed between light and shadow.
    pub changed: usize,
    /// Those of them that another map answers for than before, as the camera moved them over a cut between slices.
    pub over_a_cut: usize,
    /// Pixels whose point both cameras have in view and the light could reach.
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

    /// The same of those that another map answers for.
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
        ["light", "map", "change in a step", "over a cut", "at worst", "steps without a map", "fit", "switches"];
    let mut table = table::new(header, 2..header.len());
    for flicker in flickers {
        table.add_row([
            flicker.light.clone(),
            format!("{}{}", flicker.name, if flicker.warm { ", warm" } else { "" }),
            percent(flicker.mean()),
            if flicker.slicing.is_some() { percent(flicker.mean_over_cuts()) } else { "-".into() },
            percent(flicker.worst()),
            flicker.steps.iter().filter(|step| step.is_none()).count().to_string(),
            format!("{:.1} µs", flicker.fit_us),
            if flicker.warm { flicker.switches.to_string() } else { "-".into() },
        ]);
    }
    table
}
