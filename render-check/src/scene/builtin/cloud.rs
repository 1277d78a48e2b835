//! A cloud of points: an undulating ground, sampled irregularly, and a ball that hovers over it. One unit is a
//! metre.

use std::f64::consts::TAU;

use shadowfit::glam::{DMat4, DVec3};

use super::solids::scattered;
use crate::scene::{Camera, LightSpec, LoadedScene, MeshBuilder};

/// Points along each side of the ground, and how far they are apart.
const SIDE: u32 = 60;
const SPACING: f64 = 0.2;
/// Jitter of the grid, relative to the spacing.
const JITTER: f64 = 0.15;

const BALL: DVec3 = DVec3::new(0.4, 2.1, 0.6);
const BALL_RADIUS: f64 = 1.0;
const POINTS_ON_BALL: u32 = 700;

const EARTH: [f32; 3] = [0.35, 0.30, 0.20];
const CLAY: [f32; 3] = [0.55, 0.24, 0.13];

/// Makes the scene with its camera and two lights: a sun and a lamp.
pub(super) fn make() -> LoadedScene {
    let mut builder = MeshBuilder::default();
    let ground: Vec<DVec3> = (0..SIDE * SIDE).map(on_ground).collect();
    let ball: Vec<DVec3> = (0..POINTS_ON_BALL).map(on_ball).collect();
    builder.add_points(&ground, EARTH, DMat4::IDENTITY);
    builder.add_points(&ball, CLAY, DMat4::IDENTITY);
    let (mesh, left_out) = builder.finish();
    let eye = DVec3::new(-3.6, 3.4, 6.6);
    LoadedScene {
        name: "cloud".into(),
        mesh,
        camera: Some(Camera {
            eye,
            forward: (DVec3::new(0.2, 0.8, 0.0) - eye).normalize(),
            up: DVec3::Y,
            fov_y: 48_f64.to_radians(),
            near: Some(1.0),
            far: Some(25.0),
        }),
        lights: vec![
            LightSpec::Sun { direction_to_light: DVec3::new(0.5, 1.0, 0.35) },
            LightSpec::Point { position: DVec3::new(-1.5, 6.0, 2.0), range: f64::INFINITY },
        ],
        left_out,
    }
}

fn on_ground(point: u32) -> DVec3 {
    let along = |step: u32, property: u32| {
        let jitter = JITTER * (2.0 * scattered(point, property) - 1.0);
        SPACING * (f64::from(step) - 0.5 * f64::from(SIDE - 1) + jitter)
    };
    let (x, z) = (along(point % SIDE, 0), along(point / SIDE, 1));
    DVec3::new(x, 0.25 * (0.9 * x).sin() * (0.7 * z + 0.4).cos(), z)
}

/// Spread over the ball by the golden angle, so that no two are close together.
fn on_ball(point: u32) -> DVec3 {
    let y = 1.0 - 2.0 * (f64::from(point) + 0.5) / f64::from(POINTS_ON_BALL);
    let (sin, cos) = (0.381_966 * TAU * f64::from(point)).sin_cos();
    let radius = (1.0 - y * y).sqrt();
    BALL + BALL_RADIUS * DVec3::new(radius * cos, y, radius * sin)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_point_is_a_disc_and_the_balls_face_outwards() {
        let mesh = make().mesh;
        assert_eq!(mesh.discs.len() as u32, SIDE * SIDE + POINTS_ON_BALL);
        assert_eq!((mesh.first_disc_triangle(), mesh.triangles.len()), (0, 4 * mesh.discs.len()));
        for disc in mesh.discs.iter().filter(|disc| disc.centre.distance(BALL) < 1.01 * BALL_RADIUS) {
            let outwards = (disc.centre - BALL).normalize();
            assert!(disc.normal.dot(outwards).abs() > 0.95, "{disc:?}");
        }
    }

    #[test]
    fn no_ray_from_above_finds_a_hole() {
        let mesh = make().mesh;
        let tracer = crate::trace::Tracer::new(&mesh).expect("it has triangles");
        for i in 0..4000 {
            let at = |property| 10.0 * scattered(i, property) - 5.0;
            let (origin, direction) = (DVec3::new(at(2), 9.0, at(3)), DVec3::NEG_Y);
            assert!(tracer.first_hit(&crate::trace::Ray { origin, direction, length: 20.0 }).is_some(), "{origin}");
        }
    }
}
