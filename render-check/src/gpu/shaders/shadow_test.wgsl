// The shadow test of every pixel. Needs `full_screen.wgsl` and one lookup, which answers
// `share_of_light(place: vec2<f32>, depth: f32) -> f32`.

struct Receiver {
    // The matrix as the crate gives it.
    texture_from_origin: mat4x4<f32>,
    // From where another API counts texture rows to where wgpu does; nothing for wgpu's own.
    sampled_from_texture: mat4x4<f32>,
}

@group(0) @binding(0) var<uniform> receiver: Receiver;
@group(0) @binding(1) var surfaces: texture_2d<f32>;
@group(0) @binding(2) var shadow_map: texture_depth_2d;

// Whether depth 1 is next to the light.
override reversed: bool = false;

@fragment
fn fragment(@builtin(position) pixel: vec4<f32>) -> @location(0) f32 {
    let surface = textureLoad(surfaces, vec2<u32>(pixel.xy), 0);
    if (surface.w == 0.0) {
        return 1.0;
    }
    let texture = receiver.sampled_from_texture * (receiver.texture_from_origin * surface);
    // A receiver beyond the farthest caster compares with the value that the map was cleared to.
    return share_of_light(texture.xy / texture.w, clamp(texture.z / texture.w, 0.0, 1.0));
}

// The comparison of one texel, the same as a comparison sampler's.
fn passes(depth: f32, texel: vec2<i32>) -> f32 {
    let last = vec2<i32>(textureDimensions(shadow_map)) - 1;
    let stored = textureLoad(shadow_map, clamp(texel, vec2(0), last), 0);
    return select(0.0, 1.0, select(depth <= stored, depth >= stored, reversed));
}
