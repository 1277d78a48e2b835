//! One light: the cheapest technique that suffices for it.

use super::budget::Budget;
use super::groups::{loosened, meets};
use super::objects::{Object, Objects, Surface};
use super::reason::Reason;
use super::seen::{Seen, points};
use super::{Kind, LightPlan, Pass, Projection};
use crate::convex::Plane;
use crate::depth::second_depth::DepthTest;
use crate::fit::{Empty, Outcome};
use crate::focus::{Focus, FocusForm};
use crate::input::light::Light;
use crate::input::scene::{Aabb, Scene};
use crate::mesh::Solidity;
use crate::settings::filter::Filter;
use crate::settings::{Settings, Shift, Warp};
use alloc::vec::Vec;
use glam::{DVec2, DVec3};

/// Texels no finer than this are no gain: a map with more parts to it has to be better by so much.
pub(super) const WORTH: f64 = 1.1;

/// A warp's camera is moved back where texels are finer by more than this: by less, both are the same but for rounding.
const SAME: f64 = 1.01;

/// Texels smaller than this part of a pixel need no filter.
const HIDDEN: f64 = 0.5;

/// Texels up to so many pixels need no wider filter than the sampler's own, which blends from one to the next. A wider one
/// hides no more steps there, and loses shadows as thin as the filter is wide.
const BLENDED: f64 = 1.0;

/// A bias that moves shadows by no more pixels than this is hidden: a pixel at their edges is off by as much anyway.
const HIDDEN_BIAS: f64 = 1.0;

/// The objects that a light may reach.
#[derive(Default)]
pub(super) struct Reach {
    pub(super) receivers: Vec<Aabb>,
    pub(super) casters: Vec<Aabb>,
    /// The objects of `casters`.
    pub(super) ids: Vec<u32>,
}

impl Reach {
    /// Collects the receivers and casters inside the planes of a light.
    fn gather(&mut self, seen: &Seen, objects: &Objects, light: &[Plane]) {
        let Self { receivers, casters, ids, .. } = self;
        receivers.clear();
        casters.clear();
        ids.clear();
        seen.receivers.for_each_inside(light, |_, one| receivers.push(*one));
        if !receivers.is_empty() {
            objects.casters.for_each_inside(light, |id, one| {
                casters.push(*one);
                ids.push(id);
            });
        }
    }
}

/// Maps under consideration.
pub(super) struct Candidate {
    pub(super) kind: Kind,
    pub(super) projections: Vec<Projection>,
    /// The worst aliasing.
    pub(super) aliasing: f64,
    /// The mean aliasing over the points where maps are compared.
    mean: f64,
}

/// A candidate; none where no map of its kind serves, or where no map is needed.
pub(super) type Found = Result<Option<Candidate>, Empty>;

impl Candidate {
    pub(super) fn new(kind: Kind, projections: Vec<Projection>, points: &[DVec3]) -> Self {
        let of = |point| projections.iter().find_map(|projection| projection.aliasing(point));
        let each = || points.iter().map(|&point| of(point).unwrap_or(f64::INFINITY));
        let (aliasing, sum) = each().fold((0.0, 0.0), |(worst, sum), one| (one.max(worst), sum + one));
        Self { kind, projections, aliasing, mean: sum / points.len() as f64 }
    }

    /// The faces of a cube, with their worst texel.
    pub(super) const fn faces(projections: Vec<Projection>, aliasing: f64) -> Self {
        Self { kind: Kind::CubeFaces, projections, aliasing, mean: aliasing }
    }

    /// How many times as large its texels are as those of another: the geometric mean of the ratios at worst and on
    /// the mean.
    ///
    /// The worst alone would not tell: a point where all maps are as coarse, as where the ground runs out of view, may be
    /// the worst of all, while everything else is twice as fine.
    fn times(&self, other: &Self) -> f64 {
        // The square root of an f64 is in `std` alone; glam has it from `libm` too.
        DVec2::splat(self.aliasing / other.aliasing * (self.mean / other.mean)).sqrt().x
    }
}

/// All that the choices for one light are made from.
pub(super) struct Planner<'a> {
    pub(super) seen: &'a Seen,
    pub(super) objects: &'a Objects,
    pub(super) budget: &'a Budget,
    /// The largest map, in texels a side.
    pub(super) most: u32,
}

impl Planner<'_> {
    /// Plans one light and appends the casters of its passes to `casters`.
    pub(super) fn plan(&self, light: &Light, reach: &mut Reach, casters: &mut Vec<u32>) -> LightPlan {
        reach.gather(self.seen, self.objects, &loosened(light.planes().as_slice(), self.objects.extent));
        if reach.receivers.is_empty() {
            return LightPlan::nothing(Reason::NoReceivers);
        }
        if reach.casters.is_empty() {
            return LightPlan::nothing(Reason::NoCasters);
        }
        let scene = Scene::of_checked(&reach.casters, &reach.receivers);
        let focus = Focus::new(&self.seen.view, light, &scene);
        let mut points = points(&focus, &reach.receivers);
        if points.is_empty() {
            points.extend(focus.receiver_volume().vertices());
        }
        let mut reasons = Vec::new();
        match self.choose(&focus, &points, reach, &mut reasons) {
            Ok(candidate) => self.finish(&focus, candidate, reach, casters, reasons),
            Err(Empty::NoReceivers) => LightPlan::nothing(Reason::NoReceivers),
            Err(Empty::NoCasters) => LightPlan::nothing(Reason::NoCasters),
        }
    }

    /// How maps of so many texels a side are fitted.
    pub(super) fn settings(&self, size: u32) -> Settings {
        let budget = self.budget.settings();
        let border = self.budget.filter().border().max(budget.border());
        // Within what settings allow, which have been checked.
        let settings = budget.with_border(0).and_then(|settings| settings.with_map_size(size));
        settings.and_then(|settings| settings.with_border(border.min(size / 4))).unwrap_or(*budget)
    }

    /// The smallest map that is fine enough: of the largest size, or a half, a quarter, … of it.
    pub(super) fn sized(&self, at: impl Fn(u32, &mut Vec<Reason>) -> Found, reasons: &mut Vec<Reason>) -> Found {
        let before = reasons.len();
        let Some(largest) = at(self.most, reasons)? else { return Ok(None) };
        let (mut size, mut aliasing) = (self.most, 2.0 * largest.aliasing);
        while aliasing <= self.budget.aliasing() && size / 2 >= Budget::SMALLEST_MAP {
            (size, aliasing) = (size / 2, 2.0 * aliasing);
        }
        // A uniform map that is fine enough stands for a warped one as well, which may be so at half the size.
        let can_warp = largest.kind == Kind::Uniform && self.budget.settings().warp().bends();
        if can_warp && largest.aliasing <= self.budget.aliasing() && size / 2 >= Budget::SMALLEST_MAP {
            size /= 2;
        }
        // A smaller map has more border and padding for its size, which may be too much.
        while size < self.most {
            let reasons_of_largest = reasons.split_off(before);
            match at(size, reasons)? {
                Some(candidate) if candidate.aliasing <= self.budget.aliasing() => return Ok(Some(candidate)),
                _ => size *= 2,
            }
            reasons.truncate(before);
            reasons.extend(reasons_of_largest);
        }
        Ok(Some(largest))
    }

    fn choose(
        &self,
        focus: &Focus<'_>,
        points: &[DVec3],
        reach: &Reach,
        reasons: &mut Vec<Reason>,
    ) -> Result<Candidate, Empty> {
        match self.sized(|size, reasons| self.frustum(focus, points, size, reasons), reasons)? {
            Some(frustum) => Ok(self.instead_of_wide(focus, points, &frustum, reach, reasons)?.unwrap_or(frustum)),
            None => self.omni(focus, points, reach, reasons),
        }
    }

    /// One frustum, warped or not; `None` when none holds all receivers.
    pub(super) fn frustum(
        &self,
        focus: &Focus<'_>,
        points: &[DVec3],
        size: u32,
        reasons: &mut Vec<Reason>,
    ) -> Found {
        let fit = |warp: Warp, shift| {
            let map = match focus.fit(&self.settings(size).with_warp(warp).with_shift(shift)) {
                Outcome::Map(map) => map,
                Outcome::Empty(empty) => return Err(empty),
                Outcome::Surrounded(_) => return Ok(None),
            };
            let kind = if warp.bends() { Kind::Warped } else { Kind::Uniform };
            Ok(Some(Candidate::new(kind, alloc::vec![Projection::Frustum(map)], points)))
        };
        let (wanted, shift) = (self.budget.settings().warp(), self.budget.settings().shift());
        let straight = if wanted.bends() { Warp::Uniform } else { wanted };
        let Some(uniform) = fit(straight, Shift::None)? else { return Ok(None) };
        if uniform.aliasing <= self.budget.aliasing() {
            reasons.push(Reason::UniformEnough);
            return Ok(Some(uniform));
        }
        if !wanted.bends() {
            reasons.push(Reason::NoWarpWanted);
            return Ok(Some(uniform));
        }
        // A light that a frustum serves without a warp it serves with one.
        let (warped, why) = match wanted {
            Warp::Perspective => {
                let unshifted = fit(wanted, Shift::None)?;
                let shifted = fit(wanted, Shift::Back(FocusForm::ViewHull))?;
                let (Some(unshifted), Some(shifted)) = (unshifted, shifted) else { return Ok(Some(uniform)) };
                let times = shifted.times(&unshifted);
                if times * SAME < 1.0 {
                    (shifted, Some(Reason::ShiftFiner(times.recip())))
                } else {
                    (unshifted, Some(Reason::NoShiftFiner(times)))
                }
            }
            _ => match fit(wanted, shift)? {
                Some(warped) => (warped, None),
                None => return Ok(Some(uniform)),
            },
        };
        // What a viewer sees decides: texels and bias at the surfaces in view.
        let error = |candidate: &Candidate| match candidate.projections.first() {
            Some(Projection::Frustum(map)) => map.surface_error(focus).map(|error| error.mean),
            _ => None,
        };
        let times = error(&warped).zip(error(&uniform)).map(|(warped, uniform)| warped / uniform);
        let times = times.unwrap_or_else(|| warped.times(&uniform));
        Ok(Some(if times * WORTH < 1.0 {
            reasons.push(Reason::WarpFiner(times));
            reasons.extend(why);
            warped
        } else {
            reasons.push(Reason::WarpNoFiner(times));
            uniform
        }))
    }

    /// Which casters each pass draws, how they are tested, and how the maps are read.
    fn finish(
        &self,
        focus: &Focus<'_>,
        candidate: Candidate,
        reach: &Reach,
        casters: &mut Vec<u32>,
        mut reasons: Vec<Reason>,
    ) -> LightPlan {
        let Candidate { kind, projections, aliasing, .. } = candidate;
        let (mut passes, mut made_of) = (Vec::new(), MadeOf::default());
        for projection in projections {
            let pass = self.pass(focus, projection, reach, casters, &mut made_of);
            if !pass.casters.is_empty() {
                passes.push(pass);
            }
        }
        let Some(size) = passes.iter().map(Pass::map_size).max() else {
            return LightPlan::nothing(Reason::NoCasters);
        };
        if kind == Kind::CubeFaces {
            reasons.push(Reason::Faces(passes.len() as u32));
        }
        if let Some(nearest) = focus.light().distance_to_casters(&reach.casters)
            && nearest > 2.0 * focus.light().near()
        {
            reasons.push(Reason::NearTooSmall(nearest));
        }
        if size < self.most {
            reasons.push(Reason::SmallerMap(size));
        }
        let filter = match self.budget.filter() {
            _ if aliasing <= HIDDEN => Filter::Nearest,
            Filter::Pcf(3..) if aliasing <= BLENDED => Filter::Hardware2x2,
            widest => widest,
        };
        let (test, virtual_samples) = made_of.test(kind, 2.0 * filter.reach() * aliasing, &mut reasons);
        reasons.push(match filter {
            Filter::Nearest if aliasing <= HIDDEN => Reason::TexelsHidden(aliasing),
            Filter::Hardware2x2 if aliasing <= BLENDED => Reason::TexelsBlend(aliasing),
            _ => Reason::TexelsShow(aliasing),
        });
        if test == DepthTest::First {
            for pass in &mut passes {
                pass.bias = pass.projection.bias(self.budget.format(), filter.reach());
            }
        }
        LightPlan { kind, test, virtual_samples, filter, aliasing, passes, reasons }
    }

    fn pass(
        &self,
        focus: &Focus<'_>,
        projection: Projection,
        reach: &Reach,
        casters: &mut Vec<u32>,
        made_of: &mut MadeOf,
    ) -> Pass {
        let Reach { receivers, casters: boxes, ids } = reach;
        let body = match &projection {
            Projection::Face(_, map) => {
                let scene = Scene::of_checked(boxes, receivers);
                Focus::new(&self.seen.view, &map.light, &scene).caster_volume(FocusForm::ReceiverHull)
            }
            _ => focus.caster_volume(FocusForm::ReceiverHull),
        };
        let half_space = match &projection {
            Projection::Paraboloid(paraboloid) => loosened(&[paraboloid.clip_plane()], self.objects.extent),
            _ => Vec::new(),
        };
        let mut drawn = alloc::vec![false; boxes.len()];
        body.culler().boxes(boxes, &mut drawn);
        let (begin, mut triangles) = (casters.len(), 0);
        for ((&id, one), _) in ids.iter().zip(boxes).zip(&drawn).filter(|(_, drawn)| **drawn) {
            if meets(one, &half_space) {
                let object = self.objects.get(id);
                triangles += u64::from(object.triangles);
                made_of.include(object);
                casters.push(id);
            }
        }
        Pass { projection, bias: None, casters: begin..casters.len(), triangles }
    }
}

/// The surfaces of a light's casters.
#[derive(Default)]
struct MadeOf {
    curved_sheets: bool,
    flat_sheets: bool,
    points: bool,
}

impl MadeOf {
    fn include(&mut self, object: &Object) {
        match object.surface {
            Surface::Mesh(Solidity::Watertight | Solidity::Inverted) => {}
            Surface::Mesh(Solidity::Open) => self.curved_sheets = true,
            Surface::FlatSheets => self.flat_sheets = true,
            Surface::Points => self.points = true,
        }
    }

    /// The depth test for these casters, and whether by virtual samples, where a bias would move shadows by so many pixels.
    ///
    /// An open mesh is stored in second depth too, and virtual samples tell it from its receivers where it is flat.
    /// Beside a bend the plane goes on where the mesh does not, so that a curved one would need a bias all the same.
    fn test(&self, kind: Kind, moved: f64, reasons: &mut Vec<Reason>) -> (DepthTest, bool) {
        let has_samples = !matches!(kind, Kind::Paraboloid | Kind::DualParaboloid);
        let (test, virtual_samples, why) = if self.points {
            (DepthTest::First, false, Reason::PointsCast)
        } else if self.curved_sheets {
            (DepthTest::First, false, Reason::SheetsCurve)
        } else if !self.flat_sheets {
            (DepthTest::Second, false, Reason::AllSolid)
        } else if moved <= HIDDEN_BIAS || !has_samples {
            (DepthTest::First, false, Reason::BiasHidden(moved))
        } else {
            (DepthTest::Second, true, Reason::BiasShows(moved))
        };
        reasons.push(why);
        (test, virtual_samples)
    }
}
