// The mean over a square of texels around the place (Reeves, Salesin & Cook 1987).

override taps: i32 = 3;

fn share_of_light(layer: i32, place: vec2<f32>, depth: f32) -> f32 {
    let size = vec2<f32>(textureDimensions(shadow_maps));
    // The middle of an odd square is a texel, that of an even one a corner between texels.
    let first = vec2<i32>(floor(place * size - 0.5 * f32(taps - 1)));
    var sum = 0.0;
    for (var y = 0; y < taps; y++) {
        for (var x = 0; x < taps; x++) {
            sum += passes(layer, depth, first + vec2(x, y));
        }
    }
    return sum / f32(taps * taps);
}
