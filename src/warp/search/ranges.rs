//! The error of the best map for any range of depths, for cascades that are chosen by it.

use super::chart::Chart;
use super::projection::{Projection, Values};
use super::refine::Refinement;
use super::surfaces::Surfaces;
use super::{Candidate, Search};
use crate::convex::Polyhedron;
use crate::focus::Focus;
use crate::input::view::{Image, Lens};
use crate::math::bounds::{Interval, Rectangle};
use crate::settings::{Objective, Settings};
use crate::warp::rays::{Functional, Rays};
use glam::{DVec2, DVec3};

/// The surfaces in view, in parts between depths.
pub(crate) struct Ranges<'a> {
    settings: &'a Settings,
    chart: Chart,
    points: [Point; Focus::MAX_SURFACES],
    len: usize,
    /// Eye depth as the light sees it, less its value at the eye's depth 0.
    depth: Functional,
    is_perspective: bool,
}

/// A surface point.
#[derive(Clone, Copy)]
struct Point {
    depth: f64,
    /// Its place on the chart of rays.
    place: DVec2,
    /// `None` where hardly any light falls on it: the window holds it all the same.
    values: Option<Values>,
}

/// The cost of a range: what is to be added up, or the largest of which counts.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cost {
    /// The sum of errors over pixels, or the worst error.
    pub(crate) error: f64,
    pub(crate) pixels: f64,
}

impl<'a> Ranges<'a> {
    /// The surfaces of a focus; `None` where there are none, or no frustum holds them.
    pub(crate) fn new(focus: &Focus<'_>, settings: &'a Settings) -> Option<Self> {
        let mut body = Polyhedron::EMPTY;
        focus.cut_visible(&mut body, |_, _| ());
        let rays = if body.is_empty() { None } else { Rays::new(focus, &mut body).ok() }?;
        let (mut u, mut v, mut along) = (Interval::EMPTY, Interval::EMPTY, Interval::EMPTY);
        let place = |point: DVec3| rays.through(point).0;
        for point in body.positions() {
            let place = place(point);
            u.include(place.x);
            v.include(place.y);
            along.include(rays.along.at(point));
        }
        let chart = Chart::new(body.positions().map(place), Rectangle::over(&u, &v).centre);
        let none = Point { depth: 0.0, place: DVec2::ZERO, values: None };
        let view = focus.view();
        let mut ranges = Self {
            settings,
            chart,
            points: [none; Focus::MAX_SURFACES],
            len: 0,
            depth: rays.depth_across(view, along.middle()),
            is_perspective: view.lens() == Lens::Perspective,
        };
        let image = Image::new(view, settings.image_height());
        let projection = Projection { image, rays: &rays, chart: &ranges.chart, zero: along.middle() };
        focus.for_each_surface(|point| {
            if let Some(slot) = ranges.points.get_mut(ranges.len) {
                let (place, values) = (place(point.position), projection.of(&point));
                *slot = Point { depth: view.depth(point.position), place, values };
                ranges.len += 1;
            }
        });
        ranges.points[..ranges.len].sort_unstable_by(|a, b| a.depth.total_cmp(&b.depth));
        (ranges.len > 0).then_some(ranges)
    }

    /// The nearest and the farthest depth of any surface.
    pub(crate) fn ends(&self) -> Interval {
        let at = |index: usize| self.points[index].depth;
        Interval { min: at(0), max: at(self.len - 1) }
    }

    /// The costs of the ranges from a depth to each of several ascending ones, `None` for those without lit surfaces; the range is
    /// taken to begin at the depth `begin`.
    pub(crate) fn costs(&self, near: f64, begin: f64, ends: &[f64], mut each: impl FnMut(usize, Option<Cost>)) {
        let mut search = Search {
            chart: self.chart.emptied(),
            surfaces: Surfaces::none(self.settings),
            objective: self.settings.objective(),
            is_square: false,
        };
        let points = &self.points[..self.len];
        let (mut next, mut before) = (points.partition_point(|point| point.depth < near), None);
        let mut across = Interval::EMPTY;
        for (index, far) in ends.iter().enumerate() {
            while let Some(point) = points.get(next).filter(|point| point.depth < *far) {
                search.chart.push(point.place);
                across.include(self.depth.at(point.place));
                if let Some(values) = &point.values {
                    search.surfaces.push(values);
                }
                next += 1;
            }
            let best = self.best(&search, begin, &across, before);
            before = best;
            each(index, best.map(|best| self.cost(&search, &best)));
        }
    }

    fn cost(&self, search: &Search, best: &Candidate) -> Cost {
        let pixels = search.surfaces.pixels();
        let error = match self.settings.objective() {
            Objective::Mean => best.error * pixels,
            Objective::Worst => best.error,
        };
        Cost { error, pixels }
    }

    /// The best map found from the uniform one, a light-space warp and the best one of a shorter range.
    fn best(&self, search: &Search, near: f64, across: &Interval, before: Option<Candidate>) -> Option<Candidate> {
        let uniform = [Functional::U, Functional::V, Functional::ONE];
        let mut best = search.measured(&uniform)?;
        if self.is_perspective {
            // As `light_space::propose`.
            let mean = DVec2::splat(near * (near + across.max - across.min)).sqrt().x;
            let constant = self.depth.constant + near + mean - across.min;
            let [x, y, _] = uniform;
            best = best.or(search.measured(&[x, y, Functional { constant, ..self.depth }]));
        }
        let before = before.and_then(|before| search.measured(&search.chart.rows(&before.map)));
        Some(search.refined(&best.or(before), &Refinement::OF_RANGE))
    }
}
