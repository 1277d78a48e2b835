//! Planes and points as exact homogeneous 4-vectors.

use std::cmp::Ordering;

use dashu_int::ops::{BitTest, Gcd};
use dashu_int::{IBig, UBig};

use super::exact::{integers, leading, power_of_two};
use super::scalar::{Bounded, dot};

/// The half-space n·x + offset ≥ 0, as `[nx, ny, nz, offset]` up to a positive factor.
pub type ExactPlane = Homogeneous;

/// A point (w > 0) or a direction (w = 0), as `[x, y, z, w]` up to a positive factor.
pub type ExactPoint = Homogeneous;

/// Components below this power of two of the largest one turn the filter off: products of four
/// would come near the underflow its error bound excludes.
const FILTER_RANGE_BITS: i64 = 200;

/// An exact 4-vector, up to a positive factor, with its rounding to `f64`.
///
/// A point x lies in a half-space h when h · x ≥ 0. The two are dual: everything the oracle does
/// with planes to find points it does with points to find planes.
#[derive(Clone)]
pub struct Homogeneous {
    /// The components.
    coords: [IBig; 4],
    /// The components times a common power of two, correctly rounded, the largest near 1; none
    /// when they differ too much in size for the filter.
    rounded: Option<[Bounded; 4]>,
}

impl Homogeneous {
    /// The 4-vector with these components.
    pub fn new(coords: [IBig; 4]) -> Self {
        let rounded = round(&coords);
        Self { coords, rounded }
    }

    /// The 4-vector with these components, exactly.
    ///
    /// # Panics
    ///
    /// When a component is not finite.
    pub fn from_f64(coords: [f64; 4]) -> Self {
        Self::new(integers(coords).0).reduced()
    }

    /// The finite point with these coordinates, exactly.
    pub fn from_position([x, y, z]: [f64; 3]) -> Self {
        Self::from_f64([x, y, z, 1.0])
    }

    /// The same 4-vector without the common divisor of its components.
    ///
    /// Cross products of cross products would otherwise grow threefold in length at every step,
    /// though what they stand for is most often one of the planes they came from.
    pub fn reduced(self) -> Self {
        let divisor = self.coords.iter().filter(|coord| !coord.is_zero()).fold(UBig::ZERO, |divisor, coord| {
            if divisor.is_zero() { coord.gcd(&IBig::ZERO) } else { divisor.gcd(coord) }
        });
        if divisor <= UBig::ONE {
            return self;
        }
        Self::new(self.coords.map(|coord| coord / &divisor))
    }

    /// The opposite 4-vector.
    pub fn negated(self) -> Self {
        Self::new(self.coords.map(|coord| -coord))
    }

    /// The exact components.
    pub fn coords(&self) -> &[IBig; 4] {
        &self.coords
    }

    /// The first three components: a plane's normal, a point's position times `w`.
    pub fn xyz(&self) -> [&IBig; 3] {
        let [x, y, z, _] = &self.coords;
        [x, y, z]
    }

    /// The last component: a plane's offset, a point's weight.
    pub fn w(&self) -> &IBig {
        &self.coords[3]
    }

    /// The rounded components, where the filter applies.
    pub fn rounded(&self) -> Option<&[Bounded; 4]> {
        self.rounded.as_ref()
    }

    /// Whether all components are zero.
    pub fn is_zero(&self) -> bool {
        self.coords.iter().all(IBig::is_zero)
    }

    /// The exact product.
    pub fn dot(&self, other: &Self) -> IBig {
        dot(&self.coords, &other.coords)
    }

    /// The sign of the exact product: on which side of the plane the point is.
    pub fn side(&self, other: &Self) -> Ordering {
        self.rounded
            .as_ref()
            .zip(other.rounded.as_ref())
            .and_then(|(a, b)| dot(a, b).sign())
            .unwrap_or_else(|| self.dot(other).cmp(&IBig::ZERO))
    }
}

/// The components times a power of two that brings the largest to 1/2 to 1.
fn round(coords: &[IBig; 4]) -> Option<[Bounded; 4]> {
    let bits = coords.iter().map(|coord| coord.bit_len()).max()? as i64;
    let in_range = |coord: &IBig| coord.is_zero() || bits - (coord.bit_len() as i64) < FILTER_RANGE_BITS;
    coords.iter().all(in_range).then(|| {
        coords.each_ref().map(|coord| {
            let (value, exponent) = leading(coord);
            // The value has at most 64 bits, so both factors are normal numbers.
            Bounded::new(if value == 0.0 {
                0.0
            } else {
                value * power_of_two(-64) * power_of_two(64 + exponent - bits)
            })
        })
    })
}
