// The maps of a view's slices. Of eight depths or layers, four make a vector.
struct shadowfit_Slices {
    // From positions, relative to what the maps take them relative to, to texture coordinates and the depth to compare.
    texture_from_origin: array<mat4x4<f32>, 8>,
    // The least and the largest texture coordinates inside the border of each map.
    inner: array<vec4<f32>, 8>,
    // The depth before the eye where each slice ends.
    far: array<vec4<f32>, 2>,
    // The depth from which on the next slice is blended in.
    blend: array<vec4<f32>, 2>,
    // The layer of each slice's map, -1 for none: nothing that could be in shadow, or nothing that could cast.
    layer: array<vec4<i32>, 2>,
}

// The slice that a depth before the eye belongs to.
fn shadowfit_slice_at(far: array<vec4<f32>, 2>, depth: f32) -> i32 {
    let zero = vec4(0);
    let one = vec4(1);
    let ended = select(zero, one, vec4(depth) >= far[0]) + select(zero, one, vec4(depth) >= far[1]);
    return min(ended.x + ended.y + ended.z + ended.w, 7);
}

// How much of the next slice to blend in, 0 to 1.
fn shadowfit_slice_blend(
    far: array<vec4<f32>, 2>, blend: array<vec4<f32>, 2>, slice: i32, depth: f32,
) -> f32 {
    // What an index that is no constant can look into.
    var ends = far;
    var begins = blend;
    let end = ends[slice / 4][slice % 4];
    let begin = begins[slice / 4][slice % 4];
    if depth <= begin {
        return 0.0;
    }
    return min((depth - begin) / (end - begin), 1.0);
}

// The layer of a slice's map; -1 where it has none.
fn shadowfit_slice_layer(layer: array<vec4<i32>, 2>, slice: i32) -> i32 {
    var layers = layer;
    return layers[slice / 4][slice % 4];
}

// A place in a map, moved to where its filter reads nothing of another one. What is visible lies there already.
fn shadowfit_slice_inside(inner: vec4<f32>, projected: vec3<f32>) -> vec3<f32> {
    return vec3(clamp(projected.xy, inner.xy, inner.zw), projected.z);
}
