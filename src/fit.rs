//! The fit: window, depth row and matrix from a focus and a warp.

use crate::bounds::{Interval, Rectangle};
use crate::convex::Body;
use crate::focus::{Focus, VIEW_BITS, clip_all};
use crate::homography::Homography;
use crate::light::Light;
use crate::map::{DepthSpan, Map, Window};
use crate::perspective::VirtualCamera;
use crate::rays::{Functional, Rays};
use crate::rounding::Rounding;
use crate::scene::{Region, Scene};
use crate::settings::{Origin, Settings, Shift, Warp};
use crate::view::View;
use crate::warp;
use core::fmt;
use glam::DVec3;

/// The window and the depth range are at least this part of half of what the image shows at the visible points: a
/// millionth of a pixel or so, for a scene that is a point.
const LEAST_PART: f64 = 1.0 / 1_073_741_824.0;

/// What comes of a fit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Outcome {
    /// One map, and its matrix.
    Map(Map),
    /// No map is needed.
    Empty(Empty),
    /// No single frustum holds what is visible.
    Surrounded(Surrounded),
}

impl Outcome {
    /// The map, if there is one.
    #[must_use]
    pub const fn map(&self) -> Option<&Map> {
        match self {
            Self::Map(map) => Some(map),
            Self::Empty(_) | Self::Surrounded(_) => None,
        }
    }
}

/// Why no map is needed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Empty {
    /// Nothing that receives is in view and lit: the light needs no pass, and no shading either.
    NothingVisible,
    /// Nothing can cast on what is visible: everything in view that the light reaches is lit.
    NothingCasts,
}

impl fmt::Display for Empty {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::NothingVisible => "nothing that is in view can be lit: no shadow map and no shading needed",
            Self::NothingCasts => "nothing can cast on what is in view: no shadow map needed, all of it is lit",
        })
    }
}

/// The light stands among what is visible and lit: every plane through it has some of that on both sides, so that one
/// frustum cannot hold it all.
///
/// What serves instead: the light cut into spots, one fit each (the faces of a cube, or [`Light::spot`]s where it is
/// needed), or, for a [`Light::hemisphere`] or a pair of them, paraboloid maps (Brabec, Annen & Seidel 2002).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Surrounded;

impl fmt::Display for Surrounded {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(
            "the light stands among what is visible, which no single frustum holds: \
             fit the faces of a cube as spots, or use paraboloid maps",
        )
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
///     println!("{}", map.matrix());
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
        let (Some(receivers), Some(casters)) = (self.receivers, self.casters) else {
            return Outcome::Empty(match self.receivers {
                Some(_) if !self.visible().is_empty() => Empty::NothingCasts,
                _ => Empty::NothingVisible,
            });
        };
        match (receivers, casters) {
            // A box, a light's six planes and a hull's ten have at most 40 vertices, and a cut of their polyhedron at
            // most 21 new ones beside the 38 old.
            (Region::Box { .. }, Region::Box { .. }) => fit_polyhedra::<64>(self, &casters, settings),
            _ => fit_polyhedra::<{ Body::MAX_VERTICES }>(self, &casters, settings),
        }
    }
}

fn fit_polyhedra<const N: usize>(focus: &Focus<'_>, casters: &Region<'_>, settings: &Settings) -> Outcome {
    let (view, light) = (focus.view(), focus.light());
    let visible = focus.visible_polyhedron::<N>(|_, _| ());
    if visible.is_empty() {
        return Outcome::Empty(Empty::NothingVisible);
    }
    let camera = match settings.shift() {
        Shift::None => VirtualCamera::own(view, visible.positions()),
        Shift::Back(form) => {
            VirtualCamera::moved_back(view, focus.body_polyhedron::<N>(form, |_, _| ()).positions())
        }
    };
    let Some(camera) = camera else {
        return Outcome::Empty(Empty::NothingCasts);
    };
    let Ok(rays) = Rays::new::<N>(focus, visible.positions()) else {
        return Outcome::Surrounded(Surrounded);
    };
    let origin = match settings.origin() {
        Origin::World => DVec3::ZERO,
        Origin::Eye => view.eye(),
    };

    // The frame: w, and the ray that u and v are measured from, the middle of the uniform map.
    let middle = Rectangle::around(visible.positions().map(|point| rays.through(point).0)).centre;
    let (warp, weakening) = match settings.warp() {
        Warp::Uniform => (Functional::ONE, 1.0),
        Warp::Perspective => {
            let visible = warp::Visible { rays: &rays, points: visible.positions(), middle, origin };
            warp::perspective(&camera.rows(view), light.homogeneous(), &visible)
        }
    };
    let along = Interval::around(visible.positions().map(|point| rays.along.at(point)));
    let mut map = Homography::new(&rays, middle, warp, along.middle());

    // The window: what R covers. Nothing else in hull(R, l) can widen it.
    let window = Rectangle::around(visible.positions().map(|point| map.uv(point)));
    let bordered = window.with_half(window.half / settings.inner());
    map.cut(&rays, &bordered, light.near());

    // The depth range: from the first caster in the window, its border included, to the last of what is visible.
    // H alone would do for the texels that R covers, but a filter reads those around them too.
    let extent = casters.extent();
    let mut casting = focus.lit_polyhedron::<N>(casters, extent, |_, _| ());
    clip_all(&mut casting, &map.planes(&bordered), VIEW_BITS, extent, &mut |_, _| ());
    let depth = Interval {
        min: Interval::around(casting.positions().map(|point| map.depth(point))).min,
        max: Interval::around(visible.positions().map(|point| map.depth(point))).max,
    };
    // Without any casters the least depth is infinite.
    if depth.min > depth.max {
        return Outcome::Empty(Empty::NothingCasts);
    }

    let points = visible.positions().chain(casting.positions());
    let rounding = Rounding::over(points, &map, &window, &depth, origin);
    let c = Interval::around(visible.positions().map(|point| map.c_at(point)));
    let seen = visible.positions().map(|point| view.half_height(view.depth(point)) / map.c_at(point));
    let least = LEAST_PART * Interval::around(seen).max;
    let half = rounding.padded_window(window.half, settings.inner(), settings.map_size(), least);
    let padded = window.with_half(half);
    let padded_depth = rounding.padded_depth(&depth, least);
    let ratio = Interval::around(visible.positions().map(|point| map.c_at(point) / rays.w.at(point)));
    Outcome::Map(Map {
        // w is at most 1 on what is visible, whatever the units.
        rows: map.rows(&padded, &padded_depth, c.max.recip()),
        view: *view,
        light: *light,
        settings: *settings,
        camera,
        window: Window::new(&window, &padded, settings.inner()),
        depth: DepthSpan::new(&rays, along.middle(), &padded_depth),
        weakening,
        warp_ratio: ratio.max / ratio.min,
    })
}
