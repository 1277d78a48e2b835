//! The map that a search found, before it was mixed with the uniform one for what it is worth at surfaces.
//!
//! [`ShadowMap::weakening`] says how much of w, in the middle of the uniform map's window, is the uniform map's. Taken off again, w is
//! what was found; the window is what the vertices of R make of it.

use super::exhaustive::nearest;
use glam::{DMat2, DVec2, DVec3, DVec4};
use shadowfit::{Focus, ShadowMap, Warp};

/// The rows x, y and w of a map.
fn rows(map: &ShadowMap) -> [DVec4; 3] {
    let matrix = map.clip_from_world();
    [0, 1, 3].map(|row| matrix.row(row))
}

/// The parts of w that are the uniform map's, where a map is mixed with it and something is left of what was found.
const PARTS: [f64; 5] = [0.0, 1.0 / 9.0, 1.0 / 5.0, 1.0 / 3.0, 1.0 / 2.0];

/// The worst side of a texel, in pixels, over points: of what the search found; `None` where nothing is left of it or f32 needs
/// more of the uniform map besides.
pub(super) fn of_search(focus: &Focus<'_>, map: &ShadowMap, points: &[DVec3]) -> Option<f64> {
    if !is_served(focus) {
        return None;
    }
    let part = map.weakening();
    let uniform = focus.fit(&map.settings().with_warp(Warp::Uniform)).into_map()?;
    // Other parts are what f32 needs, which was there when the map was compared.
    if !PARTS.iter().any(|mixed| (part - mixed).abs() < 1e-9) {
        return None;
    }
    let [x, y, w] = rows(map);
    let [_, _, of_uniform] = rows(&uniform);
    // A point on the ray in the middle of its window.
    let middle = uniform.clip_from_world().inverse() * DVec4::new(0.0, 0.0, 0.5, 1.0);
    let uniform_w = of_uniform * (w.dot(middle) / of_uniform.dot(middle));
    // x and y have the mixed w in them, which moves the window.
    let [x, y] = [x, y].map(|row| row - w * (row.dot(middle) / w.dot(middle)));
    Some(worst(focus, map, points, [x, y, w - uniform_w * part]))
}

/// Whether a map answers for all vertices of R: a light in a corner of what is visible has no place in its own map, and what is
/// nearer than its near distance is cut off before the fit.
fn is_served(focus: &Focus<'_>) -> bool {
    let near = focus.light().near();
    let is_served =
        |point: &DVec3| focus.light().position().is_none_or(|position| position.distance(*point) >= near);
    focus.receiver_volume().vertices().iter().all(is_served)
}

/// The same of a map as it is.
pub(super) fn of_form(focus: &Focus<'_>, map: &ShadowMap, points: &[DVec3]) -> f64 {
    worst(focus, map, points, rows(map))
}

/// The same of a homography, in the window that it makes of the vertices of R.
fn worst(focus: &Focus<'_>, map: &ShadowMap, points: &[DVec3], [x, y, w]: [DVec4; 3]) -> f64 {
    let place = |point: DVec3| {
        let at = point.extend(1.0);
        DVec2::new(x.dot(at), y.dot(at)) / w.dot(at)
    };
    let visible = focus.receiver_volume();
    let places = || visible.vertices().iter().copied().map(place);
    let (min, max) =
        places().fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(min, max), place| (min.min(place), max.max(place)));
    let (width, height) = map.settings().map_sides();
    let texel = (max - min) / DVec2::new(width.into(), height.into());
    let view = focus.view();
    let nearest = nearest(view, points);
    let side = |&point: &DVec3| {
        let (one, other) = focus.light().direction_from(point).any_orthonormal_pair();
        let at = place(point);
        let gradient = |row: DVec4, at: f64| (row.truncate() - w.truncate() * at) / w.dot(point.extend(1.0));
        let (gx, gy) = (gradient(x, at.x), gradient(y, at.y));
        let steps =
            DMat2::from_cols(DVec2::new(gx.dot(one), gy.dot(one)), DVec2::new(gx.dot(other), gy.dot(other)));
        let footprint = steps.inverse() * DMat2::from_diagonal(texel);
        let (a, b) = (footprint.x_axis, footprint.y_axis);
        let (sum, product) = (a.length_squared() + b.length_squared(), footprint.determinant());
        let longest = (0.5 * (sum + (sum * sum - 4.0 * product * product).max(0.0).sqrt())).sqrt();
        let pixel =
            2.0 * view.half_height(view.depth(point).max(nearest)) / f64::from(map.settings().image_height());
        longest / pixel
    };
    points.iter().map(side).fold(0.0, f64::max)
}
