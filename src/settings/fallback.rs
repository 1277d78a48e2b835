//! Why a map is the uniform one although another was asked for.

use core::fmt;

/// Why a map is the uniform one although another was asked for ([`ShadowMap::fallback`](crate::ShadowMap::fallback)).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum WarpFallback {
    /// The view is orthographic: there is no perspective to undo.
    NoPerspective,
    /// The light lies on the view's central ray, or shines along it: there is no direction on the map to warp along.
    AlongView,
    /// What the trapezoid is to be focused on is behind the light's frustum, and only what lies beside it is lit.
    FocusBehindLight,
    /// What the trapezoid is to be focused on takes four fifths of the map without any warp.
    FocusLarge,
    /// A stable map of a light at a position is that of all that the light reaches, and no single frustum holds that: of a
    /// point light, of a hemisphere, of a spot whose pyramid is within a tenth of a degree of a half space, or of a lamp
    /// whose near distance is lost in the rounding of its position. The faces of a cube
    /// ([`Light::cube_face`](crate::Light::cube_face)) have stable maps.
    NoRegion,
    /// A stable map has room for all of the view or all of the scene, and there is no end to the view, while the scene comes
    /// as lists, of which what is visible changes as the camera moves. Narrow the view to the distance that shadows are
    /// drawn to ([`View::narrowed`](crate::View::narrowed)).
    Endless,
}

impl fmt::Display for WarpFallback {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::NoPerspective => "the view has no perspective for a warp to undo",
            Self::AlongView => "the light shines along the view: there is no direction on the map to warp along",
            Self::FocusBehindLight => "what the trapezoid is to be focused on is behind the light's frustum",
            Self::FocusLarge => {
                "what the trapezoid is to be focused on takes four fifths of the map without any warp"
            }
            Self::NoRegion => {
                "no stable map: no single frustum holds all that the light reaches; fit the faces of a cube around it"
            }
            Self::Endless => {
                "no stable map: the view has no end and the scene comes as lists; narrow the view to a finite distance"
            }
        })
    }
}
