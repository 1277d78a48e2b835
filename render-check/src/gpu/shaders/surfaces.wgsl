// What the camera sees: the position of each pixel's surface, and which triangle it is.

struct Camera {
    clip_from_origin: mat4x4<f32>,
    // From positions about the geometry's origin to those that the shadow test is to have.
    tested_from_origin: mat4x4<f32>,
}

@group(0) @binding(0) var<uniform> camera: Camera;

struct Surface {
    @builtin(position) clip: vec4<f32>,
    // Relative to the origin that the geometry was uploaded about.
    @location(0) position: vec3<f32>,
    @location(1) @interpolate(flat) triangle: u32,
}

@vertex
fn vertex(@builtin(vertex_index) index: u32, @location(0) position: vec3<f32>) -> Surface {
    // Three vertices a triangle, none shared; 0 is the sky.
    return Surface(camera.clip_from_origin * vec4(position, 1.0), position, index / 3u + 1u);
}

struct Pixel {
    @location(0) position: vec4<f32>,
    @location(1) triangle: u32,
}

@fragment
fn fragment(surface: Surface) -> Pixel {
    return Pixel(camera.tested_from_origin * vec4(surface.position, 1.0), surface.triangle);
}
