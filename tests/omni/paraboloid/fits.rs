//! Which hemispheres a light gets, and what is in them.

use glam::DVec3;
use proptest::prelude::*;
use shadowfit::{
    Empty, Focus, Light, Settings, View,
    focus::ConvexBody,
    input::InputErrorKind,
    omni::{Paraboloid, Paraboloids},
};
use std::cell::Cell;

use super::{lamp, room, view};
use testkit::arbitrary::{case, run, settings};
use testkit::claims::paraboloid::{carries_no_farther_than_it_says, holds_what_it_must};

#[test]
fn f32_carries_points_no_farther_than_the_map_says() {
    run(3000, &(case(), settings(), any::<u64>()), |(case, settings, seed)| {
        carries_no_farther_than_it_says(&case, &settings, seed);
    });
}

#[test]
fn hemispheres_hold_what_they_must() {
    let (one, two) = (Cell::new(0), Cell::new(0));
    run(5000, &(case(), settings(), any::<u64>(), any::<bool>()), |(case, settings, seed, among)| {
        match holds_what_it_must(&case, &settings, seed, among) {
            1 => one.set(one.get() + 1),
            2 => two.set(two.get() + 1),
            _ => {}
        }
    });
    assert!(one.get() > 100 && two.get() > 100, "{one:?} {two:?}");
}

/// Of settings that are not square a paraboloid map has the shorter side, either way.
#[test]
fn maps_are_square() {
    let (view, room) = (view(), room());
    let lamp = lamp([0.0, 0.0, 0.0]);
    let focus = Focus::new(&view, &lamp, &room);
    let square = Settings::new(512, 1080).and_then(|settings| settings.with_border(7)).expect("legal sizes");
    for (width, height) in [(512, 2048), (3000, 512)] {
        let settings = square.with_map_sides(width, height).expect("legal sizes");
        assert_eq!(focus.paraboloids(&settings), focus.paraboloids(&square));
    }
}

#[test]
fn which_hemispheres() {
    let settings = Settings::default();
    let fit = |light: &Light| Focus::new(&view(), light, &room()).paraboloids(&settings);
    let axis_of = |light: &Light| match fit(light) {
        Paraboloids::One(map) => map.axis(),
        other => panic!("{other:?}"),
    };
    // A hemisphere and a spot have axes of their own.
    let axis = DVec3::new(0.0, -0.8, -0.6);
    assert_eq!(axis_of(&Light::hemisphere(DVec3::ZERO, axis, 0.1, 30.0).expect("sound")), axis);
    assert_eq!(axis_of(&Light::spot(DVec3::ZERO, axis, 0.7, 0.1, 30.0).expect("sound")), axis);
    // A lamp on the ceiling, and almost; one on the floor; one on a wall.
    assert_eq!(axis_of(&lamp([0.0, 3.0, 0.0])), DVec3::NEG_Y);
    assert_eq!(axis_of(&lamp([0.0, 3.0_f64.next_down(), 0.0])), DVec3::NEG_Y);
    assert_eq!(axis_of(&lamp([0.0, -3.0, 0.0])), DVec3::Y);
    assert_eq!(axis_of(&lamp([5.0, 0.0, -4.0])), DVec3::NEG_X);
    // A lamp behind the viewer, to one side of what is visible.
    assert!(axis_of(&lamp([0.0, 0.0, 9.8])).z < 0.0);
    assert!(matches!(fit(&lamp([0.0, 0.0, 0.0])), Paraboloids::Two(_)));
    assert_eq!(fit(&Light::directional(DVec3::Y).expect("sound")), Paraboloids::Directional);
    let far_away = Light::point((900.0, 0.0, 0.0), 0.1, 5.0).expect("sound");
    assert_eq!(fit(&far_away), Paraboloids::Empty(Empty::NoReceivers));
    let dark = Light::point((0.0, 0.0, 0.0), 900.0, 1000.0).expect("sound");
    assert_eq!(fit(&dark), Paraboloids::Empty(Empty::NoCasters));
}

#[test]
fn the_camera_moves_no_texel() {
    let (light, settings) = (lamp([0.0, 0.0, 0.0]), Settings::default());
    let maps = [0.0, 0.1, 0.3].map(|turn: f64| {
        let forward = DVec3::new(turn.sin(), 0.1, -turn.cos());
        let view = View::perspective((0.5, 1.0, 8.0), forward, DVec3::Y, 1.2, 1.5, 0.1, 50.0).expect("sound");
        match Focus::new(&view, &light, &room()).paraboloids(&settings) {
            Paraboloids::Two([map, _]) => map,
            other => panic!("{other:?}"),
        }
    });
    let point = DVec3::new(1.0, -2.0, 3.0);
    let places = maps.map(|map| map.project(point).map(DVec3::truncate));
    assert!(places.iter().all(|place| *place == places[0] && place.is_some()));
}

#[test]
fn errors_name_the_axis() {
    let (light, settings) = (lamp([0.0; 3]), Settings::default());
    let (view, scene) = (view(), room());
    let focus = Focus::new(&view, &light, &scene);
    for (axis, problem) in [(DVec3::ZERO, InputErrorKind::NoDirection), (DVec3::NAN, InputErrorKind::NotFinite)] {
        let error = focus.paraboloids_about(axis, &settings).expect_err("no axis");
        assert_eq!((error.field, error.problem), ("axis", problem));
    }
    let fitted = focus.paraboloids_about(DVec3::Z * 3.0, &settings).expect("sound");
    assert_eq!(fitted.maps().iter().map(Paraboloid::axis).collect::<Vec<_>>(), [DVec3::Z, DVec3::NEG_Z]);
    assert_eq!(focus.paraboloids(&settings), focus.paraboloids_about(DVec3::NEG_Y, &settings).expect("sound"));
}

#[test]
fn a_fit_allocates_nothing() {
    let (view, scene) = (view(), room());
    for light in [lamp([0.0; 3]), lamp([0.0, 3.0, 0.0])] {
        let focus = Focus::new(&view, &light, &scene);
        let visible: ConvexBody = focus.receiver_volume();
        let work = || {
            for map in focus.paraboloids(&Settings::default()).maps() {
                std::hint::black_box((map.caster_matrix(), map.clip_scale(), map.largest_edge(0.5)));
                for &point in visible.vertices() {
                    std::hint::black_box((map.footprint(point), map.rounding(point)));
                }
            }
        };
        assert_eq!(allocation_counter::measure(work).count_total, 0);
    }
}
