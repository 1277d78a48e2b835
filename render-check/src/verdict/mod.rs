//! The verdict: a rendered image with shadows compared with ray-traced truth.
//!
//! A renderer draws a scene with shadows from a fitted map and hands over the visible triangle and the lit fraction
//! of each pixel, and the map as drawn. [`TruthImage`] holds the true shadows at the same surface points, by rays
//! in f64; [`judge`] compares the two and classifies every wrong pixel:
//!
//! 1. **missing caster**: a caster is missing from the map. With a fitted map this never happens;
//! 2. **edge**: the edge of a true shadow is closer than the map can resolve, or next to the pixel;
//! 3. **false shadow** (acne) and **false light** (light leaks): the rest.

mod bias_reach;
mod cluster;
mod comparison;
mod edge;
mod frustum;
mod hemisphere;
mod judge;
mod mark;
mod missing;
mod projection;
mod rendered;
mod report;
mod share;
mod source;
mod surface;
mod truth;

pub use cluster::Cluster;
pub use frustum::Frustum;
pub use hemisphere::Hemisphere;
pub use judge::judge;
pub use mark::{Fault, Mark};
pub use projection::Projection;
pub use rendered::{Bias, DrawnMap, Rendered, projection};
pub use report::{Aliasing, Counts, Verdict};
pub use share::share;
pub use source::Illumination;
pub use surface::Surface;
pub use truth::{Truth, TruthImage};

#[cfg(test)]
pub(crate) mod fake;
#[cfg(test)]
mod tests;
