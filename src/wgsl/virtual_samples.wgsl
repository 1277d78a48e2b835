// The result of a test with virtual samples (Wang & Molnar 1994, Fig. 10).
struct shadowfit_Sampled {
    // The share of light, 0 to 1.
    share: f32,
    // Whether the texels disagreed, so that the plane was asked.
    used_plane: bool,
}

// The changes of a receiver's depth with each of the texture coordinates, along its plane. The normal may have any length
// and look to either side.
fn shadowfit_slopes(texture_from_origin: mat4x4<f32>, projected: vec3<f32>, normal: vec3<f32>) -> vec2<f32> {
    // Gradients of u, v and depth, but for a factor that cancels: it is chosen so that no product underflows.
    let rows = transpose(texture_from_origin);
    let w = rows[3].xyz;
    let across_u = rows[0].xyz - projected.x * w;
    let across_v = rows[1].xyz - projected.y * w;
    let largest = max(abs(across_u), abs(across_v));
    let factor = 1.0 / max(largest.x, max(largest.y, largest.z));
    let u = factor * across_u;
    let v = factor * across_v;
    let z = factor * (rows[2].xyz - projected.z * w);
    // Along the light's ray; a plane that it meets at less than a quarter of a degree is taken for one at that angle.
    let along = cross(u, v);
    let least = length(along) * length(normal) / 256.0;
    let facing = dot(normal, along);
    let bounded = select(max(facing, least), min(facing, -least), facing < 0.0);
    return vec2(dot(normal, cross(z, v)), dot(normal, cross(u, z))) / bounded;
}

// The rounding that a comparison with the plane allows for at a position. `parts` is the map's `comparison_tolerance`: its
// constant, the part over w, the most of that, and the factor of the slopes.
fn shadowfit_tolerance(
    map: shadowfit_Map, texture_from_origin: mat4x4<f32>, position: vec3<f32>, slopes: vec2<f32>, parts: vec4<f32>,
) -> f32 {
    let w = (texture_from_origin * vec4(position, 1.0)).w;
    let steps = abs(slopes) / vec2<f32>(shadowfit_size(map));
    return parts.x + min(parts.y / w, parts.z) + parts.w * (steps.x + steps.y);
}

// Whether the plane passes at a texel's centre.
fn shadowfit_plane_passes(
    map: shadowfit_Map, layer: i32, texel: vec2<i32>, projected: vec3<f32>, slopes: vec2<f32>, tolerance: f32,
    reversed: bool,
) -> bool {
    let size = shadowfit_size(map);
    let inside = clamp(texel, vec2(0), size - 1);
    let centre = (vec2<f32>(inside) + 0.5) / vec2<f32>(size);
    let depth = projected.z + dot(slopes, centre - projected.xy);
    return shadowfit_passes(map, layer, inside, depth, tolerance, reversed);
}

// The share of light by the four texels around a place, blended by its distance from their centres.
fn shadowfit_virtual_blended(
    map: shadowfit_Map, layer: i32, projected: vec3<f32>, slopes: vec2<f32>, tolerance: f32, reversed: bool,
) -> shadowfit_Sampled {
    let first = shadowfit_first(map, projected.xy, 2);
    let passed = shadowfit_passed(map, layer, first, 2, projected.z, tolerance, reversed);
    if (passed == 0 || passed == 4) {
        return shadowfit_Sampled(f32(passed) / 4.0, false);
    }
    let part = fract(projected.xy * vec2<f32>(shadowfit_size(map)) - 0.5);
    var share = 0.0;
    for (var y = 0; y < 2; y++) {
        for (var x = 0; x < 2; x++) {
            let texel = first + vec2(x, y);
            if (shadowfit_plane_passes(map, layer, texel, projected, slopes, tolerance, reversed)) {
                let weight = select(1.0 - part, part, vec2(x, y) == vec2(1));
                share += weight.x * weight.y;
            }
        }
    }
    return shadowfit_Sampled(min(share, 1.0), true);
}

// By a square of texels, `taps` across and down, each counted alike. One tap always asks the plane.
fn shadowfit_virtual_mean(
    map: shadowfit_Map, layer: i32, projected: vec3<f32>, slopes: vec2<f32>, taps: i32, tolerance: f32, reversed: bool,
) -> shadowfit_Sampled {
    let first = shadowfit_first(map, projected.xy, taps);
    let all = taps * taps;
    let passed = shadowfit_passed(map, layer, first, taps, projected.z, tolerance, reversed);
    if (taps > 1 && (passed == 0 || passed == all)) {
        return shadowfit_Sampled(f32(passed) / f32(all), false);
    }
    var of_plane = 0;
    for (var y = 0; y < taps; y++) {
        for (var x = 0; x < taps; x++) {
            let texel = first + vec2(x, y);
            let passes = shadowfit_plane_passes(map, layer, texel, projected, slopes, tolerance, reversed);
            of_plane += select(0, 1, passes);
        }
    }
    return shadowfit_Sampled(f32(of_plane) / f32(all), true);
}
