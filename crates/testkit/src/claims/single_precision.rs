//! What f32 makes of a map: all that must be in it is, and its depths are as quiet as it says.

use shadowfit::glam::{DVec2, DVec3, DVec4, Vec4};
use shadowfit::{ClipSpace, FocusForm, Outcome, Settings, ShadowMap, input::DepthRange};

use crate::arbitrary::{Case, SceneParams, Together, points_of, sides};

/// What the f32 matrix makes of a position that is an f32 too, as a vertex shader does it.
pub fn in_f32(map: &ShadowMap, point: DVec3) -> Vec4 {
    let origin = map.origin();
    map.caster_matrix() * (point - origin).as_vec3().extend(1.0)
}

/// What eight roundings of f32 can move a point by across the clip volume, and w by relative to itself.
pub fn rounding(map: &ShadowMap, point: DVec3) -> (f64, f64) {
    const UNITS: f64 = 8.0 / 16_777_216.0;
    let rows = map.clip_from_world().transpose();
    let origin = map.origin();
    let w = rows.w_axis.dot(point.extend(1.0));
    let [x, y, w] = [rows.x_axis, rows.y_axis, rows.w_axis].map(|row| {
        let terms = row.truncate().abs().dot((point - origin).abs()) + row.dot(origin.extend(1.0)).abs();
        UNITS * terms / w
    });
    (x.max(y) + w, w)
}

/// Whether a position is inside the sides of the clip volume, `inner` of the way from its middle.
pub fn is_in_window(position: Vec4, inner: DVec2) -> bool {
    let [x, y, _, w] = position.to_array().map(f64::from);
    w > 0.0 && x.abs() <= inner.x * w && y.abs() <= inner.y * w
}

/// Whether a position is behind the near end of the depth range of a convention, and before its far end.
fn is_in_depth(clip: ClipSpace, position: Vec4) -> [bool; 2] {
    let (z, w) = (position.z, position.w);
    match clip.depth {
        DepthRange::ZeroToOne => [z >= 0.0, z <= w],
        DepthRange::ZeroToOneReversed => [z <= w, z >= 0.0],
        DepthRange::NegativeOneToOne => [z >= -w, z <= w],
        DepthRange::NegativeOneToOneReversed => [z <= w, z >= -w],
    }
}

/// Asserts that R and what casts on it are in the f32 map.
pub fn holds_what_it_must(case: &Case, settings: &Settings, seed: u64) {
    let together = Together::of(case);
    let focus = together.focus();
    let Outcome::Map(map) = focus.fit(settings) else { return };
    // The border is measured in f64 after the division, which is a rounding more than the map answers for.
    let border = f64::from(settings.border()) / sides(settings);
    let inner = (1.0 - 2.0 * border) * (1.0 + f64::EPSILON);
    let visible = points_of(&focus.receiver_volume(), seed);
    let body = focus.caster_volume(FocusForm::ReceiverHull);
    let casters = together.casters(&body, &visible, seed);
    let l = together.light.homogeneous();
    for (name, points, inner) in [("R", visible, inner), ("H", casters, DVec2::ONE)] {
        for point in points {
            // A scene of millimetres about a lamp a thousand kilometres from the origin is beyond f32: w may be 0.
            let (across, of_w) = rounding(&map, point);
            if !together.is_served(point) || of_w > 0.5 {
                continue;
            }
            // A caster next to a lamp, whose place f32 cannot tell to a thousandth of the window, may be off by that, and a receiver
            // beside it whose place it cannot tell to a 64th.
            let most = if name == "H" { 1.0 / 1024.0 } else { 1.0 / 64.0 };
            let is_beside_lamp = l.w > 0.0 && across > most;
            let inner = if is_beside_lamp { inner + across } else { inner };
            let position = in_f32(&map, point);
            let shown = position.truncate() / position.w;
            assert!(is_in_window(position, inner), "{name}: {point} is at {shown}, w {}", position.w);
            if is_beside_lamp {
                continue;
            }
            // Among lists, receivers may be nearer to the light than the first caster.
            let separate = matches!(case.scene, SceneParams::Lists { .. });
            let [behind, before] = is_in_depth(settings.clip(), position);
            assert!(behind || separate && name == "R", "{name}: {point} is before the near end, at {shown}");
            assert!(before, "{name}: {point} is beyond the far end, at {shown}");
        }
    }
}

/// Depth from 0 at the near end to 1 at the far end, in any convention.
pub fn depth_of(clip: ClipSpace, position: DVec4) -> f64 {
    let z = position.z / position.w;
    match clip.depth {
        DepthRange::ZeroToOne => z,
        DepthRange::ZeroToOneReversed => 1.0 - z,
        DepthRange::NegativeOneToOne => 0.5 + 0.5 * z,
        DepthRange::NegativeOneToOneReversed => 0.5 - 0.5 * z,
    }
}

/// Asserts that depths in f32 are off by no more than the map says.
pub fn is_as_quiet_as_it_says(case: &Case, settings: &Settings, seed: u64) {
    let together = Together::of(case);
    let focus = together.focus();
    let Outcome::Map(map) = focus.fit(settings) else { return };
    for point in points_of(&focus.receiver_volume(), seed) {
        let (_, of_w) = rounding(&map, point);
        if !together.is_served(point) || of_w > 0.5 {
            continue;
        }
        let in_f32 = depth_of(settings.clip(), in_f32(&map, point).as_dvec4());
        let exact = depth_of(settings.clip(), map.clip_from_world() * point.extend(1.0));
        let noise = map.depth_rounding(point);
        // Among lists a receiver may be before the near end: w's rounding then counts as often as depth is large.
        let (off, noise_here) = ((in_f32 - exact).abs(), noise * exact.abs().max(1.0));
        assert!(off <= noise_here, "{point}: {in_f32} {exact}, noise {noise}");
        assert!(noise <= map.depth().rounding, "{point}: {noise}, at most {}", map.depth().rounding);
    }
}
