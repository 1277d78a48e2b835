//! Row 36: what cannot be fitted is refused at the door, by the name of the field, and its neighbours on the legal side make
//! a fit without a NaN. `errors` has every door, `properties::any_numbers_make_a_fit_or_a_typed_error` any numbers at all.

use shadowfit::glam::{DMat4, DVec3};
use shadowfit::{
    ClipSpace, Focus, InputError, Light, Scene, Settings, View, fit,
    input::{InputErrorKind, MIN_DISTANCE},
};

use crate::sweep::steps;

#[track_caller]
fn refused<T>(result: Result<T, InputError>, field: &str, problem: InputErrorKind) {
    let error = result.err().expect("refused");
    assert_eq!((error.field, error.problem), (field, problem));
}

fn view_with(fov_y: f64, near: f64, far: f64) -> Result<View, InputError> {
    View::perspective(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, fov_y, 1.5, near, far)
}

fn spot(half_angle: f64) -> Result<Light, InputError> {
    Light::spot((0.0, 20.0, -10.0), DVec3::NEG_Y, half_angle, 0.1, 100.0)
}

fn scene() -> Scene<'static> {
    Scene::from_box((-20.0, -5.0, -40.0), (20.0, 5.0, 5.0)).expect("sound")
}

/// Nothing in a result is NaN.
fn exercise(view: &View, light: &Light, scene: &Scene<'_>) {
    let focus = Focus::new(view, light, scene);
    assert!(focus.receiver_volume().vertices().iter().all(|p| p.is_finite()));
    if let Some(map) = fit(view, light, scene, &Settings::default()).map() {
        assert!(
            map.caster_matrix().is_finite()
                && map.clip_from_world().is_finite()
                && map.receiver_matrix().is_finite()
        );
        assert!(map.warp_ratio().is_finite() && map.weakening().is_finite() && !map.depth().far.is_nan());
        let report = map.report(&focus);
        assert!(!report.aliasing.is_nan() && !report.texel.is_nan());
    }
}

#[test]
fn row_36_input_that_cannot_be_fitted() {
    let sound = (view_with(1.0, 0.5, 80.0).expect("sound"), Light::directional((0.3, 1.0, 0.2)).expect("sound"));
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        refused(Light::directional((bad, 0.0, 1.0)), "direction_to_light", InputErrorKind::NotFinite);
        refused(Light::point((0.0, bad, 1.0), 0.1, 9.0), "position", InputErrorKind::NotFinite);
        refused(view_with(1.0, bad, 9.0), "near", InputErrorKind::NotFinite);
        refused(Scene::from_box((0.0, 0.0, bad), DVec3::ONE), "min", InputErrorKind::NotFinite);
        let singular = View::from_matrices(DMat4::IDENTITY * bad, DMat4::IDENTITY, ClipSpace::WGPU);
        refused(singular, "eye_from_world", InputErrorKind::NotFinite);
    }
    // Denormal directions are directions; zero is none.
    for step in steps(0.0) {
        let light = Light::directional((step, 0.0, -step));
        if step == 0.0 {
            refused(light, "direction_to_light", InputErrorKind::NoDirection);
        } else {
            exercise(&sound.0, &light.expect("a direction"), &scene());
        }
    }
    // near and far, to the step.
    for far in steps(0.5) {
        match view_with(1.0, 0.5, far) {
            Ok(view) => {
                assert!(far > 0.5);
                exercise(&view, &sound.1, &scene());
            }
            Err(error) => {
                assert!(far <= 0.5, "{far:e}");
                assert_eq!((error.field, error.problem), ("far", InputErrorKind::OutOfOrder));
            }
        }
    }
    for near in steps(0.0).chain([-1.0]) {
        refused(view_with(1.0, near, 80.0), "near", InputErrorKind::TooSmall);
    }
    for near in steps(MIN_DISTANCE) {
        match view_with(1.0, near, 80.0) {
            Ok(view) => exercise(&view, &sound.1, &scene()),
            Err(error) => assert_eq!((error.field, error.problem), ("near", InputErrorKind::TooSmall)),
        }
    }
    // A singular camera.
    refused(
        View::from_matrices(DMat4::ZERO, DMat4::IDENTITY, ClipSpace::WGPU),
        "eye_from_world",
        InputErrorKind::Singular,
    );
    refused(
        View::from_matrices(DMat4::IDENTITY, DMat4::ZERO, ClipSpace::WGPU),
        "clip_from_eye",
        InputErrorKind::Singular,
    );
    // min > max, by a step; flat is legal.
    for max in steps(1.0) {
        match Scene::from_box((-9.0, 1.0, -9.0), (9.0, max, -3.0)) {
            Ok(scene) => {
                assert!(max >= 1.0);
                exercise(&sound.0, &sound.1, &scene);
            }
            Err(error) => {
                assert!(max < 1.0);
                assert_eq!((error.field, error.problem), ("max", InputErrorKind::OutOfOrder));
            }
        }
    }
    // Spots of nothing and of a half space.
    use std::f64::consts::{FRAC_PI_2, PI};
    for angle in steps(0.0).chain(steps(FRAC_PI_2)).chain([-0.5, 2.0, PI, f64::NAN]) {
        refused(spot(angle), "half_angle", InputErrorKind::AngleOutOfRange);
    }
    for angle in [1e-8, 1e-3, 0.7, 1.5, 1.570] {
        exercise(&sound.0, &spot(angle).expect("in range"), &scene());
    }
}
