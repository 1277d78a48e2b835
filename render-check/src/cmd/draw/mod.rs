//! The fit and its pictures, by ray casting.

mod args;
mod fitting;
mod table;

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use shadowfit::{Settings, View};

pub use args::DrawArgs;
pub(crate) use args::HELP;

use fitting::{LightFit, fit_light};
use table::table;

use crate::cli::{choose_lights, open, output_directory, place_camera, sort};
use crate::maps::{Technique, map_or_reason};
use crate::output::say;
use crate::picture::{Lighting, Line, camera_view, light_lens, light_view, maps_view, save};
use crate::stage::lamp_near;
use crate::trace::{Lens, Tracer};

/// Fits and draws every light of a scene.
///
/// # Errors
///
/// When the scene, camera or options cannot be used, with a hint.
pub fn draw(args: &DrawArgs) -> Result<()> {
    let settings = Settings::new(args.size, args.view.height).context("the sizes cannot be used")?;
    let techniques = Technique::or_compared(&args.techniques);
    if let Some(several) = techniques.iter().find(|technique| technique.has_faces() || technique.is_paraboloid()) {
        bail!("single maps are drawn here: leave out --technique {several}");
    }
    let scene = open(&args.view)?;
    let out = output_directory(&args.view, &scene)?;
    let tracer = sort(&scene.mesh)?;
    let (_, view) = place_camera(&args.view, &scene, &tracer)?;

    let fits = choose_lights(&args.view, &scene)
        .into_iter()
        .map(|light| {
            let near = args.view.lamp_near.unwrap_or_else(|| lamp_near(&tracer, &light));
            fit_light(light, &view, &scene.mesh, near, &settings, techniques)
        })
        .collect::<Result<Vec<_>>>()?;
    say(&table(&fits, tracer.bounds()).to_string());
    for (i, fit) in fits.iter().enumerate() {
        if let Err(none) = map_or_reason(fit.maps[0].outcome.clone()) {
            say(&format!("light {}: no map: {none}", i + 1));
        }
    }

    for (i, fit) in fits.iter().enumerate() {
        for path in draw_light(args, &out, i + 1, fit, &view, &tracer)? {
            say(&format!("wrote {}", path.display()));
        }
    }
    Ok(())
}

/// Draws the pictures of one light; maps only where there are any.
fn draw_light(
    args: &DrawArgs,
    out: &Path,
    number: usize,
    fit: &LightFit,
    view: &View,
    tracer: &Tracer,
) -> Result<Vec<PathBuf>> {
    let size = [args.view.width, args.view.height];
    let mut written = Vec::new();
    let mut write = |what: &str, image: &image::RgbImage| {
        let path = out.join(format!("{number}-{}-{what}.png", fit.spec.kind()));
        save(image, &path)?;
        written.push(path);
        anyhow::Ok(())
    };

    let edges: Vec<Line> = fit.body.edges().collect();
    let (min, max) = tracer.bounds();
    let lighting = Lighting::new(fit.spec, 0.5 * (min + max));
    write("camera", &camera_view(view, &lighting, tracer, &edges, size)?)?;

    let lens = light_lens(&fit.spec, view, &fit.body, tracer.mesh(), args.view.aspect())?;
    write("light", &light_view(&lens, view, tracer, &fit.body, size))?;

    let mut lenses = Vec::new();
    for fitted in &fit.maps {
        if let Some(map) = fitted.outcome.map() {
            lenses.push((fitted.technique.to_string(), Lens::new(map.clip_from_world())?));
        }
    }
    if !lenses.is_empty() {
        write("maps", &maps_view(&lenses, args.size, tracer, &edges))?;
    }
    Ok(written)
}
