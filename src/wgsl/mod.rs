//! Functions in WGSL for a renderer's own shaders.
//!
//! Each constant is the text of a few functions without bindings or entry points, to be put before the shader that calls
//! them. What they need they take as arguments: matrices as this crate gives them, textures, samplers. All names begin
//! with `shadowfit_`.

mod frustum;

pub use frustum::{FILTERS, MAP, MAP_ARRAY, PROJECT, VIRTUAL_SAMPLES};
