//! Reducing a depth buffer to tiles.

/// Reduces the camera's depth buffer to tiles, each a [`DepthTile`](crate::seen::DepthTile), to be read back and fitted to
/// ([`Seen::from_tiles`](crate::seen::Seen::from_tiles)).
///
/// A workgroup of 64 invocations makes one tile. `clear` is the depth of the far plane: 0 in reversed depth, else 1. Tiles of 64
/// pixels make 30 × 17 of an image of 1920 × 1080, 14 KB to read back.
///
/// ```wgsl
/// struct shadowfit_DepthTile {
///     least: f32, greatest: f32, depth: f32, slope_x: f32, slope_y: f32, pixel: u32, pixels: u32,
/// }
/// fn shadowfit_reduce_tile(
///     depths: texture_depth_2d, image: vec2<u32>, tile: u32, clear: f32, workgroup: vec2<u32>, invocation: u32,
/// ) -> shadowfit_DepthTile
/// ```
///
/// The rest of the shader, dispatched with as many workgroups across and down as there are tiles:
///
/// ```wgsl
/// @group(0) @binding(0) var depths: texture_depth_2d;
/// @group(0) @binding(1) var<storage, read_write> tiles: array<shadowfit_DepthTile>;
///
/// @compute @workgroup_size(64)
/// fn reduce(
///     @builtin(workgroup_id) tile: vec3<u32>,
///     @builtin(num_workgroups) count: vec3<u32>,
///     @builtin(local_invocation_index) invocation: u32,
/// ) {
///     let reduced = shadowfit_reduce_tile(depths, textureDimensions(depths), 64u, 0.0, tile.xy, invocation);
///     if invocation == 0u {
///         tiles[tile.y * count.x + tile.x] = reduced;
///     }
/// }
/// ```
pub const DEPTH_TILES: &str = include_str!("depth_tiles.wgsl");

#[cfg(test)]
mod tests {
    use super::super::validation::validated;
    use super::DEPTH_TILES;
    use crate::seen::DepthTile;
    use naga::{AddressSpace, TypeInner};

    #[test]
    fn the_text_is_valid_and_all_its_names_are_its_own() {
        let module = validated(DEPTH_TILES);
        assert!(module.entry_points.is_empty());
        for (_, variable) in module.global_variables.iter() {
            assert_eq!(variable.space, AddressSpace::WorkGroup);
        }
        let variables = module.global_variables.iter().filter_map(|(_, one)| one.name.as_ref());
        let functions = module.functions.iter().filter_map(|(_, function)| function.name.as_ref());
        let types = module.types.iter().filter_map(|(_, of)| of.name.as_ref());
        assert!(variables.chain(functions).chain(types).all(|name| name.starts_with("shadowfit_")));
    }

    #[test]
    fn a_tile_is_as_large_on_both_sides() {
        let module = validated(DEPTH_TILES);
        let spans = module.types.iter().filter_map(|(_, of)| match &of.inner {
            TypeInner::Struct { span, .. } => Some(*span as usize),
            _ => None,
        });
        assert!(spans.eq([DepthTile::SIZE]));
    }
}
