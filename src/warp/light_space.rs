//! The light-space perspective warp: LiSPSM.

use super::{MAX_RATIO, NEAREST, Proposed, Visible};
use crate::input::view::Lens;
use crate::settings::fallback::WarpFallback;
use glam::{DVec2, DVec3};

/// The light-space perspective warp (Wimmer, Scherzer & Purgathofer 2004): a perspective across the light, along the view as the
/// light sees it, with its centre a distance n in front of R.
///
/// In the paper, with γ the angle between light and view, z_n the near distance and d the length of R along the warp,
///
/// ```text
///     n_opt = (z_n + √(z_n z_f)) / sin γ      z_f = z_n + d sin γ
/// ```
///
/// Along the warp, eye depth on a plane across the light grows by sin γ per unit. In terms of that depth h the sine cancels, and
/// with it the pole: with R between h₀ and h₁,
///
/// ```text
///     c = h − h₀ + z_n + √(z_n (z_n + h₁ − h₀))
/// ```
///
/// A local light is directional after its own perspective, as in the paper, with h taken on the plane through the middle of R: one
/// formula serves every class. As the light turns into the view h becomes constant, and c fades to the uniform map.
///
/// z_n is the least eye depth of R, not the near plane's, and at least [`NEAREST`] of the largest: air in front of the receivers
/// deserves no texels.
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
    // Rounding may put a point of R just in front of the near plane.
    let near = visible.eye_depth.min.max(view.near()).max(NEAREST * visible.eye_depth.max);
    // The square root of a vector is available without the standard library.
    let geometric_mean = DVec2::splat(near * (near + depth.max - depth.min)).sqrt().x;
    c.constant += near + geometric_mean - depth.min;
    Ok(visible.weakened(&rays.covector(&c), MAX_RATIO).through_eye(visible))
}
