//! Scenes with nothing in them: an answer with its reason, never an error that ends a frame.

use shadowfit::glam::DVec3;
use shadowfit::{
    Aabb, Empty, Focus, FocusForm, Light, Outcome, Scene, Settings, View, fit,
    focus::Plane,
    input::{ConvexScene, DAabb, Hint},
};

fn view() -> View {
    View::perspective((0.0, 2.0, 9.0), (0.0, -0.2, -1.0), (0.0, 1.0, 0.0), 1.0, 1.5, 0.1, 60.0).expect("sound")
}

fn lights() -> [Light; 3] {
    let position = (0.0, 6.0, 0.0);
    [
        Light::directional((0.3, 1.0, 0.2)),
        Light::point(position, 0.1, 40.0),
        Light::spot(position, (0.0, -1.0, 0.0), 0.9, 0.1, 40.0),
    ]
    .map(|light| light.expect("sound"))
}

#[track_caller]
fn assert_empty(scene: &Scene<'_>, why: Empty) {
    for light in lights() {
        let focus = Focus::new(&view(), &light, scene);
        assert_eq!(focus.fit(&Settings::default()), Outcome::Empty(why), "{light:?}");
        assert_eq!(focus.receiver_volume().is_empty(), why == Empty::NoReceivers);
        assert!(
            focus.caster_volume(FocusForm::ReceiverHull).is_empty()
                && focus.caster_volume(FocusForm::ViewHull).is_empty()
        );
    }
}

/// They were errors: casters is empty, receivers is empty.
#[test]
fn lists_without_a_box() {
    let one = [Aabb::new([-5.0, 0.0, -5.0], [5.0, 1.0, 5.0])];
    assert_empty(&Scene::new::<Aabb>(&[], &[]).expect("empty"), Empty::NoReceivers);
    assert_empty(&Scene::new(&one, &[]).expect("no receivers"), Empty::NoReceivers);
    assert_empty(&Scene::new(&[], &one).expect("no casters"), Empty::NoCasters);
    assert_empty(&Scene::new::<DAabb>(&[], &[]).expect("empty"), Empty::NoReceivers);
}

/// As engines mark a box around nothing: by infinities or by the largest numbers.
#[test]
fn boxes_around_nothing() {
    let one = Aabb::new([-5.0, 0.0, -5.0], [5.0, 1.0, 5.0]);
    for nothing in [Aabb::EMPTY, Aabb::new([f32::MAX; 3], [f32::MIN; 3])] {
        assert_empty(&Scene::from_box(nothing.min, nothing.max).expect("empty"), Empty::NoReceivers);
        assert_empty(&Scene::new(&[nothing], &[nothing, nothing]).expect("empty"), Empty::NoReceivers);
        assert_empty(&Scene::new(&[nothing], &[nothing, one]).expect("no casters"), Empty::NoCasters);
        assert!(ConvexScene::new(nothing.min, nothing.max, &[]).is_ok());
        // Among others they are passed over.
        let boxes = [nothing, one, nothing];
        let (scene, plain) = (Scene::new(&boxes, &boxes).expect("sound"), Scene::new(&boxes[1..2], &boxes[1..2]));
        for light in lights() {
            let plain = fit(&view(), &light, &plain.expect("sound"), &Settings::default());
            assert_eq!(fit(&view(), &light, &scene, &Settings::default()), plain);
        }
    }
}

/// As engines mark a box that is never to be culled: refused, with its index and the reason.
#[test]
fn boxes_without_bounds() {
    let one = Aabb::new([-5.0, 0.0, -5.0], [5.0, 1.0, 5.0]);
    for all in [Aabb::new([f32::MIN; 3], [f32::MAX; 3]), Aabb::new([f32::NEG_INFINITY; 3], [f32::INFINITY; 3])] {
        let error = Scene::new(&[one, all], &[one]).expect_err("no bounds");
        assert_eq!((error.field, error.index, error.hint), ("casters", Some(1), Some(Hint::Unbounded)));
        let error = Scene::from_box(all.min, all.max).expect_err("no bounds");
        assert_eq!((error.field, error.hint), ("min", Some(Hint::Unbounded)));
    }
}

/// It was an error: planes is empty.
#[test]
fn scenes_cut_to_nothing() {
    let (min, max) = (DVec3::splat(-5.0), DVec3::splat(5.0));
    let away = Plane::new(DVec3::X, -6.0);
    let many = [away; 80];
    for planes in [&[away][..], &[Plane::new(DVec3::X, 0.0), Plane::new(DVec3::NEG_X, -1.0)], &many] {
        let scene = ConvexScene::new(min, max, planes).expect("empty");
        assert_empty(&Scene::from_convex(&scene), Empty::NoReceivers);
    }
    // More planes than have names, of which the last leaves nothing.
    let mut planes = vec![Plane::new(DVec3::Y, 0.0); 70];
    planes.push(away);
    let scene = ConvexScene::new(min, max, &planes).expect("empty");
    assert_empty(&Scene::from_convex(&scene), Empty::NoReceivers);
    let none = ConvexScene::around([DVec3::ZERO; 0]).expect("empty");
    assert_empty(&Scene::from_convex(&none), Empty::NoReceivers);
}
