//! The figures that renders with the crate's maps are held to, on whatever adapter there is.
//!
//! Pixels wrong away from edges are not zero, and the bounds below are what was measured on a software adapter, about
//! doubled. What is left is of two kinds. At convex creases and on curved facets the middle of a texel lies on another
//! face than the pixel's point; the rasteriser biases by that face's slope, which may be far smaller than the receiver's,
//! and the receiver shadows itself within half a texel of the crease. And a bias that is large on a grazing face lets
//! light through just behind the edge of a caster. Both shrink with the texel; neither is a matter of the matrix.

#![allow(clippy::disallowed_methods, reason = "only the fitting path needs the same bits on every platform")]

use std::collections::HashMap;
use std::path::Path;

use render_check::cut::Cutting;
use render_check::gpu::{Bias, Filter, Gpu, MapDraw, MapPass, Points, ShadowMaps, shadow_test};
use render_check::layout::Layout;
use render_check::light::LightSpec;
use render_check::run::{MapRun, Options, run};
use render_check::scene::{self, LoadedScene};
use render_check::split::Split;
use render_check::stage::{Stage, StageLight};
use render_check::sweep::{GROUPS, Summary, SweepRun, run_shots};
use render_check::technique::Technique;
use render_check::trace::{Faces, Tracer};
use render_check::verdict::{self, Counts, DrawnMap, Frustum, Rendered, Verdict, judge};
use shadowfit::glam::DVec3;
use shadowfit::{DepthFormat, Map, Origin, Settings, View, fit};

fn gpu() -> Gpu {
    Gpu::new().unwrap_or_else(|error| panic!("{error:#}"))
}

/// Sweeps a group; checks that no caster is missing anywhere and that no run has more false pixels than `most`, as a
/// part of what is compared.
fn sweep(name: &str, most: f64) -> Vec<SweepRun> {
    let group = GROUPS.iter().find(|group| group.name == name).expect(name);
    let shots = (group.shots)().expect("built in");
    let runs = run_shots(&gpu(), group.name, &shots, || ()).expect("drawn");
    let summary = Summary::of(group.name, &runs);
    assert_eq!(runs.len(), summary.maps + summary.none);
    for run in &runs {
        assert_eq!(run.run.missing(), 0, "{run}");
    }
    assert!(
        summary.worst_false <= most,
        "{name}: {} of the pixels are false in {}",
        summary.worst_false,
        summary.worst.unwrap_or_default()
    );
    runs
}

#[test]
fn suns_through_every_class_miss_no_caster() {
    let runs = sweep("classes-of-suns", 0.013);
    let kinds = classes(&runs);
    assert!(kinds.contains_key("infinity plane") && kinds.contains_key("infinity plane, inverted"), "{kinds:?}");
    assert!(runs.len() > 60);
}

#[test]
fn lamps_through_every_class_miss_no_caster() {
    let runs = sweep("classes-of-lamps", 0.005);
    let kinds = classes(&runs);
    assert!(kinds.contains_key("point") && kinds.contains_key("inverted"), "{kinds:?}");
}

fn classes(runs: &[SweepRun]) -> HashMap<&str, usize> {
    let mut kinds = HashMap::new();
    for run in runs {
        *kinds.entry(run.run.class.as_str()).or_default() += 1;
    }
    kinds
}

#[test]
fn lights_through_the_viewers_back_miss_no_caster() {
    sweep("through-the-back", 0.01);
}

#[test]
fn casters_behind_the_eye_cast_into_the_picture() {
    let runs = sweep("behind-the-eye", 0.013);
    assert!(!runs.is_empty());
}

/// One map serves some lamps in the room, the faces of a cube all of them.
#[test]
fn lights_inside_the_scene_have_a_map_a_cube_or_a_reason() {
    let runs = sweep("lights-inside", 0.012);
    let mut without = 0;
    for run in &runs {
        match (verdict(run), run.run.technique.has_faces()) {
            (Some(verdict), has_faces) => {
                // A lamp that hangs in view has R reach to its near distance, a thousandth of the scene off, where depths
                // are noisy in f32. The bias follows that noise, so that it costs nothing farther off.
                let in_view = !run.case.starts_with("room");
                let most = match (has_faces, in_view) {
                    (false, _) => 0.012,
                    (true, false) => 0.0012,
                    (true, true) => 0.0019,
                };
                let counts = verdict.counts;
                assert!(counts.fraction(counts.faults()) <= most, "{run}: {counts:?}");
            }
            (None, has_faces) => {
                assert!(!has_faces, "{run}");
                without += 1;
            }
        }
    }
    assert!(without > 0, "a lamp in view is not served by one map");
    let most_passes = runs.iter().map(passes).max();
    assert_eq!(most_passes, Some(6), "a lamp in view needs all of its faces");
    assert!(
        runs.iter().any(|run| run.run.technique.has_faces() && passes(run) == 3),
        "one behind the view does not"
    );
}

/// Paraboloids of casters that are cut as the crate says. Vulkan's and OpenGL's clip spaces among them.
#[test]
fn paraboloids_miss_no_caster() {
    let runs = sweep("paraboloids", 0.005);
    for run in &runs {
        let counts = verdict(run).expect("a map").counts;
        let most = if pass(run).faces == Faces::Second { 0.005 } else { 0.0036 };
        assert!(counts.shadowed > 1000 && counts.fraction(counts.faults()) <= most, "{run}: {counts:?}");
    }
    let two = |run: &&SweepRun| run.case == "room, in view";
    assert!(runs.iter().filter(two).count() > 3 && runs.iter().filter(two).all(|run| passes(run) == 2));
    assert!(runs.iter().filter(|run| run.case == "room, in its shade").all(|run| passes(run) == 1));
}

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
    for filter in [Filter::Nearest, Filter::PercentageCloser(5)] {
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

fn passes(run: &SweepRun) -> usize {
    match &run.run.result {
        render_check::report::RunResult::Maps(maps) => maps.passes,
        render_check::report::RunResult::NoMap { .. } => 0,
    }
}

#[test]
fn a_flat_scene_is_all_lit() {
    for run in sweep("flat", 0.0) {
        let counts = verdict(&run).expect("a map").counts;
        assert!(counts.compared > 10_000 && counts.shadowed == 0 && counts.edges() == 0, "{run}: {counts:?}");
    }
}

#[test]
fn far_planes_at_infinity_miss_no_caster() {
    sweep("far-planes", 0.0031);
}

#[test]
fn scale_and_place_make_no_difference() {
    let runs = sweep("scales", 0.0031);
    let mut seen: HashMap<(String, Technique), Counts> = HashMap::new();
    for run in &runs {
        let counts = verdict(run).expect("a map").counts;
        let (_, light) = run.case.rsplit_once(", ").expect("a light");
        let first = seen.entry((light.to_owned(), run.run.technique)).or_insert(counts);
        let apart = counts.compared.abs_diff(first.compared) + counts.faults().abs_diff(first.faults());
        // Vertices round differently in f32 at each place, which moves a few edges over a pixel's middle.
        assert!(apart * 500 < first.compared, "{run}: {counts:?} against {first:?}");
    }
    assert_eq!(seen.len(), 9);
}

#[test]
fn every_clip_space_misses_no_caster() {
    sweep("clip-spaces", 0.0031);
}

#[test]
fn wrong_pixels_shrink_with_the_texels() {
    let runs = sweep("sizes", 0.0031);
    let mut wrong: HashMap<(Technique, u32), usize> = HashMap::new();
    for run in &runs {
        let counts = verdict(run).expect("a map").counts;
        *wrong.entry((run.run.technique, run.run.map_size)).or_default() += counts.faults() + counts.edges();
    }
    for technique in Technique::COMPARED {
        let [coarse, fine] = [256, 4096].map(|size| wrong[&(technique, size)]);
        // Edges are lines: their wrong pixels go with the texel's side until a pixel is larger.
        assert!(coarse > 4 * fine, "{technique}: {coarse} pixels wrong at 256, {fine} at 4096");
    }
}

#[test]
fn every_filter_and_side_misses_no_caster() {
    // Back faces with a bias let light through where a solid stands on the floor.
    for run in sweep("filters", 0.016) {
        let (faces, counts) = (pass(&run).faces, verdict(&run).expect("a map").counts);
        if faces == Faces::Back {
            assert!(counts.fraction(counts.false_shadow) < 1e-4, "{run}: {counts:?}");
        } else {
            assert!(counts.fraction(counts.faults()) < 0.0031, "{run}: {counts:?}");
        }
    }
}

/// A warp follows the view from its near plane on. Where that lies close before what is seen, the map's texels go where
/// the pixels are; where it lies in the air, most of them go into the air, and no warp would be better.
#[test]
fn a_warp_pays_where_the_near_plane_is_at_what_is_seen() {
    let runs = sweep("street", 0.007);
    let of = |plane: &str, technique: Technique| {
        let case = format!("near plane {plane}, sun");
        let run = runs.iter().find(|run| run.case == case && run.run.technique == technique).expect("swept");
        verdict(run).expect("a map").aliasing.expect("compared")
    };
    let [uniform, psm] = [Technique::Uniform, Technique::Psm].map(|technique| of("at what is seen", technique));
    assert!(1.5 * psm.median < uniform.median && 2.0 * psm.p95 < uniform.p95, "uniform {uniform:?}, psm {psm:?}");
    let [uniform, psm] = [Technique::Uniform, Technique::Psm].map(|technique| of("in the air", technique));
    assert!(uniform.median < psm.median, "uniform {uniform:?}, psm {psm:?}");
}

#[test]
fn leaves_are_edges_and_little_else() {
    for run in sweep("leaves", 0.0015) {
        let counts = verdict(&run).expect("a map").counts;
        assert!(counts.shadowed * 20 > counts.compared, "{run}: {counts:?}");
    }
}

/// What is left of second depth lies at edges of solids and is gone with virtual samples.
#[test]
fn a_table_needs_no_bias_at_any_size() {
    for run in sweep("table", 0.0056) {
        let counts = verdict(&run).expect("a map").counts;
        let most = match (pass(&run).faces, run.run.filter) {
            (Faces::All, _) => 0.0056,
            (_, Filter::Nearest) => 0.0009,
            _ => 0.0001,
        };
        assert!(counts.fraction(counts.faults()) <= most, "{run}: {counts:?}");
    }
}

/// Virtual samples keep sheets from shadowing themselves. The middle of two layers does where nothing lies close below:
/// not with slabs laid in sand, which the map sees a texel's depth above it.
#[test]
fn sheets_need_virtual_samples_and_not_two_layers() {
    for run in sweep("open-sheets", 0.57) {
        let counts = verdict(&run).expect("a map").counts;
        let faults = counts.fraction(counts.faults());
        match (pass(&run).faces, run.case.starts_with("leaves")) {
            (Faces::Layers, false) => assert!(faults <= 0.0016, "{run}: {counts:?}"),
            (Faces::Layers, true) => assert!(counts.fraction(counts.false_light) <= 0.0022, "{run}: {counts:?}"),
            _ => assert!(faults <= 0.0002, "{run}: {counts:?}"),
        }
    }
}

/// On the first surface they leave what rasterisers make of triangles a texel wide and a thousand long, the street's kerbs;
/// on the second the insides of solids besides, next to creases and feet, where it is too bright.
#[test]
fn virtual_samples_need_no_bias_in_any_format() {
    for run in sweep("virtual", 0.0028) {
        let counts = verdict(&run).expect("a map").counts;
        let most_light = if pass(&run).faces == Faces::Second { 0.0014 } else { 0.0001 };
        let most_shadow = match (run.case.starts_with("street"), run.run.filter, pass(&run).faces) {
            (true, Filter::Virtual(2), Faces::Second) => 0.0008,
            (true, Filter::Virtual(2), _) => 0.0028,
            _ => 0.0001,
        };
        assert!(counts.fraction(counts.false_light) <= most_light, "{run}: {counts:?}");
        assert!(counts.fraction(counts.false_shadow) <= most_shadow, "{run}: {counts:?}");
    }
}

/// No pixel at all was false, drawn either way: two are allowed.
#[test]
fn clouds_cast_as_hexagons_and_as_splats() {
    for run in sweep("points", 0.0001) {
        let counts = verdict(&run).expect("a map").counts;
        assert!(counts.shadowed * 20 > counts.compared, "{run}: {counts:?}");
    }
}

fn verdict(run: &SweepRun) -> Option<&Verdict> {
    match &run.run.result {
        render_check::report::RunResult::Maps(maps) => Some(&maps.verdict),
        render_check::report::RunResult::NoMap { .. } => None,
    }
}

fn pass(run: &SweepRun) -> MapPass {
    match &run.run.result {
        render_check::report::RunResult::Maps(maps) => maps.maps[0].pass,
        render_check::report::RunResult::NoMap { .. } => panic!("{run}: no map"),
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
    for technique in [Technique::Psm, Technique::PsmTight, Technique::PsmUnshifted] {
        let warped = run_one(&stage, &light, technique);
        let (a, b) = (uniform.verdict.aliasing.expect("compared"), warped.verdict.aliasing.expect("compared"));
        for (a, b) in [(a.worst, b.worst), (a.median, b.median), (a.p95, b.p95)] {
            assert!((a / b - 1.0).abs() < 1e-6, "{technique}: {a} {b}");
        }
        assert_eq!(uniform.verdict.counts, warped.verdict.counts, "{technique}");
    }
}

/// Draws some casters through some map and judges it: what a broken fit or a broken culler would do.
fn judged(stage: &Stage<'_>, light: &StageLight, map: &Map, casters: &[std::ops::Range<u32>]) -> Verdict {
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
    let draw = MapDraw { map: Layout::Frustum(*map), casters, pass };
    let shadow_maps = ShadowMaps::draw(stage.gpu, &stage.geometry, &split, &[Some(draw)]).expect("drawn");
    let lit = shadow_test(stage.gpu, &stage.surfaces, &shadow_maps, Filter::Nearest).expect("tested").lit;
    let depths = shadow_maps.depths(stage.gpu).expect("readable");
    let frustum = Frustum::new(map, stage.view.eye());
    let bias = verdict::Bias::most(&pass);
    let drawn = DrawnMap { projection: &frustum, depths: &depths[0], is_reversed: false, bias };
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
    let map = *fit(&view, &light.light, &stage.bounds, &settings).map().expect("one map does");
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
        let biased = [Filter::Nearest, Filter::PercentageCloser(5)].map(|filter| of(Faces::All, filter, None));
        let second = [Filter::Nearest, Filter::PercentageCloser(5)].map(|filter| of(Faces::Second, filter, None));
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
    assert!(2.0 * narrow < wide, "{wide} and narrowed {narrow}");
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
