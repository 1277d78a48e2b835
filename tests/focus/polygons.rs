//! What bodies are made of: faces are convex polygons, counter-clockwise as seen from outside, wherever a body is, and what is
//! inside all planes is inside.

use shadowfit::glam::DVec3;
use shadowfit::{
    Focus, FocusForm, Light, Scene, View,
    focus::{ConvexBody, Plane},
    input::ConvexScene,
};

/// How far the computed vertices of a body may be from exact ones, in roundings of the largest coordinate of its scene:
/// what the crate itself allows for ([`shadowfit::Focus::paraboloids`] takes twice as many, for two of them).
const ROUNDINGS: f64 = 64.0 * f64::EPSILON;

/// Goes around every face and asks that each corner turn to the left, if by no more than vertices are off; and that a face
/// be gone around once: the fan from any of its corners covers just what the polygon does.
fn assert_polygons(body: &ConvexBody, extent: f64) {
    for face in body.faces() {
        let outward = -face.plane().normalized().normal;
        let corners: Vec<DVec3> = face.vertices().collect();
        let count = corners.len();
        let across = corners.iter().map(|corner| corner.distance(corners[0])).fold(0.0, f64::max);
        // Of a product of two sides, each off at both ends.
        let allowed = 8.0 * ROUNDINGS * extent * (across + ROUNDINGS * extent);
        let (mut area, mut covered) = (0.0, 0.0);
        for at in 0..count {
            let [a, b, c] = [at, at + 1, at + 2].map(|index| corners[index % count]);
            let turn = (b - a).cross(c - b).dot(outward);
            assert!(turn >= -allowed, "corner {at} of {corners:?} turns by {turn:e}, allowed {allowed:e}");
            let part = (b - corners[0]).cross(c - corners[0]).dot(outward);
            (area, covered) = (area + part, covered + part.abs());
        }
        assert!(
            covered - area <= 2.0 * count as f64 * allowed,
            "{corners:?} covers {covered:e}, its area is {area:e}"
        );
    }
}

/// Two planes that hardly differ share a line that may be anywhere between them, and so may the corners on it: which of them
/// a corner is in is all that is known. Here no two planes are like that.
#[test]
fn faces_are_convex_and_gone_around_once() {
    let mut faces = 0;
    for place in [DVec3::ZERO, DVec3::new(300.0, -20.0, 70.0), DVec3::new(-5000.0, 40.0, 80_000.0)] {
        let (min, max) = (place + DVec3::new(-16.0, 0.0, -32.0), place + DVec3::new(16.0, 8.0, 16.0));
        let roof =
            [1.0, -1.0].map(|side| Plane::through(DVec3::new(0.3 * side, -1.0, 0.1), place + DVec3::Y * 7.0));
        let house = ConvexScene::new(min, max, &roof).expect("a house");
        let extent = min.abs().max(max.abs()).max_element();
        for forward in [DVec3::new(0.2, -0.3, -1.0), DVec3::new(-1.0, -0.1, 0.4), DVec3::new(0.7, 0.2, 0.5)] {
            let eye = place + DVec3::new(1.0, 1.75, 8.0);
            let view = View::perspective(eye, forward, DVec3::Y, 1.0, 1.5, 0.5, 100.0).expect("a view");
            let lights = [
                Light::directional((0.4, 1.0, 0.3)),
                Light::directional((-0.6, 0.5, -0.9)),
                Light::point(place + DVec3::new(5.0, 12.0, -3.0), 0.25, f64::INFINITY),
                Light::spot(place + DVec3::new(-7.0, 6.0, 9.0), (0.5, -0.9, -0.7), 0.7, 0.25, 60.0),
            ];
            for light in lights {
                let scene = Scene::from_convex(&house);
                let focus = Focus::new(&view, &light.expect("a light"), &scene);
                for body in [
                    focus.receiver_volume(),
                    focus.caster_volume(FocusForm::ViewHull),
                    focus.caster_volume(FocusForm::ReceiverHull),
                ] {
                    assert_polygons(&body, extent);
                    faces += body.faces().count();
                }
            }
        }
    }
    assert!(faces >= 500, "{faces} faces");
}

#[test]
fn a_body_contains_what_is_inside_all_of_its_planes() {
    let view =
        View::perspective((1.0, 1.75, 8.0), (0.2, -0.3, -1.0), DVec3::Y, 1.0, 1.5, 0.5, 100.0).expect("a view");
    let sun = Light::directional((0.4, 1.0, 0.3)).expect("a sun");
    let scene = Scene::from_box((-16.0, 0.0, -32.0), (16.0, 8.0, 16.0)).expect("a scene");
    let focus = Focus::new(&view, &sun, &scene);
    for body in [
        focus.receiver_volume(),
        focus.caster_volume(FocusForm::ViewHull),
        focus.caster_volume(FocusForm::ReceiverHull),
    ] {
        let corners = body.vertices();
        let middle = corners.iter().sum::<DVec3>() / corners.len() as f64;
        assert!(body.contains(middle));
        for face in body.faces() {
            let on_face = face.vertices().sum::<DVec3>() / face.vertices().len() as f64;
            let outward = -face.plane().normalized().normal;
            assert!(
                body.contains(on_face - outward * 1e-6) && !body.contains(on_face + outward * 1e-6),
                "{on_face}"
            );
        }
    }
    let aside = Scene::from_box((-16.0, 0.0, 20.0), (16.0, 8.0, 36.0)).expect("a scene");
    assert!(!Focus::new(&view, &sun, &aside).receiver_volume().contains(DVec3::ZERO));
}

/// The plane at infinity has no normal to make unit length.
#[test]
fn a_plane_without_a_normal_stays_as_it_is() {
    assert_eq!(Plane::ONE.normalized(), Plane::ONE);
    let plane = Plane::new(DVec3::new(0.0, 3.0, 4.0), 10.0).normalized();
    assert!(
        (plane.normal.length() - 1.0).abs() <= f64::EPSILON && (plane.offset - 2.0).abs() <= 2.0 * f64::EPSILON
    );
}
