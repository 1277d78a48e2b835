//! How a fit is made.

pub(crate) mod fallback;
pub(crate) mod filter;

use crate::error::{Expected, InputError, check};
use crate::focus::FocusForm;
use crate::input::clip_space::ClipSpace;
use crate::input::light::Light;
use crate::input::view::View;
use glam::{DVec2, DVec3};

/// What the map's texels are spread by: the covector c that becomes w.
///
/// A warp that cannot be made leaves the uniform map, and the map says why ([`ShadowMap::fallback`](crate::ShadowMap::fallback)).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Warp {
    /// No warp: a parallel projection for a directional light, a perspective one from any other.
    Uniform,
    /// The camera's perspective (Stamminger & Drettakis 2002): texels shrink towards the eye, from the view's near plane
    /// on. A near plane in the air before all that is seen draws them there, and a uniform map may then be better: narrow
    /// the view to what is seen ([`View::narrowed`](crate::View::narrowed)).
    Perspective,
    /// The light-space perspective (Wimmer, Scherzer & Purgathofer 2004): the warp runs across the light, along the view as
    /// the light sees it, and is as strong as their formula for n says. It fades as the light turns into the view, and is
    /// refused for an orthographic one.
    LightSpace,
    /// The trapezoidal map (Martin & Tan 2004): the trapezoid around what is visible, as the light sees it, with four fifths
    /// of the map for the part that lies next to the viewer: up to a fifth of the visible depths. It does not fade as
    /// the light turns into the view, but keeps a warp whose direction jumps there; a light along the view is refused.
    Trapezoidal,
    /// No warp, and texels that stay where they are in the world while the camera moves and turns, for edges of shadows
    /// that do not crawl: steadiness before sharpness, as cascades are often made (Valient, *Stable Rendering of Cascaded
    /// Shadow Maps*, ShaderX6, 2008). The back-shift makes no difference to it.
    ///
    /// Under a directional light the map's axes are those of the light, whatever the view. The window has room for the
    /// view in all positions: a ball around V, or all of S across the light where that is narrower, each axis for itself.
    /// Its middle moves in whole texels of a grid through the world's origin. From a spot or a face of a cube the map is
    /// that of all that the light reaches, and x, y and w of its matrix do not change at all. Depth ranges grow and shrink
    /// in steps.
    ///
    /// **How to use it.** Keep what the texel's size is made of: the field of view, the aspect, near and far, the size and
    /// border of the map, and the direction of light. Another field of view, a zoom say, or another far plane makes another
    /// grid, all of which then changes at once. Narrow the view to the distance that shadows are drawn to
    /// ([`View::narrowed`](crate::View::narrowed)): the window is as large as all that is nearer, wherever the camera
    /// looks. A sun that moves turns the grid: move it in steps.
    ///
    /// **What f32 can do.** With [`Origin::Eye`] a point stays where it is among the texels to within
    /// [`Window::rounding`](crate::map::Window::rounding), also a thousand kilometres from the origin. With [`Origin::World`]
    /// coordinates far out are known to f32 by steps, and texels are made no smaller than those: by factors of two, so that
    /// the grid stays where it is but for every other line, as long as the camera does not travel as far again. What f32
    /// makes of a point's place in the map then is off by as much as the steps are, and by the same in each frame.
    ///
    /// Not every light has such a map, see [`WarpFallback`](crate::WarpFallback); it is the uniform one then.
    Stable,
    /// The best of all single matrices that a search of this effort finds: over the warp, and over turn and shear of the window.
    ///
    /// The search looks for the least worst aliasing over the vertices of what is visible and, under a light at a position, over the
    /// middles of its edges too ([`ShadowMap::aliasing_over`](crate::ShadowMap::aliasing_over) looks everywhere), from those of all closed forms
    /// on, of which the perspective warp comes with the back-shift of the settings. Points nearer to the eye than a 256th of the
    /// depth of the farthest, in the air before all that is seen most often, count as if they stood there.
    ///
    /// What is found is then mixed with the uniform map by as much as is best at points that stand for what is seen, where bias
    /// counts beside texels: a warp leans depth, and shadows begin farther behind their casters the more it does.
    /// [`ShadowMap::weakening`](crate::ShadowMap::weakening) says by how much, and 1 where the uniform map is better.
    ///
    /// From one frame to the next the search may end elsewhere; fitted from the map of the frame before
    /// ([`Focus::fit_warm`](crate::Focus::fit_warm)) it stays, and costs less.
    Best(Effort),
}

impl Default for Warp {
    /// The best single matrix, by a search of the usual effort.
    fn default() -> Self {
        Self::Best(Effort::default())
    }
}

#[cfg(feature = "alloc")]
impl Warp {
    /// Whether texels are spread unevenly.
    pub(crate) const fn bends(self) -> bool {
        !matches!(self, Self::Uniform | Self::Stable)
    }
}

/// How long to search for the best matrix: the price of its accuracy.
///
/// Worst aliasing over the least that an exhaustive search finds, on outdoor views, median and in 95 % of cases, and the time of
/// a fit over that of a uniform one, in instructions (`cargo test --test fit best -- --nocapture`, `cargo bench --bench instructions`):
///
/// | | sun | lamp | spot | times as long |
/// |---|---|---|---|---|
/// | `ClosedForms` | 1.21, 1.9 | 1.36, 2.6 | 1.28, 1.7 | 3 |
/// | `Rough` | 1.016, 1.13 | 1.020, 1.11 | 1.021, 1.13 | 5 to 6 |
/// | `Good` | 1.001, 1.007 | 1.002, 1.020 | 1.002, 1.018 | 12 to 17 |
/// | `Thorough` | 1.001, 1.006 | 1.001, 1.003 | 1.001, 1.014 | 17 to 26 |
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Effort {
    /// The best of the closed forms, in the frame that they have by themselves; in a map that is not square, in that and a
    /// quarter turn from it.
    ClosedForms,
    /// The best of them refined once, with eight steps.
    Rough,
    /// Two beginnings, the better of which is refined. In a map that is not square they are four, and the better two.
    #[default]
    Good,
    /// All refined to the end.
    Thorough,
}

/// Where the camera stands whose perspective warps the map, for [`Warp::Perspective`], and for [`Warp::Best`], which tries that
/// warp among others.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Shift {
    /// Where the view has it. Casters behind the eye are in the map all the same.
    None,
    /// Moved back until this form of H lies before it (Stamminger & Drettakis 2002, §4.2), which weakens the warp.
    Back(FocusForm),
}

impl Default for Shift {
    /// As the paper has it. On outdoor views the median of the worst aliasing, over the uniform map's, is 0.45 with it
    /// and 0.73 without (the `survey` example).
    fn default() -> Self {
        Self::Back(FocusForm::ViewHull)
    }
}

/// What the f32 matrices take positions relative to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Origin {
    /// World space.
    #[default]
    World,
    /// The eye of the view, with the world's axes: what a renderer of large worlds uploads, with positions that it
    /// subtracted the eye from in f64.
    Eye,
    /// The light, where it is at a position, with the world's axes, and the eye where it is directional: the numbers are smallest
    /// where they count. [`ShadowMap::origin`](crate::ShadowMap::origin) says what to subtract, in f64, before positions become f32.
    ///
    /// A lamp's map is then the same wherever in the world the lamp stands, where in world space it loses with every power of
    /// ten one digit of what there is at its near distance.
    Light,
}

impl Origin {
    /// Where it is, in world space.
    pub(crate) fn of(self, view: &View, light: &Light) -> DVec3 {
        match self {
            Self::World => DVec3::ZERO,
            Self::Eye => view.eye(),
            Self::Light => light.position().unwrap_or(view.eye()),
        }
    }
}

/// How a fit is made. The default is the best single matrix that is found, in a map of 2048² texels for an image 1080
/// pixels high, world space, wgpu's clip space.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(try_from = "stored::Settings"))]
pub struct Settings {
    map_width: u32,
    /// An option as it is stored: settings from when all maps were square are read as well.
    #[cfg_attr(feature = "serde", serde(serialize_with = "stored::some"))]
    map_height: u32,
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
            map_width: 2048,
            map_height: 2048,
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
        check_sizes([("map_size", map_size), ("image_height", image_height)])?;
        Ok(Self { map_width: map_size, map_height: map_size, image_height, ..Self::default() })
    }

    /// The same for a square map of another size, in texels a side.
    ///
    /// # Errors
    ///
    /// As [`Self::new`], and names `"border"` when the border is too wide for it.
    pub fn with_map_size(self, map_size: u32) -> Result<Self, InputError> {
        check_sizes([("map_size", map_size)])?;
        self.with_map_sides(map_size, map_size)
    }

    /// The same for a map so many texels wide and high, square or not: a tile of an atlas, say.
    ///
    /// The window is made to fit as in a square map, whatever the sides: what the view looks along lies along the map's height,
    /// and so do the closed forms' warps. Only [`Warp::Best`] looks for what makes the most of the sides, and may turn the map
    /// to it.
    ///
    /// # Errors
    ///
    /// Names `"map_width"` or `"map_height"` when it is below 4 or above [`Self::MAX_SIZE`], and `"border"` when the border
    /// is too wide for the shorter side.
    pub fn with_map_sides(self, map_width: u32, map_height: u32) -> Result<Self, InputError> {
        check_sizes([("map_width", map_width), ("map_height", map_height)])?;
        Self { map_width, map_height, ..self }.with_border(self.border)
    }

    /// The same with a border of so many texels around what is visible, for filters to reach into; 1 by default.
    ///
    /// # Errors
    ///
    /// Names `"border"` when less than half of a side of the map would be left.
    pub fn with_border(self, border: u32) -> Result<Self, InputError> {
        let most = (self.map_size() / 4).into();
        check::within("border", border.into(), Expected::Within { least: 0.0, most })?;
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

    /// Texels a side of a square map; of another, texels of its shorter side. It is the side of the largest square in the
    /// map, which is what paraboloid maps and the planner, whose maps are all square, take.
    #[must_use]
    pub const fn map_size(&self) -> u32 {
        if self.map_width < self.map_height { self.map_width } else { self.map_height }
    }

    /// Texels of the map across and down.
    #[must_use]
    pub const fn map_sides(&self) -> (u32, u32) {
        (self.map_width, self.map_height)
    }

    /// The same as numbers to reckon with.
    pub(crate) fn sides(&self) -> DVec2 {
        DVec2::new(self.map_width.into(), self.map_height.into())
    }

    /// The same for the largest square in the map.
    pub(crate) const fn squared(self) -> Self {
        let map_size = self.map_size();
        Self { map_width: map_size, map_height: map_size, ..self }
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

    /// The part of the map inside its border, across and down.
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

/// Names the size that is out of bounds.
fn check_sizes<const N: usize>(sizes: [(&'static str, u32); N]) -> Result<(), InputError> {
    for (field, size) in sizes {
        check::within(field, size.into(), Expected::Within { least: 4.0, most: Settings::MAX_SIZE.into() })?;
    }
    Ok(())
}

/// Settings as they are stored: the same values, checked again when they are read.
#[cfg(feature = "serde")]
mod stored {
    use super::{ClipSpace, InputError, Origin, Shift, Warp};

    #[derive(serde::Deserialize)]
    pub(super) struct Settings {
        /// Of a square map this was once all there was.
        #[serde(alias = "map_size")]
        map_width: u32,
        #[serde(default)]
        map_height: Option<u32>,
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
            let Settings { map_width, map_height, image_height, border, warp, shift, clip, origin } = settings;
            let map_height = map_height.unwrap_or(map_width);
            let largest = Self::new(Self::MAX_SIZE, image_height)?;
            let checked = largest.with_map_sides(map_width, map_height)?.with_border(border)?;
            Ok(checked.with_warp(warp).with_shift(shift).with_clip(clip).with_origin(origin))
        }
    }

    /// A height as it is read again.
    #[expect(clippy::trivially_copy_pass_by_ref, reason = "it is what serde calls")]
    pub(super) fn some<S: serde::Serializer>(height: &u32, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_some(height)
    }
}
