// The discs of points as quads into a shadow map, without the corners of the quads. Needs the crate's functions for splats.

struct Light {
    // The matrix as the crate gives it.
    shadow_from_origin: mat4x4<f32>,
    // What the driver of another API does with its clip space before the rasteriser sees it; nothing for wgpu's own.
    raster_from_clip: mat4x4<f32>,
}

struct Disc {
    centre: vec3<f32>,
    radius: f32,
    normal: vec3<f32>,
}

@group(0) @binding(0) var<uniform> light: Light;
@group(0) @binding(1) var<storage, read> discs: array<Disc>;

// Texels along each side.
override map_size: f32 = 1024.0;
// Of the discs' radii: so little that no disc is larger than a texel makes bare points of them.
override scale: f32 = 1.0;

struct Corner {
    @builtin(position) clip: vec4<f32>,
    @location(0) offset: vec2<f32>,
}

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Corner {
    // Two triangles a disc: corners 0 1 2 and 3 2 1 of a quad.
    let disc = discs[index / 6u];
    let triangle_corner = index % 6u;
    let quad_corner = select(6u - triangle_corner, triangle_corner, triangle_corner < 3u);
    let corner = vec2(f32(quad_corner & 1u), f32(quad_corner >> 1u)) * 2.0 - 1.0;
    let radius = disc.radius * scale;
    let splat =
        shadowfit_splat_corner(light.shadow_from_origin, disc.centre, disc.normal, radius, vec2(map_size), corner);
    return Corner(light.raster_from_clip * splat.clip, splat.offset);
}

@fragment
fn fragment(@location(0) offset: vec2<f32>) {
    if (dot(offset, offset) > 1.0) {
        discard;
    }
}
