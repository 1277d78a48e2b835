//! Checks that the constructors share; each names its field.

use super::{Expected, InputError, InputErrorKind, MAX_COORDINATE, MIN_DISTANCE};
use glam::DVec3;

pub(crate) const fn fail<T>(field: &'static str, problem: InputErrorKind) -> Result<T, InputError> {
    Err(InputError::new(field, problem))
}

/// The range of coordinates.
const COORDINATE: Expected = Expected::Within { least: -MAX_COORDINATE, most: MAX_COORDINATE };
/// The range of distances.
const DISTANCE: Expected = Expected::Within { least: MIN_DISTANCE, most: MAX_COORDINATE };

/// Zero for numbers below 2⁻²⁰⁰, about 10⁻⁶⁰: products of a few of them would underflow.
fn flushed(value: f64) -> f64 {
    const TINY: f64 = 6.223_015_277_861_142e-61;
    if value.abs() < TINY { 0.0 } else { value }
}

/// A coordinate or signed distance.
pub(crate) fn coordinate(field: &'static str, value: f64) -> Result<f64, InputError> {
    within(field, value, COORDINATE).map(flushed)
}

/// A point.
pub(crate) fn point(field: &'static str, value: DVec3) -> Result<DVec3, InputError> {
    let [x, y, z] = value.to_array();
    let axis = |axis: usize, value: f64| coordinate(field, value).map_err(|error| error.of_axis(axis));
    Ok(DVec3::new(axis(0, x)?, axis(1, y)?, axis(2, z)?))
}

/// A positive distance.
pub(crate) fn distance(field: &'static str, value: f64) -> Result<f64, InputError> {
    within(field, value, DISTANCE)
}

/// A number from 0 to `most`.
pub(crate) fn part(field: &'static str, value: f64, most: f64) -> Result<f64, InputError> {
    within(field, value, Expected::Within { least: 0.0, most }).map(flushed)
}

/// A number from `least` to `most`, or one that is too small or too large.
pub(crate) fn within(field: &'static str, value: f64, expected: Expected) -> Result<f64, InputError> {
    let Expected::Within { least, most } = expected else { return Ok(value) };
    let problem = if !value.is_finite() {
        InputErrorKind::NotFinite
    } else if value < least {
        // A large negative coordinate is too large, not too small.
        if value < -MAX_COORDINATE && least < 0.0 { InputErrorKind::TooLarge } else { InputErrorKind::TooSmall }
    } else if value > most {
        InputErrorKind::TooLarge
    } else {
        return Ok(value);
    };
    Err(InputError::new(field, problem).got(value).expected(expected))
}

/// A positive distance, or infinity.
pub(crate) fn distance_or_infinity(field: &'static str, value: f64) -> Result<f64, InputError> {
    if value == f64::INFINITY { Ok(value) } else { distance(field, value) }
}

/// Checks that a number is greater than `other`, the argument `than`.
pub(crate) fn above(field: &'static str, value: f64, than: &'static str, other: f64) -> Result<(), InputError> {
    if value > other {
        return Ok(());
    }
    let expected = Expected::Above { field: than, value: other };
    Err(InputError::new(field, InputErrorKind::OutOfOrder).got(value).expected(expected))
}

/// An angle in an open range, in radians.
pub(crate) fn angle(field: &'static str, value: f64, above: f64, below: f64) -> Result<f64, InputError> {
    if value > above && value < below {
        return Ok(value);
    }
    Err(InputError::new(field, InputErrorKind::AngleOutOfRange)
        .got(value)
        .expected(Expected::Between { above, below }))
}

/// A direction of any length, normalised; a unit vector keeps its bits.
pub(crate) fn direction(field: &'static str, value: DVec3) -> Result<DVec3, InputError> {
    let components = value.to_array();
    if let Some(axis) = components.iter().position(|component| !component.is_finite()) {
        return Err(InputError::new(field, InputErrorKind::NotFinite).got(components[axis]).of_axis(axis));
    }
    if (value.length_squared() - 1.0).abs() <= 4.0 * f64::EPSILON {
        return Ok(value.map(flushed));
    }
    // Scaled by a power of two first, so that neither tiny nor huge directions under- or overflow when squared.
    let largest = value.abs().max_element();
    if largest == 0.0 {
        return fail(field, InputErrorKind::NoDirection);
    }
    let scaled = value / largest;
    Ok((scaled / scaled.length()).map(flushed))
}
