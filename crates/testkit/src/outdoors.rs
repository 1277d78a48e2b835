//! Somebody standing in a town and looking around, and its lights: what warps are for.

use rand::RngExt;
use rand::rngs::StdRng;
use shadowfit::glam::DVec3;
use shadowfit::input::DAabb;
use shadowfit::seen::SeenPoint;
use shadowfit::{Light, Scene, View};
use std::f64::consts::TAU;

/// The least and the largest coordinates of a town of 400 m.
pub const TOWN: ([f64; 3], [f64; 3]) = ([-200.0, 0.0, -200.0], [200.0, 15.0, 200.0]);

/// The town, seen as a box.
pub fn town() -> Scene<'static> {
    Scene::from_box(TOWN.0, TOWN.1).expect("a legal box")
}

/// A view of somebody who looks around, from no higher than a second floor.
pub fn view(random: &mut StdRng) -> View {
    let (yaw, pitch) = (random.random_range(0.0..TAU), random.random_range(-0.6..0.1_f64));
    let forward = DVec3::new(yaw.cos() * pitch.cos(), pitch.sin(), yaw.sin() * pitch.cos());
    let mut number = |low: f64, high: f64| random.random_range(low..high);
    let eye = DVec3::new(number(-50.0, 50.0), number(1.0, 10.0), number(-50.0, 50.0));
    let (near, far) = (10.0_f64.powf(number(-1.0, 0.3)), 10.0_f64.powf(number(2.0, 3.0)));
    View::perspective(eye, forward, DVec3::Y, 1.0, 1.6, near, far).expect("a legal view")
}

/// A direction between 6° and 86° above the horizon.
fn upwards(random: &mut StdRng) -> DVec3 {
    let (azimuth, height) = (random.random_range(0.0..TAU), random.random_range(0.1..1.5_f64));
    DVec3::new(azimuth.cos() * height.cos(), height.sin(), azimuth.sin() * height.cos())
}

/// The kinds of lights.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Sun,
    Lamp,
    Spot,
}

impl Kind {
    pub const ALL: [Self; 3] = [Self::Sun, Self::Lamp, Self::Spot];

    /// What it is called.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Sun => "sun",
            Self::Lamp => "lamp",
            Self::Spot => "spot",
        }
    }

    /// A light of this kind, a lamp or a spot 10 m to 300 m away from somewhere in the middle of the town.
    pub fn light(self, random: &mut StdRng) -> Light {
        let towards = upwards(random);
        let mut number = |low: f64, high: f64| random.random_range(low..high);
        let light = if self == Self::Sun {
            Light::directional(towards)
        } else {
            let [beside, target] = [(); 2].map(|()| DVec3::new(number(-50.0, 50.0), 0.0, number(-50.0, 50.0)));
            let position = towards * 10.0_f64.powf(number(1.0, 2.5)) + beside;
            match self {
                Self::Spot => Light::spot(position, target - position, number(0.2, 1.2), 0.1, 1000.0),
                _ => Light::point(position, 0.1, 1000.0),
            }
        };
        light.expect("a legal light")
    }
}

/// A ground and buildings on it: what is seen of a town.
pub fn buildings(random: &mut StdRng) -> Vec<DAabb> {
    let mut boxes = vec![DAabb { min: DVec3::new(-200.0, -1.0, -200.0), max: DVec3::new(200.0, 0.0, 200.0) }];
    for _ in 0..200 {
        let mut number = |low: f64, high: f64| random.random_range(low..high);
        let (x, z) = (number(-195.0, 195.0), number(-195.0, 195.0));
        let half = DVec3::new(number(1.0, 5.0), number(1.0, 15.0), number(1.0, 5.0));
        let min = DVec3::new(x, 0.0, z) - half * DVec3::new(1.0, 0.0, 1.0);
        boxes.push(DAabb { min, max: min + half * DVec3::new(2.0, 1.0, 2.0) });
    }
    boxes
}

/// The points where so many lines of sight across and down meet boxes, each with the box's normal.
pub fn seen(view: &View, boxes: &[DAabb], [across, down]: [u32; 2]) -> Vec<SeenPoint> {
    let world_from_clip = view.clip_from_world().inverse();
    let place = |i: u32, of: u32| 2.0 * (f64::from(i) + 0.5) / f64::from(of) - 1.0;
    let mut points = Vec::new();
    for (x, y) in (0..down).flat_map(|y| (0..across).map(move |x| (x, y))) {
        let at = |depth: f64| world_from_clip.project_point3(DVec3::new(place(x, across), place(y, down), depth));
        let (from, to) = (at(0.0), at(0.999));
        let step = to - from;
        let hit = boxes.iter().filter_map(|one| entry(one, from, step)).min_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((part, normal)) = hit {
            points.push(SeenPoint { position: from + step * part, normal: Some(normal), pixels: 1.0 });
        }
    }
    points
}

/// Where a line enters a box, as a part of `step`, and the normal there.
fn entry(one: &DAabb, from: DVec3, step: DVec3) -> Option<(f64, DVec3)> {
    let (a, b) = ((one.min - from) / step, (one.max - from) / step);
    let (enter, leave) = (a.min(b), a.max(b));
    let part = enter.max_element();
    if part < 0.0 || part > leave.min_element() {
        return None;
    }
    let axis = DVec3::AXES[enter.max_position()];
    Some((part, axis * -step.dot(axis).signum()))
}
