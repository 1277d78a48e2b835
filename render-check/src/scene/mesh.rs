//! Triangles in world space.

use std::collections::HashSet;
use std::ops::Range;

use shadowfit::glam::{DMat3, DMat4, DVec3, Vec3};
use shadowfit::{input::MAX_COORDINATE, mesh::Solidity, plan::Surface};

use super::cloud::{self, Disc};
use super::left_out::LeftOut;

/// All triangles of a scene, in world space, indexed, with a colour each.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    /// Positions.
    pub vertices: Vec<DVec3>,
    /// Unit normals, one for each vertex; zero for flat shading.
    pub normals: Vec<Vec3>,
    /// Three indices into `vertices`, counter-clockwise seen from the front.
    pub triangles: Vec<[u32; 3]>,
    /// The linear RGB base colour of each triangle.
    pub colours: Vec<[f32; 3]>,
    /// The discs that stand for points. Each is drawn as a hexagon: the last triangles of the mesh, four for each.
    pub discs: Vec<Disc>,
    /// The parts of the mesh, in the order of their triangles: the units of culling and drawing.
    pub objects: Vec<Object>,
}

/// A part of a mesh: the unit of culling and drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct Object {
    /// Its triangles, never none.
    pub triangles: Range<u32>,
    /// The least coordinates of its triangles, in world space.
    pub min: DVec3,
    /// The greatest.
    pub max: DVec3,
    /// Whether it is watertight.
    pub solidity: Solidity,
    /// The same for the planner, which also tells flat open meshes from others.
    pub surface: Surface,
}

impl Mesh {
    /// The corners of a triangle.
    #[must_use]
    pub fn corners(&self, triangle: usize) -> [DVec3; 3] {
        self.triangles[triangle].map(|i| self.vertices[i as usize])
    }

    /// The first triangle of the first disc.
    #[must_use]
    pub fn first_disc_triangle(&self) -> usize {
        self.triangles.len() - Disc::TRIANGLES.len() * self.discs.len()
    }

    /// The unit normal on the triangle's front.
    #[must_use]
    pub fn face_normal(&self, triangle: usize) -> DVec3 {
        let [a, b, c] = self.corners(triangle);
        (b - a).cross(c - a).normalize_or(DVec3::Y)
    }

    /// The smooth unit normal at a point of the triangle, on the triangle's front; `None` where it has none.
    #[must_use]
    pub fn shading_normal(&self, triangle: usize, point: DVec3) -> Option<DVec3> {
        let [na, nb, nc] = self.triangles[triangle].map(|i| self.normals[i as usize].as_dvec3());
        let [a, b, c] = self.corners(triangle);
        let cross = (b - a).cross(c - a);
        // Barycentric coordinates as ratios of signed areas.
        let weight_b = (point - a).cross(c - a).dot(cross) / cross.length_squared();
        let weight_c = (b - a).cross(point - a).dot(cross) / cross.length_squared();
        let normal = (na * (1.0 - weight_b - weight_c) + nb * weight_b + nc * weight_c).try_normalize()?;
        // Files have normals that contradict the winding; the winding wins.
        Some(if normal.dot(cross) < 0.0 { -normal } else { normal })
    }

    /// The least and greatest coordinates of all triangles. An inverted box where there are none.
    #[must_use]
    pub fn bounds(&self) -> (DVec3, DVec3) {
        self.bounds_of(0..self.triangles.len())
    }

    /// The object that a triangle belongs to.
    #[must_use]
    pub fn object_of(&self, triangle: usize) -> Option<&Object> {
        let after = self.objects.partition_point(|object| object.triangles.start as usize <= triangle);
        self.objects[..after].last().filter(|object| triangle < object.triangles.end as usize)
    }

    fn bounds_of(&self, triangles: Range<usize>) -> (DVec3, DVec3) {
        let used = self.triangles[triangles].iter().flatten().map(|&i| self.vertices[i as usize]);
        used.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(min, max), v| (min.min(v), max.max(v)))
    }
}

/// A part of a mesh in local coordinates.
#[derive(Clone, Copy, Debug)]
pub struct Part<'a> {
    /// Positions.
    pub positions: &'a [DVec3],
    /// Normals, one for each position, or none at all for flat shading.
    pub normals: &'a [Vec3],
    /// Indices into `positions`, three for each triangle.
    pub triangles: &'a [[u32; 3]],
    /// Linear RGB.
    pub colour: [f32; 3],
}

/// Collects parts into one mesh; leaves out and counts triangles that are degenerate, invalid or too large for a
/// fit.
#[derive(Debug, Default)]
pub struct MeshBuilder {
    mesh: Mesh,
    /// The discs of points, with their colours: their triangles come last.
    clouds: Vec<(Vec<Disc>, [f32; 3])>,
    /// What was left out so far.
    pub left_out: LeftOut,
}

impl MeshBuilder {
    /// Adds a part; its unusable triangles are left out.
    pub fn add(&mut self, part: &Part<'_>, world_from_part: DMat4) {
        let triangles = self.usable(part);
        self.append(&Part { triangles: &triangles, ..*part }, world_from_part);
    }

    /// The triangles of a part with valid indices, without duplicates. A duplicate would give its edges too many
    /// faces, so that [`Solidity::of`] would call a watertight part open.
    fn usable(&mut self, part: &Part<'_>) -> Vec<[u32; 3]> {
        let mut seen = HashSet::new();
        let mut usable = part.triangles.to_vec();
        usable.retain(|triangle| triangle.iter().all(|&i| (i as usize) < part.positions.len()));
        self.left_out.out_of_range += part.triangles.len() - usable.len();
        let in_range = usable.len();
        usable.retain(|triangle| {
            // −0 becomes 0; the least corner comes first, so that the starting corner does not matter.
            let mut corners = triangle.map(|i| part.positions[i as usize].to_array().map(|x| (x + 0.0).to_bits()));
            let least = (0..3).min_by_key(|&corner| corners[corner]).unwrap_or(0);
            corners.rotate_left(least);
            seen.insert(corners)
        });
        self.left_out.twice += in_range - usable.len();
        usable
    }

    /// Adds the triangles of a part that have finite corners and an area.
    fn append(&mut self, part: &Part<'_>, world_from_part: DMat4) {
        let first = self.mesh.vertices.len() as u32;
        let first_triangle = self.mesh.triangles.len();
        self.mesh.vertices.extend(part.positions.iter().map(|&p| world_from_part.transform_point3(p)));

        // Normals transform by the cofactor matrix: the inverse transpose up to a factor, defined for singular
        // transforms too.
        let linear = DMat3::from_mat4(world_from_part);
        let mirrored = linear.determinant() < 0.0;
        let cofactors = DMat3::from_cols(
            linear.y_axis.cross(linear.z_axis),
            linear.z_axis.cross(linear.x_axis),
            linear.x_axis.cross(linear.y_axis),
        );
        let facing = if mirrored { -1.0 } else { 1.0 };
        self.mesh.normals.extend(
            part.normals.iter().map(|&n| (facing * (cofactors * n.as_dvec3())).normalize_or_zero().as_vec3()),
        );
        self.mesh.normals.resize(self.mesh.vertices.len(), Vec3::ZERO);

        // Degenerate triangles serve only to close cracks.
        let mut with_cracks_closed = Vec::new();
        for triangle in part.triangles {
            let mut corners = triangle.map(|i| first + i);
            // A mirroring transform flips the winding; it is flipped back so that front faces stay front faces.
            if mirrored {
                corners.swap(1, 2);
            }
            let [a, b, c] = corners.map(|i| self.mesh.vertices[i as usize]);
            if !(a.is_finite() && b.is_finite() && c.is_finite()) {
                self.left_out.not_finite += 1;
                continue;
            }
            if [a, b, c].iter().any(|corner| is_too_large(*corner)) {
                self.left_out.too_large += 1;
                continue;
            }
            with_cracks_closed.push(corners);
            if is_flat(a, b, c) {
                self.left_out.flat += 1;
            } else {
                self.mesh.triangles.push(corners);
                self.mesh.colours.push(part.colour);
            }
        }
        if first_triangle < self.mesh.triangles.len() {
            let (min, max) = self.mesh.bounds_of(first_triangle..self.mesh.triangles.len());
            let triangles = first_triangle as u32..self.mesh.triangles.len() as u32;
            // Degenerate triangles may hang from a watertight mesh, so solidity is decided without them.
            let drawn = &self.mesh.triangles[first_triangle..];
            let report = Solidity::of(&self.mesh.vertices, &with_cracks_closed);
            let report = match report {
                Ok(report) if report.solidity == Solidity::Open && drawn.len() < with_cracks_closed.len() => {
                    Solidity::of(&self.mesh.vertices, drawn)
                }
                report => report,
            };
            // If undecided, both faces are drawn, as for open meshes.
            let (solidity, surface) = report
                .map_or((Solidity::Open, Surface::default()), |report| (report.solidity, Surface::from(&report)));
            self.mesh.objects.push(Object { triangles, min, max, solidity, surface });
        }
    }

    /// Adds a point cloud; its points become discs.
    pub fn add_points(&mut self, points: &[DVec3], colour: [f32; 3], world_from_part: DMat4) {
        let points = points.iter().map(|&point| world_from_part.transform_point3(point));
        let (finite, other): (Vec<DVec3>, Vec<DVec3>) =
            points.partition(|point| point.is_finite() && !is_too_large(*point));
        let mut discs = cloud::discs(&finite);
        discs.retain(|disc| {
            let corners = disc.hexagon();
            !Disc::TRIANGLES
                .iter()
                .any(|&[a, b, c]| is_flat(corners[a as usize], corners[b as usize], corners[c as usize]))
        });
        self.left_out.points += other.len() + finite.len() - discs.len();
        self.clouds.push((discs, colour));
    }

    /// The mesh and what was left out of it.
    #[must_use]
    pub fn finish(mut self) -> (Mesh, LeftOut) {
        for (mut discs, colour) in std::mem::take(&mut self.clouds) {
            cloud::grouped(&mut discs, DISCS_AN_OBJECT, &mut |group| self.add_discs(group, colour));
        }
        (self.mesh, self.left_out)
    }

    /// Adds an object of discs.
    fn add_discs(&mut self, discs: &[Disc], colour: [f32; 3]) {
        let positions: Vec<DVec3> = discs.iter().flat_map(Disc::hexagon).collect();
        let of_disc = |first: u32| Disc::TRIANGLES.map(|triangle| triangle.map(|corner| first + corner));
        let triangles: Vec<[u32; 3]> = (0..discs.len() as u32).flat_map(|disc| of_disc(6 * disc)).collect();
        // Coincident points have a disc, and triangles, each.
        self.append(&Part { positions: &positions, normals: &[], triangles: &triangles, colour }, DMat4::IDENTITY);
        if let Some(object) = self.mesh.objects.last_mut() {
            object.surface = Surface::Points;
        }
        self.mesh.discs.extend(discs);
    }
}

/// The largest number of discs in an object.
const DISCS_AN_OBJECT: usize = 1024;

/// Whether a coordinate is beyond [`MAX_COORDINATE`].
fn is_too_large(point: DVec3) -> bool {
    point.abs().max_element() > MAX_COORDINATE
}

/// Whether three points are collinear within the rounding of their coordinates: each edge is known to a few ulps of
/// the largest coordinate, so the doubled area is known to that times the longest edge.
fn is_flat(a: DVec3, b: DVec3, c: DVec3) -> bool {
    let longest = (b - a).length().max((c - b).length()).max((a - c).length());
    let largest = a.abs().max(b.abs()).max(c.abs()).max_element();
    (b - a).cross(c - a).length() <= 4.0 * f64::EPSILON * largest * longest
}

#[cfg(test)]
mod tests {
    use super::*;

    const SQUARE: [DVec3; 4] = [DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::Y];

    fn part<'a>(positions: &'a [DVec3], triangles: &'a [[u32; 3]]) -> Part<'a> {
        Part { positions, normals: &[], triangles, colour: [1.0; 3] }
    }

    #[test]
    fn triangles_that_no_ray_can_meet_are_counted_and_dropped() {
        let positions = [DVec3::ZERO, DVec3::X, 2.0 * DVec3::X, DVec3::Y, DVec3::new(f64::NAN, 0.0, 0.0)];
        let mut builder = MeshBuilder::default();
        builder.add(&part(&positions, &[[0, 1, 3], [0, 1, 2], [0, 0, 1], [0, 1, 4]]), DMat4::IDENTITY);
        let (mesh, left_out) = builder.finish();
        assert_eq!(mesh.triangles, [[0, 1, 3]]);
        assert_eq!((left_out.flat, left_out.not_finite), (2, 1));
        assert_eq!(mesh.bounds(), (DVec3::ZERO, DVec3::new(1.0, 1.0, 0.0)), "the dropped vertices do not count");
    }

    #[test]
    fn the_front_of_a_mirrored_part_stays_its_front() {
        let mut builder = MeshBuilder::default();
        let normals = [Vec3::Z; 4];
        let square = Part { normals: &normals, ..part(&SQUARE, &[[0, 1, 2], [0, 2, 3]]) };
        builder.add(&square, DMat4::from_scale(DVec3::new(-2.0, 1.0, 1.0)));
        let (mesh, _) = builder.finish();
        assert_eq!(mesh.face_normal(0), DVec3::Z);
        assert_eq!(mesh.shading_normal(0, DVec3::new(-0.5, 0.2, 0.0)), Some(DVec3::Z));
    }

    #[test]
    fn a_part_without_normals_looks_flat() {
        let mut builder = MeshBuilder::default();
        builder.add(&part(&SQUARE, &[[0, 1, 2]]), DMat4::IDENTITY);
        let (mesh, _) = builder.finish();
        assert_eq!(mesh.shading_normal(0, DVec3::ZERO), None);
    }
}
