//! Points on surfaces, and the error of a map there.
//!
//! The search runs in f32, four points at a time; all that is uploaded is computed in f64 from its result.

use super::chart::{Chart, Drawn};
use super::lanes::{greater, raised, total};
use super::moments::{Moments, Spread, totals};
use super::projection::{Projection, Values};
use crate::focus::Focus;
use crate::input::view::Image;
use crate::settings::{Objective, Settings};
use crate::warp::rays::Rays;
use glam::Vec4;

/// Vectors of four points.
const VECTORS: usize = Focus::MAX_SURFACES / 4;

/// Four points. Steps are those on the chart, and lengths in pixels.
#[derive(Clone, Copy)]
struct Four {
    /// Their rays on the chart.
    u: Vec4,
    v: Vec4,
    /// The squared length in the image of a step along the surface: a quadratic form.
    xx: Vec4,
    xy: Vec4,
    yy: Vec4,
    /// The change of depth with a step along the surface, times the weight of a bias.
    depth_u: Vec4,
    depth_v: Vec4,
    /// The change of depth with that of the logarithm of w, likewise.
    tilt: Vec4,
    /// The factor of sides, which holds the bias where the surface is not known.
    side: Vec4,
    /// How many pixels they stand for.
    pixels: Vec4,
}

/// Points on surfaces.
pub(super) struct Surfaces {
    fours: [Four; VECTORS],
    /// The number of points.
    len: usize,
    /// The size of a texel in a window from −1 to 1.
    texel: [f32; 2],
    objective: Objective,
}

/// The steps and errors of a map at four points.
struct Errors {
    places: [Vec4; 2],
    /// The forms xx, xy and yy for steps across the window.
    forms: [Vec4; 3],
    /// The sides of a texel, times [`Four::side`].
    sides: [Vec4; 2],
    /// The changes of depth with a step across the window.
    depths: [Vec4; 2],
    /// The error for steps across and for steps down.
    parts: [Vec4; 2],
}

impl Surfaces {
    /// The surfaces in view on a chart, for maps with zero depth at the distance `zero` along the axis.
    pub(super) fn new(focus: &Focus<'_>, rays: &Rays, chart: &Chart, zero: f64, settings: &Settings) -> Self {
        let mut all = Self::none(settings);
        let projection = Projection { image: Image::new(focus.view(), settings.image_height()), rays, chart, zero };
        focus.for_each_surface(|point| {
            if let Some(values) = projection.of(&point) {
                all.push(&values);
            }
        });
        all
    }

    /// Adds a point, if there is room.
    pub(super) fn push(&mut self, values: &Values) {
        if self.len == Focus::MAX_SURFACES {
            return;
        }
        let Four { u, v, xx, xy, yy, depth_u, depth_v, tilt, side, pixels } = &mut self.fours[self.len / 4];
        let lane = self.len % 4;
        for (slot, value) in [u, v, xx, xy, yy, depth_u, depth_v, tilt, side, pixels].into_iter().zip(values) {
            slot[lane] = *value;
        }
        self.len += 1;
    }

    /// No surfaces, for maps of these settings.
    pub(super) fn none(settings: &Settings) -> Self {
        let none = Four {
            u: Vec4::ZERO,
            v: Vec4::ZERO,
            xx: Vec4::ONE,
            xy: Vec4::ZERO,
            yy: Vec4::ONE,
            depth_u: Vec4::ZERO,
            depth_v: Vec4::ZERO,
            tilt: Vec4::ZERO,
            // Lanes past the last point have an error like any other, and weigh nothing.
            side: Vec4::ONE,
            pixels: Vec4::ZERO,
        };
        let texel = (2.0 / settings.sides()).as_vec2();
        Self { fours: [none; VECTORS], len: 0, texel: texel.to_array(), objective: settings.objective() }
    }

    /// The pixels that all points stand for.
    pub(super) fn pixels(&self) -> f64 {
        total(self.fours().iter().fold(Vec4::ZERO, |sum, four| sum + four.pixels))
    }

    fn fours(&self) -> &[Four] {
        &self.fours[..self.len.div_ceil(4)]
    }

    /// The error of a map: NaN or infinite where it is no map.
    pub(super) fn error(&self, map: &Drawn) -> f64 {
        match self.objective {
            Objective::Mean => {
                let (mut sum, mut pixels) = (Vec4::ZERO, Vec4::ZERO);
                for four in self.fours() {
                    let [across, down] = self.errors(map, four).parts;
                    let error = across + down;
                    sum += error * four.pixels;
                    pixels += four.pixels;
                }
                total(sum) / total(pixels)
            }
            Objective::Worst => {
                let mut worst = Vec4::ZERO;
                for four in self.fours() {
                    let [across, down] = self.errors(map, four).parts;
                    worst = greater(worst, (across + down) * sign(four.pixels - Vec4::splat(f32::MIN_POSITIVE)));
                }
                f64::from(worst.max_element())
            }
        }
    }

    /// The gain of a map over another: the relative decrease of the sum of powers of errors.
    pub(super) fn gain(&self, next: (&Drawn, f64), here: (&Drawn, f64), power: Power) -> f64 {
        match self.objective {
            Objective::Mean => 1.0 - next.1 / here.1,
            Objective::Worst => 1.0 - self.powers(next.0, here.1, power) / self.powers(here.0, here.1, power),
        }
    }

    /// The sum of powers of errors relative to `unit`.
    fn powers(&self, map: &Drawn, unit: f64, power: Power) -> f64 {
        let unit = Vec4::splat((1.0 / unit) as f32);
        let mut sum = Vec4::ZERO;
        for four in self.fours() {
            let [across, down] = self.errors(map, four).parts;
            sum += power.of((across + down) * unit) * four.pixels;
        }
        total(sum)
    }

    /// Moments of the relative growth of errors with a change of the map, and the mean weights of steps across and down.
    pub(super) fn growth(&self, map: &Drawn, unit: f64, power: Power, sides: &[[f32; 4]; 2]) -> (Spread, [f32; 2]) {
        let unit = Vec4::splat((1.0 / unit) as f32);
        let [wide, high] = sides.map(|growth| growth.map(Vec4::splat));
        let [texel_x, texel_y] = self.texel.map(Vec4::splat);
        let mut moments = Moments::NONE;
        let mut parts = [Vec4::ZERO; 2];
        for four in self.fours() {
            let Errors { places: [x, y], forms: [xx, xy, yy], sides, depths: [across, down], parts: [ex, ey] } =
                self.errors(map, four);
            let error = ex + ey;
            let inverse = error.recip();
            let weight = power.of(error * unit) * four.pixels;
            let (side_x, side_y) = (sides[0] / xx, sides[1] / yy);
            let (sign_x, sign_y) = (sign(across) * texel_x, sign(down) * texel_y);
            let moved = x * across + y * down - four.tilt;
            let tilt_x = error * x + side_x * (x * xx + y * xy) + sign_x * moved;
            let tilt_y = error * y + side_y * (x * xy + y * yy) + sign_y * moved;
            let lean_x = -(side_y * xy + sign_y * across);
            let lean_y = -(side_x * xy + sign_x * down);
            let of = |own: Vec4, axis: usize| (own + ex * wide[axis] + ey * high[axis]) * inverse;
            moments.include(weight, [of(tilt_x, 0), of(tilt_y, 1), of(lean_x, 2), of(lean_y, 3)]);
            parts[0] += weight * ex * inverse;
            parts[1] += weight * ey * inverse;
        }
        let [across, down, ..] = totals([parts[0], parts[1], Vec4::ZERO, Vec4::ZERO]);
        (moments.spread(), [across, down])
    }

    /// The errors at four points.
    #[inline(always)]
    fn errors(&self, map: &Drawn, four: &Four) -> Errors {
        let [x, y, w] = &map.rows;
        let at = |row: &glam::Vec3| four.u * row.x + four.v * row.y + row.z;
        let inverse = at(w).recip();
        let (px, py) = (at(x) * inverse, at(y) * inverse);
        // A step across the window, on the chart: the inverse of the place's derivative, whose determinant is that of all rows
        // over w³.
        let scale = (inverse * inverse * map.determinant).recip();
        let across = [(py * -w.y + y.y) * scale, (py * w.x - y.x) * scale];
        let down = [(px * w.y - x.y) * scale, (px * -w.x + x.x) * scale];
        let form = |a: &[Vec4; 2], b: &[Vec4; 2]| {
            four.xx * a[0] * b[0] + four.xy * (a[0] * b[1] + a[1] * b[0]) + four.yy * a[1] * b[1]
        };
        let (xx, xy, yy) = (form(&across, &across), form(&across, &down), form(&down, &down));
        // Sums of squares, but for rounding.
        let least = Vec4::splat(f32::MIN_POSITIVE);
        let (xx, yy) = (greater(xx, least), greater(yy, least));
        let depth = |step: &[Vec4; 2]| {
            four.depth_u * step[0] + four.depth_v * step[1] - four.tilt * inverse * (step[0] * w.x + step[1] * w.y)
        };
        let depths = [depth(&across), depth(&down)];
        let half = four.side * 0.5;
        let sides = [root(xx) * half * self.texel[0], root(yy) * half * self.texel[1]];
        let parts = [sides[0] + depths[0].abs() * self.texel[0], sides[1] + depths[1].abs() * self.texel[1]];
        Errors { places: [px, py], forms: [xx, xy, yy], sides, depths, parts }
    }
}

/// The power that errors are raised to.
#[derive(Clone, Copy, Debug)]
pub(super) struct Power(u32);

impl Power {
    /// That of an objective, with the sharpness k of a soft maximum.
    pub(super) const fn new(objective: Objective, sharpness: u32) -> Self {
        match objective {
            Objective::Mean => Self(0),
            Objective::Worst => Self(sharpness),
        }
    }

    fn of(self, value: Vec4) -> Vec4 {
        raised(value, self.0)
    }

    pub(super) fn exponent(self) -> f64 {
        f64::from(1_u32 << self.0)
    }
}

fn sign(value: Vec4) -> Vec4 {
    Vec4::select(value.cmpge(Vec4::ZERO), Vec4::ONE, Vec4::NEG_ONE)
}

fn root(value: Vec4) -> Vec4 {
    value.sqrt()
}
