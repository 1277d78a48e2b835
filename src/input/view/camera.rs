//! Cameras with named fields.

use super::View;
use crate::error::InputError;

/// A perspective camera with a symmetric frame: the arguments of [`View::perspective`] by name.
///
/// ```
/// use shadowfit::{View, input::PerspectiveCamera};
///
/// let camera = PerspectiveCamera {
///     eye: [0.0, 1.7, 0.0],
///     forward: [0.0, -0.2, -1.0],
///     up: [0.0, 1.0, 0.0],
///     fov_y: 1.0,
///     aspect: 1.6,
///     near: 0.1,
///     far: 500.0,
/// };
/// let view = View::perspective((0.0, 1.7, 0.0), (0.0, -0.2, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.1, 500.0)?;
/// assert_eq!(camera.view()?, view);
/// # Ok::<(), shadowfit::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PerspectiveCamera {
    /// The position, in world space.
    pub eye: [f64; 3],
    /// The direction of the view, in world space, of any length.
    pub forward: [f64; 3],
    /// The up direction, in world space, of any length and not parallel to `forward`.
    pub up: [f64; 3],
    /// The full vertical field of view in radians.
    pub fov_y: f64,
    /// Width of the image over its height.
    pub aspect: f64,
    /// Depth of the near plane along `forward`, in world units.
    pub near: f64,
    /// Depth of the far plane; may be infinite.
    pub far: f64,
}

impl PerspectiveCamera {
    /// The view of the camera.
    ///
    /// # Errors
    ///
    /// As [`View::perspective`].
    pub fn view(&self) -> Result<View, InputError> {
        let Self { eye, forward, up, fov_y, aspect, near, far } = *self;
        View::perspective(eye, forward, up, fov_y, aspect, near, far)
    }
}

/// An orthographic camera with a symmetric frame: the arguments of [`View::orthographic`] by name.
///
/// ```
/// use shadowfit::{View, input::OrthographicCamera};
///
/// let camera = OrthographicCamera {
///     eye: [0.0, 50.0, 0.0],
///     forward: [0.0, -1.0, 0.0],
///     up: [0.0, 0.0, -1.0],
///     half_height: 20.0,
///     aspect: 1.6,
///     near: 0.0,
///     far: 60.0,
/// };
/// assert_eq!(camera.view()?.half_height(0.0), 20.0);
/// # Ok::<(), shadowfit::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrthographicCamera {
    /// The position, in world space: depths count from it.
    pub eye: [f64; 3],
    /// The direction of the view, in world space, of any length.
    pub forward: [f64; 3],
    /// The up direction, in world space, of any length and not parallel to `forward`.
    pub up: [f64; 3],
    /// Half the height of the image, in world units.
    pub half_height: f64,
    /// Width of the image over its height.
    pub aspect: f64,
    /// Depth of the near plane along `forward`, in world units, of either sign.
    pub near: f64,
    /// Depth of the far plane.
    pub far: f64,
}

impl OrthographicCamera {
    /// The view of the camera.
    ///
    /// # Errors
    ///
    /// As [`View::orthographic`].
    pub fn view(&self) -> Result<View, InputError> {
        let Self { eye, forward, up, half_height, aspect, near, far } = *self;
        View::orthographic(eye, forward, up, half_height, aspect, near, far)
    }
}
