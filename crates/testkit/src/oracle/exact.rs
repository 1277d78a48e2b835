//! The door between `f64` and integers: in without rounding, out with one rounding.

use dashu_int::ops::{BitTest, DivRem, UnsignedAbs};
use dashu_int::{IBig, UBig};

/// Explicit mantissa bits of an `f64`.
const MANTISSA_BITS: u32 = 52;

/// Quotient bits kept before the rounding to `f64`: more than 53 + 2, so that with a sticky last
/// bit the one rounding is correct.
const QUOTIENT_BITS: i64 = 66;

/// Integers `n` and an exponent `e` with `values[i] = n[i] · 2^e`, exactly.
///
/// # Panics
///
/// When a value is not finite.
pub fn integers<const N: usize>(values: [f64; N]) -> ([IBig; N], i64) {
    let parts = values.map(decompose);
    let exponent =
        parts.iter().filter(|(mantissa, _)| *mantissa != 0).map(|&(_, exponent)| exponent).min().unwrap_or(0);
    let scaled = parts.map(|(mantissa, own)| match mantissa {
        0 => IBig::ZERO,
        _ => IBig::from(mantissa) << (own - exponent) as usize,
    });
    (scaled, exponent)
}

/// The signed mantissa `m` and the exponent `e` of `value = m · 2^e`.
fn decompose(value: f64) -> (i64, i64) {
    assert!(value.is_finite(), "the oracle takes finite numbers only");
    let bits = value.to_bits();
    let biased = (bits >> MANTISSA_BITS & 0x7ff) as i64;
    let fraction = (bits & ((1 << MANTISSA_BITS) - 1)) as i64;
    let (mantissa, exponent) = match biased {
        0 => (fraction, -1074),
        _ => (fraction | 1 << MANTISSA_BITS, biased - 1075),
    };
    (if value.is_sign_negative() { -mantissa } else { mantissa }, exponent)
}

/// `value = f · 2^e` with `f` correctly rounded; `f` is zero only when the value is.
pub fn leading(value: &IBig) -> (f64, i64) {
    let magnitude = value.unsigned_abs();
    let dropped = magnitude.bit_len().saturating_sub(64);
    let sticky = magnitude.trailing_zeros().is_some_and(|zeros| zeros < dropped);
    let top = u64::try_from(magnitude >> dropped).expect("64 bits are kept");
    let rounded = (top | u64::from(sticky)) as f64;
    (if *value < IBig::ZERO { -rounded } else { rounded }, dropped as i64)
}

/// `numerator / denominator · 2^exponent`, correctly rounded (twice among subnormal numbers).
///
/// # Panics
///
/// When the denominator is not positive.
pub fn ratio(numerator: &IBig, denominator: &IBig, exponent: i64) -> f64 {
    assert!(*denominator > IBig::ZERO, "a ratio's denominator is positive");
    if numerator.is_zero() {
        return 0.0;
    }
    let magnitude = numerator.unsigned_abs();
    let denominator = denominator.unsigned_abs();
    let shift = QUOTIENT_BITS - magnitude.bit_len() as i64 + denominator.bit_len() as i64;
    let quotient = scale(shifted_quotient(magnitude, denominator, shift), exponent - shift);
    if *numerator < IBig::ZERO { -quotient } else { quotient }
}

/// The square root of `numerator / denominator`, to within an ulp.
pub fn sqrt_ratio(numerator: UBig, denominator: UBig) -> f64 {
    if numerator.is_zero() {
        return 0.0;
    }
    let shift = QUOTIENT_BITS - numerator.bit_len() as i64 + denominator.bit_len() as i64;
    // An even shift is a whole power of two once the root is taken.
    let shift = shift - shift.rem_euclid(2);
    scale(shifted_quotient(numerator, denominator, shift).sqrt(), -shift / 2)
}

/// `numerator · 2^shift / denominator`, correctly rounded, for a shift that leaves about
/// `QUOTIENT_BITS` bits in the quotient.
fn shifted_quotient(numerator: UBig, denominator: UBig, shift: i64) -> f64 {
    let (numerator, denominator) = if shift >= 0 {
        (numerator << shift as usize, denominator)
    } else {
        (numerator, denominator << shift.unsigned_abs() as usize)
    };
    let (quotient, remainder) = numerator.div_rem(denominator);
    let quotient = u128::try_from(quotient).expect("the shift bounds the quotient");
    (quotient | u128::from(!remainder.is_zero())) as f64
}

/// `value · 2^exponent`, for any exponent.
pub fn scale(value: f64, exponent: i64) -> f64 {
    // Beyond this the result is zero or infinite whatever the value.
    let mut left = exponent.clamp(-3000, 3000);
    let mut value = value;
    while left != 0 {
        let step = left.clamp(-1000, 1000);
        value *= power_of_two(step);
        left -= step;
    }
    value
}

/// 2^exponent for an exponent of the normal range.
pub fn power_of_two(exponent: i64) -> f64 {
    f64::from_bits(((exponent + 1023) as u64) << MANTISSA_BITS)
}
