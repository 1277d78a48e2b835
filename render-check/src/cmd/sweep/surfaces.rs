//! Point lights on paths through the surfaces of a scene.

use std::path::Path;

use anyhow::{Result, ensure};
use shadowfit::glam::DVec3;

use super::lights::NamedLight;
use super::shot::{Shot, Stand};
use crate::maps::Technique;
use crate::run::Options;
use crate::scene::{self, LightSpec, LoadedScene, Mesh};
use crate::trace::{Ray, Tracer};

/// Small images and maps, as there are many lights.
const IMAGE: [u32; 2] = [160, 100];
const MAP_SIZE: u32 = 256;

/// Where a path crosses a surface.
#[derive(Clone, Copy, Debug)]
struct Crossing {
    /// A point of the surface, up to f64 rounding.
    point: DVec3,
    /// Towards the side that the light comes from.
    normal: DVec3,
}

impl Crossing {
    /// At the point of a triangle's plane nearest to a given point.
    fn of(mesh: &Mesh, triangle: usize, close_by: DVec3) -> Self {
        let normal = mesh.face_normal(triangle);
        let corner = mesh.corners(triangle)[0];
        Self { point: close_by - normal.dot(close_by - corner) * normal, normal }
    }

    /// Point lights in front of the surface, on it and behind it: off by 1e-2, 1e-4, four steps and one step of
    /// f32, and one step of f64, relative to the largest coordinate.
    fn lamps(&self, number: usize) -> Vec<NamedLight> {
        let (in_f32, in_f64) = (f64::from(f32::EPSILON), f64::EPSILON);
        let parts = [1e-2, 1e-4, 4.0 * in_f32, in_f32, in_f64];
        let behind = parts.iter().rev().map(|part| -part);
        let lamp = |part: f64| {
            let distance = part * self.point.abs().max_element();
            let position = self.point + distance * self.normal;
            (format!("surface {number}, {part:+.1e}"), LightSpec::Point { position, range: f64::INFINITY })
        };
        parts.iter().copied().chain([0.0]).chain(behind).map(lamp).collect()
    }
}

/// Every surface crossing on the polyline through the points.
fn on_the_ways(mesh: &Mesh, ways: &[[DVec3; 2]]) -> Result<Vec<Crossing>> {
    let tracer = Tracer::new(mesh)?;
    let mut all = Vec::new();
    for [from, to] in ways {
        let direction = (to - from).normalize();
        let mut ray = Ray { origin: *from, direction, length: from.distance(*to) };
        while let Some(hit) = tracer.first_hit(&ray) {
            let crossing = Crossing::of(mesh, hit.triangle, hit.point);
            let is_from_behind = crossing.normal.dot(direction) > 0.0;
            all.push(Crossing {
                normal: if is_from_behind { -crossing.normal } else { crossing.normal },
                ..crossing
            });
            let past = hit.distance + tracer.surface_offset();
            ray = Ray { origin: ray.origin + past * direction, length: ray.length - past, ..ray };
        }
    }
    Ok(all)
}

/// A crossing at the middle of the largest triangle of every object.
fn of_every_object(mesh: &Mesh) -> Vec<Crossing> {
    let area = |triangle: usize| {
        let [a, b, c] = mesh.corners(triangle);
        (b - a).cross(c - a).length()
    };
    let largest = mesh.objects.iter().filter_map(|object| {
        let triangles = object.triangles.start as usize..object.triangles.end as usize;
        triangles.max_by(|&one, &other| area(one).total_cmp(&area(other)))
    });
    largest
        .map(|triangle| {
            let [a, b, c] = mesh.corners(triangle);
            Crossing::of(mesh, triangle, (a + b + c) / 3.0)
        })
        .collect()
}

fn shot(scene: LoadedScene, crossings: &[Crossing]) -> Result<Shot> {
    ensure!(!crossings.is_empty(), "the lamp meets nothing in '{}'", scene.name);
    let lamps = (1..).zip(crossings).flat_map(|(number, crossing)| crossing.lamps(number)).collect();
    let name = scene.name.clone();
    let shot = Stand::before(scene)?.shot(&name, |_| lamps)?;
    let techniques = [Technique::Uniform, Technique::Psm, Technique::Best, Technique::Cube, Technique::Paraboloid];
    let options = techniques.map(|technique| Options::new(technique, MAP_SIZE)).to_vec();
    Ok(Shot { image: IMAGE, ..shot.with_options(options) })
}

/// Point lights on paths through a room, and through a piece of a chess board.
pub(super) fn through_surfaces() -> Result<Vec<Shot>> {
    // Out of the ceiling and through both sides of the lampshade; out of the vase into the table; into a wall;
    // through the rug into the floor.
    let room = [
        [DVec3::new(1.05, 3.0, -1.95), DVec3::new(1.05, 2.2, -1.95)],
        [DVec3::new(-0.2, 0.9, -3.2), DVec3::new(-0.36, 0.74, -3.24)],
        [DVec3::new(-2.9, 1.5, -4.5), DVec3::new(-3.1, 1.5, -4.5)],
        [DVec3::new(-0.79, 0.05, -3.15), DVec3::new(-0.81, -0.01, -3.13)],
    ];
    // Through a piece, and into the board.
    let board = [
        [DVec3::new(0.4, 0.55, -3.0), DVec3::new(0.48, 0.51, -5.3)],
        [DVec3::new(0.5333, 0.1, -6.1), DVec3::new(0.5333, -0.01, -6.1)],
    ];
    [("room", &room[..]), ("chess-board", &board[..])]
        .into_iter()
        .map(|(name, ways)| {
            let scene = scene::load(Path::new(name))?;
            let crossings = on_the_ways(&scene.mesh, ways)?;
            shot(scene, &crossings)
        })
        .collect()
}

/// Point lights through every object of a scene.
///
/// # Errors
///
/// When the scene cannot be used or has no camera.
pub(super) fn through_all_of(path: &Path) -> Result<Vec<Shot>> {
    let scene = scene::load(path)?;
    let crossings = of_every_object(&scene.mesh);
    Ok(vec![shot(scene, &crossings)?])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lamps_stand_on_both_sides_of_a_surface_and_on_it() {
        let shots = through_surfaces().expect("built in");
        for (shot, surfaces) in shots.iter().zip([8, 3]) {
            let tracer = Tracer::new(&shot.scene.mesh).expect("it has triangles");
            assert_eq!(shot.lights.len(), 11 * surfaces, "{}", shot.name);
            for lamps in shot.lights.chunks(11) {
                let position = |i: usize| lamps[i].1.position().expect("a lamp");
                // Another surface may lie between the farthest two: a lampshade has two sides.
                let way = position(9) - position(1);
                let ray = Ray { origin: position(1), direction: way.normalize(), length: way.length() };
                let hit = tracer.first_hit(&ray).expect("a surface");
                // The middle one is on it, up to rounding.
                let on = position(5);
                let rounding = 4.0 * f64::EPSILON * on.abs().max_element();
                assert!(hit.face_normal.dot(hit.point - on).abs() <= 2.0 * rounding, "{}: {hit:?}", lamps[5].0);
                let from = |i: usize| (position(i) - on).dot(ray.direction);
                assert!((0..10).all(|i| from(i) <= from(i + 1)), "{}", lamps[0].0);
                assert!(from(3) < 0.0 && 0.0 < from(7), "a step of f32 is one");
            }
        }
    }
}
