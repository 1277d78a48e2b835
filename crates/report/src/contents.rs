//! What is in a report.

use anyhow::Result;

use crate::chapter::Chapter;
use crate::size::Size;
use crate::{advice, arithmetic, body, growth, map};

/// A part of the report: chapters made from the same measurements.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// What the command line calls it.
    pub name: &'static str,
    /// Whether it draws on a graphics card.
    pub draws: bool,
    /// Measures what it is about, and writes it down.
    pub make: fn(Size) -> Result<Vec<Chapter>>,
}

/// All parts, in the report's order: what follows comes first, and then what it follows from.
pub const ENTRIES: [Entry; 4] = [
    Entry {
        name: "map",
        draws: true,
        make: |size| {
            let measured = map::measure(size)?;
            Ok(vec![advice::chapter(&measured)?, map::chapter(&measured)?])
        },
    },
    Entry { name: "body", draws: false, make: |size| Ok(vec![body::chapter(&body::measure(size)?)?]) },
    Entry {
        name: "arithmetic",
        draws: false,
        make: |size| Ok(vec![arithmetic::chapter(&arithmetic::measure(size)?)?]),
    },
    Entry { name: "growth", draws: true, make: |size| Ok(vec![growth::chapter(&growth::measure(size)?)?]) },
];
