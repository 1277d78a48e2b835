//! A card in software: what a map and a bias make of a plane that is drawn into it and tested against it.

use std::f64::consts::TAU;

use glam::{DMat4, DVec2, DVec3, DVec4, Mat4, Vec4Swizzles};
use proptest::prelude::*;
use shadowfit::{
    ClipSpace, DepthFormat, Light, ShadowMap,
    depth::DepthBias,
    input::{DepthRange, TextureOrigin, YAxis},
};

use super::FORMATS;
use testkit::arbitrary::{Numbers, sides};

/// What f32 makes of a row, relative to the sum of its terms' magnitudes.
pub(crate) const UNITS: f64 = 8.0 / 16_777_216.0;

/// A map on a card: places in texels, counted as its texture coordinates are, and depths as stored.
pub(crate) struct Card<'a> {
    map: &'a ShadowMap,
    /// What positions are relative to.
    pub(crate) origin: DVec3,
    /// World to texture space, exact.
    exact: DMat4,
    /// Texels across and down.
    sides: DVec2,
    reversed: bool,
}

impl<'a> Card<'a> {
    pub(crate) fn new(map: &'a ShadowMap) -> Self {
        let origin = map.origin();
        let sides = sides(map.settings());
        let reversed = map.settings().clip().depth.is_reversed();
        Self { map, origin, exact: map.texture_from_world(), sides, reversed }
    }

    /// Where a point falls, in texels, and its depth; exact.
    pub(crate) fn place(&self, point: DVec3) -> DVec3 {
        self.exact.project_point3(point) * self.sides.extend(1.0)
    }

    /// The same in f32, by a matrix from positions to texture space.
    pub(crate) fn place_in_f32(&self, texture: &Mat4, point: DVec3) -> DVec3 {
        let at = *texture * (point - self.origin).as_vec3().extend(1.0);
        (at.xyz() / at.w).as_dvec3() * self.sides.extend(1.0)
    }

    /// The same of a caster's corner, by way of clip space, as a driver takes it to the grid of a 256th of a texel, up or
    /// down as `up` says.
    fn corner(&self, point: DVec3, up: [bool; 2]) -> DVec3 {
        let clip = self.map.settings().clip();
        let at = self.map.caster_matrix() * (point - self.origin).as_vec3().extend(1.0);
        let at = at.xyz() / at.w;
        let v_up = clip.y == YAxis::Down || clip.texture_origin == TextureOrigin::BottomLeft;
        let (x, y) = (0.5 + 0.5 * at.x, if v_up { 0.5 + 0.5 * at.y } else { 0.5 - 0.5 * at.y });
        let z = match clip.depth {
            DepthRange::ZeroToOne | DepthRange::ZeroToOneReversed => at.z,
            DepthRange::NegativeOneToOne | DepthRange::NegativeOneToOneReversed => 0.5 + 0.5 * at.z,
        };
        let snapped = |place: f32, side: f64, up: bool| {
            let grid = f64::from(place) * side * 256.0;
            (if up { grid.ceil() } else { grid.floor() }) / 256.0
        };
        DVec3::new(snapped(x, self.sides.x, up[0]), snapped(y, self.sides.y, up[1]), z.into())
    }

    /// The point on the plane through `point` across `normal` that falls on a place.
    fn on_plane(&self, point: DVec3, normal: DVec3, place: DVec2) -> Option<DVec3> {
        let rows = self.exact.transpose();
        let column = rows.x_axis - rows.w_axis * (place.x / self.sides.x);
        let row = rows.y_axis - rows.w_axis * (place.y / self.sides.y);
        let (x, y) = (column.xyz(), row.xyz());
        let volume = x.dot(y.cross(normal));
        let off = DVec2::new(column.dot(point.extend(1.0)), row.dot(point.extend(1.0)));
        let found = point - (y.cross(normal) * off.x + normal.cross(x) * off.y) / volume;
        (found.is_finite() && rows.w_axis.dot(found.extend(1.0)) > 0.0).then_some(found)
    }

    /// Whether f32 moves a point by no more than the map says of what is visible, and across by no more than `places`.
    fn is_quiet(&self, point: DVec3, places: f64) -> bool {
        let rows = self.map.clip_from_world_in(ClipSpace::WGPU).transpose();
        let w = rows.w_axis.dot(point.extend(1.0));
        let of = |row: DVec4| {
            let terms = row.xyz().abs().dot((point - self.origin).abs()) + row.dot(self.origin.extend(1.0)).abs();
            UNITS * terms / w
        };
        let [x, y, z, w_rounding] = [rows.x_axis, rows.y_axis, rows.z_axis, rows.w_axis].map(of);
        let left = 1.0 - w_rounding;
        let across = (0.5 * self.sides * (DVec2::new(x, y) + 3.0 * w_rounding)).max_element() / left;
        let depth = (z + w_rounding) / left;
        w > 0.0 && w_rounding < 0.5 && across <= places && depth <= self.map.depth_rounding(point)
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
pub(crate) enum Round {
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
pub(crate) struct Drawing {
    pub(crate) format: DepthFormat,
    pub(crate) reach: f64,
    round: Round,
    /// How much the plane leans out of the light: the tangent of the angle.
    pub(crate) lean: f64,
    /// Which way.
    turn: f64,
    /// How high the triangle is, in what a bias answers for, and which way it points.
    height: f64,
    points: f64,
}

pub(crate) fn drawing() -> impl Strategy<Value = Drawing> {
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
pub(crate) fn margin(
    card: &Card<'_>,
    light: &Light,
    point: DVec3,
    bias: &DepthBias,
    how: &Drawing,
    seed: u64,
) -> Option<f64> {
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
    let inside = how.reach - bias.places * numbers.part() - 1e-3 * numbers.part();
    let receiver = card.on_plane(at_middle, normal, middle + deeper * inside)?;
    let texture = map.receiver_matrix_with(&bias.offset());
    let read = card.place_in_f32(&texture, receiver);
    let is_read = (read.truncate() - middle).abs().max_element() <= how.reach;
    if !is_read || !card.is_quiet(receiver, bias.places) {
        return None;
    }

    // A triangle around the middle of the texel.
    let least_height = 1_f64.max(8.0 * (1.0 / 256.0 + bias.places));
    let radius = how.height * least_height / 1.5;
    let corners = [0.0, 1.0, 2.0].map(|third| DVec2::from_angle(how.points + third * TAU / 3.0) * radius);
    let weights = [(); 3].map(|()| numbers.part() + 1e-3);
    let total: f64 = weights.iter().sum();
    let inner: DVec2 = corners.iter().zip(weights).map(|(corner, weight)| corner * (weight / total)).sum();
    let (mut drawn, mut noisiest) = ([DVec3::ZERO; 3], 1_f64);
    for (drawn, corner) in drawn.iter_mut().zip(corners) {
        let corner = card.on_plane(at_middle, normal, middle + corner - inner)?;
        if !card.is_quiet(corner, bias.places) {
            return None;
        }
        noisiest = noisiest.max(map.depth_rounding(corner) / map.depth_rounding(receiver));
        *drawn = card.corner(corner, [numbers.part() < 0.5, numbers.part() < 0.5]);
    }
    let triangle = Triangle { corners: drawn };
    if triangle.least_height() < least_height * noisiest {
        return None;
    }

    // The least that a card may add: its smallest unit, the larger of the slopes.
    let (depth, gradient) = triangle.depth(middle);
    let unit = *bias.format.bias_unit(depth.clamp(0.0, 1.0)).start();
    let added = f64::from(bias.constant) * unit + f64::from(bias.slope_scale) * gradient.abs().max_element();
    let stored = quantised(bias.format, depth + added, how.round, card.reversed);
    let compared = read.z.clamp(0.0, 1.0);
    let compared = match how.round {
        Round::TowardsLight => compared,
        Round::Nearest => quantised(bias.format, compared, how.round, card.reversed),
    };
    Some(sign * (stored - compared))
}
