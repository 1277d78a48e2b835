// The layout of maps that are frusta: a matrix for each layer.

struct Layer {
    // The matrix as the crate gives it.
    texture_from_origin: mat4x4<f32>,
    // From where another API counts texture rows to where wgpu does; nothing for wgpu's own.
    sampled_from_texture: mat4x4<f32>,
    // What a comparison with a plane allows for, in the parts that the crate gives.
    tolerance: vec4<f32>,
}

@group(0) @binding(3) var<storage, read> layers: array<Layer>;

fn sampled_from_origin(layer: i32) -> mat4x4<f32> {
    return layers[layer].sampled_from_texture * layers[layer].texture_from_origin;
}

fn place_in(layer: i32, position: vec3<f32>) -> vec3<f32> {
    return shadowfit_project(sampled_from_origin(layer), position);
}

fn slopes_in(layer: i32, projected: vec3<f32>, normal: vec3<f32>) -> vec2<f32> {
    return shadowfit_slopes(sampled_from_origin(layer), projected, normal);
}

fn tolerance_in(layer: i32, position: vec3<f32>, slopes: vec2<f32>) -> f32 {
    return shadowfit_tolerance(shadow_maps, sampled_from_origin(layer), position, slopes, layers[layer].tolerance);
}
