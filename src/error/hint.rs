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
    /// Least and largest, or near and far, have changed places.
    Swapped,
    /// Bounds of an object that has none, as engines mark what must never be culled.
    Unbounded,
    /// A matrix by rows where columns are taken.
    Transposed,
    /// A camera's pose, world ← eye, where its inverse is taken.
    NotInverted,
    /// A projection for reversed depth, read as if it were not, or the other way round.
    ReversedDepth,
    /// A projection for another clip space.
    OtherClipSpace,
}

impl fmt::Display for Hint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Degrees => "Degrees?",
            Self::FullAngle => "The full angle? It is half of that.",
            Self::NoLimit => "No limit? That is f64::INFINITY.",
            Self::Swapped => "Swapped?",
            Self::Unbounded => "An object without bounds? Give it those of the world, or leave it out.",
            Self::Transposed => "Transposed? Matrices are arrays of columns, for column vectors.",
            Self::NotInverted => "The camera's pose? The view matrix is its inverse.",
            Self::ReversedDepth => "Is its depth reversed? `ClipSpace::reversed` says whether it is.",
            Self::OtherClipSpace => "Was it made for another clip space?",
        })
    }
}
