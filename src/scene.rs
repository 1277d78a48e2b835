//! The scene S: bounds of what casts shadows and of what receives them.

use crate::convex::{Plane, PlaneSet, Polyhedron, Vertex, box_planes};
use crate::error::{InputError, Problem, check};
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
    Box { min: DVec3, max: DVec3 },
    Convex(&'a ConvexScene),
    Lists { casters: &'a [Aabb], receivers: &'a [Aabb] },
}

impl<'a> Scene<'a> {
    /// Everything lies in one box, which may be flat.
    ///
    /// # Errors
    ///
    /// Names `"min"` or `"max"` when it is not finite, too large, or out of order.
    pub fn from_box(min: impl Into<DVec3>, max: impl Into<DVec3>) -> Result<Self, InputError> {
        let (min, max) = checked_box(min.into(), max.into())?;
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
            for one in list {
                checked_box(one.min.as_dvec3(), one.max.as_dvec3())
                    .map_err(|error| InputError { field, ..error })?;
            }
        }
        Ok(Self { bounds: Bounds::Lists { casters, receivers } })
    }
}

fn checked_box(min: DVec3, max: DVec3) -> Result<(DVec3, DVec3), InputError> {
    check::point("min", min)?;
    check::point("max", max)?;
    if min.cmple(max).all() { Ok((min, max)) } else { check::fail("max", Problem::OutOfOrder) }
}

/// A convex body as the bounds of a scene: a box cut by up to [`ConvexScene::MAX_CUTS`] planes.
///
/// Made once where the scene changes and borrowed by [`Scene::from_convex`] for every fit.
#[derive(Clone, Debug)]
pub struct ConvexScene {
    vertices: [Vertex; Self::MAX_VERTICES],
    len: usize,
    planes: [Plane; Self::MAX_PLANES],
    plane_count: usize,
    min: DVec3,
    max: DVec3,
}

impl ConvexScene {
    /// The most planes that may cut the box: enough for the 26 directions to the faces, edges and corners of a cube.
    pub const MAX_CUTS: usize = 20;
    pub(crate) const MAX_PLANES: usize = 6 + Self::MAX_CUTS;
    /// `2F − 4` vertices for `F` planes.
    const MAX_VERTICES: usize = 2 * Self::MAX_PLANES - 4;

    /// The part of a box inside all of `planes`, each of which keeps what lies on the side its normal points to.
    ///
    /// # Errors
    ///
    /// Names `"min"` or `"max"` as [`Scene::from_box`] does, and `"planes"` when there are more than
    /// [`Self::MAX_CUTS`], one is not finite or without direction, or nothing is left of the box.
    pub fn new(min: impl Into<DVec3>, max: impl Into<DVec3>, planes: &[Plane]) -> Result<Self, InputError> {
        const FIELD: &str = "planes";
        let (min, max) = checked_box(min.into(), max.into())?;
        if planes.len() > Self::MAX_CUTS {
            return check::fail(FIELD, Problem::TooMany);
        }
        // Clipping needs room for the new vertices beside the old ones.
        let mut body = Polyhedron::<{ 2 * Self::MAX_VERTICES }>::from_box(min, max);
        let mut all = [Plane::ONE; Self::MAX_PLANES];
        all[..6].copy_from_slice(&box_planes(min, max));
        let extent = min.abs().max(max.abs());
        for (index, (plane, slot)) in planes.iter().zip(&mut all[6..]).enumerate() {
            let length = plane.normal.length();
            if !(plane.offset.is_finite() && length.is_finite()) {
                return check::fail(FIELD, Problem::NotFinite);
            }
            if length == 0.0 {
                return check::fail(FIELD, Problem::NoDirection);
            }
            *slot = plane.normalized().loosened(extent);
            body.clip(slot, 1 << (6 + index));
        }
        if body.is_empty() {
            return check::fail(FIELD, Problem::Empty);
        }
        let mut vertices = [Vertex { position: DVec3::ZERO, planes: 0 }; Self::MAX_VERTICES];
        let Some(room) = vertices.get_mut(..body.vertices().len()) else {
            return check::fail(FIELD, Problem::TooMany);
        };
        room.copy_from_slice(body.vertices());
        let min = body.positions().fold(max, DVec3::min);
        let max = body.positions().fold(min, DVec3::max);
        let len = body.vertices().len();
        Ok(Self { vertices, len, planes: all, plane_count: 6 + planes.len(), min, max })
    }

    /// The smallest body around points whose faces look along the 26 directions to the faces, edges and corners of a
    /// cube: a bound for a mesh much tighter than its box.
    ///
    /// # Errors
    ///
    /// Names `"points"` when there are none, or one is not finite or too large.
    pub fn around(points: impl IntoIterator<Item = DVec3>) -> Result<Self, InputError> {
        const FIELD: &str = "points";
        /// Half of the directions; the others are their opposites.
        const DIRECTIONS: [DVec3; 10] = [
            DVec3::new(1.0, 1.0, 0.0),
            DVec3::new(1.0, -1.0, 0.0),
            DVec3::new(0.0, 1.0, 1.0),
            DVec3::new(0.0, 1.0, -1.0),
            DVec3::new(1.0, 0.0, 1.0),
            DVec3::new(1.0, 0.0, -1.0),
            DVec3::new(1.0, 1.0, 1.0),
            DVec3::new(1.0, 1.0, -1.0),
            DVec3::new(1.0, -1.0, 1.0),
            DVec3::new(1.0, -1.0, -1.0),
        ];
        let (mut min, mut max) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let mut slabs = [(f64::INFINITY, f64::NEG_INFINITY); DIRECTIONS.len()];
        for point in points {
            check::point(FIELD, point)?;
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

    pub(crate) fn vertices(&self) -> &[Vertex] {
        &self.vertices[..self.len]
    }

    pub(crate) fn planes(&self) -> &[Plane] {
        &self.planes[..self.plane_count]
    }
}

/// One convex bound of casters or of receivers, which a body is clipped from.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Region<'a> {
    Box { min: DVec3, max: DVec3 },
    Convex(&'a ConvexScene),
}

impl Region<'_> {
    /// The planes of a region take the bits below this one.
    pub(crate) const BITS: u32 = ConvexScene::MAX_PLANES as u32;

    /// The region as a body to clip.
    pub(crate) fn polyhedron<const N: usize>(&self) -> Polyhedron<N> {
        match *self {
            Self::Box { min, max } => Polyhedron::from_box(min, max),
            Self::Convex(body) => Polyhedron::from_vertices(body.vertices()),
        }
    }

    /// Passes each plane of the region and its bit to `each`.
    pub(crate) fn for_each_plane(&self, mut each: impl FnMut(Plane, PlaneSet)) {
        match self {
            Self::Box { min, max } => {
                for (index, plane) in box_planes(*min, *max).into_iter().enumerate() {
                    each(plane, 1 << index);
                }
            }
            Self::Convex(body) => {
                for (index, plane) in body.planes().iter().enumerate() {
                    each(*plane, 1 << index);
                }
            }
        }
    }

    /// The largest absolute coordinates in the region.
    pub(crate) fn extent(&self) -> DVec3 {
        match self {
            Self::Box { min, max } => min.abs().max(max.abs()),
            Self::Convex(body) => body.min.abs().max(body.max.abs()),
        }
    }
}
