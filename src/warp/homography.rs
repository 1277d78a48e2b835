//! The homography from the chart of rays to the window, before the window is scaled to the clip volume.

use crate::convex::{Plane, matrix_from_rows};
use crate::math::bounds::{Interval, Rectangle, most};
use crate::warp::rays::{Functional, Rays};
use glam::{DMat2, DMat4, DVec2, DVec3, DVec4};

/// Three covectors that vanish at the light, and a depth row that does not (`docs/design.md`, section 2):
///
/// ```text
///     u = a·X / c·X      v = b·X / c·X      z = e·X / c·X
/// ```
///
/// a and b vanish on the ray through the middle of R, where c is the uniform map's w and u and v grow by 1 along the unit vectors of
/// a frame across the ray: an isometry there if the frame is orthonormal. e·l < 0, and c > 0 on R: z grows away from the light in
/// every class.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Homography {
    a: Plane,
    b: Plane,
    c: Plane,
    e: Plane,
    /// The rows a, b, e, c of a matrix.
    pub(crate) rows: DMat4,
    /// The middle of R on the chart.
    middle: DVec2,
    /// From (u, v), next to the middle, to the chart.
    chart_from_window: DMat2,
    /// The gradient of c in u and v there.
    slope: DVec2,
}

/// Two unit vectors on the chart, along which u and v grow in the middle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Frame {
    pub(crate) u: DVec2,
    pub(crate) v: DVec2,
}

impl Frame {
    /// The chart's own.
    pub(crate) const CHART: Self = Self { u: DVec2::X, v: DVec2::Y };

    /// The rows a, b and c, as functions on the chart, of the homography with the middle and c.
    pub(crate) fn rows(&self, middle: DVec2, warp: &Functional) -> [Functional; 3] {
        let row = |along: DVec2| Functional { slope: along, constant: -along.dot(middle) };
        [row(self.u), row(self.v), *warp]
    }
}

impl Homography {
    /// The homography with w = `warp`, 1 at `middle`, and zero depth at distance `along` along the axis.
    pub(crate) fn new(rays: &Rays, middle: DVec2, frame: &Frame, warp: &Functional, along: f64) -> Self {
        let [a, b, c] = frame.rows(middle, warp).map(|row| rays.covector(&row));
        let e = rays.along - Plane::ONE * along;
        let chart_from_window = DMat2::from_cols(frame.u, frame.v).transpose().inverse();
        let slope = chart_from_window.transpose() * warp.slope;
        Self { a, b, c, e, rows: matrix_from_rows([a, b, e, c]), middle, chart_from_window, slope }
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

    /// The change of the uniform map's w on c = 1 from a texel to the next, across and down together, in a window of `sides` texels.
    pub(crate) fn change_of_inverse_c(&self, window: &Rectangle, sides: DVec2) -> f64 {
        // w is 1 − slope · (u, v) there, as in `least_c`, in units of a texel across.
        self.slope.abs().dot(window.half * (sides.x / sides)) * 2.0 / sides.x
    }

    /// The least c in the window at distances of at least `near` from the light.
    pub(crate) fn least_c(&self, rays: &Rays, window: &Rectangle, near: f64) -> f64 {
        // c is 1 at the homogeneous point D = (across, w) on the ray through a corner of the window. A point X = l + near · D/|D|, at
        // distance `near` from a local light, has c = near/|D|; under a directional light c = 1/w(D) where w = 1. |D| and w(D) are
        // convex over the window, so that the corners decide.
        let farthest = window.corners().map(|corner| {
            let w = 1.0 - self.slope.dot(corner);
            let across = self.middle * w + self.chart_from_window * corner;
            if rays.local { rays.direction(across, w).length() / near } else { w }
        });
        farthest.into_iter().fold(f64::MIN_POSITIVE, most).recip()
    }

    /// The planes of the window, of the depth `last` and, at the end, of the least c; inside ≥ 0.
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

    /// The rows of the matrix from the window and the depth range to clip space (x and y −1 to 1, depth 0 to 1), times `scale`.
    pub(crate) fn rows_to(&self, window: &Rectangle, depth: &Interval, scale: f64) -> [Plane; 4] {
        [
            (self.a - self.c * window.centre.x) * (scale / window.half.x),
            (self.b - self.c * window.centre.y) * (scale / window.half.y),
            (self.e - self.c * depth.min) * (scale / (depth.max - depth.min)),
            self.c * scale,
        ]
    }
}
