//! An effect's two sides: the one that the plan chose, and the other.

use anyhow::{Result, ensure};
use shadowfit::{
    Warp,
    depth::DepthTest,
    plan::{Kind, Reason},
    warp::Shift,
};

use super::effect::Effect;
use super::setup::{Maps, Setup};
use crate::run::planned;

/// The ratio by which narrowing must move the near plane to count.
const NARROWED: f64 = 1.1;

/// Maps with the effect and without it; `None` for no map.
pub(super) struct Sides {
    /// Whether the plan asks for it.
    pub(super) is_asked_for: bool,
    pub(super) with: Option<Maps>,
    pub(super) without: Option<Maps>,
}

impl Sides {
    /// Puts the planned maps on the plan's side, and the others on the other.
    fn of(is_asked_for: bool, planned: Maps, other: Maps) -> Self {
        let (with, without) = if is_asked_for { (planned, other) } else { (other, planned) };
        Self { is_asked_for, with: Some(with), without: Some(without) }
    }

    /// The two sides of an effect for a light.
    pub(super) fn new(effect: Effect, setup: &Setup<'_>) -> Result<Self> {
        let Some(planned) = setup.planned()? else {
            ensure!(effect == Effect::Map, "{} has no map", setup.light.spec);
            return Ok(Self { is_asked_for: false, with: setup.naive()?, without: None });
        };
        let of_light = setup.of_light();
        let has = |is: fn(&Reason) -> bool| of_light.reasons().iter().any(is);
        let view = setup.narrowed();
        Ok(match effect {
            Effect::Map => Self { is_asked_for: true, with: Some(planned), without: None },
            Effect::Warp => {
                ensure!(setup.is(Kind::Uniform) || setup.is(Kind::Warped), "there is no single frustum");
                let is_warped = setup.is(Kind::Warped);
                let warp = if is_warped { Warp::Uniform } else { Warp::default() };
                let other = setup.refitted(&planned, view, |settings| {
                    Ok(settings.with_warp(warp).with_shift(Shift::default()))
                })?;
                Self::of(is_warped, planned, other)
            }
            Effect::BackShift => {
                ensure!(setup.is(Kind::Warped), "there is no warp whose camera could be moved");
                let other = setup.refitted(&planned, view, |settings| {
                    Ok(settings.with_shift(Setup::other_shift(settings.shift())))
                })?;
                Self::of(has(|reason| matches!(reason, Reason::ShiftFiner(_))), planned, other)
            }
            Effect::SeveralMaps => match setup.is(Kind::CubeFaces) {
                true => Self::of(true, planned.clone(), setup.best_face(&planned)),
                false => Self::of(false, planned.clone(), setup.faces_instead(&planned)?),
            },
            Effect::FaceDropping => {
                ensure!(setup.is(Kind::CubeFaces), "there are no faces to leave out");
                let is_complete = has(|reason| matches!(reason, Reason::Faces(6)));
                let all = setup.all_faces(&planned)?;
                Self { is_asked_for: !is_complete, with: Some(planned), without: Some(all) }
            }
            Effect::SecondDepth => {
                let is_solid = has(|reason| matches!(reason, Reason::AllSolid));
                let test = if is_solid { DepthTest::First } else { DepthTest::Second };
                let filter = planned::filter(of_light.filter(), false);
                let other = setup.read_by(&planned, test, filter)?;
                Self::of(is_solid, planned, other)
            }
            Effect::VirtualSamples => {
                let is_virtual = of_light.virtual_samples();
                let test = if is_virtual { DepthTest::First } else { DepthTest::Second };
                let filter = planned::filter(of_light.filter(), !is_virtual);
                let other = setup.read_by(&planned, test, filter)?;
                Self::of(is_virtual, planned, other)
            }
            Effect::Filter => {
                let is_widest = of_light.filter() == setup.widest();
                let other = if is_widest { shadowfit::Filter::Nearest } else { setup.widest() };
                let filter = planned::filter(other, of_light.virtual_samples());
                let other = setup.read_by(&planned, of_light.test(), filter)?;
                Self::of(is_widest, planned, other)
            }
            Effect::FullSize => {
                let is_smaller = has(|reason| matches!(reason, Reason::SmallerMap(_)));
                let other = setup.refitted(&planned, view, |settings| {
                    let size = if is_smaller { setup.largest() } else { settings.map_size() / 2 };
                    Ok(settings.with_map_size(size)?)
                })?;
                Self::of(!is_smaller, planned, other)
            }
            Effect::Culling => {
                let all = setup.undiscerning(&planned);
                let is_asked_for =
                    all.fitted.drawn(setup.stage).triangles > planned.fitted.drawn(setup.stage).triangles;
                Self { is_asked_for, with: Some(planned), without: Some(all) }
            }
            Effect::Narrowing => {
                let whole = setup.unnarrowed(&planned)?;
                // Only a warp depends on the view's near plane.
                let is_warped =
                    planned.fitted.maps.iter().flatten().any(|one| one.map.settings().warp() != Warp::Uniform);
                let is_asked_for = is_warped && view.near() > NARROWED * setup.stage.view.near();
                Self { is_asked_for, with: Some(planned), without: Some(whole) }
            }
        })
    }
}
