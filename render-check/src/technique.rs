//! The ways to fit a map that are compared.

use std::fmt;

use clap::ValueEnum;
use shadowfit::{Form, Settings, Shift, Warp};

/// A way to spread a map's texels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, ValueEnum, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Technique {
    /// Without a warp
    Uniform,
    /// The perspective shadow map, its camera moved back for the whole of H, as in the paper
    Psm,
    /// The same, moved back for the tight form of H
    PsmTight,
    /// The same, with its camera where the view's is
    PsmUnshifted,
    /// Without a warp, a map for each face of the cube around a lamp
    Cube,
    /// The perspective shadow map of each face of the cube around a lamp
    CubePsm,
    /// One or two paraboloids around a lamp, as many as it needs
    Paraboloid,
}

impl Technique {
    /// Those that are compared where nobody chooses.
    pub const COMPARED: [Self; 3] = [Self::Uniform, Self::Psm, Self::PsmUnshifted];

    /// Those for lamps among what they light.
    pub const CUBES: [Self; 2] = [Self::Cube, Self::CubePsm];

    /// Whether each face of the cube around a lamp has a map of its own.
    #[must_use]
    pub fn has_faces(self) -> bool {
        matches!(self, Self::Cube | Self::CubePsm)
    }

    /// Whether lamps have maps that are no frusta.
    #[must_use]
    pub fn is_paraboloid(self) -> bool {
        self == Self::Paraboloid
    }

    /// The settings with this technique's warp and shift.
    #[must_use]
    pub fn settings(self, settings: Settings) -> Settings {
        let (warp, shift) = match self {
            Self::Uniform | Self::Cube | Self::Paraboloid => (Warp::Uniform, Shift::None),
            Self::Psm | Self::CubePsm => (Warp::Perspective, Shift::Back(Form::Paper)),
            Self::PsmTight => (Warp::Perspective, Shift::Back(Form::Tight)),
            Self::PsmUnshifted => (Warp::Perspective, Shift::None),
        };
        settings.with_warp(warp).with_shift(shift)
    }
}

/// The word that the command line takes.
impl fmt::Display for Technique {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.to_possible_value().map_or(Ok(()), |value| f.pad(value.get_name()))
    }
}
