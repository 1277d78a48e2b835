//! Virtual samples: depths of a plane at places where it was not seen, against the matrix, in f64 and as a shader has them.

use shadowfit::glam::{DMat4, DVec2, DVec3, Mat4, Vec2, Vec3};
use shadowfit::{
    DepthFormat, Outcome, Settings, ShadowMap,
    depth::{ComparisonTolerance, Decision, MIN_SIN_INCIDENCE, RASTER_GRID, TangentPlane},
};

use super::single_precision::{depth_of, in_f32, rounding};
use crate::arbitrary::{Case, Numbers, Together, points_of, sides};

/// The unit roundoffs.
const F64: f64 = 0.5 * f64::EPSILON;
const F32: f64 = 1.0 / 16_777_216.0;

/// What the texture matrix makes of a point.
pub fn projected(texture_from_world: DMat4, point: DVec3) -> DVec3 {
    let texture = texture_from_world * point.extend(1.0);
    texture.truncate() / texture.w
}

/// What rounding, at most `unit` an operation, can do to the coordinates of a point and to the slopes of a plane through
/// it, with the matrix and the position about one origin.
struct Error {
    coordinates: DVec3,
    slopes: DVec2,
}

impl Error {
    /// `None` where the slopes could be off by all of themselves: a plane nearly from its edge, or much of w lost.
    fn of(texture: DMat4, point: DVec3, normal: DVec3, unit: f64) -> Option<Self> {
        let rows = [0, 1, 2, 3].map(|i| texture.row(i));
        let magnitudes = rows.map(|row| row.abs().dot(point.abs().extend(1.0)));
        let w = rows[3].dot(point.extend(1.0));
        let place = projected(texture, point);
        // Eight roundings a row (entry, coordinate, product, three sums, two spare) and those of w through the division.
        let of_row = |i: usize| 8.0 * unit * (magnitudes[i] + place[i].abs() * magnitudes[3]) / w;
        let coordinates = DVec3::new(of_row(0), of_row(1), of_row(2)) + 2.0 * unit * place.abs();
        // Gradients: entries rounded, a product, a difference, and the coordinate's own error.
        let w_normal = rows[3].truncate();
        let gradients = [0, 1, 2].map(|i| rows[i].truncate() - place[i] * w_normal);
        let errors = [0, 1, 2].map(|i| {
            let terms = rows[i].truncate().length() + place[i].abs() * w_normal.length();
            4.0 * unit * terms + coordinates[i] * w_normal.length()
        });
        // A triple product of unit n with two of them: theirs, and 12 roundings (n's three entries, two products and a
        // difference of the cross product, three of the dot product, and spare).
        let triple = |i: usize, j: usize| {
            let (a, b) = (gradients[i].length(), gradients[j].length());
            errors[i] * b + a * errors[j] + errors[i] * errors[j] + 12.0 * unit * a * b
        };
        let facing = normal.dot(gradients[0].cross(gradients[1])).abs();
        let along = gradients[0].cross(gradients[1]).length();
        let of_facing = triple(0, 1);
        if facing < 1.01 * MIN_SIN_INCIDENCE * along + 2.0 * of_facing || magnitudes[3] * 16.0 * unit > w {
            return None;
        }
        let slopes = DVec2::new(
            normal.dot(gradients[2].cross(gradients[1])).abs(),
            normal.dot(gradients[0].cross(gradients[2])).abs(),
        ) / facing;
        let slopes = (DVec2::new(triple(2, 1), triple(0, 2)) + slopes * of_facing) / (facing - of_facing)
            + 2.0 * unit * slopes;
        Some(Self { coordinates, slopes })
    }

    /// Of the depth at a place so far off, with those slopes: the point's own depth, its place, the slopes, the sum.
    fn at(&self, slopes: DVec2, off: DVec2, depth: f64, unit: f64) -> f64 {
        let terms = depth.abs() + slopes.abs().dot(off.abs());
        self.coordinates.z
            + slopes.abs().dot(self.coordinates.truncate())
            + self.slopes.dot(off.abs() + self.coordinates.truncate())
            + 4.0 * unit * terms
    }
}

/// A direction at random.
pub fn direction(numbers: &mut Numbers) -> DVec3 {
    loop {
        let at = DVec3::new(numbers.part(), numbers.part(), numbers.part()) * 2.0 - 1.0;
        if (0.1..1.0).contains(&at.length_squared()) {
            return at.normalize();
        }
    }
}

/// The planes through points of what is visible, turned at random, with a second point of each not many texels off.
fn planes(map: &ShadowMap, visible: &[DVec3], seed: u64) -> Vec<(DVec3, DVec3, DVec3)> {
    let mut numbers = Numbers(seed);
    let texture = map.texture_from_world();
    let texels = |point| projected(texture, point).truncate() * sides(map.settings());
    visible
        .iter()
        .filter_map(|&point| {
            let normal = direction(&mut numbers);
            let texel = map.footprint(point)?.longest();
            let step = normal.cross(direction(&mut numbers)) * texel * 3.0;
            let other = point + step;
            (texels(other).distance(texels(point)) < 16.0).then_some((point, normal, other))
        })
        .collect()
}

/// Asserts that the depth of a plane at another of its points is that of the point.
pub fn depths_are_exact(case: &Case, settings: &Settings, seed: u64) {
    let together = Together::of(case);
    let focus = together.focus();
    let Outcome::Map(map) = focus.fit(settings) else { return };
    let texture = map.texture_from_world();
    for (point, normal, other) in planes(&map, &points_of(&focus.receiver_volume(), seed), seed) {
        let Some(plane) = TangentPlane::new(&map, point, normal) else { continue };
        let (Some(here), Some(there)) =
            (Error::of(texture, point, normal, F64), Error::of(texture, other, normal, F64))
        else {
            continue;
        };
        let expected = projected(texture, other);
        let off = expected.truncate() - plane.place();
        let found = plane.depth_at(expected.truncate());
        // The other point is on the plane but for the rounding of its coordinates, four roundings of the larger.
        let largest = point.abs().max(other.abs()).max_element();
        let tolerance = here.at(plane.slopes(), off, plane.depth(), F64)
            + there.at(plane.slopes(), DVec2::ZERO, expected.z, F64) / (1.0 - 1e-3)
            + 8.0 * F64 * largest * depth_per_unit(texture, point, plane.slopes());
        assert!((found - expected.z).abs() <= tolerance, "{found} for {}, within {tolerance}", expected.z);
    }
}

/// How much depth beyond a plane's changes with a step off it, at most: the gradients of depth and of the place.
fn depth_per_unit(texture: DMat4, point: DVec3, slopes: DVec2) -> f64 {
    let place = projected(texture, point);
    let w = texture.row(3);
    let at = w.dot(point.extend(1.0));
    let gradient = |i: usize| ((texture.row(i) - place[i] * w).truncate() / at).length();
    gradient(2) + slopes.x.abs() * gradient(0) + slopes.y.abs() * gradient(1)
}

/// The functions of `wgsl/virtual_samples.wgsl`, operation by operation.
pub fn in_a_shader(texture: Mat4, position: Vec3, normal: Vec3) -> (Vec3, Vec2) {
    let clip = texture * position.extend(1.0);
    let projected = clip.truncate() / clip.w;
    let rows = [0, 1, 2, 3].map(|i| texture.row(i).truncate());
    let across = [0, 1].map(|i| rows[i] - projected[i] * rows[3]);
    let factor = 1.0 / across[0].abs().max(across[1].abs()).max_element();
    let [u, v, z] = [across[0], across[1], rows[2] - projected.z * rows[3]].map(|row| factor * row);
    let along = u.cross(v);
    let least = along.length() * normal.length() / 256.0;
    let facing = normal.dot(along);
    let bounded = if facing < 0.0 { facing.min(-least) } else { facing.max(least) };
    (projected, Vec2::new(normal.dot(z.cross(v)), normal.dot(u.cross(z))) / bounded)
}

/// Asserts that a shader finds the depths of planes to what f32 can tell.
pub fn shaders_find_them(case: &Case, settings: &Settings, seed: u64) {
    let together = Together::of(case);
    let focus = together.focus();
    let Outcome::Map(map) = focus.fit(settings) else { return };
    let origin = map.origin();
    let texture = map.texture_from_world() * DMat4::from_translation(origin);
    for (point, normal, _) in planes(&map, &points_of(&focus.receiver_volume(), seed), seed) {
        if !together.is_served(point) {
            continue;
        }
        // The shader's point is what the position is after rounding.
        let position = (point - origin).as_vec3();
        let Some(plane) = TangentPlane::new(&map, position.as_dvec3() + origin, normal) else { continue };
        let Some(error) = Error::of(texture, position.as_dvec3(), normal, F32) else { continue };
        // Far from the world's origin f64 loses digits of what is expected, and of the matrix as it is moved to the eye.
        let world = Error::of(map.texture_from_world(), point, normal, F64);
        let Some(in_f64) = world else { continue };
        let (projected, slopes) = in_a_shader(map.receiver_matrix(), position, normal.as_vec3());
        let sides = sides(map.settings());
        for off in [DVec2::new(-0.5, 0.5), DVec2::new(1.0, 0.3), DVec2::new(1.5, -1.5)].map(|off| off / sides) {
            let place = (plane.place() + off).as_vec2();
            let found = f64::from(projected.z + slopes.dot(place - projected.truncate()));
            let expected = plane.depth_at(place.as_dvec2());
            let tolerance = error.at(plane.slopes(), off.abs() + F32, plane.depth(), F32)
                + 2.0 * in_f64.at(plane.slopes(), off, plane.depth(), F64);
            assert!((found - expected).abs() <= tolerance, "{found} for {expected}, within {tolerance}");
        }
    }
}

/// Asserts that rules cut short only what they may, at points of what is visible.
pub fn rules_hold_where_planes_are_seen(case: &Case, settings: &Settings, seed: u64) {
    let together = Together::of(case);
    let focus = together.focus();
    let Outcome::Map(map) = focus.fit(settings) else { return };
    // All texels that a filter reads are in the map.
    let margin = 4.0 / sides(settings);
    for (point, normal, _) in planes(&map, &points_of(&focus.receiver_volume(), seed), seed) {
        let Some(plane) = TangentPlane::new(&map, point, normal) else { continue };
        if plane.place().cmpgt(margin).all() && plane.place().cmplt(1.0 - margin).all() {
            rules_only_cut_short(&map, plane, seed);
        }
    }
}

/// Asserts that where the rules differ from a test that asks the plane at every texel, on depths about the plane at
/// random, the point passes against all texels or against none.
pub fn rules_only_cut_short(map: &ShadowMap, plane: TangentPlane, seed: u64) {
    let sides = sides(map.settings());
    let away = if map.settings().clip().depth.is_reversed() { -1.0 } else { 1.0 };
    let spread = 4.0 * (plane.slopes().abs() / sides).element_sum();
    let field = |x: u32, y: u32| Numbers(seed ^ u64::from(x) << 32 ^ u64::from(y)).part() - 0.5;
    let stored = |x: u32, y: u32| plane.depth() + spread * field(x, y);
    let parts = ComparisonTolerance::constant(1e-7);
    let tolerance = plane.tolerance(&parts);
    let passes = |depth: f64, x: u32, y: u32| away * (depth.clamp(0.0, 1.0) - stored(x, y)) <= tolerance;
    for taps in 1..=5_u32 {
        let first = (plane.place() * sides - 0.5 * f64::from(taps - 1)).floor();
        let texels: Vec<(u32, u32)> =
            (0..taps * taps).map(|i| (first.x as u32 + i % taps, first.y as u32 + i / taps)).collect();
        let of_point = texels.iter().filter(|&&(x, y)| passes(plane.depth(), x, y)).count();
        let at = |x: u32, y: u32| plane.depth_at((DVec2::new(f64::from(x), f64::from(y)) + 0.5) / sides);
        let of_plane = texels.iter().filter(|&&(x, y)| passes(at(x, y), x, y)).count();
        let sampled = plane.mean(taps, &parts, stored);
        let expected = match sampled.rule {
            Decision::AllPass => (of_point == texels.len()).then_some(1.0),
            Decision::NonePass => (of_point == 0).then_some(0.0),
            Decision::VirtualSamples => {
                let disagree = taps == 1 || (of_point > 0 && of_point < texels.len());
                disagree.then_some(of_plane as f64 / texels.len() as f64)
            }
        };
        let expected = expected.expect("the rule's own condition");
        assert!((sampled.share - expected).abs() < 1e-12, "{sampled:?}, {expected}");
    }
    // Blended, the weights are those of the centres around the point.
    let blended = plane.blended(&parts, stored);
    let corner = plane.place() * sides - 0.5;
    let part = corner.fract();
    let weights =
        [(1.0 - part.x) * (1.0 - part.y), part.x * (1.0 - part.y), (1.0 - part.x) * part.y, part.x * part.y];
    let (x, y) = (corner.x as u32, corner.y as u32);
    let around = [(x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)];
    let at = |x: u32, y: u32| plane.depth_at((DVec2::new(f64::from(x), f64::from(y)) + 0.5) / sides);
    let share: f64 =
        around.iter().zip(weights).filter(|((x, y), _)| passes(at(*x, *y), *x, *y)).map(|(_, w)| w).sum();
    if blended.rule == Decision::VirtualSamples {
        assert!((blended.share - share).abs() < 1e-9, "{blended:?}, {share}");
    }
}

/// Asserts that the depth of a point and that stored for a texel of the same plane differ by no more than is allowed for
/// rounding: triangles of three points of what is visible, as f32 has their corners and a point between them.
pub fn allows_for_rounding(case: &Case, settings: &Settings, seed: u64) {
    let together = Together::of(case);
    let focus = together.focus();
    let Outcome::Map(map) = focus.fit(settings) else { return };
    let mut numbers = Numbers(seed);
    let sides = sides(settings);
    let off = |point| {
        let exact = depth_of(settings.clip(), map.clip_from_world() * DVec3::extend(point, 1.0));
        let (_, of_w) = rounding(&map, point);
        let is_counted = together.is_served(point) && of_w <= 0.5 && exact.abs() <= 1.0;
        let found = depth_of(settings.clip(), in_f32(&map, point).as_dvec4());
        is_counted.then_some(found - exact)
    };
    for corners in points_of(&focus.receiver_volume(), seed).windows(3) {
        let [a, b, c] = [corners[0], corners[1], corners[2]];
        let (s, t) = (numbers.part(), numbers.part());
        let point = a + s * ((b - a) + t * (c - b));
        let Some(plane) = TangentPlane::new(&map, point, (b - a).cross(c - a)) else { continue };
        let errors = [a, b, c, point].map(off);
        let [Some(of_a), Some(of_b), Some(of_c), Some(of_point)] = errors else { continue };
        for reach in [0.5, 1.0, 2.5] {
            let step = DVec2::new(numbers.part(), numbers.part()) * 2.0 - 1.0;
            let texel = plane.place() + reach * step / sides;
            let [at_a, at_b, at_c] = [a, b, c].map(|p| projected(map.texture_from_world(), p).truncate() - texel);
            let parts = [at_b.perp_dot(at_c), at_c.perp_dot(at_a), at_a.perp_dot(at_b)];
            let all: f64 = parts.iter().sum();
            let [part_a, part_b, part_c] = parts.map(|part| part / all);
            if !(part_a >= 0.0 && part_b >= 0.0 && part_c >= 0.0) {
                continue;
            }
            let tolerance = map.comparison_tolerance(DepthFormat::Float32, reach).expect("a reach");
            // Without what is for the format and for the rasteriser.
            let grid = RASTER_GRID * (plane.slopes().abs() / sides).element_sum();
            let allowed = plane.tolerance(&tolerance) - 0.5 * DepthFormat::Float32.step(1.0) - grid;
            let stored = part_a * of_a + part_b * of_b + part_c * of_c;
            // Exact depths are f64's.
            let noise = 64.0 * F64 + 1e-9 * grid;
            assert!(
                (of_point - stored).abs() <= allowed + noise,
                "{of_point} {stored}, {allowed} allowed, at {point}"
            );
        }
    }
}
