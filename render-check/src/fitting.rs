//! The calls into `shadowfit`: all that it says about one light, and how long it takes to say it.

use std::hint::black_box;
use std::time::{Duration, Instant};

use anyhow::{Context, Result};
use shadowfit::{Body, Focus, Form, Light, LightClass, Outcome, Scene, Settings, Shift, View, Warp, classify, fit};

use crate::light::LightSpec;
use crate::scene::Mesh;

/// A lamp's shadow map begins this far from it, as a part of the diagonal of the scene's box: inside any lampshade.
const LAMP_NEAR: f64 = 1e-3;

/// How long fits are timed for each light, and how many at most.
const TIMING_BUDGET: Duration = Duration::from_millis(100);
const MOST_TIMED_FITS: usize = 2001;

/// All that is known of one light.
#[derive(Debug)]
pub struct LightFit {
    /// The light as it was written.
    pub spec: LightSpec,
    /// What the camera's perspective makes of it.
    pub class: LightClass,
    /// The focus body H as the paper has it.
    pub body: Body,
    /// The tight form of H.
    pub tight_body: Body,
    /// The fit without a warp.
    pub uniform: Outcome,
    /// The perspective shadow map's.
    pub perspective: Outcome,
    /// The perspective shadow map's with the virtual camera moved back for the whole of H, as in the paper.
    pub shifted: Outcome,
    /// The median time of one perspective fit on this machine.
    pub median_time: Duration,
}

/// The scene's box, as the fit wants it.
///
/// # Errors
///
/// When its coordinates are beyond what a fit takes.
pub fn scene_box(mesh: &Mesh) -> Result<Scene<'static>> {
    let (min, max) = mesh.bounds();
    Scene::from_box(min, max).context("the scene's extent cannot be used")
}

/// Fits one light.
///
/// # Errors
///
/// When the light makes no sense.
pub fn fit_light(spec: LightSpec, view: &View, mesh: &Mesh, settings: &Settings) -> Result<LightFit> {
    let scene = scene_box(mesh)?;
    let (min, max) = mesh.bounds();
    let light: Light = spec.to_light(LAMP_NEAR * (max - min).length())?;
    let focus = Focus::new(view, &light, &scene);
    let perspective = settings.with_warp(Warp::Perspective);
    Ok(LightFit {
        spec,
        class: classify(view, &light),
        body: focus.body(Form::Paper),
        tight_body: focus.body(Form::Tight),
        uniform: fit(view, &light, &scene, &settings.with_warp(Warp::Uniform)),
        perspective: fit(view, &light, &scene, &perspective),
        shifted: fit(view, &light, &scene, &perspective.with_shift(Shift::Back(Form::Paper))),
        median_time: median_time(|| fit(view, &light, &scene, black_box(&perspective))),
    })
}

/// The median time of many calls.
fn median_time<T>(call: impl Fn() -> T) -> Duration {
    let begin = Instant::now();
    let mut times = Vec::new();
    while times.is_empty() || (times.len() < MOST_TIMED_FITS && begin.elapsed() < TIMING_BUDGET) {
        let start = Instant::now();
        black_box(call());
        times.push(start.elapsed());
    }
    times.sort_unstable();
    times[times.len() / 2]
}
