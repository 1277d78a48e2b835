// The layout of maps that are frusta: a matrix for each layer.

struct Layer {
    // The matrix as the crate gives it.
    texture_from_origin: mat4x4<f32>,
    // From where another API counts texture rows to where wgpu does; nothing for wgpu's own.
    sampled_from_texture: mat4x4<f32>,
}

@group(0) @binding(3) var<storage, read> layers: array<Layer>;

fn place_in(layer: i32, surface: vec4<f32>) -> vec3<f32> {
    let texture = layers[layer].sampled_from_texture * (layers[layer].texture_from_origin * surface);
    return texture.xyz / texture.w;
}
