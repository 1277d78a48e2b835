//! What single renders show: that the verdict finds what is wrong, and what each way to draw and read a map is good for.
//! The hard cases, and how the bounds here and there were found, are in `sweep.rs`.

#![allow(clippy::disallowed_methods, reason = "only the fitting path needs the same bits on every platform")]

use std::path::Path;

use super::common::gpu;
use render_check::gpu::{Bias, Filter, MapDraw, MapPass, Points, ShadowMaps, shadow_test};
use render_check::maps::{Layout, Split, Technique};
use render_check::run::{Cutting, MapRun, Options, run};
use render_check::scene::{self, LightSpec, LoadedScene};
use render_check::stage::{Stage, StageLight};
use render_check::trace::{Faces, Tracer};
use render_check::verdict::{self, DrawnMap, Frustum, Rendered, Verdict, judge};
use shadowfit::glam::DVec3;
use shadowfit::{DepthFormat, Origin, Settings, ShadowMap, View, fit};

/// What straight edges make of a paraboloid: the shade around the lamp is small, and the light sees each of its facets
/// under a large angle. Cutting walls on a grid does nothing for it; cutting by the angle does.
#[test]
fn casters_that_are_not_cut_are_missed() {
    let scene = scene::load(Path::new("room")).expect("built in");
    let view = scene.camera.expect("it has one").view(1.6, 0.5, 9.0).expect("sound");
    let (gpu, tracer) = (gpu(), Tracer::new(&scene.mesh).expect("it has triangles"));
    let stage = Stage::new(&gpu, &tracer, &view, IMAGE).expect("drawn");
    let light = stage.light(scene.lights[0]).expect("sound");
    let [none, grid, bound] = [Cutting::None, Cutting::Grid, Cutting::Bound].map(|cut| {
        let options = Options { cut, ..Options::new(Technique::Paraboloid, 512) };
        run(&stage, &light, &options).expect("drawn").unwrap_or_else(|none| panic!("{none}"))
    });
    let share = |run: &MapRun, count: usize| run.verdict.counts.fraction(count);
    for run in [&none, &grid] {
        assert!(share(run, run.verdict.counts.missing) > 0.1, "{:?}", run.verdict.counts);
    }
    // But the walls are better for it: bent edges let shadows fall beside where they should.
    let false_shadow = |run: &MapRun| share(run, run.verdict.counts.false_shadow);
    assert!(false_shadow(&none) > 3.0 * false_shadow(&grid), "{} {}", false_shadow(&none), false_shadow(&grid));
    assert_eq!(bound.verdict.counts.missing, 0);
    assert!(bound.drawn.triangles > bound.drawn.of_triangles && bound.drawn.cut_ms.is_some());
    assert!(none.drawn.triangles <= none.drawn.of_triangles && none.drawn.cut_ms.is_none());
}

/// Along the seam between two hemispheres, where both maps are read at their rims, pixels are as right as elsewhere: two
/// are false, at the crease where a wall turns into the window.
#[test]
fn the_seam_between_hemispheres_does_not_show() {
    let scene = scene::load(Path::new("room")).expect("built in");
    let view = scene.camera.expect("it has one").view(1.6, 0.5, 9.0).expect("sound");
    let (gpu, tracer) = (gpu(), Tracer::new(&scene.mesh).expect("it has triangles"));
    let stage = Stage::new(&gpu, &tracer, &view, [480, 300]).expect("drawn");
    let position = DVec3::new(0.0, 1.5, -2.5);
    let light = stage.light(LightSpec::Point { position, range: f64::INFINITY }).expect("sound");
    for filter in [Filter::Nearest, Filter::Pcf(5)] {
        let options = Options { filter, ..Options::new(Technique::Paraboloid, 512) };
        let run = run(&stage, &light, &options).expect("drawn").unwrap_or_else(|none| panic!("{none}"));
        let (mut at_seam, mut faults) = (0, 0);
        for (pixel, mark) in light.truth.pixels().iter().zip(&run.verdict.marks) {
            let Some((surface, _)) = pixel.compared() else { continue };
            let arm = surface.point - position;
            // Within four texels of it, in which a texel is a 256th of the radius.
            if arm.y.abs() < arm.length() * 4.0 / 256.0 {
                at_seam += 1;
                faults += usize::from(mark.fault().is_some());
            }
        }
        assert!(at_seam > 300, "{at_seam}");
        assert!(faults * 500 < at_seam, "{faults} of {at_seam}, {filter}");
    }
}

const IMAGE: [u32; 2] = [240, 150];

fn chess_board() -> (LoadedScene, View) {
    let scene = scene::load(Path::new("chess-board")).expect("built in");
    let camera = scene.camera.expect("it has one");
    let view = camera.view(1.6, 1.0, 28.0).expect("sound");
    (scene, view)
}

fn run_one(stage: &Stage<'_>, light: &StageLight, technique: Technique) -> MapRun {
    match run(stage, light, &Options::new(technique, 512)).expect("drawn") {
        Ok(run) => run,
        Err(none) => panic!("{none}"),
    }
}

/// Looking along the light there is nothing for a perspective to gain: all of the view is equally wide to it.
#[test]
fn along_the_light_a_warp_is_no_warp() {
    let (scene, view) = chess_board();
    let (gpu, tracer) = (gpu(), Tracer::new(&scene.mesh).expect("it has triangles"));
    let stage = Stage::new(&gpu, &tracer, &view, IMAGE).expect("drawn");
    let light = stage.light(LightSpec::Sun { direction_to_light: -view.forward() }).expect("sound");
    let uniform = run_one(&stage, &light, Technique::Uniform);
    let warps = [
        Technique::Psm,
        Technique::PsmTight,
        Technique::PsmUnshifted,
        Technique::LightSpace,
        Technique::Trapezoidal,
    ];
    for technique in warps {
        let warped = run_one(&stage, &light, technique);
        let (a, b) = (uniform.verdict.aliasing.expect("compared"), warped.verdict.aliasing.expect("compared"));
        for (a, b) in [(a.worst, b.worst), (a.median, b.median), (a.p95, b.p95)] {
            assert!((a / b - 1.0).abs() < 1e-6, "{technique}: {a} {b}");
        }
        assert_eq!(uniform.verdict.counts, warped.verdict.counts, "{technique}");
    }
}

/// Draws some casters through some map and judges it: what a broken fit or a broken culler would do.
fn judged(stage: &Stage<'_>, light: &StageLight, map: &ShadowMap, casters: &[std::ops::Range<u32>]) -> Verdict {
    let bias = Bias { constant: 9, slope: 1.125 };
    let pass = MapPass {
        format: DepthFormat::Unorm24,
        faces: Faces::All,
        bias,
        receiver: 0.0,
        relative: 0.0,
        points: Points::Discs,
    };
    let split = Split::whole();
    let layout = Layout::Frustum(map.clone());
    let draw = MapDraw { map: &layout, casters, pass };
    let shadow_maps = ShadowMaps::draw(stage.gpu, &stage.geometry, &split, &[Some(draw)]).expect("drawn");
    let lit = shadow_test(stage.gpu, &stage.surfaces, &shadow_maps, Filter::Nearest).expect("tested").lit;
    let depths = shadow_maps.depths(stage.gpu).expect("readable");
    let frustum = Frustum::new(map);
    let bias = verdict::Bias::most(&pass);
    let drawn = DrawnMap { projection: &frustum, depths: &depths[0], is_reversed: false, bias, derived: None };
    let rendered = Rendered {
        split: &split,
        maps: &[Some(drawn)],
        lit: &lit,
        faces: pass.faces,
        depth_step: pass.format.step(1.0),
        reach: Filter::Nearest.reach(),
    };
    judge(&light.truth, &rendered, stage.tracer).expect("as it was drawn")
}

#[test]
fn a_caster_that_is_not_drawn_is_found_missing() {
    let (scene, view) = chess_board();
    let (gpu, tracer) = (gpu(), Tracer::new(&scene.mesh).expect("it has triangles"));
    let stage = Stage::new(&gpu, &tracer, &view, IMAGE).expect("drawn");
    let light = stage.light(scene.lights[0]).expect("sound");
    let settings = Settings::new(512, IMAGE[1]).expect("sound").with_origin(Origin::Eye);
    let map = fit(&view, &light.light, &stage.bounds, &settings).into_map().expect("one map does");
    let all: Vec<_> = scene.mesh.objects.iter().map(|object| object.triangles.clone()).collect();
    assert_eq!(judged(&stage, &light, &map, &all).counts.missing, 0);

    // A piece: an object that stands higher than a square is thick.
    let tall = |i: &usize| scene.mesh.objects[*i].max.y > 1.0;
    let without_pieces: Vec<_> = (0..all.len()).filter(|i| !tall(i)).map(|i| all[i].clone()).collect();
    let counts = judged(&stage, &light, &map, &without_pieces).counts;
    let lost = counts.missing + counts.edges();
    assert!(counts.missing > 500 && counts.missing > 9 * counts.false_light, "{counts:?}, {lost} lost");
}

/// Of the pixels that are truly in shadow, edges included, the share that is lit.
fn lit_in_shadow(light: &StageLight, run: &MapRun) -> f64 {
    let pixels = light.truth.pixels().iter().zip(&run.lit);
    let lit = pixels.filter(|(pixel, lit)| **lit >= 0.5 && pixel.compared().is_some_and(|(_, lit)| !lit)).count();
    lit as f64 / light.truth.shadowed() as f64
}

/// Wang & Molnar's Fig. 12, with figures: a table that stands on a floor, at three sizes of map. What second depth is for:
/// no bias, no acne, and no shadow that leaves what casts it.
#[test]
fn solids_need_no_bias_in_second_depth() {
    let scene = scene::load(Path::new("table")).expect("built in");
    let view = scene.camera.expect("it has one").view(1.6, 1.0, 8.0).expect("sound");
    let (gpu, tracer) = (gpu(), Tracer::new(&scene.mesh).expect("it has triangles"));
    let stage = Stage::new(&gpu, &tracer, &view, [480, 300]).expect("drawn");
    for (spec, size) in scene.lights.iter().flat_map(|spec| [512, 256, 128].map(|size| (spec, size))) {
        let light = stage.light(*spec).expect("sound");
        let of = |faces, filter, bias| {
            let options = Options { faces, filter, bias, ..Options::new(Technique::Uniform, size) };
            run(&stage, &light, &options).expect("drawn").unwrap_or_else(|none| panic!("{none}"))
        };
        let faults = |run: &MapRun| run.verdict.counts.fraction(run.verdict.counts.faults());
        let lit_in_shadow = |run: &MapRun| lit_in_shadow(&light, run);
        let case = format!("{spec}, {size}");

        // The first surface without a bias: acne on all that is lit.
        let unbiased = of(Faces::All, Filter::Nearest, Some(Bias::NONE));
        assert!(faults(&unbiased) > 0.25, "{case}: {}", faults(&unbiased));
        // With one: no acne, but light where shadows should begin, the more the wider the filter is.
        let biased = [Filter::Nearest, Filter::Pcf(5)].map(|filter| of(Faces::All, filter, None));
        let second = [Filter::Nearest, Filter::Pcf(5)].map(|filter| of(Faces::Second, filter, None));
        assert_eq!(second[0].fitted.maps[0].as_ref().map(|map| map.pass.bias), Some(Bias::NONE));
        // Without any bias, texels that straddle an edge of a solid are all that is wrong with the second surface.
        assert!(
            faults(&second[0]) < 1e-3 && faults(&second[1]) < 1e-4,
            "{case}: {:?}",
            second.each_ref().map(faults)
        );
        assert!(lit_in_shadow(&second[1]) < 0.9 * lit_in_shadow(&biased[1]), "{case}");
        // With virtual samples not even they are, and shadows begin where they should.
        let sampled = of(Faces::Second, Filter::Virtual(2), None);
        assert!(faults(&sampled) < 1e-4, "{case}: {}", faults(&sampled));
        assert!(lit_in_shadow(&sampled) < lit_in_shadow(&biased[0]), "{case}");
        // They are asked for along edges; on the first surface, whose own depths are stored, nearly everywhere.
        let first_sampled = of(Faces::All, Filter::Virtual(2), None);
        assert!(faults(&first_sampled) < 1e-4, "{case}: {}", faults(&first_sampled));
        let [along_edges, everywhere] = [&sampled, &first_sampled].map(|run| run.used_plane.expect("asked for"));
        assert!(along_edges < 0.17 && everywhere > 0.5, "{case}: {along_edges}, {everywhere}");
    }
}

/// Sheets hold their own depths in second depth too: virtual samples are what keeps a flat one from shadowing itself.
#[test]
fn flat_sheets_need_virtual_samples_and_no_bias() {
    for name in ["ground", "leaves"] {
        let scene = scene::load(Path::new(name)).expect("built in");
        let view = scene.camera.expect("it has one").view(1.6, 1.0, 45.0).expect("sound");
        let (gpu, tracer) = (gpu(), Tracer::new(&scene.mesh).expect("it has triangles"));
        let stage = Stage::new(&gpu, &tracer, &view, IMAGE).expect("drawn");
        for (spec, technique) in scene.lights.iter().flat_map(|spec| Technique::COMPARED.map(|way| (spec, way))) {
            let light = stage.light(*spec).expect("sound");
            let false_shadow = |filter| {
                let options = Options { faces: Faces::Second, filter, ..Options::new(technique, 512) };
                let run = run(&stage, &light, &options).expect("drawn").unwrap_or_else(|none| panic!("{none}"));
                let bias = run.fitted.maps[0].as_ref().map(|map| map.pass.bias);
                assert_eq!((bias, run.verdict.counts.missing), (Some(Bias::NONE), 0));
                run.verdict.counts.fraction(run.verdict.counts.false_shadow)
            };
            let [nearest, sampled] = [Filter::Nearest, Filter::Virtual(2)].map(false_shadow);
            assert!(nearest > 5e-4 && sampled < 1e-4, "{name}, {spec}, {technique}: {nearest}, {sampled}");
        }
    }
}

/// What is seen lies within the view that the depth buffer is read back to, and within little more.
#[test]
fn a_view_narrowed_to_what_is_seen_holds_every_pixel() {
    let gpu = gpu();
    for built_in in scene::BUILT_IN {
        let scene = (built_in.make)();
        let camera = scene.camera.expect("it has one");
        let tracer = Tracer::new(&scene.mesh).expect("it has triangles");
        for far in [100.0, f64::INFINITY] {
            let view = camera.view(1.6, 0.01, far).expect("sound");
            let stage = Stage::new(&gpu, &tracer, &view, IMAGE).and_then(Stage::narrowed).expect("drawn");
            let truth = stage.light(scene.lights[0]).expect("sound").truth;
            let depths = truth.pixels().iter().filter_map(|pixel| Some(view.depth(pixel.surface()?.point)));
            let (near, far) = depths.fold((f64::INFINITY, 0.0_f64), |(near, far), d| (near.min(d), far.max(d)));
            let (fitted, name) = (stage.fitted_view, built_in.name);
            let inside = fitted.near() <= near && far <= fitted.far();
            assert!(inside, "{name}: {near} to {far} in {} to {}", fitted.near(), fitted.far());
            assert!(
                1.01 * fitted.near() > near && 0.99 * fitted.far() < far,
                "{name}: {near}, {far} in {fitted:?}"
            );
        }
    }
}

/// The near plane in the air, where a warp is worse than none, and moved to what is seen, where it is far better.
#[test]
fn a_warp_pays_once_the_view_is_narrowed() {
    let scene = scene::load(Path::new("street")).expect("built in");
    let camera = scene.camera.expect("it has one");
    let view = camera.view(1.6, camera.near.expect("it has one"), camera.far.expect("it has one")).expect("sound");
    let (gpu, tracer) = (gpu(), Tracer::new(&scene.mesh).expect("it has triangles"));
    let median = |narrow: bool, technique| {
        let stage = Stage::new(&gpu, &tracer, &view, IMAGE).expect("drawn");
        let stage = if narrow { stage.narrowed().expect("read back") } else { stage };
        let verdict = run_one(&stage, &stage.light(scene.lights[0]).expect("sound"), technique).verdict;
        assert_eq!(verdict.counts.missing, 0);
        verdict.aliasing.expect("compared").median
    };
    let [wide, narrow] = [false, true].map(|narrow| median(narrow, Technique::Psm));
    assert!(1.5 * narrow < wide, "{wide} and narrowed {narrow}");
}

/// A near plane in the air, and moved to what is seen: the best matrix has few wrong pixels with either, and no more than any closed
/// form, though one that minds the air may predict less for it.
#[test]
fn the_best_matrix_has_few_wrong_pixels() {
    let scene = scene::load(Path::new("street")).expect("built in");
    let camera = scene.camera.expect("it has one");
    let view = camera.view(1.6, camera.near.expect("it has one"), camera.far.expect("it has one")).expect("sound");
    let (gpu, tracer) = (gpu(), Tracer::new(&scene.mesh).expect("it has triangles"));
    for (spec, narrow) in scene.lights.iter().flat_map(|spec| [(spec, false), (spec, true)]) {
        let stage = Stage::new(&gpu, &tracer, &view, IMAGE).expect("drawn");
        let stage = if narrow { stage.narrowed().expect("read back") } else { stage };
        let light = stage.light(*spec).expect("sound");
        let runs = Technique::WARPS.map(|technique| (technique, run_one(&stage, &light, technique)));
        let predicted = |run: &MapRun| run.prediction.predicted.expect("no paraboloid");
        let of = |wanted| &runs.iter().find(|(technique, _)| *technique == wanted).expect("run").1;
        let (best, case) = (of(Technique::Best), format!("{spec}, narrowed: {narrow}"));
        for (technique, run) in &runs {
            // What is seen of R is no coarser than its vertices under a sun, but for the f32 of its points.
            let worst = run.verdict.aliasing.expect("compared").worst;
            assert!(worst <= 1.0001 * predicted(run), "{case}, {technique}: {worst}, {}", predicted(run));
            assert_eq!(run.verdict.counts.missing, 0, "{case}, {technique}");
        }
        let wrong = |run: &MapRun| run.verdict.counts.wrong();
        for (technique, run) in &runs {
            println!("{case}, {technique}: {} wrong, best {}", wrong(run), wrong(best));
        }
        for technique in [Technique::Uniform, Technique::Psm] {
            assert!(3 * wrong(best) < 2 * wrong(of(technique)), "{case}, {technique}: {}", wrong(best));
        }
    }
}

/// Without a bias nothing is left but edges, and they go with the texels.
#[test]
fn wrong_pixels_of_virtual_samples_go_with_predicted_aliasing() {
    let scene = scene::load(Path::new("street")).expect("built in");
    let camera = scene.camera.expect("it has one");
    let view = camera.view(1.6, camera.near.expect("it has one"), camera.far.expect("it has one")).expect("sound");
    let (gpu, tracer) = (gpu(), Tracer::new(&scene.mesh).expect("it has triangles"));
    let stage = Stage::new(&gpu, &tracer, &view, IMAGE).and_then(Stage::narrowed).expect("drawn");
    let light = stage.light(scene.lights[0]).expect("sound");
    let [uniform, psm, best] = [Technique::Uniform, Technique::Psm, Technique::Best].map(|technique| {
        let options = Options { filter: Filter::Virtual(2), ..Options::new(technique, 512) };
        run(&stage, &light, &options).expect("drawn").unwrap_or_else(|none| panic!("{none}"))
    });
    for (coarse, fine) in [(&uniform, &psm), (&psm, &best)] {
        let [a, b] = [coarse, fine].map(|run| run.prediction.predicted);
        assert!(a > b, "{a:?} {b:?}");
        let [a, b] = [coarse, fine].map(|run| run.verdict.counts.wrong());
        assert!(a > b, "{a} and {b} pixels wrong");
    }
    let counts = best.verdict.counts;
    assert!(counts.fraction(counts.faults()) < 0.001, "{counts:?}");
}

/// Points as single texels let light through; as their discs they do not, and cast no more than they should.
#[test]
fn a_cloud_of_splats_has_no_holes() {
    let scene = scene::load(Path::new("cloud")).expect("built in");
    let camera = scene.camera.expect("it has one");
    let view = camera.view(1.6, 1.0, 25.0).expect("sound");
    let (gpu, tracer) = (gpu(), Tracer::new(&scene.mesh).expect("it has triangles"));
    let stage = Stage::new(&gpu, &tracer, &view, IMAGE).expect("drawn");
    for &spec in &scene.lights {
        let light = stage.light(spec).expect("sound");
        for technique in [Technique::Uniform, Technique::Psm] {
            let counts = |points| {
                let options = Options { points, ..Options::new(technique, 512) };
                let Ok(run) = run(&stage, &light, &options).expect("drawn") else { panic!("{technique}: no map") };
                run.verdict.counts
            };
            let [discs, splats, texels] = [Points::Discs, Points::Splats, Points::Texels].map(counts);
            assert_eq!((discs.missing, splats.missing), (0, 0), "{spec}, {technique}");
            assert!(discs.fraction(discs.faults()) < 0.0005, "{spec}, {technique}: {discs:?}");
            assert!(splats.fraction(splats.false_light) < 0.0001, "{spec}, {technique}: {splats:?}");
            assert!(splats.fraction(splats.false_shadow) < 0.0001, "{spec}, {technique}: {splats:?}");
            // More than a third of all that is in shadow shines through.
            let through = texels.missing + texels.false_light;
            assert!(3 * through > texels.shadowed, "{spec}, {technique}: {texels:?}");
        }
    }
}
