//! Paraboloid maps: the projection against its closed forms, what f32 makes of it, what straight edges make of it, and the
//! fit over views, lights and scenes at random.

mod bias;
mod edges;
mod fits;
mod projection;

use glam::DVec3;
use shadowfit::{
    Focus, Light, Scene, Settings, View,
    omni::{Paraboloid, Paraboloids},
};
use std::f64::consts::{FRAC_PI_2, TAU};
use testkit::arbitrary::Numbers;

fn view() -> View {
    View::perspective((0.5, 2.0, 9.0), (0.0, 0.1, -1.0), DVec3::Y, 1.0, 1.5, 0.1, 100.0).expect("sound")
}

/// A room of 10 by 6 by 20 about the origin.
fn room() -> Scene<'static> {
    Scene::from_box((-5.0, -3.0, -10.0), (5.0, 3.0, 10.0)).expect("sound")
}

fn lamp(position: [f64; 3]) -> Light {
    Light::point(position, 0.1, f64::INFINITY).expect("sound")
}

/// Both maps of a lamp in the middle of the room.
fn both(settings: &Settings) -> [Paraboloid; 2] {
    match Focus::new(&view(), &lamp([0.0, 0.5, 1.0]), &room()).paraboloids(settings) {
        Paraboloids::Two(maps) => maps,
        other => panic!("the lamp is among what is visible: {other:?}"),
    }
}

/// Any direction, many of them near the rim, the axis, or straight behind.
fn direction_about(numbers: &mut Numbers) -> DVec3 {
    let (kind, sign) = (numbers.part(), if numbers.part() < 0.5 { -1.0 } else { 1.0 });
    let tiny = 10_f64.powf(-14.0 * numbers.part());
    let angle = match kind {
        _ if kind < 0.5 => (1.0 - 2.0 * numbers.part()).acos(),
        _ if kind < 0.7 => FRAC_PI_2 + sign * tiny,
        _ if kind < 0.85 => tiny,
        _ => std::f64::consts::PI - tiny,
    };
    let around = TAU * numbers.part();
    DVec3::new(angle.sin() * around.cos(), angle.sin() * around.sin(), angle.cos()).normalize()
}

/// The same in the frame of a map.
fn from_light(map: &Paraboloid, local: DVec3) -> DVec3 {
    let place = |u, v| (map.unproject(DVec3::new(u, v, 1.0)) - map.position()).normalize();
    // (1, 0) and (0, 1) are on the rim, along the axes of the frame.
    place(1.0, 0.0) * local.x + place(0.0, 1.0) * local.y + map.axis() * local.z
}
