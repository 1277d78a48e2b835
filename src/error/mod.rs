//! What can be wrong with an input, and which field it is.

pub(crate) mod check;
mod hint;
mod message;

pub use hint::Hint;

use core::fmt;

/// The largest coordinate, distance or extent accepted anywhere, in world units: 2⁴⁰, about 10¹².
///
/// In f64 it leaves 12 bits for what lies within one unit, and squares of squares of it are still far from overflow in
/// f64 as entries of a matrix are in f32.
pub const MAX_COORDINATE: f64 = 1_099_511_627_776.0;

/// The smallest distance (near plane, light range, half height of an orthographic view) accepted, in world units:
/// 2⁻⁴⁰, about 10⁻¹².
pub const MIN_DISTANCE: f64 = 1.0 / MAX_COORDINATE;

/// An input that no fit can be made from: which number it is, what is wrong with it, what it was, what is allowed, and, where one
/// mistake is by far the likeliest, which.
///
/// Every constructor checks its arguments once; past the door there are no errors, only results.
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
    /// Where in a list it is.
    pub index: Option<usize>,
    /// Which number of a vector or a box it is, as `"y"` or `"min.y"`.
    pub component: Option<&'static str>,
    /// What is wrong with it.
    pub problem: InputErrorKind,
    /// The number that was refused.
    pub value: Option<f64>,
    /// What it must be instead.
    pub expected: Option<Expected>,
    /// The likeliest mistake.
    pub hint: Option<Hint>,
}

/// What a refused number must be.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Expected {
    /// From `least` to `most`, both of them allowed.
    Within {
        /// The least that is allowed.
        least: f64,
        /// The largest that is allowed.
        most: f64,
    },
    /// Between `above` and `below`, neither of them allowed.
    Between {
        /// What it must be above.
        above: f64,
        /// What it must be below.
        below: f64,
    },
    /// Greater than another argument.
    Above {
        /// The name of the other argument.
        field: &'static str,
        /// What that is.
        value: f64,
    },
    /// No less than another number of the same box.
    AtLeast {
        /// The name of the other number.
        field: &'static str,
        /// What that is.
        value: f64,
    },
}

impl InputError {
    pub(crate) const fn new(field: &'static str, problem: InputErrorKind) -> Self {
        Self { field, index: None, component: None, problem, value: None, expected: None, hint: None }
    }

    /// With the number that was refused.
    pub(crate) const fn got(self, value: f64) -> Self {
        Self { value: Some(value), ..self }
    }

    /// With what was expected of it.
    pub(crate) const fn expected(self, expected: Expected) -> Self {
        Self { expected: Some(expected), ..self }
    }

    /// With the likeliest mistake, if there is one.
    pub(crate) const fn hinted(self, hint: Option<Hint>) -> Self {
        Self { hint, ..self }
    }

    /// Of one number of a vector: `axis` is 0 for x.
    pub(crate) const fn of_axis(self, axis: usize) -> Self {
        let component = match axis {
            0 => "x",
            1 => "y",
            _ => "z",
        };
        Self { component: Some(component), ..self }
    }

    /// Of an element of a list, or of all of it.
    pub(crate) const fn of_list(self, field: &'static str, index: usize) -> Self {
        Self { field, index: Some(index), ..self }
    }
}

/// A NaN that was refused is equal to the same one.
impl PartialEq for InputError {
    fn eq(&self, other: &Self) -> bool {
        let bits = |error: &Self| error.value.map(f64::to_bits);
        (self.field, self.index, self.component, self.problem)
            == (other.field, other.index, other.component, other.problem)
            && (bits(self), self.expected, self.hint) == (bits(other), other.expected, other.hint)
    }
}

/// What is wrong with a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum InputErrorKind {
    /// NaN or infinite where a number is needed.
    NotFinite,
    /// A length or count that must be positive and no smaller than [`MIN_DISTANCE`], or a part less than 0.
    TooSmall,
    /// Larger than [`MAX_COORDINATE`], or than what its documentation allows.
    TooLarge,
    /// A direction of length zero.
    NoDirection,
    /// A direction along another one that it must span a plane with.
    Parallel,
    /// An angle outside its open range.
    AngleOutOfRange,
    /// A minimum above its maximum: a near plane beyond the far one, a box turned inside out.
    OutOfOrder,
    /// A matrix that takes space to a plane or less: there is no image.
    Singular,
    /// The axes of a stored view, where they are not those that [`View`](crate::View) guarantees.
    NotOrthonormal,
    /// A projection that is neither perspective nor orthographic: lines of sight neither meet in an eye nor run side by side
    /// with a positive w.
    NotAProjection,
    /// A matrix that is made for row vectors: its transpose would be one for column vectors.
    LooksTransposed,
    /// A depth range with near and far exchanged, which the convention with reversed depth would put right.
    LooksReversed,
    /// A range of depths that misses the view, or a near plane that leaves nothing of it.
    OutsideView,
    /// A light that shines neither all around nor into a half space.
    NotAllAround,
    /// A light that shines into no cone.
    NotASpot,
    /// A list with nothing in it.
    Empty,
    /// A list longer than its documentation allows.
    TooMany,
    /// An index that is past the end of its list.
    OutOfRange,
}

impl fmt::Display for InputErrorKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::NotFinite => "is not a finite number",
            Self::TooSmall => "is too small",
            Self::TooLarge => "is too large",
            Self::NoDirection => "has length zero, and no direction",
            Self::Parallel => "is parallel to the direction it must differ from",
            Self::AngleOutOfRange => "is outside the open range of its angle",
            Self::OutOfOrder => "has its minimum above its maximum",
            Self::Singular => "takes space to a plane or less",
            Self::NotOrthonormal => "is not of unit length and at right angles to the other axes",
            Self::NotAProjection => "is neither perspective nor orthographic with a positive w",
            Self::LooksTransposed => "looks transposed: vectors are columns here, so pass its transpose",
            Self::LooksReversed => "has near and far exchanged for this matrix: try `ClipSpace::reversed`",
            Self::OutsideView => "lies outside of the view's own depths",
            Self::NotASpot => "is no spot",
            Self::NotAllAround => "shines neither all around nor into a half space",
            Self::Empty => "is empty",
            Self::TooMany => "holds too many elements",
            Self::OutOfRange => "has an index past the end of its list",
        })
    }
}

impl core::error::Error for InputError {}
