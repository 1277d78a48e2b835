//! Where a map puts what must be in it, in f64: inside, a ray in one place, and what is nearer to the light before the
//! rest.

use shadowfit::glam::{DMat4, DVec2, DVec3, DVec4};
use shadowfit::{ClipSpace, FocusForm, Outcome, Settings};

use crate::arbitrary::{Case, Numbers, SceneParams, Together, points_of, sides};

/// A row of a matrix at a point, and how far rounding can carry it.
///
/// A row is a combination of planes through the light or the eye and through the middle of what is visible: a few dozen
/// roundings of terms as large as its normal times those points. Axes are off by roundings of their length, also in a component
/// that is zero or nearly so.
fn at(row: DVec4, point: DVec3, reach: DVec3) -> (f64, f64) {
    const ROUNDINGS: f64 = 64.0 * f64::EPSILON;
    let terms = row.truncate().length() * (point.abs() + reach).length() + row.w.abs();
    // Terms may also be too small to be rounded like others.
    (row.dot(point.extend(1.0)), ROUNDINGS * terms + f64::MIN_POSITIVE)
}

/// Coordinates after the division by w, how far rounding can carry them, and w itself.
pub fn projected(matrix: &DMat4, point: DVec3, reach: DVec3) -> (DVec3, DVec3, f64) {
    let rows = matrix.transpose();
    let (w, w_slack) = at(rows.w_axis, point, reach);
    let coordinates = [rows.x_axis, rows.y_axis, rows.z_axis].map(|row| {
        let (value, slack) = at(row, point, reach);
        let least = (w - w_slack).max(f64::MIN_POSITIVE);
        (value / w, (slack + (value / w).abs() * w_slack) / least + f64::MIN_POSITIVE)
    });
    (DVec3::from(coordinates.map(|(value, _)| value)), DVec3::from(coordinates.map(|(_, slack)| slack)), w)
}

/// How large the numbers are that the rows of a case's map were made from.
fn reach(case: &Case, together: &Together) -> DVec3 {
    let (min, max) = case.scene.bounds();
    let l = together.light.homogeneous();
    DVec3::from(min).abs().max(DVec3::from(max).abs()) + together.view.eye().abs() + l.truncate().abs() * l.w
}

/// Asserts that rays keep their place and gain depth away from the light.
pub fn keep_their_place(case: &Case, settings: &Settings, seed: u64) {
    let together = Together::of(case);
    let focus = together.focus();
    let Outcome::Map(map) = focus.fit(settings) else { return };
    let matrix = map.clip_from_world_in(ClipSpace::WGPU);
    let l = together.light.homogeneous();
    let (min, max) = case.scene.bounds();
    let size = (DVec3::from(max) - DVec3::from(min)).length();
    let reach = reach(case, &together);
    let mut numbers = Numbers(!seed);
    for point in points_of(&focus.receiver_volume(), seed) {
        if !together.is_served(point) {
            continue;
        }
        let (end, end_slack, end_w) = projected(&matrix, point, reach);
        assert!(end_w > 0.0, "{point} has w {end_w}");
        for _ in 0..4 {
            // Beyond the near distance of a lamp; twice as far as the scene is large from the sun, so that many a
            // caster is behind the eye.
            let to_light = match together.light.position() {
                Some(position) => {
                    let arm = position - point;
                    arm * (1.0 - together.light.near() / arm.length()).max(0.0)
                }
                None => l.truncate() * (2.0 * size),
            };
            let caster = point + to_light * numbers.part();
            let (start, start_slack, start_w) = projected(&matrix, caster, reach);
            assert!(start_w > 0.0, "{caster} has w {start_w}");
            let slack = end_slack + start_slack;
            let moved = (start - end).abs();
            assert!(moved.x <= slack.x && moved.y <= slack.y, "{caster} and {point} differ by {moved}");
            assert!(start.z <= end.z + slack.z, "{caster} at {} is behind {point} at {}", start.z, end.z);
        }
    }
}

/// Asserts that what is visible and what can cast on it is in the map: R inside its border, H in its depth range.
pub fn end_in_the_map(case: &Case, settings: &Settings, seed: u64) {
    let together = Together::of(case);
    let focus = together.focus();
    let Outcome::Map(map) = focus.fit(settings) else { return };
    let matrix = map.clip_from_world_in(ClipSpace::WGPU);
    let reach = reach(case, &together);
    let border = f64::from(settings.border()) / sides(settings);
    let visible = points_of(&focus.receiver_volume(), seed);
    let casters = together.casters(&focus.caster_volume(FocusForm::ReceiverHull), &visible, seed);
    // Among lists, receivers may be nearer to the light than the first caster.
    let separate = matches!(case.scene, SceneParams::Lists { .. });
    for (name, points, inner) in [("R", visible, 1.0 - 2.0 * border), ("H", casters, DVec2::ONE)] {
        for point in points {
            if !together.is_served(point) {
                continue;
            }
            let (place, slack, w) = projected(&matrix, point, reach);
            assert!(w > 0.0, "{name}: {point} has w {w}");
            let is_inside = place.x.abs() <= inner.x + slack.x && place.y.abs() <= inner.y + slack.y;
            assert!(is_inside, "{name}: {point} is at {place}, beyond {inner}");
            let is_behind = place.z >= -slack.z || separate && name == "R";
            assert!(is_behind && place.z <= 1.0 + slack.z, "{name}: {point} is at the depth of {place}");
        }
    }
}
