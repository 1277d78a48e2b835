//! Ways of fitting maps to a town, from what engines do to maps chosen by what is seen: how large texels are in pixels at the
//! surfaces in view.
//!
//! ```text
//! cargo run --release -p testkit --bin ladder -- [SEED] [VIEWS]
//! ```

#![allow(clippy::disallowed_methods, reason = "angles and powers spread the cases, they are no part of a fit")]

use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use shadowfit::cascades::{CascadeChoice, CascadeSplits, Cascades, SplitScheme};
use shadowfit::glam::DVec3;
use shadowfit::input::DAabb;
use shadowfit::seen::{Seen, SeenPoint};
use shadowfit::warp::Objective;
use shadowfit::{Focus, Light, Scene, Settings, ShadowMap, View, Warp};
use std::f64::consts::TAU;
use testkit::outdoors::seen;

/// Blocks of the town, across and along.
const BLOCKS: i32 = 40;

/// The distance between their middles, in metres.
const BLOCK: f64 = 20.0;

/// A view with a sun, and what is seen.
struct Case {
    view: View,
    sun: Light,
    /// For fits.
    samples: Vec<SeenPoint>,
    /// For the comparison.
    surfaces: Vec<SeenPoint>,
    boxes: Vec<DAabb>,
}

impl Case {
    fn drawn(random: &mut StdRng, boxes: &[DAabb]) -> Self {
        let mut number = |low: f64, high: f64| random.random_range(low..high);
        loop {
            let (yaw, pitch) = (number(0.0, TAU), number(-0.35, 0.05));
            let forward = DVec3::new(yaw.cos() * pitch.cos(), pitch.sin(), yaw.sin() * pitch.cos());
            // In the streets, which run between the blocks.
            let street = |at: f64| ((at / BLOCK).floor() + 0.5) * BLOCK;
            let eye = DVec3::new(street(number(-200.0, 200.0)), number(1.6, 12.0), number(-200.0, 200.0));
            let view = View::perspective(eye, forward, DVec3::Y, 1.0, 1.6, 0.1, 565.0).expect("a legal view");
            let (azimuth, height) = (number(0.0, TAU), number(0.2, 1.2));
            let to_sun = DVec3::new(azimuth.cos() * height.cos(), height.sin(), azimuth.sin() * height.cos());
            let sun = Light::directional(to_sun).expect("a direction");
            let lit = |points: Vec<SeenPoint>| -> Vec<SeenPoint> {
                points.into_iter().filter(|point| point.position.is_finite()).collect()
            };
            let (samples, surfaces) = (lit(seen(&view, boxes, [16, 9])), lit(seen(&view, boxes, [96, 54])));
            let is_lit = |point: &&SeenPoint| point.normal.is_some_and(|normal| normal.dot(to_sun) > 0.05);
            if samples.iter().filter(is_lit).count() >= 32 {
                return Self { view, sun, samples, surfaces, boxes: boxes.to_vec() };
            }
        }
    }

    /// The worst of texel over pixel at the surfaces in view, and the 95th percentile.
    fn measured(&self, fitted: &Fitted) -> [f64; 5] {
        let to_sun = self.sun.direction_from(DVec3::ZERO);
        let of = |point: &SeenPoint| {
            let is_lit = point.normal.is_some_and(|normal| normal.dot(to_sun) > 0.05);
            let map = fitted.map_at(self.view.depth(point.position))?;
            is_lit.then(|| map.aliasing(point.position)).flatten()
        };
        let mut all: Vec<f64> = self.surfaces.iter().filter_map(of).collect();
        all.sort_by(f64::total_cmp);
        let at = |part: f64| all.get(((all.len().max(1) - 1) as f64 * part) as usize).copied().unwrap_or(0.0);
        let (mut errors, mut texels, mut pixels, mut worst) = (0.0, 0.0, 0.0, 0.0_f64);
        let mut near = self.view.near();
        let seen = Seen::from_points(&self.surfaces).expect("legal points");
        let scene = Scene::from_box((-1e4, -1e4, -1e4), (1e4, 1e4, 1e4)).expect("a legal box");
        for (far, map) in &fitted.maps {
            let far = far.min(self.view.far());
            let Some((map, view)) = map.as_ref().zip(self.view.narrowed(near, far).ok()) else { continue };
            near = far;
            let focus = Focus::new(&view, &self.sun, &scene).with_seen(&seen);
            let Some(error) = map.surface_error(&focus) else { continue };
            errors += error.mean * error.pixels;
            texels += error.texel * error.pixels;
            pixels += error.pixels;
            worst = worst.max(error.worst);
        }
        [at(1.0), at(0.95), errors / pixels, texels / pixels, worst]
    }
}

/// Maps, each from the depth before it to its own.
struct Fitted {
    maps: Vec<(f64, Option<ShadowMap>)>,
}

impl Fitted {
    fn one(map: Option<ShadowMap>) -> Self {
        Self { maps: vec![(f64::INFINITY, map)] }
    }

    fn of(cascades: &Cascades<'_>, settings: &Settings) -> Self {
        let maps = cascades.iter().map(|cascade| (cascade.far, cascade.focus.fit(settings).into_map())).collect();
        Self { maps }
    }

    fn map_at(&self, depth: f64) -> Option<&ShadowMap> {
        let last = self.maps.len() - 1;
        let index = self.maps.iter().position(|(far, _)| depth < *far).unwrap_or(last);
        self.maps[index].1.as_ref()
    }
}

/// The town: a ground and a house in each block.
fn town(random: &mut StdRng) -> Vec<DAabb> {
    let half = f64::from(BLOCKS) * BLOCK * 0.5;
    let mut boxes = vec![DAabb { min: DVec3::new(-half, -1.0, -half), max: DVec3::new(half, 0.0, half) }];
    for block in 0..BLOCKS * BLOCKS {
        let mut number = |low: f64, high: f64| random.random_range(low..high);
        let middle = |index: i32| (f64::from(index) + 0.5) * BLOCK - half;
        let centre = DVec3::new(middle(block % BLOCKS), 0.0, middle(block / BLOCKS));
        let size = DVec3::new(number(4.0, 7.0), number(3.0, 25.0), number(4.0, 7.0));
        let side = size * DVec3::new(1.0, 0.0, 1.0);
        boxes.push(DAabb { min: centre - side, max: centre + size });
    }
    boxes
}

/// A way of fitting, by its name.
type Way<'a> = (&'a str, &'a dyn Fn(&Case) -> Fitted);

fn main() {
    let mut arguments = std::env::args().skip(1).filter_map(|argument| argument.parse::<u64>().ok());
    let (seed, views) = (arguments.next().unwrap_or(1), arguments.next().unwrap_or(24));
    let mut random = StdRng::seed_from_u64(seed);
    let boxes = town(&mut random);
    let cases: Vec<Case> = (0..views).map(|_| Case::drawn(&mut random, &boxes)).collect();

    let half = f64::from(BLOCKS) * BLOCK * 0.5;
    let scene = Scene::from_box((-half, -1.0, -half), (half, 25.0, half)).expect("a legal box");
    let settings = Settings::new(1024, 1080).expect("legal sizes");
    let narrowed = |case: &Case| {
        let depths = case.samples.iter().map(|point| case.view.depth(point.position));
        let (near, far) =
            depths.fold((f64::INFINITY, 0.0_f64), |(near, far), depth| (near.min(depth), far.max(depth)));
        case.view.narrowed(near, far).expect("surfaces in view")
    };
    let split = |view: View, case: &Case, split: SplitScheme, warp: Warp| {
        let cuts = CascadeSplits::View { count: 4, split };
        let cascades = Cascades::new(&view, &case.sun, &scene, cuts, 0.0).expect("legal cuts");
        Fitted::of(&cascades, &settings.with_warp(warp))
    };
    let chosen = |case: &Case, most: usize, objective: Objective| {
        let seen = Seen::from_points(&case.surfaces).expect("legal points");
        let settings = settings.with_objective(objective);
        let choice = CascadeChoice { most, enough: 1e-3, overlap: 0.0 };
        let cascades = Cascades::chosen(&case.view, &case.sun, &scene, &seen, &choice, &settings);
        Fitted::of(&cascades.expect("a legal choice"), &settings)
    };
    let one = |case: &Case, objective: Objective| {
        let seen = Seen::from_points(&case.surfaces).expect("legal points");
        let focus = Focus::new(&case.view, &case.sun, &scene).with_seen(&seen);
        Fitted::one(focus.fit(&settings.with_objective(objective)).into_map())
    };
    let best = Warp::default();
    // Cuts by brute force: one after another moved to where the error is least, until none moves.
    let brute = |case: &Case, count: usize| {
        let seen = Seen::from_points(&case.surfaces).expect("legal points");
        let view = narrowed(case);
        let at = |part: f64| view.near() * (view.far() / view.near()).powf(part);
        let fitted = |parts: &[f64]| {
            let depths: Vec<f64> = parts.iter().map(|&part| at(part)).collect();
            let cascades = Cascades::new(&case.view, &case.sun, &scene, CascadeSplits::At(&depths), 0.0);
            Fitted::of(&cascades.expect("ascending").with_seen(&seen), &settings)
        };
        let mut parts: Vec<f64> = (1..count).map(|cut| cut as f64 / count as f64).collect();
        let mut least = case.measured(&fitted(&parts))[2];
        loop {
            let before = least;
            for cut in 0..parts.len() {
                for candidate in 1..64 {
                    let mut others = parts.clone();
                    others[cut] = f64::from(candidate) / 64.0;
                    if others.is_sorted_by(|a, b| a < b) {
                        let error = case.measured(&fitted(&others))[2];
                        if error < least {
                            (least, parts) = (error, others);
                        }
                    }
                }
            }
            if least >= before {
                return fitted(&parts);
            }
        }
    };
    let ways: [Way<'_>; 17] = [
        ("1 best, seen depths", &|case| {
            Fitted::one(Focus::new(&narrowed(case), &case.sun, &scene).fit(&settings).into_map())
        }),
        ("2 by brute force", &|case| brute(case, 2)),
        ("4 by brute force", &|case| brute(case, 4)),
        ("4 stable, practical 0.5, over the view", &|case| {
            split(case.view, case, SplitScheme::Practical(0.5), Warp::Stable)
        }),
        ("4 uniform, logarithmic, over the view", &|case| {
            split(case.view, case, SplitScheme::Logarithmic, Warp::Uniform)
        }),
        ("4 uniform, logarithmic, seen depths", &|case| {
            split(narrowed(case), case, SplitScheme::Logarithmic, Warp::Uniform)
        }),
        ("4 best, logarithmic, seen depths", &|case| split(narrowed(case), case, SplitScheme::Logarithmic, best)),
        ("1 uniform, seen depths", &|case| {
            let focus = Focus::new(&narrowed(case), &case.sun, &scene);
            Fitted::one(focus.fit(&settings.with_warp(Warp::Uniform)).into_map())
        }),
        ("1 best, boxes of receivers", &|case| {
            let scene = Scene::new(&case.boxes, &case.boxes).expect("legal boxes");
            Fitted::one(Focus::new(&case.view, &case.sun, &scene).fit(&settings).into_map())
        }),
        ("1 best, seen surfaces", &|case| one(case, Objective::Mean)),
        ("1 least worst, seen surfaces", &|case| one(case, Objective::Worst)),
        ("2 chosen", &|case| chosen(case, 2, Objective::Mean)),
        ("3 chosen", &|case| chosen(case, 3, Objective::Mean)),
        ("4 chosen", &|case| chosen(case, 4, Objective::Mean)),
        ("2 chosen by the least worst", &|case| chosen(case, 2, Objective::Worst)),
        ("3 chosen by the least worst", &|case| chosen(case, 3, Objective::Worst)),
        ("4 chosen by the least worst", &|case| chosen(case, 4, Objective::Worst)),
    ];
    println!(
        "seed {seed}, {} views: texel over pixel at what is seen, medians: worst, 95 %; error: mean, mean texel, worst",
        cases.len()
    );
    for (name, way) in ways {
        let mut all: Vec<[f64; 5]> = cases.iter().map(|case| case.measured(&way(case))).collect();
        let mut median = |of: usize| {
            all.sort_by(|a, b| a[of].total_cmp(&b[of]));
            all[all.len() / 2][of]
        };
        println!(
            "{name:45} {:7.2} {:7.2} {:7.2} {:7.2} {:7.2}",
            median(0),
            median(1),
            median(2),
            median(3),
            median(4)
        );
    }
}
