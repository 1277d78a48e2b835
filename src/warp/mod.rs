//! The covector c that becomes w: how texels are spread.
//!
//! Each warp is a file with a function `propose`: from what is visible to c, in closed form, or the reason why there is none.
//! What they share is here.

pub(crate) mod light_space;
pub(crate) mod perspective;
pub(crate) mod trapezoidal;

use crate::bounds::{Interval, most};
use crate::convex::Plane;
use crate::homography::Frame;
use crate::rays::{Functional, Rays};
use crate::view::View;
use glam::{DVec2, DVec3, DVec4};

/// What a warp is proposed for, and what limits it.
pub(crate) struct Visible<'a, P> {
    /// The view that it is seen from.
    pub(crate) view: &'a View,
    /// The light.
    pub(crate) l: DVec4,
    /// The chart of the light's rays.
    pub(crate) rays: &'a Rays,
    /// The vertices of R.
    pub(crate) points: P,
    /// Their middle on the chart.
    pub(crate) middle: DVec2,
    /// The middle of their distances along the axis.
    pub(crate) along: f64,
    /// Their depths before the eye.
    pub(crate) eye_depth: Interval,
    /// What the f32 matrix takes positions relative to.
    pub(crate) origin: DVec3,
    /// The length that is too small to see.
    pub(crate) least: f64,
}

/// A warp that is valid for what it was proposed for: c > 0 on R, and within what f32 can evaluate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Proposed {
    /// c, 1 at the middle of R on the chart.
    pub(crate) warp: Functional,
    /// The part of it, there, that is the uniform map's w: how much the warp was weakened by.
    pub(crate) weakening: f64,
    /// How the window lies there.
    pub(crate) frame: Frame,
}

impl Proposed {
    /// No warp.
    pub(crate) const UNIFORM: Self = Self { warp: Functional::ONE, weakening: 1.0, frame: Frame::CHART };
}

impl<P: Iterator<Item = DVec3> + Clone> Visible<'_, P> {
    /// A function on the chart over R.
    fn range(&self, function: impl Fn(DVec2) -> f64) -> Interval {
        let mut range = Interval::EMPTY;
        self.points.clone().for_each(|point| range.include(function(self.rays.through(point).0)));
        range
    }

    /// The warp `c + κ·w`, with w that of the uniform map and κ ≥ 0 the least number for which, at every vertex of R and at
    /// its middle,
    ///
    /// - c varies, against the uniform map's w, by no more than `most_ratio`, above 1;
    /// - c is large enough against the terms that it is summed from for f32 to evaluate it, and against what it changes by
    ///   over a length too small to see: all of a scene may be smaller, down to where the slope of c would leave f32.
    ///
    /// Both conditions are linear in κ, so that c changes continuously with everything it depends on, and c > 0 on R.
    pub(crate) fn weakened(&self, covector: &Plane, most_ratio: f64) -> Proposed {
        let rays = self.rays;
        let warp = rays.functional(covector);
        let mut ratio = Interval::EMPTY;
        ratio.include(warp.at(self.middle));
        let mut for_f32 = 0.0;
        let magnitudes = |plane: &Plane| (plane.normal.abs(), plane.at(self.origin).abs());
        let (warp_terms, uniform_terms) = (magnitudes(covector), magnitudes(&rays.w));
        for point in self.points.clone() {
            let arm = (point - self.origin).abs() + self.least;
            let size = |(normal, offset): (DVec3, f64)| normal.dot(arm) + offset;
            let w = rays.w.at(point);
            let here = covector.at(point) / w;
            ratio.include(here);
            let missing = PRECISION * size(warp_terms) / w - here;
            if missing > 0.0 {
                for_f32 = most(for_f32, missing / most(1.0 - PRECISION * size(uniform_terms) / w, 0.5));
            }
        }
        let for_ratio = (ratio.max - most_ratio * ratio.min) / (most_ratio - 1.0);
        let kappa = for_ratio.max(for_f32).max(0.0);
        let warp = Functional { constant: warp.constant + kappa, ..warp };
        let scale = warp.at(self.middle).recip();
        Proposed { warp: warp.scaled(scale), weakening: kappa * scale, frame: Frame::CHART }
    }
}

impl Proposed {
    /// The same in a window whose middle line from the bottom to the top goes, when the warp bends it, through the eye as the
    /// light sees it: what the view shows to the left and to the right lies to the left and to the right of such a line, and a
    /// frustum seen from above fills the window instead of a wedge of it.
    ///
    /// With the eye at (u, v, w) on the chart, `x = w U − u` vanishes on its ray, and so does its line in the window, which at
    /// the middle m runs across `(w, 0) − (w m₁ − u) ∇c`. The less warp there is, the less it leans.
    pub(crate) fn through_eye<P>(self, visible: &Visible<'_, P>) -> Self {
        let Visible { view, rays, middle, .. } = *visible;
        let eye = rays.homogeneous(view.eye());
        let across = DVec2::X * eye.z - self.warp.slope * (eye.z * middle.x - eye.x);
        // across.y / across.x, drawn in where it grows large: then the eye lies beside the light or far to one side.
        let shear =
            across.x * across.y / across.dot(across * DVec2::new(1.0, MAX_SHEAR.recip() * MAX_SHEAR.recip()));
        let shear = if shear.is_finite() { shear } else { 0.0 };
        Self { frame: Frame { u: DVec2::new(1.0, shear).normalize(), ..self.frame }, ..self }
    }

    /// The same with x where y was.
    pub(crate) fn quarter_turned(self) -> Self {
        let Frame { u, v } = self.frame;
        Self { frame: Frame { u: v, v: -u }, ..self }
    }
}

/// Twice the slope that a window's sides may lean by.
const MAX_SHEAR: f64 = 32.0;

/// w is at least this part of the terms that it is summed from: eight f32 roundings of them are then 1/2000 of w, half
/// a texel of a 2048² map.
const PRECISION: f64 = 1.0 / 1024.0;

/// The largest ratio of w over R.
pub(crate) const MAX_RATIO: f64 = 1e6;
