//! One camera in one scene, to be drawn in a sweep.

use std::path::Path;

use anyhow::{Context, Result};
use shadowfit::{Origin, View};

use super::lights::NamedLight;
use crate::maps::Technique;
use crate::run::Options;
use crate::scene::{self, Camera, LoadedScene};
use crate::stage::choose_view;
use crate::trace::Tracer;

/// Default image size, in pixels.
pub const IMAGE: [u32; 2] = [240, 150];

/// Default map size, in texels.
pub(super) const MAP_SIZE: u32 = 512;

/// No warp, the perspective warp and the best warp: enough for groups about something other than warps.
pub(super) const EXTREMES: [Technique; 3] = [Technique::Uniform, Technique::Psm, Technique::Best];

/// One camera in one scene, with its lights and the maps for each.
pub struct Shot {
    /// Description.
    pub name: String,
    /// The scene.
    pub scene: LoadedScene,
    /// The camera.
    pub view: View,
    /// Width and height of the picture, in pixels.
    pub image: [u32; 2],
    /// The origin of the maps' matrices.
    pub origin: Origin,
    /// The lights with their descriptions.
    pub lights: Vec<NamedLight>,
    /// The maps.
    pub options: Vec<Options>,
}

impl Shot {
    /// Number of runs.
    #[must_use]
    pub fn runs(&self) -> usize {
        self.lights.len() * self.options.len()
    }

    pub(super) fn with_options(self, options: Vec<Options>) -> Self {
        Self { options, ..self }
    }

    /// The same with every kind of warp.
    pub(super) fn warped(self) -> Self {
        self.with_options(Technique::WARPS.map(|technique| Options::new(technique, MAP_SIZE)).to_vec())
    }

    /// The same with a stabilised map as well.
    pub(super) fn and_stable(mut self) -> Self {
        self.options.push(Options::new(Technique::Stable, MAP_SIZE));
        self
    }
}

/// A camera in a scene; near and far planes are chosen later.
pub(super) struct Stand {
    pub(super) scene: LoadedScene,
    pub(super) camera: Camera,
}

impl Stand {
    pub(super) fn built_in(name: &str) -> Result<Self> {
        Self::before(scene::load(Path::new(name))?)
    }

    pub(super) fn before(scene: LoadedScene) -> Result<Self> {
        let camera = scene.camera.with_context(|| format!("the scene '{}' has no camera", scene.name))?;
        Ok(Self { scene, camera })
    }

    pub(super) fn with_planes(mut self, near: f64, far: f64) -> Self {
        (self.camera.near, self.camera.far) = (Some(near), Some(far));
        self
    }

    pub(super) fn shot(self, name: &str, lights: impl FnOnce(&View) -> Vec<NamedLight>) -> Result<Shot> {
        let aspect = f64::from(IMAGE[0]) / f64::from(IMAGE[1]);
        let view = choose_view(&self.camera, aspect, &Tracer::new(&self.scene.mesh)?)?.0;
        let options = Technique::COMPARED.map(|technique| Options::new(technique, MAP_SIZE)).to_vec();
        let (name, lights) = (name.to_owned(), lights(&view));
        Ok(Shot { name, lights, scene: self.scene, view, image: IMAGE, origin: Origin::Eye, options })
    }

    pub(super) fn own_lights(self, name: &str) -> Result<Shot> {
        let lights = self.scene.lights.iter().map(|light| (light.kind().to_owned(), *light)).collect();
        self.shot(name, |_| lights)
    }
}

/// The chess board.
pub(super) fn chess_board() -> Result<Stand> {
    Stand::built_in("chess-board")
}

/// The same under its own lights.
pub(super) fn lit_chess_board() -> Result<Shot> {
    chess_board()?.own_lights("chess board")
}
