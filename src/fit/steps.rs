//! The steps of a fit: receivers on the chart, warp, window, casters, padding, assembly.

use crate::convex::Polyhedron;
use crate::fit::{Empty, Outcome};
use crate::focus::cone::NoCone;
use crate::focus::surrounded::Surrounded;
use crate::focus::{Focus, VIEW_IDS, clip_all};
use crate::input::scene::Region;
use crate::map::linear_depth::LinearDepth;
use crate::map::shadow_map::{DepthSpan, ShadowMap, Window};
use crate::math::bounds::{Interval, Rectangle, least, most};
use crate::settings::fallback::WarpFallback;
use crate::settings::{Settings, Warp};
use crate::warp::homography::Homography;
use crate::warp::rays::Rays;
use crate::warp::rounding::{self, AWAY_FROM_LIGHT, Rounding};
use crate::warp::search::{self, Previous};
use crate::warp::stable::Stable;
use crate::warp::virtual_camera::VirtualCamera;
use crate::warp::{Precision, Proposed, Visible, light_space, psm, trapezoidal};
use glam::{DVec2, DVec3, DVec4};

/// The window and the depth range are at least this part of half of the image's height at the receivers: a
/// millionth of a pixel or so, for a scene that is a point.
const LEAST_PART: f64 = 1.0 / 1_073_741_824.0;

/// Why there is no map.
enum NoMap {
    Empty(Empty),
    Surrounded(Surrounded),
}

/// Fits a map to the receiver volume, the vertices and edges of `body`, whose memory it takes. `depths` are those of H before
/// the camera, where the camera is moved back by it.
pub(crate) fn fit_receivers(
    focus: &Focus<'_>,
    body: &mut Polyhedron,
    casters: &Region<'_>,
    depths: Option<Interval>,
    previous: Option<&Previous>,
    settings: &Settings,
) -> Outcome {
    match Fit::new(focus, body, settings).and_then(|fit| fit.map(body, casters, depths, previous)) {
        Ok(map) => Outcome::Map(map),
        Err(NoMap::Empty(empty)) => Outcome::Empty(empty),
        Err(NoMap::Surrounded(surrounded)) => Outcome::Surrounded(surrounded),
    }
}

/// What all steps share.
struct Fit<'a> {
    focus: &'a Focus<'a>,
    settings: &'a Settings,
    /// The chart of the light's rays.
    rays: Rays,
    /// The grid of a stable map, or why there is none.
    stable: Option<Stable>,
    fallback: Option<WarpFallback>,
    /// The origin that positions are relative to in the f32 matrices.
    origin: DVec3,
}

/// The receivers as the uniform map and the camera see them.
struct OnChart {
    /// Their middle on the chart.
    middle: DVec2,
    /// Their distances along the axis.
    along: Interval,
    /// Their depths before the eye.
    eye_depth: Interval,
}

/// A warp, and whether the search for it jumped.
struct Chosen {
    proposed: Result<Proposed, WarpFallback>,
    jumped: bool,
}

/// The receivers as the warped map sees them.
struct Covered {
    window: Rectangle,
    depth: Interval,
    /// c, and c over the uniform map's w.
    c: Interval,
    ratio: Interval,
    /// How far they are from the origin, on each axis.
    reach: DVec3,
    /// Half of the image's height at the receivers, at most, in units of the map.
    seen: f64,
}

/// The casters in the window.
struct Casting {
    /// From the first caster to the last receiver.
    depth: Interval,
    /// The nearest caster's distance along the axis.
    nearest: f64,
    /// c is no less but for rounding.
    least_c: f64,
}

impl Casting {
    fn c(&self, values: DVec4) -> f64 {
        most(values.w, 0.5 * self.least_c)
    }
}

impl<'a> Fit<'a> {
    fn new(focus: &'a Focus<'a>, body: &mut Polyhedron, settings: &'a Settings) -> Result<Self, NoMap> {
        let (stable, fallback) = match settings.warp() {
            Warp::Stable => match Stable::new(focus, body.positions(), settings) {
                Ok(stable) => (Some(stable), None),
                Err(fallback) => (None, Some(fallback)),
            },
            _ => (None, None),
        };
        let rays = match &stable {
            Some(stable) => Ok(stable.rays(focus.light())),
            None => Rays::new(focus, body),
        };
        let rays = rays.map_err(|none| match none {
            NoCone::Surrounded(surrounded) => NoMap::Surrounded(surrounded),
            // All receivers are where the light is.
            NoCone::Nothing => NoMap::Empty(Empty::NoCasters),
        })?;
        let origin = settings.origin().of(focus.view(), focus.light());
        Ok(Self { focus, settings, rays, stable, fallback, origin })
    }

    fn map(
        &self,
        body: &mut Polyhedron,
        casters: &Region<'_>,
        depths: Option<Interval>,
        previous: Option<&Previous>,
    ) -> Result<ShadowMap, NoMap> {
        let on_chart = self.on_chart(body);
        let camera = match depths {
            None => VirtualCamera::own(self.focus.view(), &on_chart.eye_depth),
            // Without any H there are no casters.
            Some(depths) if depths.min > depths.max => return Err(NoMap::Empty(Empty::NoCasters)),
            Some(depths) => VirtualCamera::moved_back(self.focus.view(), &depths),
        };
        let chosen = self.choose_warp(body, &on_chart, &camera, previous);
        let proposed = chosen.proposed.unwrap_or(Proposed::UNIFORM);
        let along = on_chart.along.middle();
        let zero = self.stable.as_ref().map_or(along, |stable| stable.zero(along));
        let map = Homography::new(&self.rays, on_chart.middle, &proposed.frame, &proposed.warp, zero);
        let covered = self.cover(&map, body);
        if covered.seen == 0.0 {
            // All receivers are nearer to the light than any caster.
            return Err(NoMap::Empty(Empty::NoCasters));
        }

        // The depth range: from the first caster in the window, its border included, to the last receiver. H alone would
        // do for the texels that R covers, but a filter reads those around them too.
        let bordered = match &self.stable {
            None => covered.window.with_half(covered.window.half / self.settings.inner()),
            Some(stable) => stable.least_window(),
        };
        let least_c = map.least_c(&self.rays, &bordered, self.focus.light().near());
        let mut rounding = self.rounding(&map, &covered, &on_chart.along, least_c, body);
        self.cut_casting(&map, &covered, &bordered, least_c, casters, body);
        let casting = self.casting(&map, &covered, &on_chart.along, least_c, body, &mut rounding)?;
        Ok(self.assembled(&on_chart, camera, &chosen, &map, zero, &covered, &casting, body, rounding))
    }

    fn on_chart(&self, receivers: &Polyhedron) -> OnChart {
        let (mut u, mut v, mut along, mut eye_depth) =
            (Interval::EMPTY, Interval::EMPTY, Interval::EMPTY, Interval::EMPTY);
        for point in receivers.positions() {
            let (ray, _) = self.rays.through(point);
            u.include(ray.x);
            v.include(ray.y);
            along.include(self.rays.along.at(point));
            eye_depth.include(self.focus.view().depth(point));
        }
        let window = Rectangle::over(&u, &v);
        let middle = self.stable.as_ref().map_or(window.centre, Stable::middle);
        OnChart { middle, along, eye_depth }
    }

    fn choose_warp(
        &self,
        receivers: &Polyhedron,
        on_chart: &OnChart,
        camera: &VirtualCamera,
        previous: Option<&Previous>,
    ) -> Chosen {
        let (view, rays, settings, origin) = (self.focus.view(), &self.rays, self.settings, self.origin);
        let along = &on_chart.along;
        let visible = || Visible {
            view,
            l: self.focus.light().homogeneous(),
            rays,
            points: receivers.positions(),
            middle: on_chart.middle,
            along: along.middle(),
            eye_depth: on_chart.eye_depth,
            origin,
            least: LEAST_PART * view.half_height(on_chart.eye_depth.max),
            precision: Precision::new(rays, receivers.positions(), origin, along, settings.sides()),
        };
        let mut jumped = false;
        let proposed = match settings.warp() {
            Warp::Uniform | Warp::Stable => self.fallback.map_or(Ok(Proposed::UNIFORM), Err),
            Warp::Perspective => Ok(psm::propose(&visible(), &camera.rows(view))),
            Warp::LightSpace => light_space::propose(&visible()),
            Warp::Trapezoidal => trapezoidal::propose(&visible()),
            Warp::Best(effort) => {
                let visible = visible();
                let perspective = psm::propose(&visible, &camera.rows(view));
                let chosen = search::choose(self.focus, &visible, perspective, effort, settings, previous);
                jumped = chosen.jumped;
                Ok(chosen.proposed)
            }
        };
        Chosen { proposed, jumped }
    }

    /// The extent of R in the map, which the window has to cover. Nothing else in hull(R, l) can widen it.
    fn cover(&self, map: &Homography, receivers: &Polyhedron) -> Covered {
        let view = self.focus.view();
        let (mut x, mut y, mut depth) = (Interval::EMPTY, Interval::EMPTY, Interval::EMPTY);
        let (mut c, mut ratio, mut seen, mut reach) = (Interval::EMPTY, Interval::EMPTY, 0.0, DVec3::ZERO);
        for point in receivers.positions() {
            let values = map.at(point);
            let one = values / values.w;
            x.include(one.x);
            y.include(one.y);
            depth.include(one.z);
            reach = reach.max((point - self.origin).abs());
            c.include(values.w);
            let w = self.rays.w.at(point);
            ratio.include(values.w / w);
            // Points nearer to the light than its near distance need not be right.
            if w >= self.rays.least_w {
                seen = most(seen, view.half_height(view.depth(point)) / values.w);
            }
        }
        Covered { window: Rectangle::over(&x, &y), depth, c, ratio, reach, seen }
    }

    fn rounding(
        &self,
        map: &Homography,
        covered: &Covered,
        along: &Interval,
        least_c: f64,
        receivers: &Polyhedron,
    ) -> Rounding {
        // The least c of points beyond 1/16 of the farthest receiver's axial distance from a local light, whatever the warp.
        let away_c = if self.rays.local { covered.ratio.min * along.max * AWAY_FROM_LIGHT } else { covered.c.min };
        let mut rounding = Rounding::new(map, &self.rays, self.origin, &covered.c, [least_c, away_c]);
        for point in receivers.positions() {
            rounding.include_visible(point, map.c_at(point));
        }
        rounding
    }

    /// Cuts `body` to the casters in the window.
    fn cut_casting(
        &self,
        map: &Homography,
        covered: &Covered,
        bordered: &Rectangle,
        least_c: f64,
        casters: &Region<'_>,
        body: &mut Polyhedron,
    ) {
        let extent = self.focus.cut_lit(body, casters, |_, _| ());
        // Casters beyond all receivers shadow none of them.
        let planes = map.planes(bordered, covered.depth.max, least_c);
        // No point that a directional light reaches has less than the least c.
        let planes = if self.rays.local { &planes[..] } else { &planes[..5] };
        clip_all(body, planes, VIEW_IDS, extent, |_, _| ());
    }

    fn casting(
        &self,
        map: &Homography,
        covered: &Covered,
        along: &Interval,
        least_c: f64,
        body: &Polyhedron,
        rounding: &mut Rounding,
    ) -> Result<Casting, NoMap> {
        if body.is_empty() {
            return Err(NoMap::Empty(Empty::NoCasters));
        }
        let depth = Interval { min: covered.depth.max, max: covered.depth.max };
        let mut casting = Casting { depth, nearest: along.min, least_c };
        for point in body.positions() {
            let values = map.at(point);
            let c = casting.c(values);
            casting.depth.min = least(casting.depth.min, values.z / c);
            casting.nearest = least(casting.nearest, self.rays.along.at(point));
            rounding.include_casting(point, c);
        }
        Ok(casting)
    }

    /// Pads the window and the depth range for the rounding of f32, and puts the map together.
    #[expect(clippy::too_many_arguments, reason = "the results of all steps before")]
    fn assembled(
        &self,
        on_chart: &OnChart,
        camera: VirtualCamera,
        chosen: &Chosen,
        map: &Homography,
        zero: f64,
        covered: &Covered,
        casting: &Casting,
        body: &Polyhedron,
        rounding: Rounding,
    ) -> ShadowMap {
        let (rays, settings, stable) = (&self.rays, self.settings, self.stable.as_ref());
        let (view, light) = (self.focus.view(), self.focus.light());
        let smallest = LEAST_PART * covered.seen;
        let half =
            |window: &Rectangle| rounding.padded_window(window, settings.inner(), settings.sides(), smallest);
        let window = &covered.window;
        let padded = stable.map_or_else(|| window.with_half(half(window)), |stable| stable.window(window, half));
        let casters = body.positions().map(|point| (point, map.at(point)));
        let deepest =
            casters.map(|(point, values)| rounding.deepest(point, values.z, casting.c(values), &casting.depth));
        let padded_depth = rounding.padded_depth(&casting.depth, deepest.fold(casting.depth.max, most), smallest);
        let row = rounding::of_row(&rays.along, self.origin, covered.reach);
        let linear = LinearDepth::new(rays, casting.nearest, on_chart.along, row, smallest);
        // w is at most 1 at receivers, whatever the units.
        let (padded_depth, linear, largest) = match stable {
            None => (padded_depth, linear, covered.c.max),
            Some(stable) => (
                stable.in_depth_steps(zero, &padded_depth),
                linear.with_range(|range| stable.in_steps(range)),
                stable.largest_w(light, covered.c.max),
            ),
        };
        // −e·l.
        let to_light = if rays.local { zero } else { 1.0 };
        let noise = rounding.scaled_to(largest).in_map(map, &padded, &padded_depth, settings.sides(), to_light);
        let Proposed { weakening, .. } = chosen.proposed.unwrap_or(Proposed::UNIFORM);
        ShadowMap {
            rows: map.rows_to(&padded, &padded_depth, largest.recip()),
            view: *view,
            light: *light,
            settings: *settings,
            camera,
            window: Window::new(window, &padded, settings.inner(), noise.place.most),
            depth: DepthSpan::new(rays, zero, &padded_depth, view.eye(), noise.depth.most),
            noise,
            along: linear,
            weakening,
            fallback: chosen.proposed.err(),
            jumped: chosen.jumped,
            warp_ratio: covered.ratio.max / covered.ratio.min,
        }
    }
}
