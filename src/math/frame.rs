//! The frame of a map: two axes across a direction, as continuous in it as a sphere allows.

use glam::DVec3;

/// Two unit axes at right angles to the unit direction `along` and to each other, for a view with the unit axes `forward` and `up`.
///
/// The second axis is the part of `forward` across `along`, which aligns the map with the direction of the view's warp. For light
/// along the view that part vanishes; there the frame is the one of light from above, `along = −up`, turned the shortest way. In
/// between the two are mixed in proportion to the part of `forward` across `along`:
///
/// ```text
///     along = −up:          second = forward      (light from above)
///     along = forward:      second = up           (light from behind the viewer)
///     along = −forward:     second = −up          (light from before the viewer)
///     along = ±right:       second = forward      (light from the side)
/// ```
///
/// No field of frames is continuous on all of a sphere. This one jumps in two directions, at 60° from `up` in the plane of
/// `forward` and `up`: light from 30° below the horizon, exactly ahead or behind.
pub(crate) fn across(along: DVec3, forward: DVec3, up: DVec3) -> (DVec3, DVec3) {
    let seen = forward - along * forward.dot(along);
    // Turning −up to `along` is, for vectors across −up, a reflection in the plane across their sum.
    let sum = along - up;
    let turned = if sum.length_squared() > 0.0 {
        forward - sum * (2.0 * forward.dot(sum) / sum.length_squared())
    } else {
        DVec3::ZERO
    };
    let mixed = seen + turned * (1.0 - seen.length()).max(0.0);
    let second = (mixed - along * mixed.dot(along)).try_normalize();
    let second = second.unwrap_or_else(|| along.any_orthonormal_vector());
    (along.cross(second).normalize(), second)
}

/// The frame of a light alone, independent of the view: that of a view along the world's −z with y up.
pub(crate) fn of_light(axis: DVec3) -> (DVec3, DVec3) {
    across(axis, DVec3::NEG_Z, DVec3::Y)
}
