//! The budget of a plan.

use crate::error::{InputError, InputErrorKind, check};
use crate::map::quality::DepthFormat;
use crate::settings::Settings;
use crate::settings::filter::Filter;

/// What a plan may spend, and what counts as fine enough.
///
/// ```
/// use shadowfit::{DepthFormat, Filter, Settings, plan::Budget};
///
/// let budget = Budget::new(Settings::new(2048, 1080)?)
///     .with_format(DepthFormat::Float32)
///     .with_filter(Filter::Pcf(5))
///     .with_aliasing(2.0)?
///     .with_texels(16 << 20);
/// assert_eq!((budget.format(), budget.filter()), (DepthFormat::Float32, Filter::Pcf(5)));
/// assert_eq!((budget.aliasing(), budget.texels()), (2.0, 16 << 20));
/// assert_eq!(budget.settings().map_size(), 2048);
/// # Ok::<(), shadowfit::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(try_from = "stored::Budget"))]
pub struct Budget {
    settings: Settings,
    format: DepthFormat,
    filter: Filter,
    aliasing: f64,
    texels: u64,
}

impl Budget {
    /// The smallest map that is worth a pass, in texels a side.
    pub const SMALLEST_MAP: u32 = 64;

    /// A budget with these settings: their warp, clip space and origin, and their size as the largest.
    ///
    /// Maps are square and no larger than the shorter side of the settings ([`Settings::map_size`]). None has another
    /// warp than theirs, and none is warped where they say [`Warp::Uniform`](crate::Warp::Uniform) or
    /// [`Warp::Stable`](crate::Warp::Stable). The back-shift of [`Warp::Perspective`](crate::Warp::Perspective) is chosen
    /// by the plan, and the border is as wide as the filter needs.
    ///
    /// By default depth has 24 bits, the filter is the sampler's 2 × 2, a texel as large as a pixel is fine enough, and
    /// all maps together may have as many texels as they need.
    ///
    /// ```
    /// use shadowfit::{DepthFormat, Filter, Settings, plan::Budget};
    ///
    /// let budget = Budget::new(Settings::default());
    /// assert_eq!((budget.format(), budget.filter()), (DepthFormat::Unorm24, Filter::Hardware2x2));
    /// assert_eq!((budget.aliasing(), budget.texels()), (1.0, u64::MAX));
    /// ```
    #[must_use]
    pub fn new(settings: Settings) -> Self {
        Self { settings, format: DepthFormat::Unorm24, filter: Filter::default(), aliasing: 1.0, texels: u64::MAX }
    }

    /// The same budget with another depth format.
    #[must_use]
    pub const fn with_format(self, format: DepthFormat) -> Self {
        Self { format, ..self }
    }

    /// The same budget with another widest filter.
    #[must_use]
    pub const fn with_filter(self, filter: Filter) -> Self {
        Self { filter, ..self }
    }

    /// The same budget with the aliasing that is fine enough: the longest side of a texel over that of a pixel.
    ///
    /// # Errors
    ///
    /// Names `"aliasing"` when it is not a positive number.
    ///
    /// ```
    /// use shadowfit::{Settings, plan::Budget};
    ///
    /// let budget = Budget::new(Settings::default());
    /// assert_eq!(budget.with_aliasing(2.0)?.aliasing(), 2.0);
    /// assert!(budget.with_aliasing(0.0).is_err());
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    pub fn with_aliasing(self, aliasing: f64) -> Result<Self, InputError> {
        match aliasing.is_finite() {
            false => check::fail("aliasing", InputErrorKind::NotFinite),
            true if aliasing < 1e-3 => check::fail("aliasing", InputErrorKind::TooSmall),
            true => Ok(Self { aliasing, ..self }),
        }
    }

    /// The same budget with the most texels that the maps of all lights may have together. Maps are made smaller to keep
    /// to it, the largest first, down to [`Self::SMALLEST_MAP`] a side.
    ///
    /// ```
    #[doc = include_str!("../examples/plan.txt")]
    /// let plan = plan(&view, &lights, &objects, &budget.with_texels(256 * 256));
    /// assert!(plan.texels() <= 256 * 256);
    /// assert!(plan.lights()[0].reasons().contains(&Reason::OverBudget(256)));
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub const fn with_texels(self, texels: u64) -> Self {
        Self { texels, ..self }
    }

    /// How maps are fitted.
    #[must_use]
    pub const fn settings(&self) -> &Settings {
        &self.settings
    }

    /// The depth format.
    #[must_use]
    pub const fn format(&self) -> DepthFormat {
        self.format
    }

    /// The widest filter.
    #[must_use]
    pub const fn filter(&self) -> Filter {
        self.filter
    }

    /// The aliasing that is fine enough, see [`Self::with_aliasing`].
    #[must_use]
    pub const fn aliasing(&self) -> f64 {
        self.aliasing
    }

    /// The most texels of all maps together.
    #[must_use]
    pub const fn texels(&self) -> u64 {
        self.texels
    }
}

/// A budget as it is stored: the same values, checked again when they are read.
#[cfg(feature = "serde")]
mod stored {
    use super::{DepthFormat, Filter, InputError, Settings};

    #[derive(serde::Deserialize)]
    pub(super) struct Budget {
        settings: Settings,
        format: DepthFormat,
        filter: Filter,
        aliasing: f64,
        texels: u64,
    }

    impl TryFrom<Budget> for super::Budget {
        type Error = InputError;
        fn try_from(budget: Budget) -> Result<Self, InputError> {
            let Budget { settings, format, filter, aliasing, texels } = budget;
            let checked = Self::new(settings).with_aliasing(aliasing)?;
            Ok(checked.with_format(format).with_filter(filter).with_texels(texels))
        }
    }
}
