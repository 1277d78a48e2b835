// Paraboloid maps: one hemisphere of a point light in one map (Brabec, Annen & Seidel 2002).
//
// `matrix` is Paraboloid::caster_matrix, or Paraboloid::receiver_matrix_with to read the map; `clip_scale` and
// `texture_scale` are the results of the methods of these names. Positions are in world space, or relative to the origin of
// the settings.

// The output of the vertex shader that draws into the map, and the input of its fragment shader.
struct ShadowfitParaboloidVertex {
    // The clip position; w is 1. z is in the middle of nothing: depth is written by the fragment, and a triangle whose
    // corners are nearer or farther than the map's depths may well have them in between.
    @builtin(position) position: vec4<f32>,
    // (q, 1) over |q| + q.z, whose first two numbers are the place (u, v). The four are linear in the map, on each triangle.
    @location(0) surface: vec4<f32>,
}

// |q.xyz| + q.z, which is no larger than this rounding of it straight behind the light: such vertices are cut off, but they
// must be somewhere.
fn shadowfit_paraboloid_divisor(distance: f32, along: f32) -> f32 {
    return max(distance + along, 1e-6 * distance + 1e-30);
}

// For the vertex shader that draws into the map.
fn shadowfit_paraboloid_clip(
    matrix: mat4x4<f32>,
    clip_scale: vec2<f32>,
    position: vec3<f32>,
) -> ShadowfitParaboloidVertex {
    let q = matrix * vec4(position, 1.0);
    let surface = vec4(q.xyz, 1.0) / shadowfit_paraboloid_divisor(length(q.xyz), q.z);
    return ShadowfitParaboloidVertex(vec4(surface.xy * clip_scale, 0.0, 1.0), surface);
}

// For the fragment shader that draws into the map: what to write as depth. Fragments that the map has no place for are
// discarded. `bias` is DepthBias::in_shader, or zeros.
//
// The rasteriser draws straight edges where the map has arcs, so that a fragment's point of the triangle is seen a little
// beside the fragment. The depth is not that point's but the one where the ray through the fragment meets the triangle's
// plane: so a plane has the right depths, however coarsely it is cut, and bias is for the filter and for rounding alone.
fn shadowfit_paraboloid_depth(
    matrix: mat4x4<f32>,
    clip_scale: vec2<f32>,
    texture_scale: vec4<f32>,
    vertex: ShadowfitParaboloidVertex,
    bias: vec2<f32>,
) -> f32 {
    let surface = vertex.surface;
    let across = dpdx(surface);
    let down = dpdy(surface);
    // The fragment's point is cut off where it is farther behind the light than the map reaches, 1/inner in the middle of
    // its sides, so that filters at the rim find texels there. It must be: a triangle behind the light has its vertices
    // outside of the disc, on all sides of it, and with straight edges between them it would cover the map. At a point of
    // the triangle 1 − 2z, over the same divisor, is the square of (u, v), wherever the fragment is.
    if (clip_scale.x * clip_scale.x * (1.0 - 2.0 * surface.z) > 1.0) {
        discard;
    }
    // The plane of the triangle is where plane · x = 1, so that plane · direction is 1 over the distance along a ray.
    let normal = cross(
        across.xyz * surface.w - surface.xyz * across.w,
        down.xyz * surface.w - surface.xyz * down.w,
    );
    let plane = normal * (surface.w / dot(normal, surface.xyz));
    let square = dot(surface.xy, surface.xy);
    let direction = vec3(2.0 * surface.xy, 1.0 - square) / (1.0 + square);
    let nearness = dot(plane, direction);
    if (nearness * matrix[3].w > 1.0) {
        // Nearer to the light than its near distance, where nothing casts.
        discard;
    }
    // The least nearness of the plane within the reach of the bias: that of the place, less its slope, less its curvature.
    let slope = abs(dot(plane, shadowfit_paraboloid_turn(surface.xy, direction, across.xy)))
        + abs(dot(plane, shadowfit_paraboloid_turn(surface.xy, direction, down.xy)));
    let least = nearness - bias.y * (slope + 4.0 * bias.y * dot(across.xy, across.xy) * length(plane));
    // Not so for planes that the light sees from their edge, all of whose numbers may be none.
    if (!(least > 0.0)) {
        return texture_scale.z + texture_scale.w;
    }
    let depth = clamp(1.0 / least - matrix[3].w + bias.x, 0.0, 1.0);
    return depth * texture_scale.z + texture_scale.w;
}

// How much the direction at a place changes with a step in (u, v).
fn shadowfit_paraboloid_turn(place: vec2<f32>, direction: vec3<f32>, step: vec2<f32>) -> vec3<f32> {
    let along = dot(place, step);
    return (1.0 + direction.z) * (vec3(step, -along) - along * direction);
}

// For reading the map: the texture coordinates, the depth to compare for the position, and a last number that
// is negative for positions in the other hemisphere.
fn shadowfit_paraboloid_texture(
    matrix: mat4x4<f32>,
    texture_scale: vec4<f32>,
    position: vec3<f32>,
) -> vec4<f32> {
    let q = matrix * vec4(position, 1.0);
    let distance = length(q.xyz);
    let place = q.xy / shadowfit_paraboloid_divisor(distance, q.z);
    let depth = distance - q.w;
    return vec4(0.5 + place * texture_scale.xy, depth * texture_scale.z + texture_scale.w, q.z);
}
