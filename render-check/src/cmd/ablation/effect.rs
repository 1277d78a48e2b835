//! The parts of a plan that can be switched off, and what each is for.

use std::fmt;

use serde::Serialize;

/// Something that a plan uses or does without.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Effect {
    /// Having a map at all.
    Map,
    /// The best warp, against a uniform map of the same size.
    Warp,
    /// The virtual camera moved back, against one at the eye.
    BackShift,
    /// A map for each face of a cube, against one map.
    SeveralMaps,
    /// Cube faces without receivers or casters dropped, against all six faces.
    FaceDropping,
    /// Second depth without a bias, against first depth with one.
    SecondDepth,
    /// Virtual samples, against first depth with a bias.
    VirtualSamples,
    /// The widest filter, against a narrower one: the nearest texel, or the narrowest that suffices.
    Filter,
    /// The largest size, against a smaller one.
    FullSize,
    /// Culling of casters against H, against drawing all objects.
    Culling,
    /// Maps fitted to the depth range of the receivers in view, against the whole view.
    Narrowing,
}

/// The purpose of an effect.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Buys {
    /// Fewer wrong pixels or smaller texels, at more work.
    Accuracy,
    /// Less work, with the same pixels.
    Work,
}

impl Effect {
    /// Its purpose.
    #[must_use]
    pub fn buys(self) -> Buys {
        match self {
            Self::FaceDropping | Self::Culling => Buys::Work,
            _ => Buys::Accuracy,
        }
    }
}

impl fmt::Display for Effect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Map => "a map",
            Self::Warp => "warp",
            Self::BackShift => "back-shift",
            Self::SeveralMaps => "several maps",
            Self::FaceDropping => "face dropping",
            Self::SecondDepth => "second depth",
            Self::VirtualSamples => "virtual samples",
            Self::Filter => "filter",
            Self::FullSize => "full size",
            Self::Culling => "culling",
            Self::Narrowing => "narrowing",
        })
    }
}
