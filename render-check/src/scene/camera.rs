//! A perspective camera.

use anyhow::{Context, Result};
use shadowfit::View;
use shadowfit::glam::DVec3;

/// The direction from the scene's middle to the default camera: in front, to the right and above.
const DEFAULT_DIRECTION_TO_EYE: DVec3 = DVec3::new(0.55, 0.45, 0.8);

/// A perspective camera, not yet validated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Position, in world space.
    pub eye: DVec3,
    /// View direction, of unit length.
    pub forward: DVec3,
    /// Approximate up direction; not parallel to `forward`.
    pub up: DVec3,
    /// The vertical field of view, in radians.
    pub fov_y: f64,
    /// The near plane's distance, if given.
    pub near: Option<f64>,
    /// The far plane's distance, if given; may be infinite.
    pub far: Option<f64>,
}

impl Camera {
    /// A camera at `eye` that looks at `target`, with y up.
    ///
    /// # Errors
    ///
    /// When the two are the same point.
    pub fn looking_at(eye: DVec3, target: DVec3, fov_y: f64) -> Result<Self> {
        let forward = (target - eye).try_normalize().context("the eye is at its target: move --eye or --target")?;
        // Looking straight up or down y cannot be up: −z is then, as on a map.
        let up = if forward.y.abs() > 0.999 { DVec3::NEG_Z } else { DVec3::Y };
        Ok(Self { eye, forward, up, fov_y, near: None, far: None })
    }

    /// A camera that shows a whole box in an image of this aspect ratio.
    ///
    /// # Errors
    ///
    /// When the box has no extent.
    pub fn showing(min: DVec3, max: DVec3, fov_y: f64, aspect: f64) -> Result<Self> {
        let centre = 0.5 * (min + max);
        let radius = 0.5 * (max - min).length();
        let half_angle = (0.5 * fov_y).min((aspect * (0.5 * fov_y).tan()).atan());
        let distance = radius / half_angle.sin();
        Self::looking_at(centre + distance * DEFAULT_DIRECTION_TO_EYE.normalize(), centre, fov_y)
    }

    /// The view of this camera with these near and far planes.
    ///
    /// # Errors
    ///
    /// When camera or planes are invalid.
    pub fn view(&self, aspect: f64, near: f64, far: f64) -> Result<View> {
        View::perspective(self.eye, self.forward, self.up, self.fov_y, aspect, near, far)
            .context("the camera cannot be used")
    }
}
