//! Rays and hits.

use shadowfit::glam::DVec3;

use crate::scene::Mesh;

/// A ray of finite or infinite length.
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    /// Its origin, in world space.
    pub origin: DVec3,
    /// Its direction, of unit length.
    pub direction: DVec3,
    /// Its length, in world units; may be infinite.
    pub length: f64,
}

/// The first hit of a ray.
#[derive(Clone, Copy, Debug)]
pub struct Hit {
    /// The distance along the ray, in world units.
    pub distance: f64,
    /// The point, in world space.
    pub point: DVec3,
    /// The index of the triangle.
    pub triangle: usize,
    /// The triangle's unit normal, on the side of its counter-clockwise winding.
    pub face_normal: DVec3,
    /// The unit shading normal, interpolated where the mesh has normals, on the side that the ray comes from.
    pub shading_normal: DVec3,
}

impl Hit {
    /// The hit of a triangle at a distance along the ray.
    #[must_use]
    pub fn along(ray: &Ray, distance: f64, mesh: &Mesh, triangle: usize) -> Self {
        let point = ray.origin + distance * ray.direction;
        let face_normal = mesh.face_normal(triangle);
        let shading_normal = mesh.shading_normal(triangle, point).unwrap_or(face_normal);
        let facing = if face_normal.dot(ray.direction) > 0.0 { -1.0 } else { 1.0 };
        Self { distance, point, triangle, face_normal, shading_normal: facing * shading_normal }
    }

    /// Whether the ray hit the triangle's back face.
    #[must_use]
    pub fn is_back_face(&self, ray: &Ray) -> bool {
        self.face_normal.dot(ray.direction) > 0.0
    }
}
