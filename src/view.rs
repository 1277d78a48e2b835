//! The view V: the camera's frustum, whatever convention its matrices came in.

use crate::angle;
use crate::bounds::{least, most};
use crate::clip_space::{ClipSpace, DepthRange};
use crate::convex::{Plane, matrix_from_rows};
use crate::decode::{EyeAxes, Frame};
use crate::error::{Hint, InputError, Problem, check};
use crate::numbers::{IntoMatrix, vector};
use glam::{DMat4, DVec2, DVec3};

/// Whether lines of sight meet in the eye or run side by side.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Lens {
    /// Lines of sight meet in the eye; the frame is given by slopes, offset per unit of depth.
    Perspective,
    /// Lines of sight are parallel; the frame is given by offsets in world units.
    Orthographic,
}

/// A camera: an eye, three axes, a frame and a depth range.
///
/// Every projection matrix the constructors accept is brought to this one form, so that equivalent cameras, whatever
/// their handedness, their direction of z or y and their clip volume, give the same view.
///
/// # Guarantees
///
/// `right`, `up` and `forward` are orthonormal (right- or left-handed); the frame is not empty; `near < far`; a
/// perspective view has `near > 0` and may have `far = ∞`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(try_from = "stored::View"))]
pub struct View {
    eye: DVec3,
    right: DVec3,
    up: DVec3,
    forward: DVec3,
    lens: Lens,
    /// The frame's lower left and upper right corners: slopes of a perspective lens, offsets of an orthographic one.
    frame_min: DVec2,
    frame_max: DVec2,
    near: f64,
    #[cfg_attr(feature = "serde", serde(with = "crate::infinity"))]
    far: f64,
}

impl View {
    /// A perspective camera with a symmetric frame.
    ///
    /// `forward` and `up` need not be unit length nor at right angles; `fov_y` is the full vertical field of view in
    /// radians, `aspect` is width over height, `near` and `far` are depths along `forward` in world units; `far` may be
    /// infinite.
    ///
    /// # Errors
    ///
    /// Names the field that is not finite, without direction, parallel to the other direction, outside (0, π), not
    /// positive, or out of order.
    pub fn perspective<E: Into<f64>, F: Into<f64>, U: Into<f64>>(
        eye: impl Into<[E; 3]>,
        forward: impl Into<[F; 3]>,
        up: impl Into<[U; 3]>,
        fov_y: f64,
        aspect: f64,
        near: f64,
        far: f64,
    ) -> Result<Self, InputError> {
        let fov_y = check::angle("fov_y", fov_y, 0.0, core::f64::consts::PI).map_err(|error| {
            // A lens of more than a turn is one of that many degrees.
            let degrees = fov_y > 2.0 * core::f64::consts::PI && fov_y <= 180.0;
            error.hinted(degrees.then_some(Hint::Degrees))
        })?;
        let (sine, cosine) = angle::sine_cosine(0.5 * fov_y);
        let slope = check::distance("fov_y", sine / cosine)?;
        let slopes = DVec2::new(check::distance("aspect", slope * check::distance("aspect", aspect)?)?, slope);
        let axes = Axes::looking(vector(forward), vector(up))?;
        Self::checked(vector(eye), axes, Lens::Perspective, -slopes, slopes, near, far)
    }

    /// An orthographic camera with a symmetric frame.
    ///
    /// `half_height` is half the height of what is seen, in world units; `aspect` is width over height; `near` and
    /// `far` are depths along `forward` from `eye`, either sign, in world units.
    ///
    /// # Errors
    ///
    /// Names the field that is not finite, without direction, parallel to the other direction, not positive, or out of
    /// order.
    pub fn orthographic<E: Into<f64>, F: Into<f64>, U: Into<f64>>(
        eye: impl Into<[E; 3]>,
        forward: impl Into<[F; 3]>,
        up: impl Into<[U; 3]>,
        half_height: f64,
        aspect: f64,
        near: f64,
        far: f64,
    ) -> Result<Self, InputError> {
        let height = check::distance("half_height", half_height)?;
        let half = DVec2::new(check::distance("aspect", height * check::distance("aspect", aspect)?)?, height);
        let axes = Axes::looking(vector(forward), vector(up))?;
        Self::checked(vector(eye), axes, Lens::Orthographic, -half, half, near, far)
    }

    /// A camera from the two matrices a renderer has: world → eye and eye → clip, for column vectors (`clip_from_eye ·
    /// eye_from_world · x`).
    ///
    /// `eye_from_world` may mirror and may scale uniformly. `clip_from_eye` may be perspective or orthographic, off
    /// axis, with the eye looking along either end of its z axis, with an infinite far plane, and in any
    /// [`ClipSpace`]; its texture origin plays no part.
    ///
    /// # Errors
    ///
    /// Names the matrix that is not finite, not rigid, or no projection; `"near"` or `"far"` when the depth range that
    /// `clip_from_eye` encodes is not positive, which is also what a matrix read in the wrong convention looks like.
    pub fn from_matrices<A, B>(
        eye_from_world: impl IntoMatrix<A>,
        clip_from_eye: impl IntoMatrix<B>,
        clip: ClipSpace,
    ) -> Result<Self, InputError> {
        let (eye_from_world, clip_from_eye) = (eye_from_world.into_matrix(), clip_from_eye.into_matrix());
        let axes = EyeAxes::of(&eye_from_world)?;
        let frame = Frame::of(&clip_from_eye, clip)?;
        let forward = axes.backward * frame.forward_sign;
        let scale = axes.world_per_eye;
        let (unit, depth) = match frame.lens {
            Lens::Perspective => (1.0, scale),
            Lens::Orthographic => (scale, scale),
        };
        let axes_found = Axes { right: axes.right, up: axes.up, forward };
        let (near, far) = (frame.near * depth, frame.far * depth);
        Self::checked(axes.eye, axes_found, frame.lens, frame.min * unit, frame.max * unit, near, far)
    }

    /// The same view between two depths, which must lie within its own: what a cascade covers, or what a read-back of
    /// the depth buffer found to be visible (PSM §6).
    ///
    /// # Errors
    ///
    /// Names `"near"` or `"far"` when it is not finite, lies outside the view's own depth range, or they are out of
    /// order. `far` may be infinite where the view's own is.
    pub fn narrowed(&self, near: f64, far: f64) -> Result<Self, InputError> {
        if near < self.near {
            return check::fail("near", Problem::TooSmall);
        }
        if far > self.far {
            return check::fail("far", Problem::TooLarge);
        }
        let axes = Axes { right: self.right, up: self.up, forward: self.forward };
        Self::checked(self.eye, axes, self.lens, self.frame_min, self.frame_max, near, far)
    }

    fn checked(
        eye: DVec3,
        axes: Axes,
        lens: Lens,
        frame_min: DVec2,
        frame_max: DVec2,
        near: f64,
        far: f64,
    ) -> Result<Self, InputError> {
        let eye = check::point("eye", eye)?;
        let corner = |corner: DVec2| check::point("frame", corner.extend(0.0)).map(DVec3::truncate);
        let (frame_min, frame_max) = (corner(frame_min)?, corner(frame_max)?);
        if !(frame_min.x < frame_max.x && frame_min.y < frame_max.y) {
            return check::fail("frame", Problem::OutOfOrder);
        }
        let size = frame_max - frame_min;
        check::distance("frame", size.x).and(check::distance("frame", size.y))?;
        let (near, far) = match lens {
            Lens::Perspective => (check::distance("near", near)?, check::distance_or_infinity("far", far)?),
            Lens::Orthographic => (check::coordinate("near", near)?, check::coordinate("far", far)?),
        };
        check::above("far", far, "near", near)?;
        let Axes { right, up, forward } = axes;
        Ok(Self { eye, right, up, forward, lens, frame_min, frame_max, near, far })
    }

    /// Where the camera is, in world space.
    #[must_use]
    pub const fn eye(&self) -> DVec3 {
        self.eye
    }

    /// The unit axis to the right of the image, in world space. [`Self::perspective`] and [`Self::orthographic`] take
    /// the world to be right-handed; in a left-handed one theirs points to the left, which changes no result.
    #[must_use]
    pub const fn right(&self) -> DVec3 {
        self.right
    }

    /// The unit axis to the top of the image, in world space.
    #[must_use]
    pub const fn up(&self) -> DVec3 {
        self.up
    }

    /// The unit axis that the camera looks along, in world space.
    #[must_use]
    pub const fn forward(&self) -> DVec3 {
        self.forward
    }

    /// Perspective or orthographic.
    #[must_use]
    pub const fn lens(&self) -> Lens {
        self.lens
    }

    /// Depth of the near plane along [`Self::forward`], in world units.
    #[must_use]
    pub const fn near(&self) -> f64 {
        self.near
    }

    /// Depth of the far plane along [`Self::forward`], in world units; may be infinite.
    #[must_use]
    pub const fn far(&self) -> f64 {
        self.far
    }

    /// Depth of a point before the eye, in world units.
    #[must_use]
    pub fn depth(&self, point: DVec3) -> f64 {
        self.forward.dot(point - self.eye)
    }

    /// The depth before the eye, in world units, that a value in the camera's own depth buffer stands for: what a renderer
    /// that reads back the nearest and the farthest of what is visible (PSM §6) turns into numbers for
    /// [`Self::narrowed`], widened by a few steps of the buffer's format.
    ///
    /// `stored` runs from 0 to 1, as depth buffers do on every API, and `range` is that of the camera's clip space; values
    /// outside are taken for the end they are beyond, NaN for 0. What is cleared to the far end and never drawn to has the depth of
    /// the far plane, infinite where that is.
    ///
    /// ```
    /// use shadowfit::{DepthRange, View};
    ///
    /// let view = View::perspective((0.0, 1.7, 0.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.1, f64::INFINITY)?;
    /// // Reversed, without end: the buffer holds near / depth.
    /// let (nearest, farthest) = (0.05, 0.000_4);
    /// let depth = |stored| view.depth_of(stored, DepthRange::ZeroToOneReversed);
    /// let narrowed = view.narrowed(depth(nearest) * 0.999, depth(farthest) * 1.001)?;
    /// assert!((narrowed.near() - 1.998).abs() < 1e-9 && (narrowed.far() - 250.25).abs() < 1e-9);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn depth_of(&self, stored: f64, range: DepthRange) -> f64 {
        let stored = if stored > 0.0 { stored.min(1.0) } else { 0.0 };
        let (to_near, to_far) = if range.is_reversed() { (stored, 1.0 - stored) } else { (1.0 - stored, stored) };
        match self.lens {
            // 1/depth is what is stored, between 1/near and 1/far.
            Lens::Perspective => self.near / (to_near + to_far * (self.near / self.far)),
            Lens::Orthographic => self.near * to_near + self.far * to_far,
        }
    }

    /// What a place in the image, (0, 0) to (1, 1), shows at depth 0, and the step from there to depth 1.
    pub(crate) fn ray(&self, place: DVec2) -> (DVec3, DVec3) {
        let place = self.frame_min + (self.frame_max - self.frame_min) * place;
        let across = self.right * place.x + self.up * place.y;
        match self.lens {
            Lens::Perspective => (self.eye, self.forward + across),
            Lens::Orthographic => (self.eye + across, self.forward),
        }
    }

    /// What the middle of the image shows at a depth.
    pub(crate) fn centre_at(&self, depth: f64) -> DVec3 {
        let centre = (self.frame_min + self.frame_max) * 0.5;
        let centre = match self.lens {
            Lens::Perspective => centre * depth,
            Lens::Orthographic => centre,
        };
        self.eye + self.forward * depth + self.right * centre.x + self.up * centre.y
    }

    /// Half the height, in world units, of what the image shows at a depth.
    #[must_use]
    pub fn half_height(&self, depth: f64) -> f64 {
        let half = 0.5 * (self.frame_max.y - self.frame_min.y);
        match self.lens {
            Lens::Perspective => half * depth,
            Lens::Orthographic => half,
        }
    }

    /// The side of a pixel at a point, across the view axis, in world units, of an image so many pixels high.
    pub(crate) fn pixel_size(&self, point: DVec3, image_height: u32) -> f64 {
        2.0 * self.half_height(self.depth(point)) / f64::from(image_height)
    }

    /// The planes of V in world space, inside ≥ 0: left, right, bottom, top, near and, unless it is infinite, far.
    #[must_use]
    pub fn planes(&self) -> FrustumPlanes {
        let (depth, one) = (self.depth_row(), self.frame_unit());
        let (x, y) = (Plane::through(self.right, self.eye), Plane::through(self.up, self.eye));
        let near = depth - Plane::ONE * self.near;
        // An infinite one is the plane at infinity. Any multiple would do: this one scales with the scene as others do.
        let far = if self.far.is_finite() { Plane::ONE * self.far - depth } else { Plane::ONE * self.near };
        FrustumPlanes {
            planes: [
                x - one * self.frame_min.x,
                one * self.frame_max.x - x,
                y - one * self.frame_min.y,
                one * self.frame_max.y - y,
                near,
                far,
            ],
            len: if self.far.is_finite() { 6 } else { 5 },
        }
    }

    /// The corners of V in world space: near then far, each left-bottom, right-bottom, left-top, right-top; `None` when
    /// the far plane is infinite.
    #[must_use]
    pub fn corners(&self) -> Option<[DVec3; 8]> {
        self.far.is_finite().then(|| {
            core::array::from_fn(|corner| {
                let depth = if corner < 4 { self.near } else { self.far };
                let unit = match self.lens {
                    Lens::Perspective => depth,
                    Lens::Orthographic => 1.0,
                };
                let x = if corner & 1 == 0 { self.frame_min.x } else { self.frame_max.x };
                let y = if corner & 2 == 0 { self.frame_min.y } else { self.frame_max.y };
                self.eye + self.forward * depth + self.right * (x * unit) + self.up * (y * unit)
            })
        })
    }

    /// The middle and the radius of a ball around V, unless its far plane is infinite. The radius comes of the frame, near and
    /// far alone, so that it has the same bits wherever the camera is.
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
    pub(crate) fn ball(&self) -> Option<(DVec3, f64)> {
        if self.far.is_infinite() {
            return None;
        }
        let (near, far) = (self.near, self.far);
        let middle = (self.frame_min + self.frame_max) * 0.5;
        let half = (self.frame_max - self.frame_min) * 0.5;
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
        Some((self.centre_at(depth), DVec2::splat(squared).sqrt().x))
    }

    /// The camera's 4×4, world → clip, with x, y and z in [−1, 1] whatever convention the view came in.
    #[must_use]
    pub fn clip_from_world(&self) -> DMat4 {
        matrix_from_rows(self.rows(self.near, self.far))
    }

    /// Depth before the eye as a covector.
    pub(crate) fn depth_row(&self) -> Plane {
        Plane::through(self.forward, self.eye)
    }

    /// What the frame's numbers are multiples of: depth for slopes, 1 for offsets. It is also the row C₃ of the
    /// camera's matrix.
    fn frame_unit(&self) -> Plane {
        match self.lens {
            Lens::Perspective => self.depth_row(),
            Lens::Orthographic => Plane::ONE,
        }
    }

    /// The rows C₀ C₁ C₂ C₃ of the camera's matrix (DESIGN section 2) with z running from −1 at depth `near` to 1 at
    /// depth `far`.
    pub(crate) fn rows(&self, near: f64, far: f64) -> [Plane; 4] {
        let centre = (self.frame_min + self.frame_max) * 0.5;
        let half = (self.frame_max - self.frame_min) * 0.5;
        let unit = self.frame_unit();
        let row =
            |axis: DVec3, centre: f64, half: f64| (Plane::through(axis, self.eye) - unit * centre) * half.recip();
        let depth = self.depth_row();
        let z = match self.lens {
            // Divided through by `far`, so that an infinite one is no special case.
            Lens::Perspective => {
                let ratio = near / far;
                (depth * (1.0 + ratio) - Plane::ONE * (2.0 * near)) * (1.0 - ratio).recip()
            }
            Lens::Orthographic => (depth * 2.0 - Plane::ONE * (far + near)) * (far - near).recip(),
        };
        [row(self.right, centre.x, half.x), row(self.up, centre.y, half.y), z, unit]
    }

    /// The same view with the eye moved back along the view axis by `shift` world units: depths grow by as much, the
    /// frame keeps its slopes.
    pub(crate) fn moved_back(&self, shift: f64) -> Self {
        Self { eye: self.eye - self.forward * shift, ..*self }
    }
}

/// Up to six planes, as [`View::planes`] returns them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrustumPlanes {
    planes: [Plane; 6],
    len: usize,
}

impl FrustumPlanes {
    /// All six, with the plane at infinity for an infinite far plane.
    pub(crate) const fn with_infinity(&self) -> &[Plane; 6] {
        &self.planes
    }
}

impl core::ops::Deref for FrustumPlanes {
    type Target = [Plane];
    fn deref(&self) -> &[Plane] {
        &self.planes[..self.len]
    }
}

/// The axes of the image, orthonormal.
struct Axes {
    right: DVec3,
    up: DVec3,
    forward: DVec3,
}

impl Axes {
    fn looking(forward: DVec3, up: DVec3) -> Result<Self, InputError> {
        let forward = check::direction("forward", forward)?;
        let up = check::direction("up", up)?;
        let right = forward.cross(up);
        // Below this the sine of the angle is mostly rounding.
        if right.length() < 1e-7 {
            return check::fail("up", Problem::Parallel);
        }
        let right = right.normalize();
        Ok(Self { right, up: right.cross(forward), forward })
    }
}

/// A view as it is stored: the same numbers, checked again when they are read.
#[cfg(feature = "serde")]
mod stored {
    use super::{Axes, DVec2, DVec3, InputError, Lens, Problem, check};

    #[derive(serde::Deserialize)]
    pub(super) struct View {
        eye: DVec3,
        right: DVec3,
        up: DVec3,
        forward: DVec3,
        lens: Lens,
        frame_min: DVec2,
        frame_max: DVec2,
        near: f64,
        #[serde(with = "crate::infinity")]
        far: f64,
    }

    impl TryFrom<View> for super::View {
        type Error = InputError;
        fn try_from(view: View) -> Result<Self, InputError> {
            let View { eye, right, up, forward, lens, frame_min, frame_max, near, far } = view;
            let units = [right, up, forward].map(|axis| axis.length_squared() - 1.0);
            let square = [right.dot(up), up.dot(forward), forward.dot(right)];
            if !units.iter().chain(&square).all(|error| error.abs() < 1e-9) {
                return check::fail("forward", Problem::NotRigid);
            }
            Self::checked(eye, Axes { right, up, forward }, lens, frame_min, frame_max, near, far)
        }
    }
}
