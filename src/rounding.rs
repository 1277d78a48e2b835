//! What f32 makes of a matrix: how far rounding can carry a point in clip space, and the padding that covers it.

use crate::bounds::{Interval, Rectangle, most};
use crate::homography::Homography;
use glam::{DMat4, DVec2, DVec3, DVec4};

/// Rounding of a row of an f32 matrix at a point, relative to the sum of the magnitudes of its four terms.
///
/// A clip coordinate is a sum of four products in f32: the coordinate and the entry are rounded on the way in, the
/// product once, the sum three times, so that an error is at most 6 units in the last place, 6 · 2⁻²⁴, of the sum of the
/// terms' magnitudes. Eight leave room for terms of second order and for a row that is the sum of two (depth −1 to 1).
const UNITS: f64 = 8.0 / 16_777_216.0;

/// The largest rounding of the rows a, b, e and c of a homography over points, relative to c there.
///
/// It bounds that over the points' convex hull too: the sum of magnitudes is convex and c is linear, so that their
/// ratio is largest at a vertex.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rounding {
    /// Magnitudes of the rows about the origin, as the columns of a matrix.
    magnitudes: DMat4,
    origin: DVec3,
    /// Largest rounding of a/c, b/c, e/c and, relative, of c.
    worst: DVec4,
}

impl Rounding {
    /// No points yet; positions are taken relative to `origin`.
    pub(crate) fn new(map: &Homography, origin: DVec3) -> Self {
        let rows = map.rows;
        let about = rows.x_axis * origin.x + rows.y_axis * origin.y + rows.z_axis * origin.z + rows.w_axis;
        let columns = [rows.x_axis, rows.y_axis, rows.z_axis, about].map(|column| column.abs() * UNITS);
        let [x, y, z, w] = columns;
        Self { magnitudes: DMat4::from_cols(x, y, z, w), origin, worst: DVec4::ZERO }
    }

    /// Takes in a point, with c there.
    #[inline]
    pub(crate) fn include(&mut self, point: DVec3, c: f64) {
        let DVec3 { x, y, z } = (point - self.origin).abs();
        let m = &self.magnitudes;
        let here = (m.x_axis * x + m.y_axis * y + m.z_axis * z + m.w_axis) * c.recip();
        let worst = &mut self.worst;
        *worst = DVec4::new(
            most(worst.x, here.x),
            most(worst.y, here.y),
            most(worst.z, here.z),
            most(worst.w, here.w),
        );
    }

    /// Relative rounding of w, as far as it makes sense to think of it as small.
    fn of_w(&self) -> f64 {
        self.worst.w.min(0.5)
    }

    /// Half extents of a window that holds `window` after rounding in the `inner` part of a map of `size` texels a
    /// side, no smaller than `least`, nor so small that a texel would be less than the rounding.
    pub(crate) fn padded_window(&self, window: &Rectangle, inner: f64, size: u32, least: f64) -> DVec2 {
        // The row is a − centre·c.
        let rounding = self.worst.truncate().truncate() + window.centre.abs() * self.worst.w;
        let padded = (window.half + rounding) / ((1.0 - self.of_w()) * inner);
        padded.max(rounding * (0.5 * f64::from(size))).max(DVec2::splat(least))
    }

    /// A depth range that holds `depth` after rounding, no shorter than `least`, nor so short that the rounding would
    /// be more than a thousandth of it.
    pub(crate) fn padded_depth(&self, depth: &Interval, least: f64) -> Interval {
        // The row is e − min·c, and w less that.
        let rounding = self.worst.z + depth.min.abs() * self.worst.w;
        let length = depth.max - depth.min;
        let pad = 2.0 * (rounding + length * self.of_w());
        let half = (0.5 * length + pad).max(512.0 * rounding).max(0.5 * least);
        Interval { min: depth.middle() - half, max: depth.middle() + half }
    }
}
