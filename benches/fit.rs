//! Time: `cargo bench --bench fit`. Read ratios within one run, not times across runs: machines are noisy. How cost grows with
//! lights, casters, planes and cascades, the report measures (`cargo run --release -p report`).

// Cases may be laid out with whatever sines the platform has, and the macros' items have no documentation.
#![allow(clippy::disallowed_methods, missing_docs)]

mod cases;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use shadowfit::glam::{DMat4, DVec3, Mat4, Vec3};
use shadowfit::{
    Aabb, Effort, Focus, FocusForm, InputError, Light, Outcome, Scene, Settings, Warp, fit, warp::classify,
};
use std::hint::black_box;

/// Each step on its own, and the whole fit.
fn steps(criterion: &mut Criterion) -> Result<(), InputError> {
    let (view, scene) = (cases::view()?, cases::scene()?);
    for (name, light) in cases::lights()? {
        let mut group = criterion.benchmark_group(name);
        let focus = || Focus::new(black_box(&view), black_box(&light), &scene);
        group.bench_function("class", |b| b.iter(|| classify(black_box(&view), black_box(&light))));
        group.bench_function("R", |b| b.iter(|| focus().receiver_volume()));
        group.bench_function("H as the paper has it", |b| b.iter(|| focus().caster_volume(FocusForm::ViewHull)));
        group.bench_function("H tight", |b| b.iter(|| focus().caster_volume(FocusForm::ReceiverHull)));
        for (map, settings) in cases::settings() {
            group.bench_function(format!("fit, {map}"), |b| {
                b.iter(|| fit(black_box(&view), black_box(&light), &scene, &settings));
            });
        }
        let whole = focus();
        let best = Settings::default().with_warp(Warp::Best(Effort::Good));
        if let Outcome::Map(before) = whole.fit(&best) {
            group.bench_function("fit, best, from the frame before", |b| {
                b.iter(|| focus().fit_warm(black_box(&before), &best));
            });
        }
        if let Outcome::Map(map) = whole.fit(&best) {
            group.bench_function("report", |b| b.iter(|| map.report(black_box(&whole))));
            group.bench_function("worst and mean aliasing", |b| b.iter(|| map.aliasing_over(black_box(&whole))));
        }
        group.bench_function("limit", |b| b.iter(|| whole.aliasing_lower_bound(black_box(&best))));
        group.finish();
    }
    if let Some(corners) = view.corners() {
        criterion.bench_function("directional/fit, naive", |b| {
            b.iter(|| naive_fit(black_box(&corners), black_box(DVec3::new(0.3, 1.0, 0.4).normalize())));
        });
    }
    Ok(())
}

/// Casters against H, and H from lists of casters and receivers.
fn culling(criterion: &mut Criterion) -> Result<(), InputError> {
    let (view, scene) = (cases::view()?, cases::scene()?);
    let sun = Light::directional((0.3, 1.0, 0.4))?;
    let body = Focus::new(&view, &sun, &scene).caster_volume(FocusForm::ReceiverHull);
    let (culler, boxes) = (body.culler(), boxes(10_000));
    let uniform = Settings::default().with_warp(Warp::Uniform);
    let mut meets = vec![false; boxes.len()];
    let mut group = criterion.benchmark_group("10,000 boxes");
    group.throughput(Throughput::Bytes(size_of_val(boxes.as_slice()) as u64));
    group.bench_function("in bulk", |b| b.iter(|| culler.boxes(black_box(&boxes), &mut meets)));
    group.bench_function("one by one", |b| {
        b.iter(|| boxes.iter().filter(|one| body.intersects_aabb(one.min, one.max)).count());
    });
    group.bench_function("copied, for comparison", |b| b.iter(|| black_box(&boxes).to_vec()));
    group.bench_function("as casters and receivers of a fit", |b| {
        b.iter(|| Scene::new(&boxes, &boxes).map(|scene| fit(&view, &sun, &scene, &uniform)));
    });
    group.finish();
    Ok(())
}

/// Objects scattered over the town.
fn boxes(count: usize) -> Vec<Aabb> {
    (0..count)
        .map(|index| {
            // Multiples of two irrational numbers fill a square evenly.
            let at = |step: f64| 400.0 * (index as f64 * step).fract() - 200.0;
            let min = Vec3::new(at(0.754_877_666) as f32, 0.0, at(0.569_840_29) as f32);
            Aabb::new(min, min + Vec3::new(2.0, 3.0, 2.0))
        })
        .collect()
}

/// What most engines do for a directional light: the light-space box around the corners of the view's frustum.
///
/// It holds no caster before the near plane and knows nothing of the scene.
fn naive_fit(corners: &[DVec3; 8], direction_to_light: DVec3) -> Mat4 {
    let (right, up) = direction_to_light.any_orthonormal_pair();
    let light_from_world = DMat4::from_cols(
        DVec3::new(right.x, up.x, -direction_to_light.x).extend(0.0),
        DVec3::new(right.y, up.y, -direction_to_light.y).extend(0.0),
        DVec3::new(right.z, up.z, -direction_to_light.z).extend(0.0),
        DVec3::ZERO.extend(1.0),
    );
    let (mut min, mut max) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for &corner in corners {
        let seen = light_from_world.transform_point3(corner);
        (min, max) = (min.min(seen), max.max(seen));
    }
    let size = max - min;
    let centre = 0.5 * (min + max);
    let scale = DVec3::new(2.0 / size.x, 2.0 / size.y, 1.0 / size.z);
    let offset = DVec3::new(-centre.x, -centre.y, -min.z) * scale;
    (DMat4::from_translation(offset) * DMat4::from_scale(scale) * light_from_world).as_mat4()
}

fn all(criterion: &mut Criterion) {
    let results = [steps(criterion), culling(criterion)];
    if let Some(error) = results.into_iter().find_map(Result::err) {
        panic!("a case of the benchmark is no valid input: {error}");
    }
}

criterion_group!(benches, all);
criterion_main!(benches);
