// The four texels around the place, compared and then blended by the sampler.

@group(0) @binding(4) var compare: sampler_comparison;

fn share_of_light(layer: i32, place: vec2<f32>, depth: f32) -> f32 {
    return textureSampleCompareLevel(shadow_maps, compare, place, layer, depth);
}
