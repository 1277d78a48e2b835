//! The filter that a shadow map is read with.

/// The filter that a shadow map is read with: bias, border and overlap of cube faces depend on its size.
///
/// ```
/// use shadowfit::{Filter, Settings};
///
/// let filter = Filter::Pcf(5); // 5 × 5 texels
/// assert_eq!((filter.reach(), filter.border()), (2.5, 3));
/// assert_eq!((Filter::Hardware2x2.reach(), Filter::Hardware2x2.border()), (1.0, 1));
/// let settings = Settings::new(2048, 1080)?.with_border(filter.border())?;
/// assert_eq!(settings.border(), 3);
/// # Ok::<(), shadowfit::InputError>(())
/// ```
#[doc(alias = "PCF")]
#[doc(alias = "percentage-closer filtering")]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Filter {
    /// The texel that the point lies in.
    Nearest,
    /// A comparison sampler: the four nearest texels, compared and blended.
    #[doc(alias = "comparison sampler")]
    #[default]
    Hardware2x2,
    /// The mean of n × n compared texels (percentage-closer filtering: Reeves, Salesin & Cook 1987); 0 counts as 1.
    #[doc(alias = "percentage-closer filtering")]
    Pcf(u8),
}

impl Filter {
    /// The largest distance from a point to the centres of the texels read for it, across or down, in texels.
    #[must_use]
    pub fn reach(self) -> f64 {
        match self {
            Self::Nearest => 0.5,
            Self::Hardware2x2 => 1.0,
            Self::Pcf(taps) => 0.5 * f64::from(taps.max(1)),
        }
    }

    /// The border around the receivers that the filter needs, in texels: [`Self::reach`] rounded up.
    #[must_use]
    pub fn border(self) -> u32 {
        match self {
            Self::Nearest | Self::Hardware2x2 => 1,
            Self::Pcf(taps) => u32::from(taps.max(1)).div_ceil(2),
        }
    }
}
