//! Reasons for a map to fall back to the uniform one.

use core::fmt;

/// The reason why a warp fell back to the uniform map ([`ShadowMap::fallback`](crate::ShadowMap::fallback)).
///
/// ```
/// use shadowfit::{Light, Scene, Settings, View, Warp, WarpFallback, fit};
///
/// let view = View::orthographic((0.0, 9.0, 9.0), (0.0, -1.0, -1.0), (0.0, 1.0, 0.0), 5.0, 1.6, 0.0, 50.0)?;
/// let scene = Scene::from_box((-20.0, 0.0, -20.0), (20.0, 3.0, 20.0))?;
/// let settings = Settings::default().with_warp(Warp::LightSpace);
/// let outcome = fit(&view, &Light::directional((0.4, 1.0, 0.2))?, &scene, &settings);
/// assert_eq!(outcome.map().and_then(|map| map.fallback()), Some(WarpFallback::NoPerspective));
/// # Ok::<(), shadowfit::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum WarpFallback {
    /// The view is orthographic: there is no perspective to undo.
    NoPerspective,
    /// The light lies on the view's central ray or shines along it: the map has no direction to warp along.
    AlongView,
    /// The focus point of the trapezoid is behind the light's frustum; only receivers beside it are lit.
    FocusBehindLight,
    /// The focus region of the trapezoid takes four fifths of the map without any warp.
    FocusLarge,
    /// A stabilised map of a local light covers the light's whole region, and no single frustum holds it: a point light, a
    /// hemisphere, a spot within a tenth of a degree of a half space, or a light whose near distance vanishes in the rounding of
    /// its position. Faces of a cube ([`Light::cube_face`](crate::Light::cube_face)) have stabilised maps.
    NoRegion,
    /// A stabilised map covers the whole view or the whole scene, but the view has no end and the scene comes as lists, whose
    /// bounds change with the view. Narrow the view to the maximum shadow distance ([`View::narrowed`](crate::View::narrowed)).
    Endless,
}

impl fmt::Display for WarpFallback {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::NoPerspective => "the view has no perspective for a warp to undo",
            Self::AlongView => "the light shines along the view: the map has no direction to warp along",
            Self::FocusBehindLight => "the focus point of the trapezoid is behind the light's frustum",
            Self::FocusLarge => "the focus region of the trapezoid takes four fifths of the map without any warp",
            Self::NoRegion => {
                "no stabilised map: no single frustum holds the light's region; fit the faces of a cube around the light"
            }
            Self::Endless => {
                "no stabilised map: the view is infinite and the scene comes as lists; narrow the view to a finite distance"
            }
        })
    }
}
