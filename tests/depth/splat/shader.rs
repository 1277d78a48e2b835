//! The same as the shader computes them in f32.

use super::rounds::{Round, Rows, TO_SUN, direction, landscape, rounds, texels};
use glam::{DMat3, DVec2, DVec3, Mat4, Vec2, Vec3};
use proptest::prelude::*;
use shadowfit::{Outcome, Settings, ShadowMap, Warp};
use testkit::arbitrary::{Numbers, Together, case, run, settings, sides};

/// What the shader does, operation by operation, in f32.
fn mirrored(matrix: Mat4, centre: Vec3, normal: Vec3, radius: f32, map_sides: Vec2, corner: Vec2) -> [f32; 3] {
    mirrored_corner(matrix, centre, normal, radius, map_sides, corner).0
}

/// The same, with the offset in the ellipse.
fn mirrored_corner(
    matrix: Mat4,
    centre: Vec3,
    normal: Vec3,
    radius: f32,
    map_sides: Vec2,
    corner: Vec2,
) -> ([f32; 3], Vec2) {
    let rows = matrix.transpose();
    let clip = matrix * centre.extend(1.0);
    let place = clip.truncate() / clip.w;
    let scale = radius / clip.w;
    let w = rows.w_axis.truncate() * scale;
    let [x, y, z] = [(rows.x_axis, place.x), (rows.y_axis, place.y), (rows.z_axis, place.z)]
        .map(|(row, place)| row.truncate() * scale - w * place);
    let across = |v: Vec3| v - normal * normal.dot(v);
    let of_w = across(w);
    if !(clip.w > 0.0 && of_w.dot(of_w) < 1.0) {
        return ([0.0, 0.0, -2.0], Vec2::ZERO);
    }
    let span = |place: f32, v: Vec3| {
        let (mixed, rest) = (v.dot(of_w), 1.0 - of_w.dot(of_w));
        (place - mixed / rest, (mixed * mixed + rest * v.dot(v)).sqrt() / rest)
    };
    let [(at_x, half_x), (at_y, half_y), (_, half_z)] =
        [span(place.x, across(x)), span(place.y, across(y)), span(place.z, across(z))];
    let half = Vec2::new(half_x, half_y);
    let least = (1.0 + 1.0 / 128.0) / map_sides;
    let grown = half.max(least);
    let from_middle = corner * grown;
    let at = Vec2::new(at_x, at_y) + from_middle;
    let turned = normal.dot(x.cross(y));
    let slopes = Vec2::new(normal.dot(z.cross(y)), normal.dot(x.cross(z)));
    let deepest = 4.0 * half_z;
    let reach = slopes.abs().dot(half);
    let divisor = (turned.abs() * deepest).max(reach);
    let limited = if divisor > 0.0 { deepest / divisor } else { 0.0 } * if turned >= 0.0 { 1.0 } else { -1.0 };
    let depth = place.z + limited * slopes.dot(at - place.truncate());
    let rest = 1.0 - of_w.dot(of_w);
    let (x, y) = (across(x), across(y));
    let mixed = x.dot(of_w) * y.dot(of_w) / (rest * rest) + x.dot(y) / rest;
    ([at.x, at.y, depth], mirrored_offset(half / least, mixed / (least.x * least.y), from_middle / least))
}

fn mirrored_offset(half: Vec2, mixed: f32, from_middle: Vec2) -> Vec2 {
    let squared = half * half;
    let mean = 0.5 * (squared.x + squared.y);
    let apart = Vec2::new(0.5 * (squared.x - squared.y), mixed).length();
    let shorter = (mean - apart).max(2.0);
    let more = shorter - (mean - apart);
    let longer = mean + apart + more;
    let x = (squared.x + more).sqrt();
    let y = shorter.sqrt() * longer.sqrt() / x;
    let grid = 1.0 + 1.0 / (64.0 * shorter.sqrt());
    Vec2::new(from_middle.x / x, (from_middle.y - mixed / (x * x) * from_middle.x) / y) / grid
}

/// What becomes of a corner of a disc's rectangle, with the offset in the ellipse, in a map about the world's origin.
fn corner_of(map: &ShadowMap, disc: &Round, corner: Vec2) -> ([f32; 3], Vec2) {
    let (centre, normal, radius) = (disc.centre.as_vec3(), disc.normal.as_vec3(), disc.radius as f32);
    mirrored_corner(map.caster_matrix(), centre, normal, radius, sides(map.settings()).as_vec2(), corner)
}

const CORNERS: [Vec2; 4] = [Vec2::new(-1.0, -1.0), Vec2::new(1.0, -1.0), Vec2::new(-1.0, 1.0), Vec2::new(1.0, 1.0)];

#[test]
fn the_shader_finds_the_same_bounds_and_the_depth_of_the_disc() {
    /// Eight units in the last place for each of a dozen rows that go into a corner, see the crate's own bound for one.
    const ROUNDINGS: f64 = 96.0 / 16_777_216.0;
    let placed = std::cell::Cell::new(0_usize);
    run(3000, &(case(), settings(), any::<u64>()), |(case, settings, seed)| {
        let together = Together::of(&case);
        let Outcome::Map(map) = together.focus().fit(&settings) else { return };
        let origin = map.origin();
        let rows = Rows::of(&map, origin, DVec3::ZERO, ROUNDINGS);
        // A matrix about an origin far away cancels terms in f64 that f32 then knows nothing of.
        let cancelled = Rows::new(&map, &together, &case);
        for round in rounds(&together, &case, seed) {
            let Some(splat) = round.splat(&map) else { continue };
            let (Some(slack), Some(cancelled)) = (rows.slack(&round, &splat), cancelled.slack(&round, &splat))
            else {
                continue;
            };
            let slack = slack + cancelled;
            let sides = sides(map.settings());
            // A matrix of a scene of millimetres at a million metres is good for nothing in f32.
            if slack.max_element() > 0.25 {
                continue;
            }
            let corners = CORNERS.map(|corner| {
                let centre = (round.centre - origin).as_vec3();
                let (normal, radius) = (round.normal.as_vec3(), round.radius as f32);
                mirrored(map.caster_matrix(), centre, normal, radius, sides.as_vec2(), corner)
            });
            let grown = splat.half.max(DVec2::splat(0.5 + 1.0 / 256.0));
            assert_eq!(grown, splat.covering().half);
            let places = corners.map(|corner| texels(&map, corner));
            let (low, high) =
                places.into_iter().fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(low, high), place| {
                    (low.min(place), high.max(place))
                });
            // The shader has the rows of clip space, 2u − w, with so much more of w's rounding in them; and clip coordinates
            // are f32 too.
            let of_w = rows.slack_of(rows.w, &round);
            let slack = slack + sides * (0.5 * of_w / (rows.least_w(&round) - of_w) + f64::from(f32::EPSILON));
            let apart = (low - (splat.centre - grown)).abs().max((high - (splat.centre + grown)).abs());
            assert!(apart.cmple(slack).all(), "{round:?}, {splat:?}: off by {apart}, not {slack}");
            placed.set(placed.get() + 1);
        }
    });
    assert!(placed.get() > 5000, "{} placed", placed.get());
}

/// At every corner, the depth of the point of the disc's plane that falls there: in f32, a few of its last digits off,
/// and a digit more for discs seen at angles down to six degrees.
#[test]
fn the_shader_gives_a_disc_the_depth_of_its_plane() {
    let mut numbers = Numbers(11);
    let mut deep = 0;
    for warp in [Warp::Uniform, Warp::Perspective] {
        let map = landscape(&Settings::default().with_warp(warp));
        let rows = map.clip_from_world().transpose();
        for _ in 0..5000 {
            let centre = DVec3::new(20.0 * numbers.part() - 10.0, numbers.part(), 8.0 - 16.0 * numbers.part());
            let (normal, radius) = (direction(&mut numbers), 0.01 + 0.4 * numbers.part());
            let disc = Round { centre, normal, radius };
            let corners = CORNERS.map(|corner| Vec3::from(corner_of(&map, &disc, corner).0).as_dvec3());
            let depth = |point: DVec3| map.clip_from_world().project_point3(point).z;
            let span = (depth(disc.farthest(TO_SUN)) - depth(centre)).abs();
            let exact = corners.map(|corner| {
                assert!(corner.is_finite());
                // Where the planes of the column, of the row and of the disc meet.
                let column = rows.x_axis - rows.w_axis * corner.x;
                let row = rows.y_axis - rows.w_axis * corner.y;
                let planes = DMat3::from_cols(column.truncate(), row.truncate(), normal).transpose();
                depth(planes.inverse() * -DVec3::new(column.w, row.w, -normal.dot(centre)))
            });
            // Beyond four times the depth of the disc, the shader holds back.
            let is_plane = exact.iter().all(|exact| (exact - depth(centre)).abs() < 3.0 * span);
            for (corner, exact) in corners.iter().zip(exact).filter(|_| is_plane) {
                deep += 1;
                let off = (corner.z - exact).abs();
                assert!(off <= 1e-6 + 1e-4 * span, "{disc:?}: {} is {off:e} off", corner.z);
            }
        }
    }
    assert!(deep > 10_000, "{deep} depths");
}

/// The offset at a place of the rectangle, as it is interpolated: corner 0 is the first, 1 next to it in x, 2 in y.
fn offset_at([a, b, c]: [Vec2; 3], part: Vec2) -> Vec2 {
    a + part.x * (b - a) + part.y * (c - a)
}

/// A point on a disc's rim falls where the offset is 1 long, less the two parts in a hundred at most that are for the
/// rasteriser's grid; points inside where it is shorter, points outside, in the disc's plane, where it is longer.
#[test]
fn the_shader_tells_discs_from_their_rectangles() {
    let mut numbers = Numbers(5);
    let (mut on_rim, mut beside) = (0, 0);
    for warp in [Warp::Uniform, Warp::Perspective] {
        let map = landscape(&Settings::default().with_warp(warp));
        for _ in 0..2000 {
            let centre = DVec3::new(20.0 * numbers.part() - 10.0, numbers.part(), 8.0 - 16.0 * numbers.part());
            let (normal, radius) = (direction(&mut numbers), 0.05 + 0.8 * numbers.part());
            let disc = Round { centre, normal, radius };
            let corners = [CORNERS[0], CORNERS[1], CORNERS[2]].map(|corner| corner_of(&map, &disc, corner));
            let [a, b, c] = corners.map(|(corner, _)| Vec3::from(corner).truncate().as_dvec2());
            let offsets = corners.map(|(_, offset)| offset);
            let (x, y) = normal.any_orthonormal_pair();
            let offset_of = |share: f64, turn: f64| {
                let way = DVec2::from_angle(turn);
                let point = centre + share * radius * (way.x * x + way.y * y);
                let place = map.clip_from_world().project_point3(point).truncate();
                offset_at(offsets, ((place - a) / DVec2::new(b.x - a.x, c.y - a.y)).as_vec2()).length()
            };
            let turns = || (0..24).map(|i| 0.26 * f64::from(i));
            let rim: Vec<f32> = turns().map(|turn| offset_of(1.0, turn)).collect();
            let (least, most) = rim.iter().fold((f32::INFINITY, 0.0_f32), |(a, b), &rim| (a.min(rim), b.max(rim)));
            // The rim lies in what is kept, whether or not its ellipse was widened.
            assert!(most <= 1.0, "{centre}, {normal}, {radius}: {most}");
            // Of one that was not, it is its edge.
            if least > 0.98 {
                on_rim += 1;
                assert!(turns().all(|turn| offset_of(0.97, turn) < 1.0), "{centre}, {normal}, {radius}");
                assert!(turns().all(|turn| offset_of(1.03, turn) > 1.0), "{centre}, {normal}, {radius}");
                let outside = CORNERS.map(|corner| offset_at(offsets, 0.5 * (corner + 1.0)).length() > 1.0);
                beside += usize::from(outside == [true; 4]);
            }
        }
    }
    assert!(on_rim > 1000 && beside > on_rim / 2, "{on_rim} discs, {beside} with four corners beside them");
}

/// Wherever an ellipse falls, and however small or narrow it is, what is kept of its rectangle holds the middle of a
/// texel: it holds a square a texel large. Those no larger than a texel keep all of the rectangle.
#[test]
fn what_is_kept_of_a_splat_holds_the_middle_of_a_texel() {
    let mut numbers = Numbers(23);
    for _ in 0..20_000 {
        let half = DVec2::new(numbers.part(), numbers.part()).map(|part| 30.0 * part * part * part).as_vec2();
        let mixed = half.x * half.y * (2.0 * numbers.part() - 1.0) as f32;
        for corner in CORNERS {
            // Half of the least rectangle is 1.
            let kept = mirrored_offset(half, mixed, corner).length();
            assert!(kept <= 1.0, "{half}, {mixed}: {kept}");
            let own = mirrored_offset(half, mixed, corner * half.max(Vec2::ONE)).length();
            assert!(half.max_element() > 1.0 || own <= 1.0, "{half}, {mixed}: {own}");
        }
    }
}

#[cfg(feature = "wgsl")]
#[test]
fn the_shader_functions_are_valid_wgsl() {
    use naga::front::wgsl;
    use naga::valid::{Capabilities, ValidationFlags, Validator};

    let source = shadowfit::wgsl::SPLAT;
    let module = wgsl::parse_str(source).unwrap_or_else(|error| panic!("{}", error.emit_to_string(source)));
    let names: Vec<_> = module.functions.iter().filter_map(|(_, function)| function.name.as_deref()).collect();
    assert!(names.iter().all(|name| name.starts_with("shadowfit_")), "{names:?}");
    assert!(names.contains(&"shadowfit_disc_splat") && names.contains(&"shadowfit_ball_splat"), "{names:?}");
    assert!(names.contains(&"shadowfit_splat_corner"), "{names:?}");
    let result = Validator::new(ValidationFlags::all(), Capabilities::empty()).validate(&module);
    assert!(result.is_ok(), "{}", result.unwrap_err().emit_to_string(source));
}
