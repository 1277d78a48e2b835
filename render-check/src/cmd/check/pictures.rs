//! The pictures of one light: the truth, and several for each run.

use std::path::Path;

use anyhow::Result;
use image::RgbImage;

use crate::maps::NoMap;
use crate::picture::{CloseUp, Lighting, aliasing_map, difference, save, shaded, side_by_side, stored_map, tinted};
use crate::run::{MapRun, Options};
use crate::scene::Mesh;
use crate::stage::{Stage, StageLight};

/// The pictures of one light.
pub(super) struct Pictures<'a> {
    out: &'a Path,
    number: usize,
    light: &'a StageLight,
    mesh: &'a Mesh,
    lighting: Lighting,
    truth: RgbImage,
    close_up: Option<CloseUp>,
    /// One of the truth, and one of each run.
    close_ups: Vec<RgbImage>,
}

impl<'a> Pictures<'a> {
    /// Also writes the picture of the truth.
    pub(super) fn new(
        out: &'a Path,
        number: usize,
        stage: &'a Stage<'a>,
        light: &'a StageLight,
        close_up: Option<CloseUp>,
    ) -> Result<Self> {
        let (min, max) = stage.tracer.bounds();
        let lighting = Lighting::new(light.spec, 0.5 * (min + max));
        let truth = shaded(&light.truth, &lighting, stage.tracer.mesh(), &light.truth.lit());
        let close_ups = close_up.iter().map(|close_up| close_up.of(&truth, "truth")).collect();
        let mesh = stage.tracer.mesh();
        let pictures = Self { out, number, light, mesh, lighting, truth, close_up, close_ups };
        pictures.save("truth", &pictures.truth)?;
        Ok(pictures)
    }

    fn save(&self, what: &str, image: &RgbImage) -> Result<()> {
        save(image, &self.out.join(format!("{}-{}-{what}.png", self.number, self.light.spec.kind())))
    }

    pub(super) fn of_run(&mut self, options: &Options, result: &Result<MapRun, NoMap>) -> Result<()> {
        let Ok(run) = result else { return Ok(()) };
        let name = options.name().replace(" x ", "x").replace(' ', "-");
        let image = shaded(&self.light.truth, &self.lighting, self.mesh, &run.lit);
        self.save(&format!("{name}-image"), &image)?;
        self.close_ups.extend(self.close_up.map(|close_up| close_up.of(&image, &options.technique.to_string())));
        self.save(&format!("{name}-faults"), &difference(&self.truth, &run.verdict.marks))?;
        let of_maps = run.fitted.maps.iter().flatten().zip(&run.depths);
        let stored: Vec<_> = of_maps.map(|(fitted, depths)| stored_map(&fitted.map, depths)).collect();
        self.save(&format!("{name}-map"), &side_by_side(&stored))?;
        if options.cascading.is_some() {
            let tinted = tinted(&image, &self.light.truth, &run.fitted.split);
            self.save(&format!("{name}-cascades"), &side_by_side(&[self.truth.clone(), tinted]))?;
        }
        self.save(&format!("{name}-aliasing"), &aliasing_map(&self.light.truth, |point| run.aliasing(point)))
    }

    pub(super) fn finish(&self) -> Result<()> {
        if self.close_ups.is_empty() { Ok(()) } else { self.save("close-up", &side_by_side(&self.close_ups)) }
    }
}
