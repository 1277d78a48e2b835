//! How a shadow map is read.

/// How a shadow map is read for a point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Filter {
    /// The one texel that the point lies in.
    Nearest,
    /// The four texels around it, compared and blended by the sampler.
    #[default]
    Hardware2x2,
    /// The mean over so many texels across and down, each compared (percentage-closer filtering: Reeves, Salesin & Cook
    /// 1987); 0 is read as 1.
    Pcf(u8),
}

impl Filter {
    /// How far from a point the middles of the texels lie that are read for it, at most, across and down, in texels.
    #[must_use]
    pub fn reach(self) -> f64 {
        match self {
            Self::Nearest => 0.5,
            Self::Hardware2x2 => 1.0,
            Self::Pcf(taps) => 0.5 * f64::from(taps.max(1)),
        }
    }

    /// The border of a map, in texels, that it can read into beyond what is visible: its reach, rounded up.
    #[must_use]
    pub fn border(self) -> u32 {
        match self {
            Self::Nearest | Self::Hardware2x2 => 1,
            Self::Pcf(taps) => u32::from(taps.max(1)).div_ceil(2),
        }
    }
}
