//! The check of one scene: every light with each technique and map size, drawn on the GPU and compared with
//! ray-traced truth.

mod args;
mod pictures;
mod table;

use std::time::Instant;

use anyhow::{Result, ensure};
use serde::Serialize;
use shadowfit::glam::DVec3;

pub use args::CheckArgs;
pub(crate) use args::HELP;

use pictures::Pictures;
use table::CheckTable;

use crate::cli::{ViewArgs, choose_lights, open, output_directory, place_camera, sort};
use crate::gpu::Gpu;
use crate::output::progress::bar;
use crate::output::{say, write_json};
use crate::run::{CameraReport, RunReport, run};
use crate::scene::damage::in_single_precision;
use crate::scene::{LeftOut, LightSpec, LoadedScene};
use crate::stage::Stage;

/// The report of a check.
#[derive(Clone, Debug, Serialize)]
pub struct CheckReport {
    /// The scene's name.
    pub scene: String,
    /// What was left out of it.
    pub left_out: LeftOut,
    /// The graphics adapter.
    pub adapter: String,
    /// Width and height of the camera's image, in pixels.
    pub image: [u32; 2],
    /// The camera.
    pub camera: CameraReport,
    /// The camera that the maps were fitted to: the same, or narrowed to the depth range of the visible surfaces.
    pub fitted: CameraReport,
    /// Every run, light by light.
    pub runs: Vec<RunReport>,
}

/// Camera options and scene translated by `--at`, all positions rounded to f32.
fn moved(args: &CheckArgs, scene: LoadedScene) -> (ViewArgs, LoadedScene) {
    let mut asked = args.view.clone();
    let Some(offset) = args.at else { return (asked, scene) };
    let position = |position: DVec3| (position + offset).as_vec3().as_dvec3();
    asked.eye = asked.eye.map(position);
    asked.target = asked.target.map(position);
    asked.lights.iter_mut().for_each(|light| *light = light.with_position(position));
    (asked, in_single_precision(&scene.moved(1.0, offset)))
}

/// The near plane of a local light, and a hint where a larger one would cost nothing; empty for a sun.
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
/// When nothing can be checked, with a hint; and when a caster is missing from a map.
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
    let stage = if args.boxes { stage.with_boxes()? } else { stage };
    let stage = if args.seen { stage.seeing() } else { stage };
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
    write_json(&report, &out.join("check.json"))?;
    say(&format!("\nwrote check.json and the pictures to {}", out.display()));
    let missing: usize = report.runs.iter().map(RunReport::missing).sum();
    ensure!(
        missing == 0,
        "{missing} pixels are lit because a caster is missing from a map: see the magenta pixels"
    );
    Ok(())
}

/// Narrows the view that maps are fitted to, and prints the new range.
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
