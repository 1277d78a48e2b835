//! Virtual samples: depths of a plane at places where it was not seen, against the matrix, in f64 and as a shader has them.

mod arbitrary;

use arbitrary::{Numbers, Together, case, points_of, run, settings};
use glam::{DMat4, DVec2, DVec3, Mat4, Vec2, Vec3};
use proptest::prelude::*;
use shadowfit::{
    ClipSpace, DepthFormat, LEAST_INCIDENCE, Light, Map, Origin, Outcome, Rule, SUBTEXEL, Scene, Settings,
    TangentPlane, View, Warp, fit,
};

/// The unit roundoffs.
const F64: f64 = 0.5 * f64::EPSILON;
const F32: f64 = 1.0 / 16_777_216.0;

/// What the texture matrix makes of a point.
fn projected(texture_from_world: DMat4, point: DVec3) -> DVec3 {
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
        if facing < 1.01 * LEAST_INCIDENCE * along + 2.0 * of_facing || magnitudes[3] * 16.0 * unit > w {
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
fn direction(numbers: &mut Numbers) -> DVec3 {
    loop {
        let at = DVec3::new(numbers.part(), numbers.part(), numbers.part()) * 2.0 - 1.0;
        if (0.1..1.0).contains(&at.length_squared()) {
            return at.normalize();
        }
    }
}

/// The planes through points of what is visible, turned at random, with a second point of each not many texels off.
fn planes(map: &Map, visible: &[DVec3], seed: u64) -> Vec<(DVec3, DVec3, DVec3)> {
    let mut numbers = Numbers(seed);
    let texture = map.texture_from_world();
    let texels = |point| projected(texture, point).truncate() * f64::from(map.settings().map_size());
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

#[test]
fn depths_on_planes_are_exact() {
    run(3000, &(case(), settings(), any::<u64>()), |(case, settings, seed)| {
        let together = Together::of(&case);
        let focus = together.focus();
        let Outcome::Map(map) = focus.fit(&settings) else { return };
        let texture = map.texture_from_world();
        for (point, normal, other) in planes(&map, &points_of(&focus.visible(), seed), seed) {
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
    });
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
fn in_a_shader(texture: Mat4, position: Vec3, normal: Vec3) -> (Vec3, Vec2) {
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

#[test]
fn shaders_find_them_to_what_f32_can_tell() {
    run(3000, &(case(), settings(), any::<u64>()), |(case, settings, seed)| {
        let together = Together::of(&case);
        let focus = together.focus();
        let Outcome::Map(map) = focus.fit(&settings) else { return };
        let origin = match settings.origin() {
            Origin::World => DVec3::ZERO,
            Origin::Eye => together.view.eye(),
        };
        let texture = map.texture_from_world() * DMat4::from_translation(origin);
        for (point, normal, _) in planes(&map, &points_of(&focus.visible(), seed), seed) {
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
            let (projected, slopes) = in_a_shader(map.texture_matrix(), position, normal.as_vec3());
            let size = f64::from(map.settings().map_size());
            for off in [DVec2::new(-0.5, 0.5), DVec2::new(1.0, 0.3), DVec2::new(1.5, -1.5)].map(|off| off / size) {
                let place = (plane.place() + off).as_vec2();
                let found = f64::from(projected.z + slopes.dot(place - projected.truncate()));
                let expected = plane.depth_at(place.as_dvec2());
                let tolerance = error.at(plane.slopes(), off.abs() + F32, plane.depth(), F32)
                    + 2.0 * in_f64.at(plane.slopes(), off, plane.depth(), F64);
                assert!((found - expected).abs() <= tolerance, "{found} for {expected}, within {tolerance}");
            }
        }
    });
}

/// Both ways in f32, relative to the eye, for roofs and walls under a sun and a lamp: slopes from gradients at the point,
/// and the plane taken through the inverse of the matrix, as in the paper: 1.4 to 2 times as far off on planes at 45° to the
/// light, 2 to 9 times on planes that it grazes at a degree.
#[test]
fn slopes_at_the_point_err_less_than_the_inverse() {
    for light in [Light::directional((0.4, 0.5, 0.5)), Light::point((3.0, 8.0, -20.0), 0.05, f64::INFINITY)] {
        let map = ground(&light.expect("sound"), ClipSpace::WGPU, Warp::Perspective);
        let inverse = map.texture_from_world().inverse().transpose().as_mat4();
        let mut numbers = Numbers(5);
        for steep in [false, true] {
            let (mut at_point, mut through_inverse): (f64, f64) = (0.0, 0.0);
            for (x, z) in (-20..=20).flat_map(|x| (-40..=-2).map(move |z| (f64::from(x), f64::from(z)))) {
                let position = Vec3::new(x as f32, 1.0, z as f32) * 0.2;
                let towards = map_light(&map, position.as_dvec3());
                let across = direction(&mut numbers).cross(towards).normalize();
                let normal = if steep { across + 0.02 * towards } else { across + towards };
                let Some(plane) = TangentPlane::new(&map, position.as_dvec3(), normal) else { continue };
                let place = (plane.place() + 1.0 / 1024.0).as_vec2();
                let expected = plane.depth_at(place.as_dvec2());
                let normal = normal.as_vec3();
                let (projected, slopes) = in_a_shader(map.texture_matrix(), position, normal);
                let found = projected.z + slopes.dot(place - projected.truncate());
                let there = inverse * normal.extend(-normal.dot(position));
                let inverted = -(there.x * place.x + there.y * place.y + there.w) / there.z;
                at_point = at_point.max((f64::from(found) - expected).abs());
                through_inverse = through_inverse.max((f64::from(inverted) - expected).abs());
            }
            assert!(
                at_point < through_inverse,
                "{at_point:e} at the point, {through_inverse:e} through the inverse"
            );
        }
    }
}

/// Towards the light of a map.
fn map_light(map: &Map, point: DVec3) -> DVec3 {
    let texture = map.texture_from_world();
    let w = texture.row(3);
    let gradient = |i: usize| (texture.row(i) - projected(texture, point)[i] * w).truncate();
    gradient(0).cross(gradient(1)).normalize()
}

/// The ground from a person's height, under a light, as a map.
fn ground(light: &Light, clip: ClipSpace, warp: Warp) -> Map {
    let view = View::perspective((0.0, 1.7, 0.0), (0.0, -0.3, -1.0), DVec3::Y, 1.0, 1.6, 0.1, 60.0).expect("sound");
    let scene = Scene::from_box((-30.0, 0.0, -30.0), (30.0, 5.0, 30.0)).expect("sound");
    let settings = Settings::new(256, 1080).expect("sound").with_border(4).expect("sound");
    let settings = settings.with_clip(clip).with_warp(warp);
    *fit(&view, light, &scene, &settings).map().expect("one map does")
}

fn grounds() -> Vec<Map> {
    let lights = [Light::directional((0.4, 0.3, 0.5)), Light::point((3.0, 4.0, -9.0), 0.1, f64::INFINITY)];
    let mut maps = Vec::new();
    for light in lights.map(|light| light.expect("sound")) {
        for clip in [ClipSpace::WGPU, ClipSpace::OPENGL, ClipSpace::VULKAN.reversed()] {
            maps.extend([Warp::Uniform, Warp::Perspective].map(|warp| ground(&light, clip, warp)));
        }
    }
    maps
}

/// Points of the ground in view, and the plane of each.
fn on_ground(map: &Map) -> Vec<TangentPlane> {
    let points =
        (-80..=80).flat_map(|x| (-100..=-10).map(move |z| DVec3::new(f64::from(x), 0.0, f64::from(z)) * 0.07));
    let planes = points.filter_map(|point| TangentPlane::new(map, point, DVec3::Y));
    planes.filter(|plane| plane.place().clamp(DVec2::splat(0.02), DVec2::splat(0.98)) == plane.place()).collect()
}

/// The depth that the map holds for a plane, at the centre of a texel, in steps of a format and off by the rasteriser's
/// half of a step of its grid in the worst direction.
fn stored_plane(map: &Map, plane: TangentPlane, format: Option<DepthFormat>) -> impl Fn(u32, u32) -> f64 {
    let size = f64::from(map.settings().map_size());
    let reversed = map.settings().clip().depth.is_reversed();
    move |x, y| {
        let exact = plane.depth_at((DVec2::new(f64::from(x), f64::from(y)) + 0.5) / size);
        let Some(format) = format else { return exact };
        let shift = 0.5 * SUBTEXEL / size * plane.slopes().abs().element_sum();
        let nearer = if reversed { exact + shift } else { exact - shift };
        let step = format.step(1.0);
        (nearer / step).round() * step
    }
}

#[test]
fn a_plane_never_shadows_itself_without_any_bias() {
    for map in grounds() {
        let planes = on_ground(&map);
        assert!(planes.len() > 1000, "{}", planes.len());
        for plane in planes {
            for format in [None, Some(DepthFormat::Unorm16), Some(DepthFormat::Unorm24)] {
                let stored = stored_plane(&map, plane, format);
                // Exact depths need nothing but what f64 rounds; stored ones the tolerance of their format.
                let constant = format.map_or(1e-12, |format| map.comparison_tolerance(format));
                let tests = [plane.blended(constant, &stored)]
                    .into_iter()
                    .chain([1, 2, 3, 5, 8].map(|taps| plane.mean(taps, constant, &stored)));
                for sampled in tests {
                    assert!((sampled.share - 1.0).abs() < 1e-12, "{plane:?}: {sampled:?} in {format:?}");
                    assert_ne!(sampled.rule, Rule::NonePass);
                }
            }
        }
    }
}

/// HARD_CASES 33: a sheet has its own depth stored; with < in place of ≤ it would shadow itself.
#[test]
fn a_thin_sheet_passes_by_at_most() {
    let map = &grounds()[0];
    // A plane across the light: one depth everywhere, the same number in the map and in the test.
    let point = DVec3::new(0.0, 0.0, -4.0);
    let sheet = TangentPlane::new(map, point, DVec3::new(0.4, 0.3, 0.5)).expect("in the map");
    for sampled in [sheet.blended(0.0, |_, _| sheet.depth()), sheet.mean(3, 0.0, |_, _| sheet.depth())] {
        assert_eq!((sampled.share, sampled.rule), (1.0, Rule::AllPass), "{:?}", sheet.slopes());
    }
}

#[test]
fn what_lies_before_the_plane_at_every_texel_shadows_it() {
    for map in grounds() {
        let away = if map.settings().clip().depth.is_reversed() { -1.0 } else { 1.0 };
        for plane in on_ground(&map) {
            let own = stored_plane(&map, plane, None);
            // By more than the tolerance, but by far less than the plane's depth changes from texel to texel.
            let before = away * (2.0 * plane.tolerance(1e-9) + 1e-12);
            for sampled in
                [plane.blended(1e-9, |x, y| own(x, y) - before), plane.mean(3, 1e-9, |x, y| own(x, y) - before)]
            {
                assert_eq!(sampled.share, 0.0, "{plane:?}");
                assert_ne!(sampled.rule, Rule::AllPass);
            }
        }
    }
}

/// Against a test that asks the plane at every texel, on depths at random about the plane: where the rules differ from it,
/// the point passes against all texels or against none.
#[test]
fn the_first_two_rules_only_cut_short() {
    run(400, &any::<u64>(), |seed| {
        let mut numbers = Numbers(seed);
        let maps = grounds();
        let map = &maps[(numbers.part() * maps.len() as f64) as usize];
        let size = f64::from(map.settings().map_size());
        let away = if map.settings().clip().depth.is_reversed() { -1.0 } else { 1.0 };
        let planes = on_ground(map);
        let plane = planes[(numbers.part() * planes.len() as f64) as usize];
        let spread = 4.0 * plane.slopes().abs().element_sum() / size;
        let field: Vec<f64> = (0..256 * 256).map(|_| spread * (numbers.part() - 0.5)).collect();
        let stored = |x: u32, y: u32| plane.depth() + field[(y * 256 + x) as usize];
        let tolerance = plane.tolerance(1e-7);
        let passes = |depth: f64, x: u32, y: u32| away * (depth - stored(x, y)) <= tolerance;
        for taps in 1..=5_u32 {
            let first = (plane.place() * size - 0.5 * f64::from(taps - 1)).floor();
            let texels: Vec<(u32, u32)> =
                (0..taps * taps).map(|i| (first.x as u32 + i % taps, first.y as u32 + i / taps)).collect();
            let of_point = texels.iter().filter(|&&(x, y)| passes(plane.depth(), x, y)).count();
            let at = |x: u32, y: u32| plane.depth_at((DVec2::new(f64::from(x), f64::from(y)) + 0.5) / size);
            let of_plane = texels.iter().filter(|&&(x, y)| passes(at(x, y), x, y)).count();
            let sampled = plane.mean(taps, 1e-7, stored);
            let expected = match sampled.rule {
                Rule::AllPass => (of_point == texels.len()).then_some(1.0),
                Rule::NonePass => (of_point == 0).then_some(0.0),
                Rule::VirtualSamples => {
                    let disagree = taps == 1 || (of_point > 0 && of_point < texels.len());
                    disagree.then_some(of_plane as f64 / texels.len() as f64)
                }
            };
            let expected = expected.expect("the rule's own condition");
            assert!((sampled.share - expected).abs() < 1e-12, "{sampled:?}, {expected}");
        }
        // Blended, the weights are those of the centres around the point.
        let blended = plane.blended(1e-7, stored);
        let corner = plane.place() * size - 0.5;
        let part = corner.fract();
        let weights =
            [(1.0 - part.x) * (1.0 - part.y), part.x * (1.0 - part.y), (1.0 - part.x) * part.y, part.x * part.y];
        let (x, y) = (corner.x as u32, corner.y as u32);
        let around = [(x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)];
        let at = |x: u32, y: u32| plane.depth_at((DVec2::new(f64::from(x), f64::from(y)) + 0.5) / size);
        let share: f64 =
            around.iter().zip(weights).filter(|((x, y), _)| passes(at(*x, *y), *x, *y)).map(|(_, w)| w).sum();
        if blended.rule == Rule::VirtualSamples {
            assert!((blended.share - share).abs() < 1e-9, "{blended:?}, {share}");
        }
    });
}

#[test]
fn a_plane_from_its_edge_has_a_slope_with_an_end() {
    for map in grounds() {
        let point = DVec3::new(1.0, 0.5, -6.0);
        let towards = map.texture_from_world();
        // Across the light's ray: the cross product of the gradients runs along it.
        let gradient = |i: usize| {
            let w = towards.row(3);
            (towards.row(i) - projected(towards, point)[i] * w).truncate()
        };
        let along = gradient(0).cross(gradient(1)).normalize();
        let edge_on = along.any_orthonormal_vector();
        let [least, steep] = [edge_on, edge_on + along * 1e-9].map(|normal| TangentPlane::new(&map, point, normal));
        for plane in [least, steep] {
            let slopes = plane.expect("in the map").slopes();
            assert!(slopes.is_finite(), "{slopes}");
            assert!(
                slopes.length()
                    <= 1.01 / LEAST_INCIDENCE * gradient(2).length()
                        / gradient(0).length().min(gradient(1).length()),
                "{slopes}"
            );
        }
        for normal in [DVec3::ZERO, DVec3::NAN, DVec3::splat(f64::INFINITY)] {
            assert_eq!(TangentPlane::new(&map, point, normal), None);
        }
    }
}

#[test]
fn a_point_behind_the_map_has_no_plane() {
    let map = ground(
        &Light::spot((0.0, 4.0, -5.0), (0.0, -1.0, -0.2), 0.7, 0.1, 30.0).expect("sound"),
        ClipSpace::WGPU,
        Warp::Uniform,
    );
    assert_eq!(TangentPlane::new(&map, DVec3::new(0.0, 9.0, -5.0), DVec3::Y), None);
    assert!(TangentPlane::new(&map, DVec3::new(0.0, 0.0, -5.0), DVec3::Y).is_some());
}
