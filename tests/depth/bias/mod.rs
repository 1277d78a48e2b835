//! The bias that a map asks for, on planes drawn as a rasteriser draws them, and offsets in the receiver's matrix.
//!
//! Each property runs some thousands of cases from a fixed seed; `SHADOWFIT_CASES=100000` in the environment runs that many
//! of each instead.
//!
//! - `simulate`: a card in software, which draws a plane into a map and compares a receiver on it.
//! - `planes`: with the bias no plane shadows itself there, and with less some do.
//! - `offsets`: what each kind of offset moves receivers by.
//! - `normals`: receivers moved along their normals, and the sign of a bias.
//! - `figures`: units, steps and costs in one scene.

mod figures;
mod normals;
mod offsets;
mod planes;
mod simulate;

use glam::DVec3;
use shadowfit::{DepthFormat, Light, Scene, Settings, ShadowMap, View, fit};

const FORMATS: [DepthFormat; 4] =
    [DepthFormat::Unorm8, DepthFormat::Unorm16, DepthFormat::Unorm24, DepthFormat::Float32];

/// A plane under a lamp and the sun, seen from a person's height, and bodies above it.
fn outdoors(light: &Light, settings: &Settings) -> ShadowMap {
    fit(&view(), light, &scene(), settings).into_map().expect("a map")
}

fn view() -> View {
    View::perspective((0.0, 1.75, 8.0), (0.0, -0.125, -1.0), DVec3::Y, 1.0, 1.5, 0.5, 100.0).expect("sound")
}

fn scene() -> Scene<'static> {
    Scene::from_box((-16.0, 0.0, -32.0), (16.0, 4.0, 16.0)).expect("sound")
}

fn sun() -> Light {
    Light::directional((0.25, 1.0, 0.5)).expect("sound")
}

fn lamp() -> Light {
    Light::point((4.0, 12.0, -16.0), 0.25, f64::INFINITY).expect("sound")
}
