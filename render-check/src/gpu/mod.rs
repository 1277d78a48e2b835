//! A minimal renderer with shadow maps on the GPU. Any adapter will do, a software driver too.
//!
//! | step | what it makes |
//! |---|---|
//! | [`Geometry`] | the triangles on the GPU, in f32, about an origin |
//! | [`Surfaces`] | what a camera sees: the position and the triangle of every pixel |
//! | [`ShadowMaps`] | the depths of the casters, through the matrix of each of a light's maps |
//! | [`shadow_test`] | how much light reaches every pixel, as the shadow maps have it |

mod depth_copy;
mod depth_tiles;
mod device;
mod geometry;
mod pass;
mod pipeline_key;
mod read_back;
mod shaders;
mod shadow_map;
mod shadow_test;
mod splats;
mod surfaces;

pub use device::Gpu;
pub use geometry::Geometry;
pub use shadow_map::{Bias, MapDraw, MapPass, ShadowMaps};
pub use shadow_test::{Filter, Shadows, shadow_test};
pub use splats::Points;
pub use surfaces::Surfaces;

#[cfg(test)]
mod tests;
