//! What planning costs: lights against objects.
//!
//! `cargo bench --bench plan`

use criterion::{BatchSize, BenchmarkId, Criterion, criterion_group, criterion_main};
use glam::{DVec3, Vec3};
use rand::rngs::StdRng;
use rand::{RngExt as _, SeedableRng as _};
use shadowfit::glam;
use shadowfit::{
    Aabb, InputError, Light, Settings, View,
    mesh::Solidity,
    plan::{Budget, Object, Objects, Surface, plan},
};
use std::hint::black_box;

/// A town of a square kilometre.
const HALF: f32 = 500.0;

fn objects(count: usize) -> Vec<Object> {
    let rng = &mut StdRng::seed_from_u64(1);
    let ground = Aabb::new(Vec3::new(-HALF, -1.0, -HALF), Vec3::new(HALF, 0.0, HALF));
    let mut objects = vec![Object::new(ground)];
    objects.extend((1..count).map(|_| {
        let size = Vec3::new(rng.random_range(1.0..12.0), rng.random_range(1.0..20.0), rng.random_range(1.0..12.0));
        let min = Vec3::new(rng.random_range(-HALF..HALF), 0.0, rng.random_range(-HALF..HALF));
        let surface =
            if rng.random_bool(0.7) { Surface::Mesh(Solidity::Watertight) } else { Surface::Mesh(Solidity::Open) };
        Object { surface, triangles: 300, ..Object::new(Aabb::new(min, min + size)) }
    }));
    objects
}

/// A sun, and lamps that reach as far as lamps do.
fn lights(count: usize) -> Result<Vec<Light>, InputError> {
    let rng = &mut StdRng::seed_from_u64(2);
    let mut lights = vec![Light::directional((0.3, 1.0, 0.4))?];
    for _ in 1..count {
        let half = f64::from(HALF);
        let position =
            DVec3::new(rng.random_range(-half..half), rng.random_range(2.0..8.0), rng.random_range(-half..half));
        lights.push(Light::point(position, 0.05, rng.random_range(10.0..25.0))?);
    }
    Ok(lights)
}

fn all(criterion: &mut Criterion) {
    let result = plans(criterion);
    if let Err(error) = result {
        panic!("a case of the benchmark is no valid input: {error}");
    }
}

fn plans(criterion: &mut Criterion) -> Result<(), InputError> {
    let view = View::perspective((0.0, 30.0, 0.0), (0.3, -0.1, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.1, 1000.0)?;
    let budget = Budget::new(Settings::new(1024, 1080)?);
    let mut group = criterion.benchmark_group("plan");
    for (light_count, object_count) in [(1, 10_000), (10, 10_000), (100, 10_000), (1000, 10_000), (1000, 1000)] {
        let (objects, lights) = (Objects::new(&objects(object_count))?, lights(light_count)?);
        let id = BenchmarkId::new(format!("{light_count} lights"), format!("{object_count} objects"));
        group.bench_function(id, |bencher| {
            bencher.iter(|| plan(black_box(&view), &lights, &objects, &budget));
        });
    }
    let boxes = objects(10_000);
    group.bench_function("sort 10000 objects", |bencher| {
        bencher.iter_batched(|| &boxes, |boxes| Objects::new(black_box(boxes)), BatchSize::SmallInput);
    });
    group.finish();
    Ok(())
}

criterion_group!(benches, all);
criterion_main!(benches);
