//! The covector c that becomes w: how texels are spread.

use crate::bounds::{Interval, most};
use crate::convex::Plane;
use crate::perspective::after_perspective;
use crate::rays::{Functional, Rays};
use glam::{DVec2, DVec3, DVec4};

/// What a warp is proposed for, and what limits it.
pub(crate) struct Visible<'a, P> {
    /// The chart of the light's rays.
    pub(crate) rays: &'a Rays,
    /// The vertices of R.
    pub(crate) points: P,
    /// Their middle on the chart.
    pub(crate) middle: DVec2,
    /// What the f32 matrix takes positions relative to.
    pub(crate) origin: DVec3,
    /// The length that is too small to see.
    pub(crate) least: f64,
}

/// The perspective warp: w as the light's own camera has it, which stands at λ and looks at the middle of the unit cube
/// that the camera's perspective makes of its frustum (Stamminger & Drettakis 2002, §3.2).
///
/// With the target at the origin of post-perspective space, g = −λ/|λ|, and the plane through the light of DESIGN
/// section 2, `c = λw·A(g) − (g·λ) C₃`, becomes a polynomial in λ, times |λ|:
///
/// ```text
///     c = |λxyz|² C₃ − λw (λx C₀ + λy C₁ + λz C₂)
/// ```
///
/// It is finite for every class of light. It is C₃, the camera's own depth, for a light that becomes directional, and
/// constant, the uniform map, for a light along the view. But it may vanish inside R: a light on the infinity plane
/// stands 2n/(f − n) behind the far face of the cube, and corners of the cube lie behind it. Then it is weakened, see
/// [`weakened`].
pub(crate) fn perspective<P: Iterator<Item = DVec3> + Clone>(
    camera: &[Plane; 4],
    l: DVec4,
    visible: &Visible<'_, P>,
) -> (Functional, f64) {
    let lambda = after_perspective(camera, l);
    let [x, y, z, depth] = camera;
    let towards = *x * lambda.x + *y * lambda.y + *z * lambda.z;
    // Scaled to λ, so that no power of a distance grows large.
    let size = lambda.abs().max_element();
    let polar = *depth * (lambda.truncate() / size).length_squared() - towards * (lambda.w / size / size);
    weakened(&polar, depth, visible)
}

/// The warp `c + κ·w`, with w that of the uniform map and κ ≥ 0 the least number for which, at every vertex of R and at
/// its middle,
///
/// - c varies, against the uniform map's w, by no more than the camera's own depth does: a warp is there to undo the
///   camera's perspective, and more than that only wastes texels. Where the light makes an angle θ with the view, depth
///   varies along its rays as well, which no warp can follow, and the part above 1 is multiplied by sin⁴ θ: a light at
///   right angles may use it all, a light along the view none. The exponent is a choice by measure (`cargo run
///   --release --example survey`): with smaller ones more views are worse off than without a warp;
/// - c is large enough against the terms that it is summed from for f32 to evaluate it, and against what it changes by over a
///   length too small to see: all of a scene may be smaller, down to where the slope of c would leave f32.
///
/// Both conditions are linear in κ, so that c changes continuously with everything it depends on, and c > 0 on R.
fn weakened<P: Iterator<Item = DVec3> + Clone>(
    covector: &Plane,
    depth: &Plane,
    visible: &Visible<'_, P>,
) -> (Functional, f64) {
    let rays = visible.rays;
    let warp = rays.functional(covector);
    let mut ratio = Interval::EMPTY;
    ratio.include(warp.at(visible.middle));
    let (mut eye_depth, mut uniform) = (Interval::EMPTY, Interval::EMPTY);
    let mut for_f32 = 0.0;
    let magnitudes = |plane: &Plane| (plane.normal.abs(), plane.at(visible.origin).abs());
    let (warp_terms, uniform_terms) = (magnitudes(covector), magnitudes(&rays.w));
    for point in visible.points.clone() {
        let arm = (point - visible.origin).abs() + visible.least;
        let size = |(normal, offset): (DVec3, f64)| normal.dot(arm) + offset;
        let w = rays.w.at(point);
        let here = covector.at(point) / w;
        ratio.include(here);
        eye_depth.include(depth.at(point));
        uniform.include(w);
        let missing = PRECISION * size(warp_terms) / w - here;
        if missing > 0.0 {
            for_f32 = most(for_f32, missing / most(1.0 - PRECISION * size(uniform_terms) / w, 0.5));
        }
    }
    // A view without perspective has ratio 1 and is left with the uniform map; the least above 1 keeps κ finite.
    const ALMOST_UNIFORM: f64 = 1.0 + 1.0 / 1024.0;
    let depth_ratio = if eye_depth.min > 0.0 { eye_depth.max / eye_depth.min } else { f64::INFINITY };
    let sine_squared = rays.axis.cross(depth.normal).length_squared();
    let depth_ratio = 1.0 + (depth_ratio - 1.0) * sine_squared * sine_squared;
    let allowed = (depth_ratio * (uniform.max / uniform.min)).clamp(ALMOST_UNIFORM, MAX_RATIO);
    let for_ratio = (ratio.max - allowed * ratio.min) / (allowed - 1.0);
    let kappa = for_ratio.max(for_f32).max(0.0);
    let warp = Functional { constant: warp.constant + kappa, ..warp };
    let scale = warp.at(visible.middle).recip();
    (warp.scaled(scale), kappa * scale)
}

/// w is at least this part of the terms that it is summed from: eight f32 roundings of them are then 1/2000 of w, half
/// a texel of a 2048² map.
const PRECISION: f64 = 1.0 / 1024.0;

/// The largest ratio of w over R.
const MAX_RATIO: f64 = 1e6;
