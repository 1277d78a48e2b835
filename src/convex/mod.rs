//! Planes, convex bodies and the clipper.

mod bits;
mod body;
mod exact;
mod plane;
mod polyhedron;

pub(crate) use bits::Bits;
pub use body::{ConvexBody, Face};
pub use plane::Plane;
pub(crate) use plane::matrix_from_rows;
pub(crate) use polyhedron::{PlaneId, Polyhedron, box_planes};
