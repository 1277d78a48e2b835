//! The bias that a map asks for, on planes drawn as a rasteriser draws them, and offsets in the receiver's matrix.
//!
//! Each property runs some thousands of cases from a fixed seed; `SHADOWFIT_CASES=100000` in the environment runs that many
//! of each instead.

#![allow(clippy::disallowed_methods, reason = "angles and powers spread the cases, they are no part of a fit")]

mod arbitrary;

use std::cell::Cell;
use std::f64::consts::TAU;

use arbitrary::{Numbers, Together, case, points_of, run, settings};
use glam::{DMat4, DVec2, DVec3, DVec4, Mat4, Vec4Swizzles};
use proptest::prelude::*;
use shadowfit::{
    ClipSpace, DepthBias, DepthFormat, DepthRange, Focus, InputError, Light, Map, Offset, Origin, Outcome, Problem,
    Scene, Settings, TextureOrigin, View, Warp, YAxis, fit,
};

const FORMATS: [DepthFormat; 4] =
    [DepthFormat::Unorm8, DepthFormat::Unorm16, DepthFormat::Unorm24, DepthFormat::Float32];

/// What f32 makes of a row, relative to the sum of its terms' magnitudes.
const UNITS: f64 = 8.0 / 16_777_216.0;

/// A map on a card: places in texels, counted as its texture coordinates are, and depths as stored.
struct Card<'a> {
    map: &'a Map,
    /// What positions are relative to.
    origin: DVec3,
    /// World to texture space, exact.
    exact: DMat4,
    size: f64,
    reversed: bool,
}

impl<'a> Card<'a> {
    fn new(map: &'a Map, view: &View) -> Self {
        let origin = match map.settings().origin() {
            Origin::World => DVec3::ZERO,
            Origin::Eye => view.eye(),
        };
        let size = map.settings().map_size().into();
        let reversed = map.settings().clip().depth.is_reversed();
        Self { map, origin, exact: map.texture_from_world(), size, reversed }
    }

    /// Where a point falls, in texels, and its depth; exact.
    fn place(&self, point: DVec3) -> DVec3 {
        self.exact.project_point3(point) * DVec3::new(self.size, self.size, 1.0)
    }

    /// The same in f32, by a matrix from positions to texture space.
    fn place_in_f32(&self, texture: &Mat4, point: DVec3) -> DVec3 {
        let at = *texture * (point - self.origin).as_vec3().extend(1.0);
        (at.xyz() / at.w).as_dvec3() * DVec3::new(self.size, self.size, 1.0)
    }

    /// The same of a caster's corner, by way of clip space, as a driver takes it to the grid of a 256th of a texel, up or
    /// down as `up` says.
    fn corner(&self, point: DVec3, up: [bool; 2]) -> DVec3 {
        let clip = self.map.settings().clip();
        let at = self.map.matrix() * (point - self.origin).as_vec3().extend(1.0);
        let at = at.xyz() / at.w;
        let v_up = clip.y == YAxis::Down || clip.texture_origin == TextureOrigin::BottomLeft;
        let (x, y) = (0.5 + 0.5 * at.x, if v_up { 0.5 + 0.5 * at.y } else { 0.5 - 0.5 * at.y });
        let z = match clip.depth {
            DepthRange::ZeroToOne | DepthRange::ZeroToOneReversed => at.z,
            DepthRange::NegativeOneToOne | DepthRange::NegativeOneToOneReversed => 0.5 + 0.5 * at.z,
        };
        let snapped = |place: f32, up: bool| {
            let grid = f64::from(place) * self.size * 256.0;
            (if up { grid.ceil() } else { grid.floor() }) / 256.0
        };
        DVec3::new(snapped(x, up[0]), snapped(y, up[1]), z.into())
    }

    /// The point on the plane through `point` across `normal` that falls on a place.
    fn on_plane(&self, point: DVec3, normal: DVec3, place: DVec2) -> Option<DVec3> {
        let rows = self.exact.transpose();
        let column = rows.x_axis - rows.w_axis * (place.x / self.size);
        let row = rows.y_axis - rows.w_axis * (place.y / self.size);
        let (x, y) = (column.xyz(), row.xyz());
        let volume = x.dot(y.cross(normal));
        let off = DVec2::new(column.dot(point.extend(1.0)), row.dot(point.extend(1.0)));
        let found = point - (y.cross(normal) * off.x + normal.cross(x) * off.y) / volume;
        (found.is_finite() && rows.w_axis.dot(found.extend(1.0)) > 0.0).then_some(found)
    }

    /// Whether f32 moves a point by no more than the map says of what is visible.
    fn is_quiet(&self, point: DVec3) -> bool {
        let rows = self.map.shadow_from_world_in(ClipSpace::WGPU).transpose();
        let w = rows.w_axis.dot(point.extend(1.0));
        let of = |row: DVec4| {
            let terms = row.xyz().abs().dot((point - self.origin).abs()) + row.dot(self.origin.extend(1.0)).abs();
            UNITS * terms / w
        };
        let [x, y, z, w_rounding] = [rows.x_axis, rows.y_axis, rows.z_axis, rows.w_axis].map(of);
        let left = 1.0 - w_rounding;
        let across = 0.5 * self.size * (x.max(y) + 3.0 * w_rounding) / left;
        let depth = (z + w_rounding) / left;
        w > 0.0 && w_rounding < 0.5 && across <= self.map.window().rounding && depth <= self.map.depth().rounding
    }
}

/// The corners of a triangle as drawn, and what it makes of depth.
struct Triangle {
    corners: [DVec3; 3],
}

impl Triangle {
    fn least_height(&self) -> f64 {
        let [a, b, c] = self.corners.map(|corner| corner.truncate());
        let longest = (b - a).length().max((c - b).length()).max((a - c).length());
        (b - a).perp_dot(c - a).abs() / longest
    }

    /// The depth at a place, and how it changes from there across and down.
    fn depth(&self, place: DVec2) -> (f64, DVec2) {
        let [a, b, c] = self.corners;
        let (b, c) = (b - a, c - a);
        let area = b.truncate().perp_dot(c.truncate());
        let gradient = DVec2::new(b.z * c.y - c.z * b.y, c.z * b.x - b.z * c.x) / area;
        (a.z + gradient.dot(place - a.truncate()), gradient)
    }
}

/// The two ways a card may round: what is stored to the next value towards the light, and nothing else; or what is stored
/// and what it is compared with, both to the nearest.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Round {
    TowardsLight,
    Nearest,
}

/// A depth from 0 to 1 in a format.
fn quantised(format: DepthFormat, depth: f64, round: Round, reversed: bool) -> f64 {
    let depth = depth.clamp(0.0, 1.0);
    let steps = match format {
        DepthFormat::Unorm8 => 255.0,
        DepthFormat::Unorm16 => 65_535.0,
        DepthFormat::Unorm24 => 16_777_215.0,
        DepthFormat::Float32 => {
            let nearest = depth as f32;
            let nearest_f64 = f64::from(nearest);
            return match (round, reversed) {
                (Round::TowardsLight, false) if nearest_f64 > depth => nearest.next_down().into(),
                (Round::TowardsLight, true) if nearest_f64 < depth => nearest.next_up().into(),
                _ => nearest_f64,
            };
        }
    };
    let step = match (round, reversed) {
        (Round::Nearest, _) => (depth * steps).round(),
        (Round::TowardsLight, false) => (depth * steps).floor(),
        (Round::TowardsLight, true) => (depth * steps).ceil(),
    };
    step / steps
}

/// A plane before a light, a texel, and a triangle of the plane around the texel's middle.
#[derive(Clone, Copy, Debug)]
struct Drawing {
    format: DepthFormat,
    reach: f64,
    round: Round,
    /// How much the plane leans out of the light: the tangent of the angle.
    lean: f64,
    /// Which way.
    turn: f64,
    /// How high the triangle is, in what a bias answers for, and which way it points.
    height: f64,
    points: f64,
}

fn drawing() -> impl Strategy<Value = Drawing> {
    let format = prop::sample::select(FORMATS.to_vec());
    let reach = prop::sample::select(vec![0.5, 1.0, 1.5, 2.5, 3.5]);
    let round = prop_oneof![Just(Round::TowardsLight), Just(Round::Nearest)];
    let lean = prop_oneof![1 => Just(0.0), 3 => 0.0..3.0, 2 => 3.0..100.0];
    let height = prop_oneof![1.0..1.5, 1.5..30.0];
    (format, reach, round, lean, 0.0..TAU, height, 0.0..TAU).prop_map(
        |(format, reach, round, lean, turn, height, points)| Drawing {
            format,
            reach,
            round,
            lean,
            turn,
            height,
            points,
        },
    )
}

/// By how much of the depth range a receiver near `point` is lit by its own plane; negative where it is in its own shadow.
/// `None` where the premises of the bias are not met or the receiver does not read the texel after all.
fn margin(card: &Card<'_>, light: &Light, point: DVec3, bias: &DepthBias, how: &Drawing, seed: u64) -> Option<f64> {
    let (map, sign) = (card.map, if card.reversed { -1.0 } else { 1.0 });
    let mut numbers = Numbers(seed);
    let to_light = light.direction_from(point);
    let across = to_light.any_orthonormal_vector();
    let normal = to_light + (across * how.turn.cos() + to_light.cross(across) * how.turn.sin()) * how.lean;

    // The receiver, as far from the middle of its texel as the filter reads, where the plane is deepest.
    let middle = card.place(point).truncate().floor() + 0.5;
    let at_middle = card.on_plane(point, normal, middle)?;
    let depth = |step: DVec2| Some(sign * card.place(card.on_plane(point, normal, middle + step)?).z);
    let here = depth(DVec2::ZERO)?;
    let deeper = DVec2::new((depth(DVec2::X)? - here).signum(), (depth(DVec2::Y)? - here).signum());
    let inside = how.reach - map.window().rounding * numbers.part() - 1e-3 * numbers.part();
    let receiver = card.on_plane(at_middle, normal, middle + deeper * inside)?;
    let texture = map.texture_matrix_with(&bias.offset());
    let read = card.place_in_f32(&texture, receiver);
    let is_read = (read.truncate() - middle).abs().max_element() <= how.reach;
    if !is_read || !card.is_quiet(receiver) {
        return None;
    }

    // A triangle around the middle of the texel.
    let least_height = 1_f64.max(8.0 * (1.0 / 256.0 + map.window().rounding));
    let radius = how.height * least_height / 1.5;
    let corners = [0.0, 1.0, 2.0].map(|third| DVec2::from_angle(how.points + third * TAU / 3.0) * radius);
    let weights = [(); 3].map(|()| numbers.part() + 1e-3);
    let total: f64 = weights.iter().sum();
    let inner: DVec2 = corners.iter().zip(weights).map(|(corner, weight)| corner * (weight / total)).sum();
    let mut drawn = [DVec3::ZERO; 3];
    for (drawn, corner) in drawn.iter_mut().zip(corners) {
        let corner = card.on_plane(at_middle, normal, middle + corner - inner)?;
        if !card.is_quiet(corner) {
            return None;
        }
        *drawn = card.corner(corner, [numbers.part() < 0.5, numbers.part() < 0.5]);
    }
    let triangle = Triangle { corners: drawn };
    if triangle.least_height() < least_height {
        return None;
    }

    // The least that a card may add: its smallest unit, the larger of the slopes.
    let (depth, gradient) = triangle.depth(middle);
    let unit = *bias.format.bias_unit(depth.clamp(0.0, 1.0)).start();
    let added = f64::from(bias.constant) * unit + f64::from(bias.slope) * gradient.abs().max_element();
    let stored = quantised(bias.format, depth + sign * added, how.round, card.reversed);
    let compared = read.z.clamp(0.0, 1.0);
    let compared = match how.round {
        Round::TowardsLight => compared,
        Round::Nearest => quantised(bias.format, compared, how.round, card.reversed),
    };
    Some(sign * (stored - compared))
}

#[test]
fn no_plane_shadows_itself() {
    let (tested, grazing) = (Cell::new(0_u32), Cell::new(0_u32));
    run(8000, &(case(), settings(), drawing(), any::<u64>()), |(case, settings, how, seed)| {
        let together = Together::of(&case);
        let focus = together.focus();
        let Outcome::Map(map) = focus.fit(&settings) else { return };
        let card = Card::new(&map, &together.view);
        let bias = map.bias(how.format, how.reach).expect("a legal reach");
        for (i, point) in points_of(&focus.visible(), seed).into_iter().enumerate() {
            if !together.is_served(point) {
                continue;
            }
            let seed = seed.wrapping_add(i as u64);
            let Some(margin) = margin(&card, &together.light, point, &bias, &how, seed) else { continue };
            assert!(margin >= 0.0, "{point} is in its own shadow by {margin}, {bias:?}");
            tested.set(tested.get() + 1);
            grazing.set(grazing.get() + u32::from(how.lean > 3.0));
        }
    });
    // The premises leave out points at the end of what is visible, whose neighbours round more coarsely.
    assert!(tested.get() > 2 * grazing.get() && grazing.get() > 1000, "{} and {}", tested.get(), grazing.get());
}

/// Half of the slope is too little, and so is a map without the receiver's part: neither is there for safety alone.
#[test]
fn less_is_not_enough() {
    let (steep, with_half) = (Cell::new(0_u32), Cell::new(0_u32));
    let (flat, without_receiver) = (Cell::new(0_u32), Cell::new(0_u32));
    run(4000, &(case(), settings(), drawing(), any::<u64>()), |(case, settings, how, seed)| {
        let together = Together::of(&case);
        let focus = together.focus();
        let Outcome::Map(map) = focus.fit(&settings) else { return };
        let card = Card::new(&map, &together.view);
        let bias = map.bias(how.format, how.reach).expect("a legal reach");
        let count = |of: &Cell<u32>, bad: &Cell<u32>, margin: Option<f64>| {
            let Some(margin) = margin else { return };
            of.set(of.get() + 1);
            bad.set(bad.get() + u32::from(margin < 0.0));
        };
        for (i, point) in points_of(&focus.visible(), seed).into_iter().enumerate() {
            let seed = seed.wrapping_add(i as u64);
            if !together.is_served(point) {
                continue;
            }
            let half = DepthBias { slope: 0.5 * bias.slope, ..bias };
            if how.lean > 3.0 && how.format != DepthFormat::Unorm8 {
                count(&steep, &with_half, margin(&card, &together.light, point, &half, &how, seed));
            }
            let alone = DepthBias { receiver: 0.0, ..bias };
            if how.lean == 0.0 && how.format == DepthFormat::Float32 {
                count(&flat, &without_receiver, margin(&card, &together.light, point, &alone, &how, seed));
            }
        }
    });
    let [steep, with_half, flat, without_receiver] =
        [steep, with_half, flat, without_receiver].map(Cell::into_inner);
    assert!(
        steep > 1000 && 10 * with_half > steep,
        "{with_half} of {steep} shadow themselves with half of the slope"
    );
    assert!(flat > 100 && 50 * without_receiver > flat, "{without_receiver} of {flat} without the receiver's part");
}

#[test]
fn places_are_as_quiet_as_the_window_says() {
    run(5000, &(case(), settings(), any::<u64>()), |(case, settings, seed)| {
        let together = Together::of(&case);
        let focus = together.focus();
        let Outcome::Map(map) = focus.fit(&settings) else { return };
        let card = Card::new(&map, &together.view);
        let visible = focus.visible();
        // The bound is one over vertices, and those within the near distance of a lamp are left out of it.
        if !visible.vertices().iter().all(|&vertex| together.is_served(vertex)) {
            return;
        }
        for point in points_of(&visible, seed) {
            // Where f32 loses half of w there is no bound.
            let rows = map.shadow_from_world_in(ClipSpace::WGPU).transpose();
            let (w, origin) = (rows.w_axis, card.origin);
            let terms = w.xyz().abs().dot((point - origin).abs()) + w.dot(origin.extend(1.0)).abs();
            if UNITS * terms > 0.5 * w.dot(point.extend(1.0)) {
                continue;
            }
            let off = card.place_in_f32(&map.texture_matrix(), point) - card.place(point);
            let (off, noise) = (off.truncate().abs().max_element(), map.window().rounding);
            assert!(off <= noise, "{point}: {off} texels, noise {noise}");
        }
    });
}

/// A plane under a lamp and the sun, seen from a person's height, and bodies above it.
fn outdoors(light: &Light, settings: &Settings) -> Map {
    *fit(&view(), light, &scene(), settings).map().expect("a map")
}

fn view() -> View {
    View::perspective((0.0, 1.75, 8.0), (0.0, -0.125, -1.0), DVec3::Y, 1.0, 1.5, 0.5, 100.0).expect("sound")
}

fn scene() -> Scene<'static> {
    Scene::from_box((-16.0, 0.0, -32.0), (16.0, 4.0, 16.0)).expect("sound")
}

fn sun() -> Light {
    Light::directional((0.25, 1.0, 0.5)).expect("sound")
}

fn lamp() -> Light {
    Light::point((4.0, 12.0, -16.0), 0.25, f64::INFINITY).expect("sound")
}

#[test]
fn eight_bits_are_steps_of_a_255th() {
    let format = DepthFormat::Unorm8;
    assert_eq!([0.0, 0.3, 1.0].map(|depth| format.step(depth)), [1.0 / 255.0; 3]);
    let map = outdoors(&sun(), &Settings::default().with_warp(Warp::Uniform));
    let range = map.depth().far - map.depth().near;
    // One 255th of the range.
    let resolution = map.depth_resolution(DVec3::new(0.0, 0.0, 0.0), format);
    assert!((resolution - range / 255.0).abs() < 1e-9 * range, "{resolution} of {range}");
    // What f32 rounds is nothing to so coarse a step, and another map of any kind asks for the same.
    let bias = map.bias(format, 0.5).expect("a legal reach");
    assert_eq!((bias.constant, bias.constant_alone(), bias.slope), (1, Some(2), 1.0625));
    assert!(bias.receiver < 0.01 * format.step(1.0), "{bias:?}");
}

/// A unit of floating point vanishes where depth does; a unit of fixed point does not.
#[test]
fn units_are_what_the_apis_say() {
    for (format, bits) in [(DepthFormat::Unorm8, 8), (DepthFormat::Unorm16, 16), (DepthFormat::Unorm24, 24)] {
        let unit = format.bias_unit(1e-30);
        assert_eq!((*unit.start(), *unit.end()), (0.5_f64.powi(bits), 2.0 * format.step(0.0)));
    }
    let unit = |largest| *DepthFormat::Float32.bias_unit(largest).end();
    for (largest, exponent) in [(0.25, -2), (0.49, -2), (0.5, -1), (0.999, -1), (1.0, 0), (1e-3, -10)] {
        assert_eq!(unit(largest), 2_f64.powi(exponent - 23), "{largest}");
    }
    assert_eq!([unit(0.0), unit(-1.0), unit(f64::NAN)], [0.0; 3]);
}

#[test]
fn a_reach_makes_sense_or_is_refused() {
    let map = outdoors(&sun(), &Settings::default());
    for (reach, problem) in [
        (f64::NAN, Problem::NotFinite),
        (f64::INFINITY, Problem::NotFinite),
        (0.49, Problem::TooSmall),
        (-1.0, Problem::TooSmall),
        (65_537.0, Problem::TooLarge),
    ] {
        let error = map.bias(DepthFormat::Unorm16, reach).expect_err("no such filter");
        assert_eq!(error, InputError { field: "reach", problem });
    }
    // Wider filters need more, and all of it is finite.
    let slopes = [0.5, 1.0, 1.5, 100.0, 65_536.0].map(|reach| map.bias(DepthFormat::Float32, reach).unwrap().slope);
    assert!(slopes.is_sorted() && slopes[0] < 1.2 && slopes[4].is_finite(), "{slopes:?}");
}

/// The most that two ways to compute a depth may differ by: a few dozen roundings of the terms of the rows, which are
/// combinations of planes through the light, so that its own coordinates count.
fn slack(matrix: &DMat4, light: &Light, point: DVec3) -> f64 {
    let (rows, l) = (matrix.transpose(), light.homogeneous());
    let terms = |row: DVec4| row.xyz().abs().dot(point.abs() + l.truncate().abs()) + row.w.abs();
    let all = terms(rows.x_axis) + terms(rows.y_axis) + terms(rows.z_axis) + terms(rows.w_axis);
    64.0 * f64::EPSILON * all / rows.w_axis.dot(point.extend(1.0))
}

/// `X + part · l`, as a point.
fn towards(light: &Light, point: DVec3, part: f64) -> DVec3 {
    let l = light.homogeneous();
    (point + part * l.truncate()) / (1.0 + part * l.w)
}

/// Depth away from the light.
fn away(map: &Map, depth: f64) -> f64 {
    if map.settings().clip().depth.is_reversed() { 1.0 - depth } else { depth }
}

#[test]
fn offsets_are_the_depths_of_points_nearer_to_the_light() {
    let amount = prop_oneof![3 => 0.0..0.5, 1 => -0.3..0.0, 1 => Just(0.0)];
    let checked = Cell::new(0_u32);
    run(3000, &(case(), settings(), amount, any::<u64>()), |(case, settings, amount, seed)| {
        let together = Together::of(&case);
        let focus = together.focus();
        let Outcome::Map(map) = focus.fit(&settings) else { return };
        let plain = map.texture_from_world();
        let light = &together.light;
        // A world length that is something in this scene.
        let (min, max) = case.scene.bounds();
        let length = amount * (DVec3::from(max) - DVec3::from(min)).length();
        let relative = map.texture_from_world_with(&Offset::relative(amount).expect("legal"));
        let depth = map.texture_from_world_with(&Offset::depth(amount).expect("legal"));
        let world = map.texture_from_world_with(&Offset::world(length).expect("legal"));
        let visible = focus.visible();
        for point in points_of(&visible, seed) {
            if !together.is_served(point) {
                continue;
            }
            let here = plain.project_point3(point);
            let same = |matrix: &DMat4, instead: DVec3, more: f64| {
                let (offset, moved) = (matrix.project_point3(point), plain.project_point3(instead));
                let slack =
                    slack(matrix, light, point) + slack(&plain, light, instead) + slack(&plain, light, point);
                // What w is off by counts as often as depth is large, which it is where a point is moved out of the map.
                let slack = slack * (1.0 + moved.z.abs());
                assert_eq!(offset.truncate(), here.truncate());
                assert!((offset - moved).truncate().abs().max_element() <= slack, "{offset}, not {moved}");
                let off = away(&map, offset.z) - away(&map, moved.z) + more;
                assert!(off.abs() <= slack, "{point}: depth is off by {off}, slack {slack}");
            };
            same(&relative, towards(light, point, amount), 0.0);
            same(&depth, point, amount);
            match light.position() {
                None => same(&world, towards(light, point, length), 0.0),
                Some(position) => {
                    let distance = position.distance(point);
                    let (moved, slack) = moved_by(&plain, &world, light, position, point);
                    // Nothing can be told of a lamp so near, or so far out, that f64 loses most of where it stands. No
                    // point is moved by more than half of what the nearest is away, along the axis.
                    let along = visible.vertices().iter().map(|&at| along_axis(&map, light, at));
                    let nearest = along.fold(f64::INFINITY, f64::min);
                    if slack < 1e-3 * distance && length > 0.0 {
                        let asked = length.min(0.49 * nearest);
                        assert!(moved >= asked - slack, "{moved} of {asked} at {point}, slack {slack}");
                        checked.set(checked.get() + 1);
                    }
                }
            }
        }
    });
    assert!(checked.get() > 5_000, "{}", checked.get());
}

/// How far an offset's matrix moves a point towards a lamp, and how far rounding can carry that.
fn moved_by(plain: &DMat4, offset: &DMat4, light: &Light, position: DVec3, point: DVec3) -> (f64, f64) {
    let row = |matrix: &DMat4, at: DVec3| matrix.transpose().z_axis.dot(at.extend(1.0));
    // e·(X + g l) is linear in g, which moves X by g/(1 + g) of its distance.
    let of_light = row(plain, position);
    let part = (row(offset, point) - row(plain, point)) / of_light;
    let w = plain.transpose().w_axis.dot(point.extend(1.0));
    let slack = (slack(plain, light, point) + slack(offset, light, point)) * w / of_light.abs();
    let distance = position.distance(point);
    // Less than the part is off by, and as much of it again where e·l is.
    (distance * part / (1.0 + part), distance * slack * (2.0 + part.abs()))
}

/// The distance of a point from the light along the axis of the map, which linear depth grows along.
fn along_axis(map: &Map, light: &Light, point: DVec3) -> f64 {
    let position = light.position().expect("a lamp");
    map.linear_depth().normal.normalize().dot(point - position)
}

#[test]
fn offsets_in_f32_are_the_ones_in_f64() {
    for light in [sun(), lamp()] {
        for clip in [ClipSpace::WGPU, ClipSpace::WGPU.reversed(), ClipSpace::OPENGL, ClipSpace::VULKAN.reversed()] {
            for origin in [Origin::World, Origin::Eye] {
                let map = outdoors(&light, &Settings::default().with_clip(clip).with_origin(origin));
                let about = match origin {
                    Origin::World => DMat4::IDENTITY,
                    Origin::Eye => DMat4::from_translation(view().eye()),
                };
                for offset in [Offset::world(0.1), Offset::relative(0.01), Offset::depth(1e-3)].map(Result::unwrap)
                {
                    let matrix = map.texture_from_world_with(&offset) * about;
                    assert_eq!(map.texture_matrix_with(&offset), matrix.as_mat4());
                }
                let none = Offset::depth(0.0).expect("legal");
                assert_eq!(map.texture_matrix_with(&none), map.texture_matrix());
            }
        }
    }
}

/// What a lamp's receivers are moved by, along the axis: what was asked for at both ends, and more between.
#[test]
fn a_world_distance_under_a_lamp_is_a_chord() {
    let map = outdoors(&lamp(), &Settings::default());
    let focus = Focus::new(&view(), &lamp(), &scene());
    let position = lamp().position().expect("a lamp");
    let (plain, moved) =
        (map.texture_from_world(), map.texture_from_world_with(&Offset::world(0.05).expect("legal")));
    let by = |point: DVec3| {
        let row = |matrix: &DMat4| matrix.transpose().z_axis.dot(point.extend(1.0));
        let part = (row(&moved) - row(&plain)) / plain.transpose().z_axis.dot(position.extend(1.0));
        position.distance(point) * part / (1.0 + part)
    };
    let all: Vec<f64> = focus.visible().vertices().iter().map(|&point| by(point)).collect();
    let (least, most) =
        (all.iter().copied().fold(f64::INFINITY, f64::min), all.iter().copied().fold(0.0, f64::max));
    // Off the axis of the map by up to 60°, distance is up to twice what it is along the axis.
    assert!((0.05..0.2).contains(&least) && most < 0.2, "{least} to {most}");
}

#[test]
fn offsets_that_make_no_sense_are_refused() {
    let refused = |offset: Result<Offset, InputError>| offset.expect_err("no sense");
    let error = |field, problem| InputError { field, problem };
    assert_eq!(refused(Offset::world(f64::NAN)), error("distance", Problem::NotFinite));
    assert_eq!(refused(Offset::world(1e13)), error("distance", Problem::TooLarge));
    assert_eq!(refused(Offset::relative(f64::INFINITY)), error("part", Problem::NotFinite));
    assert_eq!(refused(Offset::relative(-0.6)), error("part", Problem::TooSmall));
    assert_eq!(refused(Offset::depth(f64::NEG_INFINITY)), error("depth", Problem::NotFinite));
}

/// A receiver moved away along the ray by the distance that the bias costs has just the depth that is stored.
#[test]
fn what_a_bias_costs_is_a_distance_along_the_ray() {
    for light in [sun(), lamp()] {
        for warp in [Warp::Uniform, Warp::Perspective] {
            let map = outdoors(&light, &Settings::default().with_warp(warp));
            let (point, normal) = (DVec3::new(1.0, 0.5, -2.0), DVec3::new(0.1, 1.0, 0.3));
            for format in FORMATS {
                let bias = map.bias(format, 1.0).expect("a legal reach");
                let distance = map.bias_distance(point, normal, &bias);
                if format == DepthFormat::Unorm8 && distance == f64::INFINITY {
                    // No depth along the ray is so much larger.
                    continue;
                }
                let matrix = map.shadow_from_world_in(ClipSpace::WGPU);
                let behind = matrix.project_point3(point - light.direction_from(point) * distance).z;
                let slopes = map.depth_slopes(point, normal).expect("not from its edge").length();
                let stored = matrix.project_point3(point).z + bias.bias_in_depth(slopes);
                assert!((behind - stored).abs() < 1e-12, "{format:?}: {behind} and {stored}");
                // Along the plane's own ray nothing is farther than from its edge.
                assert!(distance > 0.0 && distance < map.bias_distance(point, normal.with_y(-0.2), &bias));
            }
        }
    }
    let map = outdoors(&sun(), &Settings::default());
    let bias = map.bias(DepthFormat::Unorm24, 0.5).expect("a legal reach");
    let behind_the_map = DVec3::new(0.0, 0.0, 1e9);
    for (point, normal) in [(DVec3::ZERO, DVec3::ZERO), (behind_the_map, DVec3::Y), (DVec3::NAN, DVec3::Y)] {
        assert_eq!(map.bias_distance(point, normal, &bias), f64::INFINITY, "{point} {normal}");
    }
}

trait BiasInDepth {
    fn bias_in_depth(&self, slope: f64) -> f64;
}

impl BiasInDepth for DepthBias {
    /// The most that may be added to depth on a plane with a gradient so long, with a step for rounding.
    fn bias_in_depth(&self, slope: f64) -> f64 {
        let unit = *self.format.bias_unit(1.0).end();
        f64::from(self.constant) * unit + f64::from(self.slope) * slope + self.receiver + self.format.step(0.5)
    }
}

/// A uniform map of the sun stores linear depth as it is.
#[test]
fn without_a_warp_the_suns_depth_is_linear() {
    let map = outdoors(&sun(), &Settings::default().with_warp(Warp::Uniform));
    let linear = map.linear_depth();
    for point in Focus::new(&view(), &sun(), &scene()).visible().vertices() {
        let (hyperbolic, linear) = (map.shadow_from_world().project_point3(*point).z, linear.at(*point));
        assert!((hyperbolic - linear).abs() < 1e-5, "{hyperbolic} {linear}");
    }
}

#[test]
fn linear_depth_holds_what_is_visible_and_grows_along_rays() {
    run(2000, &(case(), settings(), any::<u64>()), |(case, settings, seed)| {
        let together = Together::of(&case);
        let focus = together.focus();
        let Outcome::Map(map) = focus.fit(&settings) else { return };
        let linear = map.linear_depth();
        let ahead = |point: DVec3| -linear.normal.dot(together.light.direction_from(point));
        for point in points_of(&focus.visible(), seed) {
            let depth = linear.at(point);
            let slack = 64.0 * f64::EPSILON * (linear.normal.abs().dot(point.abs()) + linear.offset.abs());
            assert!((-slack..=1.0 + slack).contains(&depth), "{point} at {depth}");
            assert!(ahead(point) > 0.0 || !together.is_served(point), "{point}");
        }
    });
}

/// What each format resolves and needs on a lawn, in world units: at what is nearest to the light and farthest from it.
#[test]
fn figures() {
    let mut text = String::new();
    for (name, light, warp) in [
        ("sun, uniform", sun(), Warp::Uniform),
        ("sun, perspective", sun(), Warp::Perspective),
        ("lamp, uniform", lamp(), Warp::Uniform),
        ("lamp, perspective", lamp(), Warp::Perspective),
    ] {
        let map = outdoors(&light, &Settings::default().with_warp(warp));
        text += &format!(
            "{name}: steps of depth, hyperbolic and linear, 4 above the ground, on it, and far off on it\n"
        );
        let points = [DVec3::new(4.0, 4.0, -16.0), DVec3::new(4.0, 0.0, -16.0), DVec3::new(-12.0, 0.0, -30.0)];
        for format in FORMATS {
            let steps = points.map(|point| {
                let (hyperbolic, linear) =
                    (map.depth_resolution(point, format), map.linear_depth_resolution(point, format));
                format!("  {hyperbolic:.1e} {linear:.1e}")
            });
            text += &format!("{:8}{}\n", format!("{format:?}"), steps.concat());
        }
        text += "bias: constant, slope, receiver, and what it costs on the ground\n";
        for format in FORMATS {
            for reach in [0.5, 1.5] {
                let bias = map.bias(format, reach).expect("a legal reach");
                let cost = map.bias_distance(points[1], DVec3::Y, &bias);
                let DepthBias { constant, slope, receiver, .. } = bias;
                text += &format!(
                    "{:8} reach {reach}: {constant} {slope} {receiver:.1e}  {cost:.1e}\n",
                    format!("{format:?}")
                );
            }
        }
        text += "\n";
    }
    insta::assert_snapshot!(text);
}
