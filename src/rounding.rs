//! What f32 makes of a matrix: how far rounding can carry a point in clip space, and the padding that covers it.

use crate::bounds::{Interval, Rectangle};
use crate::convex::Plane;
use crate::homography::Homography;
use glam::{DVec2, DVec3};

/// Rounding of one row of an f32 matrix at a point, relative to w there.
///
/// A clip coordinate is a sum of four products in f32: the coordinate and the entry are rounded on the way in, the
/// product once, the sum three times, so that an error is at most 6 units in the last place, 6 · 2⁻²⁴, of the sum of the
/// terms' magnitudes. Eight leave room for terms of second order and for a row that is the sum of two (depth −1 to 1).
const UNITS: f64 = 8.0 / 16_777_216.0;

/// The largest rounding over a set of points, in the units of the homography: of u, of v, of w (relative) and of depth.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rounding {
    pub(crate) window: DVec2,
    pub(crate) w: f64,
    pub(crate) depth: f64,
}

impl Rounding {
    /// The bound over points, and with them over their convex hull: the sum of magnitudes is convex and w is linear,
    /// so that their ratio is largest at a vertex.
    pub(crate) fn over(
        points: impl Iterator<Item = DVec3>,
        map: &Homography,
        window: &Rectangle,
        depth: &Interval,
        origin: DVec3,
    ) -> Self {
        let about = |row: Plane| Plane::new(row.normal, row.at(origin));
        let x = about(map.a - map.c * window.centre.x);
        let y = about(map.b - map.c * window.centre.y);
        let (z, w) = (about(map.e - map.c * depth.min), about(map.c));
        let none = Self { window: DVec2::ZERO, w: 0.0, depth: 0.0 };
        points.fold(none, |most, point| {
            let arm = (point - origin).abs();
            let terms = |row: &Plane| row.normal.abs().dot(arm) + row.offset.abs();
            let unit = UNITS / map.c_at(point);
            Self {
                window: most.window.max(DVec2::new(terms(&x), terms(&y)) * unit),
                w: most.w.max(terms(&w) * unit),
                depth: most.depth.max(terms(&z) * unit),
            }
        })
    }

    /// Half extents of a window that holds `half` after rounding in the `inner` part of a map of `size` texels a side,
    /// no smaller than `least`, nor so small that a texel would be less than the rounding.
    pub(crate) fn padded_window(&self, half: DVec2, inner: f64, size: u32, least: f64) -> DVec2 {
        let padded = (half + self.window) / ((1.0 - self.w.min(0.5)) * inner);
        padded.max(self.window * (0.5 * f64::from(size))).max(DVec2::splat(least))
    }

    /// A depth range that holds `depth` after rounding, no shorter than `least`, nor so short that the rounding would
    /// be more than a thousandth of it.
    pub(crate) fn padded_depth(&self, depth: &Interval, least: f64) -> Interval {
        let length = depth.max - depth.min;
        let pad = 2.0 * (self.depth + length * self.w.min(0.5));
        let half = (0.5 * length + pad).max(512.0 * self.depth).max(0.5 * least);
        Interval { min: depth.middle() - half, max: depth.middle() + half }
    }
}
