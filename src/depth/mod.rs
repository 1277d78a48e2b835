//! Depth tests: the bias that keeps shadow acne away, second depth and virtual samples, which need none, and splats for
//! point clouds.
//!
//! The page `docs/depth.md` of the package compares the answers and derives the numbers.

pub(crate) mod bias;
mod normal_offset;
#[cfg(feature = "alloc")]
pub(crate) mod second_depth;
mod splat;
mod tolerance;
mod virtual_sample;

pub use crate::map::receiver_offset::ReceiverOffset;
pub use bias::DepthBias;
#[cfg(feature = "alloc")]
pub use second_depth::{Culling, DepthTest};
pub use splat::Splat;
pub use tolerance::{ComparisonTolerance, RASTER_GRID};
pub use virtual_sample::{Decision, MIN_SIN_INCIDENCE, ShadowSample, TangentPlane};
