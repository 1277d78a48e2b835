//! Planes and convex bodies.

mod body;
mod plane;
mod polyhedron;

pub(crate) use body::Bits;
pub use body::{Body, Face};
pub use plane::Plane;
pub(crate) use plane::matrix_from_rows;
pub(crate) use polyhedron::{PlaneSet, Polyhedron, Vertex, box_planes};
