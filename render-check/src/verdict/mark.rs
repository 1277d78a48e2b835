//! Marks: the verdict on a pixel.

use serde::Serialize;

/// The verdict on a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// No surface; not compared.
    Sky,
    /// Not lit whatever casts shadows; not compared.
    Unlit,
    /// Correct.
    Right,
    /// Wrong, within the filter's reach of a true shadow's edge.
    EdgeTexel,
    /// Wrong, next to a pixel across a true shadow's edge.
    EdgePixel,
    /// In shadow, but should be lit.
    FalseShadow,
    /// Lit, but should be in shadow.
    FalseLight,
    /// Lit, but should be in shadow, because a caster is missing from the map.
    Missing,
}

impl Mark {
    /// The fault, for wrong pixels away from edges.
    #[must_use]
    pub fn fault(self) -> Option<Fault> {
        match self {
            Self::FalseShadow => Some(Fault::FalseShadow),
            Self::FalseLight => Some(Fault::FalseLight),
            Self::Missing => Some(Fault::Missing),
            Self::Sky | Self::Unlit | Self::Right | Self::EdgeTexel | Self::EdgePixel => None,
        }
    }
}

/// A fault: what is wrong with a pixel away from edges.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Fault {
    /// In shadow, but should be lit: shadow acne.
    FalseShadow,
    /// Lit, but should be in shadow: a bias too large (peter-panning), or a map too coarse.
    FalseLight,
    /// The same, because a caster is missing from the map.
    Missing,
}
