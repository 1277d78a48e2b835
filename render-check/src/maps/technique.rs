//! The techniques that are compared.

use std::fmt;

use clap::ValueEnum;
use shadowfit::{Effort, FocusForm, Settings, Warp, warp::Shift};

/// A technique: a warp, or another parameterization of the map.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, ValueEnum, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Technique {
    /// Uniform: no warp
    Uniform,
    /// Uniform and stabilised: snapped to texels, of constant size while the camera moves and turns
    Stable,
    /// Perspective shadow map (PSM), its virtual camera moved back for the whole of H, as in the paper
    Psm,
    /// PSM, moved back for the tight form of H
    PsmTight,
    /// PSM, its virtual camera at the eye
    PsmUnshifted,
    /// Light-space perspective shadow map (LiSPSM)
    LightSpace,
    /// Trapezoidal shadow map (TSM)
    Trapezoidal,
    /// The best single matrix, by search
    Best,
    /// The best of the closed forms, without a search
    BestClosed,
    /// The best, with a short search
    BestRough,
    /// The best, with a long search
    BestThorough,
    /// Cube map: a uniform map for each cube face around a point light
    Cube,
    /// Cube map with a PSM for each face
    CubePsm,
    /// Cube map with stabilised faces
    CubeStable,
    /// One or two paraboloids around a point light, as needed
    Paraboloid,
}

impl Technique {
    /// The techniques compared by default.
    pub const COMPARED: [Self; 4] = [Self::Uniform, Self::Psm, Self::LightSpace, Self::Best];

    /// One technique for every kind of warp of a single map.
    pub const WARPS: [Self; 6] =
        [Self::Uniform, Self::Psm, Self::PsmUnshifted, Self::LightSpace, Self::Trapezoidal, Self::Best];

    /// Techniques for point lights inside the scene.
    pub const CUBES: [Self; 2] = [Self::Cube, Self::CubePsm];

    /// The techniques asked for, or the default ones.
    #[must_use]
    pub fn or_compared(asked_for: &[Self]) -> &[Self] {
        if asked_for.is_empty() { &Self::COMPARED } else { asked_for }
    }

    /// Whether it has a map for each cube face.
    #[must_use]
    pub fn has_faces(self) -> bool {
        matches!(self, Self::Cube | Self::CubePsm | Self::CubeStable)
    }

    /// Whether its matrix is searched for, and so can be warm-started.
    #[must_use]
    pub fn is_searched(self) -> bool {
        matches!(self, Self::Best | Self::BestClosed | Self::BestRough | Self::BestThorough)
    }

    /// Whether point and spot lights have paraboloid maps.
    #[must_use]
    pub fn is_paraboloid(self) -> bool {
        self == Self::Paraboloid
    }

    /// The single-map technique with these settings; else one with the same warp.
    #[must_use]
    pub fn of(settings: &Settings) -> Self {
        let is_single = |way: &&Self| !way.has_faces() && !way.is_paraboloid();
        let ways = || Self::value_variants().iter().filter(is_single);
        let same = ways().find(|way| way.settings(*settings) == *settings);
        let like = || ways().find(|way| way.settings(*settings).warp() == settings.warp());
        same.or_else(like).copied().unwrap_or(Self::Uniform)
    }

    /// Whether its maps are stabilised.
    #[must_use]
    pub fn stays_put(self) -> bool {
        matches!(self, Self::Stable | Self::CubeStable)
    }

    /// The settings with this technique's warp and back-shift.
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
            // Its search starts from the paper's PSM, among others.
            Self::Best => (Warp::Best(Effort::Good), Shift::Back(FocusForm::ViewHull)),
            Self::BestClosed => (Warp::Best(Effort::ClosedForms), Shift::Back(FocusForm::ViewHull)),
            Self::BestRough => (Warp::Best(Effort::Rough), Shift::Back(FocusForm::ViewHull)),
            Self::BestThorough => (Warp::Best(Effort::Thorough), Shift::Back(FocusForm::ViewHull)),
        };
        settings.with_warp(warp).with_shift(shift)
    }
}

/// The command line's spelling.
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
            // The back-shift matters for the perspective warp only.
            let shifted = way.settings(Settings::default()).with_shift(Shift::Back(FocusForm::ReceiverHull));
            assert_eq!(Technique::of(&shifted).settings(shifted).warp(), shifted.warp());
        }
    }
}
