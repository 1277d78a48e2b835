//! What f32 makes of a map, over views, lights and scenes at random: all that must be in it is, and its depths are as
//! quiet as it says.
//!
//! Each property runs some thousands of cases from a fixed seed; `SHADOWFIT_CASES=100000` in the environment runs that many
//! of each instead.

#![allow(clippy::disallowed_methods, reason = "angles and powers spread the cases, they are no part of a fit")]

mod arbitrary;
mod claims;

use arbitrary::{case, run, settings};
use claims::single_precision::{holds_what_it_must, is_as_quiet_as_it_says, rounding};
use glam::DVec3;
use proptest::prelude::*;
use shadowfit::{Focus, Light, Origin, Scene, Settings, View, Warp};

#[test]
fn maps_hold_what_they_must() {
    run(5000, &(case(), settings(), any::<u64>()), |(case, settings, seed)| {
        holds_what_it_must(&case, &settings, seed);
    });
}

#[test]
fn depths_are_as_quiet_as_the_map_says() {
    run(5000, &(case(), settings(), any::<u64>()), |(case, settings, seed)| {
        is_as_quiet_as_it_says(&case, &settings, seed);
    });
}

/// Found by drawing it: with a depth range no longer than needed, all of a plate under the sun shadowed itself.
#[test]
fn a_plate_under_light_from_above_does_not_drown_in_noise() {
    let view =
        View::perspective((0.0, 2.0, 12.0), (0.0, -0.2, -1.0), DVec3::Y, 1.0, 1.6, 0.1, 100.0).expect("sound");
    let scene = Scene::from_box((-20.0, 0.0, -20.0), (20.0, 0.0, 20.0)).expect("sound");
    let lights = [
        Light::directional(DVec3::Y),
        Light::directional((1e-3, 1.0, -2e-3)),
        Light::point((1.0, 30.0, 2.0), 0.1, f64::INFINITY),
    ];
    for light in lights.map(|light| light.expect("sound")) {
        for warp in [Warp::Uniform, Warp::Perspective] {
            for origin in [Origin::World, Origin::Eye] {
                let settings = Settings::default().with_warp(warp).with_origin(origin);
                let focus = Focus::new(&view, &light, &scene);
                let map = *focus.fit(&settings).map().expect("one map does");
                let of_w = |point: &DVec3| rounding(&map, &view, *point).1;
                let of_w = focus.visible().vertices().iter().map(of_w).fold(0.0, f64::max);
                for point in focus.visible().vertices() {
                    let w = (map.shadow_from_world() * point.extend(1.0)).w;
                    let noise = map.depth_rounding(*point) * w;
                    assert!(noise <= 16.0 / 16_777_216.0 + 2.0 * of_w, "{light:?}, {warp:?}, {origin:?}: {noise}");
                }
            }
        }
    }
}
