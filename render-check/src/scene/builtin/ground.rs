//! The built-in scene without any height: a flat plate that casts no shadow and receives none.

use shadowfit::glam::{DMat4, DVec3, Vec3};

use crate::scene::{Camera, LightSpec, LoadedScene, MeshBuilder, Part};

/// Half of the plate's width and length.
const HALF_SIZE: f64 = 20.0;
const EYE_HEIGHT: f64 = 2.0;
const LAMP_HEIGHT: f64 = 5.0;

const STONE: [f32; 3] = [0.46, 0.44, 0.40];

/// Makes the scene with its camera and two lights: an oblique sun and a lamp.
pub(super) fn make() -> LoadedScene {
    let corners = [(-1.0, 1.0), (1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)];
    let positions = corners.map(|(x, z)| HALF_SIZE * DVec3::new(x, 0.0, z));
    // A thickness would give the scene's box a height: this is the one scene whose box has none.
    let plate =
        Part { positions: &positions, normals: &[Vec3::Y; 4], triangles: &[[0, 1, 2], [0, 2, 3]], colour: STONE };
    let mut builder = MeshBuilder::default();
    builder.add(&plate, DMat4::IDENTITY);
    let (mesh, left_out) = builder.finish();
    let eye = DVec3::new(0.0, EYE_HEIGHT, 18.0);
    LoadedScene {
        name: "ground".into(),
        mesh,
        camera: Some(Camera {
            eye,
            forward: (DVec3::new(0.0, 0.0, 8.0) - eye).normalize(),
            up: DVec3::Y,
            fov_y: 45_f64.to_radians(),
            near: Some(1.0),
            far: Some(45.0),
        }),
        lights: vec![
            LightSpec::Sun { direction_to_light: DVec3::new(-0.6, 0.5, -0.4) },
            LightSpec::Point { position: DVec3::new(1.5, LAMP_HEIGHT, 6.0), range: f64::INFINITY },
        ],
        left_out,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_plate_has_no_height_and_faces_up() {
        let scene = make();
        let corner = HALF_SIZE * DVec3::new(1.0, 0.0, 1.0);
        assert_eq!(scene.mesh.bounds(), (-corner, corner));
        assert_eq!(scene.mesh.triangles.len(), 2);
        assert!((0..2).all(|triangle| scene.mesh.face_normal(triangle) == DVec3::Y));
        assert!(scene.left_out.is_nothing(), "{}", scene.left_out);
    }

    #[test]
    fn the_eye_and_the_lights_are_above_the_plate() {
        let scene = make();
        let camera = scene.camera.expect("the scene has a camera");
        assert!(camera.eye.y == EYE_HEIGHT && camera.forward.y > -0.3, "it looks along the plate");
        for light in &scene.lights {
            match *light {
                LightSpec::Sun { direction_to_light } => assert!(direction_to_light.y > 0.0),
                _ => assert_eq!(light.position().map(|p| p.y), Some(LAMP_HEIGHT)),
            }
        }
    }
}
