//! The fit: from a focus and settings to a map.

mod steps;

use crate::convex::Polyhedron;
use crate::focus::Focus;
use crate::focus::surrounded::Surrounded;
use crate::input::light::Light;
use crate::input::scene::Scene;
use crate::input::view::View;
use crate::map::shadow_map::ShadowMap;
use crate::settings::{Settings, Shift, Warp};
use crate::warp::search::Previous;
use crate::warp::virtual_camera::VirtualCamera;
use core::fmt;
pub(crate) use steps::fit_receivers;

/// Result of fitting a shadow map.
#[derive(Clone, Debug, PartialEq)]
#[expect(clippy::large_enum_variant, reason = "a box would need a heap")]
pub enum Outcome {
    /// One map, and its matrix.
    Map(ShadowMap),
    /// No map is needed.
    Empty(Empty),
    /// No single frustum holds what is visible.
    Surrounded(Surrounded),
}

impl Outcome {
    /// The map, if there is one.
    #[must_use]
    pub const fn map(&self) -> Option<&ShadowMap> {
        match self {
            Self::Map(map) => Some(map),
            Self::Empty(_) | Self::Surrounded(_) => None,
        }
    }

    /// The map itself, if there is one.
    #[must_use]
    pub fn into_map(self) -> Option<ShadowMap> {
        match self {
            Self::Map(map) => Some(map),
            Self::Empty(_) | Self::Surrounded(_) => None,
        }
    }
}

/// Why no map is needed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Empty {
    /// Nothing that receives is in view and lit: the light needs no pass, and no shading either.
    NoReceivers,
    /// Nothing can cast on what is visible: everything in view that the light reaches is lit.
    NoCasters,
}

impl fmt::Display for Empty {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::NoReceivers => "nothing that is in view can be lit: no shadow map and no shading needed",
            Self::NoCasters => "nothing can cast on what is in view: no shadow map needed, all of it is lit",
        })
    }
}

/// Fits one shadow map: the one call for the common case, the same as [`Focus::new`] and [`Focus::fit`].
///
/// ```
/// use shadowfit::{Light, Outcome, Scene, Settings, View, fit};
///
/// let view = View::perspective((0.0, 1.7, 0.0), (0.0, -0.2, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.1, 500.0)?;
/// let sun = Light::directional((0.4, 1.0, 0.2))?;
/// let scene = Scene::from_box((-200.0, 0.0, -200.0), (200.0, 30.0, 200.0))?;
/// if let Outcome::Map(map) = fit(&view, &sun, &scene, &Settings::default()) {
///     println!("{}", map.caster_matrix());
/// }
/// # Ok::<(), shadowfit::InputError>(())
/// ```
#[must_use]
pub fn fit(view: &View, light: &Light, scene: &Scene<'_>, settings: &Settings) -> Outcome {
    Focus::new(view, light, scene).fit(settings)
}

impl Focus<'_> {
    /// Fits one shadow map.
    #[must_use]
    pub fn fit(&self, settings: &Settings) -> Outcome {
        self.fit_after(None, settings)
    }

    /// Fits one shadow map where there was another the frame before, of a view and a light that were not much different.
    ///
    /// Only [`Warp::Best`] makes something of that: it begins where the last search ended, which takes about half of the time,
    /// and stays with the same local minimum while there is one and no closed form is better. [`ShadowMap::jumped`] says when it
    /// jumped. All else is as by [`Self::fit`].
    #[must_use]
    pub fn fit_warm(&self, previous: &ShadowMap, settings: &Settings) -> Outcome {
        let ShadowMap { rows, weakening, mixed, .. } = *previous;
        self.fit_after(Some(Previous { rows, weakening, mixed }), settings)
    }

    fn fit_after(&self, previous: Option<Previous>, settings: &Settings) -> Outcome {
        // One body after another in the same memory: H where the camera is moved back by it, R, and what can cast
        // into the window.
        let mut body = Polyhedron::EMPTY;
        let depths = match (settings.warp(), settings.shift()) {
            // Only the perspective warp has a camera to move.
            (Warp::Perspective | Warp::Best(_), Shift::Back(form)) => {
                self.cut_body(&mut body, form, |_, _| ());
                Some(VirtualCamera::depths(self.view(), body.positions()))
            }
            _ => None,
        };
        self.cut_visible(&mut body, |_, _| ());
        if body.is_empty() {
            return Outcome::Empty(Empty::NoReceivers);
        }
        match &self.casters {
            Some(casters) => fit_receivers(self, &mut body, casters, depths, previous.as_ref(), settings),
            None => Outcome::Empty(Empty::NoCasters),
        }
    }
}
