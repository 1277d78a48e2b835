//! Numbers of twice the precision with a bound on their error.

use crate::oracle::scalar::Scalar;

/// A sum of two `f64` with the sum of the magnitudes of all products that went into it.
///
/// Every product is exact but for the product of the two low parts and the roundings of low parts, and so is every
/// sum; each of them is below 2^-102 of the magnitudes it is made of. No chain of products and sums here is longer
/// than 40 operations, whose errors hence stay below 2^-96 of the magnitude; `RELATIVE_ERROR` leaves two bits for the
/// rounding of the magnitude and of the bound itself.
///
/// The argument needs products that neither overflow nor underflow: `admits` holds each input to a magnitude of zero or
/// 2^-150 to 2^150, and no value is a product of more than five. What cancellation leaves may be smaller than any such
/// product, but the magnitude is not, and what underflows then is far below the bound.
#[derive(Clone, Copy, Debug)]
pub struct Precise {
    high: f64,
    low: f64,
    magnitude: f64,
}

/// The error of a `Precise` over its magnitude: 2^-94.
const RELATIVE_ERROR: f64 = 1.0 / (1_u128 << 94) as f64;

/// The magnitudes that inputs may have: 2^-150 to 2^150, a little narrower.
const RANGE: std::ops::RangeInclusive<f64> = 1e-45..=1e45;

/// Whether the error bound holds for inputs of these values.
pub fn admits(values: &[f64]) -> bool {
    values.iter().all(|value| *value == 0.0 || RANGE.contains(&value.abs()))
}

impl Precise {
    /// An exact input.
    pub fn new(value: f64) -> Self {
        Self { high: value, low: 0.0, magnitude: value.abs() }
    }

    /// The nearest `f64`.
    pub fn value(&self) -> f64 {
        self.high
    }

    /// How far the exact value may be from the computed one.
    pub fn error(&self) -> f64 {
        RELATIVE_ERROR * self.magnitude
    }

    /// A number that the exact value is not below.
    pub fn lower(&self) -> f64 {
        // The low part is at most half of the step to the next number.
        (self.high.next_down() - self.error()).next_down()
    }

    /// A number that the exact value is not above.
    pub fn upper(&self) -> f64 {
        (self.high.next_up() + self.error()).next_up()
    }
}

impl Scalar for Precise {
    fn times(&self, other: &Self) -> Self {
        let (high, rest) = two_product(self.high, other.high);
        let (high, low) = two_sum(high, rest + (self.high * other.low + self.low * other.high));
        Self { high, low, magnitude: self.magnitude * other.magnitude }
    }

    fn plus(self, other: Self) -> Self {
        let (high, rest) = two_sum(self.high, other.high);
        let (high, low) = two_sum(high, rest + (self.low + other.low));
        Self { high, low, magnitude: self.magnitude + other.magnitude }
    }

    fn minus(self, other: Self) -> Self {
        self.plus(other.negated())
    }

    fn negated(self) -> Self {
        Self { high: -self.high, low: -self.low, ..self }
    }
}

/// A sum and its rounding, whatever their order of size (Knuth).
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let of_b = sum - a;
    (sum, (a - (sum - of_b)) + (b - of_b))
}

/// A product and its rounding, by halves of 26 bits (Dekker).
fn two_product(a: f64, b: f64) -> (f64, f64) {
    let halves = |x: f64| {
        let shifted = 134_217_729.0 * x;
        let high = shifted - (shifted - x);
        (high, x - high)
    };
    let product = a * b;
    let ((ah, al), (bh, bl)) = (halves(a), halves(b));
    (product, ((ah * bh - product) + ah * bl + al * bh) + al * bl)
}
