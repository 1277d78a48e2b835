//! A camera that walks, and the pixels that flicker: light and shadow that change though the truth does not.

use anyhow::Result;
use comfy_table::Table;
use serde::Serialize;
use shadowfit::View;
use shadowfit::glam::DQuat;

use crate::args::WalkArgs;
use crate::fitted_maps::FittedMaps;
use crate::framing::Camera;
use crate::gpu::{Gpu, Surfaces, shadow_test};
use crate::opening::{choose_lights, open, output_directory, place_camera, say, sort};
use crate::picture::Lens;
use crate::progress::bar;
use crate::report;
use crate::run::Options;
use crate::stage::{Stage, StageLight};
use crate::table::{self, percent};
use crate::technique::Technique;
use crate::trace::Tracer;
use crate::verdict::share;

/// How far the camera goes in a step by default, over the distance to what is in the middle of its picture.
const PACE: f64 = 0.01;

/// What flickered under one light through one kind of map.
#[derive(Clone, Debug, Serialize)]
pub struct Flicker {
    /// The light, as the command line spells it.
    pub light: String,
    /// How the texels are spread.
    pub technique: Technique,
    /// Texels along each side.
    pub map_size: u32,
    /// What changed in each step; nothing where one of its two cameras has no map.
    pub steps: Vec<Option<Step>>,
}

/// What flickered in a step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Step {
    /// Pixels that changed between light and shadow.
    pub changed: usize,
    /// Pixels whose point both cameras have in view and the light could reach.
    pub compared: usize,
}

impl Step {
    /// The share of pixels that changed; 0 where none was compared.
    #[must_use]
    pub fn share(&self) -> f64 {
        share(self.changed, self.compared)
    }
}

impl Flicker {
    /// The mean share of pixels that changed in a step.
    #[must_use]
    pub fn mean(&self) -> f64 {
        let shares = self.steps.iter().flatten().map(Step::share);
        shares.clone().sum::<f64>() / shares.count().max(1) as f64
    }

    /// The largest share that changed in a step.
    #[must_use]
    pub fn worst(&self) -> f64 {
        self.steps.iter().flatten().map(Step::share).fold(0.0, f64::max)
    }
}

/// Walks through a scene.
///
/// # Errors
///
/// When nothing can be drawn, with a message that says what to do.
pub fn walk(args: &WalkArgs) -> Result<()> {
    let scene = open(&args.view)?;
    let out = output_directory(&args.view, &scene)?;
    let tracer = sort(&scene.mesh)?;
    let (camera, start) = place_camera(&args.view, &scene, &tracer)?;
    let gpu = Gpu::new()?;
    let pace = args.pace.unwrap_or_else(|| PACE * distance_ahead(&start, &tracer));
    say(&format!(
        "{} step(s) of {pace:.4}, turning {} degrees each; drawn by {}",
        args.steps,
        args.turn,
        gpu.name()
    ));

    let options = args.map.options(1);
    let lights = choose_lights(&args.view, &scene);
    let mut flickers: Vec<Flicker> = lights
        .iter()
        .flat_map(|light| options.iter().map(move |options| (light, options)))
        .map(|(light, options)| Flicker {
            light: light.to_string(),
            technique: options.technique,
            map_size: options.map_size,
            steps: Vec::new(),
        })
        .collect();
    let bar = bar("walking", args.steps as usize);
    let size = [args.view.width, args.view.height];
    let mut here = Stage::new(&gpu, &tracer, &start, size)?.with_lamp_near(args.view.lamp_near);
    for step in 0..args.steps {
        let camera = moved(&camera, pace * f64::from(step + 1), args.turn * f64::from(step + 1));
        let view = camera.view(args.view.aspect(), start.near(), start.far())?;
        let next = Stage::new(&gpu, &tracer, &view, size)?.with_lamp_near(args.view.lamp_near);
        // What the camera saw, about the origin that the next map's matrix takes positions from.
        let again = Surfaces::draw(&gpu, &next.geometry, &here.view, size)?;
        for (spec, flickers) in lights.iter().zip(flickers.chunks_mut(options.len())) {
            let light = here.light(*spec)?;
            for (options, flicker) in options.iter().zip(flickers) {
                flicker.steps.push(compare(&here, &next, &again, &light, options)?);
            }
        }
        here = next;
        bar.inc(1);
    }
    bar.finish_and_clear();

    say(&summary(&flickers).to_string());
    report::write(&flickers, &out.join("walk.json"))?;
    say(&format!("wrote walk.json to {}", out.display()));
    Ok(())
}

fn summary(flickers: &[Flicker]) -> Table {
    let mut table = table::new(["light", "map", "change in a step", "at worst", "steps without a map"], 2..5);
    for flicker in flickers {
        table.add_row([
            flicker.light.clone(),
            format!("{} {}", flicker.technique, flicker.map_size),
            percent(flicker.mean()),
            percent(flicker.worst()),
            flicker.steps.iter().filter(|step| step.is_none()).count().to_string(),
        ]);
    }
    table
}

/// The depth of what is in the middle of the picture; of the far end of the scene, where nothing is.
fn distance_ahead(view: &View, tracer: &Tracer<'_>) -> f64 {
    let ray = Lens::of_view(view).ok().and_then(|lens| lens.ray_through_pixel(0, 0, 1, 1));
    let hit = ray.and_then(|ray| tracer.first_hit(&ray));
    let (min, max) = tracer.bounds();
    hit.map_or((max - min).length(), |hit| view.depth(hit.point))
}

/// The camera so far ahead and half as far to the right, turned to the left about its up axis.
fn moved(start: &Camera, ahead: f64, degrees: f64) -> Camera {
    let turn = DQuat::from_axis_angle(start.up.normalize(), degrees.to_radians());
    let right = start.forward.cross(start.up).normalize();
    Camera { eye: start.eye + ahead * (start.forward + 0.5 * right), forward: turn * start.forward, ..*start }
}

/// Counts the pixels seen from here that change when the map fitted for the next camera takes the place of this one's.
fn compare(
    here: &Stage<'_>,
    next: &Stage<'_>,
    again: &Surfaces,
    light: &StageLight,
    options: &Options,
) -> Result<Option<Step>> {
    let maps = (FittedMaps::new(here, &light.light, options)?, FittedMaps::new(next, &light.light, options)?);
    let (Ok(these_maps), Ok(next_maps)) = maps else { return Ok(None) };
    let before = shadow_test(here.gpu, &here.surfaces, &these_maps.draw(here)?, options.filter)?.lit;
    let after = shadow_test(here.gpu, again, &next_maps.draw(next)?, options.filter)?.lit;
    let planes = next.view.planes();
    let mut step = Step::default();
    for (i, pixel) in light.truth.pixels().iter().enumerate() {
        let Some((surface, _)) = pixel.compared() else { continue };
        // The two drawings of the same view may differ by the rounding of their origins.
        let same_surface = here.surfaces.triangles[i] == again.triangles[i];
        if same_surface && planes.iter().all(|plane| plane.at(surface.point) >= 0.0) {
            step.compared += 1;
            step.changed += usize::from((before[i] >= 0.5) != (after[i] >= 0.5));
        }
    }
    Ok(Some(step))
}
