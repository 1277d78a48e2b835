// Casters into a paraboloid map. Needs the crate's functions for paraboloids.

struct Light {
    // All as the crate gives it.
    matrix: mat4x4<f32>,
    // What the driver of another API does with its clip space before the rasteriser sees it; nothing for wgpu's own.
    raster_from_clip: mat4x4<f32>,
    texture_scale: vec4<f32>,
    clip_scale: vec2<f32>,
    bias: vec2<f32>,
}

@group(0) @binding(0) var<uniform> light: Light;

@vertex
fn vertex(@location(0) position: vec3<f32>) -> ShadowfitParaboloidVertex {
    let vertex = shadowfit_paraboloid_clip(light.matrix, light.clip_scale, position);
    return ShadowfitParaboloidVertex(light.raster_from_clip * vertex.position, vertex.surface);
}

@fragment
fn fragment(vertex: ShadowfitParaboloidVertex) -> @builtin(frag_depth) f32 {
    return shadowfit_paraboloid_depth(light.matrix, light.clip_scale, light.texture_scale, vertex, light.bias);
}
