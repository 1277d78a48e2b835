//! Successive frames of the same maps, for timing.

use std::time::Duration;

use anyhow::Result;

use super::fitted_maps::FittedMaps;
use crate::gpu::{Filter, ShadowMaps, Shadows, shadow_test};
use crate::stage::Stage;

/// The maps of a light with GPU memory of their own, drawn and tested every frame as in a renderer.
pub struct Frames<'a> {
    stage: &'a Stage<'a>,
    fitted: &'a FittedMaps,
    filter: Filter,
    shadow_maps: ShadowMaps,
}

/// The results of a frame.
pub struct Frame {
    /// GPU time of the maps, where timestamps are supported.
    pub shadow_maps: Option<Duration>,
    /// The result of the shadow test, and its time.
    pub shadows: Shadows,
}

impl<'a> Frames<'a> {
    /// Draws the maps once, so that their memory is allocated and written before the first frame.
    ///
    /// # Errors
    ///
    /// When the GPU reports an error.
    pub fn new(stage: &'a Stage<'a>, fitted: &'a FittedMaps, filter: Filter) -> Result<Self> {
        Ok(Self { stage, fitted, filter, shadow_maps: fitted.draw(stage)? })
    }

    /// Draws the maps and tests every pixel against them.
    ///
    /// # Errors
    ///
    /// When the GPU reports an error.
    pub fn draw(&mut self) -> Result<Frame> {
        self.fitted.draw_again(self.stage, &mut self.shadow_maps)?;
        let shadows = shadow_test(self.stage.gpu, &self.stage.surfaces, &self.shadow_maps, self.filter)?;
        Ok(Frame { shadow_maps: self.shadow_maps.time, shadows })
    }

    /// The depths of each map, see [`ShadowMaps::depths`].
    ///
    /// # Errors
    ///
    /// When the GPU reports an error.
    pub fn depths(&self) -> Result<Vec<Vec<f32>>> {
        self.shadow_maps.depths(self.stage.gpu)
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::gpu::Gpu;
    use crate::maps::Technique;
    use crate::run::Options;
    use crate::scene;
    use crate::stage::choose_view;
    use crate::trace::{Faces, Tracer};

    #[test]
    fn each_frame_is_the_one_before_whoever_drew_between() {
        let gpu = Gpu::new().expect("there is an adapter");
        let scene = scene::load(Path::new("table")).expect("built in");
        let tracer = Tracer::new(&scene.mesh).expect("it has triangles");
        let (view, _) = choose_view(&scene.camera.expect("it has one"), 1.6, &tracer).expect("in view");
        let stage = Stage::new(&gpu, &tracer, &view, [48, 30]).expect("it can be drawn");
        let light = scene.lights[0].to_light(stage.lamp_near(&scene.lights[0])).expect("a sound light");
        let plain = Options::new(Technique::Uniform, 64);
        let ways =
            [plain, Options { faces: Faces::Layers, ..plain }, Options { technique: Technique::Psm, ..plain }];
        let fitted = ways.map(|options| FittedMaps::new(&stage, &light, &options).expect("drawn").expect("needed"));
        let mut frames: Vec<_> =
            fitted.iter().map(|fitted| Frames::new(&stage, fitted, Filter::Nearest).expect("drawn")).collect();
        let of_round = |frames: &mut Vec<Frames<'_>>| -> Vec<_> {
            let of = |frames: &mut Frames<'_>| {
                let lit = frames.draw().expect("drawn again").shadows.lit;
                (lit, frames.depths().expect("read back"))
            };
            frames.iter_mut().map(of).collect()
        };
        let once = of_round(&mut frames);
        assert!(once == of_round(&mut frames));
        // The three maps differ.
        assert!(once[0].1 != once[2].1 && once[0].0 != once[2].0);
    }
}
