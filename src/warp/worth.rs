//! The score of a warp at sampled receivers: its texels and its bias against the uniform map's.

use super::in_window;
use crate::convex::Plane;
use crate::focus::Focus;
use crate::math::bounds::{Rectangle, least, most};
use crate::warp::rays::{Functional, Rays};
use glam::DVec2;

/// Sample points of R that stand for its receivers.
///
/// The vertices of R are a poor sample: half of them lie on the near plane, in the air, where a warp is finest. Receivers lie along
/// the lines of sight, most often towards their ends. A few of these are clipped to R, with samples at the end, at half and at a
/// quarter of the way.
pub(crate) struct Samples {
    samples: [Sample; Self::ACROSS * Self::DOWN * Self::DEPTHS.len()],
    len: usize,
    /// The width and height of the map in texels.
    sides: DVec2,
    local: bool,
}

/// A sample point on a ray of the light.
#[derive(Clone, Copy)]
struct Sample {
    /// The ray's place on the chart.
    ray: DVec2,
    /// World units per unit step on the chart.
    size: f64,
    /// The tilt of depth with w, see [`Samples::cost`].
    tilt: f64,
    /// The cost of the uniform map.
    uniform: f64,
    /// The weight: it fades as the line of sight leaves R.
    weight: f64,
}

/// The weight of a texel's change of depth against its sides: 0.3 of the bias, which is 2.25 times that change with the sampler's
/// 2 × 2 texels. Of the predictors of pixel error that were tried, the mean side of a texel plus 0.3 of the bias correlates best. The
/// slope of the surface is assumed to be 45°.
const BIAS: f64 = 0.3 * 2.25;

impl Samples {
    const ACROSS: usize = 3;
    const DOWN: usize = 2;
    const DEPTHS: [f64; 3] = [1.0, 0.5, 0.25];

    /// Samples of R for maps of `sides` texels; the uniform map has the given window and zero depth at the distance `along`.
    pub(crate) fn new(focus: &Focus<'_>, rays: &Rays, window: &Rectangle, along: f64, sides: DVec2) -> Self {
        let none = Sample { ray: DVec2::ZERO, size: 0.0, tilt: 0.0, uniform: 0.0, weight: 0.0 };
        let mut all = Self {
            samples: [none; Self::ACROSS * Self::DOWN * Self::DEPTHS.len()],
            len: 0,
            sides,
            local: rays.local,
        };
        let view = focus.view();
        let rows = in_window([Functional::U, Functional::V, Functional::ONE], window);
        for i in 0..Self::ACROSS * Self::DOWN {
            let place = DVec2::new(
                ((i % Self::ACROSS) as f64 + 0.5) / Self::ACROSS as f64,
                ((i / Self::ACROSS) as f64 + 0.5) / Self::DOWN as f64,
            );
            let (from, step) = view.ray(place);
            let (mut near, mut far) = (view.near(), view.far());
            let mut cut = |plane: Plane| {
                let (at, change) = (plane.at(from), plane.normal.dot(step));
                // Without change the line of sight is inside at all depths or at none.
                let depth = -at / change;
                if change > 0.0 {
                    near = most(near, depth);
                } else if change < 0.0 {
                    far = least(far, depth);
                } else if at < 0.0 {
                    far = near;
                }
            };
            focus.for_each_plane(&mut cut);
            [view.near_cut, view.far_cut].into_iter().flatten().for_each(cut);
            for part in Self::DEPTHS {
                let depth = near + (far - near) * part;
                let weight = (far - near) / (far.abs() + near.abs());
                if !(weight > 0.0 && depth.is_finite()) {
                    continue;
                }
                let point = from + step * depth;
                let (ray, w) = rays.through(point);
                let beside = rays.along.at(point);
                let tilt = if rays.local { w * (w / along - 1.0) } else { beside - along };
                let size = if rays.local { w } else { 1.0 };
                let mut sample = Sample { ray, size, tilt, uniform: 0.0, weight };
                let uniform = all.cost(&sample, &rows);
                if uniform > 0.0 && uniform.is_finite() {
                    sample.uniform = uniform;
                    all.samples[all.len] = sample;
                    all.len += 1;
                }
            }
        }
        all
    }

    /// The cost at a point of a map with these rows on the chart and its window at −1 to 1: the mean side of a texel plus the bias, in
    /// world units; infinite where w ≤ 0.
    ///
    /// A step t of a texel on the chart changes depth along a ray by the slope of the surface times its length and, where w varies,
    /// by `tilt · (∇w · t)/w`. The tilt is the distance from zero depth under a directional light and w (w/zero − 1) under a local one.
    fn cost(&self, sample: &Sample, [x, y, w]: &[Functional; 3]) -> f64 {
        let Sample { ray, size, tilt, .. } = *sample;
        let at = w.at(ray);
        let gradient = |row: &Functional| (row.slope - w.slope * (row.at(ray) / at)) / at;
        let (gx, gy) = (gradient(x), gradient(y));
        let texel = 2.0 / self.sides / gx.perp_dot(gy);
        let steps = [DVec2::new(gy.y, -gy.x) * texel.x, DVec2::new(-gx.y, gx.x) * texel.y];
        let shorter = if self.local { 1.0 / (1.0 + ray.length_squared()) } else { 0.0 };
        let mut cost = 0.0;
        for step in steps {
            let along = ray.dot(step);
            let side = size * DVec2::new(step.length_squared() - along * along * shorter, 0.0).sqrt().x;
            cost += 0.5 * side * (1.0 + BIAS) + 0.5 * BIAS * (tilt * w.slope.dot(step) / at).abs();
        }
        if at > 0.0 && cost >= 0.0 { cost } else { f64::INFINITY }
    }

    /// The score of a map with these rows on the chart and its window at −1 to 1: the mean of (r − 1)/(r + 1), with r the ratio of its
    /// cost to the uniform map's. It lies in [−1, 1], negative for better maps, and weighs halves and doubles alike.
    pub(crate) fn score(&self, rows: &[Functional; 3]) -> f64 {
        let (mut sum, mut weights) = (0.0, 0.0);
        for sample in &self.samples[..self.len] {
            let times = least(self.cost(sample, rows) / sample.uniform, 1e12);
            sum += sample.weight * (times - 1.0) / (times + 1.0);
            weights += sample.weight;
        }
        if weights > 0.0 { sum / weights } else { 0.0 }
    }
}
