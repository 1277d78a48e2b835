//! Checks of the vertex enumeration.

use super::random::Random;
use super::shapes::{cuboid, tetrahedron, unit_cube};
use testkit::oracle::body::Body;

/// The vertices in lexicographic order.
fn sorted_vertices(planes: &[[f64; 4]]) -> Vec<[f64; 3]> {
    let mut vertices = Body::from_planes(planes).vertices_f64();
    vertices.sort_by(|a, b| a.partial_cmp(b).expect("vertices are finite"));
    vertices
}

/// The corners of the unit cube in lexicographic order.
fn cube_corners() -> Vec<[f64; 3]> {
    (0..8).map(|bits| [bits >> 2 & 1, bits >> 1 & 1, bits & 1].map(f64::from)).collect()
}

#[test]
fn unit_cube_has_its_corners() {
    assert_eq!(sorted_vertices(&unit_cube()), cube_corners());
}

#[test]
fn redundant_and_duplicate_planes_change_nothing() {
    let mut planes = unit_cube();
    planes.extend(unit_cube());
    planes.extend(unit_cube().iter().map(|plane| plane.map(|x| x * 3.0)));
    // One outside, one touching a face, one touching an edge, one touching a corner.
    planes.push([1.0, 0.25, 0.0, 2.0]);
    planes.push([1.0, 0.0, 0.0, 0.0]);
    planes.push([1.0, 1.0, 0.0, 0.0]);
    planes.push([-1.0, -1.0, -1.0, 3.0]);
    // No plane at all: its half-space is all of space.
    planes.push([0.0, 0.0, 0.0, 1.0]);
    planes.push([0.0; 4]);
    assert_eq!(sorted_vertices(&planes), cube_corners());
}

#[test]
fn tetrahedron_has_its_corners() {
    assert_eq!(
        sorted_vertices(&tetrahedron()),
        [[0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]]
    );
}

#[test]
fn flat_bodies_keep_their_vertices() {
    let flat = sorted_vertices(&cuboid([0.0, 0.0, 0.5], [1.0, 2.0, 0.5]));
    assert_eq!(flat, [[0.0, 0.0, 0.5], [0.0, 2.0, 0.5], [1.0, 0.0, 0.5], [1.0, 2.0, 0.5]]);
    let segment = sorted_vertices(&cuboid([0.0, 1.0, 0.5], [2.0, 1.0, 0.5]));
    assert_eq!(segment, [[0.0, 1.0, 0.5], [2.0, 1.0, 0.5]]);
    let point = sorted_vertices(&cuboid([0.1, 0.2, 0.3], [0.1, 0.2, 0.3]));
    assert_eq!(point, [[0.1, 0.2, 0.3]]);
}

/// A face, an edge and a corner of the cube are what is left when a plane only touches it there.
#[test]
fn touching_planes_leave_a_face_an_edge_or_a_corner() {
    let touched = |plane| {
        let mut planes = unit_cube();
        planes.push(plane);
        sorted_vertices(&planes)
    };
    assert_eq!(touched([-1.0, 0.0, 0.0, 0.0]), cube_corners()[..4]);
    assert_eq!(touched([-1.0, -1.0, 0.0, 0.0]), cube_corners()[..2]);
    assert_eq!(touched([-1.0, -2.0, -3.0, 0.0]), cube_corners()[..1]);
    assert!(touched([-1.0, -2.0, -3.0, -f64::MIN_POSITIVE]).is_empty());
}

#[test]
fn cuts_through_edges_and_corners_are_exact() {
    // The diagonal cut x + y <= 1 passes through two edges.
    let mut planes = unit_cube();
    planes.push([-1.0, -1.0, 0.0, 1.0]);
    assert_eq!(
        sorted_vertices(&planes),
        [[0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [0.0, 1.0, 1.0], [1.0, 0.0, 0.0], [1.0, 0.0, 1.0]]
    );
    // And x + y + z <= 1 through three corners, with the cube's far faces left redundant.
    let mut planes = unit_cube();
    planes.push([-1.0, -1.0, -1.0, 1.0]);
    assert_eq!(sorted_vertices(&planes), sorted_vertices(&tetrahedron()), "the cube's far faces are redundant");
}

#[test]
fn emptiness_is_exact() {
    let gap = |gap: f64| {
        let mut planes = unit_cube();
        planes.push([-1.0, 0.0, 0.0, 0.0 - gap]);
        Body::from_planes(&planes).is_empty()
    };
    assert!(!gap(0.0));
    assert!(gap(1e-300), "beyond the filter's range of components");
    assert!(gap(1e-20));
    assert!(!gap(-1e-300));
    // Empty, though the system also has directions at infinity and whole lines.
    assert!(Body::from_planes(&[[1.0, 0.0, 0.0, -1.0], [-1.0, 0.0, 0.0, 0.0]]).is_empty());
    assert!(Body::from_planes(&[[0.0, 0.0, 0.0, -1.0]]).is_empty());
}

#[test]
#[should_panic(expected = "unbounded")]
fn unbounded_bodies_are_refused() {
    Body::from_planes(&[[1.0, 0.0, 0.0, 0.0]]);
}

#[test]
fn violation_is_accurate_at_any_size() {
    let cube = Body::from_planes(&unit_cube());
    assert_eq!(cube.violation([1.0, 0.0, 0.0, 0.0]), 0.0);
    assert_eq!(cube.violation([1.0, 0.0, 0.0, -1e-20]), 1e-20);
    assert_eq!(cube.violation([3.0, 4.0, 0.0, -5.0]), 1.0);
    assert_eq!(cube.violation([3e200, 4e200, 0.0, -5e200]), 1.0);
    assert_eq!(cube.violation([-0.5, 0.0, 0.0, 1.0]), -1.0);
    // 0.1 + 0.2 - 0.3 of the very numbers, which floating point gets wrong.
    let point = Body::from_planes(&cuboid([0.1; 3], [0.1; 3]));
    let violation = point.violation([-1.0, -2.0, 0.0, 0.3]);
    assert!((violation * 5.0_f64.sqrt() / 2.775_557_561_562_891e-17 - 1.0).abs() < 1e-15);
    let empty = Body::from_planes(&[[0.0, 0.0, 0.0, -1.0]]);
    assert_eq!(empty.violation([1.0, 0.0, 0.0, 0.0]), f64::NEG_INFINITY);
}

/// Random polyhedra with small integer planes, where coincidences abound, satisfy Euler's formula,
/// which a missing or a spurious vertex would break.
#[test]
fn random_polyhedra_satisfy_eulers_formula() {
    let mut random = Random::new(4);
    let mut solid = 0;
    for _ in 0..1000 {
        let mut planes = cuboid([-4.0; 3], [4.0; 3]);
        for _ in 0..random.integer(1, 12) {
            planes.push(random.small_plane().map(|x| x as f64));
        }
        let body = Body::from_planes(&planes);
        let inside = |vertex: [f64; 3]| {
            planes.iter().all(|[x, y, z, d]| x * vertex[0] + y * vertex[1] + z * vertex[2] + d >= -1e-12)
        };
        assert!(body.vertices_f64().into_iter().all(inside));
        // Only a body with an interior has these numbers, and only with each face counted once.
        let on_all = |plane: usize| body.vertices.iter().all(|v| v.tight.contains(&plane));
        if body.is_empty() || (0..planes.len()).any(on_all) {
            continue;
        }
        solid += 1;
        let mut faces: Vec<Vec<usize>> = (0..planes.len())
            .map(|plane| {
                let touches = |&v: &usize| body.vertices[v].tight.contains(&plane);
                (0..body.vertices.len()).filter(touches).collect()
            })
            .filter(|face: &Vec<usize>| face.len() >= 3)
            .collect();
        faces.sort();
        faces.dedup();
        let corners = body.vertices.len();
        let edges = (0..corners)
            .flat_map(|a| (0..a).map(move |b| [a, b]))
            .filter(|edge| {
                let holds = |face: &&Vec<usize>| edge.iter().all(|end| face.contains(end));
                faces.iter().filter(holds).count() == 2
            })
            .count();
        assert_eq!(corners + faces.len(), edges + 2, "{planes:?}");
    }
    assert!(solid > 500);
}
