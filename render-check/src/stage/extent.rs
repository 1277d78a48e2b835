//! The scene's box for the fit, and the default near plane of local lights.

use anyhow::{Context, Result};
use shadowfit::Scene;

use crate::scene::{LightSpec, Mesh};
use crate::trace::Tracer;

/// The smallest default near plane of a local light, relative to the diagonal of the scene's box: inside a
/// lampshade, and outside the bulb.
const LEAST_LAMP_NEAR: f64 = 1e-3;

/// The default near plane relative to the distance of the nearest surface.
const OF_NEAREST: f64 = 0.5;

/// The scene's box for the fit.
///
/// # Errors
///
/// When its coordinates are too large for a fit.
pub fn scene_box(mesh: &Mesh) -> Result<Scene<'static>> {
    let (min, max) = mesh.bounds();
    Scene::from_box(min, max).context("the scene's extent cannot be used")
}

/// The smallest default near plane of a local light, in world units.
#[must_use]
pub fn least_lamp_near(mesh: &Mesh) -> f64 {
    let (min, max) = mesh.bounds();
    LEAST_LAMP_NEAR * (max - min).length()
}

/// The default near plane of a light, in world units: half the distance to the nearest surface, but at least
/// [`least_lamp_near`]. A sun, which needs none, gets the smallest.
#[must_use]
pub fn lamp_near(tracer: &Tracer<'_>, spec: &LightSpec) -> f64 {
    let nearest = spec.position().map_or(0.0, |position| tracer.distance_to(position));
    least_lamp_near(tracer.mesh()).max(OF_NEAREST * nearest.min(spec.range()))
}
