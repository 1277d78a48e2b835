//! A ball around a view, for maps whose texels stay where they are.

use super::{Lens, View};
use crate::math::bounds::{least, most};
use glam::{DVec2, DVec3};

impl View {
    /// The middle and the radius of a ball around V, unless its far plane is infinite, for an image so many pixels high. The
    /// radius comes of the frame, near and far alone, so that it has the same bits wherever the camera is.
    ///
    /// It has the same bits too while the projection is moved about by less than a pixel, as temporal anti-aliasing does:
    /// the frame counts as centred, and larger by a pixel to each side, while its middle is no farther than that from the
    /// axis. A frame farther off axis counts with its middle at the nearest sixteenth of its half size, larger by
    /// the half of that.
    ///
    /// It is the smallest with its middle on the frame's own axis, and so the smallest of all where that is the view's. With m
    /// the middle of a perspective frame, h half its size, s = |h|, q = h·|m| and A = 1 + |m|², the farthest corners at depth
    /// d of the ball's middle at depth z lie at
    ///
    /// ```text
    ///     A (d − z)² + 2 q d |d − z| + s² d²
    /// ```
    ///
    /// squared, which is the same for near and far where a linear equation in z says.
    pub(crate) fn ball(&self, image_height: u32) -> Option<(DVec3, f64)> {
        if self.far.is_infinite() {
            return None;
        }
        let (near, far) = (self.near, self.far);
        let (middle, half) = self.steady_frame(image_height);
        let centre = middle;
        // In a sheared image what lies so far along the axes is no farther than this from its middle.
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

    /// The middle and half the size of a frame that holds the view's, and every other that a projection moved by less than a
    /// pixel gives it.
    fn steady_frame(&self, image_height: u32) -> (DVec2, DVec2) {
        /// Room for what roundings to f32 take from the frame, and for how far the axes of a view in f32 are from right angles.
        const ROOM: f64 = 1.0 / 1_048_576.0;
        let middle = (self.frame_min + self.frame_max) * 0.5;
        // The scale of a matrix in f32 does not change as its middle does. What is left of it here, by way of both sides,
        // does by a rounding of f64, which is not enough for the quotient of two numbers of f32 to round to another one.
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
