//! What the window has room for.

use super::cameras::{Form, Lens, lens, middle, rows, sides, stable, texels, two_poses};
use glam::DVec3;
use proptest::prelude::*;
use shadowfit::{Light, Origin, Scene, Settings, View, Warp, fit, omni::CubeFace};
use std::cell::Cell;
use testkit::arbitrary::{self, Together, case, points_of, run, settings};

/// The window that what is visible needs is inside of the one that is there, in every case: no slack is left to roundings of
/// f64, since the room for those of f32 is far larger.
#[test]
fn the_window_holds_what_is_visible() {
    run(5000, &(case(), settings(), any::<u64>()), |(case, settings, seed)| {
        let together = Together::of(&case);
        let focus = together.focus();
        let [map, uniform] = [Warp::Stable, Warp::Uniform].map(|warp| focus.fit(&settings.with_warp(warp)));
        let (Some(map), Some(uniform)) = (map.into_map(), uniform.into_map()) else { return };
        let size = arbitrary::sides(&settings);
        if map.fallback().is_some() {
            assert_eq!(map.caster_matrix(), uniform.caster_matrix());
            return;
        }
        let border = f64::from(settings.border());
        for point in points_of(&focus.receiver_volume(), seed) {
            // Where f32 may put a point anywhere, nothing is promised of it.
            if !together.is_served(point) || map.place_rounding(point) > 0.25 * size.min_element() {
                continue;
            }
            let place = texels(&map, point);
            let is_inside = place.min_element() >= border && place.cmple(size - border).all();
            assert!(is_inside, "{point} is at {place} of {size}");
        }
    });
}

/// S is smaller than V, which has no end: nothing of the window moves at all, whatever the camera does, and depth not often.
#[test]
fn a_scene_that_is_smaller_than_the_view_has_one_window() {
    let endless = lens().prop_map(|lens| Lens { far: 1e6, orthographic: false, ..lens });
    let light = arbitrary::rotation();
    run(1000, &(endless, two_poses(), middle(), light, stable(), any::<bool>()), |case| {
        let (lens, poses, middle, sun, settings, infinite) = case;
        let settings = settings.with_origin(Origin::Eye);
        let light = Light::directional(sun * DVec3::Y).expect("a legal light");
        for form in [Form::Block, Form::Flat, Form::Convex] {
            form.with(middle, |scene| {
                let maps = poses.map(|pose| {
                    let view = lens.view(middle, &pose);
                    let eye = middle + DVec3::from(pose.eye);
                    let slope = (0.5 * lens.fov_y).tan();
                    let endless = View::perspective(
                        eye,
                        view.forward(),
                        view.up(),
                        2.0 * slope.atan(),
                        lens.aspect,
                        lens.near,
                        f64::INFINITY,
                    );
                    let view = if infinite { endless.expect("a legal view") } else { view };
                    fit(&view, &light, scene, &settings).into_map()
                });
                let [Some(one), Some(other)] = maps else { return };
                let (a, b) = (rows(&one), rows(&other));
                assert_eq!([a.x_axis, a.y_axis, a.w_axis], [b.x_axis, b.y_axis, b.w_axis]);
            });
        }
    });
}

/// Spots and faces of cubes have one window, and the same rows to the bit.
#[test]
fn lamps_with_a_frustum_of_their_own_have_one_window() {
    let lamp = (prop::array::uniform3(-20.0..20.0), arbitrary::rotation(), 0.1..1.4, 10.0..300.0, 0..12_usize);
    let cases = (lens(), two_poses(), middle(), lamp, stable(), any::<bool>());
    let [counted, grown] = [(); 2].map(|()| Cell::new(0_usize));
    run(3000, &cases, |(lens, poses, middle, (at, turn, half_angle, range, kind), settings, endless)| {
        let settings = settings.with_origin(Origin::Eye);
        let range = if endless { f64::INFINITY } else { range };
        let position = middle + DVec3::from(at) + DVec3::Y * 25.0;
        let axis = turn * DVec3::X;
        let face = |light: Light| light.cube_face(CubeFace::ALL[kind % 6], 0.1);
        let light = match kind {
            0..4 => Light::spot(position, axis, half_angle, 0.1, range),
            4..8 => Light::point(position, 0.1, range).and_then(face),
            _ => Light::hemisphere(position, axis, 0.1, range).and_then(face),
        };
        let light = light.expect("a legal light");
        for form in [Form::Block, Form::Lists] {
            form.with(middle, |scene| {
                let maps = poses.map(|pose| fit(&lens.view(middle, &pose), &light, scene, &settings).into_map());
                let [Some(one), Some(other)] = maps else { return };
                counted.set(counted.get() + 1);
                assert_eq!([one.fallback(), other.fallback()], [None; 2]);
                let [a, b] = [&one, &other].map(|map| {
                    let rows = rows(map);
                    [rows.x_axis, rows.y_axis, rows.w_axis]
                });
                if sides(&one) != sides(&other) {
                    // Next to a lamp f32 may need more, above all with an eye that is far from it.
                    grown.set(grown.get() + 1);
                    let times = (sides(&one) / sides(&other)).to_array();
                    assert!(times.iter().all(|times| times.log2().fract() == 0.0), "{times:?}");
                } else if endless {
                    let times = a[2].truncate().length() / b[2].truncate().length();
                    let times = 2.0_f64.powi(times.log2().round() as i32);
                    assert_eq!(a, b.map(|row| row * times));
                } else {
                    assert_eq!(a, b);
                }
            });
        }
    });
    assert!(counted.get() > 300, "{} maps", counted.get());
    // Measured: one in fifty.
    assert!(grown.get() * 20 < counted.get(), "{} of {}", grown.get(), counted.get());
}

/// What a spot lights is what its map is for.
#[test]
fn the_map_of_a_spot_is_as_wide_as_its_cone() {
    let view = View::perspective((0.0, 5.0, 20.0), DVec3::NEG_Z, DVec3::Y, 1.0, 1.6, 0.1, 100.0).expect("sound");
    let scene = Scene::from_box((-50.0, 0.0, -50.0), (50.0, 10.0, 50.0)).expect("sound");
    let settings = Settings::default().with_warp(Warp::Stable);
    for half_angle in [0.2, 0.7, 1.2] {
        let light = Light::spot((0.0, 9.0, 0.0), (0.3, -1.0, 0.2), half_angle, 0.1, 60.0).expect("sound");
        let map = fit(&view, &light, &scene, &settings).into_map().expect("one map does");
        let wide = 2.0 * half_angle.tan() * 2048.0 / 2046.0;
        for side in [map.window().width, map.window().height] {
            assert!(side >= wide && side <= wide * (1.0 + 1.0 / 128.0) * (1.0 + 1.0 / 4096.0), "{side} {wide}");
        }
    }
}
