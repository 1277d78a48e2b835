// A square of texels around the place, each compared with the plane of the pixel's triangle: two a side blended, more the
// mean.

@group(0) @binding(4) var triangles: texture_2d<u32>;
@group(0) @binding(5) var<storage, read> normals: array<vec4<f32>>;

override taps: i32 = 2;

fn share_of_light(layer: i32, pixel: vec2<u32>, projected: vec3<f32>) -> vec2<f32> {
    // 0 is the sky, which is not asked for.
    let normal = normals[textureLoad(triangles, pixel, 0).x - 1u].xyz;
    let slopes = slopes_in(layer, projected, normal);
    let tolerance = tolerance_in(layer, textureLoad(surfaces, pixel, 0).xyz, slopes);
    var sampled: shadowfit_Sampled;
    if (taps == 2) {
        sampled = shadowfit_virtual_blended(shadow_maps, layer, projected, slopes, tolerance, reversed);
    } else {
        sampled = shadowfit_virtual_mean(shadow_maps, layer, projected, slopes, taps, tolerance, reversed);
    }
    return vec2(sampled.share, select(0.0, 1.0, sampled.used_plane));
}
