//! Tessellation for paraboloid maps: meshes cut so finely that a light sees every edge under a small angle.

use crate::error::{InputError, InputErrorKind, check};
use crate::input::numbers::vector;
use crate::math::angle;
use glam::{DVec2, DVec3};
use spade::handles::DirectedEdgeHandle;
use spade::{DelaunayTriangulation, HasPosition, Point2, Triangulation};
use std::collections::{BinaryHeap, HashMap};
use std::ops::Range;
use std::vec::Vec;

/// Cuts triangles until a light at a position sees none of their edges under more than an angle, as a paraboloid map
/// needs it: it draws straight edges where the mesh's are arcs
/// ([`Paraboloid::largest_edge`](crate::omni::Paraboloid::largest_edge)).
///
/// ```text
///     ∗ light                       an edge is cut into as many parts as it takes, of equal angles from the
///     |\ \  \                       light, by a rule that depends on its two ends only: triangles on both
///     | \  \   \                    sides of it are cut at the same points, to the last bit, whether they
///     |  \   \     \                share vertices or have vertices of their own at the same places
///     ●---○----○-------● edge
/// ```
///
/// Inside of a triangle the longest edge by angle is halved until none is too long; the triangulation is Delaunay's
/// throughout (by spade, with exact predicates).
///
/// # Guarantees
///
/// - Every edge is seen under at most the angle, but for edges with both ends nearer to the light than its near
///   distance, where nothing casts, and for those no longer than a step or two of 2⁻⁴⁰ of the triangle they are in.
/// - No vertex lies on an edge of another triangle that did not lie there before: a closed mesh stays closed.
/// - Triangles keep their side, and those that need no cut are left as they are.
/// - Triangles without area are cut as their edges are, so that they still close what they closed.
///
/// ```
/// use shadowfit::mesh::Tessellator;
/// use shadowfit::glam::DVec3;
///
/// let floor = [DVec3::new(-4.0, 0.0, -4.0), DVec3::new(0.0, 0.0, 4.0), DVec3::new(4.0, 0.0, -4.0)];
/// let fine = Tessellator::new((0.0, 2.0, 0.0), 0.1, 0.5)?.tessellate(&floor, &[[0, 1, 2]])?;
/// let positions: Vec<_> = floor.into_iter().chain(fine.added.iter().map(|added| added.position)).collect();
/// assert!(fine.triangles.len() > 1 && fine.sources.iter().all(|&source| source == 0));
/// assert!(fine.triangles.iter().flatten().all(|&index| (index as usize) < positions.len()));
/// # Ok::<(), shadowfit::InputError>(())
/// ```
#[doc(alias = "subdivide")]
#[doc(alias = "refine")]
#[doc(alias = "tessellation")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tessellator {
    light: DVec3,
    near: f64,
    angle: f64,
    limit: usize,
}

/// A tessellated mesh: its vertices are those of the original mesh, in their order, and after them `added`.
#[derive(Clone, Debug, PartialEq)]
pub struct Tessellation {
    /// The new vertices.
    pub added: Vec<NewVertex>,
    /// The triangles, as indices of vertices.
    pub triangles: Vec<[u32; 3]>,
    /// For each triangle, the index of the triangle that it is a part of.
    pub sources: Vec<u32>,
}

/// A vertex that tessellation added.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct NewVertex {
    /// Where it is, in world space.
    pub position: DVec3,
    /// The vertices of the mesh that it lies between; on an edge, the second and third are the same.
    pub corners: [u32; 3],
    /// How much of each is in it: attributes of the vertex are sums of theirs by these weights. They sum to 1.
    pub weights: [f64; 3],
}

impl Tessellator {
    /// The default limit on the number of resulting triangles, 2²⁰; see [`Self::with_limit`].
    pub const DEFAULT_LIMIT: u32 = 1 << 20;

    /// A tessellator for a light at a position, the distance from it within which nothing casts, in world units, and the
    /// largest angle of edges, in radians.
    ///
    /// # Errors
    ///
    /// Names the field that is not finite or too large, `"near"` when it is not positive, and `"angle"` when it is not
    /// positive or more than a right angle.
    ///
    /// ```
    /// use shadowfit::mesh::Tessellator;
    ///
    /// assert!(Tessellator::new((0.0, 2.0, 0.0), 0.1, 0.5).is_ok());
    /// assert!(Tessellator::new((0.0, 2.0, 0.0), 0.1, 90.0).is_err()); // radians
    /// ```
    pub fn new<F: Into<f64>>(light: impl Into<[F; 3]>, near: f64, angle: f64) -> Result<Self, InputError> {
        let light = check::point("light", vector(light))?;
        let near = check::distance("near", near)?;
        if !(angle > 0.0 && angle <= core::f64::consts::FRAC_PI_2) {
            return check::fail("angle", InputErrorKind::AngleOutOfRange);
        }
        Ok(Self { light, near, angle, limit: Self::DEFAULT_LIMIT as usize })
    }

    /// The same tessellator with another limit on the number of resulting triangles.
    ///
    /// ```
    /// use shadowfit::{glam::DVec3, mesh::Tessellator};
    ///
    /// let floor = [DVec3::new(-4.0, 0.0, -4.0), DVec3::new(0.0, 0.0, 4.0), DVec3::new(4.0, 0.0, -4.0)];
    /// let fine = Tessellator::new((0.0, 2.0, 0.0), 0.1, 0.05)?;
    /// assert!(fine.with_limit(10).tessellate(&floor, &[[0, 1, 2]]).is_err());
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub const fn with_limit(self, triangles: u32) -> Self {
        Self { limit: triangles as usize, ..self }
    }

    /// Cuts a mesh.
    ///
    /// # Errors
    ///
    /// Names `"positions"` when one is not finite or too large, `"triangles"` when one has an index without a position
    /// ([`InputErrorKind::OutOfRange`]), and either when the result would exceed the limit ([`InputErrorKind::TooMany`]).
    ///
    /// ```
    /// use shadowfit::{glam::DVec3, mesh::Tessellator};
    ///
    /// let floor = [DVec3::new(-4.0, 0.0, -4.0), DVec3::new(0.0, 0.0, 4.0), DVec3::new(4.0, 0.0, -4.0)];
    /// let tessellator = Tessellator::new((0.0, 2.0, 0.0), 0.1, 0.5)?;
    /// let fine = tessellator.tessellate(&floor, &[[0, 1, 2]])?;
    /// let (at, from) = (fine.added[0].position, fine.added[0].corners.map(|corner| floor[corner as usize]));
    /// let sum = from[0] * fine.added[0].weights[0] + from[1] * fine.added[0].weights[1] + from[2] * fine.added[0].weights[2];
    /// assert!(at.distance(sum) < 1e-9); // attributes are interpolated the same way
    /// assert!(tessellator.tessellate(&floor, &[[0, 1, 3]]).is_err());
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    pub fn tessellate(&self, positions: &[DVec3], triangles: &[[u32; 3]]) -> Result<Tessellation, InputError> {
        // All vertices, with as many added as there may be triangles and more, have an index.
        if positions.len() > u32::MAX as usize / 2 {
            return check::fail("positions", InputErrorKind::TooMany);
        }
        for (index, &position) in positions.iter().enumerate() {
            check::point("positions", position).map_err(|error| error.of_list("positions", index))?;
        }
        let mut work = Work {
            refiner: self,
            positions,
            refined: Tessellation { added: Vec::new(), triangles: Vec::new(), sources: Vec::new() },
            cuts: HashMap::new(),
        };
        for (source, &triangle) in (0..).zip(triangles) {
            if triangle.iter().any(|&index| index as usize >= positions.len()) {
                return Err(
                    InputError::new("triangles", InputErrorKind::OutOfRange).of_list("triangles", source as usize)
                );
            }
            work.triangle(triangle, source)?;
        }
        Ok(work.refined)
    }

    /// The angle between two points as the light sees them, or 0 where nothing between them casts or one is the light
    /// itself: an edge that begins there is seen as a point.
    fn angle_between(&self, a: DVec3, b: DVec3) -> f64 {
        let (a, b) = (a - self.light, b - self.light);
        if a.length() < self.near && b.length() < self.near {
            return 0.0;
        }
        angle::of_vector(a.dot(b), a.cross(b).length())
    }

    /// Whether an edge must be cut.
    fn is_long(&self, a: DVec3, b: DVec3) -> bool {
        self.angle_between(a, b) > self.angle
    }

    /// Where to cut an edge, in steps from its first end, in order.
    fn cuts(&self, edge: &Edge) -> Result<Vec<u64>, InputError> {
        let mut cuts = Vec::new();
        let angle = self.angle_between(edge.first, edge.last);
        // A little more than as many parts as needed, so that rounding the cuts makes none of them too long.
        const SPARE: f64 = 1.0 + 1.0 / 1_048_576.0;
        let parts = (angle / self.angle * SPARE).ceil();
        if angle <= self.angle {
            return Ok(cuts);
        }
        if parts >= self.limit as f64 {
            return check::fail("triangles", InputErrorKind::TooMany);
        }
        let (first, last) = ((edge.first - self.light).length(), (edge.last - self.light).length());
        let mut done = 0;
        for part in 1..=parts as u32 {
            // The ray at an angle φ from the first end meets the edge where it divides it as |a| sin φ to |b| sin(θ − φ).
            let turned = angle * f64::from(part) / parts;
            let before = first * angle::sine_cosine(turned).0;
            let after = last * angle::sine_cosine(angle - turned).0;
            let part = if turned < angle { before / (before + after) } else { 1.0 };
            let cut = steps(part).clamp(done, STEPS);
            self.halve(edge, done..cut, &mut cuts)?;
            if cut > done && cut < STEPS {
                cuts.push(cut);
            }
            done = cut;
        }
        Ok(cuts)
    }

    /// Halves parts that are still too long: where an edge passes the light closely, rounding moves the cuts.
    fn halve(&self, edge: &Edge, part: Range<u64>, cuts: &mut Vec<u64>) -> Result<(), InputError> {
        let middle = part.start.midpoint(part.end);
        if middle == part.start || !self.is_long(edge.at(part.start), edge.at(part.end)) {
            return Ok(());
        }
        if cuts.len() >= self.limit {
            return check::fail("triangles", InputErrorKind::TooMany);
        }
        self.halve(edge, part.start..middle, cuts)?;
        cuts.push(middle);
        self.halve(edge, middle..part.end, cuts)
    }
}

/// The steps that an edge is divided into. Places are whole numbers of them, so that a vertex on an edge is on it
/// exactly.
const STEPS: u64 = 1 << 40;

fn steps(part: f64) -> u64 {
    // NaN becomes 0.
    (part * STEPS as f64).round() as u64
}

fn part(steps: u64) -> f64 {
    steps as f64 / STEPS as f64
}

/// An edge between two positions, whichever triangle it is looked at from.
struct Edge {
    first: DVec3,
    last: DVec3,
    /// The vertices, in the same order.
    ends: [u32; 2],
}

impl Edge {
    fn at(&self, steps: u64) -> DVec3 {
        if steps == STEPS { self.last } else { self.first + (self.last - self.first) * part(steps) }
    }
}

/// A vertex within a triangle: steps from the first corner towards the second and the third, and its place in a plane where
/// the triangle is drawn.
#[derive(Clone, Copy)]
struct Inside {
    steps: [u64; 2],
    /// The index of the vertex; none yet for a new one inside.
    index: Option<u32>,
    /// Where the third corner is drawn, see [`Work::third`].
    third: DVec2,
}

impl HasPosition for Inside {
    type Scalar = f64;
    /// An affine map of the steps, without any rounding: 40 bits times 12 are 52. So the corners and all that is on the
    /// edges between them bound a convex polygon, a triangle, and its triangulation has all of their parts as its edges.
    fn position(&self) -> Point2<f64> {
        let [second, third] = self.steps.map(|steps| steps as f64);
        Point2::new(second + third * self.third.x, third * self.third.y)
    }
}

impl Inside {
    fn weights(&self) -> [f64; 3] {
        let [second, third] = self.steps;
        [STEPS.saturating_sub(second + third), second, third].map(part)
    }

    /// Whether it is on none of the edges.
    fn is_inside(&self) -> bool {
        let [second, third] = self.steps;
        second > 0 && third > 0 && second + third < STEPS
    }
}

/// A mesh being cut.
struct Work<'a> {
    refiner: &'a Tessellator,
    positions: &'a [DVec3],
    refined: Tessellation,
    /// The vertices on each edge that was cut, in its order, with their steps.
    cuts: HashMap<[u32; 2], Vec<(u64, u32)>>,
}

impl Work<'_> {
    fn triangle(&mut self, triangle: [u32; 3], source: u32) -> Result<(), InputError> {
        let corners = self.longest_first(triangle);
        let [a, b, c] = corners.map(|index| self.position(index));
        let third = Self::third(a, b, c);
        let inside = |steps, index| Inside { steps, index: Some(index), third };
        let [first, second, last] = corners;
        let mut vertices = Vec::from([inside([0, 0], first), inside([STEPS, 0], second), inside([0, STEPS], last)]);
        for side in 0..3 {
            let (edge, turned) = self.edge(corners[side], corners[(side + 1) % 3]);
            for &(cut, index) in self.cut(&edge)? {
                let along = if turned { STEPS - cut } else { cut };
                let steps = [[along, 0], [STEPS - along, along], [0, STEPS - along]][side];
                vertices.push(inside(steps, index));
            }
        }
        if vertices.len() == 3 { self.push(triangle, source) } else { self.fill(corners, vertices, source) }
    }

    /// The same triangle with its longest edge first, which spoils the least when it is drawn with few digits.
    fn longest_first(&self, [a, b, c]: [u32; 3]) -> [u32; 3] {
        let length = |a, b| self.position(a).distance_squared(self.position(b));
        let (ab, bc, ca) = (length(a, b), length(b, c), length(c, a));
        if ab >= bc && ab >= ca {
            [a, b, c]
        } else if bc >= ca {
            [b, c, a]
        } else {
            [c, a, b]
        }
    }

    /// Where the third corner is drawn when the others are at 0 and 1: as in the triangle itself, to twelve bits, and off the
    /// line between the others even if it is on it. Nothing but the look of the triangulation depends on it.
    fn third(a: DVec3, b: DVec3, c: DVec3) -> DVec2 {
        const FINENESS: f64 = 4096.0;
        let (along, across) = (b - a, c - a);
        let square = along.length_squared();
        if square == 0.0 {
            return DVec2::new(0.0, 1.0);
        }
        let drawn = DVec2::new(across.dot(along), across.cross(along).length()) / square;
        let drawn = (drawn.clamp(DVec2::ZERO, DVec2::ONE) * FINENESS).round();
        drawn.max(DVec2::new(0.0, 1.0)) / FINENESS
    }

    /// A position of the mesh, with the one zero for both.
    fn position(&self, index: u32) -> DVec3 {
        self.positions[index as usize] + DVec3::ZERO
    }

    /// The edge between two vertices, in the order of their coordinates, and whether that is the other way round.
    fn edge(&self, from: u32, to: u32) -> (Edge, bool) {
        let (a, b) = (self.position(from), self.position(to));
        // Vertices at one place leave nothing to cut, but one name for the edge.
        let turned = (b.to_array(), to) < (a.to_array(), from);
        let edge = Edge { first: a, last: b, ends: [from, to] };
        (if turned { Edge { first: b, last: a, ends: [to, from] } } else { edge }, turned)
    }

    /// The vertices on an edge.
    fn cut(&mut self, edge: &Edge) -> Result<&[(u64, u32)], InputError> {
        if !self.cuts.contains_key(&edge.ends) {
            let cuts = self.refiner.cuts(edge)?;
            let [first, last] = edge.ends;
            let mut vertices = Vec::with_capacity(cuts.len());
            for cut in cuts {
                let weights = [part(STEPS - cut), part(cut), 0.0];
                let added = NewVertex { position: edge.at(cut), corners: [first, last, last], weights };
                vertices.push((cut, self.add(added)?));
            }
            self.cuts.insert(edge.ends, vertices);
        }
        Ok(self.cuts.get(&edge.ends).map_or(&[], |vertices| vertices))
    }

    fn add(&mut self, added: NewVertex) -> Result<u32, InputError> {
        // A vertex is in a triangle and cuts one in two, but those on edges may be counted ahead of their triangles.
        if self.refined.added.len() >= self.refiner.limit {
            return check::fail("triangles", InputErrorKind::TooMany);
        }
        self.refined.added.push(added);
        Ok((self.positions.len() + self.refined.added.len() - 1) as u32)
    }

    fn push(&mut self, triangle: [u32; 3], source: u32) -> Result<(), InputError> {
        if self.refined.triangles.len() >= self.refiner.limit {
            return check::fail("triangles", InputErrorKind::TooMany);
        }
        self.refined.triangles.push(triangle);
        self.refined.sources.push(source);
        Ok(())
    }

    /// Triangulates the inside of a triangle between the vertices on its edges, with more vertices inside as needed.
    fn fill(&mut self, corners: [u32; 3], vertices: Vec<Inside>, source: u32) -> Result<(), InputError> {
        // Coordinates are whole numbers and multiples of 2⁻¹², which spade takes.
        let too_many = |_| InputError::new("triangles", InputErrorKind::TooMany);
        let mut triangulation = DelaunayTriangulation::<Inside>::bulk_load_stable(vertices).map_err(too_many)?;
        let place = |inside: &Inside| {
            let [a, b, c] = corners.map(|index| self.position(index));
            let [_, second, third] = inside.weights();
            a + (b - a) * second + (c - a) * third
        };
        let long = |from: &Inside, to: &Inside| {
            let angle = self.refiner.angle_between(place(from), place(to));
            // Angles are not negative, and their bits are in their order.
            (angle > self.refiner.angle).then_some(angle.to_bits())
        };

        // The edges that are too long, the longest on top. Some are gone by the time they come up, and their handles are
        // those of others then: an edge is known by its ends.
        let mut queue = BinaryHeap::new();
        let enter = |edge: DirectedEdgeHandle<'_, Inside, (), (), ()>, queue: &mut BinaryHeap<_>| {
            let (from, to) = (edge.from(), edge.to());
            if let Some(angle) = long(from.data(), to.data()) {
                queue.push((angle, edge.fix(), [from.index(), to.index()]));
            }
        };
        for edge in triangulation.undirected_edges().filter(|edge| !edge.is_part_of_convex_hull()) {
            enter(edge.as_directed(), &mut queue);
        }
        while let Some((_, edge, ends)) = queue.pop() {
            let edge = triangulation.directed_edge(edge);
            if [edge.from().index(), edge.to().index()] != ends {
                continue;
            }
            let Some(middle) = self.halfway(edge.from().data(), edge.to().data(), place) else { continue };
            let beside = edge.from().fix();
            if self.refined.triangles.len() + triangulation.num_inner_faces() > self.refiner.limit {
                return check::fail("triangles", InputErrorKind::TooMany);
            }
            let count = triangulation.num_vertices();
            let vertex = triangulation.insert_with_hint(middle, beside).map_err(too_many)?;
            // A vertex may be there already, a step or so beside the edge: then that cannot be cut more finely.
            if triangulation.num_vertices() == count {
                continue;
            }
            // All new edges begin at the new vertex, and none of them is on the boundary.
            for edge in triangulation.vertex(vertex).out_edges() {
                enter(edge, &mut queue);
            }
        }

        let mut indices = Vec::with_capacity(triangulation.num_vertices());
        for vertex in triangulation.vertices() {
            let inside = vertex.data();
            let added = NewVertex { position: place(inside), corners, weights: inside.weights() };
            indices.push((inside.index, added));
        }
        let mut names = Vec::with_capacity(indices.len());
        for (index, added) in indices {
            names.push(match index {
                Some(index) => index,
                None => self.add(added)?,
            });
        }
        for face in triangulation.inner_faces() {
            self.push(face.vertices().map(|vertex| names[vertex.index()]), source)?;
        }
        Ok(())
    }

    /// A vertex inside of the triangle on the edge between two others, where the light sees either half under the same
    /// angle: by the bisector theorem it divides the edge as the distances of its ends do.
    fn halfway(&self, a: &Inside, b: &Inside, place: impl Fn(&Inside) -> DVec3) -> Option<Inside> {
        let [from, to] = [a, b].map(|end| place(end).distance(self.refiner.light));
        let along = from / (from + to);
        let mix = |a: u64, b: u64| (a as f64 + (b as f64 - a as f64) * along).round() as u64;
        let steps = [mix(a.steps[0], b.steps[0]), mix(a.steps[1], b.steps[1])];
        let middle = Inside { steps, index: None, third: a.third };
        (middle.is_inside() && steps != a.steps && steps != b.steps).then_some(middle)
    }
}
