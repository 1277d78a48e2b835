//! The refiner: every edge within its angle, what was closed closed, what was covered covered, and an end to it on any input.

use glam::DVec3;
use proptest::prelude::*;
use shadowfit::{
    Focus, Light, Scene, Settings, View,
    input::InputErrorKind,
    mesh::{Tessellation, Tessellator},
    omni::Paraboloid,
};
use std::collections::HashMap;
use std::time::{Duration, Instant};
use testkit::arbitrary::{Numbers, number_bits, run};

/// A mesh: positions and triangles.
type Mesh = (Vec<DVec3>, Vec<[u32; 3]>);

/// A box with shared vertices, its outside counter-clockwise.
fn closed_box(min: DVec3, max: DVec3) -> Mesh {
    let corner = |i: u32| DVec3::select(glam::BVec3::new(i & 1 > 0, i & 2 > 0, i & 4 > 0), max, min);
    let faces = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let triangles = faces.into_iter().flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    ((0..8).map(corner).collect(), triangles)
}

/// The same with vertices of its own for every triangle.
fn apart((positions, triangles): &Mesh) -> Mesh {
    let own = triangles.iter().flatten().map(|&index| positions[index as usize]).collect();
    (own, (0..triangles.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect())
}

/// All positions of a refined mesh.
fn all_positions(mesh: &Mesh, refined: &Tessellation) -> Vec<DVec3> {
    mesh.0.iter().copied().chain(refined.added.iter().map(|added| added.position)).collect()
}

fn area_vector(positions: &[DVec3], triangle: &[u32; 3]) -> DVec3 {
    let [a, b, c] = triangle.map(|index| positions[index as usize]);
    (b - a).cross(c - a) * 0.5
}

/// How often each directed edge is there, by the bits of its ends.
fn edges(positions: &[DVec3], triangles: &[[u32; 3]]) -> HashMap<[[u64; 3]; 2], i32> {
    let mut count = HashMap::new();
    for [a, b, c] in triangles {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            let ends =
                [from, to].map(|&index| (positions[index as usize] + DVec3::ZERO).to_array().map(f64::to_bits));
            *count.entry(ends).or_insert(0) += 1;
        }
    }
    count
}

/// Whether every edge has as many triangles on one side as on the other: no hole and no T-junction.
fn is_closed(positions: &[DVec3], triangles: &[[u32; 3]]) -> bool {
    let edges = edges(positions, triangles);
    edges.iter().all(|([from, to], count)| from == to || edges.get(&[*to, *from]) == Some(count))
}

fn angle(light: DVec3, a: DVec3, b: DVec3) -> f64 {
    let (a, b) = (a - light, b - light);
    a.cross(b).length().atan2(a.dot(b))
}

/// All that must hold of a refined mesh; the largest angle of its edges that may cast.
fn check(mesh: &Mesh, refined: &Tessellation, light: DVec3, near: f64, most: f64) -> f64 {
    let (positions, triangles) = mesh;
    let all = all_positions(mesh, refined);
    let mut largest: f64 = 0.0;
    assert_eq!(refined.triangles.len(), refined.sources.len());
    let mut areas = vec![DVec3::ZERO; triangles.len()];
    let mut parts = vec![0; triangles.len()];
    for (triangle, &source) in refined.triangles.iter().zip(&refined.sources) {
        let [a, b, c] = triangle.map(|index| all[index as usize]);
        for (a, b) in [(a, b), (b, c), (c, a)] {
            if a.distance(light) >= near || b.distance(light) >= near {
                largest = largest.max(angle(light, a, b));
            }
        }
        let whole = area_vector(positions, &triangles[source as usize]);
        let part = area_vector(&all, triangle);
        // A part keeps its side but for the rounding of its corners.
        let size = [a, b, c].iter().map(|p| p.length()).fold(0.0, f64::max);
        let extent = (b - a).length() + (c - a).length();
        assert!(part.dot(whole) >= -1e-14 * size * extent * whole.length(), "{triangle:?} of {source} is turned");
        areas[source as usize] += part;
        parts[source as usize] += 1;
    }
    assert!(largest <= most * (1.0 + 1e-9), "an edge of {largest} instead of {most}");
    for (source, triangle) in triangles.iter().enumerate() {
        let [a, b, c] = triangle.map(|index| positions[index as usize]);
        let whole = area_vector(positions, triangle);
        let size = [a, b, c].iter().map(|p| p.length()).fold(0.0, f64::max);
        let extent = (b - a).length() + (c - a).length();
        let rounding = 1e-15 * size * extent * f64::from(parts[source]).sqrt() + 1e-12 * whole.length();
        assert!((areas[source] - whole).length() <= 8.0 * rounding, "triangle {source}: {} {whole}", areas[source]);
        // What needs no cut is left as it is.
        let short = |a: DVec3, b: DVec3| {
            angle(light, a, b) <= most * (1.0 - 1e-9) || a.distance(light) < near && b.distance(light) < near
        };
        if short(a, b) && short(b, c) && short(c, a) {
            let first = refined.sources.iter().position(|&other| other as usize == source).expect("it is there");
            assert_eq!(parts[source], 1);
            let mut same = refined.triangles[first];
            while same != *triangle {
                same.rotate_left(1);
                assert_ne!(same, refined.triangles[first], "{triangle:?} has other corners");
            }
        }
    }
    for added in &refined.added {
        let sum: f64 = added.weights.iter().sum();
        assert_eq!(sum, 1.0);
        assert!(added.weights.iter().all(|weight| (0.0..1.0).contains(weight)));
        let corners = added.corners.map(|index| positions[index as usize]);
        let mixed: DVec3 = corners.iter().zip(added.weights).map(|(corner, weight)| corner * weight).sum();
        let size = corners.iter().map(|corner| corner.abs().max_element()).fold(0.0, f64::max);
        assert!((mixed - added.position).length() <= 8.0 * f64::EPSILON * size, "{added:?} is at {mixed}");
    }
    assert_eq!(is_closed(positions, triangles), is_closed(&all, &refined.triangles));
    largest
}

#[test]
fn boxes_stay_closed() {
    let mesh = closed_box(DVec3::new(-5.0, -3.0, -10.0), DVec3::new(5.0, 3.0, 10.0));
    let own = apart(&mesh);
    let mut numbers = Numbers(1);
    for angle in [0.05, 0.1, 0.3, 1.0, 1.57] {
        for _ in 0..8 {
            let part = || numbers.part();
            let [x, y, z] = [(); 3].map({
                let mut part = part;
                move |()| 1.2 * (2.0 * part() - 1.0)
            });
            let light = DVec3::new(5.0 * x, 3.0 * y, 10.0 * z);
            let refiner = Tessellator::new(light, 0.1, angle).expect("sound");
            let [shared, separate] = [&mesh, &own].map(|mesh| {
                let refined = refiner.tessellate(&mesh.0, &mesh.1).expect("it ends");
                check(mesh, &refined, light, 0.1, angle);
                let all = all_positions(mesh, &refined);
                assert!(is_closed(&all, &refined.triangles));
                refined
            });
            // Vertices of their own are cut at the same places.
            assert_eq!(shared.triangles.len(), separate.triangles.len());
            assert!(shared.added.len() < separate.added.len());
        }
    }
}

#[test]
fn no_more_vertices_on_an_edge_than_it_takes() {
    let light = DVec3::new(0.0, 1.0, 0.0);
    let mesh = (vec![DVec3::X * -4.0, DVec3::X * 9.0, DVec3::new(0.0, -1e-3, 0.01)], vec![[0, 1, 2]]);
    for most in [0.01, 0.1, 0.7, 1.5] {
        let refined =
            Tessellator::new(light, 0.1, most).expect("sound").tessellate(&mesh.0, &mesh.1).expect("it ends");
        let on_first = refined.added.iter().filter(|added| added.corners == [0, 1, 1]).count();
        assert_eq!(on_first + 1, (angle(light, mesh.0[0], mesh.0[1]) / most).ceil() as usize);
    }
}

/// Coordinates from a small lattice, so that lights lie on vertices, edges and planes, and triangles without area.
fn lattice_point() -> impl Strategy<Value = DVec3> {
    prop::array::uniform3(-4..=4_i8).prop_map(|point| DVec3::from(point.map(f64::from)))
}

#[test]
fn any_mesh_any_light() {
    let point =
        || prop_oneof![2 => lattice_point(), 1 => prop::array::uniform3(-4.0..4.0_f64).prop_map(DVec3::from)];
    let light = prop_oneof![
        2 => point(),
        // A few roundings or a small step from the lattice.
        1 => (lattice_point(), prop::array::uniform3(-1.0..1.0_f64), 0..16_i32)
            .prop_map(|(at, by, digits)| at + DVec3::from(by) * 10_f64.powi(-digits)),
    ];
    let mesh =
        (prop::collection::vec(point(), 3..8), prop::collection::vec(prop::array::uniform3(0..8_u32), 1..10));
    let strategy = (mesh, light, 0.06..1.57_f64, prop::sample::select(vec![0.01, 0.1, 1.0]));
    run(400, &strategy, |((positions, triangles), light, angle, near)| {
        let count = positions.len() as u32;
        let triangles: Vec<_> = triangles.into_iter().map(|triangle| triangle.map(|index| index % count)).collect();
        let mesh = (positions, triangles);
        let refined =
            Tessellator::new(light, near, angle).expect("sound").tessellate(&mesh.0, &mesh.1).expect("it ends");
        check(&mesh, &refined, light, near, angle);
    });
}

#[test]
fn hostile_meshes_end() {
    let limit = Duration::from_secs(5);
    let far = shadowfit::input::MAX_COORDINATE;
    let tiny = shadowfit::input::MIN_DISTANCE;
    let plane = [DVec3::new(-1.0, 0.0, -1.0), DVec3::new(0.0, 0.0, 1.0), DVec3::new(1.0, 0.0, -1.0)];
    let lights =
        [DVec3::ZERO, plane[0], plane[0].midpoint(plane[2]), DVec3::Y * 1e-9, DVec3::Y * tiny, DVec3::X * 3.0];
    for scale in [1.0, 1e-6, 1e6, far] {
        for light in lights {
            for near in [tiny, 1e-3, 1.0] {
                for angle in [1e-300, 1e-9, 1e-3, 0.1] {
                    let began = Instant::now();
                    let refiner =
                        Tessellator::new(light * scale.min(1e6), near, angle).expect("sound").with_limit(20_000);
                    match refiner.tessellate(&plane.map(|point| point * scale), &[[0, 1, 2]]) {
                        Ok(refined) => assert!(refined.triangles.len() <= 20_000),
                        Err(error) => {
                            assert_eq!((error.field, error.problem), ("triangles", InputErrorKind::TooMany))
                        }
                    }
                    assert!(began.elapsed() < limit, "{scale} {light} {near} {angle}: {:?}", began.elapsed());
                }
            }
        }
    }
}

#[test]
fn errors_name_the_field() {
    let refused = |light: DVec3, near, angle| {
        let error = Tessellator::new(light, near, angle).expect_err("it is refused");
        (error.field, error.problem)
    };
    assert_eq!(refused(DVec3::NAN, 0.1, 0.1), ("light", InputErrorKind::NotFinite));
    assert_eq!(refused(DVec3::ZERO, 0.0, 0.1), ("near", InputErrorKind::TooSmall));
    for angle in [0.0, -1.0, 1.6, f64::NAN, f64::INFINITY] {
        assert_eq!(refused(DVec3::ZERO, 0.1, angle), ("angle", InputErrorKind::AngleOutOfRange));
    }
    let refiner = Tessellator::new(DVec3::ZERO, 0.1, 0.1).expect("sound");
    let positions = [DVec3::X, DVec3::Y, DVec3::Z];
    let refused = |refiner: &Tessellator, positions: &[DVec3], triangle| {
        let error = refiner.tessellate(positions, &[triangle]).expect_err("it is refused");
        (error.field, error.problem)
    };
    assert_eq!(refused(&refiner, &positions, [0, 1, 3]), ("triangles", InputErrorKind::OutOfRange));
    assert_eq!(refused(&refiner, &positions, [0, 1, u32::MAX]), ("triangles", InputErrorKind::OutOfRange));
    assert_eq!(
        refused(&refiner, &[DVec3::X, DVec3::NAN, DVec3::Z], [0, 1, 2]),
        ("positions", InputErrorKind::NotFinite)
    );
    assert_eq!(
        refused(&refiner, &[DVec3::X * 1e13, DVec3::Y, DVec3::Z], [0, 1, 2]),
        ("positions", InputErrorKind::TooLarge)
    );
    assert_eq!(refused(&refiner.with_limit(3), &positions, [0, 1, 2]), ("triangles", InputErrorKind::TooMany));
    assert_eq!(
        refiner.tessellate(&[], &[]),
        Ok(Tessellation { added: vec![], triangles: vec![], sources: vec![] })
    );
}

#[test]
fn any_numbers_at_all() {
    let numbers = || prop::array::uniform3(number_bits());
    let strategy = (prop::array::uniform4(numbers()), numbers(), number_bits());
    run(3000, &strategy, |([light, a, b, c], [near, angle, _], _)| {
        if let Ok(refiner) = Tessellator::new(light, near, angle) {
            let _ = refiner.with_limit(2000).tessellate(&[a, b, c].map(DVec3::from), &[[0, 1, 2]]);
        }
    });
}

#[test]
fn a_room_costs_so_many_triangles() {
    let (min, max) = (DVec3::new(-5.0, -3.0, -5.0), DVec3::new(5.0, 3.0, 5.0));
    let mesh = closed_box(min, max);
    let view = View::perspective((0.0, 0.0, 4.0), DVec3::NEG_Z, DVec3::Y, 1.0, 1.5, 0.1, 100.0).expect("sound");
    let light = Light::point(DVec3::ZERO, 0.1, f64::INFINITY).expect("sound");
    let scene = Scene::from_box(min, max).expect("sound");
    let settings = Settings::new(1024, 1080).expect("sound");
    let maps = Focus::new(&view, &light, &scene).paraboloids(&settings);
    let map: &Paraboloid = &maps.maps()[0];
    for texels in [0.5, 1.0] {
        let angle = map.largest_edge(texels);
        let refiner = Tessellator::new(DVec3::ZERO, 0.1, angle).expect("sound");
        let began = Instant::now();
        let refined = refiner.tessellate(&mesh.0, &mesh.1).expect("it ends");
        let took = began.elapsed();
        let largest = check(&mesh, &refined, DVec3::ZERO, 0.1, angle);
        let triangles = refined.triangles.len();
        println!("{texels} texels: {angle:.4}, largest {largest:.4}, {triangles} triangles, {took:?}");
        // Equilateral triangles of that side would cover the sphere this often; a Delaunay triangulation whose longest
        // edges are halved has edges from half of that up, a quarter of the area and no less.
        let least = 4.0 * std::f64::consts::PI / (3_f64.sqrt() / 4.0 * angle * angle);
        assert!((triangles as f64) < 4.0 * least, "{triangles}, {least} at least");
    }
    // 8 by 8 cuts of each wall: an eighth of the wall's middle.
    let cell = angle(DVec3::ZERO, DVec3::new(0.0, 0.0, 5.0), DVec3::new(1.25, 0.75, 5.0));
    println!("8 by 8: 768 triangles, {:.2} texels", map.edge_error(cell));
}
