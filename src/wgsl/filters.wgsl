// The comparison of one texel: lit is at most the stored depth, or at least it where depth is reversed. A receiver beyond
// the depth range compares with the value that the map was cleared to.
fn shadowfit_passes(
    map: shadowfit_Map, layer: i32, texel: vec2<i32>, depth: f32, tolerance: f32, reversed: bool,
) -> bool {
    let stored = shadowfit_stored(map, layer, clamp(texel, vec2(0), shadowfit_size(map) - 1));
    let beyond = clamp(depth, 0.0, 1.0) - stored;
    return select(beyond, -beyond, reversed) <= tolerance;
}

// How many of a square of texels, `taps` across and down, a depth passes against.
fn shadowfit_passed(
    map: shadowfit_Map, layer: i32, first: vec2<i32>, taps: i32, depth: f32, tolerance: f32, reversed: bool,
) -> i32 {
    var passed = 0;
    for (var y = 0; y < taps; y++) {
        for (var x = 0; x < taps; x++) {
            passed += select(0, 1, shadowfit_passes(map, layer, first + vec2(x, y), depth, tolerance, reversed));
        }
    }
    return passed;
}

// The first column and row of the square of texels around a place. The middle of an odd square is a texel, that of an
// even one a corner between texels.
fn shadowfit_first(map: shadowfit_Map, place: vec2<f32>, taps: i32) -> vec2<i32> {
    return vec2<i32>(floor(place * vec2<f32>(shadowfit_size(map)) - 0.5 * f32(taps - 1)));
}

// The share of light, by the one texel that a place lies in.
fn shadowfit_nearest(map: shadowfit_Map, layer: i32, projected: vec3<f32>, reversed: bool) -> f32 {
    return shadowfit_percentage_closer(map, layer, projected, 1, reversed);
}

// By the four texels around it, compared and then blended by the sampler, which compares with 'less or equal', or with
// 'greater or equal' where depth is reversed.
fn shadowfit_hardware(
    map: shadowfit_Map, layer: i32, compare: sampler_comparison, projected: vec3<f32>,
) -> f32 {
    return shadowfit_compared(map, layer, compare, projected.xy, clamp(projected.z, 0.0, 1.0));
}

// By a square of texels, each counted alike: percentage-closer filtering (Reeves, Salesin & Cook 1987).
fn shadowfit_percentage_closer(
    map: shadowfit_Map, layer: i32, projected: vec3<f32>, taps: i32, reversed: bool,
) -> f32 {
    let first = shadowfit_first(map, projected.xy, taps);
    return f32(shadowfit_passed(map, layer, first, taps, projected.z, 0.0, reversed)) / f32(taps * taps);
}
