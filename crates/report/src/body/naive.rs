//! What engines do: a box or a ball around the view as the light sees it, and the whole cone of a spot.

use shadowfit::glam::{DMat4, DVec3, DVec4, Mat4};

use super::case::{Case, corners_of};
use super::contender::{Contender, Fitted, NearSide, frustum};

/// Where the near plane of a light's frustum stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Near {
    /// Where the view begins, as the light sees it.
    View,
    /// Where the scene begins.
    Scene,
}

/// A box around the view's corners in the light's own axes, and a ball around them, each with the near plane where the
/// view begins and where the scene does.
pub(crate) fn boxes_and_balls<'a>() -> Vec<Contender<'a>> {
    vec![
        Contender::new(BOX, |case| around_corners(case, Near::View), |_, matrix| closed(matrix)),
        Contender::new(BOX_TO_SCENE, |case| around_corners(case, Near::Scene), |_, matrix| closed(matrix)),
        Contender::new(BALL, |case| around_ball(case, Near::View), |_, matrix| closed(matrix)),
        Contender::new(BALL_TO_SCENE, |case| around_ball(case, Near::Scene), |_, matrix| closed(matrix)),
    ]
}

/// The names of the contenders here.
pub(crate) const BOX: &str = "box around V";
pub(crate) const BOX_TO_SCENE: &str = "box around V, near plane at S";
pub(crate) const BALL: &str = "ball around V";
pub(crate) const BALL_TO_SCENE: &str = "ball around V, near plane at S";
pub(crate) const WHOLE_CONE: &str = "whole cone";

/// All that a spot shines at.
pub(crate) fn whole_cone<'a>() -> Contender<'a> {
    Contender::new(WHOLE_CONE, around_cone, |_, matrix| closed(matrix))
}

fn closed(shadow_from_world: Mat4) -> Fitted {
    frustum(shadow_from_world.as_dmat4(), false, NearSide::Closed)
}

/// The light's axes: right, up, and towards the light.
fn light_axes(case: &Case<'_>) -> Option<[DVec3; 3]> {
    let to_light = case.direction_to_light()?;
    let (right, up) = to_light.any_orthonormal_pair();
    Some([right, up, to_light])
}

/// The box around the corners.
fn around_corners(case: &Case<'_>, near: Near) -> Option<Mat4> {
    let axes = light_axes(case)?;
    let (mut min, mut max) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for &corner in &case.corners {
        let seen = in_axes(&axes, corner);
        (min, max) = (min.min(seen), max.max(seen));
    }
    Some(orthographic(case, &axes, min, max, near))
}

/// The box around the least ball around the corners with its middle on the view's axis.
fn around_ball(case: &Case<'_>, near: Near) -> Option<Mat4> {
    let axes = light_axes(case)?;
    let (first, last) = (case.corners[0], case.corners[7]);
    let [near_end, far_end] =
        [&case.corners[..4], &case.corners[4..]].map(|corners| 0.25 * corners.iter().sum::<DVec3>());
    // The same distance to a near corner and to a far one, but no farther than the far plane.
    let along = far_end - near_end;
    let length = along.length();
    let [near_square, far_square] = [first.distance_squared(near_end), last.distance_squared(far_end)];
    let part = 0.5 + 0.5 * (far_square - near_square) / (length * length);
    let middle = near_end + along * part.clamp(0.0, 1.0);
    let radius = first.distance(middle).max(last.distance(middle));
    let middle = in_axes(&axes, middle);
    Some(orthographic(case, &axes, middle - radius, middle + radius, near))
}

fn in_axes(axes: &[DVec3; 3], point: DVec3) -> DVec3 {
    DVec3::from_array(axes.map(|axis| axis.dot(point)))
}

/// The matrix of a box in the light's axes, z towards the light.
fn orthographic(case: &Case<'_>, axes: &[DVec3; 3], min: DVec3, max: DVec3, near: Near) -> Mat4 {
    let last = axes[2];
    let nearest = match near {
        Near::View => max.z,
        Near::Scene => corners_of(case.bounds).into_iter().map(|corner| last.dot(corner)).fold(max.z, f64::max),
    };
    matrix_of_box(axes, min, DVec3::new(max.x, max.y, nearest)).as_mat4()
}

/// World to clip for a box in the axes across and towards the light: depth 0 at its largest z, 1 at its least.
pub(crate) fn matrix_of_box(axes: &[DVec3; 3], min: DVec3, max: DVec3) -> DMat4 {
    let (size, middle) = (max - min, 0.5 * (min + max));
    let row = |axis: DVec3, scale: f64, zero: f64| (axis * scale).extend(-zero * scale);
    DMat4::from_cols(
        row(axes[0], 2.0 / size.x, middle.x),
        row(axes[1], 2.0 / size.y, middle.y),
        row(-axes[2], 1.0 / size.z, -max.z),
        DVec4::W,
    )
    .transpose()
}

/// The frustum around a spot's cone, from its near plane to its range.
fn around_cone(case: &Case<'_>) -> Option<Mat4> {
    let position = case.light.position()?;
    // Four sides, then near and far: opposite sides add up to the axis, and differ by what is across.
    let planes = case.light.planes();
    let [right, left, top, bottom, near, far] = planes.as_slice().get(..6)?.try_into().ok()?;
    let axis = (right.normal + left.normal).normalize();
    let across = |one: DVec3, other: DVec3| 0.5 * (other - one) / (0.5 * (one + other)).length();
    let [u, v] = [across(right.normal, left.normal), across(top.normal, bottom.normal)];
    // u and v are as long as the cotangent of half the angle.
    let (near, far) = (-near.at(position), far.at(position));
    let range = far / (far - near);
    let row = |normal: DVec3, constant: f64| normal.extend(constant - normal.dot(position));
    let rows = [row(u, 0.0), row(v, 0.0), row(axis * range, -near * range), row(axis, 0.0)];
    Some(DMat4::from_cols_array_2d(&rows.map(|row| row.to_array())).transpose().as_mat4())
}

#[cfg(test)]
mod tests {
    use super::*;
    use shadowfit::{Light, Scene, View};

    fn case(light: Light) -> Case<'static> {
        let view = View::perspective((0.0, 2.0, 0.0), (0.3, -0.1, -1.0), DVec3::Y, 1.0, 1.6, 0.5, 100.0)
            .expect("a legal view");
        let bounds = (DVec3::new(-200.0, 0.0, -200.0), DVec3::new(200.0, 20.0, 200.0));
        let scene = Scene::from_box(bounds.0, bounds.1).expect("a legal box");
        Case::new(view, light, scene, bounds, Vec::new()).expect("a legal case")
    }

    #[test]
    fn boxes_and_balls_hold_the_view() {
        let sun = case(Light::directional((0.3, 1.0, 0.2)).expect("a legal light"));
        for contender in boxes_and_balls() {
            let fitted = contender.fitted(&sun).expect("it is finite");
            let least = |point: DVec3| {
                fitted.clip.iter().map(|plane| plane.normalized().at(point)).fold(f64::INFINITY, f64::min)
            };
            for corner in sun.corners {
                assert!(least(corner) > -1e-3, "{}: {corner}", contender.name);
            }
            let high = sun.view.eye() + 25.0 * sun.view.forward() + DVec3::new(0.0, 15.0, 0.0);
            let reaches_scene = [BOX_TO_SCENE, BALL_TO_SCENE].contains(&contender.name);
            assert!(!reaches_scene || least(high) > 0.0, "{}", contender.name);
        }
    }

    #[test]
    fn a_cone_is_held_and_no_more() {
        let position = DVec3::new(3.0, 20.0, -30.0);
        let axis = DVec3::new(0.2, -1.0, 0.3).normalize();
        let spot = case(Light::spot(position, axis, 0.6, 0.1, 100.0).expect("a legal light"));
        let fitted = whole_cone().fitted(&spot).expect("it is finite");
        let inside = |point: DVec3| fitted.clip.iter().all(|plane| plane.normalized().at(point) > -1e-4);
        let side = axis.any_orthonormal_vector();
        assert!(inside(position + 50.0 * axis) && inside(position + 50.0 * (axis + 0.68 * side)));
        assert!(!inside(position - 5.0 * axis) && !inside(position + 120.0 * axis));
        assert!(!inside(position + 50.0 * (axis + 1.0 * side)), "wider than the corners of the frustum");
    }
}
