//! Raw bits in every public constructor: a typed error or a value that fits without a NaN.
//!
//! `cargo +nightly fuzz run constructors`

#![no_main]

use arbitrary::Arbitrary;
use libfuzzer_sys::fuzz_target;
use shadowfit::glam::{DMat4, DVec3};
use shadowfit::{ClipSpace, Focus, InputError, Light, Outcome, Scene, Settings, View};

#[derive(Arbitrary, Debug)]
struct Input {
    view: ViewInput,
    light: LightInput,
    min: [f64; 3],
    max: [f64; 3],
}

#[derive(Arbitrary, Debug)]
enum ViewInput {
    Perspective {
        eye: [f64; 3],
        forward: [f64; 3],
        up: [f64; 3],
        fov_y: f64,
        aspect: f64,
        near: f64,
        far: f64,
    },
    Orthographic {
        eye: [f64; 3],
        forward: [f64; 3],
        up: [f64; 3],
        half_height: f64,
        aspect: f64,
        near: f64,
        far: f64,
    },
    Matrices {
        eye_from_world: [f64; 16],
        clip_from_eye: [f64; 16],
        reversed: bool,
    },
}

#[derive(Arbitrary, Debug)]
enum LightInput {
    Directional { direction_to_light: [f64; 3] },
    Point { position: [f64; 3], near: f64, range: f64 },
    Spot { position: [f64; 3], axis: [f64; 3], half_angle: f64, near: f64, range: f64 },
    Hemisphere { position: [f64; 3], axis: [f64; 3], near: f64, range: f64 },
}

impl ViewInput {
    fn view(&self) -> Result<View, InputError> {
        match *self {
            Self::Perspective { eye, forward, up, fov_y, aspect, near, far } => {
                View::perspective(eye, forward, up, fov_y, aspect, near, far)
            }
            Self::Orthographic { eye, forward, up, half_height, aspect, near, far } => {
                View::orthographic(eye, forward, up, half_height, aspect, near, far)
            }
            Self::Matrices { eye_from_world, clip_from_eye, reversed } => {
                let clip = if reversed { ClipSpace::WGPU.reversed() } else { ClipSpace::WGPU };
                let [eye, lens] = [eye_from_world, clip_from_eye].map(|matrix| DMat4::from_cols_array(&matrix));
                View::from_matrices(eye, lens, clip)
            }
        }
    }
}

impl LightInput {
    fn light(&self) -> Result<Light, InputError> {
        match *self {
            Self::Directional { direction_to_light } => Light::directional(direction_to_light),
            Self::Point { position, near, range } => Light::point(position, near, range),
            Self::Spot { position, axis, half_angle, near, range } => {
                Light::spot(position, axis, half_angle, near, range)
            }
            Self::Hemisphere { position, axis, near, range } => Light::hemisphere(position, axis, near, range),
        }
    }
}

fuzz_target!(|input: Input| {
    let scene = Scene::from_box(DVec3::from(input.min), DVec3::from(input.max));
    if let (Ok(view), Ok(light), Ok(scene)) = (input.view.view(), input.light.light(), scene) {
        let focus = Focus::new(&view, &light, &scene);
        if let Outcome::Map(map) = focus.fit(&Settings::default()) {
            assert!(map.shadow_from_world().is_finite());
            assert!(map.matrix().is_finite());
        }
    }
});
