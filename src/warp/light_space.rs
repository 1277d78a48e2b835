//! The light-space perspective: LiSPSM.

use super::{MAX_RATIO, NEAREST, Proposed, Visible};
use crate::input::view::Lens;
use crate::settings::fallback::WarpFallback;
use glam::{DVec2, DVec3};

/// The light-space perspective warp (Wimmer, Scherzer & Purgathofer 2004): a perspective across the light, along the view as
/// the light sees it, whose centre is a distance n before all that is visible.
///
/// Theirs is, with γ the angle between light and view, z_n the near distance and d the length of what is visible along the
/// warp,
///
/// ```text
///     n_opt = (z_n + √(z_n z_f)) / sin γ      z_f = z_n + d sin γ
/// ```
///
/// LinearDepth the warp, eye depth on a plane across the light grows by sin γ for each unit. Measured by that depth, h, no
/// sine is left, and no pole: with R between h₀ and h₁,
///
/// ```text
///     c = h − h₀ + z_n + √(z_n (z_n + h₁ − h₀))
/// ```
///
/// A light at a position is directional after its own perspective, as in their paper, and h is read off the plane through
/// the middle of R: one formula holds for every class. As the light turns into the view h becomes constant, and c fades
/// to the uniform map by itself.
///
/// z_n is the least eye depth of R, not that of the near plane: what lies before all that is visible is worth no texel. Nor is it
/// less than [`NEAREST`] of the largest: what lies there most often is air.
///
/// # Errors
///
/// [`WarpFallback::NoPerspective`].
pub(crate) fn propose<P: Iterator<Item = DVec3> + Clone>(
    visible: &Visible<'_, P>,
) -> Result<Proposed, WarpFallback> {
    let (view, rays) = (visible.view, visible.rays);
    if view.lens() == Lens::Orthographic {
        return Err(WarpFallback::NoPerspective);
    }
    let mut c = rays.depth_across(view, visible.along);
    let depth = visible.range(|ray| c.at(ray));
    // Rounding may leave a point of R just before the near plane.
    let near = visible.eye_depth.min.max(view.near()).max(NEAREST * visible.eye_depth.max);
    // A vector's square root is there without the standard library too.
    let geometric_mean = DVec2::splat(near * (near + depth.max - depth.min)).sqrt().x;
    c.constant += near + geometric_mean - depth.min;
    Ok(visible.weakened(&rays.covector(&c), MAX_RATIO).through_eye(visible))
}
