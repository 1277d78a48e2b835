//! The opening steps of a command: load the scene, place the camera, choose the lights.

use std::path::{Path, PathBuf};

use anyhow::Result;
use shadowfit::View;
use shadowfit::glam::DVec3;

use super::view::ViewArgs;
use crate::output::progress::spinner;
use crate::output::{complain, make_directory, say};
use crate::scene::{self, Camera, LightSpec, LoadedScene, Mesh};
use crate::stage::{choose_camera, choose_view, least_lamp_near};
use crate::trace::Tracer;

/// The light of a scene without lights.
const DEFAULT_SUN: LightSpec = LightSpec::Sun { direction_to_light: DVec3::new(0.5, 1.0, 0.35) };

/// Loads the scene that the arguments name, and prints its size.
///
/// # Errors
///
/// When the scene cannot be loaded.
pub fn open(args: &ViewArgs) -> Result<LoadedScene> {
    let scene = {
        let _spinner = spinner("loading the scene");
        scene::load(&args.scene)?
    };
    let (min, max) = scene.mesh.bounds();
    say(&format!("{}: {} triangles, {min:.3} to {max:.3}", scene.name, scene.mesh.triangles.len()));
    if !scene.left_out.is_nothing() {
        say(&scene.left_out.to_string());
    }
    Ok(scene)
}

/// The output directory, created where it is missing.
///
/// # Errors
///
/// When it cannot be created.
pub fn output_directory(args: &ViewArgs, scene: &LoadedScene) -> Result<PathBuf> {
    let out = args.out.clone().unwrap_or_else(|| Path::new("out").join(&scene.name));
    make_directory(&out)?;
    Ok(out)
}

/// Builds the ray tracer's bounding-volume tree.
///
/// # Errors
///
/// When there are no triangles.
pub fn sort(mesh: &Mesh) -> Result<Tracer<'_>> {
    let _spinner = spinner("sorting the triangles");
    Tracer::new(mesh)
}

/// The camera that the arguments ask for, and its view; prints both.
///
/// # Errors
///
/// When the camera is invalid or nothing is in view.
pub fn place_camera(args: &ViewArgs, scene: &LoadedScene, tracer: &Tracer<'_>) -> Result<(Camera, View)> {
    let camera = choose_camera(&args.camera(), args.aspect(), scene)?;
    let (view, warning) = choose_view(&camera, args.aspect(), tracer)?;
    say(&format!(
        "camera: eye {:.3}, forward {:.3}, field of view {:.1} degrees, near {:.4}, far {:.4}",
        view.eye(),
        view.forward(),
        camera.fov_y.to_degrees(),
        view.near(),
        view.far()
    ));
    if let Some(warning) = warning {
        complain(&format!("warning: {warning}"));
    }
    Ok((camera, view))
}

/// The lights that the arguments ask for; else the scene's own; else a sun. Prints which of the scene's lights are
/// invalid.
#[must_use]
pub fn choose_lights(args: &ViewArgs, scene: &LoadedScene) -> Vec<LightSpec> {
    if !args.lights.is_empty() {
        return args.lights.clone();
    }
    let near = args.lamp_near.unwrap_or_else(|| least_lamp_near(&scene.mesh));
    let is_usable = |light: &LightSpec| match light.to_light(near) {
        Ok(_) => true,
        Err(error) => {
            complain(&format!("warning: left out: {error:#}"));
            false
        }
    };
    let usable: Vec<LightSpec> = scene.lights.iter().copied().filter(is_usable).collect();
    if usable.is_empty() { vec![DEFAULT_SUN] } else { usable }
}
