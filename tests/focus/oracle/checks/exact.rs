//! Checks of the conversions between `f64` and integers.

use dashu_int::{IBig, UBig};

use super::random::Random;
use testkit::oracle::exact::{integers, leading, ratio, scale, sqrt_ratio};

/// What goes in comes out again, across the whole range of `f64`.
#[test]
fn conversions_round_trip() {
    let mut random = Random::new(1);
    for _ in 0..2000 {
        let values: [f64; 2] = std::array::from_fn(|_| scale(random.signed(), random.integer(-1080, 1020)));
        let (whole, exponent) = integers(values);
        for (value, whole) in values.iter().zip(&whole) {
            assert_eq!(ratio(whole, &IBig::ONE, exponent), *value);
            let (mantissa, shift) = leading(whole);
            assert_eq!(scale(mantissa, shift + exponent), *value);
        }
    }
    assert_eq!(integers([0.0, -0.0]).0, [IBig::ZERO, IBig::ZERO]);
    assert_eq!(integers([f64::MIN_POSITIVE, 5e-324]).0[1], IBig::ONE);
}

/// A ratio is the nearest `f64`, as division of exactly representable integers is.
#[test]
fn ratios_round_to_nearest() {
    let mut random = Random::new(2);
    for _ in 0..2000 {
        let a = random.integer(-(1 << 53), 1 << 53);
        let b = random.integer(1, 1 << 53);
        assert_eq!(ratio(&a.into(), &b.into(), 0), a as f64 / b as f64);
        // The same with operands far beyond the range of `f64`.
        let (a_long, b_long) = (IBig::from(a) << 3000, IBig::from(b) << 3100);
        assert_eq!(ratio(&a_long, &b_long, 100), a as f64 / b as f64);
    }
}

/// Ties and values just beside a tie round as they should.
#[test]
fn rounding_sees_the_last_bit() {
    let tie = (IBig::ONE << 200) + (IBig::ONE << 147);
    let one = IBig::ONE << 200;
    assert_eq!(ratio(&tie, &one, 0), 1.0);
    assert_eq!(ratio(&(&tie + 1), &one, 0), 1.0 + f64::EPSILON);
    assert_eq!(leading(&tie), ((1_u64 << 63) as f64, 137));
    let (above, _) = leading(&(&tie + 1));
    assert_eq!(above, (1_u64 << 63) as f64 * (1.0 + f64::EPSILON));
}

/// Square roots of squares are exact at any size.
#[test]
fn roots_of_squares_are_exact() {
    let mut random = Random::new(3);
    for _ in 0..1000 {
        let a = random.integer(1, 1 << 53) as u64;
        let b = random.integer(0, 400) as usize;
        let square = UBig::from(a).sqr();
        assert_eq!(sqrt_ratio(square.clone() << (2 * b), UBig::ONE), { scale(a as f64, b as i64) });
        assert_eq!(sqrt_ratio(square, UBig::ONE << (2 * b)), { scale(a as f64, -(b as i64)) });
    }
}
