//! What a paraboloid map makes of straight edges, which it draws straight.

use glam::DVec3;
use shadowfit::{Settings, omni::Paraboloid};
use std::f64::consts::{FRAC_PI_2, TAU};

use super::{both, direction_about, from_light};
use testkit::arbitrary::Numbers;
use testkit::claims::paraboloid::texels_per_unit;

/// A part of a straight edge: where it is drawn, the point of the edge whose part it is, and where that should be.
struct Fragment {
    drawn: DVec3,
    point: DVec3,
    exact: DVec3,
}

fn fragment(map: &Paraboloid, [a, b]: [DVec3; 2], part: f64) -> Option<Fragment> {
    let [from, to] = [map.project(a)?, map.project(b)?];
    let [g, h] = [(a, from), (b, to)]
        .map(|(point, place)| (1.0 + place.truncate().length_squared()) / point.distance(map.position()));
    let (g, h) = ((1.0 - part) * g, part * h);
    let point = a + (b - a) * (h / (g + h));
    Some(Fragment { drawn: from.lerp(to, part), point, exact: map.project(point)? })
}

/// Edges near and across the rim, with ends at any two distances.
fn edges(map: &Paraboloid, angle: f64, count: usize) -> Vec<[DVec3; 2]> {
    let mut numbers = Numbers(5);
    let mut all = Vec::new();
    while all.len() < count {
        let first = direction_about(&mut numbers);
        let across = direction_about(&mut numbers).cross(first);
        let (Some(across), true) = (across.try_normalize(), first.z > -angle.sin()) else { continue };
        let second = first * angle.cos() + across * angle.sin();
        let mut distance = || 10_f64.powf(3.0 * numbers.part() - 1.0);
        let ends = [first, second].map(|local| map.position() + from_light(map, local) * distance());
        all.push(ends);
    }
    all
}

#[test]
fn straight_edges_are_drawn_no_farther_off_than_said() {
    for settings in [Settings::default(), Settings::new(256, 1080).and_then(|s| s.with_border(9)).expect("sound")] {
        let [map, _] = both(&settings);
        for angle in [1e-3, 0.02, 0.0884, 0.3, 0.8, FRAC_PI_2] {
            let (mut most, mut most_depth): (f64, f64) = (0.0, 0.0);
            let said = map.edge_error(angle);
            for ends in edges(&map, angle, 20_000) {
                let inside = ends.iter().all(|&end| map.clip_plane().at(end) >= 0.0);
                for part in [0.1, 0.3, 0.5, 0.8] {
                    let Some(Fragment { drawn, point, exact }) = fragment(&map, ends, part) else { continue };
                    if map.clip_plane().at(point) < 0.0 {
                        continue;
                    }
                    let off = (drawn - exact).truncate().length() * texels_per_unit(&settings);
                    // Places near 1 are rounded, and so is the point.
                    let rounding = 64.0 * f64::EPSILON * texels_per_unit(&settings);
                    most = most.max(off / said);
                    assert!(off <= said + rounding, "{angle}: {ends:?} at {part}: {off}, said {said}");
                    if inside {
                        let range = map.far() - map.near();
                        let off = (drawn - exact).z.abs() * range;
                        let said = map.edge_depth_error(ends[0], ends[1]);
                        let rounding = 64.0 * f64::EPSILON * (range + point.distance(map.position()) + 1e3);
                        most_depth = most_depth.max(off / said);
                        assert!(off <= said + rounding, "{angle}: {ends:?} at {part}: {off}, said {said}");
                    }
                }
            }
            assert!(most > 0.9, "{angle}: {most}");
            assert!(most_depth > 0.9, "{angle}: {most_depth}");
            // And along the rim it gets there, in depth too.
            let (sine, cosine) = (0.5 * angle).sin_cos();
            let ends = [sine, -sine].map(|x| map.position() + from_light(&map, DVec3::new(x, cosine, 0.0)) * 3.0);
            let Fragment { drawn, exact, .. } = fragment(&map, ends, 0.5).expect("before the light");
            let off = (drawn - exact).truncate().length() * texels_per_unit(&settings);
            assert!((off / said - 1.0).abs() <= 1e-8, "{off} {said}");
            let off = (drawn - exact).z * (map.far() - map.near());
            let said = map.edge_depth_error(ends[0], ends[1]);
            assert!((off / said - 1.0).abs() <= 1e-6, "{off} {said}");
            assert!((said / (3.0 * 2.0 * (0.25 * angle).sin().powi(2)) - 1.0).abs() <= 1e-6);
        }
    }
}

#[test]
fn the_insides_of_triangles_are_off_by_four_thirds_of_that() {
    let [map, _] = both(&Settings::default());
    let mut numbers = Numbers(6);
    let mut most: f64 = 0.0;
    for _ in 0..20_000 {
        let angle: f64 = 0.1;
        let middle = direction_about(&mut numbers);
        let (across, up) = middle.any_orthonormal_pair();
        let turn = TAU * numbers.part();
        let reach = (2.0 / 3_f64.sqrt() * (0.5 * angle).sin()).asin();
        let corners = [0.0, 1.0, 2.0].map(|third| {
            let (y, x) = (turn + third / 3.0 * TAU).sin_cos();
            map.position() + from_light(&map, middle * reach.cos() + (across * x + up * y) * reach.sin())
        });
        if corners.iter().any(|&corner| map.clip_plane().at(corner) < 0.0) {
            continue;
        }
        let places = corners.map(|corner| map.project(corner).expect("before the light").truncate());
        let drawn = (places[0] + places[1] + places[2]) / 3.0;
        let weights = places.map(|place| 1.0 + place.length_squared());
        let point = corners.iter().zip(weights).map(|(corner, weight)| corner * weight).sum::<DVec3>();
        let point = point / weights.iter().sum::<f64>();
        let exact = map.project(point).expect("before the light").truncate();
        most = most.max((drawn - exact).length() * texels_per_unit(map.settings()) / map.edge_error(angle));
    }
    // 4/3 to the first order in the angle squared.
    assert!(most <= 4.0 / 3.0 * (1.0 + 0.1 * 0.1) && most > 1.2, "{most}");
}

#[test]
fn the_largest_edge_is_the_inverse_of_its_error() {
    let [map, _] = both(&Settings::new(1024, 1080).and_then(|s| s.with_border(0)).expect("sound"));
    for texels in [1e-3, 0.25, 0.5, 1.0, 3.0, 20.0] {
        let angle = map.largest_edge(texels);
        assert!((map.edge_error(angle) / texels - 1.0).abs() <= 1e-12, "{texels}");
        // α = 2 arccos(1 − 2ε/N).
        assert!((angle - 2.0 * (1.0 - texels / 512.0).acos()).abs() <= 1e-9, "{texels}");
    }
    assert!((map.largest_edge(1e9) - FRAC_PI_2).abs() <= 1e-15);
    for texels in [0.0, -1.0, f64::NAN, f64::NEG_INFINITY] {
        assert_eq!(map.largest_edge(texels), 0.0);
    }
}

/// It was a step above one, which the refiner does not take.
#[test]
fn the_largest_edge_is_no_more_than_a_right_angle() {
    let [map, _] = both(&Settings::default());
    for texels in [1e9, f64::INFINITY, f64::MAX] {
        let angle = map.largest_edge(texels);
        assert!(angle <= FRAC_PI_2, "{angle:?}");
        #[cfg(feature = "spade")]
        assert!(shadowfit::mesh::Tessellator::new(map.position(), map.near(), angle).is_ok());
    }
}
