//! Balls and discs in a map, over views, lights and scenes at random: their bounds hold them and touch them, in f64 and
//! as the shader computes them in f32.

#![allow(clippy::disallowed_methods, reason = "angles and powers spread the cases, they are no part of a fit")]

mod arbitrary;

use arbitrary::{Case, Numbers, Similarity, Together, case, points_of, run, settings, sides};
use glam::{DMat3, DVec2, DVec3, DVec4, Mat4, Vec2, Vec3};
use proptest::prelude::*;
use shadowfit::{Light, Map, Origin, Outcome, Scene, Settings, Splat, TextureOrigin, View, Warp, YAxis, fit};

/// A disc or, with a normal of zero, a ball.
#[derive(Clone, Copy, Debug)]
struct Round {
    centre: DVec3,
    normal: DVec3,
    radius: f64,
}

impl Round {
    /// About a point, small or large for the scene that it stands in.
    fn about(point: DVec3, size: f64, numbers: &mut Numbers) -> Self {
        let is_ball = numbers.part() < 0.3;
        let normal = if is_ball { DVec3::ZERO } else { direction(numbers) };
        Self { centre: point, normal, radius: size * 10_f64.powf(1.0 - 7.0 * numbers.part()) }
    }

    fn splat(&self, map: &Map) -> Option<Splat> {
        match self.normal == DVec3::ZERO {
            true => map.splat(self.centre, self.radius),
            false => map.disc_splat(self.centre, self.normal, self.radius),
        }
    }

    /// The part of a vector that counts: in the disc's plane.
    fn within(&self, v: DVec3) -> DVec3 {
        v - self.normal * self.normal.dot(v)
    }

    /// The point that is farthest along a direction.
    fn farthest(&self, direction: DVec3) -> DVec3 {
        self.centre + self.within(direction).normalize_or_zero() * self.radius
    }
}

fn direction(numbers: &mut Numbers) -> DVec3 {
    let y = 2.0 * numbers.part() - 1.0;
    let (sin, cos) = (std::f64::consts::TAU * numbers.part()).sin_cos();
    let radius = (1.0 - y * y).sqrt();
    // Along the axes as often as not: many a normal in a real cloud is one of them.
    match (4.0 * numbers.part()) as usize {
        0 => DVec3::Y,
        1 => DVec3::X,
        _ => DVec3::new(radius * cos, y, radius * sin),
    }
}

/// Rows of a map that give places in texels, and what can be off in them.
struct Rows {
    x: DVec4,
    y: DVec4,
    w: DVec4,
    /// What the positions are relative to where they are rounded.
    origin: DVec3,
    /// How large coordinates are that rows were made of.
    reach: DVec3,
    /// Roundings of one row, relative to the sum of the magnitudes of its terms.
    roundings: f64,
}

impl Rows {
    /// In f64: some dozen roundings, as in all properties of maps.
    fn new(map: &Map, together: &Together, case: &Case) -> Self {
        let (min, max) = case.scene.bounds();
        let l = together.light.homogeneous();
        let reach = DVec3::from(min).abs().max(DVec3::from(max).abs())
            + together.view.eye().abs()
            + l.truncate().abs() * l.w;
        Self::of(map, DVec3::ZERO, reach, 64.0 * f64::EPSILON)
    }

    fn of(map: &Map, origin: DVec3, reach: DVec3, roundings: f64) -> Self {
        let rows = map.texture_from_world().transpose();
        let sides = sides(map.settings());
        Self { x: rows.x_axis * sides.x, y: rows.y_axis * sides.y, w: rows.w_axis, origin, reach, roundings }
    }

    fn place(&self, point: DVec3) -> DVec2 {
        let point = point.extend(1.0);
        DVec2::new(self.x.dot(point), self.y.dot(point)) / self.w.dot(point)
    }

    /// How far rounding can carry the value of a row over a ball or disc.
    fn slack_of(&self, row: DVec4, round: &Round) -> f64 {
        let farthest = (round.centre - self.origin).abs() + DVec3::splat(round.radius) + self.reach;
        let offset = row.dot(self.origin.extend(1.0));
        self.roundings * (row.truncate().abs().dot(farthest) + offset.abs()) + f64::MIN_POSITIVE
    }

    /// The least w over a ball or disc.
    fn least_w(&self, round: &Round) -> f64 {
        self.w.dot(round.farthest(-self.w.truncate()).extend(1.0))
    }

    /// How far rounding can carry the bounds of a ball or disc: `None` where it may carry them anywhere.
    ///
    /// A bound t is where the value of a − t·c vanishes. That value is off by what a and c are off by, and it changes
    /// with t by no less than the least c. The length of the bounds is also divided by 1 − |ρ c/c·P|², which is off by
    /// what c is off by over the least c, relative to itself.
    fn slack(&self, round: &Round, splat: &Splat) -> Option<DVec2> {
        let of_w = self.slack_of(self.w, round);
        let least = self.least_w(round) - of_w;
        let farthest = splat.centre.abs() + 2.0 * splat.half;
        let slack = DVec2::new(self.slack_of(self.x, round), self.slack_of(self.y, round)) + farthest * of_w;
        (least > of_w).then(|| slack / least)
    }
}

/// Whatever there is to see and one size of the scene, from a case.
fn rounds(together: &Together, case: &Case, seed: u64) -> Vec<Round> {
    let (min, max) = case.scene.bounds();
    let size = (DVec3::from(max) - DVec3::from(min)).length().max(f64::MIN_POSITIVE);
    let mut numbers = Numbers(!seed);
    let points = points_of(&together.focus().visible(), seed);
    points.into_iter().map(|point| Round::about(point, size, &mut numbers)).collect()
}

#[test]
fn bounds_hold_balls_and_discs_and_touch_them() {
    let tried = std::cell::Cell::new(0_usize);
    run(3000, &(case(), settings(), any::<u64>()), |(case, settings, seed)| {
        let together = Together::of(&case);
        let Outcome::Map(map) = together.focus().fit(&settings) else { return };
        let rows = Rows::new(&map, &together, &case);
        let mut numbers = Numbers(seed);
        for round in rounds(&together, &case, seed) {
            let Some(splat) = round.splat(&map) else { continue };
            let Some(slack) = rows.slack(&round, &splat) else { continue };
            tried.set(tried.get() + 1);
            let off = |point: DVec3| rows.place(point) - splat.centre;
            for _ in 0..8 {
                let aside = direction(&mut numbers);
                let point = round.farthest(aside).lerp(round.centre, (2.0 * numbers.part() - 1.0).max(0.0));
                let outside = off(point).abs() - splat.half - slack;
                assert!(outside.cmple(DVec2::ZERO).all(), "{round:?}, {splat:?}: {point} is {outside} outside");
            }
            // The planes of the four ends touch the ball where their normals lead to.
            for sign in [1.0, -1.0] {
                let end = splat.centre + splat.half * sign;
                let normal = |row: DVec4, end: f64| (row - rows.w * end).truncate() * sign;
                let x = off(round.farthest(normal(rows.x, end.x))).x - splat.half.x * sign;
                let y = off(round.farthest(normal(rows.y, end.y))).y - splat.half.y * sign;
                let apart = DVec2::new(x, y).abs();
                assert!(apart.cmple(slack).all(), "{round:?}, {splat:?}: {apart} before its end, not {slack}");
            }
        }
    });
    assert!(tried.get() > 10_000, "{} were tried", tried.get());
}

#[test]
fn what_reaches_behind_the_light_has_no_bounds() {
    let counts = std::cell::Cell::new([0_usize; 2]);
    run(3000, &(case(), settings(), any::<u64>()), |(case, settings, seed)| {
        let together = Together::of(&case);
        let Outcome::Map(map) = together.focus().fit(&settings) else { return };
        let rows = Rows::new(&map, &together, &case);
        for round in rounds(&together, &case, seed) {
            let (least, slack) = (rows.least_w(&round), rows.slack_of(rows.w, &round));
            let splat = round.splat(&map);
            let [mut with, mut without] = counts.get();
            match splat {
                Some(_) => with += 1,
                None => without += 1,
            }
            counts.set([with, without]);
            if least.abs() > 4.0 * slack {
                assert_eq!(splat.is_some(), least > 0.0, "{round:?} has w from {least} on");
            }
        }
    });
    let [with, without] = counts.get();
    assert!(with > 10_000 && without > 1000, "{with} with bounds, {without} without");
}

#[test]
fn scaling_by_a_power_of_two_scales_nothing_in_texels() {
    run(1000, &(case(), settings(), -20..=20_i32, any::<u64>()), |(case, settings, exponent, seed)| {
        let scale = 2_f64.powi(exponent);
        let [larger, back] = [scale, scale.recip()].map(|scale| Similarity { scale, offset: [0.0; 3] });
        let scaled = larger.apply(&case);
        let l = case.build().1.homogeneous();
        let is_tiny = |x: f64| x != 0.0 && x.abs() < 1e-200;
        if !scaled.is_accepted() || back.apply(&scaled) != case || l.to_array().into_iter().any(is_tiny) {
            return;
        }
        let (here, there) = (Together::of(&case), Together::of(&scaled));
        let (Some(map), Some(scaled)) =
            (here.focus().fit(&settings).map().copied(), there.focus().fit(&settings).map().copied())
        else {
            return;
        };
        for round in rounds(&here, &case, seed) {
            let larger = Round { centre: round.centre * scale, radius: round.radius * scale, ..round };
            let (one, other) = (round.splat(&map), larger.splat(&scaled));
            // Squares of what is tiny across may leave the normal range of f64 in one of the two.
            let is_tiny = |splat: &Splat| splat.half.min_element() < 1e-100;
            if !one.iter().chain(&other).any(is_tiny) {
                assert_eq!(one, other, "{round:?}");
            }
        }
    });
}

const TO_SUN: DVec3 = DVec3::new(0.3, 1.0, 0.2);

fn landscape(settings: &Settings) -> Map {
    let view =
        View::perspective((0.0, 2.0, 12.0), (0.0, -0.2, -1.0), DVec3::Y, 1.0, 1.6, 0.5, 100.0).expect("sound");
    let scene = Scene::from_box((-20.0, -1.0, -20.0), (20.0, 4.0, 20.0)).expect("sound");
    let sun = Light::directional(TO_SUN).expect("sound");
    *fit(&view, &sun, &scene, settings).map().expect("one map does")
}

/// Through parallel light a ball is a ball: in texels, its radius over what a texel covers.
#[test]
fn in_a_uniform_map_of_the_sun_a_ball_is_a_radius_and_a_disc_across_the_light_too() {
    let map = landscape(&Settings::default().with_warp(Warp::Uniform));
    let (centre, radius) = (DVec3::new(1.0, 0.5, -3.0), 0.25);
    let expected = 2048.0 * radius / DVec2::new(map.window().width, map.window().height);
    let place = map.texture_from_world().project_point3(centre).truncate() * 2048.0;
    for splat in [map.splat(centre, radius), map.disc_splat(centre, (0.6, 2.0, 0.4), radius)] {
        let splat = splat.expect("in the map");
        assert!((splat.half / expected - 1.0).abs().max_element() < 1e-12, "{splat:?}, not {expected}");
        assert!((splat.centre - place).length() < 1e-9, "{splat:?}, not {place}");
        assert_eq!(splat.diameter(), 2.0 * splat.half.max_element());
    }
    // From its edge a disc is a line: across the light and across its normal it is as wide as ever.
    let edge = map.disc_splat(centre, DVec3::new(1.0, 0.0, -1.5), radius).expect("in the map");
    let flat = map.splat(centre, radius).expect("in the map");
    assert!(edge.half.cmple(flat.half).all() && edge.half.length() < 1.0001 * flat.half.max_element());
}

#[test]
fn a_covering_rectangle_holds_the_middle_of_a_texel_wherever_it_falls() {
    let map = landscape(&Settings::default());
    let mut numbers = Numbers(7);
    for _ in 0..10_000 {
        let place = DVec3::new(20.0 * numbers.part() - 10.0, numbers.part(), -10.0 * numbers.part());
        let exact = map.disc_splat(place, direction(&mut numbers), 1e-3).expect("in the map");
        let splat = exact.covering();
        assert!(splat.half.cmpge(exact.half).all() && splat.centre == exact.centre);
        // Corners on a grid of 256ths, each moved by half a step at most.
        let [low, high] = [-1.0, 1.0].map(|sign| ((splat.centre + splat.half * sign) * 256.0).round() / 256.0);
        let first_middle = (low - 0.5).ceil() + 0.5;
        assert!(first_middle.cmplt(high).all(), "{splat:?} holds no middle of a texel");
    }
    let large = Splat { centre: DVec2::ONE, half: DVec2::new(3.0, 0.25) };
    assert_eq!(large.covering().half.x, 3.0);
}

#[test]
fn numbers_that_are_none_have_no_bounds() {
    let map = landscape(&Settings::default());
    let (point, up) = (DVec3::new(1.0, 0.5, -3.0), DVec3::Y);
    for radius in [-1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(map.splat(point, radius), None);
        assert_eq!(map.disc_splat(point, up, radius), None);
    }
    for centre in [DVec3::NAN, DVec3::INFINITY, DVec3::splat(f64::MAX)] {
        assert_eq!(map.splat(centre, 1.0), None);
        assert_eq!(map.disc_splat(centre, up, 1.0), None);
    }
    for normal in [DVec3::ZERO, DVec3::NAN, DVec3::NEG_INFINITY] {
        assert_eq!(map.disc_splat(point, normal, 1.0), None);
    }
    let point = map.splat(point, 0.0).expect("a point has a place");
    assert_eq!(point.half, DVec2::ZERO);
}

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

const CORNERS: [Vec2; 4] = [Vec2::new(-1.0, -1.0), Vec2::new(1.0, -1.0), Vec2::new(-1.0, 1.0), Vec2::new(1.0, 1.0)];

/// Texels of a clip position in the map's own convention.
fn texels(map: &Map, [x, y, _]: [f32; 3]) -> DVec2 {
    let clip = map.settings().clip();
    let from_top = (clip.y, clip.texture_origin) == (YAxis::Up, TextureOrigin::TopLeft);
    let v = if from_top { 0.5 - 0.5 * f64::from(y) } else { 0.5 + 0.5 * f64::from(y) };
    DVec2::new(0.5 + 0.5 * f64::from(x), v) * sides(map.settings())
}

#[test]
fn the_shader_finds_the_same_bounds_and_the_depth_of_the_disc() {
    /// Eight units in the last place for each of a dozen rows that go into a corner, see the crate's own bound for one.
    const ROUNDINGS: f64 = 96.0 / 16_777_216.0;
    let placed = std::cell::Cell::new(0_usize);
    run(3000, &(case(), settings(), any::<u64>()), |(case, settings, seed)| {
        let together = Together::of(&case);
        let Outcome::Map(map) = together.focus().fit(&settings) else { return };
        let origin = match map.settings().origin() {
            Origin::World => DVec3::ZERO,
            Origin::Eye => together.view.eye(),
        };
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
                mirrored(map.matrix(), centre, normal, radius, sides.as_vec2(), corner)
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
        let rows = map.shadow_from_world().transpose();
        for _ in 0..5000 {
            let centre = DVec3::new(20.0 * numbers.part() - 10.0, numbers.part(), 8.0 - 16.0 * numbers.part());
            let (normal, radius) = (direction(&mut numbers), 0.01 + 0.4 * numbers.part());
            let corner_at = |corner| {
                mirrored(
                    map.matrix(),
                    centre.as_vec3(),
                    normal.as_vec3(),
                    radius as f32,
                    Vec2::splat(2048.0),
                    corner,
                )
            };
            let corners = CORNERS.map(corner_at).map(|corner| Vec3::from(corner).as_dvec3());
            let disc = Round { centre, normal, radius };
            let depth = |point: DVec3| map.shadow_from_world().project_point3(point).z;
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
            let corners = [CORNERS[0], CORNERS[1], CORNERS[2]].map(|corner| {
                mirrored_corner(
                    map.matrix(),
                    centre.as_vec3(),
                    normal.as_vec3(),
                    radius as f32,
                    Vec2::splat(2048.0),
                    corner,
                )
            });
            let [a, b, c] = corners.map(|(corner, _)| Vec3::from(corner).truncate().as_dvec2());
            let offsets = corners.map(|(_, offset)| offset);
            let (x, y) = normal.any_orthonormal_pair();
            let offset_of = |share: f64, turn: f64| {
                let way = DVec2::from_angle(turn);
                let point = centre + share * radius * (way.x * x + way.y * y);
                let place = map.shadow_from_world().project_point3(point).truncate();
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
