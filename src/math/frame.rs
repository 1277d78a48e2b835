//! The frame of a map: two axes across a direction, turning with it as continuously as a sphere allows.

use glam::DVec3;

/// Two unit axes at right angles to the unit direction `along` and to each other, for an observer who looks along the
/// unit direction `forward` with the unit direction `up` above.
///
/// The second axis follows `forward` as seen across `along`, which lines the map up with the way the view's warp runs.
/// That leaves out only a direction along the view, and there the frame is the one reached by the shortest turn from
/// "light falls from above"; in between, the two are mixed in proportion to how much of `forward` is left:
///
/// ```text
///     along = −up:          second = forward      (light from above)
///     along = forward:      second = up           (light from behind the viewer)
///     along = −forward:     second = −up          (light from before the viewer)
///     along = ±right:       second = forward      (light from the side)
/// ```
///
/// No field of frames is continuous all over a sphere. This one has its two jumps where `along` is 60° from `up` in the
/// plane of the view: light from below the horizon, at 30°, exactly ahead or behind.
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

/// The same for a light's own axis, whatever the view: as an observer has them who looks along the world's −z, y up.
pub(crate) fn of_light(axis: DVec3) -> (DVec3, DVec3) {
    across(axis, DVec3::NEG_Z, DVec3::Y)
}
