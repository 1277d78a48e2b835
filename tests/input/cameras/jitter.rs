//! Stable maps under a projection that moves by parts of a pixel from frame to frame, as temporal anti-aliasing has it.

use glam::{DMat4, DQuat, DVec2, DVec3, DVec4, Mat4, Quat, Vec3};
use proptest::prelude::*;
use shadowfit::{ClipSpace, Light, Scene, Settings, ShadowMap, View, Warp, fit};
use testkit::arbitrary::{rotation, run};

const HEIGHT: u32 = 1080;
const ASPECT: f64 = 16.0 / 9.0;

/// A projection in f32, moved by so much of a pixel.
fn projection(fov_y: f64, near: f64, far: f64, middle: [f64; 2], offset: [f64; 2]) -> Mat4 {
    let scale = 1.0 / (0.5 * fov_y).tan();
    let pixel = 2.0 / f64::from(HEIGHT);
    let place = [middle[0] + offset[0] * pixel / ASPECT, middle[1] + offset[1] * pixel];
    let depth = far / (near - far);
    DMat4::from_cols(
        DVec4::X * (scale / ASPECT),
        DVec4::Y * scale,
        DVec4::new(place[0], place[1], depth, -1.0),
        DVec4::Z * (near * depth),
    )
    .as_mat4()
}

fn stable(eye_from_world: Mat4, projection: Mat4, sun: DVec3) -> ShadowMap {
    let view = View::from_matrices(eye_from_world.as_dmat4(), projection.as_dmat4(), ClipSpace::WGPU);
    let settings = Settings::new(2048, HEIGHT).expect("legal sizes").with_warp(Warp::Stable);
    let scene = Scene::from_box((-400.0, 0.0, -400.0), (400.0, 60.0, 400.0)).expect("sound");
    let light = Light::directional(sun).expect("sound");
    fit(&view.expect("a camera"), &light, &scene, &settings).into_map().expect("one map does")
}

/// The rows of x and y of the matrix, to the bit: extent, grid and place.
fn rows(map: &ShadowMap) -> [[u64; 4]; 2] {
    let rows = map.clip_from_world_in(ClipSpace::WGPU).transpose();
    [rows.x_axis, rows.y_axis].map(|row| row.to_array().map(f64::to_bits))
}

/// At two offsets the radius was on two sides of a step of its rounding, and the grid moved by half a texel. At 900 far
/// distances nothing moves.
#[test]
fn offsets_below_a_pixel_move_nothing() {
    let pose = Mat4::from_rotation_translation(Quat::from_rotation_y(0.4), Vec3::new(3.0, 1.7, 9.0));
    let offsets = [[0.0, 0.0], [0.125, -0.25], [-0.375, 0.4], [0.5, 0.5], [-0.99, 0.99]];
    for far in (0..900).map(|step| 50.0 + 0.25 * f64::from(step)).chain([104.0]) {
        let maps = offsets.map(|offset| {
            let projection = projection(45_f64.to_radians(), 0.1, far, [0.0; 2], offset);
            rows(&stable(pose.inverse(), projection, DVec3::new(0.4, 1.0, 0.2)))
        });
        assert!(maps.iter().all(|map| *map == maps[0]), "far {far}");
    }
}

/// Neither do they whatever the camera and the sun are, by matrices whose last rows are a rounding off too.
#[test]
fn offsets_below_a_pixel_move_nothing_of_any_camera() {
    let offset = || prop::array::uniform2(-1.0..1.0);
    let lens = (0.05..2.2, 0.05..1.0, 5.0..300.0);
    let pose = (prop::array::uniform3(-100.0..100.0), rotation());
    run(
        1000,
        &(lens, pose, rotation(), offset(), offset()),
        |((fov_y, near, far), (eye, turn), sun, one, other)| {
            let (eye, turn): (DVec3, DQuat) = (DVec3::from(eye).with_y(20.0), turn);
            let eye_from_world = Mat4::from_rotation_translation(turn.as_quat(), eye.as_vec3()).inverse();
            let view = |offset| {
                let projection = projection(fov_y, near, far, [0.0; 2], offset);
                View::from_matrices(eye_from_world.as_dmat4(), projection.as_dmat4(), ClipSpace::WGPU)
            };
            let settings = Settings::new(1024, HEIGHT).expect("legal sizes").with_warp(Warp::Stable);
            let scene = Scene::from_box((-400.0, 0.0, -400.0), (400.0, 60.0, 400.0)).expect("sound");
            let light = Light::directional(sun * DVec3::Y).expect("sound");
            let maps = [one, other].map(|offset| {
                let view = view(offset).expect("a camera");
                fit(&view, &light, &scene, &settings).map().map(rows)
            });
            assert_eq!(maps[0], maps[1]);
        },
    );
}

/// A frame off its axis, as an eye of a headset has it, keeps its grid too, unless its middle is within a pixel of an odd
/// number of thirty-seconds of its half size.
#[test]
fn offsets_of_frames_off_axis_move_nothing() {
    let pose = Mat4::from_rotation_translation(Quat::from_rotation_y(-1.1), Vec3::new(-3.0, 1.7, 2.0)).inverse();
    for middle in [[0.1, -0.05], [-0.22, 0.015_625], [0.5, 0.5]] {
        let maps = [[0.0, 0.0], [0.4, -0.3], [-0.5, 0.5]].map(|offset| {
            let projection = projection(1.2, 0.1, 120.0, middle, offset);
            rows(&stable(pose, projection, DVec3::new(-0.3, 1.0, 0.5)))
        });
        assert!(maps.iter().all(|map| *map == maps[0]), "{middle:?}");
    }
}

/// What the room for a pixel and for a sixteenth costs: next to nothing on the axis, 3 % of a texel's side off it.
#[test]
fn room_for_jitter_costs_little() {
    let sides = |middle: [f64; 2]| {
        let map = stable(Mat4::IDENTITY, projection(1.0, 0.1, 100.0, middle, [0.0; 2]), DVec3::Y);
        DVec2::new(map.window().width, map.window().height)
    };
    // The farthest corner is what a symmetric view's ball is made for: d² = h² far² + (far − z)².
    let view = View::perspective(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 1.0, ASPECT, 0.1, 100.0).expect("sound");
    let corners = view.corners().expect("a finite far plane");
    let farthest =
        |depth: f64| corners.map(|corner| corner.distance(DVec3::NEG_Z * depth)).into_iter().fold(0.0, f64::max);
    let least = (0..=100_000).map(|step| farthest(f64::from(step) / 1000.0)).fold(f64::INFINITY, f64::min);
    // 1/128 of room, 2047 of 2048 texels, 13 bits of a texel's side, and a pixel.
    let ratio = sides([0.0; 2]).max_element() / (2.0 * least);
    assert!(
        ratio > 1.0 && ratio < (1.0 + 1.0 / 128.0) * (2048.0 / 2047.0) * (1.0 + 1.0 / 4096.0) * 1.003,
        "{ratio}"
    );
}
