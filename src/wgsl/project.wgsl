// Where a position lies in a map: texture coordinates, and the depth to compare there. The position is relative to
// the origin of the map.
fn shadowfit_project(texture_from_origin: mat4x4<f32>, position: vec3<f32>) -> vec3<f32> {
    let texture = texture_from_origin * vec4(position, 1.0);
    return texture.xyz / texture.w;
}
