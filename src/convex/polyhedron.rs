//! The clipper: a convex polyhedron held as vertices that know their planes.

use super::Plane;
use glam::DVec3;

/// The set of planes a vertex lies on, one bit each.
pub(crate) type PlaneSet = u64;

/// A vertex and the planes it lies on by construction: three of them, or more where planes coincide.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Vertex {
    pub(crate) position: DVec3,
    pub(crate) planes: PlaneSet,
}

/// A bounded convex polyhedron with room for `N` vertices; no vertex at all is the empty set.
///
/// There is no mesh. Two vertices are the ends of an edge when they share two planes, so clipping needs only the
/// vertices and, for each, its set of planes:
///
/// ```text
///     inside                          every pair (inside, outside) that shares two planes
///   ────●─────────●────  clip plane   is a cut edge; its new vertex lies on those two planes
///       ╎         ╎                   and on the clip plane
///    outside   outside
/// ```
///
/// # Guarantees
///
/// - A new vertex lies on a segment between two old ones, so that rounding cannot carry it away: clipping never
///   leaves the body it started from by more than a rounding, whatever the planes.
/// - A vertex exactly on a clip plane counts as inside, which is what moving the plane outwards by an infinitesimal
///   would do. The combinatorics is therefore that of a simple polyhedron, `F` planes having at most `2F − 4` vertices,
///   and flat bodies, segments and points are ordinary bodies with coincident vertices.
/// - Only comparisons with zero decide, no tolerance: scaling everything by a power of two changes no decision.
#[derive(Clone, Debug)]
pub(crate) struct Polyhedron<const N: usize> {
    vertices: [Vertex; N],
    distances: [f64; N],
    len: usize,
}

impl<const N: usize> Polyhedron<N> {
    const EMPTY: Self = Self {
        vertices: [Vertex { position: DVec3::ZERO, planes: 0 }; N],
        distances: [0.0; N],
        len: 0,
    };

    /// A box with the planes of [`box_planes`] as bits 0 to 5. The box may be flat.
    pub(crate) fn from_box(min: DVec3, max: DVec3) -> Self {
        let mut body = Self::EMPTY;
        for (corner, vertex) in body.vertices.iter_mut().take(8).enumerate() {
            let (x, y, z) = (corner & 1, corner >> 1 & 1, corner >> 2);
            vertex.position = DVec3::new([min.x, max.x][x], [min.y, max.y][y], [min.z, max.z][z]);
            vertex.planes = 1 << x | 4 << y | 16 << z;
        }
        body.len = 8;
        body
    }

    /// A body from vertices that already know their planes, or empty when there is no room for them.
    pub(crate) fn from_vertices(vertices: &[Vertex]) -> Self {
        let mut body = Self::EMPTY;
        if let Some(room) = body.vertices.get_mut(..vertices.len()) {
            room.copy_from_slice(vertices);
            body.len = vertices.len();
        }
        body
    }

    pub(crate) fn vertices(&self) -> &[Vertex] {
        &self.vertices[..self.len]
    }

    pub(crate) fn positions(&self) -> impl ExactSizeIterator<Item = DVec3> + Clone + '_ {
        self.vertices().iter().map(|vertex| vertex.position)
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// Keeps what lies inside `plane`, whose bit is `bit`.
    ///
    /// Where a degenerate body would need more than `N` vertices the plane is left out: the body is then larger than
    /// it might be, never smaller.
    pub(crate) fn clip(&mut self, plane: &Plane, bit: PlaneSet) {
        let len = self.len;
        let (vertices, distances) = (&mut self.vertices, &mut self.distances);
        let mut inside = 0;
        for (vertex, distance) in vertices[..len].iter().zip(&mut distances[..len]) {
            *distance = plane.at(vertex.position);
            inside += usize::from(*distance >= 0.0);
        }
        if inside == len {
            return;
        }
        if inside == 0 {
            self.len = 0;
            return;
        }

        // Inside vertices to the front.
        let mut last = len;
        for first in 0..inside {
            if distances[first] < 0.0 {
                last -= 1;
                while distances[last] < 0.0 {
                    last -= 1;
                }
                vertices.swap(first, last);
                distances.swap(first, last);
            }
        }

        let mut end = len;
        for outer in inside..len {
            let below = vertices[outer];
            let below_distance = distances[outer];
            for inner in 0..inside {
                let shared = vertices[inner].planes & below.planes;
                // Two bits at least.
                if shared & shared.wrapping_sub(1) != 0 {
                    if end == N {
                        return;
                    }
                    let above = vertices[inner].position;
                    let t = distances[inner] / (distances[inner] - below_distance);
                    vertices[end] =
                        Vertex { position: above + (below.position - above) * t, planes: shared | bit };
                    end += 1;
                }
            }
        }
        vertices.copy_within(len..end, inside);
        self.len = inside + end - len;
    }
}

/// The six planes of a box, in the order of the bits that [`Polyhedron::from_box`] sets.
pub(crate) fn box_planes(min: DVec3, max: DVec3) -> [Plane; 6] {
    [
        Plane::new(DVec3::X, -min.x),
        Plane::new(DVec3::NEG_X, max.x),
        Plane::new(DVec3::Y, -min.y),
        Plane::new(DVec3::NEG_Y, max.y),
        Plane::new(DVec3::Z, -min.z),
        Plane::new(DVec3::NEG_Z, max.z),
    ]
}
