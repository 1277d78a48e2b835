//! The view V: the camera's frustum, whatever convention its matrices came in.

use crate::convex::{Plane, matrix_from_rows};
use crate::error::{Hint, InputError, InputErrorKind, MIN_DISTANCE, check};
use crate::input::clip_space::DepthRange;
use crate::input::numbers::vector;
use crate::input::view::frustum::steps;
use crate::math::angle;
use crate::math::bounds::{Interval, least, most};
use glam::{DMat4, DVec2, DVec3};

mod ball;
mod decode;
mod frustum;
mod matrices;
mod planes;
#[cfg(feature = "serde")]
mod stored;
mod tangents;

pub use planes::FrustumPlanes;
pub use tangents::Tangents;

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
/// `right`, `up` and `forward` are unit length, `right` and `up` at right angles to `forward`, and, unless the image is
/// sheared, to each other (right- or left-handed); the frame is not empty; `near < far`; a perspective view has
/// `near > 0` and may have `far = ∞`.
///
/// A near or far plane may be oblique, as that of a mirror's camera is. It cuts V further ([`View::planes`]); `near` and
/// `far` are then the depths between which V lies.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(try_from = "stored::View"))]
pub struct View {
    pub(crate) eye: DVec3,
    pub(crate) right: DVec3,
    pub(crate) up: DVec3,
    pub(crate) forward: DVec3,
    /// The cosine of the angle between `right` and `up`, 0 in an image that is not sheared.
    pub(crate) lean: f64,
    pub(crate) lens: Lens,
    /// The frame's lower left and upper right corners: slopes of a perspective lens, offsets of an orthographic one.
    pub(crate) frame_min: DVec2,
    pub(crate) frame_max: DVec2,
    pub(crate) near: f64,
    #[cfg_attr(feature = "serde", serde(with = "crate::math::infinity"))]
    pub(crate) far: f64,
    /// Where a plane is oblique, what cuts V beside the plane across the view.
    pub(crate) near_cut: Option<Plane>,
    pub(crate) far_cut: Option<Plane>,
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
        Self::framed(vector(eye), axes, Lens::Perspective, [-slopes, slopes], [near, far])
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
        Self::framed(vector(eye), axes, Lens::Orthographic, [-half, half], [near, far])
    }

    /// A perspective camera by the tangents of its four half angles, as headset runtimes give them: `near` and `far` stay
    /// what they are, where a matrix keeps no more of them than its numbers have room for.
    ///
    /// `forward` and `up` are those of the pose, of any length, in world space: with a unit quaternion, the images of −z
    /// and y in OpenXR and OpenVR. `near` and `far` are depths along `forward` in world units; `far` may be infinite.
    ///
    /// ```
    /// use shadowfit::{View, input::Tangents};
    ///
    /// // An `XrFovf` of the left eye.
    /// let tangents = Tangents::from_angles(-0.94, 0.77, -0.88, 0.83)?;
    /// let left = View::from_tangents((-0.032, 1.7, 0.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0), tangents, 0.05, 500.0)?;
    /// assert_eq!((left.near(), left.far()), (0.05, 500.0));
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// Names the field that is not finite, without direction, parallel to the other direction, not positive, or out of
    /// order; `"frame"` where left is not less than right or bottom than top.
    pub fn from_tangents<E: Into<f64>, F: Into<f64>, U: Into<f64>>(
        eye: impl Into<[E; 3]>,
        forward: impl Into<[F; 3]>,
        up: impl Into<[U; 3]>,
        tangents: Tangents,
        near: f64,
        far: f64,
    ) -> Result<Self, InputError> {
        let Tangents { left, right, bottom, top } = tangents;
        let frame = [DVec2::new(left, bottom), DVec2::new(right, top)];
        let axes = Axes::looking(vector(forward), vector(up))?;
        Self::framed(vector(eye), axes, Lens::Perspective, frame, [near, far])
    }

    /// The part of the view between two depths: what a cascade covers, or what a read-back of the depth buffer found to be
    /// visible (PSM §6). Depths beyond the view's own are drawn in to those.
    ///
    /// ```
    /// use shadowfit::View;
    ///
    /// let view = View::perspective((0.0, 1.7, 0.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.5, 80.0)?;
    /// let narrowed = view.narrowed(0.1, 20.0)?;
    /// assert_eq!((narrowed.near(), narrowed.far()), (0.5, 20.0));
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// Names `"near"` or `"far"` when it is NaN, `"far"` when it is no more than `near`, and the one that lies beyond the
    /// other end of the view when the range misses it ([`InputErrorKind::OutsideView`]).
    pub fn narrowed(&self, near: f64, far: f64) -> Result<Self, InputError> {
        for (field, depth) in [("near", near), ("far", far)] {
            if depth.is_nan() {
                return Err(InputError::new(field, InputErrorKind::NotFinite).got(depth));
            }
        }
        check::above("far", far, "near", near)?;
        if near >= self.far {
            return Err(InputError::new("near", InputErrorKind::OutsideView).got(near));
        }
        if far <= self.near {
            return Err(InputError::new("far", InputErrorKind::OutsideView).got(far));
        }
        Self { near: most(near, self.near), far: least(far, self.far), ..*self }.checked()
    }

    fn framed(
        eye: DVec3,
        axes: Axes,
        lens: Lens,
        [frame_min, frame_max]: [DVec2; 2],
        [near, far]: [f64; 2],
    ) -> Result<Self, InputError> {
        let Axes { right, up, forward } = axes;
        let (lean, near_cut, far_cut) = (0.0, None, None);
        Self { eye, right, up, forward, lean, lens, frame_min, frame_max, near, far, near_cut, far_cut }.checked()
    }

    /// The view, if its numbers are what one has.
    pub(crate) fn checked(self) -> Result<Self, InputError> {
        let eye = check::point("eye", self.eye)?;
        let corner = |corner: DVec2| check::point("frame", corner.extend(0.0)).map(DVec3::truncate);
        let (frame_min, frame_max) = (corner(self.frame_min)?, corner(self.frame_max)?);
        if !(frame_min.x < frame_max.x && frame_min.y < frame_max.y) {
            return check::fail("frame", InputErrorKind::OutOfOrder);
        }
        let size = frame_max - frame_min;
        check::distance("frame", size.x).and(check::distance("frame", size.y))?;
        let (near, far) = match self.lens {
            Lens::Perspective => {
                (check::distance("near", self.near)?, check::distance_or_infinity("far", self.far)?)
            }
            Lens::Orthographic => (check::coordinate("near", self.near)?, check::coordinate("far", self.far)?),
        };
        check::above("far", far, "near", near)?;
        Ok(Self { eye, frame_min, frame_max, near, far, ..self })
    }

    /// Where the camera is, in world space.
    #[must_use]
    pub const fn eye(&self) -> DVec3 {
        self.eye
    }

    /// The unit axis to the right of the image, in world space, at right angles to its left and right edges. The
    /// constructors that take directions take the world to be right-handed; in a left-handed one theirs points to the left,
    /// which changes no result.
    #[must_use]
    pub const fn right(&self) -> DVec3 {
        self.right
    }

    /// The unit axis to the top of the image, in world space, at right angles to its lower and upper edges.
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
    /// outside are taken for the end they are beyond, NaN for 0. With an oblique plane depth is no function of what is
    /// stored alone, and this is that of a buffer drawn without one. What is cleared to the far end and never drawn to has the depth of
    /// the far plane, infinite where that is.
    ///
    /// ```
    /// use shadowfit::{View, input::DepthRange};
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
        let [right, up] = self.steps();
        let across = right * place.x + up * place.y;
        match self.lens {
            Lens::Perspective => (self.eye, self.forward + across),
            Lens::Orthographic => (self.eye + across, self.forward),
        }
    }

    /// What the middle of the image shows at a depth.
    pub(crate) fn centre_at(&self, depth: f64) -> DVec3 {
        self.at((self.frame_min + self.frame_max) * 0.5, depth)
    }

    /// What a point of the frame shows at a depth.
    fn at(&self, point: DVec2, depth: f64) -> DVec3 {
        let point = match self.lens {
            Lens::Perspective => point * depth,
            Lens::Orthographic => point,
        };
        let [right, up] = self.steps();
        self.eye + self.forward * depth + right * point.x + up * point.y
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

    /// The corners, in world space, of the frustum between the depths [`Self::near`] and [`Self::far`]: near then far, each
    /// left-bottom, right-bottom, left-top, right-top; `None` when the far plane is infinite. They are V's own unless
    /// a plane is oblique, which cuts V further.
    #[must_use]
    pub fn corners(&self) -> Option<[DVec3; 8]> {
        self.far.is_finite().then(|| {
            let [right, up] = self.steps();
            core::array::from_fn(|corner| {
                let depth = if corner < 4 { self.near } else { self.far };
                let unit = match self.lens {
                    Lens::Perspective => depth,
                    Lens::Orthographic => 1.0,
                };
                let x = if corner & 1 == 0 { self.frame_min.x } else { self.frame_max.x };
                let y = if corner & 2 == 0 { self.frame_min.y } else { self.frame_max.y };
                self.eye + self.forward * depth + right * (x * unit) + up * (y * unit)
            })
        })
    }

    /// The steps that go along one side of the frame by 1, in world space.
    fn steps(&self) -> [DVec3; 2] {
        steps(self.right, self.up, self.lean)
    }

    /// The camera's 4×4, world → clip, with x, y and z in [−1, 1] whatever convention the view came in; z runs from the depth
    /// [`Self::near`] to [`Self::far`], whether or not a plane is oblique.
    #[must_use]
    pub fn clip_from_world(&self) -> DMat4 {
        matrix_from_rows(self.rows(self.near, self.far))
    }

    /// The rows C₀ C₁ C₂ C₃ of the camera's matrix (`docs/design.md`, section 2) with z running from −1 at depth `near` to 1 at
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

    /// A view from the same eye along the same axis, of lines of sight side by side, between depths: in its image, half as
    /// high as that range is deep, everything has the same size.
    pub(crate) fn without_perspective(&self, depths: &Interval) -> Self {
        let half = DVec2::splat(most(0.5 * (depths.max - depths.min), MIN_DISTANCE));
        Self {
            lens: Lens::Orthographic,
            frame_min: -half,
            frame_max: half,
            near: depths.min,
            far: most(depths.max, depths.min + half.x),
            near_cut: None,
            far_cut: None,
            ..*self
        }
    }

    /// The same view with the eye moved back along the view axis by `shift` world units: depths grow by as much, the
    /// frame keeps its slopes.
    pub(crate) fn moved_back(&self, shift: f64) -> Self {
        Self { eye: self.eye - self.forward * shift, ..*self }
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
            return check::fail("up", InputErrorKind::Parallel);
        }
        let right = right.normalize();
        Ok(Self { right, up: right.cross(forward), forward })
    }
}
