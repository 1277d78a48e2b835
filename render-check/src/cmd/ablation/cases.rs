//! The cases: for each effect one light of a built-in scene where the plan does without it, and one where the plan
//! uses it.

use anyhow::{Context, Result};
use shadowfit::{Filter, Origin, Settings, View, Warp, plan::Budget};

use super::effect::Effect;
use crate::scene::{LightSpec, LoadedScene};

/// One light of a scene, for one effect.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    /// The effect.
    pub effect: Effect,
    /// Whether the plan is expected to use it.
    pub is_asked_for: bool,
    /// A built-in scene.
    pub scene: &'static str,
    /// The light, in the command line's spelling.
    pub light: &'static str,
    /// The largest map size, in texels.
    pub size: u32,
    /// The widest filter.
    pub filter: Filter,
}

impl Case {
    const fn new(effect: Effect, is_asked_for: bool, scene: &'static str, light: &'static str, size: u32) -> Self {
        Self { effect, is_asked_for, scene, light, size, filter: Filter::Hardware2x2 }
    }

    const fn filtered(self, filter: Filter) -> Self {
        Self { filter, ..self }
    }

    /// The view.
    pub(super) fn view(&self, scene: &LoadedScene, aspect: f64) -> Result<View> {
        let own = scene.camera.context("a built-in scene has a camera")?;
        let (near, far) = own.near.zip(own.far).context("a built-in scene has planes")?;
        own.view(aspect, near, far)
    }

    /// The light.
    pub(super) fn light(&self) -> Result<LightSpec> {
        self.light.parse().map_err(anyhow::Error::msg)
    }

    /// The budget.
    pub(super) fn budget(&self, image_height: u32) -> Result<Budget> {
        // A plan moves the virtual camera back for this warp alone.
        let warp = if self.effect == Effect::BackShift { Warp::Perspective } else { Warp::default() };
        let settings = Settings::new(self.size, image_height)?.with_warp(warp).with_origin(Origin::Eye);
        Ok(Budget::new(settings).with_filter(self.filter))
    }
}

const WIDE: Filter = Filter::Pcf(5);

/// All cases, effect by effect: first the one where the plan does without it, then the one where the plan uses it.
pub const CASES: [Case; 22] = [
    // A light behind the viewer whose range ends in front of the near plane.
    Case::new(Effect::Map, false, "street", "point:0,3,16/6", 1024),
    Case::new(Effect::Map, true, "chess-board", "sun:-0.8,0.6,0.2", 512),
    // Without a warp the texels are small enough.
    Case::new(Effect::Warp, false, "room", "sun:-0.8,0.42,-0.12", 1024),
    // The far end of the board has the same aliasing in both; everything nearer differs.
    Case::new(Effect::Warp, true, "chess-board", "sun:0.8,0.6,-0.4", 512),
    // Under the first sun all casters are ahead of the viewer; under the second, which is behind, they are not.
    Case::new(Effect::BackShift, false, "street", "sun:0.62,0.72,-0.42", 1024),
    Case::new(Effect::BackShift, true, "chess-board", "sun:-0.8,0.6,0.2", 512),
    // One frustum covers the table; none covers what surrounds the light in the room.
    Case::new(Effect::SeveralMaps, false, "table", "point:-1.1,1.9,0.9", 1024),
    Case::new(Effect::SeveralMaps, true, "room", "point:0,1.5,-2.5", 512),
    // A light in the middle of the image needs all six faces; one at the near side of a room does not.
    Case::new(Effect::FaceDropping, false, "chess-board", "point:0,0.8,-8", 512),
    Case::new(Effect::FaceDropping, true, "room", "point:0,1.5,-2.5", 512),
    Case::new(Effect::SecondDepth, false, "cloud", "sun:0.5,1,0.35", 512),
    Case::new(Effect::SecondDepth, true, "room", "point:0,1.5,-2.5", 512),
    // Open sheets: first in maps finer than the pixels, then in coarser maps under a sun at grazing incidence.
    Case::new(Effect::VirtualSamples, false, "leaves", "sun:-0.55,1,-0.25", 1024).filtered(Filter::Nearest),
    Case::new(Effect::VirtualSamples, true, "leaves", "sun:-1,0.35,-0.4", 512),
    // Texels no larger than pixels need no wide filter; larger ones do.
    Case::new(Effect::Filter, false, "leaves", "sun:-0.55,1,-0.25", 1024).filtered(WIDE),
    Case::new(Effect::Filter, true, "table", "sun:-0.7,1,0.4", 256),
    Case::new(Effect::FullSize, false, "table", "sun:-0.7,1,0.4", 4096),
    Case::new(Effect::FullSize, true, "chess-board", "sun:0.8,0.6,-0.4", 512),
    // In the first scene every object is a caster; around one light of a street far fewer are.
    Case::new(Effect::Culling, false, "cloud", "sun:0.5,1,0.35", 512),
    Case::new(Effect::Culling, true, "street", "point:2,5,-12/30", 512),
    // An unwarped map does not depend on the view's near plane.
    Case::new(Effect::Narrowing, false, "chess-board", "spot:6,6,-1/0,0,-5/50", 1024),
    Case::new(Effect::Narrowing, true, "street", "sun:0.62,0.72,-0.42", 1024),
];
