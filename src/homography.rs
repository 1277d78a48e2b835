//! The map from rays to the window, before the window is moved into the clip volume.

use crate::bounds::{Interval, Rectangle};
use crate::convex::Plane;
use crate::rays::{Functional, Rays};
use glam::{DVec2, DVec3};

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
    pub(crate) a: Plane,
    pub(crate) b: Plane,
    pub(crate) c: Plane,
    pub(crate) e: Plane,
    /// The middle of what is visible, on the chart.
    middle: DVec2,
    /// c as a function on the chart.
    warp: Functional,
    /// c of what is visible or can cast on it is no smaller than this.
    least_c: f64,
}

impl Homography {
    /// The homography with w = `warp`, 1 at `middle`, and zero depth at distance `along` along the axis.
    pub(crate) fn new(rays: &Rays, middle: DVec2, warp: Functional, along: f64) -> Self {
        Self {
            a: rays.u - rays.w * middle.x,
            b: rays.v - rays.w * middle.y,
            c: rays.covector(&warp),
            e: rays.along - Plane::ONE * along,
            middle,
            warp,
            least_c: f64::MIN_POSITIVE,
        }
    }

    /// Takes it from here on that nothing nearer to the light than `near` matters, nor outside of the window.
    pub(crate) fn cut(&mut self, rays: &Rays, window: &Rectangle, near: f64) {
        // c is 1 at the homogeneous point D = (across, w) of the ray through a corner of the window. A point at
        // distance `near` from a light at a position, X = l + near · D/|D|, has c = near/|D|; a point that a
        // directional light reaches, w = 1, has c = 1/w(D). |D| is convex over the window, and so is w(D), so that the
        // corners decide.
        let farthest = window.corners().map(|corner| {
            let w = 1.0 - self.warp.slope.dot(corner);
            if rays.local { rays.direction(self.middle * w + corner, w).length() / near } else { w }
        });
        self.least_c = farthest.into_iter().fold(f64::MIN_POSITIVE, f64::max).recip();
    }

    /// c at a point that matters, never less than half of what it can be but for rounding.
    pub(crate) fn c_at(&self, point: DVec3) -> f64 {
        self.c.at(point).max(0.5 * self.least_c)
    }

    pub(crate) fn uv(&self, point: DVec3) -> DVec2 {
        DVec2::new(self.a.at(point), self.b.at(point)) / self.c_at(point)
    }

    pub(crate) fn depth(&self, point: DVec3) -> f64 {
        self.e.at(point) / self.c_at(point)
    }

    /// The planes that bound the window and, last, cut off what is nearer than the least c; inside ≥ 0.
    pub(crate) fn planes(&self, window: &Rectangle) -> [Plane; 5] {
        let (min, max) = (window.centre - window.half, window.centre + window.half);
        [
            self.a - self.c * min.x,
            self.c * max.x - self.a,
            self.b - self.c * min.y,
            self.c * max.y - self.b,
            self.c - Plane::ONE * self.least_c,
        ]
    }

    /// The rows of the matrix that takes the window and the depth range to clip space (x and y −1 to 1, depth 0 to 1),
    /// with w multiplied by `scale`.
    pub(crate) fn rows(&self, window: &Rectangle, depth: &Interval, scale: f64) -> [Plane; 4] {
        [
            (self.a - self.c * window.centre.x) * (scale / window.half.x),
            (self.b - self.c * window.centre.y) * (scale / window.half.y),
            (self.e - self.c * depth.min) * (scale / (depth.max - depth.min)),
            self.c * scale,
        ]
    }
}
