//! Checks of the hull of a view and a light.

use std::cmp::Ordering;

use super::random::Random;
use super::shapes::{cuboid, frustum, infinite_frustum};
use testkit::oracle::body::Body;
use testkit::oracle::homogeneous::{ExactPlane, Homogeneous};
use testkit::oracle::hull::{homogeneous_vertices, hull};

/// The half-spaces as `f64`, scaled to a largest component of 1 and in lexicographic order, where
/// that is exact.
fn sorted_planes(planes: &[ExactPlane]) -> Vec<[f64; 4]> {
    let mut planes: Vec<[f64; 4]> = planes
        .iter()
        .map(|plane| {
            plane.coords().each_ref().map(|coord| {
                let [coord, x, y, z] = [coord, plane.xyz()[0], plane.xyz()[1], plane.xyz()[2]]
                    .map(|coord| i32::try_from(coord.clone()).expect("small components"));
                f64::from(coord) / f64::from(x.abs().max(y.abs()).max(z.abs()))
            })
        })
        .collect();
    planes.sort_by(|a, b| a.partial_cmp(b).expect("planes are finite"));
    planes
}

/// The same of half-spaces given as `f64`.
fn sorted(planes: &[[f64; 4]]) -> Vec<[f64; 4]> {
    let planes: Vec<ExactPlane> = planes.iter().copied().map(Homogeneous::from_f64).collect();
    sorted_planes(&planes)
}

/// The hull in a comparable form.
fn sorted_hull(view: &[[f64; 4]], light: [f64; 4]) -> Vec<[f64; 4]> {
    sorted_planes(&hull(view, light))
}

#[test]
fn light_inside_leaves_the_view() {
    let view = frustum(1.0, 4.0);
    assert_eq!(sorted_hull(&view, [0.0, 0.0, 2.0, 1.0]), sorted(&view));
    // On a face, an edge and a corner too, and given with redundant planes.
    assert_eq!(sorted_hull(&view, [0.0, 0.0, 1.0, 1.0]), sorted(&view));
    assert_eq!(sorted_hull(&view, [0.0, 2.0, 2.0, 1.0]), sorted(&view));
    assert_eq!(sorted_hull(&view, [1.0, 1.0, 1.0, 1.0]), sorted(&view));
    let mut redundant = view.clone();
    redundant.extend(&view);
    redundant.push([1.0, 0.0, 0.0, 4.0]);
    assert_eq!(sorted_hull(&redundant, [0.0, 0.0, 2.0, 1.0]), sorted(&view));
}

#[test]
fn light_at_the_eye_completes_the_pyramid() {
    let pyramid = |far: &[[f64; 4]]| sorted(&[&infinite_frustum(1.0)[..4], far].concat());
    assert_eq!(sorted_hull(&frustum(1.0, 4.0), [0.0, 0.0, 0.0, 1.0]), pyramid(&[[0.0, 0.0, -1.0, 4.0]]));
    assert_eq!(sorted_hull(&infinite_frustum(1.0), [0.0, 0.0, 0.0, 1.0]), pyramid(&[]));
    // With no near plane the eye is the view's own vertex.
    assert_eq!(sorted_hull(&infinite_frustum(1.0)[..4], [0.0, 0.0, 0.0, 1.0]), pyramid(&[]));
}

#[test]
fn point_light_above_a_box() {
    let view = cuboid([-1.0; 3], [1.0; 3]);
    let planes = sorted_hull(&view, [0.0, 0.0, 3.0, 1.0]);
    // Without the top, with four sloping sides through the top's edges and the light.
    let mut expected: Vec<[f64; 4]> = view[..5].to_vec();
    expected.extend([[2.0, 0.0, -1.0, 3.0], [-2.0, 0.0, -1.0, 3.0], [0.0, 2.0, -1.0, 3.0], [0.0, -2.0, -1.0, 3.0]]);
    assert_eq!(planes, sorted(&expected));
}

/// A light exactly on the plane of a face widens that face and adds no plane through it twice.
#[test]
fn light_on_the_plane_of_a_face() {
    let view = cuboid([-1.0; 3], [1.0; 3]);
    let planes = sorted_hull(&view, [1.0, 0.0, 3.0, 1.0]);
    let mut expected: Vec<[f64; 4]> = view[..5].to_vec();
    expected.extend([[1.0, 0.0, -1.0, 2.0], [0.0, 2.0, -1.0, 3.0], [0.0, -2.0, -1.0, 3.0]]);
    assert_eq!(planes, sorted(&expected));
    // On the line of an edge.
    let planes = sorted_hull(&view, [1.0, 1.0, 3.0, 1.0]);
    let mut expected: Vec<[f64; 4]> = view[..5].to_vec();
    expected.extend([[1.0, 0.0, -1.0, 2.0], [0.0, 1.0, -1.0, 2.0]]);
    assert_eq!(planes, sorted(&expected));
}

#[test]
fn directional_light_extrudes_the_view() {
    let view = cuboid([-1.0; 3], [1.0; 3]);
    // Along an edge, along a face, and along neither.
    assert_eq!(sorted_hull(&view, [0.0, 0.0, 1.0, 0.0]), sorted(&view[..5]));
    let mut along_face = vec![view[0], view[2], view[3], view[4]];
    along_face.extend([[-1.0, 0.0, 1.0, 2.0], [1.0, 0.0, -1.0, 2.0]]);
    assert_eq!(sorted_hull(&view, [1.0, 0.0, 1.0, 0.0]), sorted(&along_face));
    let oblique = hull(&view, [1.0, 1.0, 1.0, 0.0]);
    assert_eq!(oblique.len(), 9);
    assert_eq!(hull(&view, [1.0, 1e-9, 1e-9, 0.0]).len(), 9, "nearly along an edge");
}

#[test]
fn infinite_views_keep_their_directions() {
    let view = infinite_frustum(1.0);
    assert_eq!(homogeneous_vertices(&view.iter().copied().map(Homogeneous::from_f64).collect::<Vec<_>>()).len(), 8);
    // From behind, the hull is the light's own pyramid, the view's directions added to it.
    assert_eq!(
        sorted_hull(&view, [0.0, 0.0, -1.0, 1.0]),
        sorted(&[[1.0, 0.0, 1.0, 1.0], [-1.0, 0.0, 1.0, 1.0], [0.0, 1.0, 1.0, 1.0], [0.0, -1.0, 1.0, 1.0],])
    );
    // A light in a direction of the view adds nothing.
    assert_eq!(sorted_hull(&view, [0.0, 0.0, 1.0, 0.0]), sorted(&view));
    assert_eq!(sorted_hull(&view, [1.0, 1.0, 1.0, 0.0]), sorted(&view));
    // One straight behind makes the hull all of space.
    assert!(hull(&view, [0.0, 0.0, -1.0, 0.0]).is_empty());
    // One opposite to a direction on a face leaves that face's half-space.
    assert_eq!(sorted_hull(&view, [-1.0, 0.0, -1.0, 0.0]), sorted(&[[-1.0, 0.0, 1.0, 0.0]]));
}

#[test]
fn flat_and_empty_views() {
    let flat = cuboid([-1.0, -1.0, 0.0], [1.0, 1.0, 0.0]);
    // In its own plane, the hull stays flat.
    let body = Body::from_exact_planes(hull(&flat, [3.0, 0.0, 0.0, 1.0]));
    assert_eq!(body.vertices.len(), 5);
    let body = Body::from_exact_planes(hull(&flat, [0.0, 0.0, 1.0, 1.0]));
    assert_eq!(body.vertices.len(), 5);
    let dot = cuboid([0.0; 3], [0.0; 3]);
    let body = Body::from_exact_planes(hull(&dot, [1.0, 2.0, 3.0, 1.0]));
    assert_eq!(body.vertices.len(), 2);
    let empty = [[1.0, 0.0, 0.0, -1.0], [-1.0, 0.0, 0.0, 0.0]];
    assert!(Body::from_exact_planes(hull(&empty, [0.0, 0.0, 0.0, 1.0])).is_empty());
}

/// Membership in the hull by definition: y is in it when moving y away from the light by some
/// amount β ≥ 0 brings it into the view: y − β l is in the closed cone of the view. Every
/// half-space bounds β from one side; the bounds are compared as fractions.
fn in_hull(view: &[[i64; 4]], light: [i64; 4], y: [i64; 4]) -> bool {
    let product = |a: &[i64; 4], b: &[i64; 4]| a.iter().zip(b).map(|(a, b)| a * b).sum::<i64>();
    let mut lower = (0, 1);
    let mut upper: Option<(i64, i64)> = None;
    for plane in view.iter().chain(&[[0, 0, 0, 1]]) {
        // here − β toward ≥ 0
        let (here, toward) = (product(plane, &y), product(plane, &light));
        match toward.cmp(&0) {
            Ordering::Equal if here < 0 => return false,
            Ordering::Equal => {}
            Ordering::Less => {
                let bound = (-here, -toward);
                if bound.0 * lower.1 > lower.0 * bound.1 {
                    lower = bound;
                }
            }
            Ordering::Greater => {
                let bound = (here, toward);
                if upper.is_none_or(|upper| bound.0 * upper.1 < upper.0 * bound.1) {
                    upper = Some(bound);
                }
            }
        }
    }
    upper.is_none_or(|upper| lower.0 * upper.1 <= upper.0 * lower.1)
}

/// The half-spaces hold exactly the points that are in the hull by definition, for random views,
/// bounded and not, flat and not, and lights on a coarse grid, where coincidences abound.
#[test]
fn membership_agrees_with_the_definition() {
    let mut random = Random::new(5);
    let mut members = 0;
    let mut checked = 0;
    for case in 0..600 {
        let mut view: Vec<[i64; 4]> = Vec::new();
        if case % 2 == 0 {
            view.extend(cuboid([-2.0; 3], [2.0; 3]).iter().map(|plane| plane.map(|x| x as i64)));
        }
        for _ in 0..random.integer(1, 6) {
            view.push(random.small_plane());
        }
        let view_f64: Vec<[f64; 4]> = view.iter().map(|plane| plane.map(|x| x as f64)).collect();
        let exact: Vec<ExactPlane> = view_f64.iter().copied().map(Homogeneous::from_f64).collect();
        let empty = homogeneous_vertices(&exact).iter().all(|vertex| vertex.vector.w().is_zero());
        let [x, y, z] = std::array::from_fn(|_| random.integer(-4, 4));
        let light = [x, y, z, random.integer(0, 1)];
        let planes = hull(&view_f64, light.map(|x| x as f64));
        for _ in 0..40 {
            // Half-integers, so that they fall on planes through integer points often.
            let [x, y, z] = std::array::from_fn(|_| random.integer(-10, 10));
            let point = [x, y, z, 2];
            let exact = Homogeneous::from_f64(point.map(|x| x as f64));
            let computed = planes.iter().all(|plane| plane.side(&exact) != Ordering::Less);
            let member = !empty && in_hull(&view, light, point);
            assert_eq!(computed, member, "{view:?} {light:?} {point:?}");
            members += usize::from(member);
            checked += 1;
        }
    }
    assert!(members > checked / 10 && members < checked * 9 / 10);
}
