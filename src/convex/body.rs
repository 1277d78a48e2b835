//! A convex body with its faces, as a result.

use super::{Bits, Plane, Polyhedron};
use glam::DVec3;

/// A bounded convex body: vertices, faces and planes.
///
/// Empty and flat bodies, segments and points are bodies too.
///
/// # Guarantees
///
/// - No two vertices are equal.
/// - Every vertex is inside every plane, up to a few roundings of its coordinates.
/// - Planes stand 96 ε of the magnitudes of their terms outside of the exact body, so that the body holds it, and a point
///   that is in the body by less than that may be outside of the exact one.
/// - It holds its memory itself: a body is a few kilobytes and allocates nothing.
#[derive(Clone, Debug)]
pub struct ConvexBody {
    positions: [DVec3; Polyhedron::MAX_VERTICES],
    /// For each vertex, the planes it lies on, one bit each.
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

    /// Whether there is no point in the body.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// The vertices, in world space and in no particular order.
    #[must_use]
    pub fn vertices(&self) -> &[DVec3] {
        &self.positions[..self.len]
    }

    /// The planes that bound the body, inside ≥ 0; each holds at least one vertex.
    pub fn planes(&self) -> impl Iterator<Item = Plane> + '_ {
        Bits(self.used).map(|bit| self.planes[bit])
    }

    /// The faces: polygons, one for each plane that at least three vertices lie on.
    ///
    /// A flat body has two, one for each side; a segment and a point have none.
    pub fn faces(&self) -> impl Iterator<Item = Face<'_>> + '_ {
        Bits(self.used).filter_map(|bit| self.face(bit))
    }

    /// The edges, each once.
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

    /// The least and largest coordinates, or `None` when empty.
    #[must_use]
    pub fn bounds(&self) -> Option<(DVec3, DVec3)> {
        let first = *self.vertices().first()?;
        Some(self.vertices().iter().fold((first, first), |(min, max), &point| (min.min(point), max.max(point))))
    }

    /// The volume, in cubic world units; 0 when empty or flat.
    #[must_use]
    pub fn volume(&self) -> f64 {
        let Some(&apex) = self.vertices().first() else { return 0.0 };
        // Cones from one vertex over all faces; a face's polygon as a fan.
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

    /// Whether a point lies in the body: inside all planes, exactly as computed.
    #[must_use]
    pub fn contains(&self, point: DVec3) -> bool {
        !self.is_empty() && self.planes().all(|plane| plane.at(point) >= 0.0)
    }

    /// All planes by bit, and which of them hold a vertex.
    pub(crate) const fn plane_table(&self) -> (&PlaneTable, u64) {
        (&self.planes, self.used)
    }

    /// Whether an edge, or at least a vertex, lies on both planes.
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
        // Around the centre, by an angle's stand-in that grows with it and needs no arc tangent. The pair is such that
        // the order is counter-clockwise as seen from outside, against the inward normal.
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

/// A face of a [`ConvexBody`]: a convex polygon, but where two planes nearly coincide. Corners on both are anywhere between the two,
/// which is nothing across the plane and may be much along it.
#[derive(Clone, Copy, Debug)]
pub struct Face<'a> {
    body: &'a ConvexBody,
    plane: Plane,
    order: [u8; Polyhedron::MAX_VERTICES],
    len: usize,
}

impl Face<'_> {
    /// The face's plane; its normal points into the body.
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
