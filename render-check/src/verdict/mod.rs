//! What a renderer made of a map, against ray-traced truth.
//!
//! A renderer draws a scene from a view with shadows from a fitted map and hands over what it has: which triangle each
//! pixel shows, how much light it let through there, and the map as it was drawn. [`TruthImage`] finds, in f64, what the
//! light really does at each of these points; [`judge`] compares the two and says of every wrong pixel why it is wrong:
//!
//! 1. **missing caster**: the map does not hold something that it should. A fitted map never has any;
//! 2. **edge**: the edge of a true shadow is closer than a map of this resolution can tell, or next to the pixel;
//! 3. **false shadow** and **false light**: the rest.

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
