//! What can be wrong with an input, and which field it is.

use core::fmt;

/// The largest coordinate, distance or extent accepted anywhere, in world units: 2⁴⁰, about 10¹².
///
/// In f64 it leaves 12 bits for what lies within one unit, and squares of squares of it are still far from overflow in
/// f64 as entries of a matrix are in f32.
pub const MAX_COORDINATE: f64 = 1_099_511_627_776.0;

/// The smallest distance (near plane, light range, half height of an orthographic view) accepted, in world units:
/// 2⁻⁴⁰, about 10⁻¹².
pub const MIN_DISTANCE: f64 = 1.0 / MAX_COORDINATE;

/// An input that no fit can be made from: the field, and what is wrong with it.
///
/// Every constructor checks its arguments once; past the door there are no errors, only results.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct InputError {
    /// The name of the argument, as in the signature of the constructor that refused it.
    pub field: &'static str,
    /// What is wrong with it.
    pub problem: Problem,
}

/// What is wrong with a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Problem {
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
    /// A list with nothing in it.
    Empty,
    /// A list longer than its documentation allows.
    TooMany,
    /// An index that is past the end of its list.
    OutOfRange,
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::NotFinite => "is not a finite number",
            Self::TooSmall => "is too small",
            Self::TooLarge => "is too large",
            Self::NoDirection => "has no direction",
            Self::Parallel => "is parallel to the direction it must differ from",
            Self::AngleOutOfRange => "is outside the open range of its angle",
            Self::OutOfOrder => "has its minimum above its maximum",
            Self::Singular => "takes space to a plane or less",
            Self::NotOrthonormal => "is not of unit length and at right angles to the other axes",
            Self::NotAProjection => "is neither perspective nor orthographic with a positive w",
            Self::LooksTransposed => "looks transposed: vectors are columns here, so pass its transpose",
            Self::LooksReversed => "has near and far exchanged for this matrix: try `ClipSpace::reversed`",
            Self::OutsideView => "lies outside of the view's own depths",
            Self::NotAllAround => "shines neither all around nor into a half space",
            Self::Empty => "is empty",
            Self::TooMany => "holds too many elements",
            Self::OutOfRange => "has an index past the end of its list",
        })
    }
}

impl fmt::Display for InputError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.field, self.problem)
    }
}

impl core::error::Error for InputError {}

/// The checks that the constructors share, each naming its field.
pub(crate) mod check {
    use super::{InputError, MAX_COORDINATE, MIN_DISTANCE, Problem};
    use glam::DVec3;

    pub(crate) const fn fail<T>(field: &'static str, problem: Problem) -> Result<T, InputError> {
        Err(InputError { field, problem })
    }

    /// Zero for a number so small that products of a few of its kind would underflow: below 2⁻²⁰⁰, about 10⁻⁶⁰.
    fn flushed(value: f64) -> f64 {
        const TINY: f64 = 6.223_015_277_861_142e-61;
        if value.abs() < TINY { 0.0 } else { value }
    }

    /// A coordinate or signed distance.
    pub(crate) fn coordinate(field: &'static str, value: f64) -> Result<f64, InputError> {
        if !value.is_finite() {
            fail(field, Problem::NotFinite)
        } else if value.abs() > MAX_COORDINATE {
            fail(field, Problem::TooLarge)
        } else {
            Ok(flushed(value))
        }
    }

    /// A point.
    pub(crate) fn point(field: &'static str, value: DVec3) -> Result<DVec3, InputError> {
        Ok(DVec3::new(coordinate(field, value.x)?, coordinate(field, value.y)?, coordinate(field, value.z)?))
    }

    /// A positive distance.
    pub(crate) fn distance(field: &'static str, value: f64) -> Result<f64, InputError> {
        coordinate(field, value)?;
        if value < MIN_DISTANCE { fail(field, Problem::TooSmall) } else { Ok(value) }
    }

    /// A number from 0 to `most`.
    pub(crate) fn part(field: &'static str, value: f64, most: f64) -> Result<f64, InputError> {
        let value = coordinate(field, value)?;
        if value < 0.0 {
            fail(field, Problem::TooSmall)
        } else if value > most {
            fail(field, Problem::TooLarge)
        } else {
            Ok(value)
        }
    }

    /// A positive distance, or infinity.
    pub(crate) fn distance_or_infinity(field: &'static str, value: f64) -> Result<f64, InputError> {
        if value == f64::INFINITY { Ok(value) } else { distance(field, value) }
    }

    /// A direction, made unit length whatever its length was; one that is unit length stays as it is to the last bit.
    pub(crate) fn direction(field: &'static str, value: DVec3) -> Result<DVec3, InputError> {
        if !value.is_finite() {
            return fail(field, Problem::NotFinite);
        }
        if (value.length_squared() - 1.0).abs() <= 4.0 * f64::EPSILON {
            return Ok(value.map(flushed));
        }
        // Scaled by a power of two first, so that neither tiny nor huge directions under- or overflow when squared.
        let largest = value.abs().max_element();
        if largest == 0.0 {
            return fail(field, Problem::NoDirection);
        }
        let scaled = value / largest;
        Ok((scaled / scaled.length()).map(flushed))
    }
}
