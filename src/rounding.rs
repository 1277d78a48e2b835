//! What f32 makes of a matrix: how far rounding can carry a point in clip space, and the padding that covers it.

use crate::bounds::{Interval, Rectangle, most};
use crate::convex::Plane;
use crate::homography::Homography;
use crate::rays::Rays;
use glam::{DMat4, DVec2, DVec3, DVec4};

/// Rounding of a row of an f32 matrix at a point, relative to the sum of the magnitudes of its four terms.
///
/// A clip coordinate is a sum of four products in f32: the coordinate and the entry are rounded on the way in, the
/// product once, the sum three times, so that an error is at most 6 units in the last place, 6 · 2⁻²⁴, of the sum of the
/// terms' magnitudes. Eight leave room for terms of second order and for a row that is the sum of two (depth −1 to 1).
const UNITS: f64 = 8.0 / 16_777_216.0;

/// The same in f64, for the dozen or two roundings between a point of the input and a row of the matrix.
const UNITS_F64: f64 = 32.0 * f64::EPSILON;

/// Rounding of a row of an f32 matrix over points no farther than `extent` from `origin` on each axis, which their
/// positions are relative to.
pub(crate) fn of_row(row: &Plane, origin: DVec3, extent: DVec3) -> f64 {
    UNITS * (row.normal.abs().dot(extent) + row.at(origin).abs())
}

/// The largest rounding of the rows a, b, e and c of a homography, relative to c, over what is visible and over what can
/// cast on it.
///
/// A bound over points bounds their convex hull too: the sum of magnitudes is convex and c is linear, so that their
/// ratio is largest at a vertex.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rounding {
    /// Magnitudes of the rows about the origin, as the columns of a matrix.
    magnitudes: DMat4,
    origin: DVec3,
    visible: Worst,
    casting: Worst,
    /// Whether the light is at a position, so that casters may come close to it.
    local: bool,
}

/// The largest rounding of a/c, b/c, e/c and, relative, of c over some points.
#[derive(Clone, Copy, Debug, Default)]
struct Worst {
    across: DVec2,
    depth: f64,
    w: f64,
}

impl Worst {
    fn include(&mut self, here: DVec4) {
        self.across = DVec2::new(most(self.across.x, here.x), most(self.across.y, here.y));
        self.depth = most(self.depth, here.z);
        self.w = most(self.w, here.w);
    }

    /// Rounding of depths above `least`, whose row is e − least·c.
    fn of_depth(&self, least: f64) -> f64 {
        self.depth + least.abs() * self.w
    }

    /// Rounding of positions across a window, whose rows are a and b less the centre times c.
    fn of_window(&self, window: &Rectangle) -> DVec2 {
        self.across + window.centre.abs() * self.w
    }
}

/// A caster next to a light at a position is seen from there through few bits. Such casters may ask for this part of the
/// window as padding and no more: beyond that the map is for what is visible.
const MOST_FOR_LOCAL_CASTERS: f64 = 1.0 / 1024.0;

/// A depth range is at least so many times as long as the rounding in it. All that is visible of a flat scene under a
/// light from straight above has one depth; were its range no longer than needed, there would be nothing but noise in
/// it, and every point would shadow itself. With this the noise is 16 steps of 24 bits or a 16th of a step of 16, and
/// what f32 loses of w besides, while no range grows longer than about what the coordinates are large.
pub(crate) const QUIET: f64 = 1_048_576.0;

impl Rounding {
    /// No points yet; positions are taken relative to `origin`.
    pub(crate) fn new(map: &Homography, rays: &Rays, origin: DVec3) -> Self {
        let rows = map.rows;
        let about = rows.x_axis * origin.x + rows.y_axis * origin.y + rows.z_axis * origin.z + rows.w_axis;
        let [x, y, z, w] = [rows.x_axis, rows.y_axis, rows.z_axis, about].map(|column| column.abs() * UNITS);
        // Moving a matrix to an origin far away cancels terms in f64 that f32 then knows nothing of.
        let [away_x, away_y, away_z] = (origin.abs() * UNITS_F64).to_array();
        let cancelled = rows.x_axis.abs() * away_x
            + rows.y_axis.abs() * away_y
            + rows.z_axis.abs() * away_z
            + rows.w_axis.abs() * UNITS_F64;
        let w = w + cancelled;
        let (visible, casting) = (Worst::default(), Worst::default());
        Self { magnitudes: DMat4::from_cols(x, y, z, w), origin, visible, casting, local: rays.local }
    }

    #[inline]
    fn at(&self, point: DVec3, c: f64) -> DVec4 {
        let DVec3 { x, y, z } = (point - self.origin).abs();
        let m = &self.magnitudes;
        (m.x_axis * x + m.y_axis * y + m.z_axis * z + m.w_axis) * c.recip()
    }

    /// Takes in a visible point, with c there.
    #[inline]
    pub(crate) fn include_visible(&mut self, point: DVec3, c: f64) {
        self.visible.include(self.at(point, c));
    }

    /// Takes in a point that may cast, with c there.
    #[inline]
    pub(crate) fn include_casting(&mut self, point: DVec3, c: f64) {
        self.casting.include(self.at(point, c));
    }

    /// Rounding of the depths of everything.
    pub(crate) fn of_depth(&self, least: f64) -> f64 {
        self.visible.of_depth(least).max(self.casting.of_depth(least))
    }

    /// Half extents of a window that holds `window` after rounding in the `inner` part of a map of `size` texels a
    /// side, no smaller than `least`, nor so small that a texel would be less than the rounding.
    pub(crate) fn padded_window(&self, window: &Rectangle, inner: f64, size: u32, least: f64) -> DVec2 {
        let visible = self.visible.of_window(window);
        let (mut casting, mut casting_w) = (self.casting.of_window(window), self.casting.w);
        if self.local {
            casting = casting.min(window.half * MOST_FOR_LOCAL_CASTERS);
            casting_w = casting_w.min(MOST_FOR_LOCAL_CASTERS);
        }
        let w = self.visible.w.max(casting_w).min(0.5);
        let padded = (window.half + visible.max(casting)) / ((1.0 - w) * inner);
        padded.max(visible * (0.5 * f64::from(size))).max(DVec2::splat(least))
    }

    /// A depth range that holds `depth` after rounding, no shorter than `least`, nor so short that the rounding of what
    /// is visible would be more than a millionth of it.
    pub(crate) fn padded_depth(&self, depth: &Interval, least: f64) -> Interval {
        let length = depth.max - depth.min;
        // Twice the rounding of z and of w, at either end that of what lies there; casters next to a light may at most
        // double the range.
        let pad = |worst: &Worst| 2.0 * (worst.of_depth(depth.min) + length * worst.w);
        let far = pad(&self.visible);
        let near = far.max(pad(&self.casting).min(length));
        let shortest = least.max(QUIET * self.visible.of_depth(depth.min));
        let missing = 0.5 * (shortest - (length + near + far)).max(0.0);
        Interval { min: depth.min - near - missing, max: depth.max + far + missing }
    }

    /// Rounding of the depth of what is visible in a depth range, relative to its length.
    pub(crate) fn in_depth(&self, depth: &Interval) -> f64 {
        (self.visible.of_depth(depth.min) / (depth.max - depth.min) + self.visible.w) / self.left_of_w()
    }

    /// Rounding of the place of what is visible in a window, in texels of a map of `size` texels a side, read by texture
    /// coordinates, whose rows are half the sum of w's and another.
    pub(crate) fn in_window(&self, window: &Rectangle, size: u32) -> f64 {
        // w counts once in the row, and twice in the division: |x/w| ≤ 1 there, texture coordinates are half as large.
        // Where f32 loses half of w or more, a point is anywhere.
        let left = self.left_of_w();
        let across = (self.visible.of_window(window) / window.half).max_element() + 3.0 * (1.0 - left);
        0.5 * f64::from(size) * across / left
    }

    /// What rounding leaves of w where something is visible, as a part; half of it where it may leave less.
    fn left_of_w(&self) -> f64 {
        1.0 - self.visible.w.min(0.5)
    }
}
