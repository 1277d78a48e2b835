//! The asymmetric frame of a headset's camera.

use crate::error::{Hint, InputError, check};
use crate::math::angle;
use core::f64::consts::{FRAC_PI_2, PI};

/// The sides of a perspective image as signed tangents of their angles to the view axis; left and bottom are negative where the
/// axis is in the image.
///
/// OpenVR's `GetProjectionRaw` has y down: pass its top, a negative number, as `bottom`, and its bottom as `top`.
///
/// ```
/// use shadowfit::{View, input::Tangents};
///
/// let tangents = Tangents { left: -1.2, right: 0.9, bottom: -1.0, top: 1.1 };
/// let view = View::from_tangents((0.0, 1.7, 0.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0), tangents, 0.05, 500.0)?;
/// assert!((view.half_height(2.0) - 2.1).abs() < 1e-12);
/// # Ok::<(), shadowfit::InputError>(())
/// ```
#[doc(alias = "XrFovf")]
#[doc(alias = "GetProjectionRaw")]
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Tangents {
    /// The tangent of the left side; less than [`Self::right`].
    pub left: f64,
    /// The tangent of the right side.
    pub right: f64,
    /// The tangent of the bottom; less than [`Self::top`].
    pub bottom: f64,
    /// The tangent of the top.
    pub top: f64,
}

impl Tangents {
    /// The tangents of signed angles in radians, as in OpenXR's `XrFovf`: `angleLeft`, `angleRight`, `angleDown`, `angleUp`.
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
            let degrees = angle.abs() > 2.0 * PI && angle.abs() < 90.0;
            check::angle(field, angle, -FRAC_PI_2, FRAC_PI_2)
                .map_err(|error| error.hinted(degrees.then_some(Hint::Degrees)))?;
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
