//! Directions, magnitudes, and values a few ulps from another.

use proptest::prelude::*;
use shadowfit::glam::{DQuat, DVec3};

/// Any direction, evenly.
pub(super) fn direction() -> impl Strategy<Value = [f64; 3]> {
    (-1.0..1.0, 0.0..std::f64::consts::TAU).prop_map(|(z, angle): (f64, f64)| {
        let radius = (1.0 - z * z).sqrt();
        [radius * angle.cos(), radius * angle.sin(), z]
    })
}

/// The 26 directions to the faces, edges and corners of a cube.
pub(super) fn lattice_direction() -> impl Strategy<Value = [f64; 3]> {
    (0..26_u8).prop_map(|index| {
        // The 27 triples of −1, 0 and 1, without the one in their middle.
        let index = index + u8::from(index >= 13);
        [index % 3, index / 3 % 3, index / 9].map(|digit| f64::from(digit) - 1.0)
    })
}

/// Any rotation, evenly.
pub fn rotation() -> impl Strategy<Value = DQuat> {
    (direction(), 0.0..std::f64::consts::TAU)
        .prop_map(|(axis, angle)| DQuat::from_axis_angle(DVec3::from(axis).normalize(), angle))
}

/// A positive number whose logarithm is even over a range.
pub(super) fn magnitude(least: f64, most: f64) -> impl Strategy<Value = f64> {
    (least.ln()..most.ln()).prop_map(f64::exp)
}

/// Zero, either of them, ±10⁻ᵏ for k = 1 … 16, or a few of the smallest steps of numbers near 1.
pub(super) fn almost_zero() -> impl Strategy<Value = f64> {
    prop_oneof![
        Just(0.0),
        Just(-0.0),
        (1..=16_i32, any::<bool>()).prop_map(|(k, negative)| {
            let value = 10_f64.powi(-k);
            if negative { -value } else { value }
        }),
        (-4..=4_i32).prop_map(|ulps| f64::from(ulps) * f64::EPSILON),
    ]
}

/// A number moved by a few of its own ulps.
pub(super) fn nudged(value: f64, ulps: i8) -> f64 {
    let step = if ulps > 0 { f64::next_up } else { f64::next_down };
    (0..ulps.unsigned_abs()).fold(value, |value, _| step(value))
}

/// Any number there is: every pattern of bits, with more than their share of special values.
pub fn number_bits() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => any::<u64>().prop_map(f64::from_bits),
        4 => -10.0..10.0,
        2 => prop::sample::select(vec![
            0.0, -0.0, 1.0, -1.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY, f64::MAX,
            f64::MIN_POSITIVE, f64::from_bits(1), f64::EPSILON, 1e300, -1e300, 1e-300,
            shadowfit::input::MAX_COORDINATE, -shadowfit::input::MAX_COORDINATE, shadowfit::input::MIN_DISTANCE,
        ]),
    ]
}
