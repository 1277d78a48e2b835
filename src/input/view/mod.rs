//! The view V: the camera's frustum, in one form for all conventions.

use crate::convex::{Plane, matrix_from_rows};
use crate::error::{Expected, Hint, InputError, InputErrorKind, MAX_COORDINATE, MIN_DISTANCE, check};
use crate::input::clip_space::DepthRange;
use crate::input::numbers::vector;
use crate::input::view::frustum::steps;
use crate::math::angle;
use crate::math::bounds::{Interval, least, most};
use glam::{DMat4, DVec2, DVec3};

mod ball;
mod camera;
mod decode;
mod frustum;
mod image;
mod matrices;
mod planes;
#[cfg(feature = "serde")]
mod stored;
mod tangents;

pub use camera::{OrthographicCamera, PerspectiveCamera};
pub(crate) use image::Image;
pub use planes::FrustumPlanes;
pub use tangents::Tangents;

/// The kind of a projection: perspective or orthographic.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Lens {
    /// Lines of sight meet in the eye; the frame is given by slopes, offset per unit of depth.
    Perspective,
    /// Lines of sight are parallel; the frame is given by offsets in world units.
    #[doc(alias = "parallel projection")]
    Orthographic,
}

/// The view V, a camera's frustum: an eye, three axes, a frame and a depth range.
///
/// Every projection is brought to this one form: cameras that see the same give the same view, whatever the handedness, the
/// direction of z or y and the clip volume of their matrices.
///
/// ```
/// use shadowfit::{View, glam::DVec3, input::Lens};
///
/// let view = View::perspective((0.0, 1.7, 0.0), (0.0, 0.0, -2.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.5, 80.0)?;
/// assert_eq!((view.eye(), view.lens()), (DVec3::new(0.0, 1.7, 0.0), Lens::Perspective));
/// assert_eq!((view.right(), view.up(), view.forward()), (DVec3::X, DVec3::Y, DVec3::NEG_Z)); // unit length
/// assert_eq!((view.near(), view.far()), (0.5, 80.0));
/// assert_eq!(view.depth(DVec3::new(3.0, 9.0, -10.0)), 10.0); // along forward, from the eye
/// assert!((view.half_height(10.0) - 10.0 * 0.5_f64.tan()).abs() < 1e-12);
/// # Ok::<(), shadowfit::InputError>(())
/// ```
///
/// # Guarantees
///
/// `right`, `up` and `forward` are unit vectors, `right` and `up` at right angles to `forward` and, unless the image is sheared,
/// to each other (right- or left-handed). The frame is not empty, and `near < far`. A perspective view has `near > 0` and may have
/// `far = ∞`.
///
/// A near or far plane may be oblique, as for mirrors and portals. It cuts V further ([`View::planes`]); `near` and `far` are then
/// the least and the largest depth of V.
#[doc(alias = "camera")]
#[doc(alias = "frustum")]
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
    /// The oblique planes, which cut V besides the planes across the view.
    pub(crate) near_cut: Option<Plane>,
    pub(crate) far_cut: Option<Plane>,
}

impl View {
    /// A perspective camera with a symmetric frame, from its pose and lens.
    ///
    /// `eye` is a position and `forward` and `up` are directions in world space; the directions need neither unit length nor a
    /// right angle. `fov_y` is the full vertical field of view in radians, `aspect` is width over height, `near` and `far` are
    /// depths along `forward` in world units. `far` may be infinite.
    ///
    /// ```
    /// use shadowfit::View;
    ///
    /// let camera = |fov_y: f64| View::perspective([0.0, 1.7, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0], fov_y, 1.6, 0.1, 500.0);
    /// assert_eq!(camera(60_f64.to_radians())?.far(), 500.0);
    /// assert_eq!(camera(60.0).unwrap_err().to_string(), "fov_y must lie in (0, π) radians; got 60. Degrees?");
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// Names the field that is not finite, the zero vector, parallel to the other direction, outside (0, π), not positive, or out
    /// of order.
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
            // More than a full turn can only be degrees.
            let degrees = fov_y > 2.0 * core::f64::consts::PI && fov_y <= 180.0;
            error.hinted(degrees.then_some(Hint::Degrees))
        })?;
        let (sine, cosine) = angle::sine_cosine(0.5 * fov_y);
        let slope = check::distance("fov_y", sine / cosine).map_err(|error| {
            let (least, most) = (2.0 * MIN_DISTANCE, core::f64::consts::PI - 2.0 * MIN_DISTANCE);
            error.got(fov_y).expected(Expected::Within { least, most })
        })?;
        let slopes = DVec2::new(scaled("aspect", aspect, slope)?, slope);
        let axes = Axes::looking(vector(forward), vector(up))?;
        Self::framed(vector(eye), axes, Lens::Perspective, [-slopes, slopes], [near, far])
    }

    /// An orthographic camera with a symmetric frame, from its pose and size.
    ///
    /// `half_height` is half the height of the image in world units, `aspect` is width over height, `near` and `far` are depths
    /// along `forward` from `eye` in world units, of either sign.
    ///
    /// ```
    /// use shadowfit::{View, glam::DVec3};
    ///
    /// // A map view from above, 40 units high and 64 wide.
    /// let view = View::orthographic((0.0, 50.0, 0.0), (0.0, -1.0, 0.0), (0.0, 0.0, -1.0), 20.0, 1.6, 0.0, 60.0)?;
    /// assert_eq!((view.half_height(10.0), view.half_height(50.0)), (20.0, 20.0));
    /// assert_eq!(view.corners().expect("a finite far plane")[0], DVec3::new(-32.0, 50.0, 20.0));
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// Names the field that is not finite, the zero vector, parallel to the other direction, not positive, or out of order.
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
        let half = DVec2::new(scaled("aspect", aspect, height)?, height);
        let axes = Axes::looking(vector(forward), vector(up))?;
        Self::framed(vector(eye), axes, Lens::Orthographic, [-half, half], [near, far])
    }

    /// A perspective camera from the tangents of its four half angles, as headset runtimes give them. `near` and `far` are exact,
    /// where an f32 projection matrix rounds them.
    ///
    /// `forward` and `up` are directions in world space, of any length: in OpenXR and OpenVR the pose's quaternion applied to −z
    /// and to y. `near` and `far` are depths along `forward` in world units; `far` may be infinite.
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
    /// Names the field that is not finite, the zero vector, parallel to the other direction, not positive, or out of order;
    /// `"frame"` where left is not less than right, or bottom not less than top.
    #[doc(alias = "XrFovf")]
    #[doc(alias = "OpenXR")]
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

    /// The part of the view between two depths, in world units along [`Self::forward`]: the range of a cascade, or that of a
    /// depth buffer read back (Stamminger & Drettakis 2002, §6). Depths outside of the view's own range are clamped to it.
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
    /// Names `"near"` or `"far"` when it is NaN, `"far"` when it is no more than `near`, and the one that lies beyond the other
    /// end of the view when the range misses the view ([`InputErrorKind::OutsideView`]).
    #[doc(alias = "SDSM")]
    #[doc(alias = "sample distribution shadow maps")]
    #[doc(alias = "maximum shadow distance")]
    pub fn narrowed(&self, near: f64, far: f64) -> Result<Self, InputError> {
        for (field, depth) in [("near", near), ("far", far)] {
            if depth.is_nan() {
                return Err(InputError::new(field, InputErrorKind::NotFinite).got(depth));
            }
        }
        check::above("far", far, "near", near)?;
        if near >= self.far {
            let expected = Expected::Below { field: "the view's far", value: self.far };
            return Err(InputError::new("near", InputErrorKind::OutsideView).got(near).expected(expected));
        }
        if far <= self.near {
            let expected = Expected::Above { field: "the view's near", value: self.near };
            return Err(InputError::new("far", InputErrorKind::OutsideView).got(far).expected(expected));
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

    /// The view, if its numbers are in range and in order.
    pub(crate) fn checked(self) -> Result<Self, InputError> {
        let eye = check::point("eye", self.eye)?;
        let of_frame = |side: &'static str| move |error: InputError| error.of_component(side);
        let corner = |corner: DVec2, [x, y]: [&'static str; 2]| -> Result<DVec2, InputError> {
            let x = check::coordinate("frame", corner.x).map_err(of_frame(x))?;
            Ok(DVec2::new(x, check::coordinate("frame", corner.y).map_err(of_frame(y))?))
        };
        let (frame_min, frame_max) =
            (corner(self.frame_min, ["left", "bottom"])?, corner(self.frame_max, ["right", "top"])?);
        check::above("frame", frame_max.x, "left", frame_min.x).map_err(of_frame("right"))?;
        check::above("frame", frame_max.y, "bottom", frame_min.y).map_err(of_frame("top"))?;
        let size = frame_max - frame_min;
        check::distance("frame", size.x).map_err(of_frame("width"))?;
        check::distance("frame", size.y).map_err(of_frame("height"))?;
        let (near, far) = match self.lens {
            Lens::Perspective => {
                let unlimited = (self.far == 0.0).then_some(Hint::NoLimit);
                let far = check::distance_or_infinity("far", self.far);
                (check::distance("near", self.near)?, far.map_err(|error| error.hinted(unlimited))?)
            }
            Lens::Orthographic => (check::coordinate("near", self.near)?, check::coordinate("far", self.far)?),
        };
        check::above("far", far, "near", near)?;
        Ok(Self { eye, frame_min, frame_max, near, far, ..self })
    }

    /// The camera's position, in world space.
    #[must_use]
    pub const fn eye(&self) -> DVec3 {
        self.eye
    }

    /// The unit axis to the right of the image, in world space, at right angles to its left and right edges. Constructors from
    /// directions assume a right-handed world; in a left-handed one the axis points to the left, which changes no result.
    #[must_use]
    pub const fn right(&self) -> DVec3 {
        self.right
    }

    /// The unit axis to the top of the image, in world space, at right angles to its lower and upper edges.
    #[must_use]
    pub const fn up(&self) -> DVec3 {
        self.up
    }

    /// The unit axis of the view, in world space: the direction of increasing depth.
    #[must_use]
    pub const fn forward(&self) -> DVec3 {
        self.forward
    }

    /// The kind of projection: perspective or orthographic.
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

    /// The depth of a world-space point before the eye, along [`Self::forward`], in world units.
    #[must_use]
    pub fn depth(&self, point: DVec3) -> f64 {
        self.forward.dot(point - self.eye)
    }

    /// The depth before the eye, in world units, of a value in the camera's own depth buffer. With the least and the largest
    /// value read back, widened by a few steps of the buffer's format, [`Self::narrowed`] fits the view to visible receivers
    /// (Stamminger & Drettakis 2002, §6).
    ///
    /// `stored` lies in [0, 1], as in depth buffers on every API, and is clamped to it (NaN to 0); `range` is that of the camera's
    /// clip space. Pixels cleared to the far end have the depth of the far plane, which may be infinite. Oblique planes are not
    /// taken into account.
    ///
    /// ```
    /// use shadowfit::{View, input::DepthRange};
    ///
    /// let view = View::perspective((0.0, 1.7, 0.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.1, f64::INFINITY)?;
    /// // Reversed depth with an infinite far plane: the buffer holds near / depth.
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
            // The buffer is linear in 1/depth, between 1/near and 1/far.
            Lens::Perspective => self.near / (to_near + to_far * (self.near / self.far)),
            Lens::Orthographic => self.near * to_near + self.far * to_far,
        }
    }

    /// The line of sight through a place in the image, (0, 0) to (1, 1): its point at depth 0 and the step to depth 1.
    pub(crate) fn ray(&self, place: DVec2) -> (DVec3, DVec3) {
        let place = self.frame_min + (self.frame_max - self.frame_min) * place;
        let [right, up] = self.steps();
        let across = right * place.x + up * place.y;
        match self.lens {
            Lens::Perspective => (self.eye, self.forward + across),
            Lens::Orthographic => (self.eye + across, self.forward),
        }
    }

    /// The point at a depth on the line of sight through the middle of the image.
    pub(crate) fn centre_at(&self, depth: f64) -> DVec3 {
        self.at((self.frame_min + self.frame_max) * 0.5, depth)
    }

    /// The point at a depth on the line of sight through a point of the frame.
    fn at(&self, point: DVec2, depth: f64) -> DVec3 {
        let point = match self.lens {
            Lens::Perspective => point * depth,
            Lens::Orthographic => point,
        };
        let [right, up] = self.steps();
        self.eye + self.forward * depth + right * point.x + up * point.y
    }

    /// Half the height of the frustum at a depth, both in world units.
    #[must_use]
    pub fn half_height(&self, depth: f64) -> f64 {
        let half = 0.5 * (self.frame_max.y - self.frame_min.y);
        match self.lens {
            Lens::Perspective => half * depth,
            Lens::Orthographic => half,
        }
    }

    /// The side of a pixel at a point, across the view axis, in world units, for an image `image_height` pixels high.
    /// The place of a point in the frame, 0 to 1, y up; `None` behind the eye.
    pub(crate) fn place(&self, point: DVec3) -> Option<DVec2> {
        let [x, y, _, w] = self.rows(self.near, self.far);
        let at = w.at(point);
        (at > 0.0).then(|| (DVec2::new(x.at(point), y.at(point)) / at + 1.0) * 0.5)
    }

    /// The width of the image over its height.
    pub(crate) fn aspect(&self) -> f64 {
        let size = self.frame_max - self.frame_min;
        size.x / size.y
    }

    pub(crate) fn pixel_size(&self, point: DVec3, image_height: u32) -> f64 {
        2.0 * self.half_height(self.depth(point)) / f64::from(image_height)
    }

    /// The eight corners of the frustum between the depths [`Self::near`] and [`Self::far`], in world space: near then far, each
    /// left-bottom, right-bottom, left-top, right-top. `None` for an infinite far plane. An oblique plane cuts V further.
    ///
    /// ```
    /// use shadowfit::View;
    ///
    /// let camera = |far| View::perspective((0.0, 0.0, 0.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.5, far);
    /// let corners = camera(80.0)?.corners().expect("a finite far plane");
    /// assert_eq!((corners[0].z, corners[7].z), (-0.5, -80.0));
    /// assert!(corners[0].x < 0.0 && corners[0].y < 0.0 && corners[7].x > 0.0 && corners[7].y > 0.0);
    /// assert_eq!(camera(f64::INFINITY)?.corners(), None);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
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

    /// The world-space steps that go by 1 along one side of the frame and by 0 along the other.
    fn steps(&self) -> [DVec3; 2] {
        steps(self.right, self.up, self.lean)
    }

    /// The camera's 4×4 matrix, world → clip, with x, y and z in [−1, 1] whatever convention the view came in. z runs from the
    /// depth [`Self::near`] to [`Self::far`], also where a plane is oblique.
    ///
    /// ```
    /// use shadowfit::{View, glam::DVec3};
    ///
    /// let view = View::perspective((0.0, 0.0, 0.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.5, 80.0)?;
    /// let clip_from_world = view.clip_from_world();
    /// assert!((clip_from_world.project_point3(DVec3::new(0.0, 0.0, -0.5)).z + 1.0).abs() < 1e-12);
    /// assert!((clip_from_world.project_point3(DVec3::new(0.0, 0.0, -80.0)).z - 1.0).abs() < 1e-12);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[doc(alias = "view_proj")]
    #[must_use]
    pub fn clip_from_world(&self) -> DMat4 {
        matrix_from_rows(self.rows(self.near, self.far))
    }

    /// The rows C₀ C₁ C₂ C₃ of the camera's matrix (`docs/design.md`, section 2), with z from −1 at depth `near` to 1 at depth
    /// `far`.
    pub(crate) fn rows(&self, near: f64, far: f64) -> [Plane; 4] {
        let centre = (self.frame_min + self.frame_max) * 0.5;
        let half = (self.frame_max - self.frame_min) * 0.5;
        let unit = self.frame_unit();
        let row =
            |axis: DVec3, centre: f64, half: f64| (Plane::through(axis, self.eye) - unit * centre) * half.recip();
        let depth = self.depth_row();
        let z = match self.lens {
            // Divided by `far`, so that an infinite far plane is no special case.
            Lens::Perspective => {
                let ratio = near / far;
                (depth * (1.0 + ratio) - Plane::ONE * (2.0 * near)) * (1.0 - ratio).recip()
            }
            Lens::Orthographic => (depth * 2.0 - Plane::ONE * (far + near)) * (far - near).recip(),
        };
        [row(self.right, centre.x, half.x), row(self.up, centre.y, half.y), z, unit]
    }

    /// An orthographic view from the same eye along the same axis, between depths; its half height is half of that range.
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

    /// The same view with the eye moved back along the view axis by `shift` world units: depths grow by `shift`, the frame keeps
    /// its slopes.
    pub(crate) fn moved_back(&self, shift: f64) -> Self {
        Self { eye: self.eye - self.forward * shift, ..*self }
    }
}

/// A distance `factor` times as large as an argument, both in the range of distances.
fn scaled(field: &'static str, value: f64, factor: f64) -> Result<f64, InputError> {
    check::distance(field, factor * check::distance(field, value)?).map_err(|error| {
        let (least, most) = (MIN_DISTANCE / factor, MAX_COORDINATE / factor);
        error.got(value).expected(Expected::Within { least, most })
    })
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
            let error = InputError::new("up", InputErrorKind::Parallel);
            let error = error.expected(Expected::NotParallel { field: "forward" });
            return Err(error.hinted(Some(Hint::StraightUpOrDown)));
        }
        let right = right.normalize();
        Ok(Self { right, up: right.cross(forward), forward })
    }
}
