//! The trapezoidal warp: TSM.

use super::{MAX_RATIO, Proposed, Visible};
use crate::input::view::Lens;
use crate::settings::fallback::WarpFallback;
use crate::warp::rays::Functional;
use glam::DVec3;

/// The trapezoidal warp (Martin & Tan 2004): the part of the trapezoid around R next to the viewer, up to a focus, takes four fifths
/// of the map.
///
/// The axis of the trapezoid is the centre line: the view's central ray as the light sees it, from the eye on. Top and base are where
/// R begins and ends along that line, a length λ apart; the focus is a distance δ' from the top. The map along the line that takes
/// the top to 1, the base to −1 and the focus to ξ = 1 − 2·4/5 = −0.6 has its centre a distance η in front of the top:
///
/// ```text
///     y(t) = (η − t (1 + 2η/λ)) / (t + η)      t the distance from the top
///     y(δ') = ξ:   η = (λδ' + λδ'ξ) / (λ − 2δ' − λξ)      c = t + η
/// ```
///
/// As δ' grows to four fifths of λ, η grows to infinity and c fades to the uniform map. As the light turns into the view it does not
/// fade: the centre line shrinks to a point with R on all sides, and its direction jumps, and the warp with it. It may also jump
/// where a local light passes the focus and all of R lies beside the central ray.
///
/// The paper fits the sides of the trapezoid as well; here the window is fitted to R anyway, sheared along the centre line.
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
    // The line from eye to focus on the chart, without division by the eye's w, as the eye may be behind the light.
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

/// The focus, which the paper leaves to the user: on the central ray, at this part of the depths of R. On outdoor views the median
/// worst aliasing is about least with it (`cargo run --release -p testkit --bin survey`): 0.096, 0.210 and 0.307 of the uniform
/// map's for suns, point lights and spots, against 0.096, 0.200 and 0.366 with 1/8 and 0.150, 0.267 and 0.366 with 1/3.
const FOCUS: f64 = 1.0 / 5.0;

/// The least distance of the focus from the top, in lengths: with R beside the central ray the focus may lie in front of R.
const LEAST_FOCUS: f64 = FOCUS / 4.0;

/// The least sine of the angle at the eye between the light and the central ray, a millionth: below it the line's direction is
/// rounding.
const LEAST_SINE: f64 = 1.0 / 1_048_576.0;

/// The place of the focus in the map, from 1 at the top to −1 at the base: the 80 % rule.
const XI: f64 = -0.6;
