//! What a computed body leaves out of the exact one, decided exactly.

use std::fmt;

use shadowfit::focus::{ConvexBody as Computed, Plane};
use shadowfit::glam::DVec3;

use crate::oracle::body::Body;
use crate::oracle::distance::outside;
use crate::oracle::homogeneous::{ExactPoint, Homogeneous};
use crate::oracle::hull::facets;

/// What a body was computed as: its numbers, to look at and to tamper with.
#[derive(Clone)]
pub struct Shape {
    /// What culling asks.
    pub planes: Vec<Plane>,
    /// What windows are fitted to.
    pub vertices: Vec<DVec3>,
    /// Planes that three vertices or more lie on, with those in turn.
    pub faces: Vec<(Plane, Vec<usize>)>,
}

impl Shape {
    pub fn of(computed: &Computed) -> Self {
        Self {
            planes: computed.planes().collect(),
            vertices: computed.vertices().to_vec(),
            faces: computed.faces().map(|face| (face.plane(), face.indices().collect())).collect(),
        }
    }

    pub fn is_empty(&self) -> bool {
        self.vertices.is_empty()
    }
}

/// A part of the exact body that the computed one leaves out.
pub enum Loss {
    /// The exact body reaches this far outside of a plane of the computed one.
    Plane(Plane, f64),
    /// An exact vertex is this far outside of the hull of the computed ones.
    Vertex(DVec3, f64),
    /// The computed body is empty, and the exact one is not.
    All,
}

impl fmt::Display for Loss {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Plane(plane, by) => write!(f, "{by:e} of the exact body is outside of {plane:?}"),
            Self::Vertex(vertex, by) => {
                write!(f, "the exact vertex near {vertex:?} is {by:e} outside of the hull of the computed ones")
            }
            Self::All => write!(f, "computed as empty"),
        }
    }
}

/// Everything that is lost.
pub fn losses(computed: &Shape, exact: &Body) -> Vec<Loss> {
    if exact.is_empty() {
        return Vec::new();
    }
    if computed.is_empty() {
        return vec![Loss::All];
    }
    let of_plane = |plane: &Plane| {
        let by = exact.violation(plane.to_row().to_array());
        (by > 0.0).then_some(Loss::Plane(*plane, by))
    };
    let points: Vec<ExactPoint> =
        computed.vertices.iter().map(|vertex| Homogeneous::from_position(vertex.to_array())).collect();
    let facets = facets(&points);
    let vertices = exact.vertices.iter().zip(exact.vertices_f64()).filter_map(|(vertex, position)| {
        let by = facets.iter().map(|facet| outside(facet, &vertex.point)).fold(0.0, f64::max);
        (by > 0.0).then_some(Loss::Vertex(position.into(), by))
    });
    computed.planes.iter().filter_map(of_plane).chain(vertices).collect()
}
