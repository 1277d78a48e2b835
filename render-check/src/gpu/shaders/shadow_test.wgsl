// The shadow test of every pixel. Needs `full_screen.wgsl`; the crate's functions; a layout, which answers
// `place_in(layer: i32, position: vec3<f32>) -> vec3<f32>`: texture coordinates and depth; and a lookup, which answers
// `share_of_light(layer: i32, pixel: vec2<u32>, projected: vec3<f32>) -> vec2<f32>`: the share, and 1 where virtual
// samples decided.

@group(0) @binding(0) var surfaces: texture_2d<f32>;
@group(0) @binding(1) var shadow_maps: texture_depth_2d_array;

// Which layer answers for which directions from the light, or for which depths before the eye.
struct Split {
    // The light's position, relative to what surfaces are; w is 1 where the parts are cascades.
    light: vec4<f32>,
    // What such a position, and 1, are multiplied by for the depth before the eye.
    depth: vec4<f32>,
    // The depth where each cascade ends.
    far: array<vec4<f32>, 2>,
    // The axis of each part and, in w, its layer; −1 where nothing needs a map.
    parts: array<vec4<f32>>,
}

@group(0) @binding(2) var<storage, read> split: Split;

// Whether depth 1 is next to the light.
override reversed: bool = false;

@fragment
fn fragment(@builtin(position) pixel: vec4<f32>) -> @location(0) vec2<f32> {
    let surface = textureLoad(surfaces, vec2<u32>(pixel.xy), 0);
    if (surface.w == 0.0) {
        return vec2(1.0, 0.0);
    }
    let layer = layer_of(surface.xyz);
    if (layer < 0) {
        return vec2(1.0, 0.0);
    }
    return share_of_light(layer, vec2<u32>(pixel.xy), place_in(layer, surface.xyz));
}

// The layer of the cascade, or of the part whose axis is nearest to the direction from the light; the first one of two as near.
fn layer_of(position: vec3<f32>) -> i32 {
    if (split.light.w > 0.0) {
        return i32(split.parts[shadowfit_cascade_at(split.far, dot(split.depth, vec4(position, 1.0)))].w);
    }
    let from_light = position - split.light.xyz;
    var nearest = split.parts[0];
    for (var i = 1u; i < arrayLength(&split.parts); i++) {
        if (dot(split.parts[i].xyz, from_light) > dot(nearest.xyz, from_light)) {
            nearest = split.parts[i];
        }
    }
    return i32(nearest.w);
}
