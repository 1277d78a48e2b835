//! Point lights and hemispheres in corners of what is visible, and how far from being served those are that are not.

use shadowfit::glam::DVec3;
use shadowfit::{Empty, Focus, Light, Outcome, Scene, Settings, ShadowMap, Surrounded, View, Warp};

use crate::place::{in_f32, is_inside};

const CORNER: DVec3 = DVec3::splat(10.0);

fn view() -> View {
    View::perspective((0.0, 0.0, 40.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0), 1.2, 1.5, 0.1, 1000.0).expect("sound")
}

fn scene() -> Scene<'static> {
    Scene::from_box(-CORNER, CORNER).expect("sound")
}

fn fit(light: &Light, warp: Warp) -> Outcome {
    Focus::new(&view(), light, &scene()).fit(&Settings::default().with_warp(warp))
}

fn hemisphere(position: DVec3) -> Light {
    Light::hemisphere(position, -position, 0.1, f64::INFINITY).expect("sound")
}

fn point(position: DVec3) -> Light {
    Light::point(position, 0.1, f64::INFINITY).expect("sound")
}

/// What is visible, as far as it is no nearer to the light than its near distance, is in the map.
fn assert_serves(map: &ShadowMap, light: &Light) {
    let position = light.position().expect("at a position");
    for corner in Focus::new(&view(), light, &scene()).receiver_volume().vertices() {
        let arm = *corner - position;
        for part in [1.0, 0.5, 0.1, light.near() / arm.length()] {
            let point = position + arm * part;
            if (point - position).length() >= light.near() {
                assert!(is_inside(in_f32(map, point)), "{point} of {light:?}");
            }
        }
    }
}

/// It was refused as surrounded, for the corner has no direction from itself.
#[test]
fn a_light_in_a_visible_corner_has_a_map() {
    for warp in [Warp::Uniform, Warp::Perspective, Warp::LightSpace, Warp::Trapezoidal, Settings::default().warp()]
    {
        for position in [CORNER, CORNER * DVec3::new(-1.0, 1.0, 1.0), -CORNER, CORNER * DVec3::new(1.0, 1.0, -1.0)]
        {
            for light in [point(position), hemisphere(position)] {
                let Outcome::Map(map) = fit(&light, warp) else { panic!("no {warp:?} map for {light:?}") };
                assert_serves(&map, &light);
                let focus = Focus::new(&view(), &light, &scene());
                let report = map.report(&focus);
                assert!(report.aliasing.is_finite() && report.texel.is_finite());
                assert!(map.aliasing_over(&focus).expect("something is visible").worst.is_finite());
                assert!(focus.aliasing_lower_bound(&Settings::default()) > 0.0);
            }
        }
    }
}

/// The corner is no place where maps jump: a step away they are the same but for the near distance.
#[test]
fn a_light_near_a_visible_corner_has_the_same_map() {
    let Outcome::Map(at) = fit(&point(CORNER), Warp::Uniform) else { panic!("no map") };
    for away in [1e-12, 1e-9, 1e-6] {
        let Outcome::Map(map) = fit(&point(CORNER + DVec3::splat(away)), Warp::Uniform) else { panic!("no map") };
        let (a, b) = (at.window(), map.window());
        assert!((a.width / b.width - 1.0).abs() < 1e-3 + away, "{away:e}: {} for {}", b.width, a.width);
        assert!((a.height / b.height - 1.0).abs() < 1e-3 + away, "{away:e}: {} for {}", b.height, a.height);
    }
}

/// On a face or an edge it sees a half space, and on top of a face nearly so; the answer says how nearly.
#[test]
fn a_surrounded_light_says_how_far_it_is_from_being_served() {
    let limit = Surrounded::MAX_HALF_ANGLE;
    assert!((limit - (1.0_f64 / 512.0).acos()).abs() < 1e-15);
    for position in [DVec3::new(0.0, 10.0, 0.0), DVec3::new(0.0, 10.0, 10.0), DVec3::new(0.0, 9.0, 0.0)] {
        let Outcome::Surrounded(why) = fit(&point(position), Warp::Uniform) else { panic!("a map at {position}") };
        assert!(
            (why.half_angle() - core::f64::consts::FRAC_PI_2).abs() < 1e-12,
            "{position}: {}",
            why.half_angle()
        );
    }
    // The farthest corners of the face are 10√2 away.
    for (height, is_served) in [(0.001, false), (0.02, false), (0.0277, true), (0.05, true)] {
        let outcome = fit(&point(DVec3::new(0.0, 10.0 + height, 0.0)), Warp::Uniform);
        let angle = (200.0_f64.sqrt() / height).atan();
        match outcome {
            Outcome::Map(_) => assert!(is_served && angle < limit, "{height}"),
            Outcome::Surrounded(why) => {
                assert!(!is_served && (why.half_angle() - angle).abs() < 1e-9, "{height}: {why}");
                assert!(why.to_string().contains("89.888°"), "{why}");
            }
            Outcome::Empty(why) => panic!("{why}"),
        }
    }
}

/// R is one point, and it is the light.
#[test]
fn nothing_casts_on_the_light_itself() {
    let scene = Scene::from_box(CORNER, CORNER).expect("a point");
    for light in [point(CORNER), hemisphere(CORNER)] {
        let outcome = Focus::new(&view(), &light, &scene).fit(&Settings::default());
        assert_eq!(outcome, Outcome::Empty(Empty::NoCasters));
    }
    // All of it nearer than the near distance: likewise, in a corner of it and beside it.
    let scene = Scene::from_box(CORNER - 0.01, CORNER).expect("small");
    for at in [CORNER, CORNER + 0.001] {
        let outcome = Focus::new(&view(), &point(at), &scene).fit(&Settings::default());
        assert_eq!(outcome, Outcome::Empty(Empty::NoCasters), "{at}");
    }
}

/// A near distance that f64 cannot tell from none beside the position: no map, and no NaN.
#[test]
fn a_near_distance_lost_in_a_corner() {
    let far = DVec3::splat(1e9);
    let view =
        View::perspective(far + DVec3::Z * 30.0, DVec3::NEG_Z, DVec3::Y, 1.2, 1.5, 0.1, 1000.0).expect("sound");
    let scene = Scene::from_box(far - 10.0, far).expect("sound");
    let light = Light::point(far, 1e-9, f64::INFINITY).expect("sound");
    assert!(matches!(Focus::new(&view, &light, &scene).fit(&Settings::default()), Outcome::Surrounded(_)));
}
