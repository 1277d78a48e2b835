//! A step towards a better map.

use super::chart::{Change, Chart, Drawn};
use super::moments::matrix;
use super::surfaces::{Power, Surfaces};
use crate::math::bounds::most;
use glam::{DVec4, Mat2, Vec2};

/// A damped Newton step on the error of a map.
///
/// To first order in a change (t₁, t₂, h₁, h₂) the side a of a texel across the window at s, on a surface whose lengths are measured
/// by a form with the products aa, ab, bb of steps across and down, and the change β of depth with that step, grow by
///
/// ```text
///     da/a = t · s + t₁ (s₁ aa + s₂ ab)/aa − h₂ ab/aa + δ₁
///     dβ   = β (t · s + δ₁) + t₁ (s₁ β + s₂ γ − τ) − h₂ γ
/// ```
///
/// and down likewise, with γ the change of depth down, τ the tilt of depth with w, and δ₁ and δ₂ the relative growth of the window's
/// half extents. A side of the window is a maximum over the vertices of R, softened by the power 2ᵏ. Of second order only the
/// curvature of sums of powers is kept: it is never negative, and all there is where as many points tie as there are degrees of
/// freedom.
pub(super) fn step(surfaces: &Surfaces, chart: &Chart, map: &Drawn, error: f64, aim: &Aim) -> Change {
    let [width, height] = chart.extents(map, aim.sharpness);
    let (growth, [wide, high]) = surfaces.growth(map, error, aim.power, &[width.growth, height.growth]);
    let (wide, high, power) = (wide / growth.weight, high / growth.weight, aim.power.exponent() as f32);
    let curvature = core::array::from_fn(|i| {
        growth.covariance[i] * power + width.curvature[i] * wide + height.curvature[i] * high
    });
    let mean = DVec4::from_array(growth.mean.map(f64::from));
    let step = matrix(&curvature, aim.damping).inverse() * -mean;
    // Far away the first order does not hold.
    let step = (step * (LONGEST_STEP / most(step.abs().max_element(), LONGEST_STEP))).as_vec4();
    let axes = Mat2::from_cols(Vec2::new(1.0, step.w), Vec2::new(step.z, 1.0));
    Change { axes, tilt: Vec2::new(step.x, step.y) }
}

/// What a step aims at.
#[derive(Clone, Copy, Debug)]
pub(super) struct Aim {
    /// The sharpness k of the sides of the window.
    pub(super) sharpness: u32,
    /// The power of errors.
    pub(super) power: Power,
    pub(super) damping: f64,
}

/// The longest step: w stays positive on the window.
const LONGEST_STEP: f64 = 0.4;
