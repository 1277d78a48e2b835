//! Errors of the constructors: which field was refused, why, and what is allowed.

pub(crate) mod check;
mod hint;
mod message;

pub use hint::Hint;

use core::fmt;

/// The largest coordinate, distance or extent accepted anywhere, in world units: 2⁴⁰, about 10¹².
///
/// At that distance f64 still resolves a 4096th of a unit, its fourth power does not overflow f64, and entries of a matrix made
/// from it do not overflow f32.
pub const MAX_COORDINATE: f64 = 1_099_511_627_776.0;

/// The smallest distance (near plane, light range, half height of an orthographic view) accepted, in world units:
/// 2⁻⁴⁰, about 10⁻¹².
pub const MIN_DISTANCE: f64 = 1.0 / MAX_COORDINATE;

/// An argument that a constructor refused: the field, its index in a list, the value, the range allowed and, where one mistake is
/// by far the likeliest, a hint.
///
/// Every constructor checks its arguments once. A fit takes checked inputs only and cannot fail. `docs/numerics.md` has the ranges.
///
/// ```
/// use shadowfit::{Aabb, Light, Scene, View, input::{Expected, Hint, InputErrorKind}};
///
/// let view = View::perspective((0.0, 1.7, 0.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0), 60.0, 1.6, 0.1, 500.0);
/// let error = view.unwrap_err();
/// assert_eq!((error.field, error.problem), ("fov_y", InputErrorKind::AngleOutOfRange));
/// assert_eq!((error.value, error.hint), (Some(60.0), Some(Hint::Degrees)));
/// assert_eq!(error.to_string(), "fov_y must lie in (0, π) radians; got 60. Degrees?");
///
/// let error = Light::point((0.0, 3.0, 0.0), 2.0, 1.0).unwrap_err();
/// assert_eq!(error.expected, Some(Expected::Above { field: "near", value: 2.0 }));
/// assert_eq!(error.to_string(), "range (1) must be greater than near (2)");
/// ```
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct InputError {
    /// The name of the argument, as in the signature of the constructor that refused it.
    pub field: &'static str,
    /// Its index, where the argument is a list.
    pub index: Option<usize>,
    /// The component of a vector, a box or a matrix: `"y"`, `"min.y"`, `"z_axis.w"`.
    pub component: Option<&'static str>,
    /// The kind of mistake.
    pub problem: InputErrorKind,
    /// The value that was refused.
    pub value: Option<f64>,
    /// The values that are allowed.
    pub expected: Option<Expected>,
    /// The likeliest cause, where there is one.
    pub hint: Option<Hint>,
}

/// The values allowed where one was refused.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Expected {
    /// The closed range from `least` to `most`.
    Within {
        /// The smallest value allowed.
        least: f64,
        /// The largest value allowed.
        most: f64,
    },
    /// The open range between `above` and `below`.
    Between {
        /// The lower bound, itself not allowed.
        above: f64,
        /// The upper bound, itself not allowed; may be infinite.
        below: f64,
    },
    /// Greater than another number.
    Above {
        /// The name of the other number.
        field: &'static str,
        /// Its value.
        value: f64,
    },
    /// Less than another number.
    Below {
        /// The name of the other number.
        field: &'static str,
        /// Its value.
        value: f64,
    },
    /// No less than another number of the same box.
    AtLeast {
        /// The name of the other number.
        field: &'static str,
        /// Its value.
        value: f64,
    },
    /// A direction that is not parallel to another.
    NotParallel {
        /// The name of the other direction.
        field: &'static str,
    },
}

impl InputError {
    pub(crate) const fn new(field: &'static str, problem: InputErrorKind) -> Self {
        Self { field, index: None, component: None, problem, value: None, expected: None, hint: None }
    }

    /// The error with the value that was refused.
    pub(crate) const fn got(self, value: f64) -> Self {
        Self { value: Some(value), ..self }
    }

    /// The error with the values that are allowed.
    pub(crate) const fn expected(self, expected: Expected) -> Self {
        Self { expected: Some(expected), ..self }
    }

    /// The error with the likeliest cause, if there is one.
    pub(crate) const fn hinted(self, hint: Option<Hint>) -> Self {
        Self { hint, ..self }
    }

    /// The error of one component.
    pub(crate) const fn of_component(self, component: &'static str) -> Self {
        Self { component: Some(component), ..self }
    }

    /// The error of one component of a vector: `axis` is 0 for x.
    pub(crate) const fn of_axis(self, axis: usize) -> Self {
        self.of_component(match axis {
            0 => "x",
            1 => "y",
            _ => "z",
        })
    }

    /// The error of an element of a list.
    pub(crate) const fn of_list(self, field: &'static str, index: usize) -> Self {
        Self { field, index: Some(index), ..self }
    }
}

/// Values are compared by their bits, so that errors about the same NaN are equal.
impl PartialEq for InputError {
    fn eq(&self, other: &Self) -> bool {
        let bits = |error: &Self| error.value.map(f64::to_bits);
        (self.field, self.index, self.component, self.problem)
            == (other.field, other.index, other.component, other.problem)
            && (bits(self), self.expected, self.hint) == (bits(other), other.expected, other.hint)
    }
}

/// The kind of mistake in a field; [`InputError`]'s message adds value, range and hint.
///
/// ```
/// use shadowfit::{Light, input::InputErrorKind};
///
/// let error = Light::directional((0.0, 0.0, 0.0)).unwrap_err();
/// assert_eq!(error.problem, InputErrorKind::NoDirection);
/// assert_eq!(error.to_string(), "direction_to_light is the zero vector, which has no direction");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum InputErrorKind {
    /// NaN, or infinite where only finite numbers are allowed.
    NotFinite,
    /// Below the smallest value allowed: [`MIN_DISTANCE`] for lengths, 0 for fractions, or as documented.
    TooSmall,
    /// Above the largest value allowed: [`MAX_COORDINATE`], or as documented.
    TooLarge,
    /// A direction of length zero.
    NoDirection,
    /// A direction parallel to one that it must span a plane with.
    Parallel,
    /// An angle outside its open range.
    AngleOutOfRange,
    /// A minimum above its maximum: a near plane beyond the far one, an inverted box.
    OutOfOrder,
    /// A singular matrix: it flattens space, so that there is no image.
    Singular,
    /// Axes of a stored view that are not orthonormal, see the guarantees of [`View`](crate::View).
    NotOrthonormal,
    /// A matrix that is neither a perspective nor an orthographic projection with positive w.
    NotAProjection,
    /// A matrix made for row vectors: pass its transpose.
    LooksTransposed,
    /// Near and far exchanged: the matrix fits the other direction of depth, [`ClipSpace::reversed`](crate::ClipSpace::reversed).
    LooksReversed,
    /// A depth range that misses the view, or a near plane that cuts all of it off.
    OutsideView,
    /// A light that is neither a point light nor a hemisphere.
    NotAllAround,
    /// A light that is no spot.
    NotASpot,
    /// An empty list.
    Empty,
    /// More elements than allowed.
    TooMany,
    /// An index past the end of its list.
    OutOfRange,
}

impl fmt::Display for InputErrorKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::NotFinite => "must be finite",
            Self::TooSmall => "is too small",
            Self::TooLarge => "is too large",
            Self::NoDirection => "is the zero vector, which has no direction",
            Self::Parallel => "is parallel to the direction that it must span a plane with",
            Self::AngleOutOfRange => "is outside the range of its angle",
            Self::OutOfOrder => "has its minimum above its maximum",
            Self::Singular => "is singular: it flattens space to a plane or less",
            Self::NotOrthonormal => "and the other axes must be unit vectors at right angles",
            Self::NotAProjection => "is neither a perspective nor an orthographic projection with positive w",
            Self::LooksTransposed => "looks transposed: it is made for row vectors. Pass its transpose",
            Self::LooksReversed => {
                "does not fit the matrix: near and far are exchanged. Reversed depth? Try `clip.reversed()`"
            }
            Self::OutsideView => "leaves nothing of the view. An oblique plane with the wrong sign?",
            Self::NotASpot => "must be a spot",
            Self::NotAllAround => "must be a point light or a hemisphere: no other has cube faces",
            Self::Empty => "must not be empty",
            Self::TooMany => "has too many elements",
            Self::OutOfRange => "has an index past the end of its list",
        })
    }
}

impl core::error::Error for InputError {}
