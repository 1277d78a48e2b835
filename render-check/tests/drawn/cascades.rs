//! A view in cascades, each with a map of its own, against the truth. The hard cases are in `sweep.rs`.

use std::path::Path;
use std::time::Duration;

use super::common::gpu;
use render_check::gpu::{Filter, Gpu};
use render_check::maps::{Cascading, SplitArg, Technique};
use render_check::run::{FittedMaps, MapRun, Options, run, run_fitted};
use render_check::scene::{self, LoadedScene};
use render_check::stage::{Stage, StageLight};
use render_check::trace::Tracer;
use render_check::verdict::Mark;
use shadowfit::{View, cascades::Cascades};

const IMAGE: [u32; 2] = [240, 150];

/// A scene whose near plane is in the air, far from all that is seen.
fn scene(name: &str) -> (LoadedScene, View) {
    let scene = scene::load(Path::new(name)).expect("built in");
    let camera = scene.camera.expect("it has one");
    let view = camera.view(1.6, 0.3, 400.0).expect("sound");
    (scene, view)
}

fn cascaded(technique: Technique, count: usize) -> Options {
    let cascading = Some(Cascading { count, split: SplitArg::default() });
    Options { cascading, ..Options::new(technique, 256) }
}

fn run_one(stage: &Stage<'_>, light: &StageLight, options: &Options) -> MapRun {
    run(stage, light, options).expect("drawn").unwrap_or_else(|none| panic!("{none}"))
}

fn stage<'a>(gpu: &'a Gpu, tracer: &'a Tracer<'a>, view: &View) -> Stage<'a> {
    Stage::new(gpu, tracer, view, IMAGE).expect("drawn")
}

/// Each number of cascades in two scenes, whatever spreads the texels of their maps. Next to the cuts, where a caster could be
/// missing from both maps and a pixel be tested against the wrong one, pixels are as right as elsewhere.
#[test]
fn no_slice_misses_a_caster_and_no_cut_shows() {
    let gpu = gpu();
    for name in ["street", "chess-board"] {
        let (scene, view) = scene(name);
        let tracer = Tracer::new(&scene.mesh).expect("it has triangles");
        let stage = stage(&gpu, &tracer, &view);
        let lights: Vec<_> = scene.lights.iter().map(|spec| stage.light(*spec).expect("sound")).collect();
        let (mut at_cuts, mut faults_at_cuts) = (0, 0);
        for technique in [Technique::Uniform, Technique::Psm, Technique::Best, Technique::Stable] {
            for (count, light) in (1..=Cascades::MAX).zip(lights.iter().cycle()) {
                let run = run_one(&stage, light, &cascaded(technique, count));
                let (split, counts, case) = (
                    &run.fitted.split,
                    run.verdict.counts,
                    format!("{name}, {}, {technique}, {count}", light.spec),
                );
                assert_eq!((split.parts(), counts.missing), (count, 0), "{case}");
                assert!(counts.fraction(counts.faults()) < 0.012, "{case}: {counts:?}");
                for (pixel, mark) in light.truth.pixels().iter().zip(&run.verdict.marks) {
                    let Some((surface, _)) = pixel.compared() else { continue };
                    let depth = view.depth(surface.point);
                    let is_near =
                        |part| split.depths(part).is_some_and(|[_, far]| (depth / far - 1.0).abs() < 0.02);
                    if (0..count - 1).any(is_near) {
                        at_cuts += 1;
                        faults_at_cuts += usize::from(mark.fault().is_some());
                    }
                }
            }
        }
        assert!(at_cuts > 10_000, "{name}: {at_cuts}");
        assert!(faults_at_cuts * 250 < at_cuts, "{name}: {faults_at_cuts} of {at_cuts}");
    }
}

/// With the size of each map as it is, every cascade more predicts less of a uniform map, and any number less than one cascade of the best one, never less than the limit; and
/// wrong pixels fall:
/// of a uniform map to a fifth by the fourth cascade, of the best one to a half.
#[test]
fn wrong_pixels_fall_with_the_number_of_cascades() {
    let (gpu, (scene, view)) = (gpu(), scene("street"));
    let tracer = Tracer::new(&scene.mesh).expect("it has triangles");
    let stage = stage(&gpu, &tracer, &view).narrowed().expect("read back");
    let light = stage.light(scene.lights[0]).expect("sound");
    for (technique, fall) in [(Technique::Uniform, [2.0, 2.8, 4.0]), (Technique::Best, [1.5, 2.0, 2.5])] {
        let runs: Vec<_> =
            (1..=Cascades::MAX).map(|count| run_one(&stage, &light, &cascaded(technique, count))).collect();
        let predicted = |run: &MapRun| run.prediction.predicted.expect("frusta");
        for pair in runs.windows(2) {
            // The best map's worst is not what it is chosen by alone.
            let before = if technique == Technique::Uniform { &pair[0] } else { &runs[0] };
            assert!(predicted(&pair[1]) < predicted(before), "{technique}: {:?}", pair[1].prediction);
            assert!(pair[1].prediction.limit < pair[0].prediction.limit);
        }
        for (count, run) in (1..).zip(&runs) {
            let (prediction, aliasing) = (run.prediction, run.verdict.aliasing.expect("compared"));
            assert!(prediction.limit < predicted(run), "{technique}, {count}: {prediction:?}");
            // But for what f32 makes of its points.
            let most = prediction.predicted_at_most.expect("frusta");
            assert!(aliasing.worst <= 1.0001 * most, "{technique}, {count}: {aliasing:?}, {prediction:?}");
            assert_eq!(run.depths.len(), count);
            // The limit goes with the texels of all maps.
            let scaled = runs[0].prediction.limit / (count as f64).sqrt();
            assert!((prediction.limit / scaled - 1.0).abs() < 1e-12);
        }
        let wrong: Vec<_> = runs.iter().map(|run| run.verdict.counts.wrong()).collect();
        for (count, times) in [2, 4, 8].into_iter().zip(fall) {
            assert!(wrong[0] as f64 > times * wrong[count - 1] as f64, "{technique}: {wrong:?}");
        }
    }
}

#[test]
fn one_slice_is_the_view() {
    let (gpu, (scene, view)) = (gpu(), scene("chess-board"));
    let tracer = Tracer::new(&scene.mesh).expect("it has triangles");
    let stage = stage(&gpu, &tracer, &view);
    let light = stage.light(scene.lights[0]).expect("sound");
    for technique in [Technique::Psm, Technique::Stable] {
        let options = cascaded(technique, 1);
        let [one, whole] = [options, Options { cascading: None, ..options }].map(|it| run_one(&stage, &light, &it));
        assert_eq!(one.fitted.maps[0].as_ref().map(|it| &it.map), whole.fitted.maps[0].as_ref().map(|it| &it.map));
        assert!(one.verdict == whole.verdict && one.prediction == whole.prediction);
    }
}

/// The verdict looks into the map of a pixel's own cascade: what is not drawn there is found missing, though another map
/// holds it.
#[test]
fn a_caster_that_is_left_out_of_one_slice_is_found_missing() {
    let (gpu, (scene, view)) = (gpu(), scene("street"));
    let tracer = Tracer::new(&scene.mesh).expect("it has triangles");
    let stage = stage(&gpu, &tracer, &view).narrowed().expect("read back");
    let light = stage.light(scene.lights[1]).expect("sound");
    let options = cascaded(Technique::Uniform, 4);
    let fitted = FittedMaps::new(&stage, &light.light, &options).expect("sound").expect("a map");
    for part in 0..4 {
        let mut broken = fitted.clone();
        broken.maps[part].as_mut().expect("a map").objects.clear();
        let judged = run_fitted(&stage, &light, &options, broken, Duration::ZERO).expect("drawn");
        let (mut inside, mut outside) = (0, 0);
        for (pixel, mark) in light.truth.pixels().iter().zip(&judged.verdict.marks) {
            let (Some(surface), true) = (pixel.surface(), *mark == Mark::Missing) else {
                continue;
            };
            let is_inside = fitted.split.part_of(surface.point) == part;
            *(if is_inside { &mut inside } else { &mut outside }) += 1;
        }
        assert!(inside > 10 && outside == 0, "cascade {part}: {inside} missing in it, {outside} elsewhere");
    }
}

/// A filter reads within the border of each map, also next to a cut.
#[test]
fn wide_filters_need_no_other_slices_texels() {
    let (gpu, (scene, view)) = (gpu(), scene("chess-board"));
    let tracer = Tracer::new(&scene.mesh).expect("it has triangles");
    let stage = stage(&gpu, &tracer, &view);
    for spec in &scene.lights {
        let light = stage.light(*spec).expect("sound");
        let options = Options { filter: Filter::Pcf(5), ..cascaded(Technique::Uniform, 5) };
        let counts = run_one(&stage, &light, &options).verdict.counts;
        assert_eq!(counts.missing, 0, "{spec}");
        assert!(counts.fraction(counts.faults()) < 0.002, "{spec}: {counts:?}");
    }
}

#[test]
fn cascades_are_of_frusta() {
    let (gpu, (scene, view)) = (gpu(), scene("room"));
    let tracer = Tracer::new(&scene.mesh).expect("it has triangles");
    let stage = stage(&gpu, &tracer, &view);
    let light = stage.light(scene.lights[0]).expect("sound");
    for technique in [Technique::Cube, Technique::Paraboloid] {
        let refused = run(&stage, &light, &cascaded(technique, 2)).err().expect("refused");
        assert!(refused.to_string().contains("--cascades"), "{refused}");
    }
}
