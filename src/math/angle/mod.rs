//! Sines, cosines and arctangents with the same bits on every platform, from sums, products and quotients alone.
//!
//! IEEE 754 specifies the rounding of +, −, ×, ÷ and the square root, but not of a library's sine, and libraries differ in the last
//! bit. The only angles in a fit are fields of view and spot angles, so that these functions make results the same everywhere.
//!
//! # Bounds
//!
//! With u = 2⁻⁵³, half an ulp at 1, and t up to about π/4: Taylor series to t¹⁷/17! and t¹⁸/18!, with a remainder below 10⁻¹⁸.
//!
//! ```text
//!     sin t = t + t³ P(t²)                |t³ P| ≤ 0.079: six roundings of its factors make 0.41 u,
//!                                         its sum with what reduction left over 0.07 u, the last sum half an ulp
//!     cos t = (1 − h) + r,  h = t²/2      h is off by u/4, t⁴ Q ≤ 0.016 by 0.1 u, 1 − h by nothing, because what it
//!                                         rounds off is exactly (1 − (1 − h)) − h and goes into r; half an ulp again
//! ```
//!
//! An ulp of a sine near 0.7, and of a cosine from there to 1, is u. Where the sine is smaller its ulp shrinks, and so do t and t³ P:
//! at ½ the error is 0.25 ulp. Both are off by less than one ulp. The angle of a vector is off by less than two: one rounding each
//! of the quotient, the series, the sum with the table's entry (106 bits), and the difference from π/2 or π.

use core::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

/// The difference between π/2 and its nearest f64.
const FRAC_PI_2_REST: f64 = 6.123_233_995_736_766e-17;

/// 1/n!, correctly rounded: up to 18! the factorial is exact.
const fn inverse_factorial(n: u32) -> f64 {
    let (mut factorial, mut factor) = (1_u64, 2);
    while factor <= n {
        factorial *= factor as u64;
        factor += 1;
    }
    1.0 / factorial as f64
}

/// Sine and cosine of an angle in [0, π] in radians, each to less than one ulp; angles outside are clamped.
#[inline]
pub(crate) fn sine_cosine(angle: f64) -> (f64, f64) {
    let angle = angle.clamp(0.0, PI);
    // The difference to a multiple of a right angle is exact, as both are within a factor of two of each other.
    if angle <= FRAC_PI_4 {
        series(angle, 0.0)
    } else if angle < 3.0 * FRAC_PI_4 {
        let (sine, cosine) = reduced(FRAC_PI_2 - angle, FRAC_PI_2_REST);
        (cosine, sine)
    } else {
        let (sine, cosine) = reduced(PI - angle, 2.0 * FRAC_PI_2_REST);
        (sine, -cosine)
    }
}

/// Sine and cosine of the sum of two numbers, the second a few ulps of a right angle and the first 0 or larger.
fn reduced(most: f64, rest: f64) -> (f64, f64) {
    let t = most + rest;
    series(t, (most - t) + rest)
}

/// Sine and cosine of `t + rest`, t no more than about π/4 and the rest at most half an ulp of it.
fn series(t: f64, rest: f64) -> (f64, f64) {
    const SINE: [f64; 8] = [
        -inverse_factorial(3),
        inverse_factorial(5),
        -inverse_factorial(7),
        inverse_factorial(9),
        -inverse_factorial(11),
        inverse_factorial(13),
        -inverse_factorial(15),
        inverse_factorial(17),
    ];
    const COSINE: [f64; 8] = [
        inverse_factorial(4),
        -inverse_factorial(6),
        inverse_factorial(8),
        -inverse_factorial(10),
        inverse_factorial(12),
        -inverse_factorial(14),
        inverse_factorial(16),
        -inverse_factorial(18),
    ];
    let square = t * t;
    let half = 0.5 * square;
    let most = 1.0 - half;
    let sine = t + (t * (square * polynomial(&SINE, square)) + rest * most);
    let cosine = most + (((1.0 - most) - half) + (square * square * polynomial(&COSINE, square) - t * rest));
    (sine, cosine)
}

/// The angle in [0, π] in radians between the x axis and the vector (x, y), y ≥ 0, to less than two ulps; 0 for the zero vector.
pub(crate) fn of_vector(x: f64, y: f64) -> f64 {
    let (steep, back) = (y > x.abs(), x < 0.0);
    let angle = if steep { arctangent(x.abs(), y) } else { arctangent(y, x.abs()) };
    match (steep, back) {
        (false, false) => angle,
        (true, false) => FRAC_PI_2 - (angle - FRAC_PI_2_REST),
        (true, true) => FRAC_PI_2 + (angle + FRAC_PI_2_REST),
        (false, true) => PI - (angle - 2.0 * FRAC_PI_2_REST),
    }
}

/// The arctangent of y/x where 0 ≤ y ≤ x; 0 where both are 0.
fn arctangent(y: f64, x: f64) -> f64 {
    /// Arctangents of k/8, each as an f64 and its remainder.
    const TABLE: [(f64, f64); 9] = [
        (0.0, 0.0),
        (0.124_354_994_546_761_44, -3.125_324_142_453_938_3e-18),
        (0.244_978_663_126_864_14, 1.069_875_561_873_445_1e-17),
        (0.358_770_670_270_572_25, -2.462_381_558_263_863_5e-17),
        (0.463_647_609_000_806_1, 2.269_877_745_296_168_7e-17),
        (0.558_599_315_343_562_4, -5.455_630_548_591_626_4e-18),
        (0.643_501_108_793_284_4, 1.583_478_505_144_428_6e-17),
        (0.718_829_999_621_624_5, -2.147_838_844_445_698_3e-17),
        (FRAC_PI_4, 0.5 * FRAC_PI_2_REST),
    ];
    const SERIES: [f64; 7] = [-1.0 / 3.0, 1.0 / 5.0, -1.0 / 7.0, 1.0 / 9.0, -1.0 / 11.0, 1.0 / 13.0, -1.0 / 15.0];
    if x <= 0.0 {
        return 0.0;
    }
    // arctan y/x = arctan k/8 + arctan z with |z| ≤ 1/16.
    let steps = (8.0 * y / x + 0.5) as usize;
    let (most, rest) = TABLE[steps.min(8)];
    let k = steps as f64;
    let z = (8.0 * y - k * x) / (8.0 * x + k * y);
    let square = z * z;
    most + (z + (z * (square * polynomial(&SERIES, square)) + rest))
}

/// c₀ + c₁ x + c₂ x² + …
fn polynomial(coefficients: &[f64], x: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, coefficient| sum * x + coefficient)
}

#[cfg(test)]
mod tests;
