//! Scenes with something wrong with them, scenes far from the origin in f32, and lamps that go through surfaces: what is
//! sound is drawn and is right, what is not is left out and said, and no caster is missing.

#![allow(clippy::disallowed_methods, reason = "only the fitting path needs the same bits on every platform")]

use std::collections::HashMap;
use std::path::Path;

use super::common::{pass, sweep, verdict};
use render_check::cmd::sweep::SweepRun;
use render_check::maps::Technique;
use render_check::run::RunResult;
use render_check::scene::damage::{Fault, damaged, in_single_precision};
use render_check::scene::{self, LeftOut, LoadedScene, Mesh};
use render_check::trace::{Faces, Ray, Tracer};
use render_check::verdict::{Counts, Mark};
use shadowfit::glam::DVec3;
use shadowfit::{mesh::Solidity, plan::Surface};

fn built_in(name: &str) -> LoadedScene {
    scene::load(Path::new(name)).expect("built in")
}

fn objects_are_as_before(mesh: &Mesh, before: &Mesh) -> bool {
    let is_alike = |i: usize| {
        let (a, b) = (&mesh.objects[i], &before.objects[i]);
        (&a.triangles, a.min, a.max, a.solidity) == (&b.triangles, b.min, b.max, b.solidity)
    };
    mesh.objects.len() == before.objects.len() && (0..before.objects.len()).all(is_alike)
}

#[test]
fn what_cannot_be_used_is_left_out_and_the_rest_is_whole() {
    for name in ["chess-board", "street", "room", "behind"] {
        let sound = built_in(name);
        let (objects, triangles) = (sound.mesh.objects.len(), sound.mesh.triangles.len());
        for fault in Fault::ALL.into_iter().filter(|fault| fault.leaves_all()) {
            let scene = damaged(&sound, fault);
            let corners = |mesh: &Mesh| (0..mesh.triangles.len()).map(|i| mesh.corners(i)).collect::<Vec<_>>();
            assert_eq!(corners(&scene.mesh), corners(&sound.mesh), "{name}, {fault:?}");
            assert!(objects_are_as_before(&scene.mesh, &sound.mesh), "{name}, {fault:?}");
            let none = LeftOut::default();
            let fifths = sound.mesh.objects.iter().map(|object| object.triangles.len().div_ceil(5)).sum();
            let expected = match fault {
                Fault::WithoutArea => LeftOut { flat: 3 * objects, ..none },
                Fault::Twice => LeftOut { twice: fifths, ..none },
                Fault::BeyondVertices => LeftOut { out_of_range: 2 * objects, ..none },
                // Shrunk to a point and to a line, each triangle is one without area, or is there twice.
                Fault::Shrunk => LeftOut { flat: 2 * triangles, ..none },
                _ => none,
            };
            assert_eq!(scene.left_out, expected, "{name}, {fault:?}");
        }
    }
}

/// The triangles of five vertices are lost and no others, and said to be.
#[test]
fn vertices_that_are_no_places_cost_their_triangles_and_no_more() {
    for name in ["chess-board", "street", "room"] {
        let sound = built_in(name);
        let lost = |fault| {
            let scene = damaged(&sound, fault);
            let LeftOut { not_finite, too_large, .. } = scene.left_out;
            assert_eq!(scene.mesh.triangles.len() + not_finite + too_large, sound.mesh.triangles.len());
            assert!(scene.mesh.bounds().0.is_finite() && scene.mesh.bounds().1.is_finite());
            let told = scene.left_out.to_string();
            assert!(told.contains("triangle(s) with a"), "{told}");
            [not_finite, too_large]
        };
        let [not_a_number, infinite, far_away] = [Fault::NotANumber, Fault::Infinite, Fault::FarAway].map(lost);
        assert!((5..=100).contains(&not_a_number[0]) && not_a_number[1] == 0, "{name}: {not_a_number:?}");
        assert_eq!((infinite, far_away), (not_a_number, [0, not_a_number[0]]), "{name}");
    }
}

/// Rays meet what is left of a scene where they met it before.
#[test]
fn rays_survive_every_fault() {
    let sound = built_in("street");
    let before = Tracer::new(&sound.mesh).expect("it has triangles");
    let camera = sound.camera.expect("it has one");
    let across = camera.forward.cross(camera.up).normalize();
    let rays = (0..40).flat_map(|i| (0..25).map(move |j| (f64::from(i - 20) / 25.0, f64::from(j - 12) / 25.0)));
    let rays: Vec<Ray> = rays
        .map(|(x, y)| (camera.forward + x * across + y * camera.up).normalize())
        .map(|direction| Ray { origin: camera.eye, direction, length: f64::INFINITY })
        .collect();
    for fault in Fault::ALL {
        let scene = damaged(&sound, fault);
        let after = Tracer::new(&scene.mesh).expect("it has triangles");
        let mut apart = 0;
        for ray in &rays {
            let [one, other] = [&before, &after].map(|tracer| tracer.first_hit(ray).map(|hit| hit.distance));
            let is_same = match (one, other) {
                (Some(one), Some(other)) => (one - other).abs() <= 1e-9 * one,
                (one, other) => one == other,
            };
            apart += usize::from(!is_same);
        }
        // Five vertices of the street are corners of much of the picture.
        let most = if matches!(fault, Fault::NotANumber | Fault::Infinite | Fault::FarAway) { 100 } else { 0 };
        assert!(apart <= most, "{fault:?}: {apart} of {} rays", rays.len());
    }
}

/// A solid with its fronts inside is one inside out; with some of its fronts inside it is none.
#[test]
fn what_is_inside_out_is_no_solid() {
    for name in ["chess-board", "table"] {
        let sound = built_in(name);
        for (fault, expected) in [(Fault::InsideOut, Solidity::Inverted), (Fault::PartlyReversed, Solidity::Open)] {
            let scene = damaged(&sound, fault);
            assert!(scene.left_out.is_nothing(), "{}", scene.left_out);
            for (i, (object, before)) in scene.mesh.objects.iter().zip(&sound.mesh.objects).enumerate() {
                assert_eq!(before.solidity, Solidity::Watertight, "{name}, {i}");
                let expected = if i % 3 == 0 { expected } else { Solidity::Watertight };
                assert_eq!(object.solidity, expected, "{name}, {i}");
                assert!(object.surface == Surface::Mesh(expected) || expected == Solidity::Open, "{name}, {i}");
            }
        }
    }
}

/// Pixel for pixel the same where all is still there, and as few false pixels as ever where something is gone or turned
/// round: the bounds of the same scenes without faults, see `sweep.rs`.
#[test]
fn faults_cost_nothing_but_what_is_faulty() {
    let runs = sweep("faults", 0.0072);
    let mut sound: HashMap<String, &[Mark]> = HashMap::new();
    let mut same = 0;
    for run in &runs {
        let (scene, rest) = run.case.split_once(", ").expect("a scene");
        let verdict = verdict(run).expect("a map");
        assert!(verdict.counts.shadowed > 1000, "{run}: {:?}", verdict.counts);
        let key = format!("{scene}, {}, {}, {}", run.run.light, run.run.technique, run.run.filter);
        if rest.starts_with("sound") {
            sound.insert(key, &verdict.marks);
            continue;
        }
        let before = sound[&key];
        let leaves_all = |fault: &Fault| fault.leaves_all() && rest.starts_with(fault.words());
        if Fault::ALL.iter().any(leaves_all) {
            assert!(verdict.marks == before, "{run}: {:?}", verdict.counts);
            same += 1;
        } else if rest.starts_with(Fault::InsideOut.words()) {
            // The same triangles with their corners in another order, which may round another way.
            let apart = verdict.marks.iter().zip(before).filter(|(one, other)| one != other).count();
            assert!(apart * 500 < verdict.counts.compared, "{run}: {apart} pixels differ");
        }
        // Depths that second depth takes from solids it must take from both sides of what is none.
        if pass(run).faces == Faces::Second {
            assert!(verdict.counts.fraction(verdict.counts.faults()) < 0.0014, "{run}: {:?}", verdict.counts);
        }
    }
    assert_eq!((runs.len(), same), (11 * 5 * 4, 5 * 5 * 4));
}

/// About the eye a scene a thousand kilometres off, in millimetres, is drawn as the same shape at home is. In world space
/// f32 loses shadows there and never makes one.
#[test]
fn far_off_nothing_is_lost_but_what_positions_are() {
    // In world space, at 10⁹ mm, next to nothing is left of a lamp's shadows, and all of what was in shadow is lit.
    let runs = sweep("far-off", 0.08);
    let mut at_home: HashMap<String, Counts> = HashMap::new();
    for run in &runs {
        let (place, light) = run.case.rsplit_once(", ").expect("a light");
        let counts = verdict(run).expect("a map").counts;
        let rounded = |place: &str| format!("{place}, {light}, {}, {}", run.run.technique, run.run.filter);
        if let Some(distance) = place.strip_suffix(", at home") {
            let distance = distance.strip_prefix("rounded at ").expect("a distance");
            at_home.insert(rounded(distance), counts);
            continue;
        }
        let (distance, way) = place.split_once(", ").expect("a way");
        let home = at_home[&rounded(distance)];
        // The camera sees the same, whatever the maps' positions are relative to.
        assert!(counts.compared.abs_diff(home.compared) * 500 < home.compared, "{run}: {counts:?}, {home:?}");
        match way {
            "about the eye" => {
                let apart = counts.faults().abs_diff(home.faults()) + counts.edges().abs_diff(home.edges());
                // Vertices round differently in f32 about another eye, which moves a few edges over a pixel's middle.
                assert!(apart * 500 < home.compared, "{run}: {counts:?} against {home:?}");
                assert!(counts.fraction(counts.faults()) <= 0.0041, "{run}: {counts:?}");
            }
            // The bias covers all that f32 does to a position, so that no surface shadows itself; what it lets through
            // is false light.
            _ => {
                assert!(counts.false_shadow <= home.false_shadow, "{run}: {counts:?} against {home:?}");
                let most = if distance == "1e6 mm" { 0.0136 } else { 0.08 };
                assert!(counts.fraction(counts.faults()) <= most, "{run}: {counts:?}");
            }
        }
    }
    assert_eq!(runs.len(), 2 * 3 * 3 * 5);
}

#[test]
fn positions_in_f32_are_on_its_grid_and_keep_their_solids() {
    let sound = built_in("chess-board");
    // 64 mm is a step of f32 at 10⁹, 0.06 mm at 10⁶.
    for (distance, step, least) in [(1e6, 0.0625, 1.0), (1e9, 64.0, 0.9)] {
        let scene = in_single_precision(&sound.moved(1e3, distance * DVec3::new(1.0, -0.3, 0.7)));
        let (mesh, before) = (&scene.mesh, &sound.mesh);
        assert!(mesh.vertices.iter().all(|vertex| (vertex.x / step).fract() == 0.0));
        let lost = before.triangles.len() - mesh.triangles.len();
        assert_eq!(lost, scene.left_out.flat + scene.left_out.twice, "{}", scene.left_out);
        let solids = mesh.objects.iter().filter(|object| object.solidity == Solidity::Watertight).count();
        assert!(solids as f64 >= least * before.objects.len() as f64, "{distance}: {solids}");
    }
}

/// The distance of a lamp from its surface, as a part of the largest coordinate.
fn part(run: &SweepRun) -> f64 {
    run.case.rsplit(", ").next().and_then(|part| part.parse().ok()).expect("a number")
}

/// A lamp on its way through ceiling, shade, vase, table, wall, rug, floor, a piece and its board. What is nearer to it than
/// its map begins is open, see `Illumination::Either`.
#[test]
fn a_lamp_passes_through_surfaces() {
    // A lamp a few centimetres above a board grazes it for many texels; twice what was measured.
    let runs = sweep("through-surfaces", 0.072);
    assert_eq!(runs.len(), 11 * 11 * 5);
    let mut by_way: HashMap<(String, Technique), Vec<&SweepRun>> = HashMap::new();
    for run in &runs {
        let has_one_map = matches!(run.run.technique, Technique::Uniform | Technique::Psm | Technique::Best);
        match &run.run.result {
            RunResult::Maps(maps) => {
                let counts = maps.verdict.counts;
                // At a surface a lamp is no worse than elsewhere in a scene: the bound for those that are.
                let most = if part(run).abs() < 1e-5 { 0.012 } else { 0.072 };
                assert!(counts.fraction(counts.faults()) <= most, "{run}: {counts:?}");
            }
            // Where a lamp is in view one map does not do; the faces of a cube and paraboloids always do.
            RunResult::NoMap { no_map, .. } => assert!(has_one_map && no_map.contains("stands among"), "{run}"),
        }
        let (way, _) = run.case.rsplit_once(", ").expect("a distance");
        by_way.entry((way.to_owned(), run.run.technique)).or_default().push(run);
    }
    // Each step of f32 and f64 shows what the one before it does.
    let mut steps = 0;
    for lamps in by_way.values() {
        assert_eq!(lamps.len(), 11);
        for pair in lamps.windows(2) {
            let [one, other] = [pair[0], pair[1]];
            if part(one).abs().max(part(other).abs()) > 1e-5 || part(one) * part(other) < 0.0 {
                continue;
            }
            let (Some(a), Some(b)) = (verdict(one), verdict(other)) else {
                assert!(verdict(one).is_none() && verdict(other).is_none(), "{one} and {other}");
                continue;
            };
            let is_compared = |mark: Mark| !matches!(mark, Mark::Sky | Mark::Unlit);
            let both: Vec<(Mark, Mark)> = a.marks.iter().copied().zip(b.marks.iter().copied()).collect();
            let both: Vec<_> = both.into_iter().filter(|&(a, b)| is_compared(a) && is_compared(b)).collect();
            let jumps = both.iter().filter(|(a, b)| a.fault().is_some() != b.fault().is_some()).count();
            assert!(jumps * 500 <= both.len(), "{one} and {other}: {jumps} of {}", both.len());
            steps += 1;
        }
    }
    // The faces of a cube and paraboloids have maps for all lamps.
    assert!(steps >= 11 * 2 * 6, "{steps}");
}
