//! The check of one scene: every light, with each technique and size of map, drawn on the card and held against the
//! truth.

use std::path::Path;
use std::time::Instant;

use anyhow::{Result, ensure};
use image::RgbImage;
use serde::Serialize;
use shadowfit::glam::DVec3;

use crate::args::{CheckArgs, ViewArgs};
use crate::check_table::CheckTable;
use crate::fitting::NoMap;
use crate::gpu::Gpu;
use crate::light::LightSpec;
use crate::opening::{choose_lights, open, output_directory, place_camera, say, sort};
use crate::picture::{CloseUp, Lighting, aliasing_map, difference, save, shaded, side_by_side, stored_map, tinted};
use crate::progress::bar;
use crate::report::{self, CameraReport, RunReport};
use crate::run::{MapRun, Options, run};
use crate::scene::damage::in_single_precision;
use crate::scene::{LeftOut, LoadedScene, Mesh};
use crate::stage::{Stage, StageLight};

/// All that is known after a check.
#[derive(Clone, Debug, Serialize)]
pub struct CheckReport {
    /// The scene's name.
    pub scene: String,
    /// What was left out of it.
    pub left_out: LeftOut,
    /// What drew it.
    pub adapter: String,
    /// Width and height of the camera's image, in pixels.
    pub image: [u32; 2],
    /// The camera.
    pub camera: CameraReport,
    /// What the maps were fitted to: the camera, or what of its depth something is seen in.
    pub fitted: CameraReport,
    /// Every run, light by light.
    pub runs: Vec<RunReport>,
}

/// What is asked for where it is to be: all positions moved, and in f32, as world space has them there.
fn moved(args: &CheckArgs, scene: LoadedScene) -> (ViewArgs, LoadedScene) {
    let mut asked = args.view.clone();
    let Some(offset) = args.at else { return (asked, scene) };
    let position = |position: DVec3| (position + offset).as_vec3().as_dvec3();
    asked.eye = asked.eye.map(position);
    asked.target = asked.target.map(position);
    asked.lights.iter_mut().for_each(|light| *light = light.with_position(position));
    (asked, in_single_precision(&scene.moved(1.0, offset)))
}

/// Where a lamp's map begins, and whether that costs precision for nothing; nothing of a sun.
fn near_words(stage: &Stage<'_>, spec: &LightSpec) -> String {
    let Some(position) = spec.position() else { return String::new() };
    let (near, nearest) = (stage.lamp_near(spec), stage.tracer.distance_to(position));
    let costs =
        if near < 0.25 * nearest { "; a larger --lamp-near loses nothing and makes depth finer" } else { "" };
    format!("its map begins {near:.3} from it, the nearest surface is {nearest:.3} from it{costs}\n")
}

/// Checks a scene.
///
/// # Errors
///
/// When nothing can be checked, with a message that says what to do; and when a caster is missing from a map.
pub fn check(args: &CheckArgs) -> Result<()> {
    let (asked, scene) = moved(args, open(&args.view)?);
    let out = output_directory(&asked, &scene)?;
    let tracer = sort(&scene.mesh)?;
    let (_, view) = place_camera(&asked, &scene, &tracer)?;
    let gpu = Gpu::new()?;
    say(&format!("drawn by {}", gpu.name()));

    let size = [args.view.width, args.view.height];
    let stage = Stage::new(&gpu, &tracer, &view, size)?.with_lamp_near(args.view.lamp_near);
    let stage = if args.at.is_some() { stage.in_world_space()? } else { stage };
    let stage = if args.narrow { narrowed(stage)? } else { stage };
    let lights = choose_lights(&asked, &scene);
    let options = args.map.options(args.frames);
    let bar = bar("checking", lights.len() * options.len());
    let mut runs = Vec::new();
    for (i, spec) in lights.into_iter().enumerate() {
        let light = stage.light(spec)?;
        let mut pictures = Pictures::new(&out, i + 1, &stage, &light, args.close_up)?;
        let mut table = CheckTable::new();
        for options in &options {
            let result = run(&stage, &light, options)?;
            match &result {
                Ok(run) => table.add_maps(options, run),
                Err(none) => table.add_no_map(options, none),
            }
            pictures.of_run(options, &result)?;
            runs.push(RunReport::new(&view, &light, options, &result));
            bar.inc(1);
        }
        pictures.finish()?;
        let class = shadowfit::warp::classify(&view, &light.light).kind;
        let [compared, shadowed] = [light.truth.compared(), light.truth.shadowed()];
        let title = format!("\nlight {}: {spec}, {class}; {compared} pixels compared, {shadowed} in shadow", i + 1);
        let near = near_words(&stage, &spec);
        bar.suspend(|| say(&format!("{title}\n{near}{table}")));
    }
    bar.finish_and_clear();

    let report = CheckReport {
        scene: scene.name,
        left_out: scene.left_out,
        adapter: gpu.name().to_owned(),
        image: stage.size,
        camera: CameraReport::from(&view),
        fitted: CameraReport::from(&stage.fitted_view),
        runs,
    };
    report::write(&report, &out.join("check.json"))?;
    say(&format!("\nwrote check.json and the pictures to {}", out.display()));
    let missing: usize = report.runs.iter().map(RunReport::missing).sum();
    ensure!(
        missing == 0,
        "{missing} pixels are lit because a caster is missing from a map: see the magenta pixels"
    );
    Ok(())
}

/// Narrows what maps are fitted to, and says how far.
fn narrowed(stage: Stage<'_>) -> Result<Stage<'_>> {
    let start = Instant::now();
    let stage = stage.narrowed()?;
    say(&format!(
        "narrowed to what is seen: near {:.4}, far {:.4}, read back in {:.1} ms",
        stage.fitted_view.near(),
        stage.fitted_view.far(),
        start.elapsed().as_secs_f64() * 1e3
    ));
    Ok(stage)
}

/// The pictures of one light.
struct Pictures<'a> {
    out: &'a Path,
    number: usize,
    light: &'a StageLight,
    mesh: &'a Mesh,
    lighting: Lighting,
    truth: RgbImage,
    close_up: Option<CloseUp>,
    /// Of the truth, and of each run.
    close_ups: Vec<RgbImage>,
}

impl<'a> Pictures<'a> {
    /// Writes the true picture, too.
    fn new(
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

    fn of_run(&mut self, options: &Options, result: &Result<MapRun, NoMap>) -> Result<()> {
        let Ok(run) = result else { return Ok(()) };
        let name = options.name().replace(" x ", "x").replace(' ', "-");
        let image = shaded(&self.light.truth, &self.lighting, self.mesh, &run.lit);
        self.save(&format!("{name}-image"), &image)?;
        self.close_ups.extend(self.close_up.map(|close_up| close_up.of(&image, &options.technique.to_string())));
        self.save(&format!("{name}-faults"), &difference(&self.truth, &run.verdict.marks))?;
        let of_maps = run.fitted.maps.iter().flatten().zip(&run.depths);
        let stored: Vec<_> = of_maps.map(|(fitted, depths)| stored_map(&fitted.map, depths)).collect();
        self.save(&format!("{name}-map"), &side_by_side(&stored))?;
        if options.slicing.is_some() {
            let tinted = tinted(&image, &self.light.truth, &run.fitted.split);
            self.save(&format!("{name}-slices"), &side_by_side(&[self.truth.clone(), tinted]))?;
        }
        self.save(&format!("{name}-aliasing"), &aliasing_map(&self.light.truth, |point| run.aliasing(point)))
    }

    fn finish(&self) -> Result<()> {
        if self.close_ups.is_empty() { Ok(()) } else { self.save("close-up", &side_by_side(&self.close_ups)) }
    }
}
