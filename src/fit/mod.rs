//! The fit: from a focus and settings to a map.

mod cover;
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

/// Result of fitting a shadow map: a map, or why there is none.
///
/// ```
#[doc = include_str!("../examples/sun.txt")]
/// match fit(&view, &sun, &scene, &settings) {
///     Outcome::Map(map) => assert!(map.w_at(ground) > 0.0), // draw the casters, upload the matrices
///     Outcome::Empty(why) => panic!("{why}"),               // skip the pass: all is lit, or nothing is
///     Outcome::Surrounded(why) => panic!("{why}"),          // use cube faces or paraboloids
/// }
/// # Ok::<(), shadowfit::InputError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[expect(clippy::large_enum_variant, reason = "a box would need a heap")]
pub enum Outcome {
    /// One map.
    Map(ShadowMap),
    /// No map is needed.
    Empty(Empty),
    /// No single frustum holds all receivers: the light stands among them.
    Surrounded(Surrounded),
}

impl Outcome {
    /// The map, by reference; `None` without one.
    ///
    /// ```
    #[doc = include_str!("../examples/sun.txt")]
    /// assert!(fit(&view, &sun, &scene, &settings).map().is_some());
    /// let below = Light::directional((0.0, -1.0, 0.0))?;
    /// let flat = Scene::from_box((-20.0, 0.0, -20.0), (20.0, 0.0, 20.0))?;
    /// assert_eq!(fit(&view.narrowed(0.1, 0.2)?, &below, &flat, &settings).map(), None); // ends before the ground
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub const fn map(&self) -> Option<&ShadowMap> {
        match self {
            Self::Map(map) => Some(map),
            Self::Empty(_) | Self::Surrounded(_) => None,
        }
    }

    /// The map itself; `None` without one.
    ///
    /// ```
    #[doc = include_str!("../examples/sun.txt")]
    /// let map = fit(&view, &sun, &scene, &settings).into_map().expect("the ground is in view");
    /// assert_eq!(map.settings(), &settings);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn into_map(self) -> Option<ShadowMap> {
        match self {
            Self::Map(map) => Some(map),
            Self::Empty(_) | Self::Surrounded(_) => None,
        }
    }
}

/// Why no map is needed.
///
/// ```
#[doc = include_str!("../examples/sun.txt")]
/// use shadowfit::Empty;
///
/// let sky = View::perspective((0.0, 9.0, 0.0), (0.0, 1.0, 0.1), (0.0, 0.0, 1.0), 1.0, 1.6, 0.1, 50.0)?;
/// assert_eq!(fit(&sky, &sun, &scene, &settings), Outcome::Empty(Empty::NoReceivers)); // looks up from above
/// # Ok::<(), shadowfit::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Empty {
    /// No receiver is in view and lit: the light needs no pass, and no shading either.
    NoReceivers,
    /// No caster can shadow any receiver: everything in view that the light reaches is lit.
    NoCasters,
}

impl fmt::Display for Empty {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::NoReceivers => "no receiver is in view and lit: no shadow map and no shading needed",
            Self::NoCasters => {
                "nothing can cast on a receiver in view: no shadow map needed, all receivers are lit"
            }
        })
    }
}

/// Fits one shadow map to a view, a light and a scene: the one call for the common case, the same as [`Focus::new`] and
/// [`Focus::fit`].
///
/// ```
#[doc = include_str!("../examples/sun.txt")]
/// let Outcome::Map(map) = fit(&view, &sun, &scene, &Settings::default()) else { panic!("the ground is in view") };
/// let place = map.receiver_matrix().project_point3(ground.as_vec3());
/// assert!(place.min_element() > 0.0 && place.max_element() < 1.0);
/// # Ok::<(), shadowfit::InputError>(())
/// ```
#[doc(alias = "fit to scene")]
#[doc(alias = "focusing")]
#[must_use]
pub fn fit(view: &View, light: &Light, scene: &Scene<'_>, settings: &Settings) -> Outcome {
    Focus::new(view, light, scene).fit(settings)
}

impl Focus<'_> {
    /// Fits one shadow map to the receivers of this focus, with the warp and size of the settings.
    ///
    /// ```
    #[doc = include_str!("../examples/sun.txt")]
    /// let uniform = focus.fit(&settings.with_warp(Warp::Uniform)).into_map().expect("as before");
    /// let best = focus.fit(&settings).into_map().expect("as before"); // `Warp::Best` is the default
    /// assert_eq!(uniform.warp_ratio(), 1.0);
    /// assert!(best.report(&focus).aliasing < uniform.report(&focus).aliasing);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn fit(&self, settings: &Settings) -> Outcome {
        self.fit_after(None, settings)
    }

    /// Fits one shadow map after that of the previous frame, whose view and light were not much different.
    ///
    /// Only [`Warp::Best`] uses it: the search begins where the last one ended, which takes about half of the time, and
    /// stays with the same local minimum while there is one and no closed form is better. [`ShadowMap::jumped`] says when
    /// it jumped. All else is as by [`Self::fit`].
    ///
    /// ```
    #[doc = include_str!("../examples/sun.txt")]
    /// let view = View::perspective((0.05, 1.7, 0.0), (0.0, -0.2, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.1, 50.0)?;
    /// let next = Focus::new(&view, &sun, &scene).fit_warm(&map, &settings).into_map().expect("as before");
    /// assert!(!next.jumped()); // a step of 5 cm
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[doc(alias = "temporal")]
    #[doc(alias = "warm start")]
    #[doc(alias = "temporal coherence")]
    #[must_use]
    pub fn fit_warm(&self, previous: &ShadowMap, settings: &Settings) -> Outcome {
        let ShadowMap { rows, weakening, .. } = *previous;
        self.fit_after(Some(Previous { rows, weakening }), settings)
    }

    fn fit_after(&self, previous: Option<Previous>, settings: &Settings) -> Outcome {
        // One body after another in the same memory: H where the camera is moved back by it, R, and the casters in
        // the window.
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
