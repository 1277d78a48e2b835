// Discs and balls as quads in a shadow map.
//
// All functions give the clip position, with w = 1, of one corner of the rectangle that a disc or a ball just fits into
// in the map, grown to a texel across and down where it is smaller. `corner` is (-1, -1), (1, -1), (-1, 1) or (1, 1):
// four vertices make a quad, on either winding, so that no side may be culled. Positions are in the space that
// `clip_from_world` takes them in, and the result is in the clip space that it was made for.
//
// A rectangle covers more than its disc. `shadowfit_splat_corner` gives the offset of the corner in the ellipse besides, for
// a fragment shader that discards where that, interpolated, is longer than 1.
//
// A disc that reaches a point with w <= 0, as next to a point light, has no rectangle; its corners all fall on one place
// outside of the clip volume, so that nothing is drawn.

// A disc, across a unit normal. Its depth is that of its plane.
fn shadowfit_disc_splat(
    clip_from_world: mat4x4<f32>,
    centre: vec3<f32>,
    normal: vec3<f32>,
    radius: f32,
    map_sides: vec2<f32>,
    corner: vec2<f32>,
) -> vec4<f32> {
    return shadowfit_splat_corner(clip_from_world, centre, normal, radius, map_sides, corner).clip;
}

// A ball. Its depth is its centre's.
fn shadowfit_ball_splat(
    clip_from_world: mat4x4<f32>,
    centre: vec3<f32>,
    radius: f32,
    map_sides: vec2<f32>,
    corner: vec2<f32>,
) -> vec4<f32> {
    return shadowfit_disc_splat(clip_from_world, centre, vec3(0.0), radius, map_sides, corner);
}

// A corner of a rectangle.
struct shadowfit_SplatCorner {
    // The clip position.
    clip: vec4<f32>,
    // The corner's place in the ellipse that the disc or ball is in the map: interpolated, it is longer than 1 outside.
    offset: vec2<f32>,
}

// A disc's, or with a normal of zero a ball's.
fn shadowfit_splat_corner(
    clip_from_world: mat4x4<f32>,
    centre: vec3<f32>,
    normal: vec3<f32>,
    radius: f32,
    map_sides: vec2<f32>,
    corner: vec2<f32>,
) -> shadowfit_SplatCorner {
    let rows = transpose(clip_from_world);
    let clip = clip_from_world * vec4(centre, 1.0);
    let place = clip.xyz / clip.w;
    // How x, y and z of the map, and w over w at the centre, change over a radius.
    let scale = radius / clip.w;
    let w = rows[3].xyz * scale;
    let x = rows[0].xyz * scale - w * place.x;
    let y = rows[1].xyz * scale - w * place.y;
    let z = rows[2].xyz * scale - w * place.z;

    let w_across = shadowfit_splat_part_across(w, normal);
    let rest = 1.0 - dot(w_across, w_across);
    if (!(clip.w > 0.0 && rest > 0.0)) {
        return shadowfit_SplatCorner(vec4(0.0, 0.0, -2.0, 1.0), vec2(0.0));
    }
    let x_across = shadowfit_splat_part_across(x, normal);
    let y_across = shadowfit_splat_part_across(y, normal);
    let x_span = shadowfit_splat_span(place.x, x_across, w_across);
    let y_span = shadowfit_splat_span(place.y, y_across, w_across);
    let z_span = shadowfit_splat_span(place.z, shadowfit_splat_part_across(z, normal), w_across);
    let half = vec2(x_span.y, y_span.y);
    // Half a texel is 1 / map_sides of clip space; the rest is for the grid that rasterisers move corners to.
    let least = (1.0 + 1.0 / 128.0) / map_sides;
    let grown = max(half, least);
    let from_middle = corner * grown;
    let at = vec2(x_span.x, y_span.x) + from_middle;

    // On the disc's plane z is place.z plus these slopes, over `turned`, times the way from the centre.
    let turned = dot(normal, cross(x, y));
    let slopes = vec2(dot(normal, cross(z, y)), dot(normal, cross(x, z)));
    // A disc seen from its edge has no bounds to its slopes: the rectangle gets no deeper than this many times the disc.
    let deepest = 4.0 * z_span.y;
    let reach = abs(slopes.x) * half.x + abs(slopes.y) * half.y;
    let divisor = max(abs(turned) * deepest, reach);
    let limited = select(0.0, deepest / divisor, divisor > 0.0) * select(-1.0, 1.0, turned >= 0.0);
    let depth = place.z + limited * dot(slopes, at - place.xy);

    // As tall and wide as the rectangle, and as lopsided as x and y change together.
    let mixed = dot(x_across, w_across) * dot(y_across, w_across) / (rest * rest) + dot(x_across, y_across) / rest;
    let offset = shadowfit_splat_offset(half / least, mixed / (least.x * least.y), from_middle / least);
    return shadowfit_SplatCorner(vec4(at, depth, 1.0), offset);
}

// Where a place, from the middle of an ellipse, lies in it: longer than 1 outside. The ellipse is half as wide and as tall
// as `half`; d * S^-1 * d = 1 along its edge, with S = (half.x^2, mixed; mixed, half.y^2). All is measured in halves of
// the least rectangle.
//
// An ellipse narrower than the square of that size is widened until it holds the square; so it holds the middle of a texel
// wherever it falls, and all of a rectangle of the least size. All grow by the rasteriser's grid.
fn shadowfit_splat_offset(half: vec2<f32>, mixed: f32, from_middle: vec2<f32>) -> vec2<f32> {
    let squared = half * half;
    let mean = 0.5 * (squared.x + squared.y);
    let apart = length(vec2(0.5 * (squared.x - squared.y), mixed));
    // The squares of the half axes are mean - apart and mean + apart; half a diagonal of the square is sqrt(2).
    let shorter = max(mean - apart, 2.0);
    let more = shorter - (mean - apart);
    let longer = mean + apart + more;
    let x = sqrt(squared.x + more);
    // The product of the axes is the root of the determinant, which is lost in the differences where they are unlike.
    let y = sqrt(shorter) * sqrt(longer) / x;
    let grid = 1.0 + 1.0 / (64.0 * sqrt(shorter));
    return vec2(from_middle.x / x, (from_middle.y - mixed / (x * x) * from_middle.x) / y) / grid;
}

// The part of a vector across a unit vector; all of it across zero.
fn shadowfit_splat_part_across(v: vec3<f32>, normal: vec3<f32>) -> vec3<f32> {
    return v - normal * dot(normal, v);
}

// The middle and half the length of the values of a / w over a disc, where `place` is the value at its centre and
// `across` and `w` are the changes of a - place * w and of w over a radius, over w at the centre.
fn shadowfit_splat_span(place: f32, across: vec3<f32>, w: vec3<f32>) -> vec2<f32> {
    let mixed = dot(across, w);
    let rest = 1.0 - dot(w, w);
    return vec2(place - mixed / rest, sqrt(mixed * mixed + rest * dot(across, across)) / rest);
}
