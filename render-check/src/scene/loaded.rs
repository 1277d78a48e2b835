//! A scene: triangles, camera and lights.

use shadowfit::glam::DVec3;

use super::camera::Camera;
use super::left_out::LeftOut;
use super::light::LightSpec;
use super::mesh::Mesh;

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

impl LoadedScene {
    /// The scene scaled and translated: a position p becomes scale · p + offset. The scale is positive.
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
    use std::path::Path;

    use super::*;
    use crate::scene::load;

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
