// Casters into a shadow map: the depth buffer is all that comes of it.

struct Light {
    // The matrix as the crate gives it.
    shadow_from_origin: mat4x4<f32>,
    // What the driver of another API does with its clip space before the rasteriser sees it; nothing for wgpu's own.
    raster_from_clip: mat4x4<f32>,
}

@group(0) @binding(0) var<uniform> light: Light;

@vertex
fn vertex(@location(0) position: vec3<f32>) -> @invariant @builtin(position) vec4<f32> {
    return light.raster_from_clip * (light.shadow_from_origin * vec4(position, 1.0));
}
