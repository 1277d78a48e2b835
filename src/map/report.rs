//! All that a fitted map costs and resolves, in one struct.

use crate::focus::Focus;
use crate::map::quality::DepthFormat;
use crate::map::shadow_map::{DepthSpan, ShadowMap, Window};
use crate::settings::Warp;
use crate::settings::fallback::WarpFallback;
use crate::warp::{LightClass, VirtualCamera, classify};
use glam::DVec3;

/// All that a fitted map costs and resolves ([`ShadowMap::report`]).
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Report {
    /// The class of the light after the camera's perspective.
    pub class: LightClass,
    /// The camera whose perspective warps the map, with its back-shift.
    pub camera: VirtualCamera,
    /// The warp that was asked for.
    pub warp: Warp,
    /// Why it could not be made, see [`ShadowMap::fallback`].
    pub fallback: Option<WarpFallback>,
    /// How much of it is left out, see [`ShadowMap::weakening`].
    pub weakening: f64,
    /// How strong the warp is, see [`ShadowMap::warp_ratio`].
    pub warp_ratio: f64,
    /// What x and y cover.
    pub window: Window,
    /// What depth covers.
    pub depth: DepthSpan,
    /// The part of the depth range spent on points next to a local light, see [`ShadowMap::depth_beside_light`].
    pub depth_beside_light: f64,
    /// The longest side of a texel's footprint over the vertices of R, in world units.
    pub texel: f64,
    /// The worst aliasing over the vertices of R, see [`ShadowMap::aliasing`]. There may be more between them:
    /// [`ShadowMap::aliasing_over`] finds that, and the mean.
    pub aliasing: f64,
    /// The coarsest depth resolution over the vertices of R.
    pub depth_resolution: DepthResolution,
    /// The same where a shader stores linear depth, see [`ShadowMap::linear_depth_resolution`].
    pub linear_depth_resolution: DepthResolution,
}

/// The world distance along the light's ray that one step of each depth format makes; infinite where a receiver lies outside
/// of the map.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct DepthResolution {
    /// 8-bit unsigned normalised.
    #[cfg_attr(feature = "serde", serde(with = "crate::math::infinity"))]
    pub unorm8: f64,
    /// 16-bit unsigned normalised.
    #[cfg_attr(feature = "serde", serde(with = "crate::math::infinity"))]
    pub unorm16: f64,
    /// 24-bit unsigned normalised.
    #[cfg_attr(feature = "serde", serde(with = "crate::math::infinity"))]
    pub unorm24: f64,
    /// 32-bit float.
    #[cfg_attr(feature = "serde", serde(with = "crate::math::infinity"))]
    pub float32: f64,
}

impl DepthResolution {
    fn new(of: impl Fn(DepthFormat) -> f64) -> Self {
        Self {
            unorm8: of(DepthFormat::Unorm8),
            unorm16: of(DepthFormat::Unorm16),
            unorm24: of(DepthFormat::Unorm24),
            float32: of(DepthFormat::Float32),
        }
    }
}

impl ShadowMap {
    /// The full report of the map over the vertices of R. `focus` is the one that the map was fitted from.
    ///
    /// ```
    #[doc = include_str!("../examples/sun.txt")]
    /// let report = map.report(&focus);
    /// assert_eq!(report.fallback, None);
    /// assert!(report.aliasing <= map.aliasing_over(&focus).expect("receivers").upper_bound);
    /// assert!(report.depth_resolution.float32 < report.depth_resolution.unorm16);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn report(&self, focus: &Focus<'_>) -> Report {
        let visible = focus.visible_beyond_light();
        let over =
            |value: &dyn Fn(DVec3) -> f64| visible.vertices().iter().map(|&point| value(point)).fold(0.0, f64::max);
        Report {
            class: classify(&self.view, &self.light),
            camera: self.camera,
            warp: self.settings.warp(),
            fallback: self.fallback,
            weakening: self.weakening,
            warp_ratio: self.warp_ratio,
            window: self.window,
            depth: self.depth,
            texel: over(&|point| self.footprint(point).map_or(f64::INFINITY, |texel| texel.longest())),
            aliasing: over(&|point| self.aliasing(point).unwrap_or(f64::INFINITY)),
            depth_resolution: DepthResolution::new(|format| over(&|point| self.depth_resolution(point, format))),
            linear_depth_resolution: DepthResolution::new(|format| {
                over(&|point| self.linear_depth_resolution(point, format))
            }),
            depth_beside_light: self.depth_beside_light(),
        }
    }
}
