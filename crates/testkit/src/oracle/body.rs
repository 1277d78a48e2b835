//! A bounded intersection of half-spaces, by its exact vertices.

use std::cmp::Ordering;

use dashu_int::IBig;

use super::exact::{integers, ratio};
use super::homogeneous::{ExactPlane, ExactPoint, Homogeneous};
use super::hull::homogeneous_vertices;

/// A bounded convex polyhedron, possibly flat, a segment, a point or empty.
pub struct Body {
    /// The half-spaces it was made from, redundant ones and all.
    pub planes: Vec<ExactPlane>,
    /// Its vertices, each once.
    pub vertices: Vec<Vertex>,
}

/// A vertex of a body.
pub struct Vertex {
    /// Where it is, with a positive weight.
    pub point: ExactPoint,
    /// Which of the body's half-spaces have it on their boundary, in ascending order.
    pub tight: Vec<usize>,
}

impl Body {
    /// The intersection of the half-spaces n·x + offset ≥ 0.
    ///
    /// # Panics
    ///
    /// When it is neither bounded nor empty, or a component is not finite.
    pub fn from_planes(planes: &[[f64; 4]]) -> Self {
        Self::from_exact_planes(planes.iter().copied().map(Homogeneous::from_f64).collect())
    }

    /// The intersection of exact half-spaces.
    ///
    /// # Panics
    ///
    /// When it is neither bounded nor empty.
    pub fn from_exact_planes(planes: Vec<ExactPlane>) -> Self {
        let (vertices, directions): (Vec<_>, Vec<_>) =
            homogeneous_vertices(&planes).into_iter().partition(|ray| !ray.vector.w().is_zero());
        assert!(vertices.is_empty() || directions.is_empty(), "the body is unbounded");
        let vertices = vertices.into_iter().map(|ray| Vertex { point: ray.vector, tight: ray.tight }).collect();
        Self { planes, vertices }
    }

    /// Whether it holds no point at all.
    pub fn is_empty(&self) -> bool {
        self.vertices.is_empty()
    }

    /// Whether a point is in it, its boundary included.
    pub fn contains(&self, position: [f64; 3]) -> bool {
        self.contains_exact(&Homogeneous::from_position(position))
    }

    /// Whether an exact point is in it, its boundary included.
    pub fn contains_exact(&self, point: &ExactPoint) -> bool {
        self.planes.iter().all(|plane| plane.side(point) != Ordering::Less)
    }

    /// Its vertices, each coordinate correctly rounded.
    pub fn vertices_f64(&self) -> Vec<[f64; 3]> {
        self.vertices
            .iter()
            .map(|vertex| {
                let point = &vertex.point;
                point.xyz().map(|coord| ratio(coord, point.w(), 0))
            })
            .collect()
    }

    /// How far it reaches outside the half-space n·x + offset ≥ 0: the largest −(n·x + offset)/|n|
    /// over its vertices, negative when all of it is strictly inside, and minus infinity when it
    /// is empty.
    ///
    /// n·x + offset is evaluated exactly and rounded once, so the result is accurate to a few ulps
    /// however small it is.
    pub fn violation(&self, plane: [f64; 4]) -> f64 {
        let [x, y, z, _] = plane;
        let largest = [x, y, z].map(f64::abs).into_iter().fold(0.0, f64::max);
        assert!(largest > 0.0, "a half-space has a normal");
        let (coords, exponent) = integers(plane);
        let outside = coords.map(|coord| -coord);
        let reach = self
            .vertices
            .iter()
            .map(|vertex| {
                let [a, b, c, d]: [IBig; 4] = std::array::from_fn(|i| &outside[i] * &vertex.point.coords()[i]);
                ratio(&(a + b + c + d), vertex.point.w(), exponent)
            })
            .fold(f64::NEG_INFINITY, f64::max);
        let norm = (x / largest).hypot(y / largest).hypot(z / largest);
        reach / norm / largest
    }
}
