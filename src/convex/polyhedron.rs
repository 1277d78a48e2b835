//! The clipper: a convex polyhedron as a graph of vertices, each on three planes and with three neighbours.

use super::{Plane, bits::Bits};
use glam::DVec3;

/// The name of a plane of a body: a number below [`Polyhedron::MAX_PLANES`].
pub(crate) type PlaneId = u8;

/// A vertex, the three planes that it lies on, and its neighbours. The k-th neighbour is at the other end of the edge on the two
/// planes other than the k-th.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Vertex {
    pub(crate) position: DVec3,
    pub(crate) planes: [PlaneId; 3],
    neighbours: [u8; 3],
}

/// A bounded convex polyhedron with room for 64 vertices; without vertices it is the empty set.
///
/// It is stored as the graph of its vertices and edges. A cut replaces the vertices outside of a plane by one new vertex for each
/// edge that crosses the plane:
///
/// ```text
///       inside                          a new vertex lies on the two planes of its edge and on the
///     ●────────●                        clip plane; its neighbours are the inside end of its edge and,
///     │        │                        for each of the two planes, the other new vertex on that plane
///   ──○────────○──── clip plane
///     ╎        ╎
///     outside
/// ```
///
/// # Guarantees
///
/// - A new vertex lies on a segment between two old ones: whatever the planes, clipping leaves the old body by no more than a
///   rounding.
/// - A vertex exactly on a clip plane counts as inside, as if the plane were moved outwards by an infinitesimal. So every vertex is
///   on three planes, `F` planes have at most `2F − 4` vertices, and flat bodies, segments and points are bodies with coincident
///   vertices, no special cases.
/// - All decisions are comparisons with zero, without tolerance: scaling by a power of two changes none of them.
/// - The hull of the vertices contains, exactly, every point of the box inside all planes as they were before being
///   [loosened](Plane::loosened): `docs/numerics.md` has the proof, "Why no cut loses a point".
#[derive(Clone, Debug)]
pub(crate) struct Polyhedron {
    vertices: [Vertex; Self::MAX_VERTICES],
    /// The value of the last clip plane at each vertex: scratch space.
    values: [f64; Self::MAX_VERTICES],
    /// The slots in use.
    alive: u64,
}

impl Polyhedron {
    /// The number of slots. A box, seven planes of a light and ten of a hull make at most `2 · 23 − 4 = 42` vertices, and the last cut
    /// at most 22 new ones besides the 40 before it. Scenes of many cuts, lights within planes and hulls of oblique views may have
    /// more: a plane that finds no room does not cut.
    pub(crate) const MAX_VERTICES: usize = 64;
    /// The number of names for planes.
    pub(crate) const MAX_PLANES: usize = 64;

    pub(crate) const EMPTY: Self = Self {
        vertices: [Vertex { position: DVec3::ZERO, planes: [0; 3], neighbours: [0; 3] }; Self::MAX_VERTICES],
        values: [0.0; Self::MAX_VERTICES],
        alive: 0,
    };

    /// A box, with its planes named by their index in [`box_planes`]. The box may be flat.
    pub(crate) fn from_box(min: DVec3, max: DVec3) -> Self {
        let mut body = Self::EMPTY;
        body.set_box(min, max);
        body
    }

    /// Sets the body to the empty set.
    pub(crate) const fn clear(&mut self) {
        self.alive = 0;
    }

    /// Sets the body to a box, see [`Self::from_box`].
    pub(crate) fn set_box(&mut self, min: DVec3, max: DVec3) {
        for (corner, vertex) in (0..8).zip(&mut self.vertices) {
            let (x, y, z) = (corner & 1, corner >> 1 & 1, corner >> 2);
            let pick = |side: u8, min: f64, max: f64| if side == 0 { min } else { max };
            *vertex = Vertex {
                position: DVec3::new(pick(x, min.x, max.x), pick(y, min.y, max.y), pick(z, min.z, max.z)),
                planes: [x, 2 + y, 4 + z],
                neighbours: [corner ^ 1, corner ^ 2, corner ^ 4],
            };
        }
        self.alive = 0xff;
    }

    /// Adds the vertices and edges of another body, to list those of several; the result must not be clipped. Returns false, and
    /// changes nothing, where there is no room.
    pub(crate) fn append(&mut self, other: &Self) -> bool {
        let mut free = Bits(!self.alive);
        if free.0.count_ones() < other.alive.count_ones() {
            return false;
        }
        let mut slots = [NOBODY; Self::MAX_VERTICES];
        for (old, new) in Bits(other.alive).zip(&mut free) {
            slots[old & LAST] = new as u8;
        }
        for old in Bits(other.alive) {
            let (vertex, new) = (other.vertices[old & LAST], usize::from(slots[old & LAST]));
            let neighbours = vertex.neighbours.map(|one| slots[usize::from(one) & LAST]);
            self.vertices[new & LAST] = Vertex { neighbours, ..vertex };
            self.alive |= 1 << new;
        }
        true
    }

    /// The number of vertices.
    pub(crate) const fn len(&self) -> u32 {
        self.alive.count_ones()
    }

    pub(crate) fn vertices(&self) -> impl Iterator<Item = &Vertex> + Clone {
        Bits(self.alive).map(|slot| &self.vertices[slot & LAST])
    }

    pub(crate) fn positions(&self) -> impl Iterator<Item = DVec3> + Clone {
        self.vertices().map(|vertex| vertex.position)
    }

    pub(crate) const fn is_empty(&self) -> bool {
        self.alive == 0
    }

    /// Cuts off the part outside of `plane`, which gets the name `id`. A plane that needs more vertices than there are slots is left
    /// out: the body is then larger than the exact one, never smaller.
    pub(crate) fn clip(&mut self, plane: &Plane, id: PlaneId) {
        let mut inside = 0_u64;
        for slot in Bits(self.alive) {
            let value = plane.at(self.vertices[slot & LAST].position);
            self.values[slot & LAST] = value;
            // NaN is outside.
            inside |= u64::from(value >= 0.0) << slot;
        }
        let outside = self.alive & !inside;
        if outside != 0 {
            self.cut(inside, outside, id);
        }
    }

    /// Replaces the outside vertices.
    fn cut(&mut self, inside: u64, outside: u64, id: PlaneId) {
        let mut free = Bits(!self.alive);
        if self.crossings(inside, outside) > free.0.count_ones() {
            return;
        }

        // For each plane, the new vertex on it that is not yet joined to another.
        let mut waiting = [NOBODY; Self::MAX_PLANES];
        self.alive = inside;
        for outer in Bits(outside) {
            let below = self.vertices[outer & LAST];
            for k in 0..3 {
                let inner = usize::from(below.neighbours[k]) & LAST;
                if inside >> inner & 1 == 0 {
                    continue;
                }
                let Some(slot) = free.next() else { return };
                let above = &mut self.vertices[inner];
                let (p, q) = (below.planes[(k + 1) % 3], below.planes[(k + 2) % 3]);
                above.replace_neighbour([p, q], slot as u8);
                let position =
                    between((above.position, self.values[inner]), (below.position, self.values[outer & LAST]));
                // Its own neighbour, which is no edge, until it is joined.
                let mut neighbours = [inner as u8, slot as u8, slot as u8];
                // The edge on p and the clip plane is opposite to q, and the other way round.
                for (on, across) in [(p, 2), (q, 1)] {
                    let waits = &mut waiting[usize::from(on) & LAST];
                    if *waits == NOBODY {
                        *waits = slot as u8;
                    } else {
                        neighbours[across] = *waits;
                        let other = &mut self.vertices[usize::from(*waits) & LAST];
                        let theirs = if other.planes[1] == on { 2 } else { 1 };
                        other.neighbours[theirs] = slot as u8;
                        *waits = NOBODY;
                    }
                }
                self.vertices[slot & LAST] = Vertex { position, planes: [id, p, q], neighbours };
                self.alive |= 1 << slot;
            }
        }
    }

    /// The number of edges between inside and outside vertices.
    fn crossings(&self, inside: u64, outside: u64) -> u32 {
        let mut crossings = 0;
        for slot in Bits(outside) {
            let [a, b, c] = self.vertices[slot & LAST].neighbours;
            crossings += (inside >> a & 1) + (inside >> b & 1) + (inside >> c & 1);
        }
        crossings as u32
    }
}

impl Vertex {
    /// Replaces the neighbour along the edge on the planes `p` and `q`. It is found by the planes, not by its slot, because two
    /// vertices may be neighbours along two edges.
    fn replace_neighbour(&mut self, [p, q]: [PlaneId; 2], new: u8) {
        for (neighbour, across) in self.neighbours.iter_mut().zip(self.planes) {
            if across != p && across != q {
                *neighbour = new;
            }
        }
    }
}

/// The zero of a linear function with opposite signs at the ends of an edge, computed from the nearer end: rounding moves it off the
/// edge by at most three roundings of the largest coordinates.
fn between((a, at_a): (DVec3, f64), (b, at_b): (DVec3, f64)) -> DVec3 {
    let from = |(near, at_near): (DVec3, f64), (far, at_far): (DVec3, f64)| {
        near + (far - near) * (at_near / (at_near - at_far))
    };
    if at_a.abs() <= at_b.abs() { from((a, at_a), (b, at_b)) } else { from((b, at_b), (a, at_a)) }
}

/// The last slot, as a mask: indices masked with it need no bounds check, as slots and planes are below 64.
const LAST: usize = Polyhedron::MAX_VERTICES - 1;

/// No slot.
const NOBODY: u8 = u8::MAX;

/// The six planes of a box, in the order of their names in [`Polyhedron::from_box`].
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

#[cfg(test)]
mod tests {
    extern crate std;

    use super::*;
    use proptest::prelude::*;
    use std::vec::Vec;

    /// What the proof rests on: each edge is known at both ends as the one on the same two planes.
    fn assert_graph(body: &Polyhedron) {
        for slot in Bits(body.alive) {
            let vertex = &body.vertices[slot];
            for k in 0..3 {
                let edge = [vertex.planes[(k + 1) % 3], vertex.planes[(k + 2) % 3]];
                let other = &body.vertices[usize::from(vertex.neighbours[k])];
                assert!(body.alive >> vertex.neighbours[k] & 1 == 1, "{slot} is joined to nobody");
                let across = (0..3).find(|&j| !edge.contains(&other.planes[j]));
                let back = across.map(|j| usize::from(other.neighbours[j]));
                assert!(edge.iter().all(|plane| other.planes.contains(plane)), "{vertex:?}, {other:?}");
                assert_eq!(back, Some(slot), "the edge on {edge:?}");
            }
        }
    }

    /// Planes through small integers: most pass vertices, edges and faces, and many are there twice.
    fn lattice_plane() -> impl Strategy<Value = Plane> {
        let small = || prop::array::uniform3((-2..=2_i8).prop_map(f64::from));
        (small(), small()).prop_map(|(normal, point)| Plane::through(normal.into(), point.into()))
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 4000, failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn edges_are_the_same_from_both_ends(
            flat in prop::array::uniform3(any::<bool>()),
            planes in prop::collection::vec(lattice_plane(), 0..20),
            step in prop_oneof![Just(0.0), Just(f64::EPSILON), Just(1e-12)],
        ) {
            let half = DVec3::from(flat.map(|flat| if flat { 0.0 } else { 2.0 }));
            let mut body = Polyhedron::from_box(-half, half);
            assert_graph(&body);
            for (id, plane) in (6..).zip(planes) {
                // Moved a little, vertices fall on either side of planes that pass them.
                body.clip(&Plane::new(plane.normal, plane.offset + step * f64::from(id % 3)), id);
                assert_graph(&body);
            }
        }

        /// More planes about a ball than there is room for vertices: some are left out, and the ball stays in.
        #[test]
        fn planes_that_find_no_room_are_left_out(
            normals in prop::collection::vec(prop::array::uniform3(-1.0..1.0), 58),
        ) {
            let mut body = Polyhedron::from_box(DVec3::splat(-1.25), DVec3::splat(1.25));
            let normals: Vec<DVec3> = normals.iter().filter_map(|n| DVec3::from(*n).try_normalize()).collect();
            for (id, normal) in (6..).zip(&normals) {
                body.clip(&Plane::new(*normal, 1.0), id);
                assert_graph(&body);
                for direction in normals.iter().chain(&DVec3::AXES) {
                    let reach = body.positions().map(|point| point.dot(*direction)).fold(f64::NEG_INFINITY, f64::max);
                    prop_assert!(reach >= 1.0 - 1e-12, "{direction}: {reach}");
                }
            }
            prop_assert!(body.alive.count_ones() > 48, "room for more");
        }
    }
}
