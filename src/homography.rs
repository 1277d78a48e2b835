//! The map from rays to the window, before the window is moved into the clip volume.

use crate::bounds::{Interval, Rectangle, most};
use crate::convex::{Plane, matrix_from_rows};
use crate::rays::{Functional, Rays};
use glam::{DMat4, DVec2, DVec3, DVec4};

/// Three covectors that vanish at the light, and a depth row that does not (DESIGN section 2):
///
/// ```text
///     u = a·X / c·X      v = b·X / c·X      z = e·X / c·X
/// ```
///
/// a and b vanish on the ray through the middle of what is visible and c is the uniform map's w there, so that u and v
/// are isometric across that ray. e·l < 0 and c > 0 on everything visible: z grows away from the light in every class.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Homography {
    a: Plane,
    b: Plane,
    c: Plane,
    e: Plane,
    /// The rows a, b, e, c of a matrix.
    pub(crate) rows: DMat4,
    /// The middle of what is visible, on the chart.
    middle: DVec2,
    /// c as a function on the chart.
    warp: Functional,
}

impl Homography {
    /// The homography with w = `warp`, 1 at `middle`, and zero depth at distance `along` along the axis.
    pub(crate) fn new(rays: &Rays, middle: DVec2, warp: Functional, along: f64) -> Self {
        let a = rays.u - rays.w * middle.x;
        let b = rays.v - rays.w * middle.y;
        let c = rays.covector(&warp);
        let e = rays.along - Plane::ONE * along;
        Self { a, b, c, e, rows: matrix_from_rows([a, b, e, c]), middle, warp }
    }

    /// (a, b, e, c) · X.
    #[inline]
    pub(crate) fn at(&self, point: DVec3) -> DVec4 {
        let m = &self.rows;
        m.x_axis * point.x + m.y_axis * point.y + m.z_axis * point.z + m.w_axis
    }

    /// c at a point.
    #[inline]
    pub(crate) fn c_at(&self, point: DVec3) -> f64 {
        self.c.at(point)
    }

    /// How much the uniform map's w changes where c is 1, from a texel to the next one across and to the next one down
    /// together, in a window of `size` texels a side.
    pub(crate) fn change_of_inverse_c(&self, window: &Rectangle, size: u32) -> f64 {
        // There w is 1 − slope · (u, v), as in `least_c`.
        self.warp.slope.abs().dot(window.half) * 2.0 / f64::from(size)
    }

    /// The least c of anything in the window that is no nearer to the light than `near`.
    pub(crate) fn least_c(&self, rays: &Rays, window: &Rectangle, near: f64) -> f64 {
        // c is 1 at the homogeneous point D = (across, w) of the ray through a corner of the window. A point at
        // distance `near` from a light at a position, X = l + near · D/|D|, has c = near/|D|; a point that a
        // directional light reaches, w = 1, has c = 1/w(D). |D| is convex over the window, and so is w(D), so that the
        // corners decide.
        let farthest = window.corners().map(|corner| {
            let w = 1.0 - self.warp.slope.dot(corner);
            if rays.local { rays.direction(self.middle * w + corner, w).length() / near } else { w }
        });
        farthest.into_iter().fold(f64::MIN_POSITIVE, most).recip()
    }

    /// The planes that bound the window, cut off what is deeper than `last` and, at the end of the list, what has less than
    /// the least c; inside ≥ 0.
    pub(crate) fn planes(&self, window: &Rectangle, last: f64, least_c: f64) -> [Plane; 6] {
        let (min, max) = (window.centre - window.half, window.centre + window.half);
        [
            self.a - self.c * min.x,
            self.c * max.x - self.a,
            self.b - self.c * min.y,
            self.c * max.y - self.b,
            self.c * last - self.e,
            self.c - Plane::ONE * least_c,
        ]
    }

    /// The rows of the matrix that takes the window and the depth range to clip space (x and y −1 to 1, depth 0 to 1),
    /// with w multiplied by `scale`.
    pub(crate) fn rows_to(&self, window: &Rectangle, depth: &Interval, scale: f64) -> [Plane; 4] {
        [
            (self.a - self.c * window.centre.x) * (scale / window.half.x),
            (self.b - self.c * window.centre.y) * (scale / window.half.y),
            (self.e - self.c * depth.min) * (scale / (depth.max - depth.min)),
            self.c * scale,
        ]
    }
}
