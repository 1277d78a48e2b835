//! The axis of the narrowest cone around directions.

use crate::math::bounds::least;
use glam::DVec3;

/// The unit vector g that maximises the least `g · u` over unit vectors u, and that least value: the axis of the narrowest cone
/// around them and the cosine of its half angle. `None` where no half space holds them.
///
/// It points to the point of their convex hull nearest to the origin (Wolfe 1976) and is continuous in the directions. Decisions
/// compare distances from a supporting plane, not lengths: near the nearest point a length is constant to second order, so that
/// its rounding would cost half of the digits.
pub(crate) fn widest_margin(directions: &[DVec3]) -> Option<(DVec3, f64)> {
    /// Each step shortens the distance to the hull, so that the loop ends by itself but for rounding; this bounds it.
    const MAX_STEPS: usize = 64;
    let mut support = Support { points: [*directions.first()?; 3], len: 1 };
    let mut nearest = support.points[0];
    for _ in 0..MAX_STEPS {
        let (deepest, depth) = deepest(directions, nearest)?;
        // Closer to the supporting plane than this, a direction is on it but for rounding.
        if depth >= nearest.length_squared() - 4.0 * f64::EPSILON || support.contains(deepest) {
            break;
        }
        let (next, closer) = support.with(deepest);
        // The directions surround the origin: no face of three supports them.
        if closer.length_squared() > nearest.length_squared() + 4.0 * f64::EPSILON {
            break;
        }
        (support, nearest) = (next, closer);
    }
    let axis = nearest.try_normalize()?;
    let (_, margin) = deepest(directions, axis)?;
    (margin > 0.0).then_some((axis, margin))
}

/// The direction least along `axis`, and how far along it is.
fn deepest(directions: &[DVec3], axis: DVec3) -> Option<(DVec3, f64)> {
    let (mut at, mut depth) = (0, f64::INFINITY);
    for (index, direction) in directions.iter().enumerate() {
        let along = direction.dot(axis);
        if along < depth {
            (at, depth) = (index, along);
        }
    }
    directions.get(at).map(|&direction| (direction, depth))
}

/// The one to three corners of the face of the hull nearest to the origin so far.
#[derive(Clone, Copy)]
struct Support {
    points: [DVec3; 3],
    len: usize,
}

impl Support {
    fn contains(&self, point: DVec3) -> bool {
        self.points[..self.len].contains(&point)
    }

    /// Of the point and the edges and triangles that it spans with the corners: the one whose foot of the perpendicular from the
    /// origin supports all corners, or comes closest to it.
    fn with(&self, point: DVec3) -> (Self, DVec3) {
        let corners = &self.points[..self.len];
        let mut best = (Self { points: [point; 3], len: 1 }, point);
        let mut most = f64::NEG_INFINITY;
        let mut consider = |points: [DVec3; 3], len: usize, nearest: Option<DVec3>| {
            let Some(nearest) = nearest else { return };
            let beyond = |corner: &DVec3| (*corner - nearest).dot(nearest);
            let supported = corners.iter().map(beyond).fold(beyond(&point), least);
            if supported > most {
                (best, most) = ((Self { points, len }, nearest), supported);
            }
        };
        consider([point; 3], 1, Some(point));
        for (index, &a) in corners.iter().enumerate() {
            consider([point, a, a], 2, nearest_of_edge(point, a));
            for &b in &corners[index + 1..] {
                consider([point, a, b], 3, nearest_of_triangle(point, a, b));
            }
        }
        best
    }
}

/// The foot of the perpendicular from the origin, if it falls inside the edge.
fn nearest_of_edge(a: DVec3, b: DVec3) -> Option<DVec3> {
    let edge = b - a;
    let t = -a.dot(edge) / edge.length_squared();
    (t > 0.0 && t < 1.0).then(|| a + edge * t)
}

/// The foot of the perpendicular from the origin, if it falls inside the triangle.
fn nearest_of_triangle(a: DVec3, b: DVec3, c: DVec3) -> Option<DVec3> {
    let normal = (b - a).cross(c - a);
    let inside = normal.dot(b.cross(c)) > 0.0 && normal.dot(c.cross(a)) > 0.0 && normal.dot(a.cross(b)) > 0.0;
    inside.then(|| normal * (normal.dot(a) / normal.length_squared()))
}

#[cfg(test)]
mod tests {
    extern crate std;

    use super::*;
    use proptest::prelude::*;
    use std::vec::Vec;

    /// The widest margin of the axes through the directions, between two of them, and as far from three of them.
    fn by_trying_all(directions: &[DVec3]) -> f64 {
        let mut axes = directions.to_vec();
        for (i, a) in directions.iter().enumerate() {
            for (j, b) in directions.iter().enumerate().skip(i + 1) {
                axes.push(*a + *b);
                axes.extend(directions[j + 1..].iter().map(|c| (*b - *a).cross(*c - *a)));
            }
        }
        let margin = |axis: DVec3| directions.iter().map(|direction| direction.dot(axis)).fold(1.0, least);
        let axes = axes.into_iter().filter_map(DVec3::try_normalize);
        axes.flat_map(|axis| [margin(axis), margin(-axis)]).fold(-1.0, f64::max)
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 20_000, failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn no_axis_has_a_wider_margin(
            directions in prop::collection::vec(prop::array::uniform3(-1.0..1.0), 1..9),
            spread in prop_oneof![Just(0.01), 0.1..3.0, Just(3.0)],
            few in any::<bool>(),
        ) {
            // About one direction, some of them the same or on one cone about it.
            let about = |direction: &[f64; 3]| {
                let direction = DVec3::from(*direction) * spread;
                let direction = if few { direction.round() } else { direction };
                (direction + DVec3::Z).try_normalize()
            };
            let directions: Vec<DVec3> = directions.iter().filter_map(about).collect();
            prop_assume!(!directions.is_empty());
            let best = by_trying_all(&directions);
            match widest_margin(&directions) {
                Some((axis, margin)) => {
                    prop_assert!((axis.length() - 1.0).abs() <= 1e-15);
                    prop_assert!((margin - best).abs() <= 1e-12, "{} of {}", margin, best);
                }
                // At no margin at all rounding decides.
                None => prop_assert!(best <= 1e-12, "none of {}", best),
            }
        }
    }
}
