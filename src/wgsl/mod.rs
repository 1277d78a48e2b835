//! Functions in WGSL for a renderer's own shaders.
//!
//! Each constant is the text of a few functions without bindings or entry points, to be put before the shader that calls
//! them. What they need they take as arguments: matrices as this crate gives them, textures, samplers. All names begin
//! with `shadowfit_`.
//!
//! ```
//! use shadowfit::wgsl;
//!
//! let bindings = "@group(0) @binding(0) var map: texture_depth_2d;";
//! let shader = [wgsl::MAP, wgsl::PROJECT, wgsl::FILTERS, bindings].concat(); // and what calls them
//! assert!(shader.contains("fn shadowfit_project(") && shader.contains("fn shadowfit_percentage_closer("));
//! ```

mod cascades;
mod depth_tiles;
mod frustum;
#[cfg(test)]
mod validation;

pub use cascades::CASCADES;
pub use depth_tiles::DEPTH_TILES;
pub use frustum::{BETWEEN_LAYERS, FILTERS, MAP, MAP_ARRAY, PROJECT, VIRTUAL_SAMPLES};

/// Draws and reads paraboloid maps, see [`Paraboloid`](crate::omni::Paraboloid). `ShadowfitParaboloidVertex` can be the
/// output of a vertex shader and the input of a fragment shader, as it is; the fragment shader writes the depth that it
/// is given.
///
/// ```wgsl
/// struct ShadowfitParaboloidVertex { @builtin(position) position: vec4<f32>, @location(0) surface: vec4<f32> }
/// fn shadowfit_paraboloid_clip(
///     matrix: mat4x4<f32>, clip_scale: vec2<f32>, position: vec3<f32>,
/// ) -> ShadowfitParaboloidVertex
/// fn shadowfit_paraboloid_depth(
///     matrix: mat4x4<f32>, clip_scale: vec2<f32>, texture_scale: vec4<f32>, vertex: ShadowfitParaboloidVertex, bias: vec2<f32>,
/// ) -> f32
/// fn shadowfit_paraboloid_texture(matrix: mat4x4<f32>, texture_scale: vec4<f32>, position: vec3<f32>) -> vec4<f32>
/// ```
pub const PARABOLOID: &str = include_str!("paraboloid.wgsl");

/// Draws discs and balls as quads into a shadow map, each of its [`covering`](crate::depth::Splat::covering) size and of
/// its own depth.
///
/// - `shadowfit_disc_splat(clip_from_world, centre, normal, radius, map_sides, corner)`: the clip position of a corner of
///   a disc's rectangle, see [`ShadowMap::disc_splat`](crate::ShadowMap::disc_splat). `clip_from_world` is
///   [`ShadowMap::caster_matrix`](crate::ShadowMap::caster_matrix), `centre`, a unit `normal` and `radius` are in the space
///   that it takes positions in, `map_sides` are the map's width and height as f32s, and `corner` has coordinates −1 or 1.
/// - `shadowfit_ball_splat(clip_from_world, centre, radius, map_sides, corner)`: the same of a ball, see
///   [`ShadowMap::splat`](crate::ShadowMap::splat).
/// - `shadowfit_splat_corner(clip_from_world, centre, normal, radius, map_sides, corner)`: the same corner as
///   `struct shadowfit_SplatCorner { clip: vec4<f32>, offset: vec2<f32> }`, of a ball with a normal of zero. A fragment
///   shader that gets `offset`, interpolated, and discards where it is longer than 1 draws discs and not rectangles, see
///   [`Splat`](crate::depth::Splat).
pub const SPLAT: &str = include_str!("splat.wgsl");
