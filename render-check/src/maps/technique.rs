//! The ways to fit a map that are compared.

use std::fmt;

use clap::ValueEnum;
use shadowfit::{Effort, FocusForm, Settings, Warp, warp::Shift};

/// A way to spread a map's texels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, ValueEnum, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Technique {
    /// Without a warp
    Uniform,
    /// Without a warp, its texels fixed in the world while the camera moves and turns
    Stable,
    /// The perspective shadow map, its camera moved back for the whole of H, as in the paper
    Psm,
    /// The same, moved back for the tight form of H
    PsmTight,
    /// The same, with its camera where the view's is
    PsmUnshifted,
    /// The light-space perspective shadow map
    LightSpace,
    /// The trapezoidal shadow map
    Trapezoidal,
    /// The best single matrix that is found
    Best,
    /// The best of the closed forms, without a search
    BestClosed,
    /// The same, searched for a short time
    BestRough,
    /// The same, searched for a long time
    BestThorough,
    /// Without a warp, a map for each face of the cube around a lamp
    Cube,
    /// The perspective shadow map of each face of the cube around a lamp
    CubePsm,
    /// Without a warp, the texels of each face of the cube fixed in the world
    CubeStable,
    /// One or two paraboloids around a lamp, as many as it needs
    Paraboloid,
}

impl Technique {
    /// Those that are compared where nobody chooses.
    pub const COMPARED: [Self; 4] = [Self::Uniform, Self::Psm, Self::LightSpace, Self::Best];

    /// One of every kind of warp there is for one map.
    pub const WARPS: [Self; 6] =
        [Self::Uniform, Self::Psm, Self::PsmUnshifted, Self::LightSpace, Self::Trapezoidal, Self::Best];

    /// Those for lamps among what they light.
    pub const CUBES: [Self; 2] = [Self::Cube, Self::CubePsm];

    /// Those that were asked for, or those that are compared where none was.
    #[must_use]
    pub fn or_compared(asked_for: &[Self]) -> &[Self] {
        if asked_for.is_empty() { &Self::COMPARED } else { asked_for }
    }

    /// Whether each face of the cube around a lamp has a map of its own.
    #[must_use]
    pub fn has_faces(self) -> bool {
        matches!(self, Self::Cube | Self::CubePsm | Self::CubeStable)
    }

    /// Whether its matrix is searched for, which can begin at that of the frame before.
    #[must_use]
    pub fn is_searched(self) -> bool {
        matches!(self, Self::Best | Self::BestClosed | Self::BestRough | Self::BestThorough)
    }

    /// Whether lamps have maps that are no frusta.
    #[must_use]
    pub fn is_paraboloid(self) -> bool {
        self == Self::Paraboloid
    }

    /// The technique of a single map with such settings; of the same warp where none has its shift.
    #[must_use]
    pub fn of(settings: &Settings) -> Self {
        let is_single = |way: &&Self| !way.has_faces() && !way.is_paraboloid();
        let ways = || Self::value_variants().iter().filter(is_single);
        let same = ways().find(|way| way.settings(*settings) == *settings);
        let like = || ways().find(|way| way.settings(*settings).warp() == settings.warp());
        same.or_else(like).copied().unwrap_or(Self::Uniform)
    }

    /// Whether its texels stay where they are while the camera moves.
    #[must_use]
    pub fn stays_put(self) -> bool {
        matches!(self, Self::Stable | Self::CubeStable)
    }

    /// The settings with this technique's warp and shift.
    #[must_use]
    pub fn settings(self, settings: Settings) -> Settings {
        let (warp, shift) = match self {
            Self::Uniform | Self::Cube | Self::Paraboloid => (Warp::Uniform, Shift::None),
            Self::Stable | Self::CubeStable => (Warp::Stable, Shift::None),
            Self::Psm | Self::CubePsm => (Warp::Perspective, Shift::Back(FocusForm::ViewHull)),
            Self::PsmTight => (Warp::Perspective, Shift::Back(FocusForm::ReceiverHull)),
            Self::PsmUnshifted => (Warp::Perspective, Shift::None),
            Self::LightSpace => (Warp::LightSpace, Shift::None),
            Self::Trapezoidal => (Warp::Trapezoidal, Shift::None),
            // Its search begins at the perspective map, too, as the paper has that.
            Self::Best => (Warp::Best(Effort::Good), Shift::Back(FocusForm::ViewHull)),
            Self::BestClosed => (Warp::Best(Effort::ClosedForms), Shift::Back(FocusForm::ViewHull)),
            Self::BestRough => (Warp::Best(Effort::Rough), Shift::Back(FocusForm::ViewHull)),
            Self::BestThorough => (Warp::Best(Effort::Thorough), Shift::Back(FocusForm::ViewHull)),
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_way_to_fit_one_map_is_known_by_its_settings() {
        let is_single = |way: &&Technique| !way.has_faces() && !way.is_paraboloid();
        let ways: Vec<_> = Technique::value_variants().iter().filter(is_single).collect();
        assert_eq!(ways.len(), 11);
        for &way in ways {
            assert_eq!(Technique::of(&way.settings(Settings::default())), way);
            // The back-shift makes no difference to other warps than the camera's.
            let shifted = way.settings(Settings::default()).with_shift(Shift::Back(FocusForm::ReceiverHull));
            assert_eq!(Technique::of(&shifted).settings(shifted).warp(), shifted.warp());
        }
    }
}
