//! Loading scenes by name or file.

use std::path::Path;

use anyhow::{Result, bail};

use super::builtin::BUILT_IN;
use super::glb;
use super::loaded::LoadedScene;

/// Builds the built-in scene of that name; else loads a `.glb` file.
///
/// # Errors
///
/// When the file cannot be read, is not valid glTF, or has no triangles.
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
}
