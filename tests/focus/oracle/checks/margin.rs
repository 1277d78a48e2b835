//! Checks of the distance between empty and non-empty.

use super::shapes::{cuboid, tetrahedron, unit_cube};
use testkit::oracle::homogeneous::Homogeneous;
use testkit::oracle::margin::smallest_inflation;

/// The inflation of half-spaces given as `f64`.
fn inflation(planes: &[[f64; 4]]) -> f64 {
    let planes: Vec<_> = planes.iter().copied().map(Homogeneous::from_f64).collect();
    smallest_inflation(&planes)
}

#[test]
fn solid_bodies_have_the_inscribed_balls_radius() {
    assert!((inflation(&unit_cube()) + 0.5).abs() < 1e-3);
    let radius = 1.0 / (3.0 + 3.0_f64.sqrt());
    assert!((inflation(&tetrahedron()) + radius).abs() < 1e-3);
}

#[test]
fn flat_bodies_are_at_the_threshold() {
    assert_eq!(inflation(&cuboid([0.0; 3], [1.0, 1.0, 0.0])), 0.0);
    assert_eq!(inflation(&cuboid([0.5; 3], [0.5; 3])), 0.0);
}

#[test]
fn gaps_are_halved_between_their_sides() {
    for gap in [1e10, 1.0, 1e-15, 1e-30] {
        let planes = [[2.0, 0.0, 0.0, -2.0 * gap], [-3.0, 0.0, 0.0, 0.0]];
        let inflation = inflation(&planes);
        assert!((inflation / gap - 0.5).abs() < 1e-3, "{inflation:e}");
    }
    // A corner beyond a plane: three faces and the plane move together.
    let mut planes = unit_cube();
    planes.push([-1.0, -1.0, -1.0, -0.5]);
    let expected = 0.5 / (3.0 + 3.0_f64.sqrt());
    assert!((inflation(&planes) / expected - 1.0).abs() < 1e-3);
}

#[test]
fn what_no_offset_helps_is_infinite() {
    assert_eq!(inflation(&[[0.0, 0.0, 0.0, -1.0]]), f64::INFINITY);
    assert_eq!(inflation(&[[1.0, 0.0, 0.0, 0.0]]), f64::NEG_INFINITY);
}
