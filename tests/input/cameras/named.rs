//! Cameras that were refused, or came out as others, each with the right value.

use glam::{DMat4, DQuat, DVec3, DVec4, Mat4, Quat, Vec3, Vec4};
use shadowfit::{
    ClipSpace, Focus, FocusForm, Light, Scene, View,
    input::{InputErrorKind, Lens, Tangents},
};

fn lens32(near: f32, far: f32) -> Mat4 {
    let depth = far / (near - far);
    Mat4::from_cols(Vec4::X * 1.2, Vec4::Y * 2.0, Vec4::new(0.0, 0.0, depth, -1.0), Vec4::Z * (near * depth))
}

fn of(view: Mat4, lens: Mat4) -> View {
    View::from_matrices(view.as_dmat4(), lens.as_dmat4(), ClipSpace::WGPU).expect("a camera")
}

/// An inverse in f32 whose last row is (0, 0, 0, 0.9999999).
#[test]
fn a_last_row_that_is_a_rounding_off() {
    let eye = Vec3::new(7.845785, -0.051_894_188, -2.189_638_6);
    let turn = Quat::from_xyzw(-0.433_849_36, -0.392_061_05, -0.277_396_2, 0.762_308_5);
    let eye_from_world = Mat4::from_rotation_translation(turn, eye).inverse();
    let view = of(eye_from_world, lens32(0.1, 100.0));
    assert!((view.eye() - eye.as_dvec3()).length() < 1e-6, "{}", view.eye());
    assert!((view.forward() - turn.as_dquat() * DVec3::NEG_Z).length() < 1e-6, "{}", view.forward());
    assert!((view.near() - 0.1).abs() < 1e-7, "{}", view.near());
}

/// A projection turned by 180° in f32 has a w of −8.7·10⁻⁸ where there was none.
#[test]
fn a_projection_turned_in_single_precision() {
    for turn in [Mat4::from_rotation_y(std::f32::consts::PI), Mat4::from_rotation_x(std::f32::consts::PI)] {
        let view = of(turn.inverse(), lens32(0.1, 100.0) * turn);
        assert!(view.eye().length() < 1e-7 && (view.forward() - DVec3::NEG_Z).length() < 1e-6);
        assert!((view.near() - 0.1).abs() < 1e-6 && (view.far() / 100.0 - 1.0).abs() < 1e-3, "{view:?}");
    }
}

/// A swapchain turned by a quarter: the image's right is the camera's up, and the view is the same volume.
#[test]
fn a_projection_turned_by_a_quarter() {
    let lens = lens32(0.1, 100.0).as_dmat4();
    let upright = View::from_matrices(DMat4::IDENTITY, lens, ClipSpace::VULKAN).expect("a camera");
    let quarter = DMat4::from_cols(DVec4::Y, DVec4::NEG_X, DVec4::Z, DVec4::W);
    let turned = View::from_matrices(DMat4::IDENTITY, quarter * lens, ClipSpace::VULKAN).expect("a camera");
    assert!((turned.right() + upright.up()).length() < 1e-15 || (turned.right() - upright.up()).length() < 1e-15);
    let sorted = |view: &View| {
        let mut corners = view.corners().expect("a finite far plane").map(|corner| corner.to_array());
        corners.sort_by(|a, b| a.partial_cmp(b).expect("numbers"));
        corners
    };
    for (a, b) in sorted(&upright).into_iter().zip(sorted(&turned)) {
        assert!((DVec3::from(a) - DVec3::from(b)).length() < 1e-10, "{a:?} {b:?}");
    }
    // A pixel's side is that of the image as it is: its height is what was its width.
    let ratio = turned.half_height(1.0) / upright.half_height(1.0);
    assert!((ratio - 2.0 / 1.2).abs() < 1e-6, "{ratio}");
}

/// One combined matrix says the same as the two that it is the product of.
#[test]
fn one_combined_matrix() {
    let pose = DMat4::from_rotation_translation(DQuat::from_rotation_y(0.3), DVec3::new(4.0, 2.0, -7.0));
    let lens = lens32(0.1, 100.0).as_dmat4();
    let two = View::from_matrices(pose.inverse(), lens, ClipSpace::WGPU).expect("a camera");
    let one = View::from_clip_from_world(lens * pose.inverse(), ClipSpace::WGPU).expect("a camera");
    assert!((one.eye() - two.eye()).length() < 1e-14 && (one.up() - two.up()).length() < 1e-15);
    let corners = [one, two].map(|view| view.corners().expect("a finite far plane"));
    for (a, b) in corners[0].iter().zip(&corners[1]) {
        assert!((a - b).length() < 1e-10, "{a} {b}");
    }
    // Of parallel lines of sight the eye is the middle of the near plane.
    let lens =
        DMat4::from_cols(DVec4::X / 8.0, DVec4::Y / 6.0, DVec4::Z / -32.0, DVec4::new(0.0, 0.0, -0.125, 1.0));
    let one = View::from_clip_from_world(lens * pose.inverse(), ClipSpace::WGPU).expect("a camera");
    assert_eq!(one.lens(), Lens::Orthographic);
    assert!((one.eye() - (DVec3::new(4.0, 2.0, -7.0) + one.forward() * 4.0)).length() < 1e-13, "{}", one.eye());
    assert!(one.near().abs() < 1e-14 && (one.far() - 32.0).abs() < 1e-12, "{} {}", one.near(), one.far());
}

/// A reversed far plane keeps its digits: z alone says where it is.
#[test]
fn a_reversed_far_plane_is_exact() {
    let (near, far) = (0.01, 1e6);
    let z = DVec4::new(0.0, 0.0, near / (far - near), near * far / (far - near));
    let lens = DMat4::from_cols(DVec4::X, DVec4::Y, z, DVec4::NEG_Z).transpose();
    let view = View::from_matrices(DMat4::IDENTITY, lens, ClipSpace::WGPU.reversed()).expect("a camera");
    assert!((view.far() / far - 1.0).abs() < 4.0 * f64::EPSILON, "{}", view.far());
}

/// Headset runtimes give tangents, from which far comes back as it was; through a matrix of f32 it is 5 % off.
#[test]
fn tangents_keep_near_and_far() {
    let (near, far) = (0.01, 10_000.0);
    let tangents = Tangents::from_angles(-0.94, 0.77, -0.88, 0.83).expect("angles");
    let view = View::from_tangents(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, tangents, near, far).expect("a camera");
    assert_eq!((view.near(), view.far()), (near, far));
    let corner = view.corners().expect("a finite far plane")[7];
    let exact = DVec3::new(0.77_f64.tan() * far, 0.83_f64.tan() * far, -far);
    assert!((corner - exact).length() < 1e-11, "{corner} {exact}");
    let refused = |left: f64, right: f64| {
        let tangents = Tangents { left, right, ..tangents };
        View::from_tangents(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, tangents, near, far)
            .map_err(|error| (error.field, error.problem))
    };
    assert_eq!(refused(0.5, -0.5), Err(("frame", InputErrorKind::OutOfOrder)));
    assert_eq!(refused(f64::NAN, 0.5), Err(("frame", InputErrorKind::NotFinite)));
    let angles = Tangents::from_angles(-60.0, 0.5, -0.5, 0.5).map_err(|error| (error.field, error.problem));
    assert_eq!(angles, Err(("left", InputErrorKind::AngleOutOfRange)));
}

/// A range of depths that has a rounding, or any amount, more than the view's is drawn in.
#[test]
fn narrowed_is_drawn_in_to_the_view() {
    let view = of(Mat4::IDENTITY, lens32(0.1, 150.0));
    assert!(view.near() > 0.1, "{}", view.near());
    let narrowed = view.narrowed(0.1, 100.0).expect("a part of the view");
    assert_eq!((narrowed.near(), narrowed.far()), (view.near(), 100.0));
    let view = of(Mat4::IDENTITY, lens32(0.1, 200.0));
    assert!(view.far() < 199.98, "{}", view.far());
    let narrowed = view.narrowed(0.2, 200.0).expect("a part of the view");
    assert_eq!((narrowed.near(), narrowed.far()), (0.2, view.far()));
    for (near, far, field) in [(200.1, 300.0, "near"), (0.01, 0.05, "far")] {
        let error = view.narrowed(near, far).expect_err("it misses the view");
        assert_eq!((error.field, error.problem), (field, InputErrorKind::OutsideView));
    }
}

/// Windows of one pixel, portrait, 1° and 170° are views; one without height is refused by name.
#[test]
fn windows_of_every_shape() {
    let scene = Scene::from_box(DVec3::splat(-50.0), DVec3::splat(50.0)).expect("sound");
    let light = Light::directional((0.3, 1.0, 0.2)).expect("sound");
    for aspect in [1.0, 9.0 / 16.0, 1.0 / 2160.0, 3840.0] {
        for degrees in [1.0_f64, 60.0, 170.0] {
            let fov_y = degrees.to_radians();
            let view = View::perspective(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, fov_y, aspect, 0.1, 100.0);
            let view = view.expect("a camera");
            let again = View::from_clip_from_world(view.clip_from_world(), ClipSpace::OPENGL).expect("a camera");
            assert!(
                !Focus::new(&again, &light, &scene).caster_volume(FocusForm::ReceiverHull).is_empty(),
                "{aspect} {degrees}"
            );
        }
    }
    for aspect in [0.0, f64::INFINITY, f64::NAN] {
        let view = View::perspective(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 1.0, aspect, 0.1, 100.0);
        assert_eq!(view.expect_err("no image").field, "aspect");
    }
}

/// Near f32's end of an infinite far plane there is none, whichever way its row was rounded.
#[test]
fn infinite_far_planes_in_single_precision() {
    let pose = Mat4::from_rotation_translation(Quat::from_rotation_y(0.3), Vec3::new(40.0, 2.0, -70.0)).inverse();
    let forward = Mat4::from_cols(Vec4::X, Vec4::Y, Vec4::new(0.0, 0.0, -1.0, -1.0), Vec4::Z * -0.1);
    let reversed = Mat4::from_cols(Vec4::X, Vec4::Y, Vec4::NEG_W, Vec4::Z * 0.1);
    for (lens, clip) in [(forward, ClipSpace::WGPU), (reversed, ClipSpace::WGPU.reversed())] {
        for matrix in [lens * pose, lens * (lens.inverse() * (lens * pose)), lens * pose * pose.inverse() * pose] {
            let view = View::from_clip_from_world(matrix.as_dmat4(), clip).expect("a camera");
            assert_eq!(view.far(), f64::INFINITY, "{matrix}");
            assert!((view.near() - 0.1).abs() < 1e-4, "{}", view.near());
        }
    }
}
