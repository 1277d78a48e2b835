//! Rows 1 to 8, 15 and 16: where the light stands to the view.

use shadowfit::glam::DVec3;
use shadowfit::{
    Focus, FocusForm, Light, Outcome, Scene, ShadowMap, View, Warp,
    warp::{ClassKind, classify},
};

use crate::place::{
    assert_holds, assert_order, change, in_f32, is_inside, lamp, map, place, settings, slack, sun, turned_view,
    view, visible, wide,
};
use crate::sweep::{about, powers, steps};
use testkit::stability::bodies::{hull, vertices};
use testkit::stability::linear::homogeneous;
use testkit::stability::measure::Ours;
use testkit::stability::setup::{Lamp, Setup};

/// That a family of maps changes about 0 by no more than in proportion: by at most four times (a kink, where another vertex
/// begins to limit the warp, may double a slope, and double it again) what the steepest of the first eight powers of ten
/// changes for as large a step, and by what rounding of the input does and of the fit.
fn assert_proportional(fit: impl Fn(f64) -> ShadowMap, points: &[DVec3], reach: f64) {
    let middle = fit(0.0);
    let coarse = powers().filter(|by| by.abs() > 1e-8);
    let steepest = coarse.map(|by| change(&fit(by), &middle, points) / by.abs()).fold(0.0, f64::max);
    let rounding = points.iter().map(|&p| slack(&middle, p, reach)).fold(0.0, f64::max);
    for by in about(0.0) {
        let allowed = 4.0 * steepest * (by.abs() + 64.0 * f64::EPSILON) + 2.0 * rounding;
        let change = change(&fit(by), &middle, points);
        assert!(change <= allowed, "by {by:e}: {change:e}, allowed {allowed:e}");
    }
}

/// λw = 0 of either sign is the same map to the last bit, and w is the camera's own depth: a parallel projection after
/// perspective. (`closed_forms::negative_zero_is_zero`, `paper_construction::directional_lights`.)
#[test]
fn row_01_light_in_the_image_plane() {
    let (view, scene) = (view(), wide());
    for make in [sun, lamp] {
        let at = |z: f64| map(&view, &make(DVec3::new(30.0, 40.0, z)), &scene, &settings());
        assert_eq!(at(0.0).clip_from_world(), at(-0.0).clip_from_world());
        for z in [0.0, -0.0] {
            let light = make(DVec3::new(30.0, 40.0, z));
            assert_eq!(classify(&view, &light).kind, ClassKind::Directional);
            let map = at(z);
            // The warp has just the ratio that it may have, but for rounding.
            assert!(map.weakening() <= f64::EPSILON, "{:e}", map.weakening());
            let w = map.clip_from_world().row(3);
            let points = visible(&view, &light, &scene);
            let ratio = |p: DVec3| w.dot(p.extend(1.0)) / view.depth(p);
            for &p in &points {
                let allowed = slack(&map, p, 400.0) * ratio(p);
                assert!((ratio(p) - ratio(points[0])).abs() <= allowed, "{} {}", ratio(p), ratio(points[0]));
            }
        }
        // The neighbours of zero take the same path: subnormal numbers are not worth a rounding.
        for z in steps(0.0) {
            assert_eq!(at(z).clip_from_world(), at(0.0).clip_from_world(), "{z:e}");
        }
    }
}

/// λw → 0 from both sides: the f64 matrix is right to its rounding, the uploaded one to f32's, and places change in
/// proportion. (`properties::maps_change_continuously_across_the_camera_plane`.)
#[test]
fn row_02_light_through_the_image_plane() {
    for make in [Lamp::Sun, Lamp::At] {
        for depth in about(0.0) {
            let setup = Setup::outdoors(make(DVec3::new(30.0, 40.0, -depth)));
            let Ours { errors: ours, bounds } = Ours::new(&setup);
            for (errors, bound) in ours.iter().zip(bounds) {
                assert!(errors.most <= bound, "{depth:e}: {errors:?}, {bound:e}");
                assert_eq!((errors.wrapped, errors.disorder), (0, 0), "{depth:e}");
            }
            // Of the order of 1e-7: four roundings of f32 of the whole clip volume.
            assert!(ours[1].most <= 4.0 / 16_777_216.0, "{depth:e}: {:e}", ours[1].most);
        }
    }
    let (view, scene) = (turned_view(), wide());
    let across = view.right() * 0.6 + view.up() * 0.8;
    for make in [|d: DVec3, _: &View| sun(d), |d, view: &View| lamp(view.eye() + d * 50.0)] {
        let fit = |depth: f64| map(&view, &make(across + view.forward() * depth, &view), &scene, &settings());
        let points = visible(&view, &make(across, &view), &scene);
        assert_proportional(fit, &points, 400.0);
    }
}

/// The name of the class has a threshold, a few roundings from λw = 0. Nothing else changes there.
#[test]
fn row_03_no_threshold_in_the_matrix() {
    let (view, scene) = (turned_view(), wide());
    let across = view.right() * 0.6 + view.up() * 0.8;
    let fit = |depth: f64| {
        let light = sun(across + view.forward() * depth);
        (classify(&view, &light).kind, map(&view, &light, &scene, &settings()))
    };
    let points = visible(&view, &sun(across), &scene);
    let per_unit = change(&fit(1e-3).1, &fit(0.0).1, &points) / 1e-3;
    let (mut before, mut changes) = (fit(-32.0 * f64::EPSILON), 0);
    for step in -31..=32 {
        let here = fit(f64::from(step) * f64::EPSILON);
        changes += usize::from(here.0 != before.0);
        // λw is not known to better than a few roundings, so that a step may be that long.
        let rounding = points.iter().map(|&p| slack(&here.1, p, 400.0)).fold(0.0, f64::max);
        let allowed = 4.0 * per_unit * 8.0 * f64::EPSILON + 2.0 * rounding;
        let change = change(&here.1, &before.1, &points);
        assert!(change <= allowed, "{step}: {change:e}, allowed {allowed:e}");
        before = here;
    }
    assert_eq!(changes, 2, "infinity plane inverted, directional, infinity plane");
}

/// A light behind the viewer: depth grows away from it all the same. (`paper_construction::inverted_lights`.)
#[test]
fn row_04_light_behind_the_viewer() {
    let (view, scene) = (view(), wide());
    let behind = powers().map(f64::abs).chain([1.0, 10.0]);
    for depth in behind {
        let direction = DVec3::new(0.6, 0.8, depth);
        for (light, kind) in
            [(sun(direction), ClassKind::InfinityPlaneInverted), (lamp(direction * 50.0), ClassKind::Inverted)]
        {
            let class = classify(&view, &light).kind;
            // But for the rounding of λw.
            assert!(class == kind || (depth < 1e-15 && class == ClassKind::Directional), "{depth:e}: {class}");
            assert_order(&map(&view, &light, &scene, &settings()), &light, &visible(&view, &light, &scene));
        }
    }
}

/// A lamp in the camera plane, at the eye, and along an edge of the frustum: finite, and H holds the exact one.
/// (`oracle` over cases at random.)
#[test]
fn row_05_lamp_where_silhouettes_degenerate() {
    let view = view();
    let (min, max) = (DVec3::new(-20.0, -8.0, -90.0), DVec3::new(25.0, 12.0, 20.0));
    let scene = Scene::from_box(min, max).expect("sound");
    let corner = view.corners().expect("finite")[0];
    let places = about(0.0).flat_map(|by| {
        [
            DVec3::new(3.0, 2.0, by),
            DVec3::new(by, 0.0, 0.0),
            DVec3::new(by, -by, by),
            // On the line of an edge, before, at and behind the eye, and beside it.
            corner * 0.5 + DVec3::X * by,
            corner * by,
            -corner * 3.0 + DVec3::Y * by,
        ]
    });
    for position in places {
        let light = lamp(position);
        let focus = Focus::new(&view, &light, &scene);
        assert_holds(&focus.caster_volume(FocusForm::ViewHull), &exact_body(&view, &light, min, max), &position);
        let map = match focus.fit(&settings()) {
            Outcome::Map(map) => map,
            other => panic!("R is before the camera plane, the lamp is not among it: {other:?}"),
        };
        assert!(map.caster_matrix().is_finite());
        for &p in focus.receiver_volume().vertices() {
            assert!(is_inside(in_f32(&map, p)), "{position}: {p} is at {}", place(&map, p));
        }
    }
}

/// The vertices of hull(V, l) ∩ S ∩ L, exactly, for a box of a scene.
fn exact_body(
    view: &View,
    light: &Light,
    min: DVec3,
    max: DVec3,
) -> Vec<testkit::stability::linear::V4<testkit::stability::arithmetic::Big>> {
    let of_view: Vec<_> = view.planes().iter().map(|plane| homogeneous(plane.to_row())).collect();
    let mut planes = hull(&of_view, &homogeneous(light.homogeneous()));
    for (axis, normal) in DVec3::AXES.into_iter().enumerate() {
        planes.push(homogeneous(normal.extend(-min[axis])));
        planes.push(homogeneous((-normal).extend(max[axis])));
    }
    planes.extend(light.planes().iter().map(|plane| homogeneous(plane.to_row())));
    vertices(&planes)
}

/// The sun before the viewer, in the image or beside it, the far plane far away: w > 0 on R, in f64 and in f32.
#[test]
fn row_06_sun_in_the_image() {
    for k in 1..=8 {
        let far = 0.1 * 10_f64.powi(k);
        let view = View::perspective(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 1.0, 1.5, 0.1, far).expect("sound");
        let scene = Scene::from_box(DVec3::splat(-2.0 * far), DVec3::splat(2.0 * far)).expect("sound");
        for slope in [0.0, 1e-6, 1e-3, 0.1, 0.3, 0.54, 0.55, 0.8] {
            let light = sun(DVec3::new(slope, 0.5 * slope, -1.0));
            let map = map(&view, &light, &scene, &settings());
            for p in visible(&view, &light, &scene) {
                assert!(map.clip_from_world().row(3).dot(p.extend(1.0)) > 0.0, "{far:e}, {slope}: {p}");
                assert!(is_inside(in_f32(&map, p)), "{far:e}, {slope}: {p}");
            }
        }
    }
}

/// Light exactly along the view or against it: the uniform map, and the view's own up to orient it.
/// (`closed_forms::along_the_view_the_warp_is_the_uniform_map`.)
#[test]
fn row_07_light_along_the_view() {
    for view in [view(), turned_view()] {
        for sign in [1.0, -1.0] {
            let light = sun(view.forward() * sign);
            let scene = wide();
            let warped = map(&view, &light, &scene, &settings());
            let uniform = map(&view, &light, &scene, &settings().with_warp(Warp::Uniform));
            let points = visible(&view, &light, &scene);
            // 1 but for the roundings of w, one part in it for each unit of the coordinates.
            assert!((warped.warp_ratio() - 1.0).abs() <= 1e-9, "{}", warped.warp_ratio());
            // The padding, which follows f32's rounding, is all that may differ.
            assert!(change(&warped, &uniform, &points) <= 1e-6);
            // along = −l: forward for the sun behind the viewer.
            let along_y = warped.clip_from_world().row(1).truncate().normalize();
            let expected = view.up() * -sign;
            assert!((along_y - expected).length() <= 1e-9, "{along_y}, {expected}");
        }
    }
}

/// Nearly along the view the warp is weakened to next to nothing: w varies by no more than 1 + (r − 1) sin⁴, r the range of
/// eye depths, and never by less than a 1024th is asked for; texels grow with w across and with its square along, so that no
/// receiver is worse off than without a warp by more than that ratio squared.
#[test]
fn row_08_light_nearly_along_the_view() {
    let scene = wide();
    for view in [view(), turned_view()] {
        for sine in powers().filter(|sine| sine.abs() <= 0.1) {
            for sign in [1.0, -1.0] {
                let light = sun(view.forward() * sign + view.up() * sine);
                let points = visible(&view, &light, &scene);
                let depths = points.iter().map(|&p| view.depth(p));
                let (least, most) = depths.fold((f64::INFINITY, 0.0_f64), |(a, b), d| (a.min(d), b.max(d)));
                let sine_squared = view.forward().cross(light.homogeneous().truncate()).length_squared();
                let allowed = 1.0 + (most / least - 1.0) * sine_squared * sine_squared;
                let allowed = allowed.max(1.0 + 1.0 / 1024.0);
                let [warped, uniform] = [Warp::Perspective, Warp::Uniform]
                    .map(|warp| map(&view, &light, &scene, &settings().with_warp(warp)));
                assert!(warped.warp_ratio() <= allowed * (1.0 + 1e-9), "{sine:e}: {}", warped.warp_ratio());
                let worst =
                    |map: &ShadowMap| points.iter().map(|&p| map.aliasing(p).expect("inside")).fold(0.0, f64::max);
                let (of_warped, of_uniform) = (worst(&warped), worst(&uniform));
                // The two windows are padded each for its own rounding in f32, by millionths.
                let factor = allowed * allowed * (1.0 + 1e-5);
                assert!(of_warped <= of_uniform * factor, "{sine:e}: {of_warped} {of_uniform}");
            }
        }
    }
}

/// The paper's plane c = 0 grazes R, cuts it, misses it: c is positive and its ratio over R bounded and reported, by that of
/// l has one sign, set at the door: w is 1 or 0, directions of any length are one light, and −d is the light from the other
/// A lamp far away becomes the sun: places differ by the angle that the scene is seen under, down to rounding.
/// (`closed_forms::a_light_far_away_is_a_directional_light`.)
#[test]
fn row_15_lamp_far_away_is_the_sun() {
    let view = View::perspective(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 1.0, 1.5, 1.0, 150.0).expect("sound");
    let scene = Scene::from_box((-80.0, -20.0, -80.0), (80.0, 20.0, 80.0)).expect("sound");
    for direction in [DVec3::new(0.5, 0.7, 0.2), DVec3::new(-0.3, 0.4, 0.9), DVec3::new(0.1, 0.2, -0.9)] {
        let infinite = sun(direction);
        let points = visible(&view, &infinite, &scene);
        for warp in [Warp::Uniform, Warp::Perspective] {
            let settings = settings().with_warp(warp);
            let of_sun = map(&view, &infinite, &scene, &settings);
            for k in 4..=11 {
                let distance = 10_f64.powi(k);
                let lamp =
                    Light::point(infinite.homogeneous().truncate() * distance, 1.0, f64::INFINITY).expect("sound");
                let of_lamp = map(&view, &lamp, &scene, &settings);
                // 8 angles of a scene of 200, and a few dozen roundings of positions at that distance, in a window that
                // is some tens wide and a depth range of as much.
                let allowed = 8.0 * 200.0 / distance + 64.0 * f64::EPSILON * distance / 10.0;
                let off = change(&of_lamp, &of_sun, &points);
                assert!(off <= allowed, "{direction}, {warp:?}, {distance:e}: {off:e}, allowed {allowed:e}");
            }
        }
    }
}

/// The axes of a map of uniform texels, by its rows.
fn axes(view: &View, direction_to_light: DVec3) -> [DVec3; 2] {
    let settings = settings().with_warp(Warp::Uniform);
    let map = map(view, &sun(direction_to_light), &wide(), &settings);
    [0, 1].map(|row| map.clip_from_world().row(row).truncate().normalize())
}

/// The frame turns with the light continuously, also where up vectors are usually switched: the light straight above, along
/// the view, to the side. It has its two jumps where `src/frame.rs` says: the light's direction of travel at 60° from up, in
/// the plane of the view, and nowhere on small circles around the other places.
#[test]
fn row_16_no_up_vector_is_switched() {
    let view = turned_view();
    let (right, up, forward) = (view.right(), view.up(), view.forward());
    let smooth = [up, -up, forward, -forward, right, -right, up + forward, up - forward, (right + up) * 0.7];
    for middle in smooth {
        let middle = middle.normalize();
        let (x, y) = middle.any_orthonormal_pair();
        let at_middle = axes(&view, middle);
        for by in about(0.0) {
            // The frame turns by no more than some ten times as much as the light does.
            for away in [x, y, x - y] {
                let turned = axes(&view, middle + away * by);
                for (a, b) in at_middle.iter().zip(&turned) {
                    let turn = (*a - *b).length();
                    assert!(turn <= 16.0 * by.abs() + 1e-12, "{middle} by {by:e}: {turn:e}");
                }
            }
        }
    }
    // Along −d: 60° from up, ahead of the viewer or behind.
    for ahead in [1.0, -1.0] {
        let jump = -(up * 0.5 + forward * (ahead * 0.75_f64.sqrt()));
        for k in 3..=12 {
            let aside = right * 10_f64.powi(-k);
            let [left, right] = [jump - aside, jump + aside].map(|direction| axes(&view, direction)[1]);
            assert!(left.dot(right) < -0.9, "no jump at {jump}, 1e-{k}: {left} {right}");
        }
        // In the plane of the view, 3° beside it, there is none.
        for angle in [57.0_f64, 63.0] {
            let (sin, cos) = angle.to_radians().sin_cos();
            let beside = -(up * cos + forward * (ahead * sin));
            let [a, b] = [-1e-9, 1e-9].map(|by| axes(&view, beside + right * by)[1]);
            assert!((a - b).length() <= 1e-6, "{angle}: {a} {b}");
        }
    }
}
