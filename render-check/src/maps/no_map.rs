//! Fits that give no map.

use std::fmt;

use shadowfit::{Empty, Outcome, ShadowMap, Surrounded};

/// Why a fit gives no map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NoMap {
    /// None is needed.
    Empty(Empty),
    /// No single frustum can hold the receivers.
    Surrounded(Surrounded),
}

impl fmt::Display for NoMap {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty(empty) => empty.fmt(f),
            Self::Surrounded(surrounded) => surrounded.fmt(f),
        }
    }
}

/// The map of a fit, or the reason for none.
///
/// # Errors
///
/// Where there is none.
pub fn map_or_reason(outcome: Outcome) -> Result<ShadowMap, NoMap> {
    match outcome {
        Outcome::Map(map) => Ok(map),
        Outcome::Empty(empty) => Err(NoMap::Empty(empty)),
        Outcome::Surrounded(surrounded) => Err(NoMap::Surrounded(surrounded)),
    }
}
