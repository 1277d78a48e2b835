//! The surface point visible in a pixel.

use anyhow::Result;
use shadowfit::View;
use shadowfit::glam::{DMat4, DVec2, DVec3};

use crate::scene::Mesh;
use crate::trace::{Lens, Ray};

/// A visible surface point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface {
    /// Its position, in world space.
    pub point: DVec3,
    /// The triangle's unit normal, on the visible side.
    pub normal: DVec3,
    /// The index of its triangle.
    pub triangle: usize,
}

impl Surface {
    /// The point where the ray hits the triangle that a renderer drew there.
    ///
    /// Rasterisers snap vertices to a grid of 1/256 pixel, so the ray may just miss the triangle: then it is the
    /// nearest point on the triangle's edge.
    #[must_use]
    pub fn seen(mesh: &Mesh, triangle: usize, ray: &Ray) -> Self {
        let corners = mesh.corners(triangle);
        let [a, b, c] = corners.map(|corner| corner - ray.origin);
        // Barycentric coordinates up to a common factor: volumes spanned by the ray and an edge. All are negative
        // for back faces, and zero for triangles seen edge-on.
        let volumes =
            DVec3::new(ray.direction.dot(b.cross(c)), ray.direction.dot(c.cross(a)), ray.direction.dot(a.cross(b)));
        let facing = if volumes.element_sum() < 0.0 { -1.0 } else { 1.0 };
        let inside = (facing * volumes).max(DVec3::ZERO);
        let sum = inside.element_sum();
        let weights = if sum > 0.0 { inside / sum } else { DVec3::splat(1.0 / 3.0) };
        let point = corners[0] * weights.x + corners[1] * weights.y + corners[2] * weights.z;
        let front = mesh.face_normal(triangle);
        let normal = if front.dot(ray.origin - point) < 0.0 { -front } else { front };
        Self { point, normal, triangle }
    }
}

/// The camera's rays through exact pixel centres, where a rasteriser samples.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PixelRays {
    /// A lens relative to the eye, so that cameras far from the origin lose no precision.
    lens: Lens,
    eye: DVec3,
    size: DVec2,
}

impl PixelRays {
    /// The rays of an image of `width` × `height` pixels.
    ///
    /// # Errors
    ///
    /// When the view's matrix has no inverse.
    pub(crate) fn new(view: &View, [width, height]: [u32; 2]) -> Result<Self> {
        let clip_from_world = Lens::of_view(view)?.clip_from_world();
        let lens = Lens::new(clip_from_world * DMat4::from_translation(view.eye()))?;
        Ok(Self { lens, eye: view.eye(), size: DVec2::new(f64::from(width), f64::from(height)) })
    }

    /// The ray through a pixel, row 0 at the top, from the near plane to the far plane.
    pub(crate) fn through(&self, x: u32, y: u32) -> Option<Ray> {
        let place = 2.0 * (DVec2::new(f64::from(x), f64::from(y)) + 0.5) / self.size - 1.0;
        let ray = self.lens.ray(DVec2::new(place.x, -place.y))?;
        Some(Ray { origin: self.eye + ray.origin, ..ray })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{MeshBuilder, Part};

    /// A triangle in the plane z = 0 with its front towards +z.
    fn mesh() -> Mesh {
        let corners = [DVec3::ZERO, DVec3::X, DVec3::Y];
        let mut builder = MeshBuilder::default();
        let part = Part { positions: &corners, normals: &[], triangles: &[[0, 1, 2]], colour: [1.0; 3] };
        builder.add(&part, DMat4::IDENTITY);
        builder.finish().0
    }

    fn seen(origin: DVec3, towards: DVec3) -> Surface {
        let direction = (towards - origin).normalize();
        Surface::seen(&mesh(), 0, &Ray { origin, direction, length: f64::INFINITY })
    }

    #[test]
    fn a_ray_inside_the_triangle_meets_its_plane() {
        let target = DVec3::new(0.25, 0.5, 0.0);
        for (z, side) in [(3.0, DVec3::Z), (-3.0, DVec3::NEG_Z)] {
            let surface = seen(DVec3::new(-1.0, 0.3, z), target);
            assert!((surface.point - target).length() < 1e-15, "{}", surface.point);
            assert_eq!(surface.normal, side);
        }
    }

    #[test]
    fn a_ray_beside_the_triangle_means_its_edge() {
        let beside_an_edge = seen(DVec3::new(0.5, 0.0, 2.0), DVec3::new(0.5, -1e-3, 0.0));
        assert!((beside_an_edge.point - DVec3::new(0.5, 0.0, 0.0)).length() < 1e-3);
        assert_eq!(beside_an_edge.point.y, 0.0);
        let beyond_a_corner = seen(DVec3::new(1.0, 0.0, 2.0), DVec3::new(1.01, -0.001, 0.0));
        assert_eq!(beyond_a_corner.point, DVec3::X);
    }

    #[test]
    fn a_triangle_seen_from_its_edge_has_a_point_all_the_same() {
        let surface = seen(DVec3::new(-1.0, 0.25, 0.0), DVec3::new(0.0, 0.25, 0.0));
        assert!((surface.point - DVec3::new(1.0, 1.0, 0.0) / 3.0).length() < 1e-15);
    }

    #[test]
    fn the_middle_pixel_looks_straight_ahead() {
        let eye = DVec3::new(1e6, -2e6, 3e6);
        let view = View::perspective(eye, DVec3::new(0.3, -0.2, -1.0), DVec3::Y, 0.8, 1.0, 0.1, f64::INFINITY);
        let view = view.expect("a sound view");
        let ray = PixelRays::new(&view, [5, 5]).expect("invertible").through(2, 2).expect("in front");
        assert!((ray.direction - view.forward()).length() < 1e-9, "{}", ray.direction);
        assert!((ray.origin - (eye + 0.1 * view.forward())).length() < 1e-8, "{}", ray.origin);
    }
}
