//! Casters tessellated for paraboloid maps, which bend straight edges, while the rasteriser draws them straight.

use std::time::{Duration, Instant};

use anyhow::{Context, Result};
use clap::ValueEnum;
use shadowfit::glam::{DVec3, Vec3};
use shadowfit::{mesh::Tessellator, omni::Paraboloid};

use crate::gpu::{Geometry, Gpu};
use crate::maps::BENT;
use crate::scene::Mesh;

/// Segments per edge of a triangle tessellated by [`Cutting::Grid`].
const PARTS: u32 = 8;

/// The smallest diagonal of objects tessellated by [`Cutting::Grid`], relative to the scene's diagonal.
const LARGE: f64 = 0.125;

/// The largest number of triangles after tessellation.
const MOST: u32 = 1 << 22;

/// How casters are tessellated for paraboloid maps. The camera pass draws the original triangles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, ValueEnum, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Cutting {
    /// Not tessellated
    None,
    /// Each triangle of large objects in 8 x 8, as Brabec, Annen and Seidel do with the walls of their room
    Grid,
    /// Until every edge is drawn within half a texel of its true curve
    #[default]
    Bound,
}

/// Tessellated casters.
#[derive(Debug)]
pub struct Cut {
    /// All objects in their order; those that are not drawn have no triangles.
    pub mesh: Mesh,
    /// The same on the GPU.
    pub geometry: Geometry,
    /// The time of tessellation.
    pub time: Duration,
}

impl Cut {
    /// Tessellates the objects that are drawn into a paraboloid or its opposite, and uploads them relative to an
    /// origin; `None` for [`Cutting::None`].
    ///
    /// # Errors
    ///
    /// When there would be too many triangles for memory or for the GPU.
    pub fn new(
        gpu: &Gpu,
        origin: DVec3,
        mesh: &Mesh,
        is_drawn: &[bool],
        map: &Paraboloid,
        how: Cutting,
    ) -> Result<Option<Self>> {
        let start = Instant::now();
        let kept = kept(mesh, is_drawn);
        let pieces = match how {
            Cutting::None => return Ok(None),
            Cutting::Grid => on_a_grid(mesh, &kept),
            Cutting::Bound => finely(mesh, &kept, map)?,
        };
        let mesh = pieces.mesh(mesh, &kept);
        let time = start.elapsed();
        let geometry = Geometry::upload(gpu, &mesh, origin)?;
        Ok(Some(Self { mesh, geometry, time }))
    }
}

/// The triangles of the objects that are drawn.
fn kept(mesh: &Mesh, is_drawn: &[bool]) -> Vec<u32> {
    let drawn = mesh.objects.iter().zip(is_drawn).filter(|(_, is_drawn)| **is_drawn);
    drawn.flat_map(|(object, _)| object.triangles.clone()).collect()
}

/// Triangles in the order of their source triangles.
struct Pieces {
    vertices: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    /// For each triangle the index of its source in the list of kept triangles.
    sources: Vec<u32>,
}

impl Pieces {
    /// A mesh of these triangles with the objects of the original.
    fn mesh(self, whole: &Mesh, kept: &[u32]) -> Mesh {
        let source = |piece: usize| kept[self.sources[piece] as usize];
        let objects = whole.objects.iter().map(|object| {
            let before =
                |triangle: u32| self.sources.partition_point(|&source| kept[source as usize] < triangle) as u32;
            let triangles = before(object.triangles.start)..before(object.triangles.end);
            crate::scene::Object { triangles, ..object.clone() }
        });
        Mesh {
            objects: objects.collect(),
            normals: vec![Vec3::ZERO; self.vertices.len()],
            colours: (0..self.triangles.len()).map(|piece| whole.colours[source(piece) as usize]).collect(),
            vertices: self.vertices,
            triangles: self.triangles,
            discs: Vec::new(),
        }
    }
}

fn finely(mesh: &Mesh, kept: &[u32], map: &Paraboloid) -> Result<Pieces> {
    let refiner = Tessellator::new(map.position(), map.light().near(), map.largest_edge(BENT));
    let refiner = refiner.context("casters cannot be cut for so small a map")?.with_limit(MOST);
    let triangles: Vec<[u32; 3]> = kept.iter().map(|&triangle| mesh.triangles[triangle as usize]).collect();
    let refined = refiner.tessellate(&mesh.vertices, &triangles).context("the casters cannot be cut")?;
    let added = refined.added.iter().map(|added| added.position);
    let vertices = mesh.vertices.iter().copied().chain(added).collect();
    Ok(Pieces { vertices, triangles: refined.triangles, sources: refined.sources })
}

fn on_a_grid(mesh: &Mesh, kept: &[u32]) -> Pieces {
    let (min, max) = mesh.bounds();
    let large = LARGE * (max - min).length();
    let mut pieces = Pieces { vertices: mesh.vertices.clone(), triangles: Vec::new(), sources: Vec::new() };
    for (source, &triangle) in (0..).zip(kept) {
        let is_large =
            mesh.object_of(triangle as usize).is_some_and(|object| (object.max - object.min).length() > large);
        if is_large {
            let first = pieces.vertices.len() as u32;
            let [a, b, c] = mesh.corners(triangle as usize);
            // With integer weights both triangles at an edge compute the same vertices.
            pieces.vertices.extend(rows().map(|(i, j)| {
                (a * f64::from(PARTS - i - j) + (b * f64::from(i) + c * f64::from(j))) / f64::from(PARTS)
            }));
            let index = |i: u32, j: u32| first + j * (PARTS + 1) - j * j.saturating_sub(1) / 2 + i;
            for (i, j) in rows().filter(|(i, j)| i + j < PARTS) {
                pieces.triangles.push([index(i, j), index(i + 1, j), index(i, j + 1)]);
                if i + j + 1 < PARTS {
                    pieces.triangles.push([index(i + 1, j), index(i + 1, j + 1), index(i, j + 1)]);
                }
            }
        } else {
            pieces.triangles.push(mesh.triangles[triangle as usize]);
        }
        pieces.sources.resize(pieces.triangles.len(), source);
    }
    pieces
}

/// The vertices of a triangle's grid, row by row, as steps towards its second and third corner.
fn rows() -> impl Iterator<Item = (u32, u32)> {
    (0..=PARTS).flat_map(|j| (0..=PARTS - j).map(move |i| (i, j)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene;

    #[test]
    fn pieces_of_a_grid_make_up_the_triangles() {
        let mesh = scene::load("room".as_ref()).expect("built in").mesh;
        let is_drawn: Vec<bool> = (0..mesh.objects.len()).map(|object| object % 3 != 1).collect();
        let kept = kept(&mesh, &is_drawn);
        let cut = on_a_grid(&mesh, &kept).mesh(&mesh, &kept);
        let area = |mesh: &Mesh, triangles: std::ops::Range<u32>| -> DVec3 {
            triangles
                .map(|triangle| {
                    let [a, b, c] = mesh.corners(triangle as usize);
                    (b - a).cross(c - a)
                })
                .map(|area| area * area.length())
                .sum()
        };
        let mut large = 0;
        for ((one, whole), is_drawn) in cut.objects.iter().zip(&mesh.objects).zip(is_drawn) {
            let times = one.triangles.len() / whole.triangles.len();
            assert_eq!(one.triangles.len(), times * whole.triangles.len());
            assert!(if is_drawn { times == 1 || times == 64 } else { times == 0 }, "{times}");
            large += usize::from(times == 64);
            // Each piece has 1/64 of the area. Areas are squared so that a missing triangle cannot be offset by a
            // duplicate.
            let [before, after] = [area(&mesh, whole.triangles.clone()), area(&cut, one.triangles.clone())];
            if times > 0 {
                assert!(
                    (before - after * times as f64).length() <= 1e-9 * (1.0 + before.length()),
                    "{before} {after}"
                );
            }
        }
        assert!(large > 3 && cut.triangles.len() == cut.colours.len());
    }
}
