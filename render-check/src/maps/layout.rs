//! The kinds of maps that the crate fits.

use anyhow::{Context, Result};
use shadowfit::glam::DVec3;
use shadowfit::{DepthFormat, Settings, ShadowMap, depth::DepthBias, omni::Paraboloid};

/// How far, in texels, an edge of a caster that is cut for a paraboloid may be drawn from its arc.
pub const BENT: f64 = 0.5;

/// A fitted map: how it lays out the world.
#[derive(Clone, Debug, PartialEq)]
#[expect(clippy::large_enum_variant, reason = "a light has six at most")]
pub enum Layout {
    /// A matrix.
    Frustum(ShadowMap),
    /// Half of everything around a light.
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

    /// How much larger a texel is than a pixel at a point, see [`ShadowMap::aliasing`]; `None` where the map has no place for it.
    #[must_use]
    pub fn aliasing(&self, point: DVec3) -> Option<f64> {
        match self {
            Self::Frustum(map) => map.aliasing(point),
            Self::Paraboloid(map) => map.aliasing(point),
        }
    }

    /// The bias with which no plane shadows itself, for a filter that reaches so many texels.
    ///
    /// # Errors
    ///
    /// When there is no such filter.
    pub fn bias(&self, format: DepthFormat, reach: f64) -> Result<DepthBias> {
        let bias = match self {
            Self::Frustum(map) => map.bias(format, reach),
            Self::Paraboloid(map) => map.bias(format, reach),
        };
        bias.context("there is no such filter")
    }
}
