//! Rays against the triangles of a scene, through parry3d's bounding-volume tree in f64.

use anyhow::{Context, Result};
use parry3d_f64::math::Vector;
use parry3d_f64::query::{Ray as ParryRay, RayCast};
use parry3d_f64::shape::TriMesh;
use shadowfit::glam::DVec3;

use crate::scene::Mesh;

/// Half a line, or a piece of one.
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    /// Where it starts, in world space.
    pub origin: DVec3,
    /// Where it goes, of length one.
    pub direction: DVec3,
    /// How far it goes, in world units; may be infinite.
    pub length: f64,
}

/// Where a ray first meets the scene.
#[derive(Clone, Copy, Debug)]
pub struct Hit {
    /// How far along the ray, in world units.
    pub distance: f64,
    /// Where, in world space.
    pub point: DVec3,
    /// Which triangle of the mesh.
    pub triangle: usize,
    /// The triangle's unit normal, on the side of its counter-clockwise winding.
    pub face_normal: DVec3,
    /// The surface's unit normal, smooth where the mesh says so, on the side the ray comes from.
    pub shading_normal: DVec3,
}

impl Hit {
    /// Whether the ray met the triangle from behind.
    #[must_use]
    pub fn is_back_face(&self, ray: &Ray) -> bool {
        self.face_normal.dot(ray.direction) > 0.0
    }
}

/// A mesh that rays can be cast at.
pub struct Tracer<'a> {
    mesh: &'a Mesh,
    tree: TriMesh,
    /// How far a ray that leaves a surface starts off it. A hit point is off by the rounding of coordinates as large
    /// as the scene, 1e-16 of it; this is far more than that and far less than anything a picture shows.
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
        let reach = min.abs().max(max.abs()).max_element();
        Ok(Self { mesh, tree, surface_offset: 1e-9 * reach })
    }

    /// The triangles that the rays are cast at.
    #[must_use]
    pub fn mesh(&self) -> &'a Mesh {
        self.mesh
    }

    /// The first triangle along the ray, from either side.
    #[must_use]
    pub fn first_hit(&self, ray: &Ray) -> Option<Hit> {
        let parry_ray = ParryRay::new(to_parry(ray.origin), to_parry(ray.direction));
        let found = self.tree.cast_local_ray_and_get_normal(&parry_ray, ray.length, false)?;
        let triangle = found.subshape as usize;
        let point = ray.origin + found.time_of_impact * ray.direction;
        let face_normal = self.mesh.face_normal(triangle);
        let shading_normal = self.mesh.shading_normal(triangle, point).unwrap_or(face_normal);
        let facing = if face_normal.dot(ray.direction) > 0.0 { -1.0 } else { 1.0 };
        Some(Hit {
            distance: found.time_of_impact,
            point,
            triangle,
            face_normal,
            shading_normal: facing * shading_normal,
        })
    }

    /// Whether anything stands between a surface point that `viewed_from` has seen and a light, `distance` away in
    /// `direction_to_light`. The ray starts a little off the surface, on the side that was seen.
    #[must_use]
    pub fn is_shadowed(&self, hit: &Hit, viewed_from: &Ray, direction_to_light: DVec3, distance: f64) -> bool {
        let side = if hit.is_back_face(viewed_from) { -1.0 } else { 1.0 };
        let origin = hit.point + side * self.surface_offset * hit.face_normal;
        let ray = ParryRay::new(to_parry(origin), to_parry(direction_to_light));
        self.tree.cast_local_ray(&ray, distance, false).is_some()
    }
}

/// parry3d has a `glam` of its own, so vectors cross over as numbers.
fn to_parry(v: DVec3) -> Vector {
    Vector::new(v.x, v.y, v.z)
}
