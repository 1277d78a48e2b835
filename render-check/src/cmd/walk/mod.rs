//! Moves the camera and counts flicker: pixels that change between light and shadow although the truth does not.

mod args;
mod flicker;

use std::time::Duration;

use anyhow::Result;
use shadowfit::View;
use shadowfit::glam::DQuat;

pub(crate) use args::HELP;
pub use args::WalkArgs;
pub use flicker::{Flicker, Step};

use flicker::summary;

use crate::cli::{choose_lights, open, output_directory, place_camera, sort};
use crate::gpu::{Gpu, Surfaces, shadow_test};
use crate::output::progress::bar;
use crate::output::{say, write_json};
use crate::run::{FittedMaps, Options, median_time};
use crate::scene::{Camera, LightSpec};
use crate::stage::{Stage, StageLight};
use crate::trace::{Lens, Tracer};

/// Default distance per step, relative to the distance to the surface in the middle of the image.
const PACE: f64 = 0.01;

/// Fits per map, for the median time.
const FITS: usize = 9;

/// Walks through a scene.
///
/// # Errors
///
/// When nothing can be drawn, with a hint.
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

    let ways = ways(&args.map.options(1));
    let lights = choose_lights(&args.view, &scene);
    let bar = bar("walking", args.steps as usize);
    let size = [args.view.width, args.view.height];
    let mut here = Stage::new(&gpu, &tracer, &start, size)?.with_lamp_near(args.view.lamp_near);
    let mut walkers = Vec::new();
    for spec in &lights {
        let light = spec.to_light(here.lamp_near(spec))?;
        for way in &ways {
            walkers.push(Walker::new(*spec, *way, FittedMaps::new(&here, &light, &way.options)?.ok()));
        }
    }
    for step in 0..args.steps {
        let camera = moved(&camera, pace * f64::from(step + 1), args.turn * f64::from(step + 1));
        let view = camera.view(args.view.aspect(), start.near(), start.far())?;
        let next = Stage::new(&gpu, &tracer, &view, size)?.with_lamp_near(args.view.lamp_near);
        // The same view drawn again, relative to the origin of the next map's matrix.
        let again = Surfaces::draw(&gpu, &next.geometry, &here.view, size)?;
        for (spec, walkers) in lights.iter().zip(walkers.chunks_mut(ways.len())) {
            let light = here.light(*spec)?;
            for walker in walkers {
                walker.step(&here, &next, &again, &light)?;
            }
        }
        here = next;
        bar.inc(1);
    }
    bar.finish_and_clear();

    let flickers: Vec<Flicker> = walkers.into_iter().map(Walker::flicker).collect();
    say(&summary(&flickers).to_string());
    write_json(&flickers, &out.join("walk.json"))?;
    say(&format!("wrote walk.json to {}", out.display()));
    Ok(())
}

/// How a map is fitted in each step.
#[derive(Clone, Copy, Debug)]
struct Way {
    options: Options,
    /// Warm-started from the previous step's map.
    warm: bool,
}

/// A cold fit for all options, and a warm-started one for techniques with a search.
fn ways(options: &[Options]) -> Vec<Way> {
    let of = |&options: &Options| {
        let is_searched = options.technique.is_searched();
        [false, true].into_iter().filter(move |&warm| is_searched || !warm).map(move |warm| Way { options, warm })
    };
    options.iter().flat_map(of).collect()
}

/// The state of one light with one kind of map.
struct Walker {
    light: LightSpec,
    way: Way,
    /// The maps of the current step, if there are any.
    maps: Option<FittedMaps>,
    times: Vec<Duration>,
    jumps: usize,
    steps: Vec<Option<Step>>,
}

impl Walker {
    fn new(light: LightSpec, way: Way, maps: Option<FittedMaps>) -> Self {
        Self { light, way, maps, times: Vec::new(), jumps: 0, steps: Vec::new() }
    }

    /// Moves on to the next camera.
    fn step(&mut self, here: &Stage<'_>, next: &Stage<'_>, again: &Surfaces, light: &StageLight) -> Result<()> {
        let Way { options, warm } = &self.way;
        let before = self.maps.as_ref().filter(|_| *warm);
        let next_maps = FittedMaps::after(before, next, &light.light, options)?.ok();
        if let Some(maps) = &next_maps {
            let settings = options.settings(next)?;
            self.times.push(median_time(FITS, || maps.fit_again(before, next, &settings)));
            self.jumps += usize::from(maps.jumped());
        }
        self.steps.push(match (&self.maps, &next_maps) {
            (Some(these), Some(those)) => Some(compare((here, these), (next, those), again, light, options)?),
            _ => None,
        });
        self.maps = next_maps;
        Ok(())
    }

    fn flicker(mut self) -> Flicker {
        self.times.sort_unstable();
        Flicker {
            light: self.light.to_string(),
            technique: self.way.options.technique,
            map_size: self.way.options.map_size,
            cascading: self.way.options.cascading,
            name: self.way.options.name(),
            warm: self.way.warm,
            fit_us: self.times.get(self.times.len() / 2).map_or(0.0, |time| time.as_secs_f64() * 1e6),
            jumps: self.jumps,
            steps: self.steps,
        }
    }
}

/// The depth of the surface in the middle of the image; the scene's diagonal where there is none.
fn distance_ahead(view: &View, tracer: &Tracer<'_>) -> f64 {
    let ray = Lens::of_view(view).ok().and_then(|lens| lens.ray_through_pixel(0, 0, 1, 1));
    let hit = ray.and_then(|ray| tracer.first_hit(&ray));
    let (min, max) = tracer.bounds();
    hit.map_or((max - min).length(), |hit| view.depth(hit.point))
}

/// The camera moved `ahead` forward and half as far to the right, and turned left about its up axis.
fn moved(start: &Camera, ahead: f64, degrees: f64) -> Camera {
    let turn = DQuat::from_axis_angle(start.up.normalize(), degrees.to_radians());
    let right = start.forward.cross(start.up).normalize();
    Camera { eye: start.eye + ahead * (start.forward + 0.5 * right), forward: turn * start.forward, ..*start }
}

/// Counts the pixels of the current view that change when the next camera's maps replace the current ones.
fn compare(
    (here, these_maps): (&Stage<'_>, &FittedMaps),
    (next, next_maps): (&Stage<'_>, &FittedMaps),
    again: &Surfaces,
    light: &StageLight,
    options: &Options,
) -> Result<Step> {
    let before = shadow_test(here.gpu, &here.surfaces, &these_maps.draw(here)?, options.filter)?.lit;
    let after = shadow_test(here.gpu, again, &next_maps.draw(next)?, options.filter)?.lit;
    let planes = next.view.planes();
    let mut step = Step::default();
    for (i, pixel) in light.truth.pixels().iter().enumerate() {
        let Some((surface, _)) = pixel.compared() else { continue };
        // The two drawings of one view may differ by rounding, as their origins differ.
        let same_surface = here.surfaces.triangles[i] == again.triangles[i];
        if same_surface && planes.iter().all(|plane| plane.at(surface.point) >= 0.0) {
            step.compared += 1;
            if (before[i] >= 0.5) != (after[i] >= 0.5) {
                let part = |maps: &FittedMaps| maps.split.part_of(surface.point);
                step.changed += 1;
                step.over_a_cut += usize::from(part(these_maps) != part(next_maps));
            }
        }
    }
    Ok(step)
}
