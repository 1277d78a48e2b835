//! What is looked at: triangles in world space, and the cameras and lights that came with them.

mod accessor;
mod builtin;
mod cloud;
pub mod damage;
mod glb;
mod mesh;

use std::fmt;
use std::path::Path;

use anyhow::{Result, bail};
use shadowfit::glam::DVec3;

pub use builtin::{BUILT_IN, BuiltIn};
pub use cloud::Disc;
pub use mesh::{Mesh, MeshBuilder, Object, Part};

use crate::framing::Camera;
use crate::light::LightSpec;

/// A scene, loaded.
#[derive(Clone, Debug)]
pub struct LoadedScene {
    /// A short name for titles and directories.
    pub name: String,
    /// All triangles, in world space; at least one.
    pub mesh: Mesh,
    /// The scene's own camera, if it has one.
    pub camera: Option<Camera>,
    /// The scene's own lights.
    pub lights: Vec<LightSpec>,
    /// What was left out.
    pub left_out: LeftOut,
}

/// What a loader left out of the scene, by count.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct LeftOut {
    /// Triangles with an index beyond the vertices.
    pub out_of_range: usize,
    /// Triangles that are there already, with the same corners in the same order.
    pub twice: usize,
    /// Triangles with a vertex that is not finite.
    pub not_finite: usize,
    /// Triangles with a coordinate larger than a fit takes.
    pub too_large: usize,
    /// Triangles without area.
    pub flat: usize,
    /// Points that are not finite or too large, or that too few others are around.
    pub points: usize,
    /// Primitives made of lines, strips or fans.
    pub other_primitives: usize,
    /// Cameras that are not used: all but the first perspective camera that makes sense.
    pub cameras: usize,
    /// Lights that cannot be used.
    pub lights: usize,
}

impl LeftOut {
    /// Whether everything is there.
    #[must_use]
    pub fn is_nothing(&self) -> bool {
        *self == Self::default()
    }
}

impl fmt::Display for LeftOut {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let parts: Vec<String> = [
            (self.flat, "triangle(s) without area"),
            (self.twice, "triangle(s) that are there twice"),
            (self.not_finite, "triangle(s) with a vertex that is not a finite number"),
            (self.too_large, "triangle(s) with a coordinate beyond 2^40"),
            (self.out_of_range, "triangle(s) with an index beyond the vertices"),
            (self.points, "point(s) that are not a number or too large or have too few others around them"),
            (
                self.other_primitives,
                "primitive(s) that are neither triangle lists nor points (lines, strips, fans)",
            ),
            (self.cameras, "camera(s) that are further ones, orthographic, or make no sense"),
            (self.lights, "light(s) with a direction, cone or range that makes no sense"),
        ]
        .iter()
        .filter(|(count, _)| *count > 0)
        .map(|(count, what)| format!("{count} {what}"))
        .collect();
        write!(f, "left out: {}", parts.join(", "))
    }
}

/// Makes the built-in scene of that name; else loads a `.glb` file.
///
/// # Errors
///
/// When the file cannot be read, is not sound glTF, or has no triangles.
pub fn load(path: &Path) -> Result<LoadedScene> {
    let scene = match BUILT_IN.iter().find(|built_in| path == Path::new(built_in.name)) {
        Some(built_in) => (built_in.make)(),
        None if path.extension().is_none() && !path.exists() => {
            let names = BUILT_IN.map(|built_in| built_in.name).join(", ");
            bail!("'{}' is neither a file nor a built-in scene: these are {names}", path.display());
        }
        None => glb::load(path)?,
    };
    if scene.mesh.triangles.is_empty() {
        let left_out = if scene.left_out.is_nothing() { String::new() } else { format!(" ({})", scene.left_out) };
        bail!("the scene '{}' has no triangles to cast or receive a shadow{left_out}", scene.name);
    }
    Ok(scene)
}

impl LoadedScene {
    /// The same scene elsewhere and of another size: a position p becomes scale · p + offset. The scale is positive.
    #[must_use]
    pub fn moved(&self, scale: f64, offset: DVec3) -> Self {
        let position = |p: DVec3| scale * p + offset;
        let mut moved = self.clone();
        moved.mesh.vertices.iter_mut().for_each(|vertex| *vertex = position(*vertex));
        for disc in &mut moved.mesh.discs {
            (disc.centre, disc.radius) = (position(disc.centre), scale * disc.radius);
        }
        for object in &mut moved.mesh.objects {
            (object.min, object.max) = (position(object.min), position(object.max));
        }
        if let Some(camera) = &mut moved.camera {
            camera.eye = position(camera.eye);
            camera.near = camera.near.map(|near| scale * near);
            camera.far = camera.far.map(|far| scale * far);
        }
        for light in &mut moved.lights {
            match light {
                LightSpec::Sun { .. } => {}
                LightSpec::Point { position: at, range } => (*at, *range) = (position(*at), scale * *range),
                LightSpec::Spot { position: at, target, range, .. } => {
                    (*at, *target, *range) = (position(*at), position(*target), scale * *range);
                }
            }
        }
        moved
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn built_in_scenes_are_whole() {
        for built_in in BUILT_IN {
            let scene = load(Path::new(built_in.name)).expect(built_in.name);
            assert_eq!(scene.name, built_in.name);
            assert!(
                scene.camera.is_some() && !scene.lights.is_empty() && scene.left_out.is_nothing(),
                "{}",
                scene.name
            );
            assert!(scene.mesh.triangles.len() < 70_000, "{}: {}", scene.name, scene.mesh.triangles.len());
            let drawn: usize = scene.mesh.objects.iter().map(|object| object.triangles.len()).sum();
            assert_eq!(drawn, scene.mesh.triangles.len(), "{}", scene.name);
        }
    }

    #[test]
    fn a_name_that_is_none_is_told_those_that_are() {
        let error = load(Path::new("chess")).expect_err("no such scene").to_string();
        assert!(error.contains("chess-board"), "{error}");
    }

    #[test]
    fn a_scene_that_is_moved_keeps_its_shape() {
        let scene = load(Path::new("chess-board")).expect("built in");
        let offset = DVec3::new(1e3, -2e3, 5e2);
        let moved = scene.moved(4.0, offset);
        let ((min, max), (moved_min, moved_max)) = (scene.mesh.bounds(), moved.mesh.bounds());
        assert!((moved_min - (4.0 * min + offset)).length() < 1e-9);
        assert!((moved_max - (4.0 * max + offset)).length() < 1e-9);
        let object = |scene: &LoadedScene| scene.mesh.objects[7].clone();
        assert!((object(&moved).min - (4.0 * object(&scene).min + offset)).length() < 1e-9);
        let camera = |scene: &LoadedScene| scene.camera.expect("it has one");
        assert_eq!(camera(&moved).eye, 4.0 * camera(&scene).eye + offset);
        assert_eq!(camera(&moved).far, Some(4.0 * 28.0));
        assert_eq!(moved.lights[0], scene.lights[0]);
        assert_eq!(moved.lights[1].position(), scene.lights[1].position().map(|p| 4.0 * p + offset));
    }
}
