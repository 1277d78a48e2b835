//! The distance from a point to a body, decided exactly and rounded at the end.

use std::borrow::Borrow;
use std::cmp::Ordering;

use dashu_int::IBig;
use dashu_int::ops::UnsignedAbs;

use super::body::Body;
use super::exact::{ratio, sqrt_ratio};
use super::homogeneous::{ExactPlane, ExactPoint, Homogeneous};

/// Slack of the floating-point distance to a segment, in units of the size of the body seen from
/// the point. Its error is a few dozen ulps of that size: the end points are correctly
/// rounded, and an error in the parameter moves the foot along the segment by no more.
const SEGMENT_SLACK: f64 = 1e-12;

impl Body {
    /// The Euclidean distance from a point to the body: zero inside, infinite when it is empty.
    ///
    /// The nearest point is the foot on a face, on an edge, or a vertex. Which one is decided
    /// exactly, and its squared distance is a ratio of integers, so that the result has a relative
    /// error of an ulp or so however small it is.
    pub fn distance(&self, position: [f64; 3]) -> f64 {
        let point = Homogeneous::from_position(position);
        if self.is_empty() {
            return f64::INFINITY;
        }
        if self.contains_exact(&point) {
            return 0.0;
        }
        self.planes
            .iter()
            .find_map(|plane| self.distance_to_face(plane, &point))
            .unwrap_or_else(|| self.distance_to_edges(&point))
    }

    /// The distance to a half-space that excludes the point, if its foot on the plane is in the
    /// body: then no point of the body is nearer.
    fn distance_to_face(&self, plane: &ExactPlane, point: &ExactPoint) -> Option<f64> {
        if plane.side(point) != Ordering::Less {
            return None;
        }
        let normal = plane.xyz();
        let height = plane.dot(point);
        let norm2 = dot3(&normal, &normal);
        let [x, y, z] = std::array::from_fn(|i| point.xyz()[i] * &norm2 - &height * normal[i]);
        let weight = point.w() * &norm2;
        let foot = Homogeneous::new([x, y, z, weight]);
        self.contains_exact(&foot).then(|| sqrt_ratio(height.sqr(), point.w().sqr() * norm2.unsigned_abs()))
    }

    /// The distance to the nearest of the edges and vertices.
    ///
    /// Every segment between two vertices is in the body, so it does no harm to try some that are
    /// not edges. A floating-point distance leaves the few segments that can be the nearest.
    fn distance_to_edges(&self, point: &ExactPoint) -> f64 {
        let seen: Vec<[f64; 3]> = self
            .vertices
            .iter()
            .map(|vertex| {
                let vertex = &vertex.point;
                let weight = point.w() * vertex.w();
                from_to(point, vertex).map(|coord| ratio(&coord, &weight, 0))
            })
            .collect();
        let size = seen.iter().flatten().fold(0.0, |size, x| x.abs().max(size));
        // In units of that size no square over- or underflows that matters.
        let seen: Vec<[f64; 3]> = seen.iter().map(|v| v.map(|x| x / size)).collect();
        let segments: Vec<(usize, usize, f64)> =
            self.edges().map(|(a, b)| (a, b, segment_distance(seen[a], seen[b]))).collect();
        let nearest = segments.iter().map(|&(.., distance)| distance).fold(f64::INFINITY, f64::min);
        segments
            .into_iter()
            .filter(|&(.., distance)| distance <= nearest + SEGMENT_SLACK)
            .map(|(a, b, _)| {
                let (a, b) = (&self.vertices[a].point, &self.vertices[b].point);
                exact_segment_distance(a, b, point)
            })
            .fold(f64::INFINITY, f64::min)
    }

    /// Pairs of vertices with two half-spaces or more tight on both, which all edges are, and
    /// every vertex with itself.
    fn edges(&self) -> impl Iterator<Item = (usize, usize)> {
        (0..self.vertices.len()).flat_map(move |a| {
            (a..self.vertices.len())
                .filter(move |&b| {
                    let [a, b] = [a, b].map(|vertex| &self.vertices[vertex].tight);
                    a.iter().filter(|plane| b.contains(plane)).count() >= 2
                })
                .map(move |b| (a, b))
        })
    }
}

/// The distance from the origin to the segment from `a` to `b`, in floating point.
fn segment_distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    let along: [f64; 3] = std::array::from_fn(|i| b[i] - a[i]);
    let dot = |p: [f64; 3], q: [f64; 3]| p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
    let length2 = dot(along, along);
    let parameter = if length2 > 0.0 { (-dot(a, along) / length2).clamp(0.0, 1.0) } else { 0.0 };
    let foot: [f64; 3] = std::array::from_fn(|i| a[i] + parameter * along[i]);
    foot[0].hypot(foot[1]).hypot(foot[2])
}

/// The distance from `point` to the segment from `a` to `b`, rounded at the end.
fn exact_segment_distance(a: &ExactPoint, b: &ExactPoint, point: &ExactPoint) -> f64 {
    let along = from_to(a, b);
    let seen = from_to(a, point);
    // With the weights, the foot's parameter is progress · w(b) / (length2 · w(point)).
    let length2 = dot3(&along, &along);
    let progress = dot3(&seen, &along);
    if progress <= IBig::ZERO {
        return exact_point_distance(a, point);
    }
    if &progress * b.w() >= &length2 * point.w() {
        return exact_point_distance(b, point);
    }
    let weight = a.w() * point.w();
    sqrt_ratio(
        (dot3(&seen, &seen) * &length2 - progress.sqr().as_ibig()).unsigned_abs(),
        length2.unsigned_abs() * weight.sqr(),
    )
}

/// The distance between two points, rounded at the end.
fn exact_point_distance(a: &ExactPoint, b: &ExactPoint) -> f64 {
    let between = from_to(a, b);
    sqrt_ratio(dot3(&between, &between).unsigned_abs(), (a.w() * b.w()).sqr())
}

/// The vector from one point to another, times both their weights.
fn from_to(from: &ExactPoint, to: &ExactPoint) -> [IBig; 3] {
    std::array::from_fn(|i| to.xyz()[i] * from.w() - from.xyz()[i] * to.w())
}

/// The product of two 3-vectors.
fn dot3<A: Borrow<IBig>, B: Borrow<IBig>>(a: &[A; 3], b: &[B; 3]) -> IBig {
    let [x, y, z] = std::array::from_fn(|i| a[i].borrow() * b[i].borrow());
    x + y + z
}

/// How far outside of a half-space a point is; zero inside.
pub fn outside(plane: &ExactPlane, point: &ExactPoint) -> f64 {
    if plane.side(point) != Ordering::Less {
        return 0.0;
    }
    let [x, y, z] = plane.xyz().map(|component| component.sqr());
    sqrt_ratio(plane.dot(point).sqr(), point.w().sqr() * (x + y + z))
}
