//! What no stable map is for.

use glam::DVec3;
use shadowfit::{Aabb, Light, Outcome, Scene, Settings, View, Warp, WarpFallback, fit, omni::CubeFace};

/// Lights and views that no stable map is for have the uniform one, and say why.
#[test]
fn refusals() {
    let settings = Settings::default();
    let eye = DVec3::new(0.0, 5.0, 30.0);
    let view = |far| View::perspective(eye, (0.0, -0.2, -1.0), DVec3::Y, 1.0, 1.6, 0.1, far).expect("sound");
    let (min, max) = (DVec3::new(-50.0, 0.0, -50.0), DVec3::new(50.0, 10.0, 20.0));
    let bounds = Scene::from_box(min, max).expect("sound");
    let boxes = [Aabb::new(min.as_vec3(), max.as_vec3())];
    let lists = Scene::new(&boxes, &boxes).expect("sound");
    let above = DVec3::new(0.0, 60.0, -10.0);
    let sun = Light::directional((0.3, 1.0, 0.2)).expect("sound");
    let point = Light::point(above, 0.1, f64::INFINITY).expect("sound");
    let hemisphere = Light::hemisphere(above, DVec3::NEG_Y, 0.1, 200.0).expect("sound");
    let spot = |half_angle| Light::spot(above, DVec3::NEG_Y, half_angle, 0.1, 200.0).expect("sound");
    let face = point.cube_face(CubeFace::NegativeY, 0.1).expect("sound");
    let cases = [
        (sun, bounds, 100.0, None),
        (sun, bounds, f64::INFINITY, None),
        (sun, lists, 100.0, None),
        (sun, lists, f64::INFINITY, Some(WarpFallback::Endless)),
        (point, bounds, 100.0, Some(WarpFallback::NoRegion)),
        (hemisphere, bounds, 100.0, Some(WarpFallback::NoRegion)),
        (spot(0.8), bounds, f64::INFINITY, None),
        (spot(0.8), lists, f64::INFINITY, None),
        (spot(1.5705), bounds, 100.0, Some(WarpFallback::NoRegion)),
        (face, bounds, f64::INFINITY, None),
    ];
    for (light, scene, far, refusal) in cases {
        let map =
            |warp| fit(&view(far), &light, &scene, &settings.with_warp(warp)).into_map().expect("one map does");
        let (stable, uniform) = (map(Warp::Stable), map(Warp::Uniform));
        assert_eq!(stable.fallback(), refusal, "{light:?}, far {far}");
        assert_eq!(uniform.fallback(), None);
        assert_eq!(stable.caster_matrix() == uniform.caster_matrix(), refusal.is_some(), "{light:?}, far {far}");
        assert_eq!([stable.warp_ratio(), stable.weakening()], [1.0; 2]);
    }
}

/// What no map is for has no stable one.
#[test]
fn lamps_among_what_is_visible_have_none() {
    let view = View::perspective((0.0, 1.7, 0.0), DVec3::NEG_Z, DVec3::Y, 1.0, 1.6, 0.1, 100.0).expect("sound");
    let scene = Scene::from_box((-5.0, 0.0, -9.0), (5.0, 4.0, 2.0)).expect("sound");
    let light = Light::point((0.0, 2.0, -3.0), 0.1, 40.0).expect("sound");
    let settings = Settings::default().with_warp(Warp::Stable);
    let Outcome::Surrounded(why) = fit(&view, &light, &scene, &settings) else { panic!("a map") };
    assert!((why.half_angle() - core::f64::consts::FRAC_PI_2).abs() < 1e-15);
}
