//! Convex bodies with vertices, faces and planes, as results.

use super::{Bits, Plane, Polyhedron};
use glam::DVec3;

/// A bounded convex body in world space, with its vertices, edges, faces and planes: the receiver volume R or a caster volume H.
/// It may be empty or flat, a segment or a point.
///
/// ```
/// use shadowfit::{Focus, Light, Scene, View, glam::DVec3};
///
/// let view = View::orthographic((0.0, 0.0, 50.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0), 100.0, 1.0, 0.0, 100.0)?;
/// let cube = Scene::from_box((-1.0, -1.0, -1.0), (1.0, 1.0, 1.0))?;
/// let body = Focus::new(&view, &Light::directional((0.4, 1.0, 0.2))?, &cube).receiver_volume();
/// assert_eq!((body.vertices().len(), body.edges().count(), body.faces().count(), body.planes().count()), (8, 12, 6, 6));
/// assert_eq!(body.bounds(), Some((DVec3::splat(-1.0), DVec3::splat(1.0))));
/// assert!(!body.is_empty() && (body.volume() - 8.0).abs() < 1e-12);
/// assert!(body.contains(DVec3::splat(0.9)) && !body.contains(DVec3::splat(1.1)));
/// # Ok::<(), shadowfit::InputError>(())
/// ```
///
/// # Guarantees
///
/// - No two vertices are equal.
/// - Every vertex is inside every plane, up to a few roundings of its coordinates.
/// - The body contains the exact one: planes stand outside of it by 96 ε of the magnitudes of their terms. A point inside by less
///   than that may be outside of the exact body.
/// - A body is a few kilobytes in place and allocates nothing.
#[doc(alias = "convex polyhedron")]
#[doc(alias = "convex hull")]
#[derive(Clone, Debug)]
pub struct ConvexBody {
    positions: [DVec3; Polyhedron::MAX_VERTICES],
    /// For each vertex the planes that it lies on, one bit each.
    incidence: [u64; Polyhedron::MAX_VERTICES],
    len: usize,
    planes: PlaneTable,
    /// The planes that a vertex lies on.
    used: u64,
}

/// Planes by their names.
pub(crate) type PlaneTable = [Plane; Polyhedron::MAX_PLANES];

impl ConvexBody {
    pub(crate) fn new(polyhedron: &Polyhedron, planes: PlaneTable) -> Self {
        let mut body = Self {
            positions: [DVec3::ZERO; Polyhedron::MAX_VERTICES],
            incidence: [0; Polyhedron::MAX_VERTICES],
            len: 0,
            planes,
            used: 0,
        };
        for vertex in polyhedron.vertices() {
            let found = body.positions[..body.len].iter().position(|&known| known == vertex.position);
            let index = found.unwrap_or(body.len);
            body.positions[index] = vertex.position;
            body.incidence[index] |= vertex.planes.iter().fold(0, |set, plane| set | 1 << plane);
            body.len = body.len.max(index + 1);
            body.used |= body.incidence[index];
        }
        body
    }

    /// Whether the body has no point.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// The vertices in world space, in no particular order.
    #[must_use]
    pub fn vertices(&self) -> &[DVec3] {
        &self.positions[..self.len]
    }

    /// The planes that bound the body, inside ≥ 0; at least one vertex lies on each.
    pub fn planes(&self) -> impl Iterator<Item = Plane> + '_ {
        Bits(self.used).map(|bit| self.planes[bit])
    }

    /// The faces: one polygon for every plane with at least three vertices. A flat body has two, one for each side; a segment and a
    /// point have none.
    pub fn faces(&self) -> impl Iterator<Item = Face<'_>> + '_ {
        Bits(self.used).filter_map(|bit| self.face(bit))
    }

    /// The edges by their ends in world space, each edge once.
    pub fn edges(&self) -> impl Iterator<Item = (DVec3, DVec3)> + '_ {
        self.faces().flat_map(move |face| {
            let (order, len) = (face.order, face.len);
            // Neighbouring faces walk a common edge in opposite directions: keep one of them.
            (0..len)
                .map(move |at| (order[at], order[(at + 1) % len]))
                .filter(|(a, b)| a < b)
                .map(|(a, b)| (self.positions[usize::from(a)], self.positions[usize::from(b)]))
        })
    }

    /// The least and largest coordinates of the body, or `None` when empty.
    #[must_use]
    pub fn bounds(&self) -> Option<(DVec3, DVec3)> {
        let first = *self.vertices().first()?;
        Some(self.vertices().iter().fold((first, first), |(min, max), &point| (min.min(point), max.max(point))))
    }

    /// The volume, in cubic world units; 0 when empty or flat.
    #[must_use]
    pub fn volume(&self) -> f64 {
        let Some(&apex) = self.vertices().first() else { return 0.0 };
        // The sum of cones from one vertex over all faces, each face a fan of triangles.
        let cones = self.faces().map(|face| {
            let mut corners = face.vertices().map(|corner| corner - apex);
            let Some(first) = corners.next() else { return 0.0 };
            let mut previous = first;
            corners.fold(0.0, |sum, corner| {
                let cone = first.dot(previous.cross(corner));
                previous = corner;
                sum + cone
            })
        });
        (cones.sum::<f64>() / 6.0).abs()
    }

    /// Whether a world-space point lies inside all planes of the body, without tolerance.
    #[must_use]
    pub fn contains(&self, point: DVec3) -> bool {
        !self.is_empty() && self.planes().all(|plane| plane.at(point) >= 0.0)
    }

    /// All planes by bit, and which of them hold a vertex.
    pub(crate) const fn plane_table(&self) -> (&PlaneTable, u64) {
        (&self.planes, self.used)
    }

    /// Whether a vertex, and so most often an edge, lies on both planes.
    pub(crate) fn meet(&self, bit: usize, other: usize) -> bool {
        let both = 1_u64 << bit | 1 << other;
        self.incidence[..self.len].iter().any(|set| set & both == both)
    }

    fn face(&self, bit: usize) -> Option<Face<'_>> {
        let plane = self.planes[bit];
        let mut face = Face { body: self, plane, order: [0; Polyhedron::MAX_VERTICES], len: 0 };
        let mut sum = DVec3::ZERO;
        for (index, set) in self.incidence[..self.len].iter().enumerate() {
            if set >> bit & 1 == 1 {
                face.order[face.len] = index as u8;
                face.len += 1;
                sum += self.positions[index];
            }
        }
        if face.len < 3 {
            return None;
        }
        let centre = sum / face.len as f64;
        let (x, y) = plane.normalized().normal.any_orthonormal_pair();
        // Sorted around the centre by a function that grows with the angle and needs no arctangent. The pair of axes makes the
        // order counter-clockwise as seen from outside, against the inward normal.
        let turn = |index: &u8| {
            let arm = self.positions[usize::from(*index)] - centre;
            let (x, y) = (arm.dot(x), arm.dot(y));
            let along = x / (x.abs() + y.abs());
            if y > 0.0 { along } else { -2.0 - along }
        };
        face.order[..face.len].sort_unstable_by(|a, b| turn(a).total_cmp(&turn(b)).then(a.cmp(b)));
        Some(face)
    }
}

/// A face of a [`ConvexBody`]: a polygon, convex up to rounding. Where two planes nearly coincide, corners on both may lie anywhere
/// between them, far along the plane though hardly across it.
///
/// ```
/// use shadowfit::{Focus, Light, Scene, View, glam::DVec3};
///
/// let view = View::orthographic((0.0, 0.0, 50.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0), 100.0, 1.0, 0.0, 100.0)?;
/// let cube = Scene::from_box((-1.0, -1.0, -1.0), (1.0, 1.0, 1.0))?;
/// let body = Focus::new(&view, &Light::directional((0.4, 1.0, 0.2))?, &cube).receiver_volume();
/// let top = body.faces().find(|face| face.plane().normal.y < 0.0).expect("a face with its normal inwards");
/// assert!(top.vertices().all(|corner| corner.y == 1.0));
/// assert!(top.indices().map(|index| body.vertices()[index]).eq(top.vertices()));
/// # Ok::<(), shadowfit::InputError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Face<'a> {
    body: &'a ConvexBody,
    plane: Plane,
    order: [u8; Polyhedron::MAX_VERTICES],
    len: usize,
}

impl Face<'_> {
    /// The plane of the face; its normal points into the body.
    #[must_use]
    pub const fn plane(&self) -> Plane {
        self.plane
    }

    /// The corners, counter-clockwise as seen from outside the body.
    pub fn vertices(&self) -> impl ExactSizeIterator<Item = DVec3> + Clone + '_ {
        self.indices().map(|index| self.body.positions[index])
    }

    /// The corners as indices into [`ConvexBody::vertices`], counter-clockwise as seen from outside the body.
    pub fn indices(&self) -> impl ExactSizeIterator<Item = usize> + Clone + '_ {
        self.order[..self.len].iter().map(|&index| usize::from(index))
    }
}
