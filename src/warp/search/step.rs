//! A step towards a better map.

use super::draft::{Change, Draft, Point};
use crate::math::bounds::most;
use core::ops::Mul;
use glam::{DMat2, DMat4, DVec2, DVec4};

/// The sharpness k of a soft maximum: aliasing is raised to the power 2ᵏ, and the root of the sum over all points tends to the
/// maximum as k → ∞.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Sharpness(pub(super) u32);

impl Sharpness {
    pub(super) const fn next(self) -> Self {
        Self(self.0 + 1)
    }

    fn power(self) -> f64 {
        (1_u64 << self.0) as f64
    }

    /// The weight of a squared aliasing, relative to the worst.
    fn weight(self, squared: f64) -> f64 {
        raised(squared, self.0 - 1)
    }

    /// The weights of points for the sides of the window, from places in [0, 1], 1 at the side.
    fn weights_at_sides(self, places: DVec4) -> DVec4 {
        raised(places, self.0 + 1)
    }

    /// The gain of a draft over another: the relative decrease of the sum of 2ᵏ-th powers.
    pub(super) fn gain(self, next: &Draft, draft: &Draft) -> f64 {
        let sum =
            |of: &Draft| of.points().iter().map(|point| self.weight(point.longest / draft.worst)).sum::<f64>();
        1.0 - sum(next) / sum(draft)
    }
}

/// Smaller weights count as zero.
const LEAST_WEIGHT: f64 = 1e-6;

/// value^(2^k).
fn raised<T: Copy + Mul<Output = T>>(mut value: T, k: u32) -> T {
    for _ in 0..k {
        value = value * value;
    }
    value
}

/// A weighted mean and covariance.
#[derive(Clone, Copy)]
struct Moments {
    weight: f64,
    first: DVec4,
    second: DMat4,
}

impl Moments {
    const NONE: Self = Self { weight: 0.0, first: DVec4::ZERO, second: DMat4::ZERO };

    #[inline]
    fn include(&mut self, weight: f64, value: impl FnOnce() -> DVec4) {
        if weight < LEAST_WEIGHT {
            return;
        }
        let value = value();
        let weighted = value * weight;
        self.weight += weight;
        self.first += weighted;
        self.second += outer(weighted, value);
    }

    fn mean(&self) -> DVec4 {
        self.first / self.weight
    }

    fn covariance(&self) -> DMat4 {
        let mean = self.mean();
        self.second * self.weight.recip() - outer(mean, mean)
    }
}

fn outer(a: DVec4, b: DVec4) -> DMat4 {
    DMat4::from_cols(a * b.x, a * b.y, a * b.z, a * b.w)
}

/// A damped Newton step on the soft maximum of aliasing.
///
/// To first order in a change (t₁, t₂, h₁, h₂) the logarithm of the longest step at s, with the unit eigenvector v, grows by
///
/// ```text
///     t · s + (v · s)(v · t) − (h₁ + h₂) v₁ v₂ + v₁² δ₁ + v₂² δ₂
/// ```
///
/// in a square map. In a map r times as wide as high v counts texels, and the window has r times as many across as down. The formula
/// holds with s, t and h in coordinates where texels are square, and in those of the window becomes
///
/// ```text
///     t · s + t₁ (v₁² s₁ + v₁ v₂ s₂/r) + t₂ (v₁ v₂ s₁ r + v₂² s₂) − (h₁ r + h₂/r) v₁ v₂ + v₁² δ₁ + v₂² δ₂
/// ```
///
/// with δ₁ and δ₂ the relative growth of the window's half extents: half of the outward moves of its sides, where a point at a side
/// moves by `H s − (t · s) s`. A side is a maximum over points as well, and is softened likewise. Of second order only the curvature
/// of the soft maxima is kept: it is never negative, and all there is where as many points tie as there are degrees of freedom.
pub(super) fn step(draft: &Draft, sharpness: Sharpness, damping: f64) -> Change {
    let (points, shape) = (draft.points(), draft.shape);
    let [width, height] = extents(points, sharpness);

    let mut growth = Moments::NONE;
    let (mut wide, mut high) = (0.0, 0.0);
    for Point { place: s, stretch, longest, difference } in points {
        let weight = sharpness.weight(longest / draft.worst);
        if weight < LEAST_WEIGHT {
            continue;
        }
        // v₁², v₁ v₂ and v₂² of the eigenvector. Where all steps have one length any vector is one, and this is their mean.
        let (difference, of_texels) = (most(*difference, f64::MIN_POSITIVE), stretch.of_texels(shape));
        let leaning = 0.25 * (of_texels.xx - of_texels.yy) / difference;
        let (xx, xy, yy) = (0.5 + leaning, 0.5 * of_texels.xy / difference, 0.5 - leaning);
        let (xy_across, xy_down) = (xy * shape, xy / shape);
        let along = *s + DVec2::new(xx * s.x + xy_down * s.y, xy_across * s.x + yy * s.y);
        growth
            .include(weight, || along.extend(-xy_across).extend(-xy_down) + width.growth * xx + height.growth * yy);
        wide += weight * xx;
        high += weight * yy;
    }
    let curvature = growth.covariance() * sharpness.power()
        + width.curvature * (wide / growth.weight)
        + height.curvature * (high / growth.weight)
        + DMat4::IDENTITY * damping;
    let step = curvature.inverse() * -growth.mean();
    // Far away the first order does not hold.
    let step = step * (LONGEST_STEP / most(step.abs().max_element(), LONGEST_STEP));
    let axes = DMat2::from_cols(DVec2::new(1.0, step.w), DVec2::new(step.z, 1.0));
    Change { axes, tilt: DVec2::new(step.x, step.y) }
}

/// The longest step: w stays positive on the window.
const LONGEST_STEP: f64 = 0.4;

/// The growth of a half extent of the window with a change.
struct Extent {
    growth: DVec4,
    curvature: DMat4,
}

impl Extent {
    /// From the outward moves of two sides.
    fn between(sides: &[Moments; 2], sharpness: Sharpness) -> Self {
        let [one, other] = sides;
        Self {
            growth: (one.mean() + other.mean()) * 0.5,
            curvature: (one.covariance() + other.covariance()) * (0.5 * sharpness.power()),
        }
    }
}

/// The horizontal and the vertical extent.
fn extents(points: &[Point], sharpness: Sharpness) -> [Extent; 2] {
    let [mut right, mut left, mut top, mut bottom] = [Moments::NONE; 4];
    for Point { place: s, .. } in points {
        let places = (DVec4::new(s.x, -s.x, s.y, -s.y) + 1.0) * 0.5;
        let weights = sharpness.weights_at_sides(places);
        let across = || DVec4::new(-s.x * s.x, -s.x * s.y, s.y, 0.0);
        let upwards = || DVec4::new(-s.x * s.y, -s.y * s.y, 0.0, s.x);
        right.include(weights.x, across);
        left.include(weights.y, || -across());
        top.include(weights.z, upwards);
        bottom.include(weights.w, || -upwards());
    }
    [[right, left], [top, bottom]].map(|sides| Extent::between(&sides, sharpness))
}
