//! What is looked at: triangles in world space, and the cameras and lights that came with them.

mod accessor;
mod chess_board;
mod glb;
mod lathe;
mod mesh;

use std::fmt;
use std::path::Path;

use anyhow::{Result, bail};

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
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LeftOut {
    /// Triangles with a vertex that is not finite.
    pub not_finite: usize,
    /// Triangles without area.
    pub flat: usize,
    /// Primitives made of points, lines, strips or fans.
    pub other_primitives: usize,
    /// Cameras that are not used: all but the first perspective camera.
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
            (self.not_finite, "triangle(s) with a vertex that is not a number"),
            (self.other_primitives, "primitive(s) that are not triangle lists (points, lines, strips, fans)"),
            (self.cameras, "further or orthographic camera(s)"),
            (self.lights, "light(s) with a direction, cone or range that makes no sense"),
        ]
        .iter()
        .filter(|(count, _)| *count > 0)
        .map(|(count, what)| format!("{count} {what}"))
        .collect();
        write!(f, "left out: {}", parts.join(", "))
    }
}

/// Loads a `.glb` file, or makes the built-in chess board where there is no file.
///
/// # Errors
///
/// When the file cannot be read, is not sound glTF, or has no triangles.
pub fn load(path: &Path) -> Result<LoadedScene> {
    let scene = if path == Path::new("chess-board") { chess_board::make() } else { glb::load(path)? };
    if scene.mesh.triangles.is_empty() {
        let left_out = if scene.left_out.is_nothing() { String::new() } else { format!(" ({})", scene.left_out) };
        bail!("the scene '{}' has no triangles to cast or receive a shadow{left_out}", scene.name);
    }
    Ok(scene)
}

impl LoadedScene {
    #[must_use]
    pub fn moved(&self, _scale: f64, _offset: shadowfit::glam::DVec3) -> Self {
        self.clone()
    }
}
