//! The aliasing of a map over all that is visible.

use approx::assert_relative_eq;
use glam::{DVec3, Vec3};
use proptest::prelude::*;
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use shadowfit::{
    Aabb, Focus, Light, Scene, Settings, ShadowMap, View, Warp, focus::ConvexBody, map::Aliasing, warp::Shift,
};
use testkit::arbitrary::{Together, case, points_of, run, settings};

/// The aliasing at a point of R, which rounding may leave before the near plane by some of its distance: not by more,
/// where coordinates are large against it.
fn in_view(map: &ShadowMap, view: &View, point: DVec3) -> f64 {
    let before = if view.lens() == shadowfit::input::Lens::Perspective {
        view.depth(point) / view.depth(point).max(view.near())
    } else {
        1.0
    };
    map.aliasing(point).expect("a point of the map") * before
}

#[test]
fn no_point_of_r_has_more_than_is_said_and_one_has_the_worst() {
    run(3000, &(case(), settings(), any::<u64>()), |(case, settings, seed)| {
        let together = Together::of(&case);
        let focus = together.focus();
        let Some(map) = focus.fit(&settings).into_map() else { return };
        let visible = focus.receiver_volume();
        let found = map.aliasing_over(&focus).expect("what is visible has aliasing");
        // A product and a quotient.
        assert_relative_eq!(
            in_view(&map, &together.view, found.worst_at),
            found.worst,
            max_relative = 4.0 * f64::EPSILON
        );
        // Next to a light in a corner of R, nearer than anything casts, there is no map.
        let is_there = |corner: &DVec3, light: DVec3| {
            (*corner - light).length() <= 1e-12 * (corner.abs() + light.abs()).length()
        };
        let position = together.light.position();
        let in_corner =
            position.is_some_and(|light| visible.vertices().iter().any(|corner| is_there(corner, light)));
        for point in points_of(&visible, seed).into_iter().filter(|point| !in_corner || together.is_served(*point))
        {
            let there = in_view(&map, &together.view, point);
            assert!(there <= found.upper_bound, "{there} at {point}, {found:?}");
        }
        assert!(found.upper_bound > found.worst);
        assert!(found.mean > 0.0 && found.mean <= found.upper_bound, "{found:?}");
    });
}

/// The mean over many points of a body, and the standard deviation of that: points at random in its bounds.
fn sampled(map: &ShadowMap, body: &ConvexBody, count: usize) -> (f64, f64) {
    let (min, max) = body.bounds().unwrap();
    let mut random = StdRng::seed_from_u64(11);
    let (mut sum, mut squares, mut inside) = (0.0, 0.0, 0.0_f64);
    for _ in 0..count {
        let part = DVec3::from([(); 3].map(|()| random.random_range(0.0..1.0)));
        let point = min + (max - min) * part;
        if body.contains(point) {
            let there = map.aliasing(point).unwrap();
            (sum, squares, inside) = (sum + there, squares + there * there, inside + 1.0);
        }
    }
    let mean = sum / inside;
    (mean, ((squares / inside - mean * mean) / inside).sqrt())
}

fn lights() -> [Light; 5] {
    [
        Light::directional((0.3, 1.0, 0.4)).unwrap(),
        Light::directional((0.2, 0.3, -1.0)).unwrap(),
        Light::point((4.0, 12.0, -20.0), 0.1, f64::INFINITY).unwrap(),
        // Just off what is visible.
        Light::point((0.0, 4.2, -10.0), 0.01, f64::INFINITY).unwrap(),
        Light::spot((4.0, 9.0, -8.0), (0.1, -1.0, -0.5), 1.2, 0.1, 90.0).unwrap(),
    ]
}

fn street() -> View {
    View::perspective((0.0, 1.7, 0.0), (0.3, -0.1, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.3, 120.0).unwrap()
}

/// Against points at random, five standard deviations of them, and one part in a thousand that the mean may be off.
#[test]
fn the_mean_is_that_of_many_points() {
    let scene = Scene::from_box((-20.0, 0.0, -40.0), (20.0, 4.0, 10.0)).unwrap();
    for light in lights() {
        let focus = Focus::new(&street(), &light, &scene);
        for warp in [Warp::Uniform, Warp::Perspective] {
            let map = focus.fit(&Settings::default().with_warp(warp)).into_map().unwrap();
            let found = map.aliasing_over(&focus).unwrap();
            let (mean, deviation) = sampled(&map, &focus.receiver_volume(), 500_000);
            assert!(deviation < 4e-3 * mean, "too few points: {mean} ± {deviation}");
            let off = (found.mean - mean).abs();
            assert!(off < 5.0 * deviation + 1e-3 * mean, "{light:?}, {warp:?}: {found:?}, {mean} ± {deviation}");
        }
    }
}

/// V as the receivers, light from straight above, no warp: aliasing is a constant over depth, and its mean over V, whose
/// cross-section grows with depth², is ∫ z dz/∫ z² dz of that constant.
#[test]
fn the_mean_over_a_frustum_has_a_closed_form() {
    for far in [1.5, 10.0, 100.0, 1e4] {
        let view = View::perspective(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 1.0, 1.0, 1.0, far).unwrap();
        let scene = Scene::from_box(DVec3::splat(-2.0 * far), DVec3::splat(2.0 * far)).unwrap();
        let focus = Focus::new(&view, &Light::directional(DVec3::Y).unwrap(), &scene);
        let map = focus.fit(&Settings::default().with_warp(Warp::Uniform)).into_map().unwrap();
        let found = map.aliasing_over(&focus).unwrap();
        let over_worst = (far.powi(2) - 1.0) / 2.0 / ((far.powi(3) - 1.0) / 3.0);
        // A near corner is off by three times 96 ε of the sum of two coordinates of 2f.
        assert_relative_eq!(found.mean / found.worst, over_worst, max_relative = 1e-3);
        assert_relative_eq!(view.depth(found.worst_at), 1.0, max_relative = 3.0 * 96.0 * f64::EPSILON * 4.0 * far);
    }
}

/// A floor 40 m long and 2 m wide under a lamp 3 m above its middle, seen from straight above. Texels are as long
/// as the window is, 20 times as long as wide. Right below the lamp they lie across the ray; at the ends the light sees
/// them foreshortened by 3/√(20² + 3²).
#[test]
fn below_a_lamp_there_may_be_more_than_at_any_vertex() {
    let view = View::orthographic((0.0, 50.0, 0.0), DVec3::NEG_Y, DVec3::X, 30.0, 1.0, 1.0, 100.0).unwrap();
    let scene = Scene::from_box((-20.0, 0.0, -1.0), (20.0, 0.0, 1.0)).unwrap();
    let light = Light::point((0.0, 3.0, 0.0), 0.01, f64::INFINITY).unwrap();
    let focus = Focus::new(&view, &light, &scene);
    let map = focus.fit(&Settings::default().with_warp(Warp::Uniform)).into_map().unwrap();
    let found = map.aliasing_over(&focus).unwrap();
    assert!(found.worst_at.x.abs() < 0.2, "{found:?}");
    // 40 m on as many texels as lie inside the border, over a pixel; what the window has of padding is the difference.
    let needed = (40.0 / 2046.0) / (60.0 / 1080.0);
    assert_relative_eq!(found.worst, needed, max_relative = 2e-3);
    let cosine = 3.0 / 20.0_f64.hypot(3.0);
    assert!(map.report(&focus).aliasing < 1.1 * cosine * needed);
}

/// c is constant: what is left is 1/depth.
#[test]
fn vertices_decide_in_uniform_maps_of_the_sun() {
    run(1000, &case(), |case| {
        let together = Together::of(&case);
        let focus = together.focus();
        let Some(map) = focus.fit(&Settings::default().with_warp(Warp::Uniform)).into_map() else { return };
        if together.light.position().is_none() {
            let found = map.aliasing_over(&focus).unwrap();
            let vertices = focus.receiver_volume();
            let worst = vertices.vertices().iter().map(|&point| in_view(&map, &together.view, point));
            // Rounding as above.
            assert!(found.worst <= worst.fold(0.0, f64::max) * (1.0 + 1e-9), "{found:?}");
        }
    });
}

/// A depth read-back narrows the view, and what is cut off counts no more: the worst of a uniform map under an overhead
/// light goes with 1/near.
#[test]
fn of_a_narrowed_view_only_what_is_left_counts() {
    let view = View::perspective(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 1.0, 1.0, 1.0, 100.0).unwrap();
    let scene = Scene::from_box(DVec3::splat(-200.0), DVec3::splat(200.0)).unwrap();
    let light = Light::directional(DVec3::Y).unwrap();
    let focus = Focus::new(&view, &light, &scene);
    let map = focus.fit(&Settings::default().with_warp(Warp::Uniform)).into_map().unwrap();
    let whole = map.aliasing_over(&focus).unwrap();
    for (near, far) in [(2.0, 100.0), (5.0, 50.0), (20.0, 40.0)] {
        let narrowed = view.narrowed(near, far).unwrap();
        let left = Focus::new(&narrowed, &light, &scene);
        let found = map.aliasing_over(&left).unwrap();
        assert_relative_eq!(found.worst, whole.worst / near, max_relative = 1e-9);
        let over_worst = near * (far.powi(2) - near.powi(2)) / 2.0 / ((far.powi(3) - near.powi(3)) / 3.0);
        assert_relative_eq!(found.mean / found.worst, over_worst, max_relative = 1e-3);
        // The map for what is left counts the same, and is no worse there.
        let own = left.fit(&Settings::default().with_warp(Warp::Uniform)).into_map().unwrap();
        let own = own.aliasing_over(&left).unwrap();
        assert!(own.worst <= found.worst * (1.0 + 1e-9) && own.mean <= found.mean * (1.0 + 1e-3));
    }
}

fn near(a: &Aliasing, b: &Aliasing) {
    assert_relative_eq!(a.worst, b.worst, max_relative = 1e-9);
    assert_relative_eq!(a.mean, b.mean, max_relative = 2e-3);
}

#[test]
fn only_receivers_that_are_listed_count() {
    let scene = Scene::from_box((-20.0, 0.0, -40.0), (20.0, 4.0, 10.0)).unwrap();
    let ground = Aabb::new(Vec3::new(-20.0, 0.0, -40.0), Vec3::new(20.0, 0.0, 10.0));
    let house = Aabb::new(Vec3::new(1.0, 0.0, -20.0), Vec3::new(6.0, 4.0, -12.0));
    let behind = Aabb::new(Vec3::new(1.0, 0.0, 5.0), Vec3::new(2.0, 4.0, 6.0));
    let post = Aabb::new(Vec3::new(1.0, 0.0, -10.0), Vec3::new(1.0, 2.0, -10.0));
    for light in lights() {
        let focus = Focus::new(&street(), &light, &scene);
        let map = focus.fit(&Settings::default().with_shift(Shift::None)).into_map().unwrap();
        let over = |receivers: &[Aabb]| map.aliasing_over_receivers(&focus, receivers);
        let all = map.aliasing_over(&focus).unwrap();

        // A flat body has two sides, which are the same.
        let flat = Scene::from_box(ground.min.as_dvec3(), ground.max.as_dvec3()).unwrap();
        let on_ground = over(&[ground]).unwrap();
        near(&on_ground, &map.aliasing_over(&Focus::new(&street(), &light, &flat)).unwrap());

        // What is out of view is not there, and of several the worst is the worst.
        assert_eq!(over(&[]), None);
        assert_eq!(over(&[behind]), None);
        assert_eq!(over(&[behind, ground]), over(&[ground]));
        let (on_house, both) = (over(&[house]).unwrap(), over(&[ground, house]).unwrap());
        assert_eq!(both.worst, on_ground.worst.max(on_house.worst));
        assert!(both.worst <= all.upper_bound);
        let (low, high) = (on_ground.mean.min(on_house.mean), on_ground.mean.max(on_house.mean));
        assert!(low <= both.mean && both.mean <= high, "{on_ground:?}, {on_house:?}, {both:?}");

        // A post counts for the worst, and has a mean of its own where there is nothing else.
        let on_post = over(&[post]).unwrap();
        assert!(on_post.mean <= on_post.worst && on_post.mean > 0.0);
        assert_eq!(over(&[post, house]).unwrap().mean, on_house.mean);
    }
}
