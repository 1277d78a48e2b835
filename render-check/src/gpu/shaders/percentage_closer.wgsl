// The mean over a square of texels around the place.

override taps: i32 = 3;

fn share_of_light(pixel: vec2<u32>, projected: vec3<f32>) -> vec2<f32> {
    return vec2(shadowfit_percentage_closer(shadow_map, 0, projected, taps, reversed), 0.0);
}
