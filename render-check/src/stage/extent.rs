//! What a fit is told of the scene: its box, and where the maps of lamps begin.

use anyhow::{Context, Result};
use shadowfit::Scene;

use crate::scene::{LightSpec, Mesh};
use crate::trace::Tracer;

/// A lamp's shadow map begins at least this far from it where nobody says, as a part of the diagonal of the scene's box:
/// inside any lampshade, and beyond the bulb.
const LEAST_LAMP_NEAR: f64 = 1e-3;

/// Where nothing is so near, it begins at this part of the distance to the nearest surface.
const OF_NEAREST: f64 = 0.5;

/// The scene's box, as the fit wants it.
///
/// # Errors
///
/// When its coordinates are beyond what a fit takes.
pub fn scene_box(mesh: &Mesh) -> Result<Scene<'static>> {
    let (min, max) = mesh.bounds();
    Scene::from_box(min, max).context("the scene's extent cannot be used")
}

/// The least distance from a lamp at which its map begins where nobody says, in world units.
#[must_use]
pub fn least_lamp_near(mesh: &Mesh) -> f64 {
    let (min, max) = mesh.bounds();
    LEAST_LAMP_NEAR * (max - min).length()
}

/// The distance from a lamp at which its map begins where nobody says, in world units: what the surfaces around it allow. A
/// sun, which has none, has the least.
#[must_use]
pub fn lamp_near(tracer: &Tracer<'_>, spec: &LightSpec) -> f64 {
    let nearest = spec.position().map_or(0.0, |position| tracer.distance_to(position));
    least_lamp_near(tracer.mesh()).max(OF_NEAREST * nearest.min(spec.range()))
}
