// A map in a texture of its own. The layer plays no part.
alias shadowfit_Map = texture_depth_2d;

fn shadowfit_size(map: shadowfit_Map) -> vec2<i32> {
    return vec2<i32>(textureDimensions(map));
}

fn shadowfit_stored(map: shadowfit_Map, layer: i32, texel: vec2<i32>) -> f32 {
    return textureLoad(map, texel, 0);
}

fn shadowfit_compared(
    map: shadowfit_Map, layer: i32, compare: sampler_comparison, place: vec2<f32>, depth: f32,
) -> f32 {
    return textureSampleCompareLevel(map, compare, place, depth);
}
