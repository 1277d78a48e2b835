//! The least worst aliasing that any spread of the same texels could have.

use approx::assert_relative_eq;
use glam::DVec3;
use proptest::prelude::*;
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use shadowfit::{Focus, Light, Scene, Settings, View, Warp, warp::Shift};
use std::f64::consts::TAU;
use testkit::arbitrary::{Together, case, run, settings};
use testkit::outdoors;

const MAP: u32 = 2048;
const IMAGE: u32 = 1080;

fn sizes() -> Settings {
    Settings::new(MAP, IMAGE).unwrap()
}

/// The limit of a map and an image of one height, squared: the texels that are needed for each pixel of its height,
/// squared. `docs/design.md` calls it S.
fn needed(focus: &Focus<'_>) -> f64 {
    (focus.aliasing_lower_bound(&sizes()) * f64::from(MAP) / f64::from(IMAGE)).powi(2)
}

/// `docs/design.md`, section 8: S = ln(f/n)/2T for light at right angles to the view with all of V as receivers.
#[test]
fn light_from_overhead() {
    for far in [10.0_f64, 100.0, 1000.0, 1e4] {
        for (tangent, aspect) in [(0.5_f64, 1.0), (0.2, 1.0), (1.5, 0.7)] {
            let view =
                View::perspective(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 2.0 * tangent.atan(), aspect, 1.0, far)
                    .unwrap();
            let scene = Scene::from_box(DVec3::splat(-4.0 * far), DVec3::splat(4.0 * far)).unwrap();
            let sun = Light::directional(DVec3::Y).unwrap();
            // A frame as wide as `aspect` times its height.
            let exact = far.ln() / (2.0 * tangent) * aspect;
            assert_relative_eq!(needed(&Focus::new(&view, &sun, &scene)), exact, max_relative = 1e-5);
        }
    }
}

/// A floor under a lamp, all of it seen at one scale: ∫ h/|X − l| dA over a rectangle.
#[test]
fn lamps_over_floors_have_a_closed_form() {
    // ∫ h/|X| dA over the rectangle from the foot of the perpendicular to (x, y), the lamp h above.
    let quarter = |x: f64, y: f64, h: f64| {
        let r = (x * x + y * y + h * h).sqrt();
        let side = |x: f64, y: f64| x * ((y + r) / x.hypot(h)).ln();
        h * (side(x, y) + side(y, x) - h * (x * y / (h * r)).atan())
    };
    let view = View::orthographic((0.0, 50.0, 0.0), DVec3::NEG_Y, DVec3::X, 40.0, 1.0, 1.0, 100.0).unwrap();
    for (half, height) in [((20.0, 1.0), 3.0), ((5.0, 7.0), 0.2), ((1.0, 1.0), 30.0)] {
        let (x, y) = half;
        let scene = Scene::from_box((-x, 0.0, -y), (x, 0.0, y)).unwrap();
        for foot in [(0.0, 0.0), (0.3 * x, -0.8 * y)] {
            let light = Light::point((foot.0, height, foot.1), 0.001, f64::INFINITY).unwrap();
            let (left, right, back, front) = (x + foot.0, x - foot.0, y + foot.1, y - foot.1);
            let area: f64 = [(left, back), (left, front), (right, back), (right, front)]
                .map(|(x, y)| quarter(x, y, height))
                .iter()
                .sum();
            // The image shows 80 m.
            assert_relative_eq!(
                needed(&Focus::new(&view, &light, &scene)),
                area / 80.0_f64.powi(2),
                max_relative = 1e-5
            );
        }
    }
}

/// A floor at one depth, under the sun: its area across the rays over a pixel's.
#[test]
fn a_floor_seen_from_straight_above_counts_by_the_square_of_its_depth() {
    let sun = Light::directional((0.6, 0.8, 0.0)).unwrap();
    for depth in [10.0, 25.0, 300.0] {
        let view = View::perspective((0.0, depth, 0.0), DVec3::NEG_Y, DVec3::X, 2.0, 1.5, 0.1, 1e3).unwrap();
        let scene = Scene::from_box((-2.0, 0.0, -3.0), (2.0, 0.0, 3.0)).unwrap();
        let shown = 2.0 * 1.0_f64.tan() * depth;
        // 24 m², of which the sun sees 0.8.
        let exact = 24.0 * 0.8 / (shown * shown);
        assert_relative_eq!(needed(&Focus::new(&view, &sun, &scene)), exact, max_relative = 1e-5);
    }
}

#[test]
fn nothing_visible_and_nothing_across_the_light_need_no_texels() {
    let view = View::perspective(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 1.0, 1.0, 1.0, 100.0).unwrap();
    let sun = Light::directional(DVec3::X).unwrap();
    let behind = Scene::from_box((-1.0, -1.0, 5.0), (1.0, 1.0, 9.0)).unwrap();
    let edge_on = Scene::from_box((-1.0, -1.0, -9.0), (1.0, -1.0, -5.0)).unwrap();
    let wire = Scene::from_box((-1.0, -1.0, -9.0), (1.0, -1.0, -9.0)).unwrap();
    for scene in [behind, edge_on, wire] {
        assert_eq!(Focus::new(&view, &sun, &scene).aliasing_lower_bound(&sizes()), 0.0);
    }
}

#[test]
fn it_goes_with_pixels_over_texels() {
    let view =
        View::perspective((0.0, 1.7, 0.0), (0.3, -0.1, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.3, 120.0).unwrap();
    let scene = Scene::from_box((-20.0, 0.0, -40.0), (20.0, 4.0, 10.0)).unwrap();
    let focus = Focus::new(&view, &Light::directional((0.3, 1.0, 0.4)).unwrap(), &scene);
    let limit = |texels, pixels| focus.aliasing_lower_bound(&Settings::new(texels, pixels).unwrap());
    // Only how many texels there are matters.
    let of_sides = |width, height| focus.aliasing_lower_bound(&sizes().with_map_sides(width, height).unwrap());
    assert_eq!([of_sides(4096, 1024), of_sides(512, 8192)], [limit(MAP, IMAGE); 2]);
    assert_eq!(limit(1024, 1080), 2.0 * limit(2048, 1080));
    assert_eq!(limit(1024, 2160), 2.0 * limit(1024, 1080));
}

/// What the limit's integral is by rays at random: each with the most that it has of any point in R, and how far that may be
/// off, one standard deviation.
fn by_rays(focus: &Focus<'_>, count: u32) -> (f64, f64) {
    let (view, body) = (focus.view(), focus.receiver_volume());
    let planes: Vec<_> = body.planes().collect();
    let mut random = StdRng::seed_from_u64(5);
    let mut part = || random.random_range(0.0..1.0);
    let (position, l) = (focus.light().position(), focus.light().homogeneous().truncate());
    // Rays of the sun through a disk across them around R, those of a lamp through the whole sphere or the cone around R.
    let centre = body.vertices().iter().sum::<DVec3>() / body.vertices().len() as f64;
    let radius = body.vertices().iter().map(|&vertex| vertex.distance(centre)).fold(0.0, f64::max);
    let axis = position.map_or(-l, |position| (centre - position).normalize());
    let (u, v) = axis.any_orthonormal_pair();
    let cosine = position.map_or(1.0, |position| {
        let least =
            body.vertices().iter().map(|&vertex| (vertex - position).normalize().dot(axis)).fold(1.0, f64::min);
        if least > 0.0 { least } else { -1.0 }
    });
    let all = if position.is_some() { TAU * (1.0 - cosine) } else { 0.5 * TAU * radius * radius };
    let (mut sum, mut squares) = (0.0, 0.0);
    for _ in 0..count {
        let (turn, height) = (TAU * part(), part());
        let across = u * turn.cos() + v * turn.sin();
        let (from, ray) = match position {
            None => (centre + across * (radius * height.sqrt()), axis),
            Some(position) => {
                let along = 1.0 - (1.0 - cosine) * height;
                (position, axis * along + across * (1.0 - along * along).max(0.0).sqrt())
            }
        };
        let (mut first, mut last) = (if position.is_some() { 0.0 } else { f64::NEG_INFINITY }, f64::INFINITY);
        for plane in &planes {
            let (at, slope) = (plane.at(from), plane.normal.dot(ray));
            if slope > 0.0 {
                first = first.max(-at / slope);
            } else if slope < 0.0 {
                last = last.min(-at / slope);
            } else if at < 0.0 {
                last = f64::NEG_INFINITY;
            }
        }
        if first < last {
            let most = (0..=8).map(|step| {
                let reach = first + (last - first) * f64::from(step) / 8.0;
                let shown = 2.0 * view.half_height(view.depth(from + ray * reach));
                if position.is_some() { (reach / shown).powi(2) } else { shown.powi(-2) }
            });
            let most = all * most.fold(0.0, f64::max);
            (sum, squares) = (sum + most, squares + most * most);
        }
    }
    let mean = sum / f64::from(count);
    (mean, ((squares / f64::from(count) - mean * mean) / f64::from(count)).sqrt())
}

/// A light of any kind about a view of a box, both lenses; depths far enough apart to matter and not so far that only one
/// ray in a thousand counts.
fn seen() -> impl Strategy<Value = (View, Light, [DVec3; 2])> {
    let point = |reach: f64| prop::array::uniform3(-reach..reach).prop_map(DVec3::from);
    let view = (point(5.0), point(1.0), any::<bool>(), 1.0..3.0, 5.0..30.0).prop_filter_map(
        "a view",
        |(eye, forward, perspective, near, far)| {
            let view = if perspective {
                View::perspective(eye, forward, DVec3::new(0.1, 1.0, 0.2), 1.2, 1.3, near, far)
            } else {
                View::orthographic(eye, forward, DVec3::new(0.1, 1.0, 0.2), 4.0, 1.3, near, far)
            };
            view.ok()
        },
    );
    let light = (point(15.0), point(1.0), 0..3).prop_filter_map("a light", |(at, axis, kind)| {
        let light = match kind {
            0 => Light::directional(at),
            1 => Light::point(at, 0.1, 60.0),
            _ => Light::spot(at, axis, 1.1, 0.1, 60.0),
        };
        light.ok()
    });
    let corners = (point(8.0), point(8.0)).prop_map(|(a, b)| [a.min(b), a.max(b)]);
    (view, light, corners)
}

/// Five standard deviations, and one in a hundred thousand of quadrature.
#[test]
fn it_is_the_integral_over_rays() {
    run(300, &seen(), |(view, light, [low, high])| {
        let scene = Scene::from_box(low, high).unwrap();
        let focus = Focus::new(&view, &light, &scene);
        if focus.receiver_volume().volume() < 1e-3 {
            return;
        }
        let (mean, deviation) = by_rays(&focus, 20_000);
        let found = needed(&focus);
        if deviation < 0.05 * mean {
            assert!((found - mean).abs() <= 5.0 * deviation + 1e-5 * mean, "{found}, {mean} ± {deviation}");
        }
    });
}

/// It is a limit: no map whatever is better.
#[test]
fn no_map_has_less_aliasing() {
    run(3000, &(case(), settings()), |(case, settings)| {
        let together = Together::of(&case);
        let focus = together.focus();
        if let Some(map) = focus.fit(&settings).map() {
            let (limit, found) = (focus.aliasing_lower_bound(&settings), map.aliasing_over(&focus).unwrap());
            // Quadrature.
            assert!(limit <= found.upper_bound * (1.0 + 1e-5), "{limit}, {found:?}");
        }
    });
}

/// The survey's views: someone standing in a town and looking around, under a sun between 6° and 86° high.
#[test]
fn outdoor_views_are_above_the_limit() {
    let mut random = StdRng::seed_from_u64(1);
    let scene = outdoors::town();
    let maps = [sizes().with_warp(Warp::Uniform), sizes().with_shift(Shift::None), sizes()];
    let (mut limits, mut ratios, mut missed) = (Vec::new(), [const { Vec::new() }; 3], [0.0_f64; 3]);
    for _ in 0..500 {
        let (view, sun) = (outdoors::view(&mut random), outdoors::Kind::Sun.light(&mut random));
        let focus = Focus::new(&view, &sun, &scene);
        let limit = focus.aliasing_lower_bound(&sizes());
        limits.push(limit);
        for ((settings, ratios), missed) in maps.iter().zip(&mut ratios).zip(&mut missed) {
            let map = focus.fit(settings).into_map().unwrap();
            let found = map.aliasing_over(&focus).unwrap();
            assert!(found.upper_bound >= limit, "{found:?}, {limit}");
            ratios.push(found.worst / limit);
            *missed = missed.max(found.worst / map.report(&focus).aliasing - 1.0);
        }
    }
    println!("                       10 %    25 %    50 %    75 %    90 %");
    for (name, values) in ["limit", "uniform/limit", "PSM/limit", "PSM shifted/limit"]
        .iter()
        .zip([&mut limits].into_iter().chain(&mut ratios))
    {
        values.sort_by(f64::total_cmp);
        let at = |part: f64| values[((values.len() - 1) as f64 * part) as usize];
        println!("{name:20} {:7.3?}", [0.1, 0.25, 0.5, 0.75, 0.9].map(at));
    }
    println!("more inside of R than at its vertices, at most: {missed:.3?}");
}
