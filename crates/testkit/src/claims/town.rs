//! Towns, views and lights at random, for the planner.

use std::convert::Infallible;

use rand::rngs::StdRng;
use rand::{Rng, RngExt as _, SeedableRng as _, TryRng};
use shadowfit::glam::{DVec3, Vec3};
use shadowfit::{
    Aabb, Effort, Filter, Light, Settings, View, Warp,
    mesh::Solidity,
    plan::{Budget, Object, Surface},
};

/// All that a plan is made from.
#[derive(Debug)]
pub struct LitTown {
    pub objects: Vec<Object>,
    pub view: View,
    pub budget: Budget,
    pub lights: Vec<Light>,
}

impl LitTown {
    pub fn at_random(rng: &mut impl Rng, lights: usize) -> Self {
        let objects = town(rng, 200);
        let (view, budget) = (view(rng), budget(rng));
        Self { objects, view, budget, lights: (0..lights).map(|_| light(rng)).collect() }
    }

    /// The same from a fuzzer's bytes, of which the view and the lights come first, and of fewer objects: the sooner it is done.
    pub fn from_bytes(bytes: &mut Bytes<'_>) -> Self {
        let (view, budget) = (view(bytes), budget(bytes));
        let lights = (0..2).map(|_| light(bytes)).collect();
        Self { objects: town(bytes, 20), view, budget, lights }
    }
}

/// Random numbers that are a fuzzer's bytes as long as there are any; the first is a seed for what comes after the last.
pub struct Bytes<'a> {
    left: &'a [u8],
    then: StdRng,
}

impl<'a> Bytes<'a> {
    pub fn new(bytes: &'a [u8]) -> Self {
        let (first, left) = bytes.split_at(bytes.len().min(1));
        Self { left, then: StdRng::seed_from_u64(first.first().copied().unwrap_or(0).into()) }
    }
}

impl TryRng for Bytes<'_> {
    type Error = Infallible;

    fn try_next_u32(&mut self) -> Result<u32, Infallible> {
        let mut bytes = [0; 4];
        self.try_fill_bytes(&mut bytes)?;
        Ok(u32::from_le_bytes(bytes))
    }

    fn try_next_u64(&mut self) -> Result<u64, Infallible> {
        let mut bytes = [0; 8];
        self.try_fill_bytes(&mut bytes)?;
        Ok(u64::from_le_bytes(bytes))
    }

    fn try_fill_bytes(&mut self, bytes: &mut [u8]) -> Result<(), Infallible> {
        match self.left.split_at_checked(bytes.len()) {
            Some((first, left)) => {
                bytes.copy_from_slice(first);
                self.left = left;
            }
            None => {
                self.left = &[];
                self.then.fill_bytes(bytes);
            }
        }
        Ok(())
    }
}

/// A ground and fewer than so many boxes on it and above it, of every surface.
pub fn town(rng: &mut impl Rng, most: i32) -> Vec<Object> {
    let half = rng.random_range(5.0..80.0_f32);
    let ground = Aabb::new(Vec3::new(-half, -0.1, -half), Vec3::new(half, 0.0, half));
    let mut objects = vec![Object { casts: rng.random_bool(0.5), ..Object::new(ground) }];
    for _ in 0..rng.random_range(3..most) {
        let size = Vec3::new(rng.random_range(0.1..6.0), rng.random_range(0.1..12.0), rng.random_range(0.1..6.0));
        let min = Vec3::new(
            rng.random_range(-half..half),
            if rng.random_bool(0.7) { 0.0 } else { rng.random_range(0.0..20.0) },
            rng.random_range(-half..half),
        );
        let surface = match rng.random_range(0..10) {
            0 => Surface::Points,
            1..3 => Surface::FlatSheets,
            3..5 => Surface::Mesh(Solidity::Open),
            _ => Surface::Mesh(Solidity::Watertight),
        };
        objects.push(Object {
            casts: rng.random_bool(0.9),
            receives: rng.random_bool(0.9),
            surface,
            triangles: rng.random_range(1..1000),
            longest_edge: rng.random_range(0.01..1.0),
            ..Object::new(Aabb::new(min, min + size))
        });
    }
    objects
}

pub fn direction(rng: &mut impl Rng) -> DVec3 {
    loop {
        let one = DVec3::from_array([(); 3].map(|()| rng.random_range(-1.0..1.0)));
        if (0.1..1.0).contains(&one.length()) {
            return one;
        }
    }
}

pub fn view(rng: &mut impl Rng) -> View {
    let eye = DVec3::new(rng.random_range(-20.0..20.0), rng.random_range(0.3..15.0), rng.random_range(-20.0..20.0));
    let far = if rng.random_bool(0.2) { f64::INFINITY } else { rng.random_range(5.0..200.0) };
    let fov = rng.random_range(0.2..2.0);
    let near = rng.random_range(0.01..1.0);
    View::perspective(eye, direction(rng) * DVec3::new(1.0, 0.3, 1.0), DVec3::Y, fov, 1.6, near, far)
        .expect("a sound view")
}

pub fn light(rng: &mut impl Rng) -> Light {
    let position =
        DVec3::new(rng.random_range(-30.0..30.0), rng.random_range(0.2..15.0), rng.random_range(-30.0..30.0));
    let (near, range) = (rng.random_range(0.001..0.1), rng.random_range(1.0..60.0));
    let range = if rng.random_bool(0.1) { f64::INFINITY } else { range };
    match rng.random_range(0..5) {
        0 => Light::directional(direction(rng) + DVec3::Y),
        1 => Light::spot(position, direction(rng) - DVec3::Y, rng.random_range(0.1..1.5), near, range),
        2 => Light::hemisphere(position, direction(rng) - DVec3::Y, near, range),
        _ => Light::point(position, near, range),
    }
    .expect("a sound light")
}

pub fn budget(rng: &mut impl Rng) -> Budget {
    let size = 1 << rng.random_range(6..12);
    let warp = match rng.random_range(0..10) {
        0 => Warp::Uniform,
        1 => Warp::Stable,
        2 => Warp::LightSpace,
        3 | 4 => Warp::Best(Effort::Rough),
        _ => Warp::Perspective,
    };
    let filter = match rng.random_range(0..3) {
        0 => Filter::Nearest,
        1 => Filter::Hardware2x2,
        _ => Filter::Pcf(rng.random_range(2..6)),
    };
    Budget::new(Settings::new(size, 720).expect("sound sizes").with_warp(warp)).with_filter(filter)
}

pub fn in_box(rng: &mut impl Rng, one: &Aabb) -> DVec3 {
    let part = DVec3::from_array([(); 3].map(|()| rng.random_range(0.0..1.0)));
    one.min.as_dvec3() + part * (one.max - one.min).as_dvec3()
}
