//! The crate's own sines, cosines and angles of vectors against integers of 220 bits, and against the platform's.

#![allow(clippy::disallowed_methods, reason = "the platform's functions are what these are compared with")]

use super::{of_vector, sine_cosine};
use dashu_int::IBig;
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};
use std::println;

/// Numbers are multiples of 2⁻²²⁰: a sine of 10⁻⁹ is known to 190 bits, and no f64 from 10⁻¹⁰ on loses one.
const BITS: usize = 220;

/// An f64 as a multiple of 2⁻²²⁰.
fn fixed(value: f64) -> IBig {
    let bits = value.abs().to_bits();
    let exponent = (bits >> 52) as usize;
    let mantissa = IBig::from(bits & ((1 << 52) - 1) | 1 << 52) << BITS;
    let magnitude = match value {
        0.0 => IBig::ZERO,
        _ if exponent >= 1075 => mantissa << (exponent - 1075),
        _ => mantissa >> (1075 - exponent),
    };
    if value < 0.0 { -magnitude } else { magnitude }
}

fn times(a: &IBig, b: &IBig) -> IBig {
    (a * b) >> BITS
}

/// Sine and cosine of an f64 by Taylor's series, to some units of 2⁻²²⁰.
fn exact(angle: f64) -> [IBig; 2] {
    let x = fixed(angle);
    let (mut term, mut sums) = (fixed(1.0), [IBig::ZERO, IBig::ZERO]);
    for n in 0..100_i32 {
        let sum = &mut sums[usize::from(n % 2 == 0)];
        *sum += if n % 4 < 2 { term.clone() } else { -term.clone() };
        term = times(&term, &x) / (n + 1);
    }
    sums
}

/// How far a number is from an exact one, in ulps: of those on either side of it the smaller.
fn ulps(value: f64, exact: &IBig) -> f64 {
    let ulp = (value.next_up() - value).min(value - value.next_down());
    (fixed(value) - exact).to_f64().value() / fixed(ulp).to_f64().value()
}

/// Angles all over [0, π], towards its ends and a right angle, and about where one series gives way to another.
fn angles(count: usize) -> impl Iterator<Item = f64> {
    let mut random = StdRng::seed_from_u64(0x616e_676c_6573);
    let ends = [0.0, 1e-9, FRAC_PI_4, FRAC_PI_2 - 1e-9, FRAC_PI_2, 3.0 * FRAC_PI_4, PI - 1e-9, PI];
    let about = ends.into_iter().flat_map(|end| {
        let (mut down, mut up) = (end, end);
        std::iter::from_fn(move || {
            (down, up) = (down.next_down(), up.next_up());
            Some([down, up])
        })
        .take(50)
        .flatten()
        .chain([end])
    });
    about.filter(|angle| *angle == 0.0 || (1e-10..=PI).contains(angle)).chain((0..count).map(move |at| {
        let spread = random.random_range(0.0..1.0);
        let near = 1e-9_f64.powf(spread);
        match at % 4 {
            0 | 1 => spread * PI,
            2 => near * FRAC_PI_4,
            _ => FRAC_PI_2 + near * if at % 8 == 3 { FRAC_PI_4 } else { -FRAC_PI_4 },
        }
    }))
}

#[test]
fn sines_and_cosines_are_off_by_less_than_an_ulp() {
    let mut worst = [0.0_f64; 2];
    for angle in angles(100_000) {
        let (sine, cosine) = sine_cosine(angle);
        for (worst, (value, exact)) in worst.iter_mut().zip([sine, cosine].into_iter().zip(exact(angle))) {
            let off = if exact == IBig::ZERO { value } else { ulps(value, &exact) };
            assert!(off.abs() < 1.0, "{angle:e}: {value:e} is off by {off} ulps");
            *worst = worst.max(off.abs());
        }
    }
    println!("the worst sine is off by {:.3} ulps, the worst cosine by {:.3}", worst[0], worst[1]);
}

/// Two numbers that are each off by less than an ulp are the same or next to each other. An ulp may be half as large
/// on one side of a power of two.
#[test]
fn sines_and_cosines_are_the_platforms_or_next_to_them() {
    let mut other = 0;
    for angle in angles(4_000_000) {
        let (sine, cosine) = sine_cosine(angle);
        for (value, platform) in [(sine, angle.sin()), (cosine, angle.cos())] {
            let next = [platform.next_down(), platform, platform.next_up()];
            assert!(next.contains(&value), "{angle:e}: {value:e} and {platform:e}");
            other += u32::from(value != platform);
        }
    }
    println!("{other} of 8000000 differ from the platform's in the last bit");
}

#[test]
fn angles_of_vectors_are_off_by_less_than_two_ulps() {
    let mut random = StdRng::seed_from_u64(0x7665_6374_6f72);
    let mut worst = 0.0_f64;
    for angle in angles(50_000) {
        let length = random.random_range(0.5..2.0) * 2.0_f64.powi(random.random_range(-20..20));
        let (x, y) = (length * angle.cos(), (length * angle.sin()).max(0.0));
        let found = of_vector(x, y);
        assert!((0.0..=PI).contains(&found), "({x:e}, {y:e}): {found:e}");
        // The sine of what is missing, times the length.
        let [sine, cosine] = exact(found);
        let off = (times(&fixed(y), &cosine) - times(&fixed(x), &sine)).to_f64().value();
        let missing = off / fixed(x.hypot(y)).to_f64().value();
        if found == 0.0 {
            assert_eq!(y, 0.0, "({x:e}, {y:e})");
            continue;
        }
        let ulps = missing / (found.next_up() - found);
        assert!(ulps.abs() < 2.0, "({x:e}, {y:e}): {found:e} is off by {ulps} ulps");
        worst = worst.max(ulps.abs());
    }
    println!("the worst angle is off by {worst:.3} ulps");
}

#[test]
fn ends_are_exact() {
    assert_eq!(sine_cosine(0.0), (0.0, 1.0));
    assert_eq!(sine_cosine(1e-9), (1e-9, 1.0));
    assert_eq!(sine_cosine(FRAC_PI_2), (1.0, 6.123_233_995_736_766e-17));
    assert_eq!(sine_cosine(PI), (1.224_646_799_147_353_2e-16, -1.0));
    // Outside: the nearer end.
    assert_eq!(sine_cosine(-1.0), (0.0, 1.0));
    assert_eq!(sine_cosine(4.0), sine_cosine(PI));
    assert!(sine_cosine(f64::NAN).0.is_nan());

    assert_eq!(of_vector(3.0, 0.0), 0.0);
    assert_eq!(of_vector(2.0, 2.0), FRAC_PI_4);
    assert_eq!(of_vector(0.0, 5.0), FRAC_PI_2);
    assert_eq!(of_vector(-7.0, 7.0), 3.0 * FRAC_PI_4);
    assert_eq!(of_vector(-1e-9, 0.0), PI);
    assert_eq!(of_vector(0.0, 0.0), 0.0);
}
