//! Conversions of bodies and boxes from and to parry3d, by component: its version of glam may differ.

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
    /// The convex polyhedron, up to rounding of its normals, where at most [`Self::MAX_CUTS`] of its faces cut its box; else
    /// [`Self::around`] its points. parry3d merges faces that are nearly coplanar: each plane is moved out to the farthest point, so
    /// that the body holds every point.
    ///
    /// ```
    /// use parry3d::{math::Vector, shape::ConvexPolyhedron};
    /// use shadowfit::{Focus, Light, Scene, View, input::ConvexScene};
    ///
    /// let points = [(0.0, 0.0, 0.0), (2.0, 0.0, 0.0), (0.0, 2.0, 0.0), (0.0, 0.0, 2.0)].map(|(x, y, z)| Vector::new(x, y, z));
    /// let pyramid = ConvexPolyhedron::from_convex_hull(&points).expect("a solid");
    /// let scene = ConvexScene::from_parry(&pyramid)?;
    /// let view = View::perspective((1.0, 1.0, 9.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.1, 50.0)?;
    /// let focus = Focus::new(&view, &Light::directional((0.4, 1.0, 0.2))?, &Scene::from_convex(&scene));
    /// assert!((focus.receiver_volume().volume() - 8.0 / 6.0).abs() < 1e-5);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// Names `"points"`, with the index, when one is not finite or too large.
    pub fn from_parry(polyhedron: &ConvexPolyhedron) -> Result<Self, InputError> {
        let points = polyhedron.points().iter().map(|&point| from_parry(point).as_dvec3());
        let normals = polyhedron.faces().iter().map(|face| from_parry(face.normal).as_dvec3());
        Self::supported(points, normals)
    }

    /// The convex hull of a mesh's points, where at most [`Self::MAX_CUTS`] of its faces cut its box; else, and for points without
    /// volume, [`Self::around`] the points.
    ///
    /// Use it for rotated solids of few faces: a crate, a roof, a ramp, the prism of a terrain tile. Their faces are kept, where
    /// [`Self::around`] has faces at multiples of 45° only. It takes `O(n log n)` time and allocates; a rounded mesh has too many
    /// faces to gain.
    ///
    /// ```
    /// use shadowfit::{Focus, Light, Scene, View, glam::Vec3, input::ConvexScene};
    ///
    /// let crate_ = [-1.0, 1.0].map(|y| [(2.0, 1.0), (-1.0, 2.0), (-2.0, -1.0), (1.0, -2.0)].map(|(x, z)| Vec3::new(x, y, z)));
    /// let hull = ConvexScene::hull_of(crate_.as_flattened())?;
    /// let view = View::perspective((0.0, 0.0, 9.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.1, 50.0)?;
    /// let focus = Focus::new(&view, &Light::directional((0.4, 1.0, 0.2))?, &Scene::from_convex(&hull));
    /// assert!((focus.receiver_volume().volume() - 20.0).abs() < 1e-4); // its box has 32
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
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

    /// The body around points with faces of these outward normals, besides those of its box.
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
        // A thinner cut is the rounding of an f32 normal, usually of a face of the box itself.
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
    /// The body as a convex polyhedron of parry3d, with vertices rounded to f32; `None` when it is empty, or flat up to f32 rounding.
    ///
    /// ```
    /// use shadowfit::{Focus, FocusForm, Light, Scene, View};
    ///
    /// let view = View::perspective((0.0, 1.7, 0.0), (0.0, -0.2, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.1, 40.0)?;
    /// let scene = Scene::from_box((-20.0, 0.0, -20.0), (20.0, 3.0, 20.0))?;
    /// let body = Focus::new(&view, &Light::directional((0.4, 1.0, 0.2))?, &scene).caster_volume(FocusForm::ReceiverHull);
    /// let polyhedron = body.to_parry().expect("a solid");
    /// assert!(polyhedron.points().len() <= body.vertices().len() && polyhedron.points().len() > 4);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
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

/// The field of a mesh's points in an [`InputError`].
const FIELD: &str = "points";

fn from_parry(vector: Vector) -> Vec3 {
    Vec3::new(vector.x, vector.y, vector.z)
}

fn to_parry(vector: Vec3) -> Vector {
    Vector::new(vector.x, vector.y, vector.z)
}
