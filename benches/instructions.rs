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
use shadowfit::{Body, Focus, Form, Light, Outcome, Scene, Settings, View, fit};
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
#[bench::point_uniform(case(1, 0))]
#[bench::point_psm(case(1, 1))]
#[bench::point_psm_shifted(case(1, 2))]
#[bench::spot_uniform(case(2, 0))]
#[bench::spot_psm(case(2, 1))]
#[bench::spot_psm_shifted(case(2, 2))]
fn whole_fit((view, light, scene, settings): Case) -> Outcome {
    fit(black_box(&view), black_box(&light), black_box(&scene), black_box(&settings))
}

#[library_benchmark]
#[bench::directional(case(0, 0))]
#[bench::point(case(1, 0))]
#[bench::spot(case(2, 0))]
fn body_of_the_paper((view, light, scene, _): Case) -> Body {
    Focus::new(black_box(&view), black_box(&light), black_box(&scene)).body(Form::Paper)
}

library_benchmark_group!(name = fits, benchmarks = [whole_fit, body_of_the_paper]);
main!(library_benchmark_groups = fits);
