//! How cost grows: with lights, casters, planes of S, texels of the map, triangles and cascades.
//!
//! | module | what it holds |
//! |---|---|
//! | [`cost`] | one figure: what was done, with how many of what, and how long it took |
//! | `town` | the view, the lamps and the boxes that the processor works on |
//! | `lights`, `casters`, `setup` | what is timed on the processor |
//! | `terrain`, `card` | what is timed on the card |
//! | [`curve`] | the figures of one work as a curve, and its exponents |
//! | `findings`, `write_up` | what the figures say |
//! | `words` | counts, times and exponents as they are written |

mod card;
mod casters;
pub mod cost;
pub mod curve;
mod findings;
mod lights;
mod setup;
mod terrain;
#[cfg(test)]
mod tests;
mod town;
mod words;
mod write_up;

use anyhow::{Context, Result};
use render_check::gpu::Gpu;
use render_check::output::progress::bar;

use crate::size::Size;
use cost::Cost;

pub use write_up::chapter;

/// What was measured.
#[derive(Clone, Debug)]
pub struct Measured {
    /// What the card calls itself, and the API it is reached through.
    pub card: String,
    /// Whether that is a driver on the processor.
    pub is_software: bool,
    /// Every figure.
    pub costs: Vec<Cost>,
}

/// Measures.
///
/// # Errors
///
/// When a case is refused, when there is no card, or when it refuses.
pub fn measure(size: Size) -> Result<Measured> {
    let gpu = Gpu::new().context("growth on the card cannot be measured")?;
    let bar = bar("growth", 4);
    let part = |what, costs: Result<Vec<Cost>>| {
        bar.inc(1);
        costs.with_context(|| format!("how cost grows: {what}"))
    };
    let costs = [
        part("lights", lights::measure(size))?,
        part("casters", casters::measure(size))?,
        part("planes, map size and cascades", setup::measure(size))?,
        part("the card", card::measure(&gpu, size))?,
    ]
    .concat();
    Ok(Measured { card: gpu.name().to_owned(), is_software: gpu.is_software(), costs })
}
