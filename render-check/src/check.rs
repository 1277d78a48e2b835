//! The whole check, in order: load, frame, fit, print, draw.

use std::fs;
use std::io::{Write as _, stderr, stdout};
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use shadowfit::{Outcome, Settings, View};

use crate::args::Args;
use crate::fitting::{LightFit, fit_light};
use crate::framing::{choose_camera, choose_view};
use crate::light::LightSpec;
use crate::picture::{Lens, Lighting, Line, camera_view, light_lens, light_view, maps_view, save};
use crate::progress::spinner;
use crate::scene::{self, LoadedScene};
use crate::table::{reason_without_map, table};
use crate::trace::Tracer;

/// Where the sun stands in a scene without lights.
const DEFAULT_SUN: LightSpec = LightSpec::Sun { direction_to_light: shadowfit::glam::DVec3::new(0.5, 1.0, 0.35) };

/// Runs the tool.
///
/// # Errors
///
/// When nothing sensible can be shown, with a message that says what to do.
pub fn run(args: &Args) -> Result<()> {
    let settings = Settings::new(args.size, args.height).context("the sizes cannot be used")?;
    let scene = {
        let _spinner = spinner("loading the scene");
        scene::load(args.scene.as_deref())?
    };
    let (min, max) = scene.mesh.bounds();
    say(&format!("{}: {} triangles, {min:.3} to {max:.3}", scene.name, scene.mesh.triangles.len()));
    if !scene.left_out.is_nothing() {
        say(&scene.left_out.to_string());
    }
    let out = args.out.clone().unwrap_or_else(|| Path::new("out").join(&scene.name));
    fs::create_dir_all(&out)
        .with_context(|| format!("cannot make the directory '{}'; choose another with --out", out.display()))?;

    let tracer = {
        let _spinner = spinner("sorting the triangles");
        Tracer::new(&scene.mesh)?
    };
    let camera = choose_camera(args, &scene)?;
    let aspect = f64::from(args.width) / f64::from(args.height);
    let (view, warning) = choose_view(&camera, aspect, &tracer)?;
    say(&format!(
        "camera: eye {:.3}, forward {:.3}, field of view {:.1} degrees, near {:.4}, far {:.4}",
        view.eye(),
        view.forward(),
        camera.fov_y.to_degrees(),
        view.near(),
        view.far()
    ));
    if let Some(warning) = warning {
        complain(&format!("warning: {warning}"));
    }

    let fits = choose_lights(args, &scene)
        .into_iter()
        .map(|light| fit_light(light, &view, &scene.mesh, &settings))
        .collect::<Result<Vec<_>>>()?;
    say(&table(&fits, (min, max)).to_string());
    for (i, fit) in fits.iter().enumerate() {
        if let Some(reason) = reason_without_map(&fit.perspective.outcome) {
            say(&format!("light {}: no map: {reason}", i + 1));
        }
    }

    for (i, fit) in fits.iter().enumerate() {
        for path in draw(args, &out, i + 1, fit, &view, &tracer)? {
            say(&format!("wrote {}", path.display()));
        }
    }
    Ok(())
}

/// The lights that the arguments ask for; else the scene's own; else a sun.
fn choose_lights(args: &Args, scene: &LoadedScene) -> Vec<LightSpec> {
    let asked_for = [&args.lights, &scene.lights].into_iter().find(|lights| !lights.is_empty());
    asked_for.cloned().unwrap_or_else(|| vec![DEFAULT_SUN])
}

/// Draws the pictures of one light. The maps are left out where there are none.
fn draw(
    args: &Args,
    out: &Path,
    number: usize,
    fit: &LightFit,
    view: &View,
    tracer: &Tracer,
) -> Result<Vec<PathBuf>> {
    let size = [args.width, args.height];
    let mut written = Vec::new();
    let mut write = |what: &str, image: &image::RgbImage| {
        let path = out.join(format!("{number}-{}-{what}.png", fit.spec.kind()));
        save(image, &path)?;
        written.push(path);
        anyhow::Ok(())
    };

    let edges: Vec<Line> = fit.body.edges().collect();
    let (min, max) = tracer.mesh().bounds();
    let lighting = Lighting::new(fit.spec, 0.5 * (min + max));
    write("camera", &camera_view(view, &lighting, tracer, &edges, size)?)?;

    let aspect = f64::from(args.width) / f64::from(args.height);
    let lens = light_lens(&fit.spec, view, &fit.body, tracer.mesh(), aspect)?;
    write("light", &light_view(&lens, view, tracer, &fit.body, size))?;

    let [uniform, perspective] = [map_lens(&fit.uniform.outcome)?, map_lens(&fit.perspective.outcome)?];
    if uniform.is_some() || perspective.is_some() {
        let maps = [("uniform", uniform.as_ref()), ("perspective", perspective.as_ref())];
        write("maps", &maps_view(maps, args.size, tracer, &edges))?;
    }
    Ok(written)
}

fn map_lens(outcome: &Outcome) -> Result<Option<Lens>> {
    match outcome {
        Outcome::Map(map) => Lens::new(map.shadow_from_world()).map(Some),
        _ => Ok(None),
    }
}

/// Prints a line. Nobody listening (`render-check | head`) is no reason to leave the pictures undrawn.
fn say(line: &str) {
    drop(writeln!(stdout(), "{line}"));
}

/// Prints a line aside from the results.
pub fn complain(line: &str) {
    drop(writeln!(stderr(), "{line}"));
}
