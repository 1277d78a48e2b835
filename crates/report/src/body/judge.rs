//! One contender's fit of one case against the truth.

use std::collections::HashMap;

use shadowfit::focus::Plane;
use shadowfit::glam::DVec3;

use super::case::{Case, farthest_corner, in_f64};
use super::contender::{Culling, Fitted};
use super::town::Town;
use super::truth::{Exact, TownTruth, Truth};
use super::window::Window;
use testkit::oracle::body::Body;

/// What lies outside of a clip volume by no more than this part of the scene's diameter counts as inside.
pub(crate) const TOLERANCE: f64 = 1e-3;

/// What is said of one fit in the town.
#[derive(Clone, Debug)]
pub struct Fit {
    /// The kind of light.
    pub light: &'static str,
    /// The number of the view and the light.
    pub case: usize,
    /// Who fitted.
    pub contender: &'static str,
    /// Whether nothing came of it, or nothing finite.
    pub failed: bool,
    /// The window's area over that of the least rectangle around R, turned as it likes; none without a window, or where R
    /// reaches beside the light.
    pub over_least: Option<f64>,
    /// The part of the window where R is not.
    pub wasted: Option<f64>,
    /// The part of the window where no visible part of a receiver is.
    pub without_receivers: Option<f64>,
    /// Casters in all.
    pub casters: usize,
    /// Casters drawn.
    pub drawn: usize,
    /// Casters that meet the exact H.
    pub needed: usize,
    /// Casters that do and are not drawn.
    pub undrawn: usize,
    /// Casters that are drawn, and whose part in the exact H reaches out of the clip volume.
    pub cut: usize,
    /// Whether something visible lies outside of the map's sides or behind its far plane.
    pub receivers_cut: bool,
}

impl Fit {
    /// Casters that are missing in the map, wholly or in part.
    #[must_use]
    pub fn missing(&self) -> usize {
        self.undrawn + self.cut
    }
}

/// A case of the town, its truth, and what was found out on the way.
pub(crate) struct Bench<'a> {
    pub(crate) light: &'static str,
    pub(crate) index: usize,
    pub(crate) case: &'a Case<'a>,
    pub(crate) town: &'a Town,
    pub(crate) truth: &'a TownTruth,
    /// R's vertices, rounded.
    visible: Vec<DVec3>,
    /// Parts of casters in H, as they are asked for.
    parts: HashMap<usize, Body>,
}

impl<'a> Bench<'a> {
    pub(crate) fn new(
        light: &'static str,
        index: usize,
        case: &'a Case<'a>,
        town: &'a Town,
        truth: &'a TownTruth,
    ) -> Self {
        let visible = truth.truth.visible.body.vertices_f64().into_iter().map(DVec3::from).collect();
        Self { light, index, case, town, truth, visible, parts: HashMap::new() }
    }

    /// What is to be said of a fit.
    pub(crate) fn judge(&mut self, contender: &'static str, fitted: Option<&Fitted>) -> Fit {
        let needed = self.truth.needed.iter().filter(|&&needed| needed).count();
        let mut fit = Fit {
            light: self.light,
            case: self.index,
            contender,
            failed: fitted.is_none(),
            over_least: None,
            wasted: None,
            without_receivers: None,
            casters: self.town.casters.len(),
            drawn: 0,
            needed,
            undrawn: needed,
            cut: 0,
            receivers_cut: true,
        };
        let Some(fitted) = fitted else { return fit };
        let window = fitted.shadow_from_world.as_ref().and_then(Window::new);
        if let Some(shares) = window.and_then(|window| window.shares(&self.visible, &self.truth.seen)) {
            fit.over_least = Some(shares.least.recip());
            fit.wasted = Some(1.0 - shares.visible);
            fit.without_receivers = Some(1.0 - shares.receivers);
        }
        let drawn = fitted.culling.drawn(&self.town.casters);
        fit.drawn = drawn.iter().filter(|&&drawn| drawn).count();
        let tolerance = tolerance(self.case);
        let both = || self.truth.needed.iter().zip(&drawn).enumerate();
        fit.undrawn = both().filter(|(_, (needed, drawn))| **needed && !**drawn).count();
        let in_both: Vec<usize> = both().filter(|(_, (a, b))| **a && **b).map(|(index, _)| index).collect();
        fit.cut = in_both.into_iter().filter(|&index| self.is_cut(index, &fitted.clip, tolerance)).count();
        // The parts of receivers in view: the air between them need not be in a map.
        let seen = || self.truth.seen.iter().flatten();
        let is_cut = |plane: &Plane| {
            let plane = plane.normalized();
            seen().any(|point| plane.at(*point) < -tolerance)
        };
        fit.receivers_cut = sides(fitted).iter().any(is_cut);
        fit
    }

    /// Whether the part of a caster in H reaches out of planes.
    fn is_cut(&mut self, index: usize, clip: &[Plane], tolerance: f64) -> bool {
        let caster = &self.town.casters[index];
        let body = &self.truth.truth.body;
        let (min, max) = in_f64(caster);
        let (min, max) = (min.max(body.bounds.0), max.min(body.bounds.1));
        // Of most casters, the whole box is inside, by far more than f64 rounds.
        let reaches_out = |plane: &&Plane| {
            let plane = plane.normalized();
            plane.at(farthest_corner(min, max, -plane.normal)) < -0.999 * tolerance
        };
        let doubtful: Vec<&Plane> = clip.iter().filter(reaches_out).collect();
        if doubtful.is_empty() {
            return false;
        }
        let part = self.parts.entry(index).or_insert_with(|| body.part_in(caster));
        doubtful.into_iter().any(|plane| part.violation(plane.to_row().to_array()) > tolerance)
    }
}

/// The planes that what is visible must be inside of: all of a map's but the near one, before which everything is lit.
fn sides(fitted: &Fitted) -> &[Plane] {
    if fitted.shadow_from_world.is_some() { fitted.clip.get(..5).unwrap_or_default() } else { &[] }
}

/// How far outside counts, in world units: a part of the scene's diameter, and besides what f32 makes of coordinates that
/// are far out.
pub(crate) fn tolerance(case: &Case<'_>) -> f64 {
    const ROUNDINGS: f64 = 8.0;
    let (min, max) = case.bounds;
    TOLERANCE * (max - min).length() + ROUNDINGS * f64::from(f32::EPSILON) * min.abs().max(max.abs()).max_element()
}

fn lies_outside(exact: &Exact, plane: &Plane, tolerance: f64) -> bool {
    exact.body.violation(plane.to_row().to_array()) > tolerance
}

/// Whether a fit loses something of a case without lists: whether R, or H as it is culled and clipped, reaches out of it.
pub(crate) fn loses(case: &Case<'_>, truth: &Truth, fitted: &Fitted) -> bool {
    let culling = match &fitted.culling {
        Culling::Planes(planes) => planes.clone(),
        Culling::Body(body) if !body.is_empty() => body.planes().collect(),
        Culling::Body(_) | Culling::Nobody => return true,
    };
    let tolerance = tolerance(case);
    fitted.clip.iter().chain(&culling).any(|plane| lies_outside(&truth.body, plane, tolerance))
        || sides(fitted).iter().any(|plane| lies_outside(&truth.visible, plane, tolerance))
}
