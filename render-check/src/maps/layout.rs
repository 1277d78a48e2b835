//! A fitted map of either kind.

use anyhow::{Context, Result};
use shadowfit::glam::DVec3;
use shadowfit::{DepthFormat, Settings, ShadowMap, depth::DepthBias, omni::Paraboloid};

/// The largest deviation, in texels, of a tessellated edge from its true curve in a paraboloid map.
pub const BENT: f64 = 0.5;

/// A fitted map.
#[derive(Clone, Debug, PartialEq)]
#[expect(clippy::large_enum_variant, reason = "a light has six at most")]
pub enum Layout {
    /// A single matrix.
    Frustum(ShadowMap),
    /// A paraboloid, for one hemisphere around a light.
    Paraboloid(Paraboloid),
}

impl Layout {
    /// The settings that it was fitted with.
    #[must_use]
    pub fn settings(&self) -> &Settings {
        match self {
            Self::Frustum(map) => map.settings(),
            Self::Paraboloid(map) => map.settings(),
        }
    }

    /// The aliasing at a point, texel size over pixel size, see [`ShadowMap::aliasing`]; `None` outside the map's
    /// domain.
    #[must_use]
    pub fn aliasing(&self, point: DVec3) -> Option<f64> {
        match self {
            Self::Frustum(map) => map.aliasing(point),
            Self::Paraboloid(map) => map.aliasing(point),
        }
    }

    /// The smallest bias that rules out shadow acne on planes, for a filter with this reach in texels.
    ///
    /// # Errors
    ///
    /// When the reach is not that of a filter.
    pub fn bias(&self, format: DepthFormat, reach: f64) -> Result<DepthBias> {
        let bias = match self {
            Self::Frustum(map) => map.bias(format, reach),
            Self::Paraboloid(map) => map.bias(format, reach),
        };
        bias.context("there is no such filter")
    }
}
