//! Ray casting with parry3d's bounding-volume tree in f64.

use anyhow::{Context, Result};
use parry3d_f64::math::Vector;
use parry3d_f64::query::{PointQuery as _, Ray as ParryRay, RayCast, RayCullingMode};
use parry3d_f64::shape::TriMesh;
use shadowfit::glam::DVec3;
use shadowfit::mesh::Solidity;

use super::faces::Faces;
use super::ray::{Hit, Ray};
use crate::scene::Mesh;

/// Parry's triangles leave cracks between them, which only rays exactly through an edge can slip through; in a
/// scene laid out on a grid, a ray from a pixel centre to the light may be one. So the origins of shadow rays are
/// also shifted sideways, in a direction that no scene is aligned with, by less than they are lifted off the
/// surface.
const ASIDE: DVec3 = DVec3::new(0.137, -0.071, 0.113);

/// A mesh with its bounding-volume tree.
pub struct Tracer<'a> {
    mesh: &'a Mesh,
    tree: TriMesh,
    /// The mesh's bounds, cached.
    bounds: (DVec3, DVec3),
    /// The offset of shadow ray origins from their surface: far more than the rounding of a surface point, about
    /// 1e-16 of its largest coordinate, and far less than anything visible in an image of the scene.
    surface_offset: f64,
}

impl<'a> Tracer<'a> {
    /// Builds the tree.
    ///
    /// # Errors
    ///
    /// When the mesh has no triangles.
    pub fn new(mesh: &'a Mesh) -> Result<Self> {
        let vertices = mesh.vertices.iter().map(|&v| to_parry(v)).collect();
        let tree = TriMesh::new(vertices, mesh.triangles.clone()).context("the scene cannot be ray-cast")?;
        let (min, max) = mesh.bounds();
        let largest = min.abs().max(max.abs()).max_element();
        Ok(Self { mesh, tree, bounds: (min, max), surface_offset: 1e-9 * (max - min).length() + 1e-12 * largest })
    }

    /// The mesh.
    #[must_use]
    pub fn mesh(&self) -> &'a Mesh {
        self.mesh
    }

    /// The least and greatest coordinates of all triangles.
    #[must_use]
    pub fn bounds(&self) -> (DVec3, DVec3) {
        self.bounds
    }

    /// The distance of a point to the nearest triangle, in world units.
    #[must_use]
    pub fn distance_to(&self, point: DVec3) -> f64 {
        self.tree.distance_to_local_point(to_parry(point), false)
    }

    /// The first hit along the ray, of front or back faces.
    #[must_use]
    pub fn first_hit(&self, ray: &Ray) -> Option<Hit> {
        self.first_hit_of(ray, Faces::All)
    }

    /// The first hit along the ray of these faces. For second depth only back faces are searched: `None` may be
    /// returned where an object that is not drawn by its back faces comes first.
    #[must_use]
    pub fn first_hit_of(&self, ray: &Ray, faces: Faces) -> Option<Hit> {
        let culled = |mode| self.tree.cast_local_ray_with_culling(&ray_to_parry(ray), ray.length, mode);
        let found = match faces {
            Faces::All | Faces::Layers => {
                self.tree.cast_local_ray_and_get_normal(&ray_to_parry(ray), ray.length, false)
            }
            Faces::Front => culled(RayCullingMode::IgnoreBackfaces),
            // Back faces, which are drawn of all but inverted objects.
            Faces::Back | Faces::Second => culled(RayCullingMode::IgnoreFrontfaces),
        }?;
        let hit = Hit::along(ray, found.time_of_impact, self.mesh, found.subshape as usize);
        let is_drawn = |triangle| {
            let object = self.mesh.object_of(triangle);
            faces != Faces::Second || object.is_none_or(|object| object.solidity != Solidity::Inverted)
        };
        is_drawn(hit.triangle).then_some(hit)
    }

    /// Whether the ray hits any triangle, front or back.
    #[must_use]
    pub fn is_blocked(&self, ray: &Ray) -> bool {
        self.tree.cast_local_ray(&ray_to_parry(ray), ray.length, false).is_some()
    }

    /// The offset of shadow ray origins from their surface, smaller than anything visible.
    #[must_use]
    pub fn surface_offset(&self) -> f64 {
        self.surface_offset
    }

    /// The origin of a shadow ray from `point`: offset along the face's unit normal on the lit side, so that the
    /// ray hits neither its own triangle nor a coplanar one.
    #[must_use]
    pub fn off_surface(&self, point: DVec3, normal: DVec3) -> DVec3 {
        point + self.surface_offset * (normal + ASIDE)
    }

    /// Whether anything blocks the light, `distance` away in `direction_to_light`, at a surface point hit by
    /// `viewed_from`. The shadow ray starts off the surface, on the visible side.
    #[must_use]
    pub fn is_shadowed(&self, hit: &Hit, viewed_from: &Ray, direction_to_light: DVec3, distance: f64) -> bool {
        let side = if hit.is_back_face(viewed_from) { -1.0 } else { 1.0 };
        let origin = self.off_surface(hit.point, side * hit.face_normal);
        self.is_blocked(&Ray { origin, direction: direction_to_light, length: distance })
    }
}

fn ray_to_parry(ray: &Ray) -> ParryRay {
    ParryRay::new(to_parry(ray.origin), to_parry(ray.direction))
}

/// parry3d uses its own version of `glam`, so vectors are converted by component.
fn to_parry(v: DVec3) -> Vector {
    Vector::new(v.x, v.y, v.z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{MeshBuilder, Part};
    use shadowfit::glam::DMat4;

    /// Two squares across the z axis: the upper one, at z = 0, with its front up, the lower one, at −1, with its back.
    fn two_squares() -> Mesh {
        let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| DVec3::new(x, y, 0.0));
        let part = Part { positions: &corners, normals: &[], triangles: &[[0, 1, 2], [0, 2, 3]], colour: [1.0; 3] };
        let mut builder = MeshBuilder::default();
        builder.add(&part, DMat4::IDENTITY);
        builder.add(&part, DMat4::from_translation(DVec3::NEG_Z) * DMat4::from_rotation_x(std::f64::consts::PI));
        builder.finish().0
    }

    #[test]
    fn no_light_falls_through_cracks() {
        // A grid of squares, turned so that no coordinate is a round number, and points on the ground exactly below its
        // edges and diagonals.
        let corners: Vec<DVec3> =
            (0..81).map(|i| DVec3::new(f64::from(i % 9) - 4.0, f64::from(i / 9) - 4.0, 2.0)).collect();
        let squares = (0..8).flat_map(|y| (0..8).map(move |x| 9 * y + x));
        let triangles: Vec<[u32; 3]> = squares.flat_map(|i| [[i, i + 1, i + 10], [i, i + 10, i + 9]]).collect();
        let part = Part { positions: &corners, normals: &[], triangles: &triangles, colour: [1.0; 3] };
        let (mut leaks, mut leaks_from_exact_points) = (0, 0);
        for turn in [0.02, 0.3, 0.77, 1.4] {
            let mut builder = MeshBuilder::default();
            builder.add(&part, DMat4::from_rotation_z(turn));
            let (mesh, _) = builder.finish();
            let tracer = Tracer::new(&mesh).expect("it has triangles");
            for step in -390..=390 {
                let along = 0.01 * f64::from(step) + 0.003;
                for point in
                    [DVec3::new(along, along, 0.0), DVec3::new(along, 1.0, 0.0), DVec3::new(-2.0, along, 0.0)]
                {
                    let point = DMat4::from_rotation_z(turn).transform_point3(point);
                    let up = |origin| Ray { origin, direction: DVec3::Z, length: f64::INFINITY };
                    leaks += u32::from(!tracer.is_blocked(&up(tracer.off_surface(point, DVec3::Z))));
                    leaks_from_exact_points += u32::from(!tracer.is_blocked(&up(point)));
                }
            }
        }
        assert!(leaks == 0 && leaks_from_exact_points > 0, "{leaks}, {leaks_from_exact_points}");
    }

    #[test]
    fn a_ray_meets_only_the_sides_it_is_asked_for() {
        let mesh = two_squares();
        let tracer = Tracer::new(&mesh).expect("it has triangles");
        let down = Ray { origin: DVec3::new(0.3, 0.1, 2.0), direction: DVec3::NEG_Z, length: f64::INFINITY };
        let distance = |faces| tracer.first_hit_of(&down, faces).map(|hit| hit.distance);
        assert_eq!([Faces::All, Faces::Front, Faces::Back].map(distance), [Some(2.0), Some(2.0), Some(3.0)]);
        let short = Ray { length: 2.5, ..down };
        assert!(tracer.first_hit_of(&short, Faces::Back).is_none() && tracer.is_blocked(&short));
        assert!(!tracer.is_blocked(&Ray { length: 1.5, ..down }));
    }
}
