//! The fit: window, depth row and matrix from a focus and a warp.

use crate::along::Along;
use crate::best;
use crate::bounds::{Interval, Rectangle, least, most};
use crate::convex::Polyhedron;
use crate::focus::{Focus, VIEW_IDS, clip_all};
use crate::homography::Homography;
use crate::light::Light;
use crate::map::{DepthSpan, ShadowMap, Window};
use crate::perspective::VirtualCamera;
use crate::rays::{NoRays, Rays};
use crate::rounding::{self, AWAY_FROM_LAMP, Rounding};
use crate::scene::{Region, Scene};
use crate::settings::{Settings, Shift, Warp};
use crate::stable::Stable;
use crate::surrounded::Surrounded;
use crate::view::View;
use crate::warp::{self, Precision, Proposed, Samples, light_space, perspective, trapezoidal};
use core::fmt;
use glam::{DVec3, DVec4};

/// The window and the depth range are at least this part of half of what the image shows at the visible points: a
/// millionth of a pixel or so, for a scene that is a point.
const LEAST_PART: f64 = 1.0 / 1_073_741_824.0;

/// What comes of a fit.
#[derive(Clone, Copy, Debug, PartialEq)]
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
}

/// Why no map is needed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
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
    pub fn fit_warm(&self, before: &ShadowMap, settings: &Settings) -> Outcome {
        self.fit_after(Some(before), settings)
    }

    fn fit_after(&self, before: Option<&ShadowMap>, settings: &Settings) -> Outcome {
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
            Some(casters) => fit_visible(self, &mut body, casters, depths, before, settings),
            None => Outcome::Empty(Empty::NoCasters),
        }
    }
}

/// Fits a map to what is visible, the vertices and edges of `body`, whose memory it takes.
pub(crate) fn fit_visible(
    focus: &Focus<'_>,
    body: &mut Polyhedron,
    casters: &Region<'_>,
    depths: Option<Interval>,
    before: Option<&ShadowMap>,
    settings: &Settings,
) -> Outcome {
    let (view, light) = (focus.view(), focus.light());
    let (stable, refusal) = match settings.warp() {
        Warp::Stable => match Stable::new(focus, body.positions(), settings) {
            Ok(stable) => (Some(stable), None),
            Err(refusal) => (None, Some(refusal)),
        },
        _ => (None, None),
    };
    let rays = match &stable {
        Some(stable) => Ok(stable.rays(light)),
        None => Rays::new(focus, body),
    };
    let rays = match rays {
        Ok(rays) => rays,
        Err(NoRays::Surrounded(surrounded)) => return Outcome::Surrounded(surrounded),
        // All that is visible is where the light is.
        Err(NoRays::Nothing) => return Outcome::Empty(Empty::NoCasters),
    };
    let origin = settings.origin().of(view, light);
    let visible = &*body;

    // What is visible, as the uniform map and as the camera see it.
    let (mut u, mut v, mut along, mut eye_depth) =
        (Interval::EMPTY, Interval::EMPTY, Interval::EMPTY, Interval::EMPTY);
    for point in visible.positions() {
        let (ray, _) = rays.through(point);
        u.include(ray.x);
        v.include(ray.y);
        along.include(rays.along.at(point));
        eye_depth.include(view.depth(point));
    }
    let on_chart = Rectangle::over(&u, &v);
    let middle = stable.as_ref().map_or(on_chart.centre, Stable::middle);
    let zero = stable.as_ref().map_or(along.middle(), |stable| stable.zero(along.middle()));

    // The warp.
    let camera = match depths {
        None => VirtualCamera::own(view, &eye_depth),
        // Without any H nothing casts.
        Some(depths) if depths.min > depths.max => return Outcome::Empty(Empty::NoCasters),
        Some(depths) => VirtualCamera::moved_back(view, &depths),
    };
    let mut switched = false;
    let proposed = {
        let seen = || warp::Visible {
            view,
            l: light.homogeneous(),
            rays: &rays,
            points: visible.positions(),
            middle,
            along: along.middle(),
            eye_depth,
            origin,
            least: LEAST_PART * view.half_height(eye_depth.max),
            precision: Precision::new(&rays, visible.positions(), origin, &along, settings.sides()),
        };
        match settings.warp() {
            Warp::Uniform | Warp::Stable => refusal.map_or(Ok(Proposed::UNIFORM), Err),
            Warp::Perspective => Ok(perspective::propose(&seen(), &camera.rows(view))),
            Warp::LightSpace => light_space::propose(&seen()),
            Warp::Trapezoidal => trapezoidal::propose(&seen()),
            Warp::Best(effort) => {
                let samples = Samples::new(focus, &rays, &on_chart, along.middle(), settings.sides());
                let seen = seen();
                let (edges, perspective) = (visible.edges(), perspective::propose(&seen, &camera.rows(view)));
                let chosen = best::choose(&seen, edges, perspective, effort, settings, before, &samples);
                switched = chosen.switched;
                Ok(chosen.proposed)
            }
        }
    };
    let Proposed { warp, weakening, mixed, frame } = proposed.unwrap_or(Proposed::UNIFORM);
    let map = Homography::new(&rays, middle, &frame, &warp, zero);

    // The window: what R covers. Nothing else in hull(R, l) can widen it.
    let (mut x, mut y, mut depth) = (Interval::EMPTY, Interval::EMPTY, Interval::EMPTY);
    let mut reach = DVec3::ZERO;
    let (mut c, mut ratio, mut seen) = (Interval::EMPTY, Interval::EMPTY, 0.0);
    for point in visible.positions() {
        let values = map.at(point);
        let one = values / values.w;
        x.include(one.x);
        y.include(one.y);
        depth.include(one.z);
        reach = reach.max((point - origin).abs());
        c.include(values.w);
        let w = rays.w.at(point);
        ratio.include(values.w / w);
        // Points nearer to the light than its near distance need not be right.
        if w >= rays.least_w {
            seen = most(seen, view.half_height(view.depth(point)) / values.w);
        }
    }
    if seen == 0.0 {
        // All that is visible is nearer to the light than anything casts.
        return Outcome::Empty(Empty::NoCasters);
    }
    let window = Rectangle::over(&x, &y);

    // The depth range: from the first caster in the window, its border included, to the last of what is visible.
    // H alone would do for the texels that R covers, but a filter reads those around them too.
    let bordered =
        stable.as_ref().map_or_else(|| window.with_half(window.half / settings.inner()), Stable::least_window);
    let least_c = map.least_c(&rays, &bordered, light.near());
    // What is so far from a lamp has at least so much c, whatever the warp; under a directional light there is none beside.
    let away_c = if rays.local { ratio.min * along.max * AWAY_FROM_LAMP } else { c.min };
    let mut rounding = Rounding::new(&map, &rays, origin, &c, [least_c, away_c]);
    for point in visible.positions() {
        rounding.include_visible(point, map.c_at(point));
    }
    let casting = body;
    let extent = focus.cut_lit(casting, casters, |_, _| ());
    // Casters beyond all that is visible shadow none of it.
    let planes = map.planes(&bordered, depth.max, least_c);
    // No point that a directional light reaches has less than the least c.
    let planes = if rays.local { &planes[..] } else { &planes[..5] };
    clip_all(casting, planes, VIEW_IDS, extent, |_, _| ());
    if casting.is_empty() {
        return Outcome::Empty(Empty::NoCasters);
    }
    // But for rounding c would never be less.
    let c_of = |values: DVec4| most(values.w, 0.5 * least_c);
    let mut nearest = along.min;
    depth.min = depth.max;
    for point in casting.positions() {
        let values = map.at(point);
        depth.min = least(depth.min, values.z / c_of(values));
        nearest = least(nearest, rays.along.at(point));
        rounding.include_casting(point, c_of(values));
    }

    let smallest = LEAST_PART * seen;
    let half = |window: &Rectangle| rounding.padded_window(window, settings.inner(), settings.sides(), smallest);
    let padded =
        stable.as_ref().map_or_else(|| window.with_half(half(&window)), |stable| stable.window(&window, half));
    let casters = casting.positions().map(|point| (point, map.at(point)));
    let deepest = casters.map(|(point, values)| rounding.deepest(point, values.z, c_of(values), &depth));
    let padded_depth = rounding.padded_depth(&depth, deepest.fold(depth.max, most), smallest);
    let row = rounding::of_row(&rays.along, origin, reach);
    let linear = Along::new(&rays, nearest, along, row, smallest);
    // w is at most 1 on what is visible, whatever the units.
    let (padded_depth, linear, largest) = match &stable {
        None => (padded_depth, linear, c.max),
        Some(stable) => (
            stable.in_depth_steps(zero, &padded_depth),
            linear.with_range(|range| stable.in_steps(range)),
            stable.largest_w(light, c.max),
        ),
    };
    // −e·l.
    let to_light = if rays.local { zero } else { 1.0 };
    let noise = rounding.scaled_to(largest).in_map(&map, &padded, &padded_depth, settings.sides(), to_light);
    Outcome::Map(ShadowMap {
        rows: map.rows_to(&padded, &padded_depth, largest.recip()),
        view: *view,
        light: *light,
        settings: *settings,
        camera,
        window: Window::new(&window, &padded, settings.inner(), noise.place.most),
        depth: DepthSpan::new(&rays, zero, &padded_depth, view.eye(), noise.depth.most),
        noise,
        along: linear,
        weakening,
        mixed,
        refusal: proposed.err(),
        switched,
        warp_ratio: ratio.max / ratio.min,
    })
}
