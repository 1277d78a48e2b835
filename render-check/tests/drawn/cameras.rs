//! Cameras that are no upright frustum of their own, drawn: no caster is missing from any map.

#![allow(clippy::disallowed_methods, reason = "pictures need no results that are the same to the bit")]

use std::time::Duration;

use render_check::gpu::Gpu;
use render_check::maps::{Layout, Split, Technique};
use render_check::run::{FittedMap, FittedMaps, Options, run, run_fitted};
use render_check::scene::{self, LightSpec, Mesh};
use render_check::stage::Stage;
use render_check::trace::Tracer;
use shadowfit::glam::{DMat4, DVec3, DVec4};
use shadowfit::{ClipSpace, FocusForm, Outcome, View, focus::Plane, multiview::SharedFocus};

const IMAGE: [u32; 2] = [160, 100];
const MAP: u32 = 512;

fn chess_board() -> Mesh {
    scene::load("chess-board".as_ref()).expect("built in").mesh
}

fn camera() -> View {
    let (eye, forward) = (DVec3::new(0.9, 2.1, 2.6), DVec3::new(-1.0, -2.0, -7.0));
    View::perspective(eye, forward, DVec3::Y, 0.73, 1.6, 0.5, 60.0).expect("sound")
}

fn sun() -> LightSpec {
    LightSpec::Sun { direction_to_light: DVec3::new(-0.8, 0.6, 0.2) }
}

/// Draws a stage with maps of its own, and counts what is missing.
fn assert_none_missing(stage: &Stage<'_>) {
    let light = stage.light(sun()).expect("sound");
    assert!(light.truth.shadowed() > 100, "{} pixels in shadow", light.truth.shadowed());
    for technique in Technique::COMPARED {
        let run = run(stage, &light, &Options::new(technique, MAP)).expect("drawn").expect("one map does");
        assert_eq!(run.verdict.counts.missing, 0, "{technique}");
    }
}

/// A swapchain turned by a quarter: the image is drawn on its side.
#[test]
fn a_projection_turned_by_a_quarter() {
    let mesh = chess_board();
    let (gpu, tracer) = (Gpu::new().expect("an adapter"), Tracer::new(&mesh).expect("it has triangles"));
    let quarter = DMat4::from_cols(DVec4::Y, DVec4::NEG_X, DVec4::Z, DVec4::W);
    let view =
        View::from_clip_from_world(quarter * camera().clip_from_world(), ClipSpace::OPENGL).expect("a camera");
    let [width, height] = IMAGE;
    assert_none_missing(&Stage::new(&gpu, &tracer, &view, [height, width]).expect("drawn"));
}

/// The scene through a portal before it: a near plane that leans by a quarter of a right angle.
#[test]
fn an_oblique_near_plane() {
    let mesh = chess_board();
    let (gpu, tracer) = (Gpu::new().expect("an adapter"), Tracer::new(&mesh).expect("it has triangles"));
    let (whole, (min, max)) = (camera(), mesh.bounds());
    // A plane that touches the scene, with all of it beyond, and the camera moved to before it.
    let normal = DVec3::new(0.2, -0.35, -1.0);
    let nearest = DVec3::select(normal.cmpgt(DVec3::ZERO), min, max);
    let plane = Plane::through(normal, nearest);
    let eye = whole.eye() - normal * ((plane.at(whole.eye()) / normal.length_squared()).max(0.0) + 0.25);
    let moved = View::perspective(eye, whole.forward(), whole.up(), 0.73, 1.6, 0.125, 60.0).expect("sound");
    let mut rows = moved.clip_from_world().transpose();
    let plane = plane.to_row();
    let from_clip = moved.clip_from_world().inverse();
    let sign = |axis: DVec4| plane.truncate().dot(axis.truncate()).signum();
    let corner = from_clip * DVec4::new(sign(from_clip.x_axis), sign(from_clip.y_axis), 1.0, 1.0);
    rows.z_axis = plane * (2.0 * rows.w_axis.dot(corner) / plane.dot(corner)) - rows.w_axis;
    let view = View::from_clip_from_world(rows.transpose(), ClipSpace::OPENGL).expect("a camera");
    assert_eq!(view.planes().len(), 8 - usize::from(view.far().is_infinite()));
    let stage = Stage::new(&gpu, &tracer, &view, IMAGE).expect("drawn");
    let light = stage.light(sun()).expect("sound");
    let surfaces = light.truth.pixels().iter().filter_map(|pixel| pixel.surface());
    let beyond = surfaces.filter(|surface| view.planes().iter().any(|plane| plane.at(surface.point) < -1e-6));
    assert_eq!(beyond.count(), 0, "all that is seen is in V");
    assert_none_missing(&stage);
}

/// Two eyes, 64 mm apart and canted outwards, read one map.
#[test]
fn two_eyes_in_one_map() {
    let mesh = chess_board();
    let (gpu, tracer) = (Gpu::new().expect("an adapter"), Tracer::new(&mesh).expect("it has triangles"));
    let middle = camera();
    let eyes = [-1.0, 1.0].map(|side: f64| {
        let forward = middle.forward() + middle.right() * (0.09 * side);
        let eye = middle.eye() + middle.right() * (0.032 * side);
        View::perspective(eye, forward, middle.up(), 0.73, 1.6, 0.5, 60.0).expect("sound")
    });
    let stages = eyes.map(|view| {
        let stage = Stage::new(&gpu, &tracer, &view, IMAGE).and_then(Stage::in_world_space);
        stage.expect("drawn")
    });
    for technique in Technique::COMPARED {
        let options = Options::new(technique, MAP);
        for stage in &stages {
            let light = stage.light(sun()).expect("sound");
            let shared = SharedFocus::new(&eyes, &light.light, &stage.bounds).expect("two views");
            let Outcome::Map(map) = shared.fit(&options.settings(stage).expect("sound")) else {
                panic!("one map does");
            };
            let bodies: Vec<_> = shared.bodies(FocusForm::ReceiverHull).collect();
            let objects = mesh.objects.iter().enumerate();
            let casts = |min: DVec3, max: DVec3| bodies.iter().any(|body| body.intersects_aabb(min, max));
            let objects =
                objects.filter(|(_, object)| casts(object.min, object.max)).map(|(index, _)| index).collect();
            let layout = Layout::Frustum(map);
            let fitted = FittedMap::of(layout, &options, objects).expect("sound");
            let lights = vec![light.light];
            let fitted =
                FittedMaps::of(stage, Split::whole(), lights, vec![Some(fitted)], options.cut).expect("sound");
            let run = run_fitted(stage, &light, &options, fitted, Duration::ZERO).expect("drawn");
            assert!(light.truth.shadowed() > 100, "{} pixels in shadow", light.truth.shadowed());
            assert_eq!(run.verdict.counts.missing, 0, "{technique}");
        }
    }
}
