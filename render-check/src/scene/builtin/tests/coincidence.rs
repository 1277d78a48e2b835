//! Finds coplanar faces that overlap.

use std::collections::HashMap;

use shadowfit::glam::{DVec2, DVec3};

use crate::scene::Mesh;

/// The smallest area of an overlap that counts, in square metres: a square of a third of a millimetre.
const LEAST_AREA: f64 = 1e-7;

/// Two triangles in one plane, back to back or front to front, that overlap.
pub(super) fn find(mesh: &Mesh) -> Option<[usize; 2]> {
    // Planes to six decimals, as turned houses are off by rounding.
    let mut by_plane: HashMap<[i64; 4], Vec<usize>> = HashMap::new();
    for triangle in 0..mesh.triangles.len() {
        let normal = mesh.face_normal(triangle);
        let largest = normal.to_array().into_iter().max_by(|a, b| a.abs().total_cmp(&b.abs())).expect("three");
        let normal = normal * largest.signum();
        let plane = normal.extend(normal.dot(mesh.corners(triangle)[0]));
        by_plane.entry(plane.to_array().map(|x| (x * 1e6).round() as i64)).or_default().push(triangle);
    }
    by_plane.values().find_map(|triangles| {
        let (across, up) = mesh.face_normal(triangles[0]).any_orthonormal_pair();
        let flat = |p: DVec3| DVec2::new(across.dot(p), up.dot(p));
        let mut flats: Vec<(usize, [DVec2; 3])> =
            triangles.iter().map(|&triangle| (triangle, mesh.corners(triangle).map(flat))).collect();
        let left = |corners: &[DVec2; 3]| corners[0].x.min(corners[1].x).min(corners[2].x);
        let right = |corners: &[DVec2; 3]| corners[0].x.max(corners[1].x).max(corners[2].x);
        flats.sort_by(|a, b| left(&a.1).total_cmp(&left(&b.1)));
        flats.iter().enumerate().find_map(|(i, (triangle, corners))| {
            let rivals = flats[i + 1..].iter().take_while(|(_, other)| left(other) < right(corners));
            let mut overlapping = rivals.filter(|(_, other)| overlap(corners, other) > LEAST_AREA);
            overlapping.next().map(|(other, _)| [*triangle, *other])
        })
    })
}

/// The area that two triangles have in common: one is clipped by the sides of the other.
fn overlap(a: &[DVec2; 3], b: &[DVec2; 3]) -> f64 {
    let turn = (b[1] - b[0]).perp_dot(b[2] - b[0]).signum();
    let mut polygon = a.to_vec();
    for (from, to) in [(b[0], b[1]), (b[1], b[2]), (b[2], b[0])] {
        let inside = |p: DVec2| turn * (to - from).perp_dot(p - from);
        let mut clipped = Vec::new();
        for (i, &p) in polygon.iter().enumerate() {
            let q = polygon[(i + 1) % polygon.len()];
            if inside(p) >= 0.0 {
                clipped.push(p);
            }
            if inside(p) * inside(q) < 0.0 {
                clipped.push(p.lerp(q, inside(p) / (inside(p) - inside(q))));
            }
        }
        polygon = clipped;
    }
    let first = polygon.first().copied().unwrap_or_default();
    let fans = polygon.windows(2).map(|pair| (pair[0] - first).perp_dot(pair[1] - first));
    0.5 * fans.sum::<f64>().abs()
}

#[test]
fn overlaps_have_the_areas_they_should() {
    let triangle = |x: f64| [(x, 0.0), (x + 1.0, 0.0), (x, 1.0)].map(DVec2::from);
    assert!((overlap(&triangle(0.0), &triangle(0.0)) - 0.5).abs() < 1e-12);
    assert!((overlap(&triangle(0.0), &triangle(0.5)) - 0.125).abs() < 1e-12);
    assert_eq!(overlap(&triangle(0.0), &triangle(1.0)), 0.0);
    let mut turned = triangle(0.5);
    turned.swap(0, 1);
    assert!((overlap(&triangle(0.0), &turned) - 0.125).abs() < 1e-12);
}
