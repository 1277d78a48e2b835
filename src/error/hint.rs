//! The likeliest causes of an error.

use core::fmt;

/// The likeliest cause of an [`InputError`](crate::InputError), given where one is by far the likeliest.
///
/// ```
/// use shadowfit::{Light, input::Hint};
///
/// let spot = Light::spot((0.0, 3.0, 0.0), (0.0, -1.0, 0.0), 30.0, 0.1, 20.0);
/// assert_eq!(spot.unwrap_err().hint, Some(Hint::Degrees));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Hint {
    /// An angle in degrees where radians are taken.
    Degrees,
    /// The full angle of a cone where the half angle is taken.
    FullAngle,
    /// 0 for an unlimited range, as some engines have it; here that is infinity.
    NoLimit,
    /// Minimum and maximum exchanged.
    Swapped,
    /// Bounds of an object that is never to be culled, as engines mark it.
    Unbounded,
    /// A camera that looks straight up or down, along its own up.
    StraightUpOrDown,
    /// The matrix of a warped shadow map where a camera's is taken.
    WarpedMap,
}

impl fmt::Display for Hint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Degrees => "Degrees?",
            Self::FullAngle => "The full angle of the cone? Pass half of it.",
            Self::NoLimit => "No limit? That is f64::INFINITY.",
            Self::Swapped => "Swapped?",
            Self::Unbounded => "An object without bounds? Give it those of the world, or leave it out.",
            Self::StraightUpOrDown => "A camera that looks straight up or down? Choose another up.",
            Self::WarpedMap => "The matrix of a warped shadow map?",
        })
    }
}
