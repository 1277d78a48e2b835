// The mean over a square of texels around the place (Reeves, Salesin & Cook 1987).

override taps: i32 = 3;

fn share_of_light(layer: i32, pixel: vec2<u32>, projected: vec3<f32>) -> vec2<f32> {
    return vec2(shadowfit_percentage_closer(shadow_maps, layer, projected, taps, reversed), 0.0);
}
