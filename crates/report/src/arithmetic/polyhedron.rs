//! A convex polyhedron that half-spaces cut, in any of the numbers: vertices, and faces as loops of them.
//!
//! Signs are taken as they come. Each vertex has one sign for a cut, whichever face asks, so that the surface stays closed
//! also where rounding lets a plane pass through a face more than once.

use super::number::{Number, Row, at};

/// A polyhedron, with the memory that cuts need, to be used again.
#[derive(Clone, Default)]
pub(crate) struct Polyhedron<T> {
    vertices: Vec<[T; 3]>,
    faces: Faces,
    cut: Cut<T>,
}

/// Loops of vertices, one after another.
#[derive(Clone, Default)]
struct Faces {
    corners: Vec<usize>,
    /// Where each loop ends among the corners.
    ends: Vec<usize>,
}

impl Faces {
    fn clear(&mut self) {
        self.corners.clear();
        self.ends.clear();
    }

    fn loops(&self) -> impl Iterator<Item = &[usize]> {
        let begins = std::iter::once(0).chain(self.ends.iter().copied());
        begins.zip(&self.ends).map(|(begin, &end)| &self.corners[begin..end])
    }

    /// Ends the loop that corners were added to. A loop of two is an edge: the faces on its sides are neighbours without it.
    fn end(&mut self) {
        let begin = self.ends.last().copied().unwrap_or(0);
        if self.corners.len() > begin + 2 {
            self.ends.push(self.corners.len());
        } else {
            self.corners.truncate(begin);
        }
    }
}

/// What one cut finds and makes.
#[derive(Clone, Default)]
struct Cut<T> {
    /// The plane's value at each vertex.
    values: Vec<T>,
    /// What becomes of each vertex: its new name, if it stays.
    names: Vec<Option<usize>>,
    vertices: Vec<[T; 3]>,
    faces: Faces,
    /// The edges that were cut, from inside to outside, in the order of their new vertices.
    edges: Vec<(usize, usize)>,
    /// On the new face, what follows after each new vertex.
    following: Vec<usize>,
}

impl<T: Number> Polyhedron<T> {
    /// A box, which may be flat.
    pub(crate) fn from_box(min: [f64; 3], max: [f64; 3]) -> Self {
        let corner = |corner: usize| {
            std::array::from_fn(|axis| T::of(if corner >> axis & 1 == 0 { min[axis] } else { max[axis] }))
        };
        // Counterclockwise from outside.
        const SIDES: [[usize; 4]; 6] =
            [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
        let faces = Faces { corners: SIDES.concat(), ends: (1..=6).map(|side| 4 * side).collect() };
        let cut = Cut {
            values: Vec::new(),
            names: Vec::new(),
            vertices: Vec::new(),
            faces: Faces::default(),
            edges: Vec::new(),
            following: Vec::new(),
        };
        Self { vertices: (0..8).map(corner).collect(), faces, cut }
    }

    /// Becomes another one, in the same memory.
    pub(crate) fn become_like(&mut self, other: &Self) {
        self.vertices.clone_from(&other.vertices);
        self.faces.corners.clone_from(&other.faces.corners);
        self.faces.ends.clone_from(&other.faces.ends);
    }

    pub(crate) fn vertices(&self) -> &[[T; 3]] {
        &self.vertices
    }

    /// Whether each edge has two faces, which pass along it in opposite directions.
    pub(crate) fn is_closed(&self) -> bool {
        let edges = |face: &[usize]| -> Vec<(usize, usize)> {
            (0..face.len()).map(|i| (face[i], face[(i + 1) % face.len()])).collect()
        };
        let mut forwards: Vec<(usize, usize)> = self.faces.loops().flat_map(edges).collect();
        let mut backwards: Vec<(usize, usize)> = forwards.iter().map(|&(a, b)| (b, a)).collect();
        forwards.sort_unstable();
        backwards.sort_unstable();
        forwards == backwards
    }

    /// Keeps what lies inside of a plane. What is not a number is outside.
    pub(crate) fn clip(&mut self, plane: &Row<T>) {
        let zero = T::of(0.0);
        let cut = &mut self.cut;
        cut.values.clear();
        cut.values.extend(self.vertices.iter().map(|vertex| at(plane, vertex)));
        if cut.values.iter().all(|value| *value >= zero) {
            return;
        }
        cut.names.clear();
        cut.vertices.clear();
        for (vertex, value) in self.vertices.iter().zip(&cut.values) {
            let stays = *value >= zero;
            cut.names.push(stays.then_some(cut.vertices.len()));
            if stays {
                cut.vertices.push(vertex.clone());
            }
        }
        cut.make_faces(&self.vertices, &self.faces);
        cut.close();
        std::mem::swap(&mut self.vertices, &mut cut.vertices);
        std::mem::swap(&mut self.faces, &mut cut.faces);
    }
}

impl<T: Number> Cut<T> {
    /// What is left of each face.
    fn make_faces(&mut self, vertices: &[[T; 3]], faces: &Faces) {
        self.faces.clear();
        self.edges.clear();
        self.following.clear();
        for face in faces.loops() {
            // Where the face was left last, and where it was come into before it was left.
            let (mut left, mut first) = (None, None);
            for (i, &a) in face.iter().enumerate() {
                let b = face[if i + 1 < face.len() { i + 1 } else { 0 }];
                if let Some(name) = self.names[a] {
                    self.faces.corners.push(name);
                }
                match (self.names[a].is_some(), self.names[b].is_some()) {
                    (true, false) => {
                        let new = self.new_vertex(vertices, a, b);
                        self.faces.corners.push(new);
                        left = Some(new);
                    }
                    (false, true) => {
                        let new = self.new_vertex(vertices, b, a);
                        self.faces.corners.push(new);
                        match left {
                            Some(left) => self.follow(new, left),
                            None => first = Some(new),
                        }
                    }
                    _ => {}
                }
            }
            if let (Some(first), Some(left)) = (first, left) {
                self.follow(first, left);
            }
            self.faces.end();
        }
    }

    /// The new face passes along the edges of the others the other way.
    fn follow(&mut self, new: usize, after: usize) {
        let first = self.vertices.len() - self.edges.len();
        self.following[new - first] = after;
    }

    /// Where an edge is cut, found once for both of its faces.
    fn new_vertex(&mut self, vertices: &[[T; 3]], inside: usize, outside: usize) -> usize {
        let first = self.vertices.len() - self.edges.len();
        if let Some(known) = self.edges.iter().position(|&edge| edge == (inside, outside)) {
            return first + known;
        }
        let at = |vertex: usize| (&vertices[vertex], &self.values[vertex]);
        let new = between(at(inside), at(outside));
        self.vertices.push(new);
        self.edges.push((inside, outside));
        // Itself, until a face says what follows.
        self.following.push(self.vertices.len() - 1);
        self.vertices.len() - 1
    }

    /// Adds the faces on the plane: one, but for rounding.
    fn close(&mut self) {
        let first = self.vertices.len() - self.edges.len();
        for begin in 0..self.edges.len() {
            let mut next = begin;
            // Where it has been, a vertex is followed by itself.
            while self.following[next] != first + next {
                let after = self.following[next] - first;
                self.faces.corners.push(first + next);
                self.following[next] = first + next;
                next = after;
            }
            self.faces.end();
        }
    }
}

/// Where a function that is not negative at the one end of an edge and negative at the other is zero: from the nearer end, as
/// rounding then moves it least.
fn between<T: Number>((a, at_a): (&[T; 3], &T), (b, at_b): (&[T; 3], &T)) -> [T; 3] {
    let from = |near: &[T; 3], at_near: &T, far: &[T; 3], at_far: &T| {
        let part = at_near.clone() / (at_near.clone() - at_far.clone());
        std::array::from_fn(|i| near[i].clone() + (far[i].clone() - near[i].clone()) * part.clone())
    };
    let is_nearer = at_a.clone() + at_b.clone() <= T::of(0.0);
    if is_nearer { from(a, at_a, b, at_b) } else { from(b, at_b, a, at_a) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use dashu_ratio::RBig;
    use proptest::prelude::*;

    fn cut<T: Number>(planes: &[[f64; 4]]) -> Polyhedron<T> {
        let mut body = Polyhedron::from_box([0.0; 3], [4.0, 4.0, 2.0]);
        for plane in planes {
            body.clip(&plane.map(T::of));
        }
        body
    }

    fn sorted<T: Number>(body: &Polyhedron<T>) -> Vec<[f64; 3]> {
        let mut vertices: Vec<[f64; 3]> =
            body.vertices().iter().map(|vertex| vertex.each_ref().map(Number::to_f64)).collect();
        vertices.sort_by(|a, b| a.partial_cmp(b).expect("no number is NaN"));
        vertices.dedup();
        vertices
    }

    #[test]
    fn a_roof_is_cut_from_a_box() {
        // Down to both sides of the line x = 2, z = 2.
        let roof = [[1.0, 0.0, -1.0, 0.0], [-1.0, 0.0, -1.0, 4.0]];
        let expected =
            [[0.0, 0.0, 0.0], [0.0, 4.0, 0.0], [2.0, 0.0, 2.0], [2.0, 4.0, 2.0], [4.0, 0.0, 0.0], [4.0, 4.0, 0.0]];
        assert_eq!(sorted(&cut::<f32>(&roof)), expected);
        assert_eq!(sorted(&cut::<f64>(&roof)), expected);
        assert_eq!(sorted(&cut::<RBig>(&roof)), expected);
    }

    #[test]
    fn a_plane_that_touches_leaves_what_it_touches() {
        let face = cut::<RBig>(&[[0.0, 0.0, 1.0, -2.0]]);
        assert_eq!(sorted(&face), [[0.0, 0.0, 2.0], [0.0, 4.0, 2.0], [4.0, 0.0, 2.0], [4.0, 4.0, 2.0]]);
        assert!(cut::<RBig>(&[[0.0, 0.0, 1.0, -2.5]]).vertices().is_empty());
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 500, failure_persistence: None, ..ProptestConfig::default() })]

        /// Planes through small integers, moved by a rounding or not at all: most pass vertices and edges.
        #[test]
        fn surfaces_stay_closed(
            planes in prop::collection::vec((prop::array::uniform4(-2..=2_i8), -1..=1_i8), 0..16),
        ) {
            let planes: Vec<[f64; 4]> = planes
                .into_iter()
                .map(|(plane, steps)| {
                    let [x, y, z, offset] = plane.map(f64::from);
                    [x, y, z, offset + f64::from(steps) * f64::from(f32::EPSILON)]
                })
                .collect();
            prop_assert!(cut::<f32>(&planes).is_closed());
            prop_assert!(cut::<f64>(&planes).is_closed());
            prop_assert!(cut::<RBig>(&planes).is_closed());
        }
    }
}
