// The four texels around the place, compared and then blended by the sampler.

@group(0) @binding(3) var compare: sampler_comparison;

fn share_of_light(place: vec2<f32>, depth: f32) -> f32 {
    return textureSampleCompareLevel(shadow_map, compare, place, depth);
}
