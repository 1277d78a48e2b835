//! Views, lights and scenes at random, with more than their share of the hard cases.
//!
//! A case is plain numbers, and its `Debug` form is the Rust expression that makes it again: a
//! failing one can be pasted into a named test. Nothing here asks the crate for a fit; the crate
//! only turns the numbers into its own types, and its axes of a view say where to put a light.
//!
//! - `params`: the numbers, and what the crate makes of them; `similarity`: what moves them.
//! - `primitive`: directions, magnitudes, and values a few ulps from another.
//! - `views`, `lights`, `scenes`: one strategy for each concept; `doors`: pyramids, lights within planes, many planes.
//! - `together`: a case brought together, with settings, and points to try a map on.
//! - `bytes`, `edits`, `corpus`: cases from the bytes of a fuzzer, and those that fuzzing has kept.

#![allow(clippy::disallowed_methods, reason = "angles and powers spread the cases, they are no part of a fit")]

mod bytes;
mod corpus;
mod doors;
mod edits;
mod lights;
mod params;
mod primitive;
mod scenes;
mod similarity;
mod together;
mod views;

pub use bytes::{ShownOnPanic, case_with, drawn};
pub use corpus::replay;
pub use doors::wide_door;
pub use edits::numbers;
pub use lights::LightParams;
pub use params::Case;
pub use primitive::{number_bits, rotation};
pub use scenes::{SceneParams, SceneStore};
pub use similarity::{Similarity, plane};
pub use together::{FORMS, Numbers, Together, WARPS, following, points_of, settings, sides};
pub use views::{Frame, Pose, ViewParams, clip_space};

use lights::light_place;
use primitive::direction;
use scenes::scene_place;
use views::{lattice_view, view};

use proptest::prelude::*;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};

/// Whole cases: any light and any scene about any view, anywhere and at any scale.
pub fn case() -> impl Strategy<Value = Case> {
    prop_oneof![
        6 => (view().boxed(), light_place().boxed(), scene_place().boxed()).prop_map(assemble),
        2 => lattice_case(),
    ]
    .prop_flat_map(|case| similarity().prop_map(move |similarity| case.moved(&similarity)))
    .prop_filter("refused at the door", Case::is_accepted)
}

/// Cases whose every plane and vertex is an exact small number, so that many coincide.
fn lattice_case() -> impl Strategy<Value = Case> {
    let light = lights::lattice_light();
    (lattice_view().boxed(), light.boxed(), scenes::lattice_scene().boxed()).prop_map(|(view, light, scene)| Case {
        view,
        light,
        scene,
    })
}

/// Most cases stay where they are; the others go far out, or become small or large.
fn similarity() -> impl Strategy<Value = Similarity> {
    let scale = prop_oneof![
        6 => Just(1.0),
        1 => Just(1e-3),
        1 => Just(1e6),
    ];
    let distance = prop_oneof![
        6 => Just(0.0),
        1 => Just(1e6),
        1 => Just(1e7),
    ];
    (scale, distance, direction())
        .prop_map(|(scale, distance, direction)| Similarity { scale, offset: direction.map(|x| x * distance) })
}

fn assemble((view, light, scene): (ViewParams, lights::Place, scenes::Place)) -> Case {
    let built = view.build().expect("the strategies make legal views");
    let scene = scene.about(&built);
    let light = light.about(&built, scene.bounds());
    Case { view, light, scene }
}

/// Checks a property for some thousands of values, or as many as `SHADOWFIT_CASES` says.
///
/// The seed is fixed, so that a run can be repeated; a value for which the property panics is made
/// smaller before it is reported.
pub fn run<S: Strategy>(cases: u32, strategy: &S, property: impl Fn(S::Value)) {
    let asked = std::env::var("SHADOWFIT_CASES").ok();
    let asked = asked.map(|count| count.parse().expect("SHADOWFIT_CASES is a number"));
    let config = Config { cases: asked.unwrap_or(cases), failure_persistence: None, ..Config::default() };
    let rng = TestRng::from_seed(RngAlgorithm::ChaCha, &[7; 32]);
    let result = TestRunner::new_with_rng(config, rng).run(strategy, |value| {
        property(value);
        Ok(())
    });
    if let Err(failure) = result {
        panic!("{failure}");
    }
}
