//! A ball around a view: the room that a stabilised map leaves for it.

use super::{Lens, View};
use crate::math::bounds::{least, most};
use glam::{DVec2, DVec3};

impl View {
    /// The centre and radius of a ball around V for an image `image_height` pixels high; `None` for an infinite far plane.
    ///
    /// The radius depends on the frame, near and far alone, so that it has the same bits wherever the camera is, and under the
    /// sub-pixel jitter of temporal anti-aliasing: [`Self::steady_frame`].
    ///
    /// It is the smallest ball with its centre on the line of sight through the frame's middle. With m the middle of a perspective
    /// frame, h half its size, s = |h|, q = h·|m| and A = 1 + |m|², the squared distance of the farthest corners at depth d from a
    /// centre at depth z is
    ///
    /// ```text
    ///     A (d − z)² + 2 q d |d − z| + s² d²
    /// ```
    ///
    /// The depth z at which near and far corners are equally distant solves a linear equation.
    pub(crate) fn ball(&self, image_height: u32) -> Option<(DVec3, f64)> {
        if self.far.is_infinite() {
            return None;
        }
        let (near, far) = (self.near, self.far);
        let (middle, half) = self.steady_frame(image_height);
        let centre = middle;
        // In a sheared image distances are larger than along orthogonal axes by at most this factor.
        let stretch = DVec2::splat(1.0 - self.lean.abs()).sqrt().x.recip();
        let (middle, half) = (middle * stretch, half * stretch);
        let (depth, squared) = match self.lens {
            Lens::Perspective => {
                let (s2, q, a) = (half.length_squared(), half.dot(middle.abs()), 1.0 + middle.length_squared());
                let (sum, difference) = (far + near, far - near);
                let balance = (a + s2) * difference * sum + 2.0 * q * (far * far + near * near);
                let depth = least(balance / (2.0 * (a * difference + q * sum)), far);
                let corner = |d: f64| {
                    let along = (d - depth).abs();
                    a * along * along + 2.0 * q * d * along + s2 * d * d
                };
                (depth, most(corner(near), corner(far)))
            }
            Lens::Orthographic => {
                let along = 0.5 * (far - near);
                (0.5 * (near + far), along * along + half.length_squared())
            }
        };
        Some((self.at(centre, depth), DVec2::splat(squared).sqrt().x))
    }

    /// The middle and half size of a frame that holds the view's own, the same for all projections that are jittered by less than
    /// a pixel: a frame within a pixel of the axis counts as centred and a pixel larger to each side; one farther off axis has its
    /// middle rounded to a sixteenth of its half size and grows by half of that.
    fn steady_frame(&self, image_height: u32) -> (DVec2, DVec2) {
        /// Room for rounding of the frame to f32, and for axes in f32 that are not quite at right angles.
        const ROOM: f64 = 1.0 / 1_048_576.0;
        let middle = (self.frame_min + self.frame_max) * 0.5;
        // Jitter leaves the scale of an f32 matrix alone. Computed from the sides it varies by a rounding of f64, too little for
        // the quotient of two f32 numbers to round to another f32.
        let half = ((self.frame_max - self.frame_min) * 0.5).as_vec2().as_dvec2();
        let axis = match self.lens {
            Lens::Perspective => 1.0,
            Lens::Orthographic => 0.0,
        };
        let pixel = 2.0 * half.y / f64::from(image_height) + ROOM * (axis + half.max_element());
        if middle.abs().max_element() <= pixel {
            return (DVec2::ZERO, half + pixel);
        }
        let step = half / 16.0;
        ((middle / step).round() * step, half * (1.0 + 1.0 / 32.0) + pixel)
    }
}
