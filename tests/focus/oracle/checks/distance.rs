//! Checks of the distance to a body.

use super::random::Random;
use super::shapes::{cuboid, tetrahedron, unit_cube};
use testkit::oracle::body::Body;

/// Asserts a distance to a relative 1e-14.
fn assert_distance(planes: &[[f64; 4]], point: [f64; 3], expected: f64) {
    let distance = Body::from_planes(planes).distance(point);
    assert!((distance - expected).abs() <= 1e-14 * expected, "{distance:e} is not {expected:e}");
}

#[test]
fn zero_inside_and_on_the_boundary() {
    for point in [[0.5; 3], [0.0; 3], [1.0, 0.5, 0.5], [1.0, 0.0, 0.5]] {
        assert_distance(&unit_cube(), point, 0.0);
    }
    assert!(Body::from_planes(&unit_cube()).contains([0.0, 1.0, 0.5]));
    assert!(!Body::from_planes(&unit_cube()).contains([0.0, 1.0, -5e-324]));
}

#[test]
fn faces_edges_and_corners_at_all_sizes() {
    for size in [1e10, 1.0, 1e-15, 1e-20, 1e-180] {
        assert_distance(&unit_cube(), [-size, 0.5, 0.25], size);
        assert_distance(&unit_cube(), [-3.0 * size, -4.0 * size, 0.25], 5.0 * size);
        assert_distance(&unit_cube(), [-size, -2.0 * size, -2.0 * size], 3.0 * size);
    }
    // Beside coordinates of another size only a few ulps are left to be outside by.
    let ulp = f64::EPSILON;
    assert_distance(&unit_cube(), [1.0 + ulp, 0.5, 0.25], ulp);
    assert_distance(&unit_cube(), [1.0 + 3.0 * ulp, 1.0 + 4.0 * ulp, 0.25], 5.0 * ulp);
}

#[test]
fn oblique_face_at_the_last_bit() {
    let third = 3.0_f64.sqrt();
    assert_distance(&tetrahedron(), [1.0, 1.0, 1.0], 2.0 / third);
    assert_distance(&tetrahedron(), [0.25, 0.25, 0.5 + f64::EPSILON], f64::EPSILON / third);
    // Beyond the face's own edge, though only one half-space is violated.
    assert_distance(&tetrahedron(), [0.0, 1.0, 1.0], 0.5_f64.sqrt());
    assert_distance(&tetrahedron(), [0.0, 0.0, 3.0], 2.0);
}

#[test]
fn flat_bodies_segments_and_points() {
    let flat = cuboid([0.0, 0.0, 0.5], [1.0, 1.0, 0.5]);
    assert_distance(&flat, [0.25, 0.75, 0.5], 0.0);
    assert_distance(&flat, [0.25, 0.75, 0.5 + f64::EPSILON], f64::EPSILON);
    assert_distance(&flat, [0.25, 1.75, 0.5], 0.75);
    assert_distance(&flat, [4.0, 1.0, 4.5], 5.0);
    let segment = cuboid([0.0, 1.0, 0.0], [2.0, 1.0, 0.0]);
    assert_distance(&segment, [1.0, 1.0, 1e-20], 1e-20);
    assert_distance(&segment, [1.0, 4.0, 4.0], 5.0);
    assert_distance(&segment, [5.0, 5.0, 0.0], 5.0);
    let point = cuboid([1.0; 3], [1.0; 3]);
    assert_distance(&point, [1.0, 4.0, 5.0], 5.0);
    let empty = Body::from_planes(&[[0.0, 0.0, 0.0, -1.0]]);
    assert_eq!(empty.distance([0.0; 3]), f64::INFINITY);
}

#[test]
fn bodies_of_any_size() {
    for size in [1e-200, 1e200] {
        let cube = cuboid([0.0; 3], [size; 3]);
        assert_distance(&cube, [2.0 * size, 0.5 * size, 0.25 * size], size);
        assert_distance(&cube, [4.0 * size, 5.0 * size, 0.25 * size], 5.0 * size);
        assert_distance(&cube, [2.0 * size, 3.0 * size, 3.0 * size], 3.0 * size);
    }
}

/// Bounds on the distance from the origin to the hull of points: the norm of the point that
/// Frank and Wolfe's iteration arrives at, and how far the plane there separates.
fn bounds(points: &[[f64; 3]]) -> (f64, f64) {
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let mut x = points[0];
    let mut lower = 0.0_f64;
    for _ in 0..2000 {
        let nearest =
            points.iter().copied().min_by(|&a, &b| dot(a, x).total_cmp(&dot(b, x))).expect("there are points");
        lower = lower.max(dot(nearest, x) / dot(x, x).sqrt());
        let step: [f64; 3] = std::array::from_fn(|i| nearest[i] - x[i]);
        let length2 = dot(step, step);
        if length2 == 0.0 {
            break;
        }
        let parameter = (-dot(x, step) / length2).clamp(0.0, 1.0);
        x = std::array::from_fn(|i| x[i] + parameter * step[i]);
    }
    (lower, dot(x, x).sqrt())
}

#[test]
fn random_distances_lie_within_bounds() {
    let mut random = Random::new(6);
    let (mut outside, mut slack) = (0, 0.0);
    for _ in 0..300 {
        let mut planes = cuboid([-1.0; 3], [1.0; 3]);
        for _ in 0..random.integer(0, 8) {
            planes.push(std::array::from_fn(|_| random.signed()));
        }
        let body = Body::from_planes(&planes);
        let point: [f64; 3] = std::array::from_fn(|_| 2.0 * random.signed());
        if body.is_empty() || body.contains(point) {
            continue;
        }
        let seen: Vec<[f64; 3]> =
            body.vertices_f64().into_iter().map(|vertex| std::array::from_fn(|i| vertex[i] - point[i])).collect();
        let (lower, upper) = bounds(&seen);
        let distance = body.distance(point);
        assert!(distance >= lower - 1e-14 && distance <= upper + 1e-14);
        outside += 1;
        slack += (upper - lower) / upper;
    }
    assert!(outside > 100);
    assert!(slack / f64::from(outside) < 0.01, "the bounds are tight");
}
