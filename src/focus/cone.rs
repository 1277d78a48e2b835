//! The narrowest cone from a local light around the receivers.

use crate::convex::{Plane, PlaneId, Polyhedron};
use crate::focus::surrounded::Surrounded;
use crate::math::axis::widest_margin;
use glam::DVec3;

/// Why there is no such cone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum NoCone {
    /// All receivers are at the light, or within its near distance.
    Nothing,
    /// No frustum holds all receivers.
    Surrounded(Surrounded),
}

/// The cosine of [`Surrounded::MAX_HALF_ANGLE`], the least of a frustum: with a wider cone the light counts as surrounded.
pub(crate) const MIN_MARGIN: f64 = 1.0 / 512.0;

/// The axis of the narrowest cone from a local light around a body, and the cosine of its half angle.
///
/// A corner at the light itself has no direction and needs none: the other ends of its edges have theirs. The part around it up to
/// the near distance is cut off, so that w is positive on the rest; `each` is called with the cutting plane.
pub(crate) fn leave_corner(
    position: DVec3,
    near: f64,
    body: &mut Polyhedron,
    mut each: impl FnMut(Plane, PlaneId),
) -> Result<(DVec3, f64), NoCone> {
    const NAME: PlaneId = Polyhedron::MAX_PLANES as PlaneId - 1;
    let surrounded = |cosine| NoCone::Surrounded(Surrounded::by(cosine));
    let mut directions = [DVec3::ZERO; Polyhedron::MAX_VERTICES];
    let (mut len, mut extent, mut in_corner) = (0, position.abs(), false);
    for point in body.positions() {
        extent = extent.max(point.abs());
        match direction_between(position, point) {
            Some(direction) => (directions[len], len) = (direction, len + 1),
            None => in_corner = true,
        }
    }
    if len == 0 {
        return Err(NoCone::Nothing);
    }
    let (axis, margin) = widest_margin(&directions[..len]).ok_or(surrounded(0.0))?;
    if margin < MIN_MARGIN {
        return Err(surrounded(margin));
    }
    if in_corner {
        let beyond = (Plane::through(axis, position) - Plane::ONE * (near * margin)).loosened(extent);
        body.clip(&beyond, NAME);
        each(beyond, NAME);
        if body.is_empty() {
            return Err(NoCone::Nothing);
        }
        // The near distance may vanish in the rounding of the position.
        if body.positions().any(|point| direction_between(position, point).is_none()) {
            return Err(surrounded(margin));
        }
    }
    Ok((axis, margin))
}

/// The unit direction from a light to a receiver point; `None` where they are equal up to rounding.
pub(crate) fn direction_between(position: DVec3, point: DVec3) -> Option<DVec3> {
    let arm = point - position;
    let distance = arm.length();
    (distance > ROUNDINGS * (point.abs() + position.abs()).max_element()).then(|| arm / distance)
}

/// How far a vertex may be from the exact one where its planes meet at right angles: their slack, and its own rounding.
const ROUNDINGS: f64 = 2.0 * Plane::SLACK;
