//! Verdicts on a renderer with known faults.

use anyhow::Result;
use shadowfit::glam::DVec3;
use shadowfit::{ClipSpace, Origin, Settings, View, Warp};

use super::fake::{self, Fake, LAMP, LAMP_NEAR, SIZE, SPOT, SUN};
use super::*;
use crate::maps::Split;
use crate::scene::LightSpec;
use crate::trace::{Faces, Tracer};

/// Objects of the fake renderer's mesh.
const SLAB: usize = 1;
const BALL: usize = 2;

fn uniform() -> Settings {
    fake::settings().with_warp(Warp::Uniform)
}

/// The verdict on a correct map, except for the faults of `fake`.
fn verdict(fake: &Fake, light: &LightSpec, settings: &Settings) -> Verdict {
    fake.verdict(light, &fake::fitted(light, settings), &fake::mesh())
}

#[test]
fn an_honest_map_is_wrong_only_at_edges() {
    let soft = Fake { filter: 3, ..Fake::default() };
    let backs = Fake { faces: Faces::Back, ..Fake::default() };
    let biased = Fake { bias: Bias { constant: 1e-4, slope: 1.5 }, look_up_slope: 0.5, ..Fake::default() };
    let reversed = uniform().with_clip(ClipSpace::OPENGL.reversed());
    let about_the_eye = uniform().with_origin(Origin::Eye);
    for (light, settings, fake) in [
        (SUN, uniform(), Fake::default()),
        (SUN, uniform(), soft),
        (SUN, uniform(), backs),
        (SUN, uniform(), biased),
        (SUN, fake::settings(), Fake::default()),
        (SUN, reversed, Fake::default()),
        (SUN, about_the_eye, Fake::default()),
        (LAMP, uniform(), Fake::default()),
        (LAMP, fake::settings(), soft),
        (SPOT, uniform(), Fake::default()),
    ] {
        let verdict = verdict(&fake, &light, &settings);
        let counts = verdict.counts;
        assert_eq!((counts.faults(), verdict.worst_cluster), (0, None), "{light}: {counts:?}");
        assert!(counts.edges() > 20 && counts.fraction(counts.edges()) < 0.01, "{light}: {counts:?}");
        assert!(counts.compared > 15_000 && counts.shadowed > 1_000 && counts.sky > 5_000, "{light}: {counts:?}");
        let aliasing = verdict.aliasing.expect("pixels were compared");
        assert!(0.3 < aliasing.median && aliasing.median <= aliasing.p95 && aliasing.p95 <= aliasing.worst);
        assert!(aliasing.worst < 3.0, "{light}: {aliasing:?}");
    }
}

#[test]
fn shadows_thinner_than_a_texel_are_all_edge() {
    let fence = fake::fence();
    for filter in [1, 3, 5] {
        let fake = Fake { filter, ..Fake::default() };
        let counts = fake.verdict_on(&fence, &SUN, &fake::fitted(&SUN, &uniform()), &fence).counts;
        // A wide filter lets nearly all light through: true shadows come out lit.
        assert!(counts.faults() == 0 && counts.edges() > 50, "{filter}: {counts:?}");
    }
}

#[test]
fn a_caster_that_is_not_in_the_map_is_missing() {
    let reversed = uniform().with_clip(ClipSpace::VULKAN.reversed());
    for (light, settings, faces) in [
        (SUN, uniform(), Faces::All),
        (SUN, fake::settings(), Faces::Back),
        (SUN, reversed, Faces::Front),
        (LAMP, fake::settings(), Faces::All),
        (SPOT, uniform(), Faces::All),
    ] {
        let fake = Fake { faces, ..Fake::default() };
        let map = fake::fitted(&light, &settings);
        let whole = fake.verdict(&light, &map, &fake::mesh()).counts;
        let verdict = fake.verdict(&light, &map, &fake::mesh_without(SLAB));
        let counts = verdict.counts;
        // About half of the shadows are the slab's.
        assert!(counts.missing > counts.shadowed / 3, "{light}: {counts:?}");
        assert_eq!(counts.false_light + counts.false_shadow, 0, "{light}: {counts:?}");
        assert!(counts.edges() < 4 * whole.edges(), "{light}: {counts:?}");
        let cluster = verdict.worst_cluster.expect("there are faults");
        assert_eq!(cluster.fault, Fault::Missing);
        // The light ray through the middle of the patch passes through the slab.
        let position = DVec3::from(cluster.position);
        let to_light = light.to_light(LAMP_NEAR).expect("sound").direction_from(position);
        let through = position + (1.5 - position.y) / to_light.y * to_light;
        assert!(through.distance(DVec3::new(-1.2, 1.5, -0.1)) < 0.5, "{light}: {cluster:?} through {through}");
        assert!(cluster.pixels > counts.missing * 9 / 10, "{light}: {cluster:?}");
    }
}

#[test]
fn a_map_that_holds_nothing_misses_all_its_casters_without_any_bias() {
    // The map stores the receiver's own depth, rounded to f32 in either direction.
    let fake = Fake { look_up_bias: 0.0, ..Fake::default() };
    let verdict = fake.verdict(&SUN, &fake::fitted(&SUN, &uniform()), &fake::floor());
    let counts = verdict.counts;
    assert!(counts.missing > counts.shadowed * 3 / 4 && counts.false_light == 0, "{counts:?}");
}

#[test]
fn each_part_of_a_light_is_judged_by_its_own_map() {
    // So low that the middle of the floor is below it and the rest to its sides.
    let position = DVec3::new(0.4, 3.0, 0.7);
    let lamp = LightSpec::Point { position, range: f64::INFINITY };
    let (mesh, map) = (fake::mesh(), fake::fitted(&lamp, &uniform()));
    let tracer = Tracer::new(&mesh).expect("it has triangles");
    let (fake, truth) = (Fake::default(), fake::truth(&lamp, &tracer));
    let depths = fake.draw(&map, &tracer);
    let lit = fake.light(&map, &depths, &truth, &mesh);
    let whole = fake.judge(&map, &depths, &lit, &truth, &tracer).expect("sound inputs");

    let (frustum, split) = (Frustum::new(&map), Split::cube(position));
    let drawn =
        DrawnMap { projection: &frustum, depths: &depths, is_reversed: false, bias: fake.bias, derived: None };
    let verdict = |maps: &[Option<DrawnMap>], lit: &[f32]| {
        judge(&truth, &fake.hand_over(&split, maps, lit), &tracer).expect("sound inputs")
    };
    assert_eq!(verdict(&[Some(drawn); 6], &lit), whole, "one map in place of six is that map");

    // Without the maps of the sides all of them counts as lit.
    let below = 3;
    let part = |index: usize| truth.pixels()[index].surface().map(|surface| split.part_of(surface.point));
    let lit: Vec<f32> = (0..lit.len()).map(|i| if part(i) == Some(below) { lit[i] } else { 1.0 }).collect();
    let maps = [0, 1, 2, 3, 4, 5].map(|part| (part == below).then_some(drawn));
    let verdict = verdict(&maps, &lit);
    for (index, (&mark, &before)) in verdict.marks.iter().zip(&whole.marks).enumerate() {
        let compared = truth.pixels()[index].compared();
        let expected = match (part(index), compared) {
            (Some(part), Some((_, true))) if part != below => Mark::Right,
            (Some(part), Some((_, false))) if part != below => Mark::Missing,
            _ => before,
        };
        assert_eq!(mark, expected, "pixel {index}");
    }
    assert!(verdict.counts.missing > 100 && whole.counts.missing == 0, "{:?}", verdict.counts);
}

#[test]
fn too_small_a_bias_is_false_shadow() {
    for (light, settings) in [(SUN, uniform()), (LAMP, fake::settings())] {
        let acne = Fake { look_up_bias: 0.0, look_up_slope: 0.0, ..Fake::default() };
        let verdict = verdict(&acne, &light, &settings);
        let counts = verdict.counts;
        assert!(counts.false_shadow > counts.compared / 4, "{light}: {counts:?}");
        assert_eq!(counts.missing, 0, "{light}: {counts:?}");
        // On the flat floor and on the convex ball, the edge rule hides faults close to a shadow and no others.
        assert!(counts.edges() < counts.false_shadow / 4, "{light}: {counts:?}");
        assert_eq!(verdict.worst_cluster.map(|cluster| cluster.fault), Some(Fault::FalseShadow));
    }
}

#[test]
fn too_large_a_bias_is_false_light() {
    // Once in the look-up, once in the rasteriser, where it is stated.
    let in_look_up = Fake { look_up_bias: 0.3, ..Fake::default() };
    let in_map = Fake { bias: Bias { constant: 0.3, slope: 0.0 }, ..Fake::default() };
    for fake in [in_look_up, in_map] {
        let counts = verdict(&fake, &SUN, &uniform()).counts;
        assert!(counts.false_light > counts.shadowed / 3, "{counts:?}");
        assert_eq!((counts.missing, counts.false_shadow), (0, 0), "{counts:?}");
    }
}

#[test]
fn a_map_upside_down_is_caught() {
    let mesh = fake::mesh();
    let tracer = Tracer::new(&mesh).expect("it has triangles");
    let (map, fake, truth) = (fake::fitted(&SUN, &uniform()), Fake::default(), fake::truth(&SUN, &tracer));
    let size = map.settings().map_size() as usize;
    let depths = fake.draw(&map, &tracer);
    let flipped: Vec<f32> = depths.chunks(size).rev().flatten().copied().collect();
    let lit = fake.light(&map, &flipped, &truth, &mesh);
    let counts = fake.judge(&map, &flipped, &lit, &truth, &tracer).expect("sound inputs").counts;
    assert!(counts.faults() > counts.shadowed && counts.faults() > 4 * counts.edges(), "{counts:?}");
    assert!(counts.missing > counts.shadowed / 3 && counts.false_shadow > 1_000, "{counts:?}");
}

#[test]
fn scenes_small_large_and_far_away_have_the_same_truth() {
    let mesh = fake::mesh();
    let tracer = Tracer::new(&mesh).expect("it has triangles");
    let triangles = fake::triangles(&fake::view(), &tracer);
    for light in [SUN, LAMP, SPOT] {
        let expected = fake::truth(&light, &tracer);
        for (scale, offset) in [(1e-3, DVec3::ZERO), (1e6, DVec3::ZERO), (0.1, DVec3::new(1e6, -1e6, 1e6))] {
            let moved = |point: DVec3| scale * point + offset;
            let mut mesh = mesh.clone();
            mesh.vertices.iter_mut().for_each(|vertex| *vertex = moved(*vertex));
            let view = fake::view();
            let (near, far) = (scale * view.near(), scale * view.far());
            let aspect = f64::from(SIZE[0]) / f64::from(SIZE[1]);
            let view = View::perspective(moved(view.eye()), view.forward(), view.up(), 0.75, aspect, near, far);
            let light = match light {
                LightSpec::Sun { .. } => light,
                LightSpec::Point { position, range } => {
                    LightSpec::Point { position: moved(position), range: scale * range }
                }
                LightSpec::Spot { position, target, cone_degrees, range } => LightSpec::Spot {
                    position: moved(position),
                    target: moved(target),
                    cone_degrees,
                    range: scale * range,
                },
            };
            let tracer = Tracer::new(&mesh).expect("it has triangles");
            let view = view.expect("a sound view");
            let truth = TruthImage::trace(&view, SIZE, &triangles, &light, scale * LAMP_NEAR, &tracer);
            let truth = truth.expect("sound inputs");
            let mut differing = 0;
            for (found, expected) in truth.pixels().iter().zip(expected.pixels()) {
                match (found, expected) {
                    (Truth::Seen(found, light), Truth::Seen(expected, expected_light)) => {
                        let off = found.point.distance(moved(expected.point));
                        assert!(off < 1e-8 * scale + 1e-13 * offset.length(), "{scale} {offset}: off by {off}");
                        differing += usize::from(light != expected_light);
                    }
                    _ => assert_eq!(found, expected),
                }
            }
            assert!(differing <= 1, "{light} {scale} {offset}: {differing} pixels differ");
        }
    }
}

/// The truth where the camera looks from `eye` at one point of the floor.
fn truth_at(point: DVec3, eye: DVec3, light: &LightSpec) -> Result<Truth> {
    let mesh = fake::floor();
    let tracer = Tracer::new(&mesh)?;
    let view = View::perspective(eye, point - eye, DVec3::X, 0.1, 1.0, 0.1, 100.0)?;
    let triangle = if point.x > -point.z { 0 } else { 1 };
    Ok(TruthImage::trace(&view, [1, 1], &[triangle], light, LAMP_NEAR, &tracer)?.pixels()[0])
}

#[test]
fn light_that_cannot_arrive_is_no_shadow() {
    let (point, above, below) = (DVec3::new(1.0, 0.0, -2.0), DVec3::new(0.0, 3.0, 1.0), DVec3::new(0.0, -3.0, 1.0));
    let lamp = |height: f64, range: f64| LightSpec::Point { position: point + height * DVec3::Y, range };
    let spot = |aside: f64| LightSpec::Spot {
        position: point + 2.0 * DVec3::Y,
        target: point + aside * DVec3::X,
        cone_degrees: 60.0,
        range: f64::INFINITY,
    };
    let beside_the_cone = 2.0 * 30_f64.to_radians().tan();
    for (eye, light, expected) in [
        (above, SUN, Illumination::Lit),
        (below, SUN, Illumination::Unlit),
        (above, LightSpec::Sun { direction_to_light: DVec3::new(1.0, -0.1, 0.0) }, Illumination::Unlit),
        (below, LightSpec::Sun { direction_to_light: DVec3::new(1.0, -0.1, 0.0) }, Illumination::Lit),
        (above, lamp(2.0, 2.1), Illumination::Lit),
        (above, lamp(2.0, 1.9), Illumination::Unlit),
        (below, lamp(2.0, 2.1), Illumination::Unlit),
        (above, lamp(1.1 * LAMP_NEAR, 9.0), Illumination::Lit),
        (above, lamp(0.9 * LAMP_NEAR, 9.0), Illumination::Unlit),
        (above, spot(0.99 * beside_the_cone), Illumination::Lit),
        (above, spot(1.01 * beside_the_cone), Illumination::Unlit),
    ] {
        let truth = truth_at(point, eye, &light).expect("sound inputs");
        let Truth::Seen(surface, illumination) = truth else { panic!("{light}: only sky") };
        assert_eq!(illumination, expected, "{light} from {eye}");
        assert!((surface.point - point).length() < 1e-12 && surface.normal == eye.y.signum() * DVec3::Y);
    }
}

#[test]
fn a_lampshade_within_the_lamps_near_distance_casts_no_shadow() {
    let mesh = fake::mesh_without(BALL);
    let tracer = Tracer::new(&mesh).expect("it has triangles");
    let triangles = fake::triangles(&fake::view(), &tracer);
    // Close above the slab, none of whose corners is farther away than 1.5.
    let lamp = LightSpec::Point { position: DVec3::new(-1.2, 1.7, -0.1), range: f64::INFINITY };
    let shadowed = |near: f64| {
        let truth = TruthImage::trace(&fake::view(), SIZE, &triangles, &lamp, near, &tracer).expect("sound inputs");
        truth.pixels().iter().filter_map(Truth::compared).filter(|(_, lit)| !lit).count()
    };
    assert!(shadowed(0.05) > 10_000 && shadowed(1.5) == 0, "{} and {}", shadowed(0.05), shadowed(1.5));
}

#[test]
fn what_does_not_fit_together_is_refused() {
    let mesh = fake::mesh();
    let tracer = Tracer::new(&mesh).expect("it has triangles");
    let trace = |triangles: &[u32], light: &LightSpec| {
        TruthImage::trace(&fake::view(), [2, 2], triangles, light, LAMP_NEAR, &tracer)
    };
    let refusal = |triangles: &[u32], light: &LightSpec| trace(triangles, light).expect_err("unsound").to_string();
    assert!(refusal(&[0; 3], &SUN).contains("2 x 2 pixels"));
    assert!(refusal(&[], &SUN).contains("2 x 2 pixels"));
    assert!(refusal(&[0, 0, 0, 123_456], &SUN).contains("triangle 123456"));
    assert!(refusal(&[0; 4], &LightSpec::Sun { direction_to_light: DVec3::ZERO }).contains("cannot be used"));

    let truth = trace(&[0, 1, u32::MAX, 0], &SUN).expect("sound inputs");
    let map = fake::fitted(&SUN, &uniform());
    let depths = vec![1.0; 256 * 256];
    let frustum = Frustum::new(&map);
    let drawn = DrawnMap {
        projection: &frustum,
        depths: &depths,
        is_reversed: false,
        bias: Bias::default(),
        derived: None,
    };
    let (split, maps) = (Split::whole(), [Some(drawn)]);
    let whole = Fake::default().hand_over(&split, &maps, &[1.0; 4]);
    let refusal = |rendered: Rendered| judge(&truth, &rendered, &tracer).expect_err("unsound").to_string();
    assert!(judge(&truth, &whole, &tracer).is_ok());
    assert!(refusal(Rendered { lit: &[1.0; 3], ..whole }).contains("3 pixels"));
    assert!(refusal(Rendered { maps: &[], ..whole }).contains("0 maps"));
    let cut = [Some(DrawnMap { depths: &depths[1..], ..drawn })];
    assert!(refusal(Rendered { maps: &cut, ..whole }).contains("65535 texels"));
    assert!(refusal(Rendered { reach: 0.2, ..whole }).contains("not 0.2"));
}

#[test]
fn a_verdict_is_written_as_json_without_its_marks() {
    let acne = Fake { look_up_bias: 0.0, look_up_slope: 0.0, ..Fake::default() };
    let json = serde_json::to_value(verdict(&acne, &SUN, &uniform())).expect("plain numbers");
    assert_eq!(json["worst_cluster"]["fault"], "false_shadow");
    assert_eq!(json["worst_cluster"]["position"].as_array().map(Vec::len), Some(3));
    assert!(json["counts"]["false_shadow"].is_u64() && json["aliasing"]["p95"].is_f64());
    assert!(json.get("marks").is_none());
}
