//! Casters of a fit in one call, and views narrowed to what there is to be seen.

use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use shadowfit::glam::DVec3;
use shadowfit::{
    Aabb, Focus, FocusForm, Light, Scene, View,
    focus::Plane,
    input::{ConvexScene, DAabb},
};

fn boxes(rng: &mut StdRng, count: usize) -> Vec<DAabb> {
    (0..count)
        .map(|_| {
            let mut number = |reach: f64| rng.random_range(-reach..reach);
            let (at, half) = (
                DVec3::new(number(40.0), number(5.0), number(60.0)),
                DVec3::new(number(3.0), number(3.0), number(3.0)),
            );
            DAabb::new(at - half.abs(), at + half.abs())
        })
        .collect()
}

fn view(rng: &mut StdRng) -> View {
    let mut number = |reach: f64| rng.random_range(-reach..reach);
    let eye = DVec3::new(number(30.0), number(8.0), number(30.0));
    let forward = DVec3::new(number(1.0), number(0.3), number(1.0));
    let far = if number(1.0) > 0.0 { 50.0 } else { f64::INFINITY };
    View::perspective(eye, forward, DVec3::Y, 0.9 + number(0.5), 1.6, 0.1, far).expect("sound")
}

/// The casters are those that the body meets one by one, in any precision and about any origin, and no others.
#[test]
fn casters_are_those_that_meet_the_body() {
    let mut rng = StdRng::seed_from_u64(1);
    let mut drawn = 0;
    for case in 0..200 {
        let (casters, receivers) = (boxes(&mut rng, 60), boxes(&mut rng, 20));
        let light = match case % 2 {
            0 => Light::directional((0.3, 1.0, 0.2)),
            _ => Light::point((0.0, 20.0, 0.0), 0.1, 70.0),
        };
        let (view, light) = (view(&mut rng), light.expect("sound"));
        let scene = Scene::new(&casters, &receivers).expect("sound");
        let focus = Focus::new(&view, &light, &scene);
        let body = focus.caster_volume(FocusForm::ReceiverHull);
        let by_one = (0..60).filter(|&index| body.intersects_aabb(casters[index].min, casters[index].max));
        let found: Vec<usize> = focus.casters().collect();
        assert!(found.iter().copied().eq(by_one));
        drawn += found.len();

        // Of rounded ones there may be more, and none is left out that the exact ones have.
        let rounded: Vec<Aabb> = casters.iter().map(|one| Aabb::from(*one)).collect();
        let about: Vec<DAabb> = casters.iter().map(|one| DAabb::new(one.min - 7.25, one.max - 7.25)).collect();
        let around: Vec<Aabb> = receivers.iter().map(|one| Aabb::from(*one)).collect();
        let moved: Vec<DAabb> = receivers.iter().map(|one| DAabb::new(one.min - 7.25, one.max - 7.25)).collect();
        let scenes = [Scene::new(&rounded, &around), Scene::relative_to(DVec3::splat(7.25), &about, &moved)];
        for scene in scenes {
            let again: Vec<usize> = Focus::new(&view, &light, &scene.expect("sound")).casters().collect();
            assert!(found.iter().all(|index| again.contains(index)) && again.len() <= found.len() + 1);
        }
    }
    assert!(drawn > 1000, "{drawn}");
}

/// What is in the view and in a receiver is in the narrowed view; and both ends of it touch a receiver.
#[test]
fn narrowed_views_hold_the_receivers() {
    let mut rng = StdRng::seed_from_u64(2);
    let mut narrowed = 0;
    for _ in 0..500 {
        let (receivers, view) = (boxes(&mut rng, 5), view(&mut rng));
        let scene = Scene::new(&[], &receivers).expect("sound");
        let Some(inner) = view.narrowed_to(&scene) else {
            let light = Light::directional(DVec3::Y).expect("sound");
            assert!(Focus::new(&view, &light, &scene).receiver_volume().is_empty());
            continue;
        };
        narrowed += 1;
        assert!(inner.near() >= view.near() && inner.far() <= view.far());
        let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
        for one in &receivers {
            let alone = Scene::from_box(one.min, one.max).expect("sound");
            let light = Light::directional(DVec3::Y).expect("sound");
            for point in Focus::new(&view, &light, &alone).receiver_volume().vertices() {
                (least, most) = (least.min(view.depth(*point)), most.max(view.depth(*point)));
            }
        }
        assert!((inner.near() - least.max(view.near())).abs() < 1e-9, "{} for {least}", inner.near());
        assert!((inner.far() - most.min(view.far())).abs() < 1e-9, "{} for {most}", inner.far());
    }
    assert!(narrowed > 200);
}

#[test]
fn views_are_narrowed_to_any_scene() {
    let view =
        View::perspective((0.0, 0.0, 9.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0), 1.0, 1.0, 0.1, 50.0).expect("sound");
    let body = ConvexScene::new([-1.0; 3], [1.0; 3], &[Plane::new(DVec3::Z, 0.5)]).expect("sound");
    for (scene, near, far) in [
        (Scene::from_box([-1.0; 3], [1.0; 3]), 8.0, 10.0),
        (Ok(Scene::from_convex(&body)), 8.0, 9.5),
        (Scene::from_box([-100.0; 3], [100.0; 3]), 0.1, 50.0),
    ] {
        let inner = view.narrowed_to(&scene.expect("sound")).expect("in view");
        assert!((inner.near() - near).abs() < 1e-9 && (inner.far() - far).abs() < 1e-9, "{near}, {far}: {inner:?}");
    }
    // A sheet across the view has no depth of its own.
    let sheet = Scene::from_box([-1.0, -1.0, 0.0], [1.0, 1.0, 0.0]).expect("flat");
    let inner = view.narrowed_to(&sheet).expect("in view");
    assert!(inner.near() <= 9.0 && inner.far() >= 9.0);
    assert_eq!(view.narrowed_to(&Scene::from_box(Aabb::EMPTY.min, Aabb::EMPTY.max).expect("empty")), None);
}
