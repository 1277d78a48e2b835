//! How a fit is made.

use crate::clip_space::ClipSpace;
use crate::error::{InputError, Problem, check};
use crate::focus::Form;

/// What the map's texels are spread by: the covector c that becomes w.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Warp {
    /// No warp: a parallel projection for a directional light, a perspective one from any other.
    Uniform,
    /// The camera's perspective (Stamminger & Drettakis 2002): texels shrink towards the eye, from the view's near plane
    /// on. A near plane in the air before all that is seen draws them there, and a uniform map may then be better: narrow
    /// the view to what is seen ([`View::narrowed`](crate::View::narrowed)).
    #[default]
    Perspective,
}

/// Where the camera stands whose perspective warps the map; it makes no difference to a uniform one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Shift {
    /// Where the view has it. Casters behind the eye are in the map all the same.
    None,
    /// Moved back until this form of H lies before it (Stamminger & Drettakis 2002, §4.2), which weakens the warp.
    Back(Form),
}

impl Default for Shift {
    /// As the paper has it. On outdoor views the median of the worst aliasing, over the uniform map's, is 0.45 with it
    /// and 0.73 without (the `survey` example).
    fn default() -> Self {
        Self::Back(Form::Paper)
    }
}

/// What the f32 matrices take positions relative to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Origin {
    /// World space.
    #[default]
    World,
    /// The eye of the view, with the world's axes: what a renderer of large worlds uploads, with positions that it
    /// subtracted the eye from in f64.
    Eye,
}

/// How a fit is made. The default is a warped map of 2048² texels for an image 1080 pixels high, world space, wgpu's
/// clip space.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(try_from = "stored::Settings"))]
pub struct Settings {
    map_size: u32,
    image_height: u32,
    border: u32,
    warp: Warp,
    shift: Shift,
    clip: ClipSpace,
    origin: Origin,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            map_size: 2048,
            image_height: 1080,
            border: 1,
            warp: Warp::default(),
            shift: Shift::default(),
            clip: ClipSpace::default(),
            origin: Origin::default(),
        }
    }
}

impl Settings {
    /// The largest map and image, in texels and pixels a side.
    pub const MAX_SIZE: u32 = 1 << 16;

    /// Settings for a square map of `map_size` texels a side and an image `image_height` pixels high.
    ///
    /// # Errors
    ///
    /// Names the field that is below 4 or above [`Self::MAX_SIZE`].
    pub fn new(map_size: u32, image_height: u32) -> Result<Self, InputError> {
        for (field, size) in [("map_size", map_size), ("image_height", image_height)] {
            if size < 4 {
                return check::fail(field, Problem::TooSmall);
            }
            if size > Self::MAX_SIZE {
                return check::fail(field, Problem::TooLarge);
            }
        }
        Ok(Self { map_size, image_height, ..Self::default() })
    }

    /// The same for a map of another size, in texels a side.
    ///
    /// # Errors
    ///
    /// As [`Self::new`], and names `"border"` when the border is too wide for it.
    pub fn with_map_size(self, map_size: u32) -> Result<Self, InputError> {
        let Self { map_size, .. } = Self::new(map_size, self.image_height)?;
        Self { map_size, ..self }.with_border(self.border)
    }

    /// The same with a border of so many texels around what is visible, for filters to reach into; 1 by default.
    ///
    /// # Errors
    ///
    /// Names `"border"` when less than half of the map would be left.
    pub fn with_border(self, border: u32) -> Result<Self, InputError> {
        if border > self.map_size / 4 {
            return check::fail("border", Problem::TooLarge);
        }
        Ok(Self { border, ..self })
    }

    /// The same with a warp.
    #[must_use]
    pub const fn with_warp(self, warp: Warp) -> Self {
        Self { warp, ..self }
    }

    /// The same with a back-shift of the warp's camera.
    #[must_use]
    pub const fn with_shift(self, shift: Shift) -> Self {
        Self { shift, ..self }
    }

    /// The same with the clip convention that the matrices are for.
    #[must_use]
    pub const fn with_clip(self, clip: ClipSpace) -> Self {
        Self { clip, ..self }
    }

    /// The same with what the f32 matrices take positions relative to.
    #[must_use]
    pub const fn with_origin(self, origin: Origin) -> Self {
        Self { origin, ..self }
    }

    /// Texels a side of the map.
    #[must_use]
    pub const fn map_size(&self) -> u32 {
        self.map_size
    }

    /// Height of the image in pixels.
    #[must_use]
    pub const fn image_height(&self) -> u32 {
        self.image_height
    }

    /// Texels around what is visible.
    #[must_use]
    pub const fn border(&self) -> u32 {
        self.border
    }

    /// The part of the map inside its border.
    pub(crate) fn inner(&self) -> f64 {
        1.0 - 2.0 * f64::from(self.border) / f64::from(self.map_size)
    }

    /// The warp.
    #[must_use]
    pub const fn warp(&self) -> Warp {
        self.warp
    }

    /// The back-shift.
    #[must_use]
    pub const fn shift(&self) -> Shift {
        self.shift
    }

    /// The clip convention.
    #[must_use]
    pub const fn clip(&self) -> ClipSpace {
        self.clip
    }

    /// What the f32 matrices take positions relative to.
    #[must_use]
    pub const fn origin(&self) -> Origin {
        self.origin
    }
}

/// Settings as they are stored: the same values, checked again when they are read.
#[cfg(feature = "serde")]
mod stored {
    use super::{ClipSpace, InputError, Origin, Shift, Warp};

    #[derive(serde::Deserialize)]
    pub(super) struct Settings {
        map_size: u32,
        image_height: u32,
        border: u32,
        warp: Warp,
        shift: Shift,
        clip: ClipSpace,
        origin: Origin,
    }

    impl TryFrom<Settings> for super::Settings {
        type Error = InputError;
        fn try_from(settings: Settings) -> Result<Self, InputError> {
            let Settings { map_size, image_height, border, warp, shift, clip, origin } = settings;
            let checked = Self::new(map_size, image_height)?.with_border(border)?;
            Ok(checked.with_warp(warp).with_shift(shift).with_clip(clip).with_origin(origin))
        }
    }
}
