//! Warps: the choice of the covector c that becomes w and distributes the texels.
//!
//! [`Warp`](crate::Warp) is at the root of the crate; this module has the class of a light, [`classify`], and the virtual camera,
//! [`VirtualCamera`]. `docs/warps.md` compares the warps, `docs/design.md` derives them.
// Each warp is a file with a function `propose`: from the receivers to c in closed form, or to the reason of a fallback. Code that
// they share is here.

pub(crate) mod homography;
pub(crate) mod light_space;
pub(crate) mod psm;
pub(crate) mod rays;
pub(crate) mod rounding;
pub(crate) mod search;
pub(crate) mod stable;
pub(crate) mod trapezoidal;
pub(crate) mod virtual_camera;

use crate::convex::Plane;
use crate::input::view::View;
use crate::math::bounds::{Interval, most};
pub use crate::settings::{Objective, Shift};
use crate::warp::homography::Frame;
use crate::warp::rays::{Functional, Rays};
use crate::warp::rounding::{AWAY_FROM_LIGHT, UNITS};
pub use crate::warp::virtual_camera::{ClassKind, LightClass, NearCase, VirtualCamera, classify};
use glam::{DVec2, DVec3, DVec4};

/// The receivers that a warp is proposed for, and its limits.
pub(crate) struct Visible<'a, P> {
    /// The view.
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
    /// The origin of positions that the f32 matrix takes.
    pub(crate) origin: DVec3,
    /// The length that is too small to see.
    pub(crate) least: f64,
    /// The least w that f32 needs.
    pub(crate) precision: Precision,
}

/// A valid warp: c > 0 on R, and large enough for f32.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Proposed {
    /// c, 1 at the middle of R on the chart.
    pub(crate) warp: Functional,
    /// The part of c there that is the uniform map's w: how much the warp was weakened.
    pub(crate) weakening: f64,
    /// The axes of the window there.
    pub(crate) frame: Frame,
}

impl Proposed {
    /// No warp.
    pub(crate) const UNIFORM: Self = Self { warp: Functional::ONE, weakening: 1.0, frame: Frame::CHART };
}

impl<P: Iterator<Item = DVec3> + Clone> Visible<'_, P> {
    /// The range of a function on the chart over R.
    fn range(&self, function: impl Fn(DVec2) -> f64) -> Interval {
        let mut range = Interval::EMPTY;
        self.points.clone().for_each(|point| range.include(function(self.rays.through(point).0)));
        range
    }

    /// The warp `c + κ·w`, with w of the uniform map and the least κ ≥ 0 for which, at every vertex of R and at its middle,
    ///
    /// - c/w varies by no more than the factor `most_ratio` > 1;
    /// - c is large enough for f32, against the terms that it is summed from and against its change over a length too small to see
    ///   (a scene may be so small that the slope of c would leave f32).
    ///
    /// Both conditions are linear in κ, so that the result is continuous in all inputs, and c > 0 on R.
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
            let part =
                |terms| size(terms) * most(self.precision.part / most(w, self.precision.away), LEAST_PRECISION / w);
            let missing = part(warp_terms) - here;
            if missing > 0.0 {
                for_f32 = most(for_f32, missing / most(1.0 - part(uniform_terms), 0.5));
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
    /// The same warp in a window sheared so that its vertical middle line passes through the eye as the light sees it. That line
    /// separates the left and right halves of the view, so that a frustum seen from above fills the window, not a wedge of it.
    ///
    /// With the eye at (u, v, w) on the chart, `x = w U − u` vanishes on its ray. The line through it has at the middle m the normal
    /// `(w, 0) − (w m₁ − u) ∇c`: the weaker the warp, the less it leans.
    pub(crate) fn through_eye<P>(self, visible: &Visible<'_, P>) -> Self {
        let Visible { view, rays, middle, .. } = *visible;
        let eye = rays.homogeneous(view.eye());
        let across = DVec2::X * eye.z - self.warp.slope * (eye.z * middle.x - eye.x);
        // across.y / across.x, limited where it grows large: then the eye lies beside the light or far to one side.
        let shear =
            across.x * across.y / across.dot(across * DVec2::new(1.0, MAX_SHEAR.recip() * MAX_SHEAR.recip()));
        let shear = if shear.is_finite() { shear } else { 0.0 };
        Self { frame: Frame { u: DVec2::new(1.0, shear).normalize(), ..self.frame }, ..self }
    }

    /// The same warp with the window turned by 90°.
    pub(crate) fn quarter_turned(self) -> Self {
        let Frame { u, v } = self.frame;
        Self { frame: Frame { u: v, v: -u }, ..self }
    }
}

/// Twice the largest slope of a window's sides.
const MAX_SHEAR: f64 = 32.0;

/// Points of R nearer to the eye than this part of the farthest depth count as if they stood there.
///
/// A near plane is most often in the air. A search for the least worst texel over R would draw texels there and, with near planes
/// of a thousandth, leave none for any receiver.
pub(crate) const NEAREST: f64 = 1.0 / 256.0;

/// The least w that f32 needs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Precision {
    /// The least ratio of w to the sum of its terms, against the uniform map's w.
    part: f64,
    /// The uniform map's w from which `part` applies; closer to a local light [`LEAST_PRECISION`] does.
    away: f64,
}

impl Precision {
    /// The larger the f32 noise of the uniform map, in texels, the less room there is for a warp.
    ///
    /// Rounding of w moves places in a warped map by a fraction that grows as w shrinks against its terms, and its depth range grows
    /// with the variation of w. Texels smaller than the noise of the uniform map are worth nothing. Six times that noise is a choice
    /// by measurement (`cargo test --test numerics precision::`). Close to a local light, where noise is hundreds of times larger
    /// than on its receivers, it is not counted.
    pub(crate) fn new(
        rays: &Rays,
        points: impl Iterator<Item = DVec3>,
        origin: DVec3,
        along: &Interval,
        sides: DVec2,
    ) -> Self {
        let away = if rays.local { AWAY_FROM_LIGHT * along.max } else { 1.0 };
        let offset = DVec2::new(rays.u.at(origin), rays.v.at(origin)).length();
        let (mut reach, mut noise) = (0.0, 0.0);
        for point in points {
            let (ray, w) = rays.through(point);
            reach = most(reach, ray.length());
            noise = most(noise, UNITS * ((point - origin).abs().element_sum() + offset) / most(w, away));
        }
        let texel = 2.0 * reach / sides.min_element();
        // A window without extent has no warp.
        let is_large = TIMES_NOISE * noise < MOST_PRECISION * texel;
        Self {
            part: if is_large { most(TIMES_NOISE * noise / texel, LEAST_PRECISION) } else { MOST_PRECISION },
            away,
        }
    }
}

/// The least w, in multiples of the noise of the uniform map in texels.
const TIMES_NOISE: f64 = 6.0;

/// The least ratio of w to its terms in the most precise maps.
const LEAST_PRECISION: f64 = 1.0 / 1024.0;

/// The least ratio of w to its terms in the least precise maps; it leaves next to no warp.
const MOST_PRECISION: f64 = 0.5;

/// The largest ratio of w over R.
pub(crate) const MAX_RATIO: f64 = 1e6;
