// The shadow test of every pixel. Needs `full_screen.wgsl`; a layout, which answers
// `place_in(layer: i32, surface: vec4<f32>) -> vec3<f32>`: texture coordinates and depth; and a lookup, which answers
// `share_of_light(layer: i32, place: vec2<f32>, depth: f32) -> f32`.

@group(0) @binding(0) var surfaces: texture_2d<f32>;
@group(0) @binding(1) var shadow_maps: texture_depth_2d_array;

// Which layer answers for which directions from the light.
struct Split {
    // The light's position, relative to what surfaces are.
    light: vec4<f32>,
    // The axis of each part and, in w, its layer; −1 where nothing needs a map.
    parts: array<vec4<f32>>,
}

@group(0) @binding(2) var<storage, read> split: Split;

// Whether depth 1 is next to the light.
override reversed: bool = false;

@fragment
fn fragment(@builtin(position) pixel: vec4<f32>) -> @location(0) f32 {
    let surface = textureLoad(surfaces, vec2<u32>(pixel.xy), 0);
    if (surface.w == 0.0) {
        return 1.0;
    }
    let layer = layer_of(surface.xyz);
    if (layer < 0) {
        return 1.0;
    }
    let place = place_in(layer, surface);
    // A receiver beyond the farthest caster compares with the value that the map was cleared to.
    return share_of_light(layer, place.xy, clamp(place.z, 0.0, 1.0));
}

// The layer of the part whose axis is nearest to the direction from the light; the first one of two as near.
fn layer_of(position: vec3<f32>) -> i32 {
    let from_light = position - split.light.xyz;
    var nearest = split.parts[0];
    for (var i = 1u; i < arrayLength(&split.parts); i++) {
        if (dot(split.parts[i].xyz, from_light) > dot(nearest.xyz, from_light)) {
            nearest = split.parts[i];
        }
    }
    return i32(nearest.w);
}

// The comparison of one texel, the same as a comparison sampler's.
fn passes(layer: i32, depth: f32, texel: vec2<i32>) -> f32 {
    let last = vec2<i32>(textureDimensions(shadow_maps)) - 1;
    let stored = textureLoad(shadow_maps, clamp(texel, vec2(0), last), layer, 0);
    return select(0.0, 1.0, select(depth <= stored, depth >= stored, reversed));
}
