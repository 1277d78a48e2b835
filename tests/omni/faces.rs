//! The faces of a cube around a light: what each lights, and that their maps together serve a light among what it lights.

use glam::DVec3;
use proptest::prelude::*;
use shadowfit::{
    Empty, Focus, FocusForm, Light, Outcome, Scene, Settings, ShadowMap, View, Warp, omni::CubeFace, warp::Shift,
};
use testkit::arbitrary::{Numbers, points_of, run};

/// A direction as long as it may be, evenly over a cube.
fn arm() -> impl Strategy<Value = DVec3> {
    prop::array::uniform3(-1.0..1.0).prop_map(DVec3::from)
}

/// Whether a direction from the light is within the pyramid around a face whose sides stand at a tangent to its axis:
/// no other component is larger than that many times the one along the axis.
fn is_within(face: CubeFace, tangent: f64, from_light: DVec3) -> bool {
    let along = face.axis().dot(from_light);
    let across = from_light - face.axis() * along;
    along > 0.0 && across.abs().max_element() <= tangent * along
}

/// Whether a point is in L, as its planes have it, and how near it is to one of them for the distance from the light.
fn is_lit(light: &Light, point: DVec3, from_light: DVec3) -> (bool, f64) {
    let values =
        light.planes().iter().map(|plane| plane.at(point) / plane.normal.length()).fold(f64::MAX, f64::min);
    (values >= 0.0, values.abs() / from_light.length())
}

#[test]
fn layers_are_in_the_order_of_a_cube_map() {
    let axes = [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z];
    assert_eq!(CubeFace::ALL.map(CubeFace::axis), axes);
    for (layer, face) in CubeFace::ALL.into_iter().enumerate() {
        assert_eq!(face as usize, layer);
        assert_eq!(CubeFace::of(face.axis() * 1e-300), face);
    }
    // Seams belong to the first of the faces.
    assert_eq!(CubeFace::of(DVec3::new(-1.0, 1.0, 1.0)), CubeFace::NegativeX);
    assert_eq!(CubeFace::of(DVec3::new(0.5, -1.0, -1.0)), CubeFace::NegativeY);
}

#[test]
fn a_direction_goes_through_its_face_and_is_lit_by_it_alone_but_for_the_overlap() {
    let position = DVec3::new(2.0, -1.0, 0.5);
    let overlap = prop_oneof![Just(0.0), 0.0..1.0];
    run(3000, &(arm(), overlap, arm()), |(arm, overlap, axis)| {
        // Directions so short that the near plane cuts them off say nothing about sides.
        if arm.length() < 0.01 {
            return;
        }
        for (light, axis) in
            [(Light::point(position, 1e-3, 9.0), None), (Light::hemisphere(position, axis, 1e-3, 9.0), Some(axis))]
        {
            let Ok(light) = light else { continue };
            for face in CubeFace::ALL {
                let of_face = light.cube_face(face, overlap).unwrap();
                assert!(of_face.planes().len() <= 7 && of_face.position() == Some(position));
                let expected = is_within(face, 1.0 + overlap, arm) && axis.is_none_or(|axis| axis.dot(arm) >= 0.0);
                let (lit, doubt) = is_lit(&of_face, position + arm, arm);
                // Points within rounding of a side may be on either.
                assert!(lit == expected || doubt < 1e-12, "{arm} in {face:?}, overlap {overlap}");
                // Whatever the overlap, its own face lights all that has its name.
                assert!(CubeFace::of(arm) != face || is_within(face, 1.0, arm), "{arm}");
            }
        }
    });
}

#[test]
fn a_face_reaches_from_near_to_range() {
    let light = Light::point(DVec3::ZERO, 0.5, 8.0).unwrap();
    run(3000, &(arm(), 0.0..1.0), |(arm, overlap)| {
        let Some(direction) = arm.try_normalize() else { return };
        let face = light.cube_face(CubeFace::of(direction), overlap).unwrap();
        let lit = |distance: f64| is_lit(&face, direction * distance, direction).0;
        // From the near distance on, wherever in the face, to the range along its axis.
        assert!(lit(0.5 * (1.0 + 1e-12)) && lit(8.0 * (1.0 - 1e-12)));
        assert!(!lit(8.0 * 3_f64.sqrt() + 1e-9));
    });
}

/// A room from −3 to 3 with the camera in one corner and a lamp anywhere.
#[derive(Clone, Copy, Debug)]
struct Room {
    eye: DVec3,
    forward: DVec3,
    lamp: DVec3,
    range: f64,
}

const LAMP_NEAR: f64 = 0.01;

impl Room {
    fn strategy() -> impl Strategy<Value = Self> {
        let inside = || arm().prop_map(|part| part * 2.9);
        let range = prop_oneof![Just(f64::INFINITY), 1.0..5.0];
        (inside(), arm(), inside(), range)
            .prop_map(|(eye, forward, lamp, range)| Self { eye, forward, lamp, range })
            .prop_filter("looks along its up axis", |room| room.view().is_some())
    }

    fn view(&self) -> Option<View> {
        View::perspective(self.eye, self.forward, DVec3::Y, 1.0, 1.5, 0.05, f64::INFINITY).ok()
    }

    fn lamp(&self) -> Light {
        Light::point(self.lamp, LAMP_NEAR, self.range).unwrap()
    }
}

fn scene() -> Scene<'static> {
    Scene::from_box(DVec3::splat(-3.0), DVec3::splat(3.0)).unwrap()
}

fn settings(warp: Warp) -> Settings {
    Settings::new(512, 600)
        .unwrap()
        .with_border(1)
        .unwrap()
        .with_warp(warp)
        .with_shift(Shift::Back(FocusForm::ViewHull))
}

/// The map of each face.
fn fit_faces(view: &View, light: &Light, overlap: f64, settings: &Settings) -> [Outcome; 6] {
    CubeFace::ALL.map(|face| Focus::new(view, &light.cube_face(face, overlap).unwrap(), &scene()).fit(settings))
}

/// How far outside of the clip volume a point is, in clip units; not above 0 inside.
fn outside(map: &ShadowMap, point: DVec3) -> f64 {
    let clip = map.clip_from_world() * point.extend(1.0);
    let [x, y, z] = (clip.truncate() / clip.w).to_array();
    if clip.w > 0.0 { (x.abs() - 1.0).max(y.abs() - 1.0).max(-z).max(z - 1.0) } else { f64::INFINITY }
}

#[test]
fn six_maps_serve_a_lamp_in_a_room() {
    run(600, &(Room::strategy(), 0.0..0.2, any::<u64>(), any::<bool>()), |(room, overlap, seed, warped)| {
        let (Some(view), lamp) = (room.view(), room.lamp()) else { return };
        let warp = if warped { Warp::Perspective } else { Warp::Uniform };
        let outcomes = fit_faces(&view, &lamp, overlap, &settings(warp));
        // What the whole lamp lights of what is visible: each point is in the map that its direction names.
        for point in points_of(&Focus::new(&view, &lamp, &scene()).receiver_volume(), seed) {
            let from_lamp = point - room.lamp;
            // Corners of L's box lie beyond the range, and so do they for a face along another axis.
            if from_lamp.length() < LAMP_NEAR || from_lamp.length() > room.range {
                continue;
            }
            let face = CubeFace::of(from_lamp);
            match &outcomes[face as usize] {
                // The vertices of R are a few roundings off.
                Outcome::Map(map) => {
                    assert!(outside(map, point) < 1e-9, "{point} in {face:?}: {}", outside(map, point))
                }
                other => panic!("{other:?} for {point} in {face:?}"),
            }
        }
        for (face, outcome) in CubeFace::ALL.into_iter().zip(&outcomes) {
            let focus_light = lamp.cube_face(face, overlap).unwrap();
            let visible = Focus::new(&view, &focus_light, &scene()).receiver_volume();
            assert!(!matches!(outcome, Outcome::Surrounded(_)), "{face:?}");
            // A face has a map exactly if something in it is visible.
            assert_eq!(visible.is_empty(), *outcome == Outcome::Empty(Empty::NoReceivers), "{face:?}");
        }
    });
}

#[test]
fn one_map_would_not_serve_it() {
    let (eye, forward) = (DVec3::new(0.0, 0.0, 2.9), DVec3::NEG_Z);
    let room = Room { eye, forward, lamp: DVec3::new(0.0, 0.0, -1.0), range: f64::INFINITY };
    let view = room.view().unwrap();
    let whole = Focus::new(&view, &room.lamp(), &scene()).fit(&settings(Warp::Uniform));
    assert!(matches!(whole, Outcome::Surrounded(_)), "{whole:?}");
    let faces = fit_faces(&view, &room.lamp(), 0.0, &settings(Warp::Uniform));
    assert!(faces.iter().all(|outcome| outcome.map().is_some()), "{faces:?}");
}

#[test]
fn faces_that_see_nothing_of_the_view_need_no_map() {
    // The lamp hangs behind the camera, which looks away from it.
    let (eye, forward) = (DVec3::ZERO, DVec3::NEG_Z);
    let room = Room { eye, forward, lamp: DVec3::new(0.0, 0.0, 2.0), range: f64::INFINITY };
    let outcomes = fit_faces(&room.view().unwrap(), &room.lamp(), 0.0, &settings(Warp::Uniform));
    for (face, outcome) in CubeFace::ALL.into_iter().zip(&outcomes) {
        match face {
            CubeFace::NegativeZ => assert!(outcome.map().is_some(), "{face:?}: {outcome:?}"),
            _ => assert_eq!(*outcome, Outcome::Empty(Empty::NoReceivers), "{face:?}"),
        }
    }
}

/// Rays through texels that a filter reads, at points of a face itself, stay within the face as it is widened.
#[test]
fn the_overlap_covers_what_a_filter_reads() {
    let reach = prop_oneof![Just(0.5), Just(1.0), Just(2.5), 0.5..8.0];
    let size = prop::sample::select(vec![128_u32, 512, 2048]);
    run(300, &(Room::strategy(), reach, size, any::<u64>()), |(room, reach, size, seed)| {
        let (Some(view), lamp) = (room.view(), room.lamp()) else { return };
        let border = f64::ceil(reach) as u32;
        let settings = Settings::new(size, 600).unwrap().with_border(border).unwrap().with_warp(Warp::Uniform);
        let overlap = CubeFace::overlap(reach, size, border);
        let mut numbers = Numbers(seed);
        for (face, outcome) in CubeFace::ALL.into_iter().zip(fit_faces(&view, &lamp, overlap, &settings)) {
            let Some(map) = outcome.map() else { continue };
            let matrix = map.clip_from_world();
            let unproject = matrix.inverse();
            let light = lamp.cube_face(face, 0.0).unwrap();
            for point in points_of(&Focus::new(&view, &light, &scene()).receiver_volume(), seed) {
                let clip = matrix * point.extend(1.0);
                let place = clip.truncate() / clip.w;
                let step = 2.0 * reach / f64::from(size);
                let aside = DVec3::new(numbers.part() - 0.5, numbers.part() - 0.5, 0.0).signum() * step;
                let read = unproject * (place + aside * DVec3::new(1.0, 1.0, 0.0)).extend(1.0);
                let from_lamp = read.truncate() / read.w - room.lamp;
                assert!(is_within(face, 1.0 + overlap, from_lamp), "{from_lamp} of {face:?}, overlap {overlap}");
            }
        }
    });
}

#[test]
fn overlaps_are_small_and_never_more_than_may_be() {
    assert_eq!(CubeFace::overlap(0.0, 512, 1), 0.0);
    let nearest = CubeFace::overlap(0.5, 512, 1);
    assert!((nearest - 0.01).abs() < 1e-3, "{nearest}");
    for (reach, size, border) in [(8.0, 16, 0), (0.5, 4, 1), (1.0, 4, 9), (f64::INFINITY, 512, 1), (1e300, 4, 0)] {
        assert_eq!(CubeFace::overlap(reach, size, border), CubeFace::MAX_OVERLAP, "{reach} {size}");
    }
    for reach in [f64::NAN, -1.0] {
        assert_eq!(CubeFace::overlap(reach, 512, 1), 0.0);
    }
}
