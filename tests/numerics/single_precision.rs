//! What f32 makes of a map, over views, lights and scenes at random: all that must be in it is, and its depths are as
//! quiet as it says.
//!
//! Each property runs some thousands of cases from a fixed seed; `SHADOWFIT_CASES=100000` in the environment runs that many
//! of each instead.

use glam::DVec3;
use proptest::prelude::*;
use shadowfit::{ClipSpace, Focus, Light, Origin, Scene, Settings, View, warp::Shift};
use testkit::arbitrary::{Case, Frame, LightParams, Pose, SceneParams, ViewParams, WARPS, case, run, settings};
use testkit::claims::single_precision::{holds_what_it_must, is_as_quiet_as_it_says, rounding};

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
        for warp in WARPS {
            for origin in [Origin::World, Origin::Eye, Origin::Light] {
                let settings = Settings::default().with_warp(warp).with_origin(origin);
                let focus = Focus::new(&view, &light, &scene);
                let map = focus.fit(&settings).into_map().expect("one map does");
                let of_w = |point: &DVec3| rounding(&map, *point).1;
                let of_w = focus.receiver_volume().vertices().iter().map(of_w).fold(0.0, f64::max);
                for point in focus.receiver_volume().vertices() {
                    let w = (map.clip_from_world() * point.extend(1.0)).w;
                    let noise = map.depth_rounding(*point) * w;
                    assert!(noise <= 16.0 / 16_777_216.0 + 2.0 * of_w, "{light:?}, {warp:?}, {origin:?}: {noise}");
                }
            }
        }
    }
}

/// Found by fuzzing: on a ground that a lamp in it grazes, casters by the lamp are as deep as what is visible, and far from the
/// eye, which positions are relative to. The far end of the depth range knew only of the roundings of what is visible.
#[test]
fn casters_that_are_as_deep_as_what_is_visible_and_far_from_the_origin() {
    let pose = Pose {
        eye: [0.0; 3],
        forward: [0.457_736_077_945_763_76, 0.659_137_581_307_904_5, 0.031_233_688_858_003_927],
        up: [0.018_466_759_188_486_274, 0.0, -0.012_019_822_723_789_516],
    };
    let frame = Frame {
        slopes: [
            -0.216_364_330_899_594_67,
            0.416_034_068_743_890_9,
            0.081_285_232_953_539_79,
            1.761_387_157_009_383,
        ],
        near: 0.010_820_981_874_558_891,
        far: Some(190.358_471_987_866_4),
    };
    let clip = ClipSpace::WGPU.reversed();
    let side = 1_671.242_475_484_479_2;
    let case = Case {
        view: ViewParams::Matrices { pose, mirrored: false, scale: 100.0, frame, clip },
        light: LightParams::Hemisphere {
            position: [-side, 0.0, side],
            axis: [side, 0.103_132_681_771_291_23, -side],
            near: 2.954_281_989_746_755,
            range: Some(2_600.378_185_430_656_7),
        },
        scene: SceneParams::Bounds { min: [-side, 0.0, -side], max: [side, 0.206_265_363_542_582_46, side] },
    };
    let settings = Settings::new(512, 1080).and_then(|settings| settings.with_border(0)).expect("sound");
    let settings = settings.with_shift(Shift::None).with_origin(Origin::Eye);
    for seed in 0..1000 {
        holds_what_it_must(&case, &settings, seed);
    }
}
