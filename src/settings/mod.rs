//! Settings of a fit.

pub(crate) mod fallback;
pub(crate) mod filter;
pub(crate) mod objective;

use crate::error::{Expected, InputError, check};
use crate::focus::FocusForm;
use crate::input::clip_space::ClipSpace;
use crate::input::light::Light;
use crate::input::view::View;
use glam::{DVec2, DVec3};
pub use objective::Objective;

/// The warp: how texels are distributed, as the covector c that becomes w (`docs/warps.md` compares them).
///
/// A warp that cannot be made falls back to the uniform map ([`ShadowMap::fallback`](crate::ShadowMap::fallback)).
///
/// ```
/// use shadowfit::{Focus, Light, Scene, Settings, View, Warp};
///
/// let view = View::perspective((0.0, 1.7, 0.0), (0.0, -0.2, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.1, 200.0)?;
/// let scene = Scene::from_box((-200.0, 0.0, -200.0), (200.0, 10.0, 200.0))?;
/// let focus = Focus::new(&view.narrowed_to(&scene).expect("in view"), &Light::directional((1.0, 1.0, 0.0))?, &scene);
/// let worst = |warp| focus.fit(&Settings::default().with_warp(warp)).into_map().map(|map| map.report(&focus).aliasing);
/// assert!(worst(Warp::default()) < worst(Warp::LightSpace) && worst(Warp::LightSpace) < worst(Warp::Uniform));
/// # Ok::<(), shadowfit::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Warp {
    /// No warp: a parallel projection for a directional light, a perspective one for a local light.
    #[doc(alias = "standard shadow map")]
    Uniform,
    /// The camera's perspective: perspective shadow maps (Stamminger & Drettakis 2002). Texels shrink towards the eye, from the
    /// view's near plane on. With a near plane in the air, far before the first receiver, a uniform map may be better: narrow the
    /// view ([`View::narrowed_to`](crate::View::narrowed_to)).
    #[doc(alias = "PSM")]
    #[doc(alias = "perspective shadow map")]
    Perspective,
    /// The light-space perspective (Wimmer, Scherzer & Purgathofer 2004): it runs across the light, along the view as the light
    /// sees it, with their n. It fades to uniform as the light turns into the view; orthographic views fall back.
    #[doc(alias = "LiSPSM")]
    #[doc(alias = "LSPSM")]
    #[doc(alias = "light-space perspective shadow map")]
    LightSpace,
    /// The trapezoidal map (Martin & Tan 2004): the trapezoid around R as the light sees it, with four fifths of the map for its
    /// part next to the viewer, up to a fifth of the depths of R. It does not fade as the light turns into the view: its direction
    /// jumps there, and a light along the view falls back.
    #[doc(alias = "TSM")]
    #[doc(alias = "trapezoidal shadow map")]
    Trapezoidal,
    /// No warp, and texels snapped to the world, so that shadow edges do not shimmer as the camera moves and turns (Valient,
    /// *Stable Rendering of Cascaded Shadow Maps*, ShaderX6, 2008). Stability before sharpness; the back-shift plays no part.
    ///
    /// Under a directional light the window holds a ball around V, or S across the light where that is narrower, and moves by
    /// whole texels. For a spot, a pyramid or a cube face it is the light's region, and x, y and w of the matrix never change.
    /// Lights and views that have no such map fall back, see [`WarpFallback`](crate::WarpFallback).
    ///
    /// Keep field of view, aspect, near, far, map size, border and light direction as they are: a change of any makes another
    /// grid, and all texels move at once. Narrow the view to the maximum shadow distance ([`View::narrowed`](crate::View::narrowed)),
    /// move a sun in steps, and far from the origin use [`Origin::Eye`] (`docs/warps.md`, "Stabilised maps").
    #[doc(alias = "texel snapping")]
    #[doc(alias = "shimmering")]
    #[doc(alias = "crawling")]
    #[doc(alias = "stabilised")]
    Stable,
    /// The best single matrix that a search of this effort finds, over the warp and over turn and shear of the window.
    ///
    /// It minimises the mean error at the surfaces in view, or the worst ([`Objective`]): texels and bias in pixels, starting from all
    /// closed forms, of which none has a smaller error. Surfaces are those that the focus knows of: seen ones
    /// ([`Focus::with_seen`](crate::Focus::with_seen)), listed boxes, or anything in R.
    ///
    /// From frame to frame the search may end in another local minimum. Fitted from the previous map
    /// ([`Focus::fit_warm`](crate::Focus::fit_warm)) it stays in its own, and costs less.
    #[doc(alias = "optimal")]
    Best(Effort),
}

impl Default for Warp {
    /// [`Self::Best`] with [`Effort::Good`].
    fn default() -> Self {
        Self::Best(Effort::default())
    }
}

#[cfg(feature = "alloc")]
impl Warp {
    /// Whether texels are distributed unevenly.
    pub(crate) const fn bends(self) -> bool {
        !matches!(self, Self::Uniform | Self::Stable)
    }
}

/// The effort of the search of [`Warp::Best`]: accuracy for time.
///
/// Error at visible surfaces over that of an exhaustive search, on outdoor views, median and 95th percentile, and the instructions of
/// a fit over those of a uniform fit (`cargo test --test fit best -- --nocapture`, `cargo bench --bench instructions`):
///
/// | | sun | point light | spot | times as long |
/// |---|---|---|---|---|
/// | `ClosedForms` | 1.18, 1.87 | 1.24, 4.11 | 1.32, 2.72 | 4 to 6 |
/// | `Rough` | 1.020, 1.11 | 1.023, 1.21 | 1.011, 1.21 | 6 to 11 |
/// | `Good` | 1.008, 1.048 | 1.008, 1.036 | 1.005, 1.20 | 10 to 20 |
/// | `Thorough` | 1.005, 1.032 | 1.007, 1.022 | 1.004, 1.20 | 12 to 26 |
///
/// ```
/// use shadowfit::{Effort, Settings, Warp};
///
/// let settings = Settings::default().with_warp(Warp::Best(Effort::Rough));
/// assert_eq!((settings.warp(), Warp::default()), (Warp::Best(Effort::Rough), Warp::Best(Effort::Good)));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Effort {
    /// The best of the closed forms, each in its own frame; in a map that is not square also turned by 90°.
    ClosedForms,
    /// The best closed form, refined with eight steps.
    Rough,
    /// Two starts, the better one refined to the end. In a map that is not square four, and the better two.
    #[default]
    Good,
    /// All starts refined to the end.
    Thorough,
}

/// The back-shift of the virtual camera of [`Warp::Perspective`], and of [`Warp::Best`], which tries that warp among others.
///
/// ```
/// use shadowfit::{FocusForm, Settings, warp::Shift};
///
/// assert_eq!(Settings::default().shift(), Shift::Back(FocusForm::ViewHull));
/// assert_eq!(Settings::default().with_shift(Shift::None).shift(), Shift::None);
/// ```
#[doc(alias = "back-shift")]
#[doc(alias = "virtual camera")]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Shift {
    /// The view's own camera. Casters behind the eye are in the map all the same.
    None,
    /// The camera moved back until this form of H lies in front of it (Stamminger & Drettakis 2002, §4.2), which weakens the warp.
    Back(FocusForm),
}

impl Default for Shift {
    /// The paper's. On random outdoor views it is coarser than the uniform map in fewer cases than without a shift (`docs/warps.md`).
    fn default() -> Self {
        Self::Back(FocusForm::ViewHull)
    }
}

/// The origin of the positions that f32 matrices take: world space, or camera-relative or light-relative positions.
///
/// Positions far from the world's origin lose digits in f32. Subtract [`ShadowMap::origin`](crate::ShadowMap::origin) from them in
/// f64, then upload them in f32.
///
/// ```
/// use shadowfit::{Light, Origin, Scene, Settings, View, fit};
///
/// let view = View::perspective((6e6, 1.7, 0.0), (0.0, -0.2, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.1, 200.0)?;
/// let scene = Scene::from_box((6e6 - 50.0, 0.0, -50.0), (6e6 + 50.0, 10.0, 50.0))?;
/// let settings = Settings::default().with_origin(Origin::Eye);
/// let outcome = fit(&view, &Light::directional((0.4, 1.0, 0.2))?, &scene, &settings);
/// assert_eq!(outcome.map().expect("a map").origin(), view.eye());
/// # Ok::<(), shadowfit::InputError>(())
/// ```
#[doc(alias = "camera-relative rendering")]
#[doc(alias = "floating origin")]
#[doc(alias = "relative to eye")]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Origin {
    /// World space.
    #[default]
    World,
    /// The eye of the view, with the world's axes: camera-relative rendering.
    Eye,
    /// The position of a local light, with the world's axes; the eye for a directional light. A local light's map then has the same
    /// precision anywhere, where in world space it loses a digit at its near distance with every power of ten from the origin.
    Light,
}

impl Origin {
    /// The origin in world space.
    pub(crate) fn of(self, view: &View, light: &Light) -> DVec3 {
        match self {
            Self::World => DVec3::ZERO,
            Self::Eye => view.eye(),
            Self::Light => light.position().unwrap_or(view.eye()),
        }
    }
}

/// Settings of a fit: size of the map and of the image, border, warp, clip space, origin.
///
/// The default is a map of 2048² texels with a border of 1 for an image 1080 pixels high, [`Warp::Best`], wgpu's clip space and
/// world space.
///
/// ```
/// use shadowfit::{ClipSpace, FocusForm, Origin, Settings, Warp, warp::Shift};
///
/// let settings = Settings::default();
/// assert_eq!((settings.map_sides(), settings.map_size(), settings.border()), ((2048, 2048), 2048, 1));
/// assert_eq!((settings.image_height(), settings.warp()), (1080, Warp::default()));
/// assert_eq!((settings.clip(), settings.origin()), (ClipSpace::WGPU, Origin::World));
/// assert_eq!(settings.shift(), Shift::Back(FocusForm::ViewHull));
///
/// let changed = settings.with_warp(Warp::Stable).with_clip(ClipSpace::WGPU.reversed()).with_origin(Origin::Eye);
/// let changed = changed.with_shift(Shift::None);
/// assert_eq!((changed.warp(), changed.clip().depth.is_reversed()), (Warp::Stable, true));
/// assert_eq!((changed.origin(), changed.shift()), (Origin::Eye, Shift::None));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(try_from = "stored::Settings"))]
pub struct Settings {
    map_width: u32,
    map_height: u32,
    image_height: u32,
    border: u32,
    warp: Warp,
    shift: Shift,
    objective: Objective,
    clip: ClipSpace,
    origin: Origin,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            map_width: 2048,
            map_height: 2048,
            image_height: 1080,
            border: 1,
            warp: Warp::default(),
            shift: Shift::default(),
            objective: Objective::default(),
            clip: ClipSpace::default(),
            origin: Origin::default(),
        }
    }
}

impl Settings {
    /// The largest size of a map, in texels a side, and of an image, in pixels.
    pub const MAX_SIZE: u32 = 1 << 16;

    /// Settings for a square map of `map_size` texels a side and an image `image_height` pixels high; the rest as by default.
    ///
    /// ```
    /// use shadowfit::Settings;
    ///
    /// let settings = Settings::new(4096, 1440)?;
    /// assert_eq!((settings.map_size(), settings.image_height()), (4096, 1440));
    /// assert_eq!(Settings::new(1, 1440).unwrap_err().to_string(), "map_size must lie in [4, 65536]; got 1");
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// Names the field that is below 4 or above [`Self::MAX_SIZE`].
    pub fn new(map_size: u32, image_height: u32) -> Result<Self, InputError> {
        check_sizes([("map_size", map_size), ("image_height", image_height)])?;
        Ok(Self { map_width: map_size, map_height: map_size, image_height, ..Self::default() })
    }

    /// The settings with a square map of `map_size` texels a side.
    ///
    /// ```
    /// use shadowfit::Settings;
    ///
    /// assert_eq!(Settings::default().with_map_size(1024)?.map_sides(), (1024, 1024));
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// As [`Self::new`], and names `"border"` when the border is too wide for the map.
    pub fn with_map_size(self, map_size: u32) -> Result<Self, InputError> {
        check_sizes([("map_size", map_size)])?;
        self.with_map_sides(map_size, map_size)
    }

    /// The settings with a map `map_width` texels wide and `map_height` high, such as a tile of an atlas.
    ///
    /// The view's direction lies along the height of the map whatever its sides, and so do closed-form warps. Only [`Warp::Best`]
    /// adapts to the sides, and may turn the map.
    ///
    /// ```
    /// use shadowfit::Settings;
    ///
    /// let settings = Settings::default().with_map_sides(4096, 1024)?;
    /// assert_eq!((settings.map_sides(), settings.map_size()), ((4096, 1024), 1024));
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// Names `"map_width"` or `"map_height"` when it is below 4 or above [`Self::MAX_SIZE`], and `"border"` when the border
    /// is too wide for the shorter side.
    pub fn with_map_sides(self, map_width: u32, map_height: u32) -> Result<Self, InputError> {
        check_sizes([("map_width", map_width), ("map_height", map_height)])?;
        Self { map_width, map_height, ..self }.with_border(self.border)
    }

    /// The settings with a border of so many texels around the receivers, for filters to reach into
    /// ([`Filter::border`](crate::Filter::border)); 1 by default.
    ///
    /// ```
    /// use shadowfit::{Filter, Settings};
    ///
    /// assert_eq!(Settings::default().with_border(Filter::Pcf(7).border())?.border(), 4);
    /// assert!(Settings::default().with_border(1000).is_err());
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// Names `"border"` when it is more than a quarter of a side of the map.
    pub fn with_border(self, border: u32) -> Result<Self, InputError> {
        let most = (self.map_size() / 4).into();
        check::within("border", border.into(), Expected::Within { least: 0.0, most })?;
        Ok(Self { border, ..self })
    }

    /// The settings with a warp.
    #[must_use]
    pub const fn with_warp(self, warp: Warp) -> Self {
        Self { warp, ..self }
    }

    /// The settings with a back-shift of the virtual camera.
    #[must_use]
    pub const fn with_shift(self, shift: Shift) -> Self {
        Self { shift, ..self }
    }

    /// The settings with what [`Warp::Best`] minimises.
    #[must_use]
    pub const fn with_objective(self, objective: Objective) -> Self {
        Self { objective, ..self }
    }

    /// The settings with the clip convention of the resulting matrices.
    #[must_use]
    pub const fn with_clip(self, clip: ClipSpace) -> Self {
        Self { clip, ..self }
    }

    /// The settings with the origin of positions that f32 matrices take.
    #[must_use]
    pub const fn with_origin(self, origin: Origin) -> Self {
        Self { origin, ..self }
    }

    /// The size of the map in texels: the shorter side, that of the largest square in the map. Paraboloid maps and the planner,
    /// whose maps are square, use it.
    #[must_use]
    pub const fn map_size(&self) -> u32 {
        if self.map_width < self.map_height { self.map_width } else { self.map_height }
    }

    /// The width and height of the map in texels.
    #[must_use]
    pub const fn map_sides(&self) -> (u32, u32) {
        (self.map_width, self.map_height)
    }

    /// The sides of the map as floating-point numbers.
    pub(crate) fn sides(&self) -> DVec2 {
        DVec2::new(self.map_width.into(), self.map_height.into())
    }

    /// The settings for the largest square in the map.
    pub(crate) const fn squared(self) -> Self {
        let map_size = self.map_size();
        Self { map_width: map_size, map_height: map_size, ..self }
    }

    /// The height of the image in pixels.
    #[must_use]
    pub const fn image_height(&self) -> u32 {
        self.image_height
    }

    /// The border around the receivers, in texels.
    #[must_use]
    pub const fn border(&self) -> u32 {
        self.border
    }

    /// The part of the map within its border, across and down.
    pub(crate) fn inner(&self) -> DVec2 {
        1.0 - 2.0 * f64::from(self.border) / self.sides()
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

    /// What [`Warp::Best`] minimises.
    #[must_use]
    pub const fn objective(&self) -> Objective {
        self.objective
    }

    /// The clip convention.
    #[must_use]
    pub const fn clip(&self) -> ClipSpace {
        self.clip
    }

    /// The origin of positions that f32 matrices take.
    #[must_use]
    pub const fn origin(&self) -> Origin {
        self.origin
    }
}

/// Names the size that is out of range.
fn check_sizes<const N: usize>(sizes: [(&'static str, u32); N]) -> Result<(), InputError> {
    for (field, size) in sizes {
        check::within(field, size.into(), Expected::Within { least: 4.0, most: Settings::MAX_SIZE.into() })?;
    }
    Ok(())
}

/// The serialised form of settings, checked when it is read.
#[cfg(feature = "serde")]
mod stored {
    use super::{ClipSpace, InputError, Objective, Origin, Shift, Warp};

    #[derive(serde::Deserialize)]
    pub(super) struct Settings {
        map_width: u32,
        map_height: u32,
        image_height: u32,
        border: u32,
        warp: Warp,
        shift: Shift,
        objective: Objective,
        clip: ClipSpace,
        origin: Origin,
    }

    impl TryFrom<Settings> for super::Settings {
        type Error = InputError;
        fn try_from(settings: Settings) -> Result<Self, InputError> {
            let Settings { map_width, map_height, image_height, border, warp, shift, objective, clip, origin } =
                settings;
            let largest = Self::new(Self::MAX_SIZE, image_height)?;
            let checked = largest.with_map_sides(map_width, map_height)?.with_border(border)?;
            let checked = checked.with_warp(warp).with_shift(shift).with_objective(objective);
            Ok(checked.with_clip(clip).with_origin(origin))
        }
    }
}
