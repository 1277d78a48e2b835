//! Bodies and boxes to and from parry3d, component by component: its glam need not be the one used here.

extern crate alloc;

use crate::convex::{ConvexBody, Plane};
use crate::error::{InputError, check};
use crate::focus::farthest_corner;
use crate::input::scene::{Aabb, ConvexScene};
use alloc::vec::Vec;
use glam::{DVec3, Vec3};
use parry3d::math::Vector;
use parry3d::shape::ConvexPolyhedron;

impl From<parry3d::bounding_volume::Aabb> for Aabb {
    fn from(bounds: parry3d::bounding_volume::Aabb) -> Self {
        Self::new(from_parry(bounds.mins), from_parry(bounds.maxs))
    }
}

impl From<Aabb> for parry3d::bounding_volume::Aabb {
    fn from(bounds: Aabb) -> Self {
        Self::new(to_parry(bounds.min), to_parry(bounds.max))
    }
}

impl ConvexScene {
    /// The convex polyhedron, exactly but for the rounding of its normals, when no more than [`Self::MAX_CUTS`] of its
    /// faces cut its box; [`Self::around`] its points when more do.
    ///
    /// parry3d merges faces that are nearly coplanar. Each plane is moved out to the farthest point, so that the body
    /// holds every point all the same.
    ///
    /// # Errors
    ///
    /// Names `"points"`, with the index, when one is not finite or too large.
    pub fn from_parry(polyhedron: &ConvexPolyhedron) -> Result<Self, InputError> {
        let points = polyhedron.points().iter().map(|&point| from_parry(point).as_dvec3());
        let normals = polyhedron.faces().iter().map(|face| from_parry(face.normal).as_dvec3());
        Self::supported(points, normals)
    }

    /// The convex hull of a mesh's points, where no more than [`Self::MAX_CUTS`] of its faces cut its box, and
    /// [`Self::around`] the points where more do or they have no volume.
    ///
    /// Worth the hull's `O(n log n)` and its allocations for simple solids that are turned: a crate, a roof, a ramp, a
    /// terrain tile's prism. Their few faces are kept as they are, where [`Self::around`] looks along multiples of 45°
    /// only. A rounded mesh has a hull of many faces and gains nothing.
    ///
    /// # Errors
    ///
    /// Names `"points"`, with the index, when one is not finite or too large.
    pub fn hull_of(points: &[Vec3]) -> Result<Self, InputError> {
        for (index, point) in points.iter().enumerate() {
            check::point(FIELD, point.as_dvec3()).map_err(|error| error.of_list(FIELD, index))?;
        }
        let all = points.iter().map(|point| point.as_dvec3());
        let theirs: Vec<Vector> = points.iter().copied().map(to_parry).collect();
        match ConvexPolyhedron::from_convex_hull(&theirs) {
            Some(hull) => {
                let normals = hull.faces().iter().map(|face| from_parry(face.normal).as_dvec3());
                Self::supported(all, normals)
            }
            None => Self::around(all),
        }
    }

    /// The body around points whose faces have these outward normals, besides those of its box.
    fn supported(
        points: impl Iterator<Item = DVec3> + Clone,
        normals: impl Iterator<Item = DVec3>,
    ) -> Result<Self, InputError> {
        let (mut min, mut max) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for (index, point) in points.clone().enumerate() {
            check::point(FIELD, point).map_err(|error| error.of_list(FIELD, index))?;
            (min, max) = (min.min(point), max.max(point));
        }
        if !min.is_finite() {
            return Self::around(points);
        }
        // A cut thinner than this is the rounding of an f32 normal, most often of a face of the box itself.
        let thinnest = 4.0 * f64::from(f32::EPSILON) * (max - min).length();
        let mut planes = [Plane::ONE; Self::MAX_CUTS];
        let mut count = 0;
        for normal in normals {
            let support = points.clone().map(|point| normal.dot(point)).fold(f64::NEG_INFINITY, f64::max);
            let corner = normal.dot(farthest_corner(min, max, normal));
            if corner - support > thinnest {
                let Some(plane) = planes.get_mut(count) else { return Self::around(points) };
                *plane = Plane::new(-normal, support);
                count += 1;
            }
        }
        Self::new(min, max, &planes[..count])
    }
}

impl ConvexBody {
    /// The body as a convex polyhedron of parry3d, its vertices rounded to f32; `None` when it is empty or, as far as
    /// f32 can tell, flat.
    #[must_use]
    pub fn to_parry(&self) -> Option<ConvexPolyhedron> {
        let (min, max) = self.bounds()?;
        let largest = min.abs().max(max.abs()).max_element();
        if self.volume() <= f64::from(f32::EPSILON) * largest * (max - min).length_squared() {
            return None;
        }
        let points: Vec<Vector> = self.vertices().iter().map(|point| to_parry(point.as_vec3())).collect();
        ConvexPolyhedron::from_convex_hull(&points)
    }
}

/// What the points of a mesh are called in an [`InputError`].
const FIELD: &str = "points";

fn from_parry(vector: Vector) -> Vec3 {
    Vec3::new(vector.x, vector.y, vector.z)
}

fn to_parry(vector: Vec3) -> Vector {
    Vector::new(vector.x, vector.y, vector.z)
}
