//! How far an intersection of half-spaces is from changing between empty and non-empty.

use dashu_int::IBig;
use dashu_int::ops::{SquareRoot, UnsignedAbs};

use crate::oracle::exact::{integers, power_of_two};
use crate::oracle::homogeneous::{ExactPlane, Homogeneous};
use crate::oracle::hull::homogeneous_vertices;

/// Extra bits a normal gets before its length is rounded to an integer, so that the length has a
/// relative error below 2^-64.
const LENGTH_BITS: usize = 64;

/// The exponents of the smallest and the largest offset told from zero and from infinity.
const OFFSET_RANGE: std::ops::Range<i64> = -120..80;

/// Bisections of an offset between two powers of two.
const REFINEMENTS: usize = 10;

/// The smallest outward offset of all half-spaces, as a distance, that makes their intersection
/// non-empty, to a relative 2^-10.
///
/// It is positive when the intersection is empty, and then rounded up: an intersection at that
/// offset is not empty. It is zero when the intersection is not empty but has no interior. It is
/// negative when there is an interior, and then the radius of the largest ball inside, negated and
/// rounded towards zero. It is infinite when no offset helps, or none is too large.
pub fn smallest_inflation(planes: &[ExactPlane]) -> f64 {
    let meets = |offset: f64| {
        let moved: Vec<ExactPlane> = planes.iter().map(|plane| moved(plane, offset)).collect();
        homogeneous_vertices(&moved).iter().any(|vertex| !vertex.vector.w().is_zero())
    };
    if meets(0.0) {
        // The offset grows until the intersection is empty; what is returned is the last that
        // leaves it non-empty.
        -threshold(|offset| !meets(-offset)).0
    } else {
        threshold(meets).1
    }
}

/// Neighbouring offsets, the predicate being false at the first and true at the second; it is
/// false before some offset and true from there on.
fn threshold(reached: impl Fn(f64) -> bool) -> (f64, f64) {
    let (mut low, mut high) = (OFFSET_RANGE.start, OFFSET_RANGE.end);
    if reached(power_of_two(low)) {
        return (0.0, power_of_two(low));
    }
    if !reached(power_of_two(high)) {
        return (f64::INFINITY, f64::INFINITY);
    }
    while high - low > 1 {
        let middle = low.midpoint(high);
        *(if reached(power_of_two(middle)) { &mut high } else { &mut low }) = middle;
    }
    let (mut low, mut high) = (power_of_two(low), power_of_two(high));
    for _ in 0..REFINEMENTS {
        let middle = low.midpoint(high);
        *(if reached(middle) { &mut high } else { &mut low }) = middle;
    }
    (low, high)
}

/// The half-space with its boundary moved outwards by an offset.
fn moved(plane: &ExactPlane, offset: f64) -> ExactPlane {
    let [x, y, z, d] = plane.coords().each_ref().map(|coord| coord << LENGTH_BITS);
    let length = (&x * &x + &y * &y + &z * &z).unsigned_abs().sqrt();
    let ([mantissa], exponent) = integers([offset]);
    // The offset's exponent, if negative, goes to the plane's other components instead.
    let (up, down) = (exponent.max(0) as usize, (-exponent).max(0) as usize);
    let shift = (mantissa * IBig::from(length)) << up;
    Homogeneous::new([x << down, y << down, z << down, (d << down) + shift]).reduced()
}
