//! Spots as renderers have them, lights within planes, and convex scenes of many planes: what holds for every fit holds for them.

use proptest::prelude::*;
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use shadowfit::glam::{DQuat, DVec3, EulerRot};
use shadowfit::{
    Focus, FocusForm, Light, Outcome, Scene, Settings, View, Warp,
    focus::{ConvexBody, Plane},
    input::{ConvexScene, InputErrorKind},
    omni::CubeFace,
};
use testkit::arbitrary::{Case, case, run, settings, wide_door};
use testkit::claims::constructors::widen_by_any_bits;
use testkit::claims::results::exercise;
use testkit::claims::{rays, scaling, single_precision};

/// As many as a scene may keep, and more.
const MANY: usize = 30;

#[test]
fn rays_keep_their_place_and_gain_depth() {
    run(1500, &(wide_door(MANY), settings(), any::<u64>()), |(case, settings, seed)| {
        rays::keep_their_place(&case, &settings, seed);
        rays::end_in_the_map(&case, &settings, seed);
    });
}

#[test]
fn maps_hold_what_they_must() {
    run(1500, &(wide_door(MANY), settings(), any::<u64>()), |(case, settings, seed)| {
        single_precision::holds_what_it_must(&case, &settings, seed);
        single_precision::is_as_quiet_as_it_says(&case, &settings, seed);
    });
}

#[test]
fn scaling_by_a_power_of_two_changes_no_bit() {
    run(500, &(wide_door(MANY), settings(), -8..8), |(case, settings, exponent)| {
        scaling::changes_no_bit(&case, &settings, exponent);
    });
}

#[test]
fn no_result_is_nan() {
    run(1500, &(wide_door(60), settings()), |(case, settings): (Case, Settings)| {
        let (view, light) = case.build();
        let store = case.scene.store();
        exercise(&view, &light, &store.scene().expect("accepted"), &settings);
    });
}

/// Whatever bits come in, what comes out is an error or has no NaN.
#[test]
fn any_bits_give_results_or_an_error() {
    let bytes = prop::collection::vec(any::<u8>(), 0..700);
    run(6000, &(case(), settings(), bytes), |(case, settings, bytes): (Case, Settings, Vec<u8>)| {
        let (view, light) = case.build();
        widen_by_any_bits(&bytes, &view, &light, &settings);
    });
}

/// A view that sees all of what is near the origin, and a sun.
fn all_of(scene: &Scene<'_>) -> ConvexBody {
    let view = View::orthographic(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 1e3, 1.0, -1e3, 1e3).expect("sound");
    Focus::new(&view, &Light::directional((0.3, 1.0, 0.2)).expect("sound"), scene).receiver_volume()
}

fn turned(rng: &mut StdRng) -> DQuat {
    let mut angle = || rng.random_range(0.0..core::f64::consts::TAU);
    DQuat::from_euler(EulerRot::XYZ, angle(), angle(), angle())
}

/// Planes of a turned box about the origin, the bounds of it, and its corners.
fn turned_box(half: DVec3, turn: DQuat) -> (Vec<Plane>, DVec3, Vec<DVec3>) {
    let axes = DVec3::AXES.map(|axis| turn * axis);
    let planes = axes.iter().zip(half.to_array());
    let planes = planes.flat_map(|(axis, half)| [Plane::new(*axis, half), Plane::new(-*axis, half)]).collect();
    // A little more than what rounding takes off corners.
    let reach = axes.iter().zip(half.to_array()).map(|(axis, half)| axis.abs() * (half + 1e-13)).sum();
    let signs = (0..8).map(|corner| DVec3::from([0, 1, 2].map(|axis| f64::from((corner >> axis & 1) * 2 - 1))));
    (planes, reach, signs.map(|signs| turn * (signs * half)).collect())
}

/// Sides of a cone from a point along an axis.
fn cone(apex: DVec3, axis: DVec3, half_angle: f64, sides: usize) -> impl Iterator<Item = Plane> {
    let (u, v) = axis.any_orthonormal_pair();
    (0..sides).map(move |side| {
        let (sine, cosine) = (core::f64::consts::TAU * side as f64 / sides as f64).sin_cos();
        Plane::through(axis * half_angle.sin() - (u * cosine + v * sine) * half_angle.cos(), apex)
    })
}

/// They were refused: planes holds too many elements.
#[test]
fn turned_boxes_in_cones_of_many_planes() {
    let mut rng = StdRng::seed_from_u64(3);
    let mut cut = 0;
    for _ in 0..2000 {
        let half = DVec3::from([(); 3].map(|()| rng.random_range(0.5..5.0)));
        let (mut planes, reach, corners) = turned_box(half, turned(&mut rng));
        let apex = turned(&mut rng) * DVec3::Z * rng.random_range(3.0..20.0);
        let axis = -apex.normalize();
        let (angle, sides) = (rng.random_range(0.05..1.2), rng.random_range(3..=12));
        planes.extend(cone(apex, axis, angle, sides));
        let scene = ConvexScene::new(-reach, reach, &planes).expect("a turned box in a cone");
        let body = all_of(&Scene::from_convex(&scene));
        for plane in &planes {
            assert!(body.vertices().iter().all(|vertex| plane.at(*vertex) >= -1e-11), "a plane was left out");
        }
        for corner in corners {
            assert!(planes.iter().any(|plane| plane.at(corner) < -1e-12) || body.contains(corner));
        }
        cut += usize::from(!body.is_empty() && planes.len() > 12);
    }
    assert!(cut > 500, "{cut}");
}

/// Planes that bound nothing take no room; of too many that do, some are left out, and the body holds what it should.
#[test]
fn planes_that_bound_nothing_take_no_room() {
    let mut rng = StdRng::seed_from_u64(4);
    for _ in 0..300 {
        let half = DVec3::from([(); 3].map(|()| rng.random_range(0.5..5.0)));
        let (planes, reach, _) = turned_box(half, turned(&mut rng));
        let plain = ConvexScene::new(-reach, reach, &planes).expect("a box");
        // Far away planes first, then those of the box.
        let loose = (0..40).map(|_| Plane::new(turned(&mut rng) * DVec3::X, 30.0));
        let all: Vec<Plane> = loose.chain(planes).collect();
        let scene = ConvexScene::new(-reach, reach, &all).expect("many");
        let [one, other] = [&plain, &scene].map(|scene| all_of(&Scene::from_convex(scene)));
        assert_eq!(one.vertices(), other.vertices());

        // A ball of as many planes as can be, all of which bound it.
        let around: Vec<Plane> =
            (0..rng.random_range(19..80)).map(|_| Plane::new(turned(&mut rng) * DVec3::X, 1.0)).collect();
        let scene = ConvexScene::new(DVec3::splat(-1.0), DVec3::splat(1.0), &around).expect("many");
        let body = all_of(&Scene::from_convex(&scene));
        for plane in &around {
            assert!(body.contains(plane.normal * -0.999_999_999), "a point of the ball is lost");
        }
    }
}

/// A scene of as many cuts as can be leaves room for all planes of a spot and a view: none of V is left out.
#[test]
fn there_is_room_for_the_view_beside_many_cuts() {
    let mut rng = StdRng::seed_from_u64(5);
    for _ in 0..500 {
        let cuts: Vec<Plane> =
            (0..ConvexScene::MAX_CUTS).map(|_| Plane::new(turned(&mut rng) * DVec3::X, 10.0)).collect();
        let scene = ConvexScene::new(DVec3::splat(-12.0), DVec3::splat(12.0), &cuts).expect("many");
        let (eye, forward) =
            (turned(&mut rng) * DVec3::Z * rng.random_range(0.0..15.0), turned(&mut rng) * DVec3::X);
        let view = View::perspective(eye, forward, (0.1, 0.9, 0.3), 1.0, 1.5, 0.1, 15.0).expect("sound");
        let light = Light::spot((0.0, 14.0, 0.0), (0.0, -1.0, 0.0), 1.0, 0.1, 60.0).expect("sound");
        let body = Focus::new(&view, &light, &Scene::from_convex(&scene)).receiver_volume();
        assert!(body.vertices().iter().all(|vertex| view.planes().iter().all(|plane| plane.at(*vertex) >= -1e-9)));
    }
}

fn view() -> View {
    View::perspective((0.0, 3.0, 20.0), (0.0, -0.1, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.1, 100.0).expect("sound")
}

fn ground() -> Scene<'static> {
    Scene::from_box((-20.0, 0.0, -20.0), (20.0, 2.0, 10.0)).expect("sound")
}

/// A spot's pyramid is square and turned as it was; a pyramid's sides have the angles they should.
#[test]
fn spots_turn_about_their_axis() {
    let spot = Light::spot((0.0, 9.0, 0.0), (0.0, -1.0, 0.0), 0.5, 0.1, 30.0).expect("sound");
    let tangent = 0.5_f64.tan();
    for roll in [0.0, 0.3, 1.0, 2.5] {
        let up = DVec3::new(f64::sin(roll), 0.7, f64::cos(roll));
        let turned = spot.with_up(up).expect("across");
        let square = Light::pyramid((0.0, 9.0, 0.0), (0.0, -1.0, 0.0), up, [tangent; 2], 0.1, 30.0).expect("sound");
        for (a, b) in turned.planes().as_slice()[..4].iter().zip([2, 3, 0, 1].map(|side| square.planes()[side])) {
            let found = square.planes().as_slice()[..4].iter().any(|plane| {
                let (a, b) = (a.normalized(), plane.normalized());
                (a.normal - b.normal).length() < 1e-12 && (a.offset - b.offset).abs() < 1e-12
            });
            assert!(found, "{a:?} is no side of {b:?} or another");
        }
        // A map that keeps to the pyramid has its axes along the pyramid's sides.
        let settings = Settings::default().with_warp(Warp::Stable);
        for light in [turned, square] {
            let Outcome::Map(map) = Focus::new(&view(), &light, &ground()).fit(&settings) else { panic!("no map") };
            assert_eq!(map.fallback(), None);
            let across = map.clip_from_world().row(0).truncate().normalize();
            assert!(across.dot(DVec3::new(up.x, 0.0, up.z).normalize()).abs() < 1e-9, "{across} for {up}");
        }
    }
    let error = spot.with_up((0.0, 2.0, 0.0)).expect_err("along the axis");
    assert_eq!((error.field, error.problem), ("up", InputErrorKind::Parallel));
    let error = Light::directional(DVec3::Y).expect("sound").with_up(DVec3::X).expect_err("no spot");
    assert_eq!((error.field, error.problem), ("light", InputErrorKind::NotASpot));
}

#[test]
fn pyramids_have_the_sides_they_say() {
    let make = |tangents| Light::pyramid((1.0, 9.0, 2.0), (0.0, -3.0, 0.0), (0.0, 0.0, -5.0), tangents, 0.1, 30.0);
    let light = make([0.5, 0.25]).expect("sound");
    let reaches = |x: f64, z: f64| {
        let point = DVec3::new(1.0 + x * 4.0, 5.0, 2.0 + z * 4.0);
        light.planes().iter().all(|plane| plane.at(point) >= 0.0)
    };
    for (x, z, is_lit) in
        [(0.49, 0.0, true), (-0.51, 0.0, false), (0.0, 0.24, true), (0.0, -0.26, false), (0.49, 0.24, true)]
    {
        assert_eq!(reaches(x, z), is_lit, "{x}, {z}");
    }
    for (tangents, problem) in [
        ([0.0, 1.0], InputErrorKind::TooSmall),
        ([1.0, 257.0], InputErrorKind::TooLarge),
        ([f64::NAN, 1.0], InputErrorKind::NotFinite),
    ] {
        let error = make(tangents).expect_err("no angle");
        assert_eq!((error.field, error.problem), ("tangents", problem));
    }
}

/// Planes bound what is lit, and what casts; faces of a cube inherit them.
#[test]
fn lights_within_planes() {
    let wall = Plane::new(DVec3::NEG_X, 3.0);
    for light in [
        Light::directional((0.3, 1.0, 0.2)),
        Light::point((0.0, 9.0, 0.0), 0.1, 60.0),
        Light::spot((0.0, 9.0, 0.0), (0.0, -1.0, 0.0), 1.0, 0.1, 60.0),
        Light::hemisphere((0.0, 9.0, 0.0), (0.0, -1.0, 0.0), 0.1, 60.0),
    ] {
        let light = light.expect("sound");
        let within = light.within(&[wall]).expect("a wall");
        assert_eq!(within.planes().len(), light.planes().len() + 1);
        let (free, bounded) = (Focus::new(&view(), &light, &ground()), Focus::new(&view(), &within, &ground()));
        for body in [
            bounded.receiver_volume(),
            bounded.caster_volume(FocusForm::ReceiverHull),
            bounded.caster_volume(FocusForm::ViewHull),
        ] {
            let (_, max) = body.bounds().expect("something is lit");
            assert!((max.x - 3.0).abs() < 1e-9);
        }
        assert!(free.receiver_volume().bounds().expect("something is lit").1.x > 3.1);
        assert_eq!(within.within(&[]).expect("none"), light);
        let error = light.within(&[wall; Light::MAX_WITHIN + 1]).expect_err("too many");
        assert_eq!((error.field, error.problem), ("planes", InputErrorKind::TooMany));
        let error = light.within(&[wall, Plane::new(DVec3::ZERO, 1.0)]).expect_err("no direction");
        assert_eq!((error.index, error.problem), (Some(1), InputErrorKind::NoDirection));
    }
    let point = Light::point((0.0, 9.0, 0.0), 0.1, 60.0).expect("sound").within(&[wall]).expect("a wall");
    let face = point.cube_face(CubeFace::NegativeY, 0.0).expect("all around");
    assert_eq!(face.planes().iter().last(), point.planes().iter().last());
}
