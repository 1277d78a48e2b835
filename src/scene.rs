//! The scene S: bounds of what casts shadows and of what receives them.

use crate::convex::{Plane, PlaneId, Polyhedron, box_planes};
use crate::error::{Expected, InputError, Problem, check};
use crate::numbers::vector;
use glam::{DVec3, Vec3};

/// An axis-aligned box in single precision, as renderers keep them for their objects.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Aabb {
    /// The least coordinates.
    pub min: Vec3,
    /// The largest coordinates.
    pub max: Vec3,
}

impl Aabb {
    /// A box from its least and largest coordinates.
    #[must_use]
    pub const fn new(min: Vec3, max: Vec3) -> Self {
        Self { min, max }
    }
}

/// Bounds of the scene: everything that casts or receives shadows lies inside.
#[derive(Clone, Copy, Debug)]
pub struct Scene<'a> {
    pub(crate) bounds: Bounds<'a>,
}

/// The forms that a scene's bounds come in.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Bounds<'a> {
    Box {
        min: DVec3,
        max: DVec3,
    },
    Convex(&'a ConvexScene),
    /// With the largest absolute coordinates of the casters.
    Lists {
        casters: &'a [Aabb],
        receivers: &'a [Aabb],
        extent: DVec3,
    },
}

impl<'a> Scene<'a> {
    /// Everything lies in one box, which may be flat.
    ///
    /// # Errors
    ///
    /// Names `"min"` or `"max"` when it is not finite, too large, or out of order.
    pub fn from_box<F: Into<f64>, G: Into<f64>>(
        min: impl Into<[F; 3]>,
        max: impl Into<[G; 3]>,
    ) -> Result<Self, InputError> {
        let (min, max) = checked_box(vector(min), vector(max))?;
        Ok(Self { bounds: Bounds::Box { min, max } })
    }

    /// Everything lies in one convex body.
    #[must_use]
    pub const fn from_convex(body: &'a ConvexScene) -> Self {
        Self { bounds: Bounds::Convex(body) }
    }

    /// Boxes of what casts and boxes of what receives, usually one an object; an object that does both is in both
    /// lists. The fit reads the lists, it does not copy them.
    ///
    /// # Errors
    ///
    /// Names `"casters"` or `"receivers"` when the list is empty, or holds a box that is not finite, too large, or out
    /// of order.
    pub fn new(casters: &'a [Aabb], receivers: &'a [Aabb]) -> Result<Self, InputError> {
        for (field, list) in [("casters", casters), ("receivers", receivers)] {
            if list.is_empty() {
                return check::fail(field, Problem::Empty);
            }
            for (index, one) in list.iter().enumerate() {
                checked_box(one.min.as_dvec3(), one.max.as_dvec3())
                    .map_err(|error| of_boxes(error, field, index))?;
            }
        }
        Ok(Self::of_checked(casters, receivers))
    }

    /// The same as [`Self::new`] for boxes that are known to be sound, and for no boxes at all.
    pub(crate) fn of_checked(casters: &'a [Aabb], receivers: &'a [Aabb]) -> Self {
        let extent = casters.iter().fold(Vec3::ZERO, |extent, one| extent.max(one.min.abs()).max(one.max.abs()));
        Self { bounds: Bounds::Lists { casters, receivers, extent: extent.as_dvec3() } }
    }
}

pub(crate) fn checked_box(min: DVec3, max: DVec3) -> Result<(DVec3, DVec3), InputError> {
    let (min, max) = (check::point("min", min)?, check::point("max", max)?);
    for (axis, (least, most)) in min.to_array().into_iter().zip(max.to_array()).enumerate() {
        if least > most {
            let field = ["min.x", "min.y", "min.z"][axis];
            let expected = Expected::AtLeast { field, value: least };
            return Err(InputError::new("max", Problem::OutOfOrder).of_axis(axis).got(most).expected(expected));
        }
    }
    Ok((min, max))
}

/// What [`checked_box`] finds wrong, of a box in a list.
pub(crate) fn of_boxes(error: InputError, field: &'static str, index: usize) -> InputError {
    let component = match (error.field, error.component) {
        ("min", Some("x")) => Some("min.x"),
        ("min", Some("y")) => Some("min.y"),
        ("min", Some("z")) => Some("min.z"),
        ("max", Some("x")) => Some("max.x"),
        ("max", Some("y")) => Some("max.y"),
        ("max", Some("z")) => Some("max.z"),
        (_, other) => other,
    };
    InputError { component, ..error }.of_list(field, index)
}

/// A convex body as the bounds of a scene: a box cut by up to [`ConvexScene::MAX_CUTS`] planes.
///
/// Made once where the scene changes and borrowed by [`Scene::from_convex`] for every fit.
#[derive(Clone, Debug)]
pub struct ConvexScene {
    body: Polyhedron,
    planes: [Plane; Self::MAX_PLANES],
    plane_count: usize,
    min: DVec3,
    max: DVec3,
}

impl ConvexScene {
    /// The most planes that may cut the box: enough for the directions to the edges of a cube, see [`Self::around`].
    pub const MAX_CUTS: usize = 12;
    const MAX_PLANES: usize = 6 + Self::MAX_CUTS;

    /// The part of a box inside all of `planes`, each of which keeps what lies on the side its normal points to.
    ///
    /// # Errors
    ///
    /// Names `"min"` or `"max"` as [`Scene::from_box`] does, and `"planes"` when there are more than
    /// [`Self::MAX_CUTS`], one is not finite or without direction, or nothing is left of the box.
    pub fn new<F: Into<f64>, G: Into<f64>>(
        min: impl Into<[F; 3]>,
        max: impl Into<[G; 3]>,
        planes: &[Plane],
    ) -> Result<Self, InputError> {
        const FIELD: &str = "planes";
        let (min, max) = checked_box(vector(min), vector(max))?;
        if planes.len() > Self::MAX_CUTS {
            return check::fail(FIELD, Problem::TooMany);
        }
        let mut body = Polyhedron::from_box(min, max);
        let mut all = [Plane::ONE; Self::MAX_PLANES];
        all[..6].copy_from_slice(&box_planes(min, max));
        let extent = min.abs().max(max.abs());
        for (id, (plane, slot)) in (6..).zip(planes.iter().zip(&mut all[6..])) {
            let normal = check::direction(FIELD, plane.normal)?;
            let offset = check::coordinate(FIELD, plane.offset * (normal.dot(plane.normal)).recip())?;
            *slot = Plane::new(normal, offset).loosened(extent);
            body.clip(slot, id);
        }
        if body.is_empty() {
            return check::fail(FIELD, Problem::Empty);
        }
        let min = body.positions().fold(max, DVec3::min);
        let max = body.positions().fold(min, DVec3::max);
        Ok(Self { body, planes: all, plane_count: 6 + planes.len(), min, max })
    }

    /// The smallest body around points whose faces look along the 18 directions to the faces and edges of a cube: a
    /// bound for a mesh that is tighter than its box.
    ///
    /// # Errors
    ///
    /// Names `"points"` when there are none, or one is not finite or too large.
    pub fn around<F: Into<f64>, P: Into<[F; 3]>>(points: impl IntoIterator<Item = P>) -> Result<Self, InputError> {
        const FIELD: &str = "points";
        /// Half of the directions; the others are their opposites.
        const DIRECTIONS: [DVec3; 6] = [
            DVec3::new(1.0, 1.0, 0.0),
            DVec3::new(1.0, -1.0, 0.0),
            DVec3::new(0.0, 1.0, 1.0),
            DVec3::new(0.0, 1.0, -1.0),
            DVec3::new(1.0, 0.0, 1.0),
            DVec3::new(1.0, 0.0, -1.0),
        ];
        let (mut min, mut max) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let mut slabs = [(f64::INFINITY, f64::NEG_INFINITY); DIRECTIONS.len()];
        for (index, point) in points.into_iter().enumerate() {
            let point = check::point(FIELD, vector(point)).map_err(|error| error.of_list(FIELD, index))?;
            (min, max) = (min.min(point), max.max(point));
            for (slab, direction) in slabs.iter_mut().zip(DIRECTIONS) {
                let along = direction.dot(point);
                *slab = (slab.0.min(along), slab.1.max(along));
            }
        }
        if !min.is_finite() {
            return check::fail(FIELD, Problem::Empty);
        }
        let mut planes = [Plane::ONE; Self::MAX_CUTS];
        for (pair, (slab, direction)) in planes.chunks_exact_mut(2).zip(slabs.into_iter().zip(DIRECTIONS)) {
            pair[0] = Plane::new(direction, -slab.0);
            pair[1] = Plane::new(-direction, slab.1);
        }
        Self::new(min, max, &planes)
    }
}

/// One convex bound of casters or of receivers, which a body is clipped from.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Region<'a> {
    Box { min: DVec3, max: DVec3 },
    Convex(&'a ConvexScene),
}

impl Region<'_> {
    /// The planes of a region have the names below this one.
    pub(crate) const IDS: PlaneId = ConvexScene::MAX_PLANES as PlaneId;

    /// Makes a body of the region, to clip.
    pub(crate) fn fill(&self, body: &mut Polyhedron) {
        match self {
            Self::Box { min, max } => body.set_box(*min, *max),
            Self::Convex(scene) => body.clone_from(&scene.body),
        }
    }

    /// Passes each plane of the region and its name to `each`.
    pub(crate) fn for_each_plane(&self, mut each: impl FnMut(Plane, PlaneId)) {
        let mut pass = |planes: &[Plane]| (0..).zip(planes).for_each(|(id, plane)| each(*plane, id));
        match self {
            Self::Box { min, max } => pass(&box_planes(*min, *max)),
            Self::Convex(scene) => pass(&scene.planes[..scene.plane_count]),
        }
    }

    /// The largest absolute coordinates in the region.
    pub(crate) fn extent(&self) -> DVec3 {
        match self {
            Self::Box { min, max } => min.abs().max(max.abs()),
            Self::Convex(scene) => scene.min.abs().max(scene.max.abs()),
        }
    }
}
