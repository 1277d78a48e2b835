//! Figures that have closed forms, and configurations that must give the same answer.
//!
//! The table of DESIGN section 2: light at right angles to the view, all of V receives, T the tangent of half the field
//! of view. Rs and Rt are the texels needed across and along the warp for each pixel of the image's height, so that no
//! texel is larger than a pixel:
//!
//! ```text
//!     uniform    Rs = f/n      Rt = (f − n)/(2T n)
//!     PSM        Rs = 1        Rt = (f − n)/(2T n)
//! ```

use approx::assert_relative_eq;
use shadowfit::glam::DVec3;
use shadowfit::{ClassKind, Focus, Light, Map, Outcome, Scene, Settings, Shift, View, Warp, classify, fit};

/// The field of view with 2T = 1, twice the angle whose tangent is a half.
const FOV: f64 = 0.927_295_218_001_612_2;
/// As many texels a side as the image has pixels, so that a ratio of sizes is a ratio of counts.
const PIXELS: u32 = 1024;

fn settings(warp: Warp) -> Settings {
    let settings = Settings::new(PIXELS, PIXELS).unwrap().with_border(0).unwrap();
    settings.with_warp(warp).with_shift(Shift::None)
}

fn map(outcome: Outcome) -> Map {
    *outcome.map().expect("a map")
}

/// Texels needed across and along the warp for each pixel, the worst over V.
fn needed(far: f64, warp: Warp) -> (f64, f64) {
    let view = View::perspective(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, FOV, 1.0, 1.0, far).unwrap();
    let light = Light::directional(DVec3::Y).unwrap();
    let side = DVec3::splat(2.0 * far);
    let scene = Scene::from_box(-side, side).unwrap();
    let focus = Focus::new(&view, &light, &scene);
    let map = map(focus.fit(&settings(warp)));

    // A ten-thousandth for rounding is all that it may be.
    let padding = map.window().padding;
    assert!(padding.0 > 0.0 && padding.0 < 1e-4 && padding.1 > 0.0 && padding.1 < 1e-4, "{padding:?}");
    // The warp runs along y. What the window is larger than R by, it says, and footprints are larger by as much.
    let (across, along) = padding;
    let body = focus.visible();
    body.vertices().iter().fold((0.0, 0.0), |(rs, rt): (f64, f64), &point| {
        let (texel, pixel) = (map.footprint(point).unwrap(), map.pixel_size(point));
        let step = texel.along_x.length();
        (rs.max(step / pixel * (1.0 - across)), rt.max(texel.area() / step / pixel * (1.0 - along)))
    })
}

/// What is left when the window's padding, 1e-6 and more of it, is divided out: planes stand 96 ε of the sum of their
/// terms' magnitudes outside, here of two coordinates of 2f, and a corner is where three of them meet, the nearest at n,
/// f/n = 10⁴ at most.
const CLOSE: f64 = 3.0 * 96.0 * f64::EPSILON * 2.0 * 2e4;

#[test]
fn texels_needed_by_the_uniform_map() {
    for far in [10.0, 100.0, 1000.0, 1e4] {
        let (rs, rt) = needed(far, Warp::Uniform);
        assert_relative_eq!(rs, far, max_relative = CLOSE);
        assert_relative_eq!(rt, far - 1.0, max_relative = CLOSE);
    }
}

#[test]
fn texels_needed_by_the_perspective_map() {
    for far in [10.0, 100.0, 1000.0, 1e4] {
        let (rs, rt) = needed(far, Warp::Perspective);
        assert_relative_eq!(rs, 1.0, max_relative = CLOSE);
        assert_relative_eq!(rt, far - 1.0, max_relative = CLOSE);
    }
}

/// Light along the view or against it: there is no perspective to undo, the warp is the uniform map, also where what is
/// visible is off the axis.
#[test]
fn along_the_view_the_warp_is_the_uniform_map() {
    let eye = DVec3::new(3.0, -2.0, 7.0);
    let forward = DVec3::new(0.48, -0.6, 0.64);
    let view = View::perspective(eye, forward, DVec3::Y, 1.1, 1.6, 0.3, 400.0).unwrap();
    for (min, max) in [
        (DVec3::splat(-600.0), DVec3::splat(600.0)),
        (eye + DVec3::new(4.0, -40.0, 10.0), eye + DVec3::new(60.0, -3.0, 31.0)),
        (eye + DVec3::new(-1.0, -9.0, 1.0), eye + DVec3::new(2.0, -2.0, 80.0)),
    ] {
        let scene = Scene::from_box(min, max).unwrap();
        for direction in [forward, -forward] {
            let light = Light::directional(direction).unwrap();
            let focus = Focus::new(&view, &light, &scene);
            let warped = map(focus.fit(&settings(Warp::Perspective)));
            let uniform = map(focus.fit(&settings(Warp::Uniform)));
            assert_relative_eq!(warped.warp_ratio(), 1.0, epsilon = CLOSE);
            for &point in focus.visible().vertices() {
                let (ours, theirs) = (warped.aliasing(point), uniform.aliasing(point));
                assert_relative_eq!(ours.unwrap(), theirs.unwrap(), max_relative = CLOSE);
            }
        }
    }
}

/// HARD_CASES row 15. From a light at a distance D a scene of size S is seen under an angle S/D: rays differ by that
/// from those of a light at infinity, and each coordinate in the map by a few times that.
#[test]
fn a_light_far_away_is_a_directional_light() {
    const DISTANCE: f64 = 1e9;
    const SIZE: f64 = 200.0;
    let eye = DVec3::new(10.0, 2.0, -30.0);
    let view = View::perspective(eye, DVec3::new(0.3, -0.1, 1.0), DVec3::Y, 1.0, 1.5, 0.5, 150.0).unwrap();
    let low = DVec3::new(-80.0, 0.0, -80.0);
    let high = DVec3::new(80.0, 20.0, 80.0);
    let scene = Scene::from_box(low, high).unwrap();
    for direction in [
        DVec3::new(0.0, 1.0, 0.0),
        DVec3::new(0.5, 0.7, 0.2),
        DVec3::new(-0.3, 0.4, 0.9),
        DVec3::new(0.1, 0.2, -0.9),
    ] {
        let sun = Light::directional(direction).unwrap();
        let position = sun.homogeneous().truncate() * DISTANCE;
        let lamp = Light::point(position, 1.0, f64::INFINITY).unwrap();
        for warp in [Warp::Uniform, Warp::Perspective] {
            for shift in [Shift::None, Shift::Back(shadowfit::Form::Tight)] {
                let settings = settings(warp).with_shift(shift);
                let near = map(fit(&view, &lamp, &scene, &settings));
                let infinite = map(fit(&view, &sun, &scene, &settings));
                let focus = Focus::new(&view, &sun, &scene);
                for &point in focus.visible().vertices() {
                    let [a, b] = [near, infinite].map(|map| {
                        let clip = map.shadow_from_world() * point.extend(1.0);
                        clip.truncate() / clip.w
                    });
                    let off = (a - b).abs().max_element();
                    assert!(off < 8.0 * SIZE / DISTANCE, "{direction}, {warp:?}: {a} {b}");
                    let [a, b] = [near, infinite].map(|map| map.aliasing(point).unwrap());
                    assert_relative_eq!(a, b, max_relative = 8.0 * SIZE / DISTANCE);
                }
            }
        }
    }
}

/// HARD_CASES row 1: λw = 0 with either sign is one light, and one map to the last bit.
#[test]
fn negative_zero_is_zero() {
    let scene = Scene::from_box(DVec3::new(-50.0, -2.0, -50.0), DVec3::new(50.0, 8.0, 50.0)).unwrap();
    for forward in [DVec3::Z, DVec3::NEG_Z] {
        let view = View::perspective(DVec3::ZERO, forward, DVec3::Y, 1.0, 1.3, 0.2, 90.0).unwrap();
        let across = |z: f64| DVec3::new(0.6, 0.8, z);
        let lamp = |z: f64| Light::point(across(z) * 20.0, 0.1, f64::INFINITY).unwrap();
        let sun = |z: f64| Light::directional(across(z)).unwrap();
        for [plus, minus] in [[lamp(0.0), lamp(-0.0)], [sun(0.0), sun(-0.0)]] {
            for light in [&plus, &minus] {
                assert_eq!(classify(&view, light).kind, ClassKind::Directional);
            }
            for warp in [Warp::Uniform, Warp::Perspective] {
                let [a, b] = [plus, minus].map(|light| map(fit(&view, &light, &scene, &settings(warp))));
                assert_eq!(a.shadow_from_world(), b.shadow_from_world());
                assert_eq!(a.warp_ratio(), b.warp_ratio());
            }
        }
    }
}
