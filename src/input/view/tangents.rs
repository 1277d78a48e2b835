//! The frame of a perspective camera as headset runtimes give it.

use crate::error::{InputError, InputErrorKind, check};
use crate::math::angle;

/// The four sides of a perspective image: tangents of the angles between each and the view's axis, signed. Left and bottom
/// are negative where the axis is in the image.
///
/// OpenVR's `GetProjectionRaw` gives them with y down: its top is the `bottom` here, which it gives a negative number, and
/// its bottom the `top`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Tangents {
    /// Of the left side; less than that of the right one.
    pub left: f64,
    /// Of the right side.
    pub right: f64,
    /// Of the bottom; less than that of the top.
    pub bottom: f64,
    /// Of the top.
    pub top: f64,
}

impl Tangents {
    /// From signed angles in radians, as OpenXR's `XrFovf` has them (`angleLeft`, `angleRight`, `angleDown`, `angleUp`).
    ///
    /// ```
    /// use shadowfit::input::Tangents;
    ///
    /// let quarter = std::f64::consts::FRAC_PI_4;
    /// let tangents = Tangents::from_angles(-quarter, quarter, -quarter, 0.0)?;
    /// assert!((tangents.left + 1.0).abs() < 1e-15 && tangents.top == 0.0);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// Names the side whose angle is not between −π/2 and π/2.
    pub fn from_angles(left: f64, right: f64, bottom: f64, top: f64) -> Result<Self, InputError> {
        let tangent = |field: &'static str, angle: f64| {
            if angle.is_nan() || angle.abs() >= core::f64::consts::FRAC_PI_2 {
                return check::fail(field, InputErrorKind::AngleOutOfRange);
            }
            let (sine, cosine) = angle::sine_cosine(angle.abs());
            Ok(if angle < 0.0 { -sine / cosine } else { sine / cosine })
        };
        Ok(Self {
            left: tangent("left", left)?,
            right: tangent("right", right)?,
            bottom: tangent("bottom", bottom)?,
            top: tangent("top", top)?,
        })
    }
}
