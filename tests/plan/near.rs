//! Near distances of lights at a position: what casters allow, and what smaller ones cost.

use shadowfit::glam::Vec3;
use shadowfit::{
    Aabb, Focus, Light, Scene, Settings, View, Warp,
    omni::CubeFace,
    plan::{Budget, Object, Objects, Reason, plan},
};

fn table() -> Aabb {
    Aabb::new(Vec3::new(-1.0, 0.0, -1.0), Vec3::new(1.0, 1.0, 1.0))
}

fn ground() -> Aabb {
    Aabb::new(Vec3::new(-30.0, -1.0, -30.0), Vec3::new(30.0, 0.0, 30.0))
}

fn lamp(near: f64) -> Light {
    Light::point([0.0, 3.0, 0.0], near, 20.0).expect("a legal light")
}

fn view() -> View {
    View::perspective([0.0, 2.0, 12.0], [0.0, -0.1, -1.0], [0.0, 1.0, 0.0], 1.0, 1.6, 0.1, 100.0)
        .expect("a legal view")
}

#[test]
fn casters_say_how_large_a_near_distance_may_be() {
    assert_eq!(lamp(0.05).distance_to_casters(&[ground(), table()]), Some(2.0));
    assert_eq!(lamp(0.05).distance_to_casters(&[ground()]), Some(3.0));
    assert_eq!(lamp(0.05).distance_to_casters(&[]), None);
    let around = Aabb::new(Vec3::splat(-5.0), Vec3::splat(5.0));
    assert_eq!(lamp(0.05).distance_to_casters(&[around]), Some(0.0));
    let far = Aabb::new(Vec3::splat(40.0), Vec3::splat(50.0));
    assert_eq!(lamp(0.05).distance_to_casters(&[far]), None, "beyond its range");
    let up = lamp(0.05).cube_face(CubeFace::PositiveY, 0.0).expect("a face");
    assert_eq!(up.distance_to_casters(&[table()]), None, "not in this face");
    let sun = Light::directional([0.0, 1.0, 0.0]).expect("a direction");
    assert_eq!(sun.distance_to_casters(&[table()]), None);
}

/// Of hyperbolic depth from n to f the part (1/n − 16/f)/(1/n − 1/f) lies before f/16.
#[test]
fn maps_say_how_much_of_their_depth_is_air() {
    let scene = Scene::from_box([-30.0, -1.0, -30.0], [30.0, 8.0, 30.0]).expect("a legal box");
    let part = |near: f64| {
        let face = lamp(near).cube_face(CubeFace::NegativeY, 0.0).expect("a face");
        let view = view();
        let focus = Focus::new(&view, &face, &scene);
        let outcome = focus.fit(&Settings::default().with_warp(Warp::Uniform));
        let map = outcome.map().expect("a map");
        let (near, far) = (map.depth().near, map.depth().far);
        let expected = ((1.0 / near - 16.0 / far) / (1.0 / near - 1.0 / far)).max(0.0);
        assert!((map.depth_beside_light() - expected).abs() < 1e-12, "{} {expected}", map.depth_beside_light());
        assert_eq!(map.report(&focus).depth_beside_light, map.depth_beside_light());
        map.depth_beside_light()
    };
    assert!(part(0.001) > 0.98 && part(0.05) > 0.5 && part(1.0) == 0.0);
}

#[test]
fn plans_say_where_a_near_distance_is_too_small() {
    let objects = Objects::new(&[Object::new(ground()), Object::new(table())]).expect("legal boxes");
    let budget = Budget::new(Settings::default());
    let reasons = |near: f64| {
        let plan = plan(&view(), &[lamp(near)], &objects, &budget);
        plan.lights()[0].reasons().to_vec()
    };
    assert!(reasons(0.05).contains(&Reason::NearTooSmall(2.0)), "{:?}", reasons(0.05));
    assert!(!reasons(1.5).iter().any(|reason| matches!(reason, Reason::NearTooSmall(_))));
}
