//! The two number types the determinants are evaluated in, and the determinants.
//!
//! Each formula is written once and evaluated in `Bounded`, where its sign is usually certain,
//! and in `IBig`, where it always is.

use std::cmp::Ordering;

use dashu_int::IBig;

/// What a determinant needs of a number.
pub trait Scalar: Sized {
    /// The product.
    fn times(&self, other: &Self) -> Self;
    /// The sum.
    fn plus(self, other: Self) -> Self;
    /// The difference.
    fn minus(self, other: Self) -> Self;
    /// The negative.
    fn negated(self) -> Self;
}

impl Scalar for IBig {
    fn times(&self, other: &Self) -> Self {
        self * other
    }

    fn plus(self, other: Self) -> Self {
        self + other
    }

    fn minus(self, other: Self) -> Self {
        self - other
    }

    fn negated(self) -> Self {
        -self
    }
}

/// A floating-point value with the sum of the magnitudes of all products that went into it.
///
/// The inputs are correctly rounded, so each carries a relative error of at most u = 2^-53. In a
/// chain of products and sums every product of inputs that ends up in the value gathers a factor
/// (1 + δ) with |δ| ≤ u for each input in it and each operation it passed. The longest chain here
/// is the product of a 4-vector with the cross product of three: four inputs, a product and a sum
/// for the 2×2 minor, a product and two sums for the 3×3 minor, a product and three sums for the
/// last: 4 + 2 + 3 + 4 = 13 factors. The error is hence at most 13u/(1 − 13u) times the true sum
/// of magnitudes, and the computed sum of magnitudes is below the true one by a relative 13u at
/// most for the same reason. `RELATIVE_ERROR` = 32u covers both and the rounding of the bound.
///
/// The argument needs products that do not underflow; `Homogeneous` admits only components of
/// magnitude zero or 2^-200 to 1, whose products of four stay far inside the normal range.
#[derive(Clone, Copy)]
pub struct Bounded {
    /// The computed value.
    value: f64,
    /// The sum of the magnitudes of the products in it.
    magnitude: f64,
}

/// The error of a `Bounded` over its magnitude: 32 · 2^-53.
const RELATIVE_ERROR: f64 = 1.0 / (1_u64 << 48) as f64;

impl Bounded {
    /// A correctly rounded input.
    pub fn new(value: f64) -> Self {
        Self { value, magnitude: value.abs() }
    }

    /// The sign of the exact value, where it is certain.
    pub fn sign(self) -> Option<Ordering> {
        let error = RELATIVE_ERROR * self.magnitude;
        if self.value > error {
            Some(Ordering::Greater)
        } else if self.value < -error {
            Some(Ordering::Less)
        } else if self.magnitude == 0.0 {
            Some(Ordering::Equal)
        } else {
            None
        }
    }
}

impl Scalar for Bounded {
    fn times(&self, other: &Self) -> Self {
        Self { value: self.value * other.value, magnitude: self.magnitude * other.magnitude }
    }

    fn plus(self, other: Self) -> Self {
        Self { value: self.value + other.value, magnitude: self.magnitude + other.magnitude }
    }

    fn minus(self, other: Self) -> Self {
        Self { value: self.value - other.value, magnitude: self.magnitude + other.magnitude }
    }

    fn negated(self) -> Self {
        Self { value: -self.value, ..self }
    }
}

/// The product of two 4-vectors.
pub fn dot<T: Scalar>(a: &[T; 4], b: &[T; 4]) -> T {
    let [p, q, r, s] = std::array::from_fn(|i| a[i].times(&b[i]));
    p.plus(q).plus(r).plus(s)
}

/// The 2×2 minors of two 4-vectors, their line's Plücker coordinates: 01, 02, 03, 12, 13, 23.
pub fn minors<T: Scalar>(a: &[T; 4], b: &[T; 4]) -> [T; 6] {
    [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)].map(|(i, j)| a[i].times(&b[j]).minus(a[j].times(&b[i])))
}

/// The cross product of two 4-vectors, given by their `minors`, and a third: orthogonal to all
/// three, and zero when they are dependent. As planes it is their common point, as points their
/// common plane, up to sign.
pub fn cross<T: Scalar>(minors: &[T; 6], c: &[T; 4]) -> [T; 4] {
    let [m01, m02, m03, m12, m13, m23] = minors;
    let [c0, c1, c2, c3] = c;
    let det = |p: (&T, &T), q: (&T, &T), r: (&T, &T)| p.0.times(p.1).minus(q.0.times(q.1)).plus(r.0.times(r.1));
    [
        det((c1, m23), (c2, m13), (c3, m12)),
        det((c0, m23), (c2, m03), (c3, m02)).negated(),
        det((c0, m13), (c1, m03), (c3, m01)),
        det((c0, m12), (c1, m02), (c2, m01)).negated(),
    ]
}
