//! One map for several views.

use glam::{DQuat, DVec3};
use proptest::prelude::*;
use shadowfit::{
    ClipSpace, Focus, Light, Origin, Outcome, Scene, Settings, View, Warp,
    input::{InputErrorKind, Tangents},
    multiview::SharedFocus,
};
use std::cell::Cell;
use testkit::arbitrary::{case, points_of, run, settings};
use testkit::claims::shared::{Tried, lose_nothing};

/// The two eyes of a headset, 64 mm apart, canted outwards by so many radians, with so much to see on the inner side.
fn eyes(middle: DVec3, turn: DQuat, cant: f64, inner: f64) -> [View; 2] {
    [-1.0, 1.0].map(|side| {
        let turn = turn * DQuat::from_rotation_y(-side * cant);
        let (left, right) = if side < 0.0 { (-1.2, inner) } else { (-inner, 1.2) };
        let tangents = Tangents { left, right, bottom: -1.1, top: 1.0 };
        let eye = middle + turn * (DVec3::X * (0.032 * side));
        View::from_tangents(eye, turn * DVec3::NEG_Z, turn * DVec3::Y, tangents, 0.1, 100.0).expect("a camera")
    })
}

fn outdoors() -> (Light, Scene<'static>) {
    let light = Light::directional((0.4, 1.0, 0.2)).expect("sound");
    (light, Scene::from_box((-200.0, 0.0, -200.0), (200.0, 20.0, 200.0)).expect("sound"))
}

/// The right eye in the left one's map has points outside of it; in the shared one neither has. Eyes side by side cost what one
/// of them does, canted ones as much more as both see more than either.
#[test]
fn two_eyes_share_a_map() {
    let (light, scene) = outdoors();
    for (cant, inner, most) in [(0.0, 1.2, [1.02, 1.5]), (0.09, 0.9, [1.5, 1.8])] {
        let views = eyes(DVec3::new(0.0, 1.7, 0.0), DQuat::from_rotation_x(-0.1), cant, inner);
        let shared = SharedFocus::new(&views, &light, &scene).expect("two views");
        let settings = Settings::default();
        let outside = |outcome: Outcome| {
            let map = outcome.into_map().expect("one map does");
            let place = move |point: DVec3| map.clip_from_world_in(ClipSpace::WGPU).project_point3(point);
            let points = shared.iter().flat_map(|part| points_of(&part.receiver_volume(), 7));
            points.filter(|&point| place(point).truncate().abs().max_element() > 1.0).count()
        };
        let uniform = settings.with_warp(Warp::Uniform);
        assert!(cant == 0.0 || outside(shared[0].fit(&uniform)) > 0);
        assert_eq!([settings, uniform].map(|settings| outside(shared.fit(&settings))), [0, 0]);
        for (warp, most) in [Warp::Uniform, Warp::default()].into_iter().zip(most) {
            let sharing = shared.sharing(&settings.with_warp(warp));
            let of_one = 2.0 * sharing.shared / sharing.separate;
            println!("two eyes, canted by {cant}, {warp:?}: a shared map costs {of_one:.3} of one eye's");
            assert!(sharing.is_worth_it() && of_one < most, "{of_one}");
        }
    }
}

/// Two views 20 m and 90° apart share next to nothing: one map for both costs what two do, and more.
#[test]
fn views_far_apart_do_not_share() {
    let (light, scene) = outdoors();
    let view = |eye: DVec3, forward: DVec3| {
        View::perspective(eye, forward, DVec3::Y, 1.0, 1.6, 0.1, 40.0).expect("a camera")
    };
    let views = [
        view(DVec3::new(0.0, 1.7, 0.0), DVec3::new(0.0, -0.1, -1.0)),
        view(DVec3::new(20.0, 1.7, 0.0), DVec3::new(1.0, -0.1, 0.0)),
    ];
    let shared = SharedFocus::new(&views, &light, &scene).expect("two views");
    for warp in [Warp::Uniform, Warp::default()] {
        let sharing = shared.sharing(&Settings::default().with_warp(warp));
        println!("far apart, {warp:?}: a shared map costs {:.2} of two", sharing.shared / sharing.separate);
        assert!(!sharing.is_worth_it(), "{sharing:?}");
    }
}

/// Whatever the views are, all that any of them sees, and what casts on it, is in the map.
#[test]
fn nothing_that_any_view_sees_is_lost() {
    let all = Cell::new(Tried::default());
    run(3000, &(case(), settings(), any::<u64>()), |(case, settings, seed)| {
        let (one, sum) = (lose_nothing(&case, &settings, seed), all.get());
        let (seen, casting) = (sum.seen + one.seen, sum.casting + one.casting);
        all.set(Tried { maps: sum.maps + one.maps, seen, casting });
    });
    let Tried { maps, seen, casting } = all.get();
    println!("{maps} maps, {seen} points seen and {casting} that cast");
    assert!(maps > 500 && seen > 5000 && casting > 1000, "{maps} maps, {seen} points, {casting} that cast");
}

/// One view alone is fitted as it is without the others, to the bit.
#[test]
fn one_view_shares_with_itself() {
    run(500, &(case(), settings()), |(case, settings)| {
        let (view, light) = case.build();
        let store = case.scene.store();
        let scene = store.scene().expect("the scene is accepted");
        let shared = SharedFocus::new(&[view], &light, &scene).expect("one view");
        assert_eq!(shared.fit(&settings), Focus::new(&view, &light, &scene).fit(&settings));
    });
}

/// A stable map of two eyes keeps its grid while the head moves and turns, and has room for both.
#[test]
fn a_stable_map_of_two_eyes_keeps_its_grid() {
    let (light, scene) = outdoors();
    let settings = Settings::default().with_warp(Warp::Stable).with_origin(Origin::World);
    let sides = |at: f64| {
        let turn = DQuat::from_rotation_y(0.7 * at) * DQuat::from_rotation_x(-0.2);
        let views = eyes(DVec3::new(1.3 * at, 1.7, -at), turn, 0.09, 0.9);
        let shared = SharedFocus::new(&views, &light, &scene).expect("two views");
        let map = shared.fit(&settings).into_map().expect("one map does");
        assert_eq!(map.fallback(), None);
        for part in shared.iter() {
            for &point in part.receiver_volume().vertices() {
                let place = map.clip_from_world_in(ClipSpace::WGPU).project_point3(point);
                assert!(place.truncate().abs().max_element() <= 1.0, "{place}");
            }
        }
        (map.window().width, map.window().height)
    };
    let first = sides(0.0);
    assert!((1..40).all(|at| sides(f64::from(at) * 0.37) == first));
}

/// No view, and more than there is room for.
#[test]
fn numbers_of_views() {
    let (light, scene) = outdoors();
    let [view, _] = eyes(DVec3::Y, DQuat::IDENTITY, 0.0, 1.2);
    let refused = |views: &[View]| {
        SharedFocus::new(views, &light, &scene).map(|_| ()).map_err(|error| (error.field, error.problem))
    };
    assert_eq!(refused(&[]), Err(("views", InputErrorKind::Empty)));
    assert_eq!(refused(&[view; SharedFocus::MAX]), Ok(()));
    assert_eq!(refused(&[view; SharedFocus::MAX + 1]), Err(("views", InputErrorKind::TooMany)));
}
