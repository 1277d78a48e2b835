//! The cases: a light before a built-in scene for each effect, where a plan leaves it out and where it asks for it.

use anyhow::{Context, Result};
use shadowfit::{Filter, Origin, Settings, View, Warp, plan::Budget};

use super::effect::Effect;
use crate::scene::{LightSpec, LoadedScene};

/// A light of a scene, for an effect.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    /// What is left out or asked for.
    pub effect: Effect,
    /// Whether a plan is expected to ask for it.
    pub is_asked_for: bool,
    /// A built-in scene.
    pub scene: &'static str,
    /// The light, as the command line spells it.
    pub light: &'static str,
    /// The most texels a side.
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
        // Only the camera of that warp is moved back by a plan.
        let warp = if self.effect == Effect::BackShift { Warp::Perspective } else { Warp::default() };
        let settings = Settings::new(self.size, image_height)?.with_warp(warp).with_origin(Origin::Eye);
        Ok(Budget::new(settings).with_filter(self.filter))
    }
}

const WIDE: Filter = Filter::Pcf(5);

/// All of them, effect by effect: first where it is left out, then where it is asked for.
pub const CASES: [Case; 22] = [
    // A lamp behind the viewer, whose light ends before the view begins.
    Case::new(Effect::Map, false, "street", "point:0,3,16/6", 1024),
    Case::new(Effect::Map, true, "chess-board", "sun:-0.8,0.6,0.2", 512),
    // Fine enough without a warp.
    Case::new(Effect::Warp, false, "room", "sun:-0.8,0.42,-0.12", 1024),
    // The far end of the board is as coarse in both; all that is nearer is not.
    Case::new(Effect::Warp, true, "chess-board", "sun:0.8,0.6,-0.4", 512),
    // All that casts into the view is ahead of the viewer; not so where the sun stands behind.
    Case::new(Effect::BackShift, false, "street", "sun:0.62,0.72,-0.42", 1024),
    Case::new(Effect::BackShift, true, "chess-board", "sun:-0.8,0.6,0.2", 512),
    // One frustum holds all of the table, and none what is around a lamp in the room.
    Case::new(Effect::SeveralMaps, false, "table", "point:-1.1,1.9,0.9", 1024),
    Case::new(Effect::SeveralMaps, true, "room", "point:0,1.5,-2.5", 512),
    // A lamp in the middle of the picture needs all six; one at the near side of a room does not.
    Case::new(Effect::FaceDropping, false, "chess-board", "point:0,0.8,-8", 512),
    Case::new(Effect::FaceDropping, true, "room", "point:0,1.5,-2.5", 512),
    Case::new(Effect::SecondDepth, false, "cloud", "sun:0.5,1,0.35", 512),
    Case::new(Effect::SecondDepth, true, "room", "point:0,1.5,-2.5", 512),
    // Sheets in maps finer than the pixels, and in coarser ones under a sun that grazes the ground.
    Case::new(Effect::VirtualSamples, false, "leaves", "sun:-0.55,1,-0.25", 1024).filtered(Filter::Nearest),
    Case::new(Effect::VirtualSamples, true, "leaves", "sun:-1,0.35,-0.4", 512),
    // Texels no larger than pixels need no wide filter, and larger ones need one.
    Case::new(Effect::Filter, false, "leaves", "sun:-0.55,1,-0.25", 1024).filtered(WIDE),
    Case::new(Effect::Filter, true, "table", "sun:-0.7,1,0.4", 256),
    Case::new(Effect::FullSize, false, "table", "sun:-0.7,1,0.4", 4096),
    Case::new(Effect::FullSize, true, "chess-board", "sun:0.8,0.6,-0.4", 512),
    // All there is casts into view, and of a street far less does around one lamp.
    Case::new(Effect::Culling, false, "cloud", "sun:0.5,1,0.35", 512),
    Case::new(Effect::Culling, true, "street", "point:2,5,-12/30", 512),
    // A map without a warp does not follow the view's near plane.
    Case::new(Effect::Narrowing, false, "chess-board", "spot:6,6,-1/0,0,-5/50", 1024),
    Case::new(Effect::Narrowing, true, "street", "sun:0.62,0.72,-0.42", 1024),
];
