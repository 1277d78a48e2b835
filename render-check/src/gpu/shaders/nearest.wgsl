// The one texel that the place lies in.

fn share_of_light(layer: i32, place: vec2<f32>, depth: f32) -> f32 {
    let size = vec2<f32>(textureDimensions(shadow_maps));
    return passes(layer, depth, vec2<i32>(floor(place * size)));
}
