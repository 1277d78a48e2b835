//! A fitted map and what it resolves: texel footprints, aliasing, depth resolution.
//!
//! The methods of [`ShadowMap`](crate::ShadowMap) are listed by topic on its page.

pub(crate) mod aliasing;
mod integral;
pub(crate) mod linear_depth;
mod lower_bound;
pub(crate) mod quality;
pub(crate) mod receiver_offset;
mod report;
pub(crate) mod shadow_map;
mod surface_error;

pub use aliasing::Aliasing;
pub use quality::Footprint;
pub use report::{DepthResolution, Report};
pub use shadow_map::{DepthSpan, Window};
pub use surface_error::SurfaceError;
