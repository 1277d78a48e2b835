@group(0) @binding(0) var depths: texture_depth_2d;
@group(0) @binding(1) var<storage, read_write> tiles: array<shadowfit_DepthTile>;

override tile: u32;

@compute @workgroup_size(64)
fn reduce(
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(num_workgroups) count: vec3<u32>,
    @builtin(local_invocation_index) invocation: u32,
) {
    // The camera's depth is reversed.
    let reduced = shadowfit_reduce_tile(depths, textureDimensions(depths), tile, 0.0, workgroup.xy, invocation);
    if invocation == 0u {
        tiles[workgroup.y * count.x + workgroup.x] = reduced;
    }
}
