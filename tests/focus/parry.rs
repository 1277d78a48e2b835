//! Bodies and boxes to and from parry3d.

use parry3d::math::Vector;
use parry3d::query::PointQuery;
use parry3d::shape::{ConvexPolyhedron, Cuboid};
use shadowfit::glam::{DQuat, DVec3, Vec3};
use shadowfit::{
    Aabb, Focus, FocusForm, Light, Scene, View,
    focus::ConvexBody,
    input::{ConvexScene, InputErrorKind},
};

/// A view that sees all around the origin, up to a hundred units away, and a light above it.
fn visible(scene: &Scene<'_>) -> ConvexBody {
    let view = View::orthographic(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 100.0, 1.0, -100.0, 100.0).unwrap();
    let light = Light::directional(DVec3::new(0.3, 1.0, 0.2)).unwrap();
    Focus::new(&view, &light, scene).receiver_volume()
}

/// Corners of a box of these half extents, turned.
fn turned_box(half: DVec3, turn: DQuat) -> Vec<Vec3> {
    (0..8)
        .map(|corner| {
            let side = |bit: i32| if corner >> bit & 1 == 0 { -1.0 } else { 1.0 };
            (turn * (half * DVec3::new(side(0), side(1), side(2)))).as_vec3()
        })
        .collect()
}

fn to_parry(points: &[Vec3]) -> Vec<Vector> {
    points.iter().map(|point| Vector::new(point.x, point.y, point.z)).collect()
}

/// The body holds every point but for the rounding that [`ConvexScene`] itself allows for.
fn assert_holds(scene: &ConvexScene, points: &[Vec3]) {
    let body = visible(&Scene::from_convex(scene));
    for point in points {
        assert!(body.contains(point.as_dvec3()), "{point} is outside");
    }
}

#[test]
fn boxes_there_and_back() {
    let ours = Aabb::new(Vec3::new(-1.0, 2.0, -3.5), Vec3::new(4.0, 5.25, 6.0));
    let theirs = parry3d::bounding_volume::Aabb::from(ours);
    assert_eq!((theirs.mins.y, theirs.maxs.z), (2.0, 6.0));
    assert_eq!(Aabb::from(theirs), ours);
}

#[test]
fn a_turned_box_keeps_its_faces() {
    let half = DVec3::new(3.0, 1.0, 2.0);
    let points = turned_box(half, DQuat::from_euler(shadowfit::glam::EulerRot::XYZ, 0.3, 0.5, 0.2));
    let polyhedron = ConvexPolyhedron::from_convex_hull(&to_parry(&points)).unwrap();
    for scene in [ConvexScene::from_parry(&polyhedron).unwrap(), ConvexScene::hull_of(&points).unwrap()] {
        assert_holds(&scene, &points);
        // Planes with f32 normals, moved out to the farthest point: an ulp of the size on each side.
        let volume = visible(&Scene::from_convex(&scene)).volume();
        let exact = 8.0 * half.x * half.y * half.z;
        assert!((volume / exact - 1.0).abs() < 1e-5, "{volume}, not {exact}");
    }
    // What the directions to a cube's edges and faces leave is much larger.
    let around = ConvexScene::around(points.iter().map(|point| point.as_dvec3())).unwrap();
    assert!(visible(&Scene::from_convex(&around)).volume() > 1.1 * 48.0);
}

#[test]
fn a_straight_box_needs_no_cuts() {
    let (vertices, indices) = Cuboid::new(Vector::new(1.0, 2.0, 3.0)).to_trimesh();
    let polyhedron = ConvexPolyhedron::from_convex_mesh(vertices, &indices).unwrap();
    let body = visible(&Scene::from_convex(&ConvexScene::from_parry(&polyhedron).unwrap()));
    assert_eq!(body.vertices().len(), 8);
    assert_eq!(body.volume(), 48.0);
}

#[test]
fn many_faces_are_bounded_by_the_directions_of_a_cube() {
    let points: Vec<Vec3> = (0..200)
        .map(|index| {
            let (turn, height) = (index as f32 * 2.399_963, index as f32 / 99.5 - 1.0);
            let radius = (1.0 - height * height).max(0.0).sqrt();
            Vec3::new(radius * turn.cos(), height, radius * turn.sin())
        })
        .collect();
    let scene = ConvexScene::hull_of(&points).unwrap();
    assert_holds(&scene, &points);
    let around = ConvexScene::around(points.iter().map(|point| point.as_dvec3())).unwrap();
    let [ours, theirs] = [&scene, &around].map(|scene| visible(&Scene::from_convex(scene)).volume());
    assert_eq!(ours, theirs);
}

#[test]
fn points_without_volume_have_a_bound_all_the_same() {
    let (a, b, c) = (Vec3::new(1.0, 2.0, 0.5), Vec3::new(3.0, -1.0, 2.0), Vec3::new(0.0, 4.0, 1.0));
    for points in [
        vec![a],
        vec![a, a, a, a],
        vec![a, b],
        vec![a, a.lerp(b, 0.25), b, a.lerp(b, 0.5)],
        vec![a, b, c],
        vec![a, b, c, (a + b + c) / 3.0, a.lerp(c, 0.5)],
    ] {
        assert_holds(&ConvexScene::hull_of(&points).unwrap(), &points);
    }
}

#[test]
fn bad_points_are_refused() {
    let bad = |points: &[Vec3], problem| {
        let error = ConvexScene::hull_of(points).unwrap_err();
        assert_eq!((error.field, error.problem), ("points", problem));
    };
    assert!(visible(&Scene::from_convex(&ConvexScene::hull_of(&[]).unwrap())).is_empty());
    bad(&[Vec3::ZERO, Vec3::new(0.0, f32::NAN, 0.0)], InputErrorKind::NotFinite);
    bad(&[Vec3::ZERO, Vec3::new(f32::INFINITY, 0.0, 0.0)], InputErrorKind::NotFinite);
    bad(&[Vec3::ZERO, Vec3::new(0.0, 0.0, -1e30)], InputErrorKind::TooLarge);
}

#[test]
fn a_focus_body_becomes_a_polyhedron() {
    let view = View::perspective(DVec3::new(0.0, 2.0, 9.0), DVec3::NEG_Z, DVec3::Y, 1.0, 1.5, 0.1, 50.0).unwrap();
    let light = Light::directional(DVec3::new(0.4, 1.0, 0.3)).unwrap();
    let scene = Scene::from_box(DVec3::new(-9.0, 0.0, -9.0), DVec3::new(9.0, 4.0, 9.0)).unwrap();
    let body = Focus::new(&view, &light, &scene).caster_volume(FocusForm::ReceiverHull);
    let polyhedron = body.to_parry().expect("a body with a volume");
    for face in body.faces() {
        for corner in face.vertices() {
            let point = Vector::new(corner.x as f32, corner.y as f32, corner.z as f32);
            // Within a rounding of the largest coordinate.
            assert!(polyhedron.distance_to_local_point(point, true) < 9.0 * 4.0 * f32::EPSILON);
        }
    }
    let volume = f64::from(parry3d::shape::Shape::mass_properties(&polyhedron, 1.0).mass());
    assert!((volume / body.volume() - 1.0).abs() < 1e-4, "{volume}, not {}", body.volume());
}

#[test]
fn flat_and_empty_bodies_become_nothing() {
    let ground = Scene::from_box(DVec3::new(-9.0, 0.0, -9.0), DVec3::new(9.0, 0.0, 9.0)).unwrap();
    assert!(visible(&ground).to_parry().is_none());
    let slope = turned_box(DVec3::new(3.0, 0.0, 2.0), DQuat::from_rotation_x(0.4));
    let slope = ConvexScene::hull_of(&slope).unwrap();
    assert!(visible(&Scene::from_convex(&slope)).to_parry().is_none());
    let away = Scene::from_box(DVec3::splat(300.0), DVec3::splat(400.0)).unwrap();
    assert!(visible(&away).to_parry().is_none());
}
