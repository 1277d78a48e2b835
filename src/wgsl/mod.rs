//! Functions in WGSL for a renderer's own shaders.
//!
//! Each constant is the text of a few functions without bindings or entry points, to be put before the shader that calls
//! them. What they need they take as arguments: matrices as this crate gives them, textures, samplers. All names begin
//! with `shadowfit_`.

mod frustum;

pub use frustum::{FILTERS, MAP, MAP_ARRAY, PROJECT, VIRTUAL_SAMPLES};

/// Paraboloid maps: `shadowfit_paraboloid_clip` for the vertices of casters, `shadowfit_paraboloid_texture` for what reads
/// the map. See [`Paraboloid`](crate::Paraboloid).
pub const PARABOLOID: &str = include_str!("paraboloid.wgsl");
