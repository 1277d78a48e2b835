// The mean over a square of texels around the place, each compared with the middle of its first two layers; one texel is
// the one that the place lies in.

@group(0) @binding(4) var second_layers: texture_depth_2d_array;

override taps: i32 = 1;

fn share_of_light(layer: i32, pixel: vec2<u32>, projected: vec3<f32>) -> vec2<f32> {
    return vec2(shadowfit_between_layers(shadow_maps, second_layers, layer, projected, taps, reversed), 0.0);
}
