//! Hard case 36 (`docs/hard-cases.md`): constructors refuse invalid input and name the field; never a panic, a hang or a NaN in a
//! result.

use shadowfit::glam::{DMat4, DVec3, DVec4, Vec3};
#[cfg(feature = "alloc")]
use shadowfit::plan::{Budget, Object, Objects};
use shadowfit::{
    Aabb, ClipSpace, InputError, Light, Outcome, Scene, Settings, View, Warp, fit,
    focus::Plane,
    input::{ConvexScene, InputErrorKind, MAX_COORDINATE, MIN_DISTANCE, Tangents},
    omni::CubeFace,
};

const NAN: f64 = f64::NAN;
const INFINITY: f64 = f64::INFINITY;
/// The smallest denormal number.
const DENORMAL: f64 = 5e-324;
const EYE: DVec3 = DVec3::new(1.0, 2.0, 3.0);

/// Refused, for this field and for this reason.
#[track_caller]
fn refused<T: core::fmt::Debug>(result: Result<T, InputError>, field: &str, problem: InputErrorKind) {
    let error = result.expect_err("accepted");
    assert_eq!((error.field, error.problem), (field, problem));
    assert!(error.to_string().starts_with(field), "{error}");
}

fn found(error: Option<InputError>) -> Option<(&'static str, InputErrorKind)> {
    error.map(|error| (error.field, error.problem))
}

/// What is wrong with a vector that has one of these in any place, and with a number that is one of these.
const NOT_FINITE: [f64; 3] = [NAN, INFINITY, -INFINITY];

/// A vector with one component replaced.
fn with(vector: DVec3, axis: usize, value: f64) -> DVec3 {
    let mut vector = vector;
    vector[axis] = value;
    vector
}

#[test]
fn points_of_views_and_lights() {
    for axis in 0..3 {
        for (value, problem) in NOT_FINITE
            .map(|value| (value, InputErrorKind::NotFinite))
            .into_iter()
            .chain([(-1e13, InputErrorKind::TooLarge)])
        {
            let point = with(EYE, axis, value);
            refused(View::perspective(point, DVec3::X, DVec3::Y, 1.0, 1.0, 0.1, 9.0), "eye", problem);
            refused(View::orthographic(point, DVec3::X, DVec3::Y, 1.0, 1.0, 0.1, 9.0), "eye", problem);
            refused(Light::point(point, 0.1, 9.0), "position", problem);
            refused(Light::spot(point, DVec3::X, 1.0, 0.1, 9.0), "position", problem);
            refused(Light::hemisphere(point, DVec3::X, 0.1, 9.0), "position", problem);
        }
        assert!(Light::point(with(EYE, axis, DENORMAL), 0.1, 9.0).is_ok());
        assert!(Light::point(with(EYE, axis, -MAX_COORDINATE), 0.1, 9.0).is_ok());
    }
}

#[test]
fn directions() {
    type Make = fn(DVec3) -> Option<InputError>;
    let doors: [(&str, Make); 7] = [
        ("forward", |v| View::perspective(EYE, v, DVec3::Y, 1.0, 1.0, 0.1, 9.0).err()),
        ("up", |v| View::perspective(EYE, DVec3::X, v, 1.0, 1.0, 0.1, 9.0).err()),
        ("forward", |v| View::orthographic(EYE, v, DVec3::Y, 1.0, 1.0, 0.1, 9.0).err()),
        ("up", |v| View::orthographic(EYE, DVec3::X, v, 1.0, 1.0, 0.1, 9.0).err()),
        ("direction_to_light", |v| Light::directional(v).err()),
        ("axis", |v| Light::spot(EYE, v, 1.0, 0.1, 9.0).err()),
        ("axis", |v| Light::hemisphere(EYE, v, 0.1, 9.0).err()),
    ];
    for (field, make) in doors {
        for axis in 0..3 {
            for value in NOT_FINITE {
                assert_eq!(found(make(with(DVec3::Z, axis, value))), Some((field, InputErrorKind::NotFinite)));
            }
        }
        for zero in [DVec3::ZERO, -DVec3::ZERO] {
            assert_eq!(found(make(zero)), Some((field, InputErrorKind::NoDirection)));
        }
        // A direction's length does not matter, however small or large.
        for length in [DENORMAL, 1e-200, 1e-20, 1e20, 1e200, f64::MAX] {
            assert_eq!(make(DVec3::Z * length), None, "{field} of length {length:e}");
        }
    }
}

#[test]
fn directions_that_must_span_a_plane() {
    for (forward, up) in [(DVec3::Y, DVec3::Y), (DVec3::Y, DVec3::NEG_Y * 3.0), (EYE, EYE * -1e-9)] {
        refused(View::perspective(EYE, forward, up, 1.0, 1.0, 0.1, 9.0), "up", InputErrorKind::Parallel);
        refused(View::orthographic(EYE, forward, up, 1.0, 1.0, 0.1, 9.0), "up", InputErrorKind::Parallel);
    }
}

#[test]
fn angles() {
    use core::f64::consts::{FRAC_PI_2, PI};
    for angle in [NAN, INFINITY, -INFINITY, 0.0, -0.0, -1.0, PI, 4.0] {
        let view = View::perspective(EYE, DVec3::X, DVec3::Y, angle, 1.0, 0.1, 9.0);
        refused(view, "fov_y", InputErrorKind::AngleOutOfRange);
    }
    for angle in [NAN, INFINITY, -INFINITY, 0.0, -0.0, -1.0, DENORMAL, FRAC_PI_2, 2.0] {
        refused(Light::spot(EYE, DVec3::X, angle, 0.1, 9.0), "half_angle", InputErrorKind::AngleOutOfRange);
    }
    // An angle in its range may have a tangent that is not.
    refused(View::perspective(EYE, DVec3::X, DVec3::Y, DENORMAL, 1.0, 0.1, 9.0), "fov_y", InputErrorKind::TooSmall);
    refused(
        View::perspective(EYE, DVec3::X, DVec3::Y, PI.next_down(), 1.0, 0.1, 9.0),
        "fov_y",
        InputErrorKind::TooLarge,
    );
}

#[test]
fn cube_faces() {
    let face = CubeFace::NegativeY;
    let lamp = Light::point(EYE, 0.1, 9.0).unwrap();
    for bad in [NAN, INFINITY, -INFINITY] {
        refused(lamp.cube_face(face, bad), "overlap", InputErrorKind::NotFinite);
    }
    refused(lamp.cube_face(face, -1e-9), "overlap", InputErrorKind::TooSmall);
    refused(lamp.cube_face(face, CubeFace::MAX_OVERLAP.next_up()), "overlap", InputErrorKind::TooLarge);
    for light in [
        Light::directional(DVec3::X).unwrap(),
        Light::spot(EYE, DVec3::X, 1.0, 0.1, 9.0).unwrap(),
        lamp.cube_face(face, CubeFace::MAX_OVERLAP).unwrap(),
    ] {
        refused(light.cube_face(face, 0.0), "light", InputErrorKind::NotAllAround);
    }
}

/// Distances and factors that must be positive, finite, and neither tiny nor huge.
#[test]
fn distances() {
    let bad = [
        (NAN, InputErrorKind::NotFinite),
        (INFINITY, InputErrorKind::NotFinite),
        (-INFINITY, InputErrorKind::NotFinite),
        (0.0, InputErrorKind::TooSmall),
        (-0.0, InputErrorKind::TooSmall),
        (-1.0, InputErrorKind::TooSmall),
        (DENORMAL, InputErrorKind::TooSmall),
        (MIN_DISTANCE.next_down(), InputErrorKind::TooSmall),
        (MAX_COORDINATE.next_up(), InputErrorKind::TooLarge),
        (f64::MAX, InputErrorKind::TooLarge),
    ];
    type Make = fn(f64) -> Option<InputError>;
    let doors: [(&str, Make); 7] = [
        ("aspect", |x| View::perspective(EYE, DVec3::X, DVec3::Y, 1.0, x, 0.1, 9.0).err()),
        ("near", |x| View::perspective(EYE, DVec3::X, DVec3::Y, 1.0, 1.0, x, INFINITY).err()),
        ("half_height", |x| View::orthographic(EYE, DVec3::X, DVec3::Y, x, 1.0, 0.1, 9.0).err()),
        ("aspect", |x| View::orthographic(EYE, DVec3::X, DVec3::Y, 1.0, x, 0.1, 9.0).err()),
        ("near", |x| Light::point(EYE, x, INFINITY).err()),
        ("near", |x| Light::spot(EYE, DVec3::X, 1.0, x, INFINITY).err()),
        ("near", |x| Light::hemisphere(EYE, DVec3::X, x, INFINITY).err()),
    ];
    for (field, make) in doors {
        for (value, problem) in bad {
            // A −1 for near is no more than a small one: it says so, not that it is out of order.
            assert_eq!(found(make(value)), Some((field, problem)), "{field} = {value}");
        }
        assert_eq!(make(1.0), None);
    }
    // Those that may be infinite.
    type Far = fn(f64) -> Option<InputError>;
    let doors: [(&str, Far); 4] = [
        ("far", |x| View::perspective(EYE, DVec3::X, DVec3::Y, 1.0, 1.0, 0.1, x).err()),
        ("range", |x| Light::point(EYE, 0.1, x).err()),
        ("range", |x| Light::spot(EYE, DVec3::X, 1.0, 0.1, x).err()),
        ("range", |x| Light::hemisphere(EYE, DVec3::X, 0.1, x).err()),
    ];
    for (field, make) in doors {
        for (value, problem) in bad {
            let expected = (value != INFINITY).then_some((field, problem));
            assert_eq!(found(make(value)), expected, "{field} = {value}");
        }
        for value in [0.1, 0.05] {
            assert_eq!(found(make(value)), Some((field, InputErrorKind::OutOfOrder)), "{field} = {value}");
        }
    }
}

#[test]
fn depths_of_orthographic_views() {
    let view = |near, far| View::orthographic(EYE, DVec3::X, DVec3::Y, 1.0, 1.0, near, far);
    for value in NOT_FINITE {
        refused(view(value, 9.0), "near", InputErrorKind::NotFinite);
        refused(view(0.1, value), "far", InputErrorKind::NotFinite);
    }
    refused(view(-1e13, 9.0), "near", InputErrorKind::TooLarge);
    refused(view(0.1, 1e13), "far", InputErrorKind::TooLarge);
    refused(view(2.0, 2.0), "far", InputErrorKind::OutOfOrder);
    refused(view(2.0, 1.0), "far", InputErrorKind::OutOfOrder);
    assert!(view(-5.0, -0.0).is_ok());
}

#[test]
fn narrowed_views() {
    let view = View::perspective(EYE, DVec3::X, DVec3::Y, 1.0, 1.0, 1.0, 9.0).unwrap();
    refused(view.narrowed(NAN, 9.0), "near", InputErrorKind::NotFinite);
    refused(view.narrowed(1.0, NAN), "far", InputErrorKind::NotFinite);
    for (near, far) in [(3.0, 3.0), (3.0, 2.0), (INFINITY, 9.0), (INFINITY, INFINITY)] {
        refused(view.narrowed(near, far), "far", InputErrorKind::OutOfOrder);
    }
    // A range that misses the view, to the step.
    refused(view.narrowed(9.0, INFINITY), "near", InputErrorKind::OutsideView);
    refused(view.narrowed(-INFINITY, 1.0), "far", InputErrorKind::OutsideView);
    assert!(view.narrowed(9.0_f64.next_down(), INFINITY).is_ok() && view.narrowed(0.0, 1.0_f64.next_up()).is_ok());
    for (near, far) in [(1.0, 9.0), (0.5, 9.5), (-INFINITY, INFINITY)] {
        assert_eq!(view.narrowed(near, far).unwrap(), view);
    }
}

/// A view matrix that is fine, and a projection that is, right-handed with depth from 0 to 1.
fn matrices() -> (DMat4, DMat4) {
    let (near, far) = (0.5, 50.0);
    let clip_from_eye = DMat4::from_cols(
        DVec4::new(1.0, 0.0, 0.0, 0.0),
        DVec4::new(0.0, 1.5, 0.0, 0.0),
        DVec4::new(0.0, 0.0, -far / (far - near), -1.0),
        DVec4::new(0.0, 0.0, -near * far / (far - near), 0.0),
    );
    (DMat4::from_rotation_y(0.7) * DMat4::from_translation(-EYE), clip_from_eye)
}

#[test]
fn every_entry_of_a_matrix_must_be_finite() {
    let (eye_from_world, clip_from_eye) = matrices();
    assert!(View::from_matrices(eye_from_world, clip_from_eye, ClipSpace::WGPU).is_ok());
    for (column, row) in (0..16).map(|entry| (entry / 4, entry % 4)) {
        for value in NOT_FINITE {
            let put = |mut matrix: DMat4| {
                matrix.col_mut(column)[row] = value;
                matrix
            };
            let view = View::from_matrices(put(eye_from_world), clip_from_eye, ClipSpace::WGPU);
            refused(view, "eye_from_world", InputErrorKind::NotFinite);
            let view = View::from_matrices(eye_from_world, put(clip_from_eye), ClipSpace::WGPU);
            refused(view, "clip_from_eye", InputErrorKind::NotFinite);
        }
    }
}

#[test]
fn matrices_that_are_no_cameras() {
    let (eye_from_world, clip_from_eye) = matrices();
    let flat = DMat4::from_scale(DVec3::new(1.0, 1.0, 0.0));
    for matrix in [DMat4::ZERO, flat * eye_from_world] {
        let view = View::from_matrices(matrix, clip_from_eye, ClipSpace::WGPU);
        refused(view, "eye_from_world", InputErrorKind::Singular);
    }
    let mut one_row = clip_from_eye.transpose();
    one_row.y_axis = one_row.x_axis;
    for matrix in [DMat4::ZERO, one_row.transpose()] {
        refused(
            View::from_matrices(eye_from_world, matrix, ClipSpace::WGPU),
            "clip_from_eye",
            InputErrorKind::Singular,
        );
        let combined = matrix * eye_from_world;
        refused(View::from_clip_from_world(combined, ClipSpace::WGPU), "clip_from_world", InputErrorKind::Singular);
    }
    // Parallel lines of sight, and w negative all over.
    let view = View::from_clip_from_world(-DMat4::IDENTITY, ClipSpace::WGPU);
    refused(view, "clip_from_world", InputErrorKind::NotAProjection);
    for value in NOT_FINITE {
        let view = View::from_clip_from_world(clip_from_eye * value, ClipSpace::WGPU);
        refused(view, "clip_from_world", InputErrorKind::NotFinite);
    }
}

/// A matrix made for row vectors decodes as a perspective with its near plane at 1 − near/far, and says so instead.
#[test]
fn matrices_that_look_transposed() {
    let (eye_from_world, clip_from_eye) = matrices();
    let reversed = DMat4::from_cols(DVec4::X, DVec4::Y * 1.5, DVec4::NEG_W, DVec4::Z * 0.1);
    let mut off_axis = clip_from_eye;
    (off_axis.z_axis.x, off_axis.z_axis.y) = (0.1, -0.2);
    let deep = DMat4::from_cols(DVec4::X, DVec4::Y, DVec4::new(0.0, 0.0, -1.0001, -1.0), DVec4::Z * -0.10001);
    for matrix in [clip_from_eye, off_axis, deep] {
        let combined = (matrix * eye_from_world).transpose();
        let view = View::from_clip_from_world(combined, ClipSpace::WGPU);
        refused(view, "clip_from_world", InputErrorKind::LooksTransposed);
    }
    for clip in [ClipSpace::WGPU, ClipSpace::WGPU.reversed(), ClipSpace::OPENGL] {
        for matrix in [clip_from_eye, reversed, off_axis, deep] {
            let view = View::from_matrices(eye_from_world, matrix.transpose(), clip);
            refused(view, "clip_from_eye", InputErrorKind::LooksTransposed);
        }
        let view = View::from_matrices(eye_from_world.transpose(), clip_from_eye, clip);
        refused(view, "eye_from_world", InputErrorKind::LooksTransposed);
    }
}

/// A projection without an image, or without any depth, is refused as what it is, not with a NaN.
#[test]
fn singular_projections() {
    let (eye_from_world, clip_from_eye) = matrices();
    let projection = |matrix: DMat4| View::from_matrices(eye_from_world, matrix, ClipSpace::WGPU);
    for row in 0..2 {
        let mut matrix = clip_from_eye.transpose();
        *matrix.col_mut(row) = DVec4::ZERO;
        assert_eq!(projection(matrix.transpose()).unwrap_err().field, "frame");
    }
    let mut matrix = clip_from_eye.transpose();
    matrix.z_axis = DVec4::ZERO;
    assert!(["near", "far"].contains(&projection(matrix.transpose()).unwrap_err().field));
    // Orthographic, with no depth at all.
    let flat = DMat4::from_scale(DVec3::new(1.0, 1.0, 0.0));
    assert!(["near", "far"].contains(&projection(flat).unwrap_err().field));
}

/// Reversed depth read as forward depth, and the other way round: near and far change places.
#[test]
fn projections_read_in_the_wrong_convention() {
    let (eye_from_world, clip_from_eye) = matrices();
    let clip = ClipSpace::WGPU.reversed();
    refused(View::from_matrices(eye_from_world, clip_from_eye, clip), "clip", InputErrorKind::LooksReversed);
    let combined = clip_from_eye * eye_from_world;
    refused(View::from_clip_from_world(combined, clip), "clip", InputErrorKind::LooksReversed);
    // An infinite far plane, reversed, has its near plane at infinity when read as forward.
    let mut infinite = clip_from_eye;
    (infinite.z_axis.z, infinite.w_axis.z) = (0.0, 0.5);
    assert!(View::from_matrices(eye_from_world, infinite, clip).is_ok());
    let wrong = View::from_matrices(eye_from_world, infinite, ClipSpace::WGPU);
    refused(wrong, "clip", InputErrorKind::LooksReversed);
}

#[test]
fn boxes_of_scenes() {
    let (min, max) = (DVec3::splat(-1.0), DVec3::splat(1.0));
    for axis in 0..3 {
        for value in NOT_FINITE {
            refused(Scene::from_box(with(min, axis, value), max), "min", InputErrorKind::NotFinite);
            refused(Scene::from_box(min, with(max, axis, value)), "max", InputErrorKind::NotFinite);
            refused(ConvexScene::new(with(min, axis, value), max, &[]), "min", InputErrorKind::NotFinite);
        }
        refused(Scene::from_box(with(min, axis, -1e13), max), "min", InputErrorKind::TooLarge);
        refused(Scene::from_box(min, with(max, axis, 1e13)), "max", InputErrorKind::TooLarge);
        refused(Scene::from_box(with(min, axis, 1.5), max), "max", InputErrorKind::OutOfOrder);
        refused(ConvexScene::new(with(min, axis, 1.5), max, &[]), "max", InputErrorKind::OutOfOrder);
        assert!(Scene::from_box(with(min, axis, 1.0), max).is_ok(), "flat");
    }
    assert!(Scene::from_box(max, max).is_ok(), "a point");
}

#[test]
fn lists_of_scenes() {
    let fine = [Aabb::new(Vec3::splat(-1.0), Vec3::splat(1.0))];
    for (value, problem) in [
        (f32::NAN, InputErrorKind::NotFinite),
        (f32::INFINITY, InputErrorKind::NotFinite),
        (f32::NEG_INFINITY, InputErrorKind::NotFinite),
        (1e13, InputErrorKind::TooLarge),
        (-2.0, InputErrorKind::OutOfOrder),
    ] {
        let bad = [fine[0], Aabb::new(fine[0].min, Vec3::new(1.0, value, 1.0)), fine[0]];
        for (scene, field) in [(Scene::new(&bad, &fine), "casters"), (Scene::new(&fine, &bad), "receivers")] {
            assert_eq!((scene.unwrap_err().index, scene.unwrap_err().component), (Some(1), Some("max.y")));
            refused(scene, field, problem);
        }
    }
}

#[test]
fn planes_of_convex_scenes() {
    let scene = |planes: &[Plane]| ConvexScene::new(DVec3::splat(-1.0), DVec3::splat(1.0), planes);
    for value in NOT_FINITE {
        refused(scene(&[Plane::new(DVec3::X, value)]), "planes", InputErrorKind::NotFinite);
        for axis in 0..3 {
            refused(scene(&[Plane::new(with(DVec3::X, axis, value), 0.0)]), "planes", InputErrorKind::NotFinite);
        }
    }
    refused(scene(&[Plane::new(DVec3::ZERO, 1.0)]), "planes", InputErrorKind::NoDirection);
    assert_eq!(scene(&[Plane::new(DVec3::X, 0.0), Plane::ONE]).unwrap_err().index, Some(1));
    for value in NOT_FINITE {
        refused(
            ConvexScene::around([DVec3::ZERO, with(DVec3::ONE, 1, value)]),
            "points",
            InputErrorKind::NotFinite,
        );
    }
    refused(ConvexScene::around([DVec3::splat(1e13)]), "points", InputErrorKind::TooLarge);
}

/// Planes may be of any length that a direction may be of.
#[test]
fn planes_of_any_length() {
    for length in [DENORMAL, 1e-300, 1e-200, 1e200, 1e300] {
        let cut = [Plane::new(DVec3::X * length, 0.0)];
        match ConvexScene::new(DVec3::splat(-1.0), DVec3::splat(1.0), &cut) {
            Ok(scene) => {
                let view = View::orthographic(EYE, DVec3::NEG_Z, DVec3::Y, 9.0, 1.0, -9.0, 9.0).unwrap();
                let light = Light::directional(DVec3::Y).unwrap();
                let settings = Settings::default();
                let Outcome::Map(map) = fit(&view, &light, &Scene::from_convex(&scene), &settings) else {
                    panic!("no map");
                };
                assert!(map.caster_matrix().is_finite());
            }
            Err(error) => assert_eq!(error.field, "planes"),
        }
    }
}

#[test]
fn sizes_of_settings() {
    for (size, problem) in [
        (0, InputErrorKind::TooSmall),
        (3, InputErrorKind::TooSmall),
        (Settings::MAX_SIZE + 1, InputErrorKind::TooLarge),
        (u32::MAX, InputErrorKind::TooLarge),
    ] {
        refused(Settings::new(size, 1080), "map_size", problem);
        refused(Settings::new(2048, size), "image_height", problem);
    }
    let settings = Settings::new(16, 4).unwrap();
    refused(settings.with_border(5), "border", InputErrorKind::TooLarge);
    refused(settings.with_border(u32::MAX), "border", InputErrorKind::TooLarge);
    assert_eq!(settings.with_border(4).unwrap().border(), 4);
    refused(settings.with_map_size(3), "map_size", InputErrorKind::TooSmall);
    refused(settings.with_border(4).unwrap().with_map_size(15), "border", InputErrorKind::TooLarge);
    assert_eq!(settings.with_map_size(64).unwrap().map_size(), 64);
    for (size, problem) in [(3, InputErrorKind::TooSmall), (Settings::MAX_SIZE + 1, InputErrorKind::TooLarge)] {
        refused(settings.with_map_sides(size, 16), "map_width", problem);
        refused(settings.with_map_sides(16, size), "map_height", problem);
    }
}

/// The border is that of the shorter side, and a size makes the map square again.
#[test]
fn sides_of_settings() {
    let settings = Settings::new(16, 4).unwrap().with_border(4).unwrap();
    assert_eq!((settings.map_sides(), settings.map_size()), ((16, 16), 16));
    for (width, height) in [(16, 64), (64, 16)] {
        let settings = settings.with_map_sides(width, height).unwrap();
        assert_eq!((settings.map_sides(), settings.map_size(), settings.border()), ((width, height), 16, 4));
        refused(settings.with_border(5), "border", InputErrorKind::TooLarge);
        assert_eq!(settings.with_map_size(32).unwrap().map_sides(), (32, 32));
    }
    refused(settings.with_map_sides(15, 64), "border", InputErrorKind::TooLarge);
    refused(settings.with_map_sides(64, 15), "border", InputErrorKind::TooLarge);
    assert_eq!(settings.with_map_sides(32, 32).unwrap(), settings.with_map_size(32).unwrap());
}

#[cfg(feature = "alloc")]
#[test]
fn plans() {
    let budget = Budget::new(Settings::default());
    for value in NOT_FINITE {
        refused(budget.with_aliasing(value), "aliasing", InputErrorKind::NotFinite);
    }
    for value in [0.0, -1.0, DENORMAL] {
        refused(budget.with_aliasing(value), "aliasing", InputErrorKind::TooSmall);
    }
    assert_eq!(budget.with_aliasing(0.5).unwrap().aliasing(), 0.5);

    let sound = Object::new(Aabb::new(Vec3::ZERO, Vec3::ONE));
    assert!(Objects::new(&[]).is_ok() && Objects::new(&[sound]).is_ok());
    let bounds = [
        (Aabb::new(Vec3::NAN, Vec3::ONE), InputErrorKind::NotFinite),
        (Aabb::new(Vec3::ZERO, Vec3::INFINITY), InputErrorKind::NotFinite),
        (Aabb::new(Vec3::ZERO, Vec3::splat(1e13)), InputErrorKind::TooLarge),
        (Aabb::new(Vec3::ONE, Vec3::ZERO), InputErrorKind::OutOfOrder),
    ];
    for (bounds, problem) in bounds {
        refused(Objects::new(&[sound, Object { bounds, ..sound }]), "objects", problem);
    }
    for (longest_edge, problem) in [(f32::NAN, InputErrorKind::NotFinite), (-1.0, InputErrorKind::TooSmall)] {
        refused(Objects::new(&[Object { longest_edge, ..sound }]), "objects", problem);
    }
}

/// The messages, as someone reads them in a log.
#[test]
fn messages_are_sentences() {
    let fine = Aabb::new(Vec3::ZERO, Vec3::ONE);
    let boxes = [fine, fine, Aabb::new(Vec3::new(0.0, f32::NAN, 0.0), Vec3::ONE)];
    let messages = [
        View::perspective(EYE, DVec3::X, DVec3::Y, 1.0, 1.0, 9.0, 0.1).unwrap_err(),
        View::perspective(EYE, DVec3::X, DVec3::X, 1.0, 1.0, 0.1, 9.0).unwrap_err(),
        View::from_matrices(DMat4::ZERO, DMat4::IDENTITY, ClipSpace::WGPU).unwrap_err(),
        View::from_matrices(DMat4::IDENTITY, DMat4::ZERO, ClipSpace::WGPU).unwrap_err(),
        Light::directional(DVec3::ZERO).unwrap_err(),
        View::perspective(EYE, DVec3::X, DVec3::Y, 60.0, 1.0, 0.1, 9.0).unwrap_err(),
        View::perspective(EYE, DVec3::X, DVec3::Y, 4.0, 1.0, 0.1, 9.0).unwrap_err(),
        Light::spot(EYE, DVec3::X, 2.0, 0.1, 9.0).unwrap_err(),
        Light::spot(EYE, DVec3::X, 30.0, 0.1, 9.0).unwrap_err(),
        Light::spot(EYE, DVec3::X, -0.5, 0.1, 9.0).unwrap_err(),
        Light::point(EYE, 0.1, 0.0).unwrap_err(),
        Light::point(EYE, 0.1, 0.05).unwrap_err(),
        Light::point(EYE * 1e30, 0.1, 9.0).unwrap_err(),
        Light::directional(with(DVec3::Y, 2, INFINITY)).unwrap_err(),
        Light::point(EYE, 0.0, 9.0).unwrap_err(),
        Light::point(EYE, NAN, 9.0).unwrap_err(),
        Light::directional(DVec3::X).unwrap().cube_face(CubeFace::PositiveX, 0.0).unwrap_err(),
        Scene::from_box(DVec3::ONE, with(DVec3::ONE, 1, 0.5)).unwrap_err(),
        Scene::from_box(DVec3::ONE, DVec3::ZERO).unwrap_err(),
        Scene::new(&boxes, &[]).unwrap_err(),
        Scene::new(&boxes[..2], &[Aabb::new(Vec3::splat(f32::MIN), Vec3::splat(f32::MAX))]).unwrap_err(),
        ConvexScene::new(DVec3::ZERO, DVec3::ONE, &[Plane::new(DVec3::X, 0.0), Plane::ONE]).unwrap_err(),
        Settings::default().with_border(4000).unwrap_err(),
        Light::point((f64::NEG_INFINITY, 0.0, 0.0), 0.1, 9.0).unwrap_err(),
        View::perspective(EYE, DVec3::X, DVec3::Y, DENORMAL, 1.0, 0.1, 9.0).unwrap_err(),
        View::perspective(EYE, DVec3::X, DVec3::Y, 1.0, 0.0, 0.1, 9.0).unwrap_err(),
        View::perspective(EYE, DVec3::X, DVec3::Y, 1.0, 1.0, 0.1, 0.0).unwrap_err(),
        Tangents::from_angles(-45.0, 45.0, -45.0, 45.0).unwrap_err(),
        Tangents::from_angles(-0.8, NAN, -0.8, 0.8).unwrap_err(),
        view_of(Tangents { left: 0.5, right: -0.5, bottom: -0.5, top: 0.5 }).unwrap_err(),
        view_of(Tangents { left: -0.5, right: 0.5, bottom: NAN, top: 0.5 }).unwrap_err(),
        view().narrowed(100.0, 200.0).unwrap_err(),
        view().narrowed(0.01, 0.05).unwrap_err(),
        Light::spot(EYE, DVec3::X, 0.5, 0.1, 9.0).unwrap().with_up(DVec3::X).unwrap_err(),
        Light::point(EYE, 0.1, 9.0).unwrap().with_up(DVec3::X).unwrap_err(),
        Light::directional(DVec3::Y).unwrap().within(&[Plane::new(DVec3::X, 0.0); 7]).unwrap_err(),
        Light::pyramid(EYE, DVec3::X, DVec3::Y, [0.5, 300.0], 0.1, 9.0).unwrap_err(),
        Settings::new(1, 1080).unwrap_err(),
    ];
    let text = messages.map(|message| message.to_string()).join("\n");
    insta::assert_snapshot!(text);
}

/// The messages about matrices: the entry, the value, and what to try.
#[test]
fn messages_about_matrices() {
    let (eye_from_world, clip_from_eye) = matrices();
    let mut broken = clip_from_eye;
    broken.z_axis.w = NAN;
    let lens =
        |x: DVec4, z: f64, w: f64| DMat4::from_cols(x, DVec4::Y * 1.5, DVec4::new(0.0, 0.0, z, -1.0), DVec4::Z * w);
    let (behind, oblique) = (lens(DVec4::X, -2.0, 1.0), lens(DVec4::new(1.0, 0.0, 1e-3, 0.0), 1.0, -1.0));
    let sun = Light::directional(DVec3::new(0.3, 1.0, 0.1)).unwrap();
    let ground = Scene::from_box((-50.0, 0.0, -50.0), (50.0, 5.0, 50.0)).unwrap();
    let Outcome::Map(map) = fit(&view(), &sun, &ground, &Settings::default().with_warp(Warp::LightSpace)) else {
        panic!("a map");
    };
    let (wgpu, reversed) = (ClipSpace::WGPU, ClipSpace::WGPU.reversed());
    let messages = [
        View::from_matrices(eye_from_world, broken, wgpu),
        View::from_matrices(eye_from_world.transpose(), clip_from_eye, wgpu),
        View::from_matrices(eye_from_world, clip_from_eye.transpose(), wgpu),
        View::from_matrices(eye_from_world, clip_from_eye, reversed),
        View::from_matrices(eye_from_world, behind, wgpu),
        View::from_clip_from_world(behind, wgpu),
        View::from_matrices(eye_from_world, oblique, wgpu),
        View::from_clip_from_world(-DMat4::IDENTITY, wgpu),
        View::from_clip_from_world(map.clip_from_world(), wgpu),
        View::from_clip_from_world(DMat4::from_scale(DVec3::new(1.0, 0.0, 1.0)), wgpu),
    ];
    let text = messages.map(|message| message.unwrap_err().to_string()).join("\n");
    insta::assert_snapshot!(text);
}

fn view() -> View {
    View::perspective(EYE, DVec3::X, DVec3::Y, 1.0, 1.0, 0.1, 80.0).unwrap()
}

fn view_of(tangents: Tangents) -> Result<View, InputError> {
    View::from_tangents(EYE, DVec3::X, DVec3::Y, tangents, 0.1, 80.0)
}
