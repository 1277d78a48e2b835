// The shadow test of every pixel. Needs `full_screen.wgsl`, the crate's functions, and one lookup, which answers
// `share_of_light(pixel: vec2<u32>, projected: vec3<f32>) -> vec2<f32>`: the share, and 1 where virtual samples decided.

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

fn sampled_from_origin() -> mat4x4<f32> {
    return receiver.sampled_from_texture * receiver.texture_from_origin;
}

@fragment
fn fragment(@builtin(position) pixel: vec4<f32>) -> @location(0) vec2<f32> {
    let surface = textureLoad(surfaces, vec2<u32>(pixel.xy), 0);
    if (surface.w == 0.0) {
        return vec2(1.0, 0.0);
    }
    return share_of_light(vec2<u32>(pixel.xy), shadowfit_project(sampled_from_origin(), surface.xyz));
}
