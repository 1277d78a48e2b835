// The one texel that the place lies in.

fn share_of_light(layer: i32, pixel: vec2<u32>, projected: vec3<f32>) -> vec2<f32> {
    return vec2(shadowfit_nearest(shadow_maps, layer, projected, reversed), 0.0);
}
