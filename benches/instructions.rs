//! Instructions, counted by Valgrind's callgrind, which repeat to the digit where times do not:
//!
//! ```text
//! apt-get install valgrind
//! cargo install --version 0.20.0 gungraun-runner
//! cargo bench --bench instructions
//! ```

// The macros generate items without documentation.
#![allow(missing_docs)]

mod cases;

use gungraun::{library_benchmark, library_benchmark_group, main};
use shadowfit::cascades::{CascadeChoice, Cascades};
use shadowfit::glam::DVec3;
use shadowfit::seen::{Seen, SeenPoint};
use shadowfit::{Focus, FocusForm, Light, Outcome, Scene, Settings, View, fit, focus::ConvexBody};
use std::hint::black_box;

/// A view, a light, a scene and settings.
type Case = (View, Light, Scene<'static>, Settings);

fn case(light: usize, settings: usize) -> Case {
    let case = || Some((cases::view().ok()?, cases::lights().ok()?[light].1, cases::scene().ok()?));
    let Some((view, light, scene)) = case() else { panic!("a case of the benchmark is no valid input") };
    (view, light, scene, cases::settings()[settings].1)
}

#[library_benchmark]
#[bench::directional_uniform(case(0, 0))]
#[bench::directional_psm(case(0, 1))]
#[bench::directional_psm_shifted(case(0, 2))]
#[bench::directional_light_space(case(0, 3))]
#[bench::directional_trapezoidal(case(0, 4))]
#[bench::directional_best_closed_forms(case(0, 5))]
#[bench::directional_best_rough(case(0, 6))]
#[bench::directional_best_good(case(0, 7))]
#[bench::directional_best_thorough(case(0, 8))]
#[bench::directional_stable(case(0, 9))]
#[bench::point_uniform(case(1, 0))]
#[bench::point_psm(case(1, 1))]
#[bench::point_psm_shifted(case(1, 2))]
#[bench::point_light_space(case(1, 3))]
#[bench::point_trapezoidal(case(1, 4))]
#[bench::point_best_closed_forms(case(1, 5))]
#[bench::point_best_rough(case(1, 6))]
#[bench::point_best_good(case(1, 7))]
#[bench::point_best_thorough(case(1, 8))]
#[bench::spot_uniform(case(2, 0))]
#[bench::spot_psm(case(2, 1))]
#[bench::spot_psm_shifted(case(2, 2))]
#[bench::spot_light_space(case(2, 3))]
#[bench::spot_trapezoidal(case(2, 4))]
#[bench::spot_best_closed_forms(case(2, 5))]
#[bench::spot_best_rough(case(2, 6))]
#[bench::spot_best_good(case(2, 7))]
#[bench::spot_best_thorough(case(2, 8))]
#[bench::spot_stable(case(2, 9))]
fn whole_fit((view, light, scene, settings): Case) -> Outcome {
    fit(black_box(&view), black_box(&light), black_box(&scene), black_box(&settings))
}

#[library_benchmark]
#[bench::directional(case(0, 0))]
#[bench::point(case(1, 0))]
#[bench::spot(case(2, 0))]
fn body_of_the_paper((view, light, scene, _): Case) -> ConvexBody {
    Focus::new(black_box(&view), black_box(&light), black_box(&scene)).caster_volume(FocusForm::ViewHull)
}

/// So many points of a ground and of walls, in the view of the benchmark.
fn surfaces(count: usize) -> Vec<SeenPoint> {
    let Ok(view) = cases::view() else { panic!("no valid view") };
    let side = DVec3::Y.cross(view.forward()).normalize();
    (0..count)
        .map(|index| {
            let (along, across) = ((index as f64 + 0.5) / count as f64, (index * 7 % 16) as f64 / 8.0 - 0.9);
            let depth = 2.0 + 78.0 * along * along;
            let place = view.eye() + view.forward() * depth + side * (0.4 * across * depth);
            let is_wall = index % 3 == 0;
            let normal = if is_wall { -side * across.signum() } else { DVec3::Y };
            let position = if is_wall { place } else { DVec3::new(place.x, 0.0, place.z) };
            SeenPoint { position, normal: Some(normal), pixels: 1.0 }
        })
        .collect()
}

type SeenCase = (Case, Vec<SeenPoint>);

#[library_benchmark]
#[bench::directional_64((case(0, 7), surfaces(64)))]
#[bench::directional_256((case(0, 7), surfaces(256)))]
#[bench::point_64((case(1, 7), surfaces(64)))]
#[bench::spot_64((case(2, 7), surfaces(64)))]
fn fit_to_seen(((view, light, scene, settings), points): SeenCase) -> Outcome {
    let Ok(seen) = Seen::from_points(black_box(&points)) else { panic!("no valid points") };
    Focus::new(black_box(&view), black_box(&light), black_box(&scene)).with_seen(&seen).fit(black_box(&settings))
}

#[library_benchmark]
#[bench::directional_64((case(0, 7), surfaces(64)))]
#[bench::directional_256((case(0, 7), surfaces(256)))]
fn four_cascades_chosen(((view, light, scene, settings), points): SeenCase) -> usize {
    let Ok(seen) = Seen::from_points(black_box(&points)) else { panic!("no valid points") };
    let choice = CascadeChoice { most: 4, enough: 1e-3, overlap: 0.1 };
    let cascades = Cascades::chosen(black_box(&view), black_box(&light), &scene, &seen, &choice, &settings);
    cascades.map_or(0, |cascades| cascades.fit(&settings).maps().count())
}

library_benchmark_group!(
    name = fits,
    benchmarks = [whole_fit, body_of_the_paper, fit_to_seen, four_cascades_chosen]
);
main!(library_benchmark_groups = fits);
