//! The trapezoidal map: TSM.

use super::{MAX_RATIO, Proposed, Visible};
use crate::input::view::Lens;
use crate::settings::fallback::WarpFallback;
use crate::warp::rays::Functional;
use glam::DVec3;

/// The trapezoidal warp (Martin & Tan 2004): of the trapezoid around what is visible, the part that lies next to the viewer,
/// up to a focus, is to take four fifths of the map.
///
/// Its axis is the centre line: the view's central ray as the light sees it, from the eye on. Its top and its base are where R
/// begins and ends along that line, a length λ apart. The focus is at a distance δ' from the top. The map along the line that
/// takes the top to 1, the base to −1 and the focus to ξ = 1 − 2·4/5 = −0.6 has its centre a distance η before the top:
///
/// ```text
///     y(t) = (η − t (1 + 2η/λ)) / (t + η)      t the distance from the top
///     y(δ') = ξ:   η = (λδ' + λδ'ξ) / (λ − 2δ' − λξ)      c = t + η
/// ```
///
/// As δ' grows to four fifths of λ, η grows to infinity and c fades to the uniform map by itself. It does not as the light
/// turns into the view: the centre line shrinks to a point, and what is visible spreads from there to all sides, of which the
/// line still takes one. Which one jumps there, and the warp with it. It may also jump where a lamp passes the focus and leaves
/// it behind, while all that is visible lies beside the central ray.
///
/// The sides of the paper's trapezoid lie to both sides of the centre line, and so do the window's; the trapezoid is not
/// drawn in further, because the window is made to fit anyway.
///
/// # Errors
///
/// [`WarpFallback::NoPerspective`], [`WarpFallback::AlongView`], [`WarpFallback::FocusBehindLight`], [`WarpFallback::FocusLarge`].
pub(crate) fn propose<P: Iterator<Item = DVec3> + Clone>(
    visible: &Visible<'_, P>,
) -> Result<Proposed, WarpFallback> {
    let (view, rays) = (visible.view, visible.rays);
    if view.lens() == Lens::Orthographic {
        return Err(WarpFallback::NoPerspective);
    }
    let depths = visible.eye_depth;
    let (eye, focus) = (view.eye(), view.centre_at(depths.min + FOCUS * (depths.max - depths.min)));
    let (from, to) = (rays.homogeneous(eye), rays.homogeneous(focus));
    if to.z <= 0.0 {
        return Err(WarpFallback::FocusBehindLight);
    }
    // The way from one to the other on the chart, without a division by where the eye is, which may be behind the light.
    let line = to.truncate() * from.z - from.truncate() * to.z;
    let to_light = if rays.local { from.length() } else { 1.0 };
    if line.length() <= LEAST_SINE * to_light * eye.distance(focus) {
        return Err(WarpFallback::AlongView);
    }
    let direction = line.normalize();
    let along = visible.range(|ray| direction.dot(ray));
    let length = along.max - along.min;
    let at_focus = direction.dot(to.truncate() / to.z) - along.min;
    let at_focus = at_focus.max(LEAST_FOCUS * length);
    let rest = length * (1.0 - XI) - 2.0 * at_focus;
    if rest <= 0.0 {
        return Err(WarpFallback::FocusLarge);
    }
    let eta = length * at_focus * (1.0 + XI) / rest;
    let c = Functional { slope: direction, constant: eta - along.min };
    Ok(visible.weakened(&rays.covector(&c), MAX_RATIO).through_eye(visible))
}

/// Where the focus is, which is the user's to choose in the paper: on the central ray, at this part of the depths of what is
/// visible. On outdoor views the medians of the worst aliasing are about least with it (`cargo run --release -p testkit --bin survey`):
/// 0.096, 0.210 and 0.307 of the uniform map's for suns, lamps and spots, where 1/8 has 0.096, 0.200 and 0.366 and 1/3 has
/// 0.150, 0.267 and 0.366.
const FOCUS: f64 = 1.0 / 5.0;

/// The least distance of the focus from the top, in lengths: what is visible may all be beside the central ray, and the
/// focus before it.
const LEAST_FOCUS: f64 = FOCUS / 4.0;

/// The least sine of the angle, at the eye, between the light and the central ray: a millionth. Where it is less, roundings
/// turn the line.
const LEAST_SINE: f64 = 1.0 / 1_048_576.0;

/// Where the focus is in the map, from 1 at the top to −1 at the base: the 80 % rule.
const XI: f64 = -0.6;
