//! Cost on the card, by its own clock: of the map's pass and of the shadow test, over texels and over triangles.

use std::time::Duration;

use anyhow::{Context, Result};
use render_check::gpu::{Filter, Gpu, ShadowMaps, shadow_test};
use render_check::maps::Technique;
use render_check::run::{FittedMaps, Options};
use render_check::scene::Mesh;
use render_check::stage::Stage;
use render_check::trace::Tracer;

use super::cost::{Contender, Cost, Counted, Work, timed};
use super::setup::SIDES;
use super::terrain;
use crate::size::Size;

/// About how many triangles are drawn.
const TRIANGLES: [usize; 7] = [1_000, 3_000, 10_000, 30_000, 100_000, 300_000, 1_000_000];

/// How often each takes a turn.
fn rounds(size: Size) -> usize {
    size.of(3, 15)
}

/// Measures; nothing on a card without a clock.
pub(super) fn measure(gpu: &Gpu, size: Size) -> Result<Vec<Cost>> {
    let image = size.of([64, 40], [1280, 800]);
    let few = terrain::mesh(size.of(1_000, 20_000));
    let tracer = Tracer::new(&few)?;
    let stage = Stage::new(gpu, &tracer, &terrain::view()?, image)?;
    if stage.surfaces.time.is_none() {
        return Ok(Vec::new());
    }
    let mut costs = over_texels(&stage, size)?;
    costs.extend(over_triangles(gpu, image, size)?);
    Ok(costs)
}

fn over_texels(stage: &Stage<'_>, size: Size) -> Result<Vec<Cost>> {
    let largest = stage.gpu.largest_texture() as usize;
    let sides: Vec<usize> =
        SIDES[..size.of(3, SIDES.len())].iter().copied().filter(|&side| side <= largest).collect();
    let fitted = |&side: &usize| Ok(((side * side) as u64, fitted(stage, side as u32)?));
    let maps: Vec<(u64, FittedMaps)> = sides.iter().map(fitted).collect::<Result<_>>()?;
    let passes = maps.iter().map(|(texels, maps)| (*texels, pass(stage, maps))).collect();
    let mut costs = timed(Work::MapPass, Counted::Texels, rounds(size), 1.0, passes)?;
    let drawn: Vec<(u64, ShadowMaps)> =
        maps.iter().map(|(texels, maps)| Ok((*texels, maps.draw(stage)?))).collect::<Result<_>>()?;
    let tests = drawn.iter().map(|(texels, maps)| (*texels, test(stage, maps))).collect();
    costs.extend(timed(Work::ShadowTest, Counted::Texels, rounds(size), 1.0, tests)?);
    Ok(costs)
}

fn over_triangles(gpu: &Gpu, image: [u32; 2], size: Size) -> Result<Vec<Cost>> {
    let meshes: Vec<Mesh> =
        TRIANGLES[..size.of(3, TRIANGLES.len())].iter().map(|&count| terrain::mesh(count)).collect();
    let tracers: Vec<Tracer<'_>> = meshes.iter().map(Tracer::new).collect::<Result<_>>()?;
    let view = terrain::view()?;
    let on_stage = |tracer| {
        let stage = Stage::new(gpu, tracer, &view, image)?;
        let maps = fitted(&stage, size.of(128, 2048))?;
        Ok((stage, maps))
    };
    let stages: Vec<(Stage<'_>, FittedMaps)> = tracers.iter().map(on_stage).collect::<Result<_>>()?;
    let passes =
        stages.iter().map(|(stage, maps)| (maps.drawn(stage).triangles as u64, pass(stage, maps))).collect();
    timed(Work::MapPass, Counted::Triangles, rounds(size), 1.0, passes)
}

/// A uniform map with so many texels a side.
fn fitted(stage: &Stage<'_>, side: u32) -> Result<FittedMaps> {
    let options = Options::new(Technique::Uniform, side);
    FittedMaps::new(stage, &terrain::sun()?, &options)?.ok().context("the terrain has no map")
}

fn pass<'a>(stage: &'a Stage<'_>, maps: &'a FittedMaps) -> Contender<'a> {
    Box::new(|| clocked(maps.draw(stage)?.time))
}

fn test<'a>(stage: &'a Stage<'_>, maps: &'a ShadowMaps) -> Contender<'a> {
    Box::new(|| clocked(shadow_test(stage.gpu, &stage.surfaces, maps, Filter::Nearest)?.time))
}

fn clocked(time: Option<Duration>) -> Result<Duration> {
    time.context("the card's clock has stopped")
}
