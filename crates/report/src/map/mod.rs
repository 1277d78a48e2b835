//! Wrong pixels and aliasing over time: by warp, size, cascades, kind of map, depth format, depth test and filter.
//!
//! | module | what it holds |
//! |---|---|
//! | [`cases`] | what is compared with what |
//! | [`record`] | what is written down of each contender |
//! | [`drawn`](mod@drawn) | contenders drawn, held against rays, and timed in turn |
//! | [`survey`](mod@survey) | aliasing and fit time on random views, without a card |
//! | [`summary`] | means over scenes and lights |
//! | `plots`, `tables`, `findings` | the chapter |

pub mod cases;
pub mod drawn;
mod findings;
mod plots;
pub mod record;
pub mod summary;
pub mod survey;
mod tables;
#[cfg(test)]
mod tests;

use anyhow::Result;
use render_check::gpu::Gpu;

use crate::chapter::{Chapter, Part, Plot, Raw};
use crate::size::Size;
use drawn::{Drawn, Manner, drawn};
use record::{Record, Refused};
use survey::{SurveyRecord, survey};

/// All that was measured.
#[derive(Clone, Debug)]
pub struct Measured {
    /// The adapter that drew it.
    pub adapter: String,
    /// Whether that is a driver on the processor.
    pub is_software: bool,
    /// How it was drawn and timed.
    pub manner: Manner,
    /// The size that all others are held against, in texels a side.
    pub middle_size: u32,
    /// Of contenders that were drawn.
    pub records: Vec<Record>,
    /// Of contenders without a map.
    pub refused: Vec<Refused>,
    /// Of fits to random views.
    pub survey: Vec<SurveyRecord>,
}

/// Draws, judges and times all comparisons, and fits maps to random views.
///
/// # Errors
///
/// When there is no adapter with a clock, when something cannot be drawn, and when a caster is missing from a map.
pub fn measure(size: Size) -> Result<Measured> {
    let gpu = Gpu::new()?;
    let manner = Manner { image: size.of([64, 40], [640, 400]), rounds: size.of(2, 11) };
    let Drawn { records, refused } = drawn(&gpu, &cases::comparisons(size), manner)?;
    Ok(Measured {
        adapter: gpu.name().to_owned(),
        is_software: gpu.is_software(),
        manner,
        middle_size: cases::middle_size(size),
        records,
        refused,
        survey: survey(size)?,
    })
}

/// The plot of warps and sizes, of maps that are fitted to what is seen: what the whole report is about.
#[must_use]
pub fn main_plot(measured: &Measured) -> Plot {
    plots::of_warps(measured, true)
}

/// The chapter, but for the main plot.
///
/// # Errors
///
/// When the raw figures cannot be put in words.
pub fn chapter(measured: &Measured) -> Result<Chapter> {
    let mut parts = vec![Part::Plot(plots::of_warps(measured, false))];
    parts.extend(tables::of_warps(measured).into_iter().map(Part::Table));
    parts.extend(plots::of_fits(measured).into_iter().map(Part::Plot));
    parts.push(Part::Table(tables::of_fits(measured)));
    parts.push(Part::Plot(plots::of_cascades(measured)));
    parts.extend(tables::of_cascades(measured).into_iter().map(Part::Table));
    parts.extend(plots::of_kinds(measured).into_iter().map(Part::Plot));
    parts.push(Part::Table(tables::of_kinds(measured)));
    parts.extend(tables::of_tests(measured).into_iter().map(Part::Table));
    let mut raw = vec![Raw::new("map", &measured.records)?, Raw::new("map-fits", &measured.survey)?];
    if !measured.refused.is_empty() {
        raw.push(Raw::new("map-refused", &measured.refused)?);
    }
    Ok(Chapter {
        title: "Wrong pixels over time".to_owned(),
        opening: opening(measured),
        findings: findings::all(measured),
        parts,
        raw,
    })
}

fn opening(measured: &Measured) -> String {
    let [width, height] = measured.manner.image;
    let clock = if measured.is_software {
        "That is a driver in software: the times of its passes are the processor's, and a card's differ, in proportion too."
    } else {
        "The times of passes are by its own clock."
    };
    format!(
        "How many pixels are wrong, and how long does a light take? Scenes made by code are drawn by `render-check`, {width} × \
         {height} pixels, on {}. {clock} Every pixel is held against a ray to the light. A contender is fitted, drawn and \
         judged once; then all have their turn, {} rounds, and a frame's time is that of fits, maps and shadow test. Ratios \
         are to the first contender before the same scene and light in the same round, and their means are geometric. One \
         pixel is added to both counts of wrong pixels, so that none is a number to divide by. 'Narrowed' maps are fitted to \
         the depths that something is seen in, as a renderer with a depth read-back, or the planner, has it; the others to \
         all between the camera's planes. What it takes to read depths back, or to plan, is not counted.",
        measured.adapter, measured.manner.rounds,
    )
}
