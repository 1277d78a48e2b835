//! A fitted map, and what it costs and gives: texel footprints, aliasing, depth resolution.

pub(crate) mod aliasing;
mod integral;
pub(crate) mod linear_depth;
mod lower_bound;
pub(crate) mod quality;
pub(crate) mod receiver_offset;
mod report;
pub(crate) mod shadow_map;

pub use aliasing::Aliasing;
pub use quality::Footprint;
pub use report::{DepthResolution, Report};
pub use shadow_map::{DepthSpan, Window};
