// The one texel that the place lies in.

fn share_of_light(place: vec2<f32>, depth: f32) -> f32 {
    let size = vec2<f32>(textureDimensions(shadow_map));
    return passes(depth, vec2<i32>(floor(place * size)));
}
