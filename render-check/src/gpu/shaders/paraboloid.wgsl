// The layout of maps that are paraboloids. Needs the crate's functions for them.

struct Layer {
    // The matrix for receivers, as the crate gives it.
    matrix: mat4x4<f32>,
    // The crate's, turned from where another API counts texture rows to where wgpu does.
    texture_scale: vec4<f32>,
}

@group(0) @binding(3) var<storage, read> layers: array<Layer>;

fn place_in(layer: i32, position: vec3<f32>) -> vec3<f32> {
    return shadowfit_paraboloid_texture(layers[layer].matrix, layers[layer].texture_scale, position).xyz;
}
