// The maps of a view's cascades. Of eight depths or layers, four make a vector.
struct shadowfit_Cascades {
    // From positions, relative to the origin of the maps, to texture coordinates and the depth to compare.
    texture_from_origin: array<mat4x4<f32>, 8>,
    // The least and the largest texture coordinates inside the border of each map.
    inner: array<vec4<f32>, 8>,
    // The depth before the eye where each cascade ends.
    far: array<vec4<f32>, 2>,
    // The depth from which on the next cascade is blended in.
    blend: array<vec4<f32>, 2>,
    // The layer of each cascade's map, -1 for none: nothing that could be in shadow, or nothing that could cast.
    layer: array<vec4<i32>, 2>,
}

// The cascade that a depth before the eye belongs to.
fn shadowfit_cascade_at(far: array<vec4<f32>, 2>, depth: f32) -> i32 {
    let zero = vec4(0);
    let one = vec4(1);
    let ended = select(zero, one, vec4(depth) >= far[0]) + select(zero, one, vec4(depth) >= far[1]);
    return min(ended.x + ended.y + ended.z + ended.w, 7);
}

// How much of the next cascade to blend in, 0 to 1.
fn shadowfit_cascade_blend(
    far: array<vec4<f32>, 2>, blend: array<vec4<f32>, 2>, cascade: i32, depth: f32,
) -> f32 {
    // Variables, which an index that is no constant can look into.
    var ends = far;
    var begins = blend;
    let end = ends[cascade / 4][cascade % 4];
    let begin = begins[cascade / 4][cascade % 4];
    if depth <= begin {
        return 0.0;
    }
    return min((depth - begin) / (end - begin), 1.0);
}

// The layer of a cascade's map; -1 where it has none.
fn shadowfit_cascade_layer(layer: array<vec4<i32>, 2>, cascade: i32) -> i32 {
    var layers = layer;
    return layers[cascade / 4][cascade % 4];
}

// A place in a map, moved to where its filter reads nothing of another one. Receivers lie there already.
fn shadowfit_cascade_inside(inner: vec4<f32>, projected: vec3<f32>) -> vec3<f32> {
    return vec3(clamp(projected.xy, inner.xy, inner.zw), projected.z);
}
