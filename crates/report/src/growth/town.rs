//! The town that the processor works on: a square kilometre, a view of it, its lamps and its boxes.

use anyhow::Result;
use rand::rngs::StdRng;
use rand::{RngExt as _, SeedableRng as _};
use render_check::maps::Technique;
use shadowfit::glam::{DVec3, Vec3};
use shadowfit::{
    Aabb, InputError, Light, Scene, Settings, View, fit,
    mesh::Solidity,
    plan::{Object, Surface},
};

use testkit::outdoors::Kind;

/// Half of its side, and its height, in metres.
pub(super) const HALF: f32 = 500.0;
pub(super) const HEIGHT: f32 = 30.0;

/// What somebody at a window on the third floor sees of it.
pub(super) fn view() -> Result<View, InputError> {
    View::perspective((0.0, 12.0, 0.0), (0.3, -0.1, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.1, 1000.0)
}

/// Its bounds.
pub(super) fn bounds() -> Result<Scene<'static>, InputError> {
    let half = f64::from(HALF);
    Scene::from_box((-half, 0.0, -half), (half, f64::from(HEIGHT), half))
}

/// A sun over it.
pub(super) fn sun() -> Result<Light, InputError> {
    Light::directional((0.3, 1.0, 0.4))
}

/// How a map is fitted, whatever the crate's defaults are.
pub(super) fn settings(technique: Technique) -> Result<Settings, InputError> {
    Ok(technique.settings(Settings::new(2048, 1080)?))
}

/// Lamps that have a map each, so that every fit is a whole one: those that stand among what is visible or light nothing in
/// view are left out.
pub(super) fn lamps(count: usize) -> Result<Vec<Light>> {
    let (view, bounds, settings) = (view()?, bounds()?, settings(Technique::Uniform)?);
    let random = &mut StdRng::seed_from_u64(1);
    let lamps = std::iter::repeat_with(|| Kind::Lamp.light(random));
    Ok(lamps.filter(|lamp| fit(&view, lamp, &bounds, &settings).map().is_some()).take(count).collect())
}

/// Street lamps all over it, most of them out of view, that reach as far as lamps do.
pub(super) fn street_lamps(count: usize) -> Result<Vec<Light>, InputError> {
    let random = &mut StdRng::seed_from_u64(2);
    let half = f64::from(HALF);
    let mut lamp = || {
        let [x, z] = [(); 2].map(|()| random.random_range(-half..half));
        Light::point(DVec3::new(x, random.random_range(2.0..8.0), z), 0.05, random.random_range(10.0..25.0))
    };
    (0..count).map(|_| lamp()).collect()
}

/// Boxes of houses, trees and cars all over it. The first of many are those of few.
pub(super) fn boxes(count: usize) -> Vec<Aabb> {
    let random = &mut StdRng::seed_from_u64(3);
    let one = |_| {
        let mut number = |low: f32, high: f32| random.random_range(low..high);
        let size = Vec3::new(number(1.0, 12.0), number(1.0, 20.0), number(1.0, 12.0));
        let min = Vec3::new(number(-HALF, HALF - 12.0), 0.0, number(-HALF, HALF - 12.0));
        Aabb::new(min, min + size)
    };
    (0..count).map(one).collect()
}

/// The same as objects on a ground, most of them solid.
pub(super) fn objects(count: usize) -> Vec<Object> {
    let ground = Object::new(Aabb::new(Vec3::new(-HALF, -1.0, -HALF), Vec3::new(HALF, 0.0, HALF)));
    let house = |(index, bounds): (usize, Aabb)| {
        let solidity = if index % 10 < 7 { Solidity::Watertight } else { Solidity::Open };
        Object { surface: Surface::Mesh(solidity), triangles: 300, ..Object::new(bounds) }
    };
    let houses = boxes(count.saturating_sub(1)).into_iter().enumerate().map(house);
    std::iter::once(ground).chain(houses).collect()
}
