//! Balls and discs at random, and what can be off in where they fall.

use glam::{DVec2, DVec3, DVec4};
use shadowfit::{
    Light, Scene, Settings, ShadowMap, View,
    depth::Splat,
    fit,
    input::{TextureOrigin, YAxis},
};
use testkit::arbitrary::{Case, Numbers, Together, points_of, sides};

/// A disc or, with a normal of zero, a ball.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Round {
    pub(crate) centre: DVec3,
    pub(crate) normal: DVec3,
    pub(crate) radius: f64,
}

impl Round {
    /// About a point, small or large for the scene that it stands in.
    pub(crate) fn about(point: DVec3, size: f64, numbers: &mut Numbers) -> Self {
        let is_ball = numbers.part() < 0.3;
        let normal = if is_ball { DVec3::ZERO } else { direction(numbers) };
        Self { centre: point, normal, radius: size * 10_f64.powf(1.0 - 7.0 * numbers.part()) }
    }

    pub(crate) fn splat(&self, map: &ShadowMap) -> Option<Splat> {
        match self.normal == DVec3::ZERO {
            true => map.splat(self.centre, self.radius),
            false => map.disc_splat(self.centre, self.normal, self.radius),
        }
    }

    /// The part of a vector that counts: in the disc's plane.
    pub(crate) fn within(&self, v: DVec3) -> DVec3 {
        v - self.normal * self.normal.dot(v)
    }

    /// The point that is farthest along a direction.
    pub(crate) fn farthest(&self, direction: DVec3) -> DVec3 {
        self.centre + self.within(direction).normalize_or_zero() * self.radius
    }
}

pub(crate) fn direction(numbers: &mut Numbers) -> DVec3 {
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
pub(crate) struct Rows {
    pub(crate) x: DVec4,
    pub(crate) y: DVec4,
    pub(crate) w: DVec4,
    /// What the positions are relative to where they are rounded.
    pub(crate) origin: DVec3,
    /// How large coordinates are that rows were made of.
    pub(crate) reach: DVec3,
    /// Roundings of one row, relative to the sum of the magnitudes of its terms.
    pub(crate) roundings: f64,
}

impl Rows {
    /// In f64: some dozen roundings, as in all properties of maps.
    pub(crate) fn new(map: &ShadowMap, together: &Together, case: &Case) -> Self {
        let (min, max) = case.scene.bounds();
        let l = together.light.homogeneous();
        let reach = DVec3::from(min).abs().max(DVec3::from(max).abs())
            + together.view.eye().abs()
            + l.truncate().abs() * l.w;
        Self::of(map, DVec3::ZERO, reach, 64.0 * f64::EPSILON)
    }

    pub(crate) fn of(map: &ShadowMap, origin: DVec3, reach: DVec3, roundings: f64) -> Self {
        let rows = map.texture_from_world().transpose();
        let sides = sides(map.settings());
        Self { x: rows.x_axis * sides.x, y: rows.y_axis * sides.y, w: rows.w_axis, origin, reach, roundings }
    }

    pub(crate) fn place(&self, point: DVec3) -> DVec2 {
        let point = point.extend(1.0);
        DVec2::new(self.x.dot(point), self.y.dot(point)) / self.w.dot(point)
    }

    /// How far rounding can carry the value of a row over a ball or disc.
    pub(crate) fn slack_of(&self, row: DVec4, round: &Round) -> f64 {
        let farthest = (round.centre - self.origin).abs() + DVec3::splat(round.radius) + self.reach;
        let offset = row.dot(self.origin.extend(1.0));
        self.roundings * (row.truncate().abs().dot(farthest) + offset.abs()) + f64::MIN_POSITIVE
    }

    /// The least w over a ball or disc.
    pub(crate) fn least_w(&self, round: &Round) -> f64 {
        self.w.dot(round.farthest(-self.w.truncate()).extend(1.0))
    }

    /// How far rounding can carry the bounds of a ball or disc: `None` where it may carry them anywhere.
    ///
    /// A bound t is where the value of a − t·c vanishes. That value is off by what a and c are off by, and it changes
    /// with t by no less than the least c. The length of the bounds is also divided by 1 − |ρ c/c·P|², which is off by
    /// what c is off by over the least c, relative to itself.
    pub(crate) fn slack(&self, round: &Round, splat: &Splat) -> Option<DVec2> {
        let of_w = self.slack_of(self.w, round);
        let least = self.least_w(round) - of_w;
        let farthest = splat.centre.abs() + 2.0 * splat.half;
        let slack = DVec2::new(self.slack_of(self.x, round), self.slack_of(self.y, round)) + farthest * of_w;
        (least > of_w).then(|| slack / least)
    }
}

/// Whatever there is to see and one size of the scene, from a case.
pub(crate) fn rounds(together: &Together, case: &Case, seed: u64) -> Vec<Round> {
    let (min, max) = case.scene.bounds();
    let size = (DVec3::from(max) - DVec3::from(min)).length().max(f64::MIN_POSITIVE);
    let mut numbers = Numbers(!seed);
    let points = points_of(&together.focus().receiver_volume(), seed);
    points.into_iter().map(|point| Round::about(point, size, &mut numbers)).collect()
}

pub(crate) const TO_SUN: DVec3 = DVec3::new(0.3, 1.0, 0.2);

pub(crate) fn landscape(settings: &Settings) -> ShadowMap {
    let view =
        View::perspective((0.0, 2.0, 12.0), (0.0, -0.2, -1.0), DVec3::Y, 1.0, 1.6, 0.5, 100.0).expect("sound");
    let scene = Scene::from_box((-20.0, -1.0, -20.0), (20.0, 4.0, 20.0)).expect("sound");
    let sun = Light::directional(TO_SUN).expect("sound");
    fit(&view, &sun, &scene, settings).into_map().expect("one map does")
}

/// Texels of a clip position in the map's own convention.
pub(crate) fn texels(map: &ShadowMap, [x, y, _]: [f32; 3]) -> DVec2 {
    let clip = map.settings().clip();
    let from_top = (clip.y, clip.texture_origin) == (YAxis::Up, TextureOrigin::TopLeft);
    let v = if from_top { 0.5 - 0.5 * f64::from(y) } else { 0.5 + 0.5 * f64::from(y) };
    DVec2::new(0.5 + 0.5 * f64::from(x), v) * sides(map.settings())
}
