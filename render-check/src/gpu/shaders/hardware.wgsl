// The four texels around the place, compared and then blended by the sampler.

@group(0) @binding(3) var compare: sampler_comparison;

fn share_of_light(pixel: vec2<u32>, projected: vec3<f32>) -> vec2<f32> {
    return vec2(shadowfit_hardware(shadow_map, 0, compare, projected), 0.0);
}
