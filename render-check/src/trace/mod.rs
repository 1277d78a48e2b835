//! Ray casting against the triangles of a scene, in f64.

mod faces;
mod lens;
mod ray;
mod tracer;

pub use faces::Faces;
pub use lens::Lens;
pub use ray::{Hit, Ray};
pub use tracer::Tracer;
