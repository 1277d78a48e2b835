//! The narrowest cone from a local light around the receivers.

use crate::convex::{Plane, PlaneId, Polyhedron};
use crate::focus::surrounded::Surrounded;
use crate::math::axis::widest_margin;
use glam::DVec3;

/// Why there is no such cone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum NoCone {
    /// All that is visible is where the light is, or nearer to it than anything casts.
    Nothing,
    /// No frustum holds what is visible.
    Surrounded(Surrounded),
}

/// The least cosine of half the opening of a frustum, that of [`Surrounded::MAX_HALF_ANGLE`]. A light nearer to what is
/// visible than that stands among it, as far as a single map is concerned.
pub(crate) const MIN_MARGIN: f64 = 1.0 / 512.0;

/// The axis of the narrowest cone from a light at a position around a body, and the least cosine to it.
///
/// A corner of the body where the light is has no direction, and needs none: the edges that end there have theirs at their other
/// ends. What is around it, up to the light's near distance, is cut off, so that w is positive on what is left. `each` is told
/// the plane.
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
        // The near distance may be lost in the rounding of the position.
        if body.positions().any(|point| direction_between(position, point).is_none()) {
            return Err(surrounded(margin));
        }
    }
    Ok((axis, margin))
}

/// The unit direction from a light to a visible point. A light a few roundings away from what is visible is on its boundary,
/// and it has none.
pub(crate) fn direction_between(position: DVec3, point: DVec3) -> Option<DVec3> {
    let arm = point - position;
    let distance = arm.length();
    (distance > ROUNDINGS * (point.abs() + position.abs()).max_element()).then(|| arm / distance)
}

/// What a vertex may be away from the exact one where its planes meet squarely: their slack, and its roundings.
const ROUNDINGS: f64 = 2.0 * Plane::SLACK;
