//! Rows 26 to 28: cameras of every kind. `conventions` has one camera in every convention, and maps for every API.

use shadowfit::glam::{DMat4, DVec3, DVec4};
use shadowfit::{
    ClipSpace, Focus, FocusForm, Light, Scene, View,
    input::InputErrorKind,
    warp::{ClassKind, classify},
};

use crate::place::{in_f32, is_inside, lamp, map, settings, sun};
use crate::sweep::steps;

/// A projection of a symmetric perspective camera along −z, in a depth convention that `z` makes of 0 to 1 and of w.
fn projection(near: f64, far: f64, y: f64, z: impl Fn(DVec4, DVec4) -> DVec4) -> DMat4 {
    let w = DVec4::NEG_Z;
    let ratio = near / far;
    let zero_to_one = DVec4::new(0.0, 0.0, -1.0, -near) / (1.0 - ratio);
    DMat4::from_cols(DVec4::X * 1.25, DVec4::Y * (2.0 * y), z(zero_to_one, w), w).transpose()
}

/// Equivalent cameras have one H: far = ∞, reversed, depth −1 to 1, y down, mirrored. Off-axis and left-handed ones are in
/// `conventions::one_focus_body_in_every_convention`.
#[test]
fn row_26_cameras_of_every_convention() {
    let eye_from_world = DMat4::from_rotation_y(0.7) * DMat4::from_translation(DVec3::new(-1.0, -5.0, 3.0));
    let mirror = DMat4::from_scale(DVec3::new(-1.0, 1.0, 1.0));
    let scene = Scene::from_box((-30.0, 0.0, -30.0), (30.0, 10.0, 30.0)).expect("sound");
    for far in [64.0, f64::INFINITY] {
        let views = [
            (eye_from_world, projection(0.5, far, 1.0, |z, _| z), ClipSpace::WGPU),
            (eye_from_world, projection(0.5, far, 1.0, |z, w| w - z), ClipSpace::WGPU.reversed()),
            (eye_from_world, projection(0.5, far, 1.0, |z, w| z * 2.0 - w), ClipSpace::OPENGL),
            (eye_from_world, projection(0.5, far, 1.0, |z, w| w - z * 2.0), ClipSpace::OPENGL.reversed()),
            (eye_from_world, projection(0.5, far, -1.0, |z, _| z), ClipSpace::VULKAN),
            (mirror * eye_from_world, projection(0.5, far, 1.0, |z, _| z), ClipSpace::WGPU),
        ]
        .map(|(view, projection, clip)| View::from_matrices(view, projection, clip).expect("sound"));
        for light in [sun(DVec3::new(0.3, 1.0, 0.4)), sun(views[0].forward()), lamp(DVec3::new(4.0, 25.0, 3.0))] {
            let bodies = views.map(|view| Focus::new(&view, &light, &scene).caster_volume(FocusForm::ViewHull));
            let size = |body: &shadowfit::focus::ConvexBody| body.bounds().expect("something is visible");
            for body in &bodies {
                let ((min, max), (expected_min, expected_max)) = (size(body), size(&bodies[0]));
                // A matrix keeps 1 − n/f: 128 roundings, of the far plane at 64 in a scene of 60.
                let off = (min - expected_min).abs().max((max - expected_max).abs()).max_element();
                assert!(off <= 16.0 * f64::EPSILON * 128.0 * 64.0, "{light:?}: {off:e}");
            }
            let classes = views.map(|view| classify(&view, &light).kind);
            assert!(classes.iter().all(|class| *class == classes[0]));
        }
    }
    // Without perspective λw is 0 for a direction, and 1 for a lamp.
    let view = View::orthographic(DVec3::ZERO, (0.3, -0.4, -1.0), DVec3::Y, 10.0, 1.5, -50.0, 50.0).expect("sound");
    for direction in [DVec3::X, DVec3::Y, view.forward(), -view.forward(), DVec3::new(0.1, 0.2, 0.3)] {
        let class = classify(&view, &sun(direction));
        assert_eq!((class.kind, class.position.w), (ClassKind::Directional, 0.0));
        let class = classify(&view, &lamp(direction * 40.0));
        assert_eq!((class.kind, class.position.w), (ClassKind::Point, 1.0));
    }
}

/// near → 0: the warp's range is bounded, and f32 can evaluate it: R is in the map that is uploaded.
#[test]
fn row_27_near_plane_at_the_eye() {
    let scene = Scene::from_box((-400.0, -2.0, -400.0), (400.0, 30.0, 400.0)).expect("sound");
    for k in 0..=12 {
        for far in [100.0, 300.0, f64::INFINITY] {
            let near = 10_f64.powi(-k);
            let view = View::perspective(DVec3::ZERO, DVec3::new(0.1, -0.1, -1.0), DVec3::Y, 1.0, 1.5, near, far)
                .expect("sound");
            for light in [
                sun(DVec3::Y),
                sun(DVec3::new(0.5, 0.5, -0.6)),
                sun(DVec3::new(0.2, 0.5, 0.8)),
                lamp(DVec3::new(3.0, 60.0, -30.0)),
            ] {
                let map = map(&view, &light, &scene, &settings());
                // A million, and the rounding of w where it is least.
                assert!(
                    map.warp_ratio() >= 1.0 && map.warp_ratio() <= 1e6 * (1.0 + 1e-3),
                    "{near:e}: {}",
                    map.warp_ratio()
                );
                for &p in Focus::new(&view, &light, &scene).receiver_volume().vertices() {
                    assert!(is_inside(in_f32(&map, p)), "{near:e}, {far}, {light:?}: {p}");
                }
            }
        }
    }
}

/// Fields of view from a billionth of a degree to all but a half space are right or refused by name.
#[test]
fn row_28_fields_of_view() {
    use std::f64::consts::PI;
    let make = |fov_y: f64| View::perspective(DVec3::ZERO, (0.1, -0.1, -1.0), DVec3::Y, fov_y, 1.0, 0.5, 80.0);
    let scene = Scene::from_box(DVec3::splat(-100.0), DVec3::splat(100.0)).expect("sound");
    let degrees = [1e-9, 1e-6, 1e-3, 0.1, 1.0, 60.0, 120.0, 170.0, 179.0, 179.9, 179.999];
    for (degrees, light) in degrees.iter().flat_map(|d| {
        [
            (*d, sun(DVec3::new(0.3, 1.0, 0.2))),
            (*d, Light::point((9.0, 95.0, 3.0), 0.1, f64::INFINITY).expect("sound")),
        ]
    }) {
        let view = make(f64::to_radians(degrees)).expect("in range");
        let focus = Focus::new(&view, &light, &scene);
        let visible = focus.receiver_volume();
        assert!(!visible.is_empty(), "{degrees}");
        if let Some(map) = focus.fit(&settings()).map() {
            for &p in visible.vertices() {
                assert!(is_inside(in_f32(map, p)), "{degrees}: {p}");
            }
        } else {
            // All but a half space holds the lamp.
            assert!(light.position().is_some() && degrees > 150.0, "{degrees}: no map");
        }
    }
    let refused = |fov_y: f64| make(fov_y).err().map(|error| (error.field, error.problem));
    for fov_y in steps(0.0).filter(|x| *x <= 0.0).chain(steps(PI).filter(|x| *x >= PI)) {
        assert_eq!(refused(fov_y), Some(("fov_y", InputErrorKind::AngleOutOfRange)), "{fov_y:e}");
    }
    for fov_y in steps(0.0).filter(|x| *x > 0.0) {
        assert_eq!(refused(fov_y), Some(("fov_y", InputErrorKind::TooSmall)), "{fov_y:e}");
    }
    for fov_y in steps(PI).filter(|x| *x < PI) {
        assert_eq!(refused(fov_y), Some(("fov_y", InputErrorKind::TooLarge)), "{fov_y:e}");
    }
}
