//! Rays, and where they meet the scene.

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
    /// The ray meets a triangle of the mesh, so far along.
    #[must_use]
    pub fn along(ray: &Ray, distance: f64, mesh: &Mesh, triangle: usize) -> Self {
        let point = ray.origin + distance * ray.direction;
        let face_normal = mesh.face_normal(triangle);
        let shading_normal = mesh.shading_normal(triangle, point).unwrap_or(face_normal);
        let facing = if face_normal.dot(ray.direction) > 0.0 { -1.0 } else { 1.0 };
        Self { distance, point, triangle, face_normal, shading_normal: facing * shading_normal }
    }

    /// Whether the ray met the triangle from behind.
    #[must_use]
    pub fn is_back_face(&self, ray: &Ray) -> bool {
        self.face_normal.dot(ray.direction) > 0.0
    }
}
