//! The camera's perspective as warp: perspective shadow maps.

use super::{MAX_RATIO, NEAREST, Proposed, Visible};
use crate::convex::Plane;
use crate::math::bounds::{Interval, most};
use crate::warp::virtual_camera::after_perspective;
use glam::DVec3;

/// The perspective warp (Stamminger & Drettakis 2002, §3.2): w of a camera at the light's position λ after the view's perspective,
/// looking at the middle of the unit cube that the frustum becomes.
///
/// With the target at the origin of post-perspective space, g = −λ/|λ|, and the plane through the light across g,
/// `c = λw·A(g) − (g·λ) C₃` with A(v) = v₀ C₀ + v₁ C₁ + v₂ C₂, becomes a polynomial in λ, times |λ|:
///
/// ```text
///     c = |λxyz|² C₃ − λw (λx C₀ + λy C₁ + λz C₂)
/// ```
///
/// It is finite for every class of light: C₃, the camera's own depth, for a light that becomes directional; constant, the uniform
/// map, for a light along the view. It may vanish inside R (a light on the infinity plane stands 2n/(f − n) behind the far face of
/// the cube, with corners of the cube behind it) and is then weakened, see [`allowed_ratio`] and [`Visible::weakened`].
pub(crate) fn propose<P: Iterator<Item = DVec3> + Clone>(
    visible: &Visible<'_, P>,
    camera: &[Plane; 4],
) -> Proposed {
    let lambda = after_perspective(camera, visible.l);
    let [x, y, z, depth] = camera;
    let towards = *x * lambda.x + *y * lambda.y + *z * lambda.z;
    // Scaled to λ, so that no power of a distance grows large.
    let size = lambda.abs().max_element();
    let polar = *depth * (lambda.truncate() / size).length_squared() - towards * (lambda.w / size / size);
    visible.weakened(&polar, allowed_ratio(depth, visible))
}

/// The largest ratio of c/w over R, with w of the uniform map: that of the camera's own depth, from [`NEAREST`] of the largest on. A
/// warp undoes the camera's perspective; more only wastes texels. Under a light at an angle θ to the view, depth varies along the
/// rays too, which no warp can follow: the part of the ratio above 1 is multiplied by sin⁴ θ, so that a light along the view gets
/// none. The exponent is a choice by measurement (`cargo run --release -p testkit --bin survey`): with smaller ones more views are
/// coarser than without a warp.
fn allowed_ratio<P: Iterator<Item = DVec3> + Clone>(depth: &Plane, visible: &Visible<'_, P>) -> f64 {
    /// An orthographic view has the ratio 1 and gets the uniform map; slightly more keeps κ finite.
    const ALMOST_UNIFORM: f64 = 1.0 + 1.0 / 1024.0;
    let nearest = NEAREST * visible.points.clone().fold(0.0, |far, point| most(far, depth.at(point)));
    let (mut eye_depth, mut uniform) = (Interval::EMPTY, Interval::EMPTY);
    for point in visible.points.clone() {
        eye_depth.include(most(depth.at(point), nearest));
        uniform.include(visible.rays.w.at(point));
    }
    let depth_ratio = if eye_depth.min > 0.0 { eye_depth.max / eye_depth.min } else { f64::INFINITY };
    let sine_squared = visible.rays.axis.cross(depth.normal).length_squared();
    let depth_ratio = 1.0 + (depth_ratio - 1.0) * sine_squared * sine_squared;
    (depth_ratio * (uniform.max / uniform.min)).clamp(ALMOST_UNIFORM, MAX_RATIO)
}
