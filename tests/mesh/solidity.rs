//! Which meshes are solids, which are inside out, and which are sheets.

use glam::{DMat3, DMat4, DVec3, Vec3};
use proptest::prelude::*;
use shadowfit::{
    input::{InputErrorKind, MAX_COORDINATE},
    mesh::{Solidity, SolidityReport},
};

use testkit::arbitrary::{Numbers, rotation, run};

type Triangles = Vec<[DVec3; 3]>;

/// Every corner with a position of its own, as a mesh with flat normals has it.
fn report(triangles: &[[DVec3; 3]]) -> SolidityReport {
    let positions = triangles.as_flattened();
    let indices: Vec<[u32; 3]> = (0..triangles.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    Solidity::of(positions, &indices).expect("sound")
}

fn quad([a, b, c, d]: [DVec3; 4]) -> [[DVec3; 3]; 2] {
    [[a, b, c], [a, c, d]]
}

/// A box around a middle, its fronts outwards.
fn cuboid(middle: DVec3, half: f64) -> Triangles {
    let corner = |bits: u32| {
        let end = |bit: u32| if bits >> bit & 1 == 1 { half } else { -half };
        middle + DVec3::new(end(0), end(1), end(2))
    };
    let sides = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    sides.into_iter().flat_map(|side| quad(side.map(corner))).collect()
}

fn turned_round(triangles: &[[DVec3; 3]]) -> Triangles {
    triangles.iter().map(|&[a, b, c]| [a, c, b]).collect()
}

/// A grid of squares of side 1 that bends as `height` says.
fn grid(side: i32, height: impl Fn(f64, f64) -> f64) -> Triangles {
    let at = |x: i32, y: i32| DVec3::new(f64::from(x), height(f64::from(x), f64::from(y)), f64::from(y));
    let square = |x: i32, y: i32| quad([at(x, y), at(x, y + 1), at(x + 1, y + 1), at(x + 1, y)]);
    (0..side).flat_map(|y| (0..side).map(move |x| (x, y))).flat_map(|(x, y)| square(x, y)).collect()
}

#[test]
fn a_box_is_solid_whichever_corners_its_faces_share() {
    let found = report(&cuboid(DVec3::new(3.0, -1.0, 7.0), 1.0));
    let solid = SolidityReport {
        solidity: Solidity::Watertight,
        parts: 1,
        reversed_parts: 0,
        boundary_edges: 0,
        inconsistent_edges: 0,
        crowded_edges: 0,
        unbalanced_edges: 0,
        without_area: 0,
        sheet: None,
    };
    assert_eq!(found, solid);
}

#[test]
fn a_box_with_its_fronts_inwards_is_inside_out() {
    assert_eq!(report(&turned_round(&cuboid(DVec3::ONE, 2.0))).solidity, Solidity::Inverted);
}

#[test]
fn a_box_without_a_triangle_is_open() {
    let found = report(&cuboid(DVec3::ZERO, 1.0)[1..]);
    assert_eq!((found.solidity, found.boundary_edges, found.unbalanced_edges), (Solidity::Open, 3, 3));
    let sheet = found.sheet.expect("open");
    assert!(!sheet.is_flat && (sheet.bend - std::f64::consts::SQRT_2).abs() < 1e-12, "{sheet:?}");
}

#[test]
fn a_box_with_a_triangle_turned_round_is_open() {
    let mut triangles = cuboid(DVec3::ZERO, 1.0);
    triangles[4].swap(0, 1);
    let found = report(&triangles);
    assert_eq!((found.solidity, found.inconsistent_edges, found.boundary_edges), (Solidity::Open, 3, 0));
}

#[test]
fn a_cavity_belongs_to_its_solid() {
    let mut hollow = cuboid(DVec3::ZERO, 2.0);
    hollow.extend(turned_round(&cuboid(DVec3::ZERO, 1.0)));
    let found = report(&hollow);
    assert_eq!((found.solidity, found.parts, found.reversed_parts), (Solidity::Watertight, 2, 0));
    assert_eq!(report(&turned_round(&hollow)).solidity, Solidity::Inverted);
}

#[test]
fn a_part_inside_out_beside_the_others_makes_all_of_it_open() {
    let mut pair = cuboid(DVec3::ZERO, 2.0);
    pair.extend(turned_round(&cuboid(5.0 * DVec3::X, 1.0)));
    let found = report(&pair);
    assert_eq!((found.solidity, found.reversed_parts, found.unbalanced_edges), (Solidity::Open, 1, 0));
}

#[test]
fn boxes_that_touch_along_an_edge_or_a_face_are_solid() {
    for offset in [DVec3::new(2.0, 2.0, 0.0), DVec3::new(2.0, 0.0, 0.0)] {
        let mut pair = cuboid(DVec3::ZERO, 1.0);
        pair.extend(cuboid(offset, 1.0));
        let found = report(&pair);
        assert_eq!((found.solidity, found.parts), (Solidity::Watertight, 1), "{offset}");
        assert!(found.crowded_edges > 0 && found.unbalanced_edges == 0, "{found:?}");
    }
}

#[test]
fn a_triangle_without_area_closes_a_t_junction() {
    // One face is cut at the middle of an edge that its neighbour has whole.
    let corners = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
    let middle = 0.5 * (corners[1] + corners[2]);
    let mut cracked = vec![
        [corners[0], corners[2], corners[1]],
        [corners[0], corners[1], corners[3]],
        [corners[0], corners[3], corners[2]],
        [corners[1], middle, corners[3]],
        [middle, corners[2], corners[3]],
    ];
    assert_eq!(report(&cracked).solidity, Solidity::Open);
    cracked.push([corners[1], corners[2], middle]);
    let found = report(&cracked);
    assert_eq!((found.solidity, found.without_area), (Solidity::Watertight, 1));
    cracked.push([corners[1], corners[1], corners[3]]);
    assert_eq!((report(&cracked).solidity, report(&cracked).without_area), (Solidity::Watertight, 2));
}

#[test]
fn faces_back_to_back_enclose_nothing() {
    let mut leaf = quad([DVec3::ZERO, DVec3::X, DVec3::X + DVec3::Y, DVec3::Y]).to_vec();
    leaf.extend(turned_round(&leaf));
    let found = report(&leaf);
    assert_eq!((found.solidity, found.unbalanced_edges), (Solidity::Open, 0));
    assert!(found.sheet.expect("open").is_flat, "{found:?}");
}

#[test]
fn a_band_with_a_twist_is_open() {
    let strip: Vec<[DVec3; 2]> = (0..24)
        .map(|i| {
            let turn = std::f64::consts::TAU * f64::from(i) / 24.0;
            let outwards = DVec3::new(turn.cos(), 0.0, turn.sin());
            let across = outwards * (0.5 * turn).cos() + DVec3::Y * (0.5 * turn).sin();
            [3.0 * outwards - across, 3.0 * outwards + across]
        })
        .collect();
    let band: Triangles = (0..24)
        .flat_map(|i| {
            let ([a, b], [c, d]) = (strip[i], strip[(i + 1) % 24]);
            quad(if i == 23 { [a, b, c, d] } else { [a, b, d, c] })
        })
        .collect();
    let found = report(&band);
    assert_eq!(found.solidity, Solidity::Open);
    assert!(!found.sheet.expect("open").is_flat);
}

#[test]
fn sheets_are_flat_where_they_are_flat_and_bent_where_they_are_bent() {
    let flat = |triangles: &[[DVec3; 3]]| report(triangles).sheet.expect("open");
    let plane = flat(&grid(9, |x, y| 0.25 * x - 0.5 * y));
    assert!(plane.is_flat && plane.bend < 1e-15, "{plane:?}");
    // In f32, moved and turned, it is flat to what f32 can tell.
    let turned = DMat4::from_translation(DVec3::new(300.0, -40.0, 77.0)) * DMat4::from_rotation_x(0.7);
    let rounded: Triangles = grid(9, |x, y| 0.3 * x - 0.7 * y)
        .into_iter()
        .map(|triangle| triangle.map(|p| turned.transform_point3(p).as_vec3().as_dvec3()))
        .collect();
    let rounded = flat(&rounded);
    assert!(rounded.is_flat && rounded.bend < 1e-3, "{rounded:?}");
    // A roof of two planes, 45° each, and a bowl that no single edge of shows much of.
    let roof = flat(&grid(4, |x, _| -(x - 2.0).abs()));
    assert!(!roof.is_flat && (roof.bend - std::f64::consts::SQRT_2).abs() < 1e-12, "{roof:?}");
    let bowl = flat(&grid(100, |x, y| 1e-5 * (x * x + y * y)));
    assert!(!bowl.is_flat && bowl.bend < 1e-4, "{bowl:?}");
    // Flat parts in different planes are flat.
    let mut shelves = grid(2, |_, _| 0.0);
    shelves.extend(grid(2, |x, _| 5.0 + x));
    assert!(flat(&shelves).is_flat);
}

#[test]
fn zero_and_minus_zero_are_one_place() {
    let mut triangles = cuboid(DVec3::ONE, 1.0);
    for triangle in [3, 7] {
        triangles[triangle] = triangles[triangle].map(|corner| corner.map(|x| if x == 0.0 { -0.0 } else { x }));
    }
    assert_eq!(report(&triangles).solidity, Solidity::Watertight);
}

#[test]
fn positions_may_be_single_precision_and_others_may_lie_beside() {
    let corners = [Vec3::NAN, Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z, Vec3::INFINITY];
    let found = Solidity::of(&corners, &[[1, 3, 2], [1, 2, 4], [1, 4, 3], [2, 3, 4]]);
    assert_eq!(found.map(|report| report.solidity), Ok(Solidity::Watertight));
}

#[test]
fn what_is_no_mesh_is_refused() {
    let refused = |field, problem| Err((field, problem));
    let solidity_of = |positions: &[DVec3], triangles: &[[u32; 3]]| {
        Solidity::of(positions, triangles).map_err(|error| (error.field, error.problem))
    };
    let square = [DVec3::ZERO, DVec3::X, DVec3::Y];
    assert_eq!(solidity_of(&square, &[]), refused("triangles", InputErrorKind::Empty));
    assert_eq!(solidity_of(&square, &[[0, 1, 3]]), refused("triangles", InputErrorKind::OutOfRange));
    let broken = [DVec3::ZERO, DVec3::X, DVec3::new(0.0, f64::NAN, 0.0)];
    assert_eq!(solidity_of(&broken, &[[0, 1, 2]]), refused("positions", InputErrorKind::NotFinite));
    let far = [DVec3::ZERO, DVec3::X, DVec3::Y * 2.0 * MAX_COORDINATE];
    assert_eq!(solidity_of(&far, &[[0, 1, 2]]), refused("positions", InputErrorKind::TooLarge));
}

/// A ball whose corners are pushed about, so that it is no longer convex; its radius is at least a half.
fn pebble(seed: u64) -> Triangles {
    let (rings, sides) = (6, 9);
    let mut numbers = Numbers(seed);
    let radii: Vec<f64> = (0..(rings + 1) * sides).map(|_| 0.5 + numbers.part()).collect();
    let at = |ring: usize, side: usize| {
        let side = if ring == 0 || ring == rings { 0 } else { side % sides };
        let (polar, turn) = (std::f64::consts::PI * ring as f64 / rings as f64, 0.7 * side as f64);
        radii[ring * sides + side] * DVec3::new(polar.sin() * turn.cos(), polar.cos(), polar.sin() * turn.sin())
    };
    let square =
        |ring, side| quad([at(ring, side), at(ring, side + 1), at(ring + 1, side + 1), at(ring + 1, side)]);
    (0..rings).flat_map(|ring| (0..sides).map(move |side| (ring, side))).flat_map(|(r, s)| square(r, s)).collect()
}

/// Order, corners first named, place, turn and size make no difference, a mirror exchanges the two kinds of solids, and
/// without any one triangle that has an area nothing is solid.
#[test]
fn solids_stay_what_they_are_however_they_are_stored() {
    let mirror = DMat3::from_diagonal(DVec3::new(-1.0, 1.0, 1.0));
    let cases = &(any::<u64>(), rotation(), -6..6_i32, any::<[f32; 3]>(), any::<bool>());
    run(400, cases, |(seed, turn, scale, offset, mirrored)| {
        let linear = DMat3::from_quat(turn) * f64::from(scale).exp2();
        let linear = if mirrored { linear * mirror } else { linear };
        let offset = DVec3::from(offset.map(|x| if x.is_finite() { f64::from(x) % 1e3 } else { 0.0 }));
        let mut numbers = Numbers(!seed);
        let mut triangles: Triangles = pebble(seed)
            .into_iter()
            .map(|mut triangle| {
                triangle.rotate_left((3.0 * numbers.part()) as usize);
                triangle.map(|corner| linear * corner + offset)
            })
            .collect();
        triangles.sort_by(|a, b| a[0].x.total_cmp(&b[0].x));
        let found = report(&triangles);
        let expected = if mirrored { Solidity::Inverted } else { Solidity::Watertight };
        assert_eq!((found.solidity, found.parts), (expected, 1), "{found:?}");

        let gone = (numbers.part() * triangles.len() as f64) as usize;
        let [a, b, c] = triangles.remove(gone);
        if a != b && b != c && c != a {
            assert_eq!(report(&triangles).solidity, Solidity::Open);
        }
    });
}
