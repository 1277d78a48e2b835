//! The likeliest mistakes.

use core::fmt;

/// The mistake that a refused input most likely comes of: there is one where one is by far the likeliest.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Hint {
    /// An angle in degrees where radians are taken.
    Degrees,
    /// The whole opening of a cone where half of it is taken.
    FullAngle,
    /// 0 for a light without limit, as some engines have it; here that is infinity.
    NoLimit,
    /// Least and largest have changed places.
    Swapped,
    /// Bounds of an object that has none, as engines mark what must never be culled.
    Unbounded,
}

impl fmt::Display for Hint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Degrees => "Degrees?",
            Self::FullAngle => "The full angle? It is half of that.",
            Self::NoLimit => "No limit? That is f64::INFINITY.",
            Self::Swapped => "Swapped?",
            Self::Unbounded => "An object without bounds? Give it those of the world, or leave it out.",
        })
    }
}
