// The four texels around the place, compared and then blended by the sampler.

@group(0) @binding(4) var compare: sampler_comparison;

fn share_of_light(layer: i32, pixel: vec2<u32>, projected: vec3<f32>) -> vec2<f32> {
    return vec2(shadowfit_hardware(shadow_maps, layer, compare, projected), 0.0);
}
