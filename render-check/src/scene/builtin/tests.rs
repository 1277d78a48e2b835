//! What holds for every built-in scene.

use shadowfit::{View, mesh::Solidity};

use super::solids::open_edges;
use super::*;
use crate::scene::{Camera, LightSpec, Object};
use crate::trace::{Hit, Lens, Ray, Tracer};

mod coincidence;

const ASPECT: f64 = 1.6;

fn all() -> impl Iterator<Item = LoadedScene> {
    BUILT_IN.into_iter().map(|built_in| (built_in.make)())
}

fn camera_of(scene: &LoadedScene) -> Camera {
    scene.camera.expect("every built-in scene has a camera")
}

/// The view of a scene's own camera.
fn view_of(scene: &LoadedScene) -> View {
    let Camera { eye, forward, up, fov_y, near, far } = camera_of(scene);
    View::perspective(eye, forward, up, fov_y, ASPECT, near.expect("given"), far.expect("given")).expect("sound")
}

/// The hits of a few rays through the picture, each with its ray.
fn seen(scene: &LoadedScene, tracer: &Tracer) -> Vec<(Ray, Hit)> {
    let lens = Lens::of_view(&view_of(scene)).expect("invertible");
    let rays = (0..60)
        .flat_map(|y| (0..96).map(move |x| (x, y)))
        .filter_map(|(x, y)| lens.ray_through_pixel(x, y, 96, 60));
    rays.filter_map(|ray| Some((ray, tracer.first_hit(&ray)?))).collect()
}

#[test]
fn names_are_theirs_alone_and_fit_into_paths() {
    for (i, built_in) in BUILT_IN.iter().enumerate() {
        assert_eq!((built_in.make)().name, built_in.name);
        assert!(built_in.name.bytes().all(|b| b.is_ascii_lowercase() || b == b'-'), "{}", built_in.name);
        assert!(BUILT_IN[..i].iter().all(|other| other.name != built_in.name));
    }
}

#[test]
fn nothing_is_left_out_and_objects_hold_every_triangle_once() {
    for scene in all() {
        assert!(scene.left_out.is_nothing() && !scene.lights.is_empty(), "{}: {}", scene.name, scene.left_out);
        let mut next = 0;
        for object in &scene.mesh.objects {
            assert_eq!(object.triangles.start, next, "{}", scene.name);
            next = object.triangles.end;
        }
        assert_eq!(next as usize, scene.mesh.triangles.len(), "{}", scene.name);
        assert!(next < 22_000 || scene.name == "chess-board", "{}: {next} triangles", scene.name);
    }
}

#[test]
fn making_a_scene_twice_makes_the_same() {
    for (one, other) in all().zip(all()) {
        assert_eq!(one.mesh.vertices, other.mesh.vertices, "{}", one.name);
        assert_eq!(one.mesh.objects, other.mesh.objects, "{}", one.name);
    }
}

#[test]
fn solids_are_closed_and_face_outwards_and_only_leaves_points_and_the_plate_are_open() {
    for scene in all() {
        let (closed, open): (Vec<&Object>, Vec<_>) =
            scene.mesh.objects.iter().partition(|&object| open_edges(&scene.mesh, object) == 0);
        let sheets = match scene.name.as_str() {
            "leaves" => 8,
            "ground" => 1,
            "cloud" => scene.mesh.objects.len(),
            _ => 0,
        };
        assert_eq!(open.len(), sheets, "{}: {:?}", scene.name, open.first());
        assert!(open.iter().all(|object| object.solidity == Solidity::Open), "{}", scene.name);
        assert!(closed.iter().all(|object| object.solidity == Solidity::Watertight), "{}", scene.name);
        for object in closed {
            let middle = 0.5 * (object.min + object.max);
            let corners = object.triangles.clone().map(|t| scene.mesh.corners(t as usize).map(|p| p - middle));
            let volume: f64 = corners.map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum();
            assert!(volume > 0.0, "{}: {object:?}", scene.name);
        }
    }
}

#[test]
fn no_two_faces_overlap_in_one_plane() {
    // The squares of the board touch, and the pieces stand on them.
    for scene in all().filter(|scene| scene.name != "chess-board") {
        let pair = coincidence::find(&scene.mesh);
        let corners = pair.map(|pair| pair.map(|triangle| scene.mesh.corners(triangle)));
        assert_eq!(corners, None, "{}", scene.name);
    }
}

#[test]
fn the_picture_is_full_and_what_it_shows_lies_before_the_far_plane() {
    for scene in all() {
        let tracer = Tracer::new(&scene.mesh).expect("it has triangles");
        let seen = seen(&scene, &tracer);
        assert!(seen.len() > 96 * 60 * 2 / 5, "{}: {} of {}", scene.name, seen.len(), 96 * 60);
        let back_faces = seen.iter().filter(|(ray, hit)| hit.is_back_face(ray)).count();
        assert!(back_faces < seen.len() / 10, "{}: {back_faces} back faces", scene.name);
        let camera = camera_of(&scene);
        let farthest =
            scene.mesh.vertices.iter().map(|&p| (p - camera.eye).dot(camera.forward)).fold(0.0, f64::max);
        assert!(farthest < camera.far.expect("given") * 1.02, "{}: {farthest}", scene.name);
    }
}

/// The fraction of visible surfaces facing the light that is in shadow.
fn share_in_shadow(light: LightSpec, tracer: &Tracer, seen: &[(Ray, Hit)]) -> f64 {
    let (mut turned_to, mut shadowed) = (0, 0);
    for (ray, hit) in seen {
        let towards = match light {
            LightSpec::Sun { direction_to_light } => (direction_to_light.normalize(), f64::INFINITY),
            LightSpec::Point { position, .. } | LightSpec::Spot { position, .. } => {
                ((position - hit.point).normalize(), position.distance(hit.point))
            }
        };
        let side = if hit.is_back_face(ray) { -1.0 } else { 1.0 };
        if side * hit.face_normal.dot(towards.0) > 0.0 {
            turned_to += 1;
            shadowed += u32::from(tracer.is_shadowed(hit, ray, towards.0, towards.1));
        }
    }
    f64::from(shadowed) / f64::from(turned_to)
}

#[test]
fn shadows_are_the_subject_of_every_picture_but_the_plates() {
    for scene in all() {
        let tracer = Tracer::new(&scene.mesh).expect("it has triangles");
        let seen = seen(&scene, &tracer);
        for &light in &scene.lights {
            let share = share_in_shadow(light, &tracer, &seen);
            let fine = if scene.name == "ground" { share == 0.0 } else { (0.05..0.95).contains(&share) };
            assert!(fine, "{}, {light}: {share}", scene.name);
        }
    }
}
