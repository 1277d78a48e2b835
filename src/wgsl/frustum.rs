//! Functions that read frustum maps.

/// Projects a position into a map: texture coordinates, and the depth to compare. The matrix is
/// [`ShadowMap::receiver_matrix_with`](crate::ShadowMap::receiver_matrix_with).
///
/// ```wgsl
/// fn shadowfit_project(texture_from_origin: mat4x4<f32>, position: vec3<f32>) -> vec3<f32>
/// ```
pub const PROJECT: &str = include_str!("project.wgsl");

/// The type `shadowfit_Map` for maps in textures of their own, `texture_depth_2d`. A shader takes this or [`MAP_ARRAY`].
///
/// ```wgsl
/// alias shadowfit_Map = texture_depth_2d;
/// fn shadowfit_size(map: shadowfit_Map) -> vec2<i32>
/// fn shadowfit_stored(map: shadowfit_Map, layer: i32, texel: vec2<i32>) -> f32
/// fn shadowfit_compared(map: shadowfit_Map, layer: i32, compare: sampler_comparison, place: vec2<f32>, depth: f32) -> f32
/// ```
pub const MAP: &str = include_str!("map.wgsl");

/// The same for maps in layers of a `texture_depth_2d_array`.
pub const MAP_ARRAY: &str = include_str!("map_array.wgsl");

/// The ordinary filters: the nearest texel, the sampler's 2 × 2, and N × N. They need a bias in the map, and [`MAP`] or
/// [`MAP_ARRAY`] before them. `reversed` says whether the map's clip space is reversed
/// ([`DepthRange::is_reversed`](crate::input::DepthRange::is_reversed)).
///
/// ```wgsl
/// fn shadowfit_nearest(map: shadowfit_Map, layer: i32, projected: vec3<f32>, reversed: bool) -> f32
/// fn shadowfit_hardware(map: shadowfit_Map, layer: i32, compare: sampler_comparison, projected: vec3<f32>) -> f32
/// fn shadowfit_percentage_closer(
///     map: shadowfit_Map, layer: i32, projected: vec3<f32>, taps: i32, reversed: bool,
/// ) -> f32
/// ```
#[doc(alias = "PCF")]
#[doc(alias = "percentage-closer filtering")]
pub const FILTERS: &str = include_str!("filters.wgsl");

/// Filters with virtual samples ([`crate::depth::TangentPlane`]), over 2 × 2 texels, blended, and over N × N: they need
/// no bias on planes. They need [`FILTERS`] before them. `parts` is
/// [`ShadowMap::comparison_tolerance`](crate::ShadowMap::comparison_tolerance), from which the second function makes the
/// tolerance that the others take; the normal is the triangle's, not a smooth one.
///
/// ```wgsl
/// struct shadowfit_Sampled { share: f32, used_plane: bool }
/// fn shadowfit_slopes(texture_from_origin: mat4x4<f32>, projected: vec3<f32>, normal: vec3<f32>) -> vec2<f32>
/// fn shadowfit_tolerance(
///     map: shadowfit_Map, texture_from_origin: mat4x4<f32>, position: vec3<f32>, slopes: vec2<f32>, parts: vec4<f32>,
/// ) -> f32
/// fn shadowfit_virtual_blended(
///     map: shadowfit_Map, layer: i32, projected: vec3<f32>, slopes: vec2<f32>, tolerance: f32, reversed: bool,
/// ) -> shadowfit_Sampled
/// fn shadowfit_virtual_mean(
///     map: shadowfit_Map, layer: i32, projected: vec3<f32>, slopes: vec2<f32>, taps: i32, tolerance: f32, reversed: bool,
/// ) -> shadowfit_Sampled
/// ```
#[doc(alias = "receiver plane depth bias")]
pub const VIRTUAL_SAMPLES: &str = include_str!("virtual_samples.wgsl");

/// Depth between two layers ([`DepthTest::BetweenLayers`](crate::depth::DepthTest)), of the nearest texel (one tap) or N × N.
/// They need [`FILTERS`] before them.
///
/// The first function is for the fragments of the second pass, which draws the same triangles with the same vertex shader
/// and matrix into a map of its own, with `first_layer` to read from: discard the fragments that it returns `false` for.
/// The position must be `@invariant` in both passes. `parts` is
/// [`ShadowMap::comparison_tolerance`](crate::ShadowMap::comparison_tolerance) for one texel, a reach of 0.5, which
/// counts once for each of the two depths, so that neither the rounding to the format nor a second triangle in the same
/// plane makes a layer.
///
/// ```wgsl
/// fn shadowfit_is_behind(
///     first_layer: shadowfit_Map, layer: i32, fragment: vec4<f32>, parts: vec4<f32>, reversed: bool,
/// ) -> bool
/// fn shadowfit_between_layers(
///     first_layer: shadowfit_Map, second_layer: shadowfit_Map, layer: i32, projected: vec3<f32>, taps: i32,
///     reversed: bool,
/// ) -> f32
/// ```
pub const BETWEEN_LAYERS: &str = include_str!("between_layers.wgsl");

#[cfg(test)]
mod tests {
    use super::super::validation::{assert_adds_only_its_own_names, validated};
    use super::*;
    use std::format;

    #[test]
    fn the_functions_are_valid_and_theirs_are_the_only_names() {
        for map in [MAP, MAP_ARRAY] {
            let texts = [PROJECT, map, FILTERS, VIRTUAL_SAMPLES, BETWEEN_LAYERS];
            for count in 1..=texts.len() {
                let text = texts[..count].concat();
                assert_adds_only_its_own_names(&validated(&text));
                // Naga does not look for uniform control flow, which a bare `textureSampleCompare` needs.
                assert!(!text.contains("textureSampleCompare("));
            }
        }
    }

    #[test]
    fn a_shader_can_call_them_on_a_texture_and_on_an_array() {
        let shader = "
            @group(0) @binding(1) var compare: sampler_comparison;
            @group(0) @binding(2) var<uniform> texture_from_origin: mat4x4<f32>;

            @fragment
            fn fragment(@location(0) position: vec3<f32>, @location(1) normal: vec3<f32>) -> @location(0) vec4<f32> {
                let projected = shadowfit_project(texture_from_origin, position);
                let slopes = shadowfit_slopes(texture_from_origin, projected, normal);
                let parts = vec4(1e-7, 1e-8, 1e-6, 1.0 / 256.0);
                let tolerance = shadowfit_tolerance(map, texture_from_origin, position, slopes, parts);
                let blended = shadowfit_virtual_blended(map, 1, projected, slopes, tolerance, false);
                let mean = shadowfit_virtual_mean(map, 0, projected, slopes, 3, tolerance, true);
                let nearest = shadowfit_nearest(map, 0, projected, false);
                let hardware = shadowfit_hardware(map, 1, compare, projected);
                let between = shadowfit_between_layers(map, second, 0, projected, 3, false);
                if (!shadowfit_is_behind(map, 0, vec4(projected, 1.0), parts, false)) {
                    discard;
                }
                return vec4(blended.share, mean.share, nearest, hardware)
                    * shadowfit_percentage_closer(map, 0, projected, 5, true) * between;
            }";
        for (map, kind) in [(MAP, "texture_depth_2d"), (MAP_ARRAY, "texture_depth_2d_array")] {
            let bindings =
                format!("@group(0) @binding(0) var map: {kind};\n@group(0) @binding(3) var second: {kind};\n");
            validated(&[PROJECT, map, FILTERS, VIRTUAL_SAMPLES, BETWEEN_LAYERS, &bindings, shader].concat());
        }
    }
}
