//! Functions that choose among the maps of cascades.

/// The cascade that a depth belongs to, and where in its map to look, see [`Cascades`](crate::cascades::Cascades).
///
/// `shadowfit_Cascades` is a struct for a shader's own uniform or storage buffer, filled with
/// [`CascadeUniform::to_bytes`](crate::cascades::CascadeUniform::to_bytes). With a matrix of it,
/// [`PROJECT`](super::PROJECT) and the filters work as on any map, in an array and in an atlas alike.
///
/// ```wgsl
/// struct shadowfit_Cascades {
///     texture_from_origin: array<mat4x4<f32>, 8>,
///     inner: array<vec4<f32>, 8>,
///     far: array<vec4<f32>, 2>,
///     blend: array<vec4<f32>, 2>,
///     layer: array<vec4<i32>, 2>,
/// }
/// fn shadowfit_cascade_at(far: array<vec4<f32>, 2>, depth: f32) -> i32
/// fn shadowfit_cascade_blend(far: array<vec4<f32>, 2>, blend: array<vec4<f32>, 2>, cascade: i32, depth: f32) -> f32
/// fn shadowfit_cascade_layer(layer: array<vec4<i32>, 2>, cascade: i32) -> i32
/// fn shadowfit_cascade_inside(inner: vec4<f32>, projected: vec3<f32>) -> vec3<f32>
/// ```
///
/// A shader that blends:
///
/// ```wgsl
/// fn light_of(cascade: i32, position: vec3<f32>) -> f32 {
///     let layer = shadowfit_cascade_layer(cascades.layer, cascade);
///     if layer < 0 {
///         return 1.0;
///     }
///     let projected = shadowfit_project(cascades.texture_from_origin[cascade], position);
///     return shadowfit_hardware(maps, layer, compare, shadowfit_cascade_inside(cascades.inner[cascade], projected));
/// }
///
/// fn light(depth: f32, position: vec3<f32>) -> f32 {
///     let cascade = shadowfit_cascade_at(cascades.far, depth);
///     let blend = shadowfit_cascade_blend(cascades.far, cascades.blend, cascade, depth);
///     if blend == 0.0 {
///         return light_of(cascade, position);
///     }
///     return mix(light_of(cascade, position), light_of(cascade + 1, position), blend);
/// }
/// ```
pub const CASCADES: &str = include_str!("cascades.wgsl");

#[cfg(test)]
mod tests {
    use super::super::validation::{assert_adds_only_its_own_names, validated};
    use super::super::{CASCADES, FILTERS, MAP, MAP_ARRAY, PROJECT};
    use crate::cascades::CascadeUniform;
    use core::mem::offset_of;
    use naga::TypeInner;
    use std::format;
    use std::vec::Vec;

    #[test]
    fn the_functions_are_valid_and_theirs_are_the_only_names() {
        assert_adds_only_its_own_names(&validated(CASCADES));
    }

    /// The shader's struct lies in memory as the one that is uploaded.
    #[test]
    fn the_block_is_laid_out_alike() {
        let module = validated(CASCADES);
        let block = module.types.iter().find(|(_, of)| of.name.as_deref() == Some("shadowfit_Cascades"));
        let Some((_, naga::Type { inner: TypeInner::Struct { members, span }, .. })) = block else {
            panic!("no struct");
        };
        let theirs: Vec<_> = members
            .iter()
            .map(|member| (member.name.as_deref().unwrap_or_default(), member.offset as usize))
            .collect();
        let ours = [
            ("texture_from_origin", offset_of!(CascadeUniform, texture_from_origin)),
            ("inner", offset_of!(CascadeUniform, inner)),
            ("far", offset_of!(CascadeUniform, far)),
            ("blend", offset_of!(CascadeUniform, blend)),
            ("layer", offset_of!(CascadeUniform, layer)),
        ];
        assert_eq!(theirs, ours);
        assert_eq!(*span as usize, CascadeUniform::SIZE);
    }

    /// The shader of the documentation, on an atlas and on an array.
    #[test]
    fn a_shader_can_blend_cascades() {
        let text = include_str!("cascades.rs");
        let (_, example) = text.split_once("/// A shader that blends:\n").expect("the example");
        let (_, example) = example.split_once("/// ```wgsl\n").expect("its text");
        let (example, _) = example.split_once("/// ```\n").expect("its end");
        let example = example.replace("///", "");
        let shader = "
            @group(0) @binding(1) var compare: sampler_comparison;
            @group(0) @binding(2) var<uniform> cascades: shadowfit_Cascades;

            @fragment
            fn fragment(
                @location(0) position: vec3<f32>, @location(1) depth: f32,
            ) -> @location(0) vec4<f32> {
                return vec4(light(depth, position));
            }";
        for (map, kind) in [(MAP, "texture_depth_2d"), (MAP_ARRAY, "texture_depth_2d_array")] {
            let bindings = format!("@group(0) @binding(0) var maps: {kind};\n");
            validated(&[PROJECT, map, FILTERS, CASCADES, &bindings, &example, shader].concat());
        }
    }
}
