//! A convex body as bounds of a scene.

use super::boxes::checked_box;
use crate::convex::{Plane, PlaneId, Polyhedron, box_planes};
use crate::error::{InputError, check};
use crate::input::numbers::vector;
use glam::DVec3;

/// A convex body as bounds of a scene: a box cut by planes.
///
/// Build it when the scene changes; [`Scene::from_convex`](crate::Scene::from_convex) borrows it for every fit.
///
/// ```
/// use shadowfit::{Empty, Light, Outcome, Scene, Settings, View, fit, focus::Plane, input::ConvexScene};
///
/// let view = View::perspective((0.0, 1.7, 9.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.1, 50.0)?;
/// let sun = Light::directional((0.4, 1.0, 0.2))?;
/// // A room with a sloping roof, and one that a plane cuts off completely.
/// let room = ConvexScene::new((-4.0, 0.0, -4.0), (4.0, 5.0, 4.0), &[Plane::from([-0.5, -1.0, 0.0, 5.0])])?;
/// assert!(fit(&view, &sun, &Scene::from_convex(&room), &Settings::default()).map().is_some());
/// let none = ConvexScene::new((-4.0, 0.0, -4.0), (4.0, 5.0, 4.0), &[Plane::from([0.0, 1.0, 0.0, -9.0])])?;
/// let outcome = fit(&view, &sun, &Scene::from_convex(&none), &Settings::default());
/// assert_eq!(outcome, Outcome::Empty(Empty::NoReceivers));
/// # Ok::<(), shadowfit::InputError>(())
/// ```
#[doc(alias = "k-DOP")]
#[derive(Clone, Debug)]
pub struct ConvexScene {
    pub(super) body: Polyhedron,
    planes: [Plane; Self::MAX_PLANES],
    pub(super) plane_count: usize,
    min: DVec3,
    max: DVec3,
}

/// The field of planes in an [`InputError`].
const FIELD: &str = "planes";

impl ConvexScene {
    /// The largest number of planes that cut the box: enough for a rotated box cut by a cone of twelve planes, and for the
    /// directions to the edges of a cube ([`Self::around`]).
    pub const MAX_CUTS: usize = 18;
    pub(crate) const MAX_PLANES: usize = 6 + Self::MAX_CUTS;

    /// The part of a world-space box inside all of `planes`, inside ≥ 0. It may be empty.
    ///
    /// Of more than [`Self::MAX_CUTS`] planes, redundant ones are left out first, then the last ones: the body is then larger than
    /// the exact one, never smaller.
    ///
    /// # Errors
    ///
    /// Names `"min"` or `"max"` as [`Scene::from_box`](crate::Scene::from_box) does, and `"planes"`, with its index, when one is not
    /// finite or has a zero normal.
    pub fn new<F: Into<f64>, G: Into<f64>>(
        min: impl Into<[F; 3]>,
        max: impl Into<[G; 3]>,
        planes: &[Plane],
    ) -> Result<Self, InputError> {
        let bounds = checked_box(vector(min), vector(max))?;
        for (index, plane) in planes.iter().enumerate() {
            plane.checked(FIELD).map_err(|error| error.of_list(FIELD, index))?;
        }
        let Some((min, max)) = bounds else { return Ok(Self::EMPTY) };
        Ok(match planes.len() {
            0..=Self::MAX_CUTS => Self::cut(min, max, planes.iter()),
            _ => Self::cut_by_those_that_bound(min, max, planes),
        })
    }

    /// A box cut by more planes than [`Self::MAX_CUTS`], all of them checked.
    fn cut_by_those_that_bound(min: DVec3, max: DVec3, planes: &[Plane]) -> Self {
        let extent = min.abs().max(max.abs());
        let mut body = Polyhedron::from_box(min, max);
        // Planes beyond the largest name are tested below.
        let named = || (6..Polyhedron::MAX_PLANES as PlaneId).zip(planes);
        for (id, plane) in named() {
            if let Ok(plane) = plane.checked(FIELD) {
                body.clip(&plane.loosened(extent), id);
            }
        }
        // A plane without a name may cut all of the body off.
        if planes.iter().any(|plane| misses(plane, &body, extent)) {
            return Self::EMPTY;
        }
        let used = body.vertices().flat_map(|vertex| vertex.planes).fold(0, |set, id| set | 1_u64 << id);
        let bounding = named().filter(|(id, _)| used >> id & 1 == 1).map(|(_, plane)| plane);
        Self::cut(min, max, bounding.take(Self::MAX_CUTS))
    }

    const EMPTY: Self = Self {
        body: Polyhedron::EMPTY,
        planes: [Plane::ONE; Self::MAX_PLANES],
        plane_count: 0,
        min: DVec3::ZERO,
        max: DVec3::ZERO,
    };

    /// A box cut by at most [`Self::MAX_CUTS`] planes, all of them checked.
    fn cut<'a>(min: DVec3, max: DVec3, planes: impl Iterator<Item = &'a Plane>) -> Self {
        let mut scene = Self { body: Polyhedron::from_box(min, max), plane_count: 6, ..Self::EMPTY };
        scene.planes[..6].copy_from_slice(&box_planes(min, max));
        let extent = min.abs().max(max.abs());
        for (id, plane) in (6..).zip(planes) {
            let Ok(plane) = plane.checked(FIELD) else { continue };
            let plane = plane.loosened(extent);
            scene.body.clip(&plane, id);
            scene.planes[usize::from(id)] = plane;
            scene.plane_count += 1;
        }
        if scene.body.is_empty() {
            return Self::EMPTY;
        }
        scene.min = scene.body.positions().fold(max, DVec3::min);
        scene.max = scene.body.positions().fold(min, DVec3::max);
        scene
    }

    /// The 18-DOP of points: the smallest body around them with faces towards the faces and edges of a cube, a tighter bound for
    /// a mesh than its box. Around no points it is empty.
    ///
    /// ```
    /// use shadowfit::{Focus, Light, Scene, View, input::ConvexScene};
    ///
    /// let octahedron = [[2.0, 0.0, 0.0], [-2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, -2.0, 0.0], [0.0, 0.0, 2.0], [0.0, 0.0, -2.0]];
    /// let body = ConvexScene::around(octahedron)?;
    /// let view = View::perspective((0.0, 0.0, 9.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.1, 50.0)?;
    /// let focus = Focus::new(&view, &Light::directional((0.4, 1.0, 0.2))?, &Scene::from_convex(&body));
    /// assert!(focus.receiver_volume().volume() < 0.26 * 64.0); // a rhombic dodecahedron; the box has 64
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// Names `"points"`, with the index, when one is not finite or too large.
    #[doc(alias = "k-DOP")]
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
            return Ok(Self::EMPTY);
        }
        let mut planes = [Plane::ONE; 2 * DIRECTIONS.len()];
        for (pair, (slab, direction)) in planes.chunks_exact_mut(2).zip(slabs.into_iter().zip(DIRECTIONS)) {
            pair[0] = Plane::new(direction, -slab.0);
            pair[1] = Plane::new(-direction, slab.1);
        }
        Self::new(min, max, &planes)
    }

    pub(super) fn planes(&self) -> &[Plane] {
        &self.planes[..self.plane_count]
    }

    /// The largest absolute coordinates.
    pub(super) fn extent(&self) -> DVec3 {
        self.min.abs().max(self.max.abs())
    }
}

/// Whether all of a body is outside of a plane.
fn misses(plane: &Plane, body: &Polyhedron, extent: DVec3) -> bool {
    plane.checked(FIELD).is_ok_and(|plane| body.positions().all(|point| plane.loosened(extent).at(point) < 0.0))
}
