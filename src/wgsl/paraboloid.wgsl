// Paraboloid maps: half of everything around a light in one map (Brabec, Annen & Seidel 2002).
//
// `matrix` is Paraboloid::matrix, `clip_scale` and `texture_scale` are what the methods of these names give. Positions are
// what the matrix takes: in world space, or relative to the eye.

struct ShadowfitParaboloidVertex {
    // The clip position; w is 1.
    position: vec4<f32>,
    // Not negative in the part of the map that is drawn. Interpolate it and discard fragments where it is negative, or
    // write it to a clip distance.
    //
    // It must be cut: a triangle behind the light has its vertices outside of the disc, on all sides of it, and with straight
    // edges between them it would cover the map, and the whole of it. Cutting wants the interpolated value. z itself will
    // not do: places are interpolated in the map, where a step is not a step on the triangle. z over the same divisor as
    // the place changes sign where the triangle crosses the plane, and the maps of both hemispheres are cut along one line.
    //
    // The plane is moved back as far as the border of the map is wide, so that filters at the rim find texels there.
    hemisphere: f32,
}

// |q.xyz| + q.z, which is no larger than this rounding of it straight behind the light: such vertices are cut off, but they
// must be somewhere.
fn shadowfit_paraboloid_divisor(distance: f32, along: f32) -> f32 {
    return max(distance + along, 1e-6 * distance + 1e-30);
}

// For the vertex shader that draws into the map.
fn shadowfit_paraboloid_clip(
    matrix: mat4x4<f32>,
    clip_scale: vec4<f32>,
    position: vec3<f32>,
) -> ShadowfitParaboloidVertex {
    let q = matrix * vec4(position, 1.0);
    let distance = length(q.xyz);
    let divisor = shadowfit_paraboloid_divisor(distance, q.z);
    let place = q.xy / divisor;
    let depth = distance - q.w;
    // Where the map ends, at 1/inner in the middle of its sides, a direction is this far behind the plane.
    let square = clip_scale.x * clip_scale.x;
    let behind = (1.0 - square) / (1.0 + square);
    var vertex: ShadowfitParaboloidVertex;
    vertex.position = vec4(place * clip_scale.xy, depth * clip_scale.z + clip_scale.w, 1.0);
    vertex.hemisphere = (q.z + behind * distance) / divisor;
    return vertex;
}

// For whatever reads the map: the texture coordinates, what the depth buffer holds for the position, and a last number that
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
