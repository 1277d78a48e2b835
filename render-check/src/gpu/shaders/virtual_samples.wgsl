// A square of texels around the place, each compared with the plane of the pixel's triangle: two a side blended, more the
// mean.

@group(0) @binding(3) var triangles: texture_2d<u32>;
@group(0) @binding(4) var<storage, read> normals: array<vec4<f32>>;

override taps: i32 = 2;
// What a comparison allows for rounding.
override tolerance: f32 = 0.0;

fn share_of_light(pixel: vec2<u32>, projected: vec3<f32>) -> vec2<f32> {
    // 0 is the sky, which is not asked for.
    let normal = normals[textureLoad(triangles, pixel, 0).x - 1u].xyz;
    let slopes = shadowfit_slopes(sampled_from_origin(), projected, normal);
    var sampled: shadowfit_Sampled;
    if (taps == 2) {
        sampled = shadowfit_virtual_blended(shadow_map, 0, projected, slopes, tolerance, reversed);
    } else {
        sampled = shadowfit_virtual_mean(shadow_map, 0, projected, slopes, taps, tolerance, reversed);
    }
    return vec2(sampled.share, select(0.0, 1.0, sampled.used_plane));
}
