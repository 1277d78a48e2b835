// Whether a fragment, by its position in the framebuffer, lies behind the first layer in its texel: all others are
// to be discarded as the second layer is drawn. `parts` is the map's `comparison_tolerance`, which counts once for each of
// the two depths.
fn shadowfit_is_behind(
    first_layer: shadowfit_Map, layer: i32, fragment: vec4<f32>, parts: vec4<f32>, reversed: bool,
) -> bool {
    // A fragment's w is 1/w.
    let gap = 2.0 * (parts.x + min(parts.y * fragment.w, parts.z));
    let behind = fragment.z - shadowfit_stored(first_layer, layer, vec2<i32>(fragment.xy));
    return select(behind, -behind, reversed) > gap;
}

// The share of light, by a square of texels, `taps` across and down, each compared with the middle of its two layers
// (Woo 1992). One tap is the texel that the place lies in.
fn shadowfit_between_layers(
    first_layer: shadowfit_Map, second_layer: shadowfit_Map, layer: i32, projected: vec3<f32>, taps: i32,
    reversed: bool,
) -> f32 {
    let corner = shadowfit_first(first_layer, projected.xy, taps);
    let last = shadowfit_size(first_layer) - 1;
    var passed = 0;
    for (var y = 0; y < taps; y++) {
        for (var x = 0; x < taps; x++) {
            let texel = clamp(corner + vec2(x, y), vec2(0), last);
            let first = shadowfit_stored(first_layer, layer, texel);
            let second = shadowfit_stored(second_layer, layer, texel);
            let beyond = clamp(projected.z, 0.0, 1.0) - 0.5 * (first + second);
            passed += select(0, 1, select(beyond, -beyond, reversed) <= 0.0);
        }
    }
    return f32(passed) / f32(taps * taps);
}
