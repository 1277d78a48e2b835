//! Mirrors and portals: a near plane that is not across the view.

use glam::{DMat4, DVec3, DVec4};
use proptest::prelude::*;
use shadowfit::{
    ClipSpace, Focus, FocusForm, Light, Outcome, Scene, Settings, View, Warp, focus::Plane, input::InputErrorKind,
};
use testkit::arbitrary::{points_of, rotation, run};

/// Lengyel's projection: the near plane is `plane`, in eye space, and the far plane is scaled to just hold the frustum.
fn oblique(lens: DMat4, plane: DVec4) -> DMat4 {
    let sign = |value: f64| if value < 0.0 { -1.0 } else { 1.0 };
    let corner = lens.inverse() * DVec4::new(sign(plane.x), sign(plane.y), 1.0, 1.0);
    let mut rows = lens.transpose();
    // Depth from −1 to 1.
    rows.z_axis = plane * (2.0 * rows.w_axis.dot(corner) / plane.dot(corner)) - rows.w_axis;
    rows.transpose()
}

/// A camera behind a mirror, looking through it.
#[derive(Clone, Debug)]
struct Mirror {
    eye_from_world: DMat4,
    clip_from_eye: DMat4,
    /// The mirror, in world space.
    plane: Plane,
    /// The view without it.
    whole: View,
}

fn mirror() -> impl Strategy<Value = Mirror> {
    let lens = (0.4..2.0, 0.5..2.0, 0.05..1.0, 10.0..200.0);
    let tilt = (-0.8..0.8, -0.8..0.8, 1.0_f64..8.0);
    (rotation(), prop::array::uniform3(-20.0..20.0), lens, tilt).prop_map(
        |(turn, eye, (fov_y, aspect, near, far), (right, up, distance)): (_, _, _, (f64, f64, f64))| {
            let eye = DVec3::from(eye);
            let view = View::perspective(eye, turn * DVec3::NEG_Z, turn * DVec3::Y, fov_y, aspect, near, far);
            let whole = view.expect("a camera");
            let pose = DMat4::from_rotation_translation(turn, eye);
            let clip_from_eye = whole.clip_from_world() * pose;
            let normal = DVec3::new(right, up, -1.0).normalize();
            let of_eye = normal.extend(-distance);
            let normal = turn * normal;
            let plane = Plane::new(normal, -distance - normal.dot(eye));
            Mirror { eye_from_world: pose.inverse(), clip_from_eye: oblique(clip_from_eye, of_eye), plane, whole }
        },
    )
}

/// The view is what lies in the frustum beyond the mirror, and before the far plane that the matrix has: exactly the points
/// whose clip coordinates are inside.
#[test]
fn views_are_cut_by_the_near_plane() {
    let point = prop::array::uniform3(-1.2..1.2);
    run(2000, &(mirror(), prop::collection::vec(point, 64)), |(mirror, points)| {
        let clip_from_world = mirror.clip_from_eye * mirror.eye_from_world;
        let one = View::from_clip_from_world(clip_from_world, ClipSpace::OPENGL);
        let two = View::from_matrices(mirror.eye_from_world, mirror.clip_from_eye, ClipSpace::OPENGL);
        for view in [one, two] {
            let view = view.expect("a camera");
            assert!((view.eye() - mirror.whole.eye()).length() < 1e-9, "{mirror:?}");
            let mut depths: (f64, f64) = (f64::INFINITY, 0.0);
            for &point in &points {
                // Anywhere in and about the frustum without the mirror.
                let inverse = mirror.whole.clip_from_world().inverse();
                let point = inverse.project_point3(point.into());
                let at = clip_from_world * point.extend(1.0);
                let inside = [at.w - at.x, at.w + at.x, at.w - at.y, at.w + at.y, at.w - at.z, at.w + at.z];
                let (least, of) = (inside.into_iter().fold(f64::INFINITY, f64::min), at.abs().max_element());
                // Closer than this rounding decides.
                if least.abs() < 1e-9 * of {
                    continue;
                }
                let is_inside = view.planes().iter().all(|plane| plane.at(point) >= 0.0);
                assert_eq!(is_inside, least > 0.0, "{mirror:?}: {point}, {at}");
                if is_inside {
                    assert!(mirror.plane.at(point) > -1e-9);
                    depths = (depths.0.min(view.depth(point)), depths.1.max(view.depth(point)));
                }
            }
            assert!(view.near() <= depths.0 && depths.1 <= view.far());
        }
    });
}

/// Nothing that casts on what is seen through a mirror is lost: any point between a visible one and the light is in both
/// bodies, in the map, and before the far end of its depths.
#[test]
fn nothing_of_h_is_lost() {
    let light = (rotation(), any::<bool>());
    run(1000, &(mirror(), light, any::<u64>()), |(mirror, (turn, is_sun), seed)| {
        let clip_from_world = mirror.clip_from_eye * mirror.eye_from_world;
        let view = View::from_clip_from_world(clip_from_world, ClipSpace::OPENGL).expect("a camera");
        let (min, max) = (DVec3::new(-60.0, -5.0, -60.0), DVec3::new(60.0, 40.0, 60.0));
        let scene = Scene::from_box(min, max).expect("sound");
        let to_light = turn * DVec3::Y;
        let light = if is_sun {
            Light::directional(to_light)
        } else {
            Light::point(to_light * 30.0 + DVec3::Y * 20.0, 0.01, f64::INFINITY)
        };
        let light = light.expect("sound");
        let focus = Focus::new(&view, &light, &scene);
        let visible = focus.receiver_volume();
        let bodies = [focus.caster_volume(FocusForm::ViewHull), focus.caster_volume(FocusForm::ReceiverHull)];
        for warp in [Warp::Uniform, Warp::Perspective, Warp::LightSpace, Warp::default()] {
            let outcome = focus.fit(&Settings::default().with_warp(warp));
            for point in points_of(&visible, seed) {
                assert!(mirror.plane.at(point) > -1e-6, "{point} is before the mirror");
                for part in [0.0, 0.1, 0.5, 0.9] {
                    let caster = match light.position() {
                        Some(position) => point.lerp(position, part),
                        None => point + to_light * (part * 80.0),
                    };
                    if caster.cmplt(min).any() || caster.cmpgt(max).any() {
                        continue;
                    }
                    for body in &bodies {
                        assert!(body.intersects_aabb(caster, caster), "{mirror:?}: {caster} before {point}");
                    }
                    if let Outcome::Map(map) = &outcome
                        && light.position().is_none_or(|at| at.distance(caster) > 0.1)
                    {
                        let place = map.clip_from_world_in(ClipSpace::WGPU).project_point3(caster);
                        assert!(
                            place.truncate().abs().max_element() <= 1.0,
                            "{mirror:?}, {warp:?}: {caster} at {place}"
                        );
                        assert!(place.z >= 0.0 && place.z <= 1.0, "{mirror:?}, {warp:?}: {caster} at {place}");
                    }
                }
            }
        }
    });
}

/// A mirror that nothing is seen through is told by name.
#[test]
fn a_mirror_that_faces_away() {
    let whole = View::perspective(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 1.0, 1.5, 0.1, 50.0).expect("a camera");
    let mut rows = whole.clip_from_world().transpose();
    // What lies behind the camera, by a near plane behind it.
    rows.z_axis = DVec4::new(0.0, 0.0, 1.0, -5.0) - rows.w_axis;
    let view = View::from_clip_from_world(rows.transpose(), ClipSpace::OPENGL);
    assert_eq!(view.map_err(|error| (error.field, error.problem)), Err(("near", InputErrorKind::OutsideView)));
}

/// A mirror on the floor that the camera looks at from above: R begins at the mirror, and narrowing leaves it there.
#[test]
fn a_mirror_of_a_known_place() {
    let whole = View::perspective(DVec3::new(0.0, -2.0, 0.0), (0.0, 0.5, -1.0), DVec3::Y, 1.0, 1.5, 0.1, 50.0);
    let whole = whole.expect("a camera");
    // The world above y = 0, seen from below it; in world space the plane is that of eye space too.
    let matrix = oblique(whole.clip_from_world(), DVec4::Y);
    let view = View::from_clip_from_world(matrix, ClipSpace::OPENGL).expect("a camera");
    let scene = Scene::from_box((-20.0, -3.0, -20.0), (20.0, 3.0, 20.0)).expect("sound");
    let light = Light::directional((0.3, 1.0, 0.2)).expect("sound");
    for view in [view, view.narrowed(3.0, 15.0).expect("a part of it")] {
        let (min, max) =
            Focus::new(&view, &light, &scene).receiver_volume().bounds().expect("something is visible");
        assert!(min.y.abs() < 1e-12 && (max.y - 3.0).abs() < 1e-12, "{min} {max}");
    }
    // Without it what lies below counts too.
    let (min, _) = Focus::new(&whole, &light, &scene).receiver_volume().bounds().expect("something is visible");
    assert!(min.y < -1.9, "{min}");
    // Depth begins where the uppermost line of sight meets the mirror.
    let steepest = whole.forward() + whole.up() * 0.5_f64.tan();
    assert!((view.near() - 2.0 / steepest.y).abs() < 1e-9, "{}", view.near());
}
