//! What a plan can leave out, and what each is bought with.

use std::fmt;

use serde::Serialize;

/// Something that a plan asks for or leaves out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Effect {
    /// Any map at all.
    Map,
    /// The best warp, against a uniform map of the same size.
    Warp,
    /// The warp's camera moved back, against one that stays.
    BackShift,
    /// A map for each face of a cube, against one map.
    SeveralMaps,
    /// The faces of a cube that have nothing to show left out, against all six.
    FaceDropping,
    /// Second depth without a bias, against first depth with one.
    SecondDepth,
    /// Virtual samples, against first depth with a bias.
    VirtualSamples,
    /// The widest filter, against a narrower one: the nearest texel, or the least that is enough.
    Filter,
    /// The largest size, against a smaller one.
    FullSize,
    /// Only casters that can touch what is seen, against all there are.
    Culling,
    /// Maps fitted to the depths of what receives in view, against all of the view.
    Narrowing,
}

/// What an effect is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Buys {
    /// Fewer wrong pixels or smaller texels, for more work.
    Accuracy,
    /// Less work, for the same pixels.
    Work,
}

impl Effect {
    /// What it is for.
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
