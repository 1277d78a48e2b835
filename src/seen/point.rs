//! A point of a surface that the camera sees.

use crate::error::{Expected, InputError, InputErrorKind, check};
use glam::DVec3;

/// A point of a surface that the camera sees, for [`Seen::from_points`](crate::seen::Seen::from_points).
///
/// ```
/// use shadowfit::{glam::DVec3, seen::{Seen, SeenPoint}};
///
/// let ground = SeenPoint { position: DVec3::new(0.0, 0.0, -8.0), normal: Some(DVec3::Y), pixels: 4000.0 };
/// assert!(Seen::from_points(&[ground]).is_ok());
/// let error = Seen::from_points(&[ground, SeenPoint { pixels: 0.0, ..ground }]).unwrap_err();
/// assert_eq!(error.to_string(), "points[1].pixels must lie in (0, ∞); got 0");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SeenPoint {
    /// Its position in world space.
    pub position: DVec3,
    /// The surface's normal on the side of the camera, of any length; `None` where it is not known.
    pub normal: Option<DVec3>,
    /// How many pixels it stands for; only ratios matter.
    pub pixels: f64,
}

impl SeenPoint {
    /// Checked at the door, as an entry of a list.
    pub(super) fn checked(&self, index: usize) -> Result<(), InputError> {
        let at = |error: InputError| error.of_list("points", index);
        check::point("points", self.position).map_err(at)?;
        if let Some(normal) = self.normal {
            check::direction("points", normal).map_err(|error| at(error.of_component("normal")))?;
        }
        if self.pixels > 0.0 && self.pixels.is_finite() {
            return Ok(());
        }
        let kind = if self.pixels.is_finite() { InputErrorKind::TooSmall } else { InputErrorKind::NotFinite };
        let error = InputError::new("points", kind).got(self.pixels).of_component("pixels");
        Err(at(error.expected(Expected::Between { above: 0.0, below: f64::INFINITY })))
    }
}
