//! What is wrong with a pixel, if anything is.

use serde::Serialize;

/// What came of comparing one pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// No surface, so nothing to compare.
    Sky,
    /// No light that a shadow could take away, so nothing to compare.
    Unlit,
    /// As it ought to be.
    Right,
    /// Wrong, close in texels to an edge of the true shadow.
    EdgeTexel,
    /// Wrong, next in pixels to an edge of the true shadow.
    EdgePixel,
    /// Dark, and ought to be lit.
    FalseShadow,
    /// Lit, and ought to be dark.
    FalseLight,
    /// Lit, and ought to be dark, as the map does not hold a caster that it should.
    Missing,
}

impl Mark {
    /// What is wrong here that no edge explains.
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

/// What is wrong with a pixel, where no edge explains it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Fault {
    /// The light reaches the point, but the map has it in shadow: acne.
    FalseShadow,
    /// Something shadows the point, but the map has it lit: a bias too large, or a map too coarse.
    FalseLight,
    /// The same, because the map does not hold a caster that it should.
    Missing,
}
