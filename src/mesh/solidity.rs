//! Whether a mesh is watertight, inverted or open.

extern crate alloc;

use crate::error::{InputError, InputErrorKind, check};
use crate::input::numbers::vector;
use alloc::vec::Vec;
use glam::DVec3;

/// Whether a mesh encloses a volume, which decides the faces that a second-depth map is drawn with.
///
/// A mesh is **closed** where each edge is run along as often in one direction as in the other: a ray that comes from outside
/// and goes on for ever leaves as often as it enters, which is all that culling needs. A mesh with two faces on every edge,
/// wound alike, is closed; so are two boxes that touch along an edge, which then has four. Vertices count as one where their
/// positions are equal to the last bit (0 and −0 are equal), since meshes have several vertices in one place for normals or
/// textures that differ.
#[doc(alias = "watertight")]
#[doc(alias = "manifold")]
#[doc(alias = "closed mesh")]
#[doc(alias = "two-manifold")]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Solidity {
    /// Closed, with the fronts of its triangles (counter-clockwise) outwards.
    Watertight,
    /// Closed, with the fronts inwards.
    Inverted,
    /// An open sheet, a mesh with a hole, or one with inconsistent winding: it has no inside.
    Open,
}

/// The result of [`Solidity::of`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SolidityReport {
    /// The verdict on all of it. A mesh is culled as a whole, so one open part makes it open.
    pub solidity: Solidity,
    /// The number of parts that share no vertex.
    pub parts: usize,
    /// Closed parts whose fronts look the other way than the whole mesh's, and which are no cavities: their box lies in
    /// no box of a part that looks the right way. With any of these the mesh is open.
    pub reversed_parts: usize,
    /// Edges with one face only.
    pub boundary_edges: usize,
    /// Edges with two faces, wound against each other.
    pub inconsistent_edges: usize,
    /// Edges with more than two faces. They do no harm where directions balance.
    pub crowded_edges: usize,
    /// Edges run along more often in one direction than in the other: the boundary edges, the inconsistent ones, and
    /// some of the crowded ones. A closed mesh has none.
    pub unbalanced_edges: usize,
    /// Triangles without area, exactly: a corner twice, or three in a line. One in a line may close the crack at a
    /// T-junction, so their edges count like all others.
    pub without_area: usize,
    /// Its shape where it is open.
    pub sheet: Option<OpenShape>,
}

/// The shape of an open mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct OpenShape {
    /// Whether each of its parts lies in a plane, as far as coordinates in f32 can tell. Virtual samples are exact on
    /// planes: a flat sheet needs no bias, a curved one does.
    pub is_flat: bool,
    /// The sharpest bend: the largest difference of the unit normals of two faces on one edge, both taken on one side of
    /// the sheet. It is 2 sin(θ/2), nearly the angle θ between them in radians; 2 for a sheet folded back on itself.
    pub bend: f64,
}

impl Solidity {
    /// Classifies a mesh: positions, and triangles as indices into them, counter-clockwise seen from the front.
    ///
    /// Only the positions that the triangles use are looked at, so that the triangles of an object can be given with the
    /// positions of a whole scene. It takes `O(n log n)` for n triangles, and memory for them: once for a mesh, when it
    /// is loaded. Moving, turning and scaling a mesh changes nothing; mirroring it exchanges [`Self::Watertight`] and
    /// [`Self::Inverted`].
    ///
    /// A part that crosses itself or another is classified by its winding. Every triangle counts: one that is there
    /// twice, or one without area that hangs on an edge, leaves edges that do not close. Drop such triangles when a file
    /// is loaded.
    ///
    /// # Errors
    ///
    /// Names `"triangles"` when there are none, more than a billion, or one of their indices has no position, and
    /// `"positions"` when one that is used is not finite or too large.
    ///
    /// ```
    /// use shadowfit::mesh::Solidity;
    /// use shadowfit::glam::Vec3;
    ///
    /// let corners = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z];
    /// let faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
    /// assert_eq!(Solidity::of(&corners, &faces)?.solidity, Solidity::Watertight);
    /// assert_eq!(Solidity::of(&corners, &faces[1..])?.solidity, Solidity::Open);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    pub fn of<F: Into<f64>, P>(positions: &[P], triangles: &[[u32; 3]]) -> Result<SolidityReport, InputError>
    where
        P: Copy + Into<[F; 3]>,
    {
        /// Three corners of each triangle must be countable in 32 bits.
        const MOST_TRIANGLES: usize = 1_000_000_000;
        if triangles.is_empty() {
            return check::fail("triangles", InputErrorKind::Empty);
        }
        if triangles.len() > MOST_TRIANGLES {
            return check::fail("triangles", InputErrorKind::TooMany);
        }
        let mut corners = Vec::with_capacity(3 * triangles.len());
        for (at, &index) in triangles.iter().flatten().enumerate() {
            let Some(&position) = positions.get(index as usize) else {
                return Err(InputError::new("triangles", InputErrorKind::OutOfRange)
                    .got(index.into())
                    .of_list("triangles", at / 3));
            };
            let position = vector(position);
            let in_list = |error: InputError| error.of_list("positions", index as usize);
            check::point("positions", position).map_err(in_list)?;
            // −0 becomes 0.
            corners.push(position + DVec3::ZERO);
        }
        Ok(Faces::welded(&corners).report())
    }
}

/// Triangles over welded vertices, each position once.
struct Faces {
    points: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
}

/// One side of one triangle.
struct Side {
    /// The lesser vertex and the greater one.
    ends: [u32; 2],
    /// Whether the triangle runs from the lesser to the greater.
    is_upwards: bool,
    triangle: usize,
}

impl Faces {
    /// The corners of triangles, three each, those of equal positions made one.
    fn welded(corners: &[DVec3]) -> Self {
        let mut order: Vec<u32> = (0..corners.len() as u32).collect();
        let at = |corner: u32| corners[corner as usize];
        order.sort_unstable_by(|&a, &b| {
            let (a, b) = (at(a), at(b));
            a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)).then(a.z.total_cmp(&b.z))
        });
        let mut points: Vec<DVec3> = Vec::new();
        let mut triangles = alloc::vec![[0; 3]; corners.len() / 3];
        for corner in order {
            if points.last() != Some(&at(corner)) {
                points.push(at(corner));
            }
            triangles[corner as usize / 3][corner as usize % 3] = points.len() as u32 - 1;
        }
        Self { points, triangles }
    }

    fn report(&self) -> SolidityReport {
        let mut report = SolidityReport {
            solidity: Solidity::Open,
            parts: 0,
            reversed_parts: 0,
            boundary_edges: 0,
            inconsistent_edges: 0,
            crowded_edges: 0,
            unbalanced_edges: 0,
            without_area: (0..self.triangles.len()).filter(|&i| self.normal(i) == DVec3::ZERO).count(),
            sheet: None,
        };
        let mut bend: f64 = 0.0;
        for edge in self.sides().chunk_by(|a, b| a.ends == b.ends) {
            let is_balanced = 2 * edge.iter().filter(|side| side.is_upwards).count() == edge.len();
            report.boundary_edges += usize::from(edge.len() == 1);
            report.inconsistent_edges += usize::from(edge.len() == 2 && !is_balanced);
            report.crowded_edges += usize::from(edge.len() > 2);
            report.unbalanced_edges += usize::from(!is_balanced);
            bend = bend.max(self.bend(edge));
        }
        let parts = self.parts();
        report.parts = parts.len();
        if report.unbalanced_edges == 0 {
            (report.solidity, report.reversed_parts) = direction_of_all(&parts);
        }
        if report.solidity == Solidity::Open {
            report.sheet = Some(OpenShape { is_flat: parts.iter().all(|part| self.is_flat(part)), bend });
        }
        report
    }

    fn corners(&self, triangle: usize) -> [DVec3; 3] {
        self.triangles[triangle].map(|point| self.points[point as usize])
    }

    /// Across the front, as long as twice the area.
    fn normal(&self, triangle: usize) -> DVec3 {
        let [a, b, c] = self.corners(triangle);
        (b - a).cross(c - a)
    }

    /// All sides, those along one edge next to each other. A triangle with a corner twice has none: they would run along
    /// one edge there and back.
    fn sides(&self) -> Vec<Side> {
        let mut sides = Vec::with_capacity(3 * self.triangles.len());
        for (triangle, &[a, b, c]) in self.triangles.iter().enumerate() {
            if a != b && b != c && c != a {
                sides.extend([(a, b), (b, c), (c, a)].map(|(from, to)| Side {
                    ends: [from.min(to), from.max(to)],
                    is_upwards: from < to,
                    triangle,
                }));
            }
        }
        sides.sort_unstable_by_key(|side| (side.ends, side.triangle));
        sides
    }

    /// The largest difference of normals between the first face of an edge and the others, all taken on one side.
    fn bend(&self, edge: &[Side]) -> f64 {
        // Faces that run along the edge in opposite directions have their fronts on one side.
        let normal = |side: &Side| {
            let front = self.normal(side.triangle).normalize_or_zero();
            if side.is_upwards { front } else { -front }
        };
        let Some((first, others)) = edge.split_first() else { return 0.0 };
        let first = normal(first);
        let of = |other: DVec3| {
            if first == DVec3::ZERO || other == DVec3::ZERO { 0.0 } else { (first + other).length() }
        };
        // Unit but for rounding.
        others.iter().map(|side| of(normal(side))).fold(0.0, f64::max).min(2.0)
    }

    /// The parts that share no vertex.
    fn parts(&self) -> Vec<Part> {
        // Each vertex points to another of its part, and in the end to the one that stands for all of them.
        let mut parents: Vec<u32> = (0..self.points.len() as u32).collect();
        for &[a, b, c] in &self.triangles {
            let root = root_of(&mut parents, a);
            for other in [b, c] {
                let other = root_of(&mut parents, other);
                parents[other as usize] = root;
            }
        }
        let mut part_of_root = alloc::vec![usize::MAX; self.points.len()];
        let mut parts: Vec<Part> = Vec::new();
        for (i, triangle) in self.triangles.iter().enumerate() {
            let part = &mut part_of_root[root_of(&mut parents, triangle[0]) as usize];
            if *part == usize::MAX {
                *part = parts.len();
                parts.push(Part::around(self.corners(i)[0]));
            }
            parts[*part].add(i, self.corners(i));
        }
        parts
    }

    /// Whether a part lies in the plane of its largest triangle, as far as coordinates in f32 can tell.
    fn is_flat(&self, part: &Part) -> bool {
        let Some(&largest) = part
            .triangles
            .iter()
            .max_by(|&&a, &&b| self.normal(a).length_squared().total_cmp(&self.normal(b).length_squared()))
        else {
            return true;
        };
        let [a, b, c] = self.corners(largest);
        let area = self.normal(largest).length();
        if area == 0.0 {
            return true;
        }
        let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
        // Corners are off by half a unit in the last place on each axis. The plane through three of them is off by that at
        // the corners, and by as many times more farther out as the part is larger than the triangle is high.
        let off = f64::from(f32::EPSILON) * part.min.abs().max(part.max.abs()).max_element();
        let tolerance = off * (2.0 + part.min.distance(part.max) * longest / area);
        let normal = self.normal(largest) / area;
        let distance = |point: DVec3| normal.dot(point - a).abs();
        part.triangles.iter().flat_map(|&triangle| self.corners(triangle)).all(|point| distance(point) <= tolerance)
    }
}

/// The vertex that stands for the part that a vertex belongs to.
fn root_of(parents: &mut [u32], mut vertex: u32) -> u32 {
    while parents[vertex as usize] != vertex {
        let above = parents[parents[vertex as usize] as usize];
        parents[vertex as usize] = above;
        vertex = above;
    }
    vertex
}

/// Triangles that are joined by vertices.
struct Part {
    triangles: Vec<usize>,
    /// The vertex that volumes are taken about.
    apex: DVec3,
    /// Six times the volume.
    volume: f64,
    /// The sum of the magnitudes of its terms.
    magnitude: f64,
    min: DVec3,
    max: DVec3,
}

impl Part {
    fn around(apex: DVec3) -> Self {
        Self { triangles: Vec::new(), apex, volume: 0.0, magnitude: 0.0, min: apex, max: apex }
    }

    fn add(&mut self, triangle: usize, corners: [DVec3; 3]) {
        self.triangles.push(triangle);
        for corner in corners {
            (self.min, self.max) = (self.min.min(corner), self.max.max(corner));
        }
        let [a, b, c] = corners.map(|corner| corner - self.apex);
        self.volume += a.dot(b.cross(c));
        self.magnitude += a.length() * b.length() * c.length();
    }

    /// The sign of a closed part's volume; zero where rounding could have made all of it.
    fn direction(&self) -> f64 {
        // A term is off by less than 16 roundings of its magnitude, and the sum by one more for each term.
        let rounding = (self.triangles.len() as f64 + 16.0) * f64::EPSILON * self.magnitude;
        if self.volume.abs() > rounding { self.volume.signum() } else { 0.0 }
    }

    fn is_within(&self, other: &Self) -> bool {
        self.min.cmpge(other.min).all() && self.max.cmple(other.max).all()
    }
}

/// Which way the fronts of closed parts look, and how many look the other way without being cavities.
///
/// The sign of the whole volume is that of the solid around its cavities. Parts without a volume, two faces back to back,
/// are as good as nothing to a ray.
fn direction_of_all(parts: &[Part]) -> (Solidity, usize) {
    let volume: f64 = parts.iter().filter(|part| part.direction() != 0.0).map(|part| part.volume).sum();
    let alike: Vec<&Part> = parts.iter().filter(|part| part.direction() * volume > 0.0).collect();
    let reversed = parts.iter().filter(|part| part.direction() * volume < 0.0);
    let reversed = reversed.filter(|part| !alike.iter().any(|around| part.is_within(around))).count();
    let solidity = match (alike.is_empty() || reversed > 0, volume > 0.0) {
        (true, _) => Solidity::Open,
        (false, true) => Solidity::Watertight,
        (false, false) => Solidity::Inverted,
    };
    (solidity, reversed)
}
