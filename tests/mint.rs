//! Vectors and matrices of other libraries, through mint.

#![cfg(feature = "mint")]

use mint::{ColumnMatrix4, Point3, Vector3};
use shadowfit::glam::{DMat4, DVec3};
use shadowfit::{Aabb, ClipSpace, ConvexScene, Focus, Light, Outcome, Scene, Settings, View};

#[test]
fn constructors_take_mint() {
    let eye = Point3 { x: 0.0, y: 2.0, z: 9.0 };
    let forward = Vector3 { x: 0.0, y: -0.2, z: -1.0 };
    let up = Vector3 { x: 0.0, y: 1.0, z: 0.0 };
    let view = View::perspective(eye, forward, up, 1.0, 1.5, 0.1, 50.0).unwrap();
    assert_eq!(view, View::perspective((0.0, 2.0, 9.0), (0.0, -0.2, -1.0), DVec3::Y, 1.0, 1.5, 0.1, 50.0).unwrap());
    View::orthographic(eye, forward, up, 5.0, 1.5, 0.1, 50.0).unwrap();

    let eye_from_world: ColumnMatrix4<f64> = DMat4::from_translation(-DVec3::from(eye)).into();
    let clip_from_eye: ColumnMatrix4<f64> = DMat4::from_scale(DVec3::new(0.1, 0.1, -0.02)).into();
    let view = View::from_matrices(eye_from_world, clip_from_eye, ClipSpace::WGPU).unwrap();
    assert_eq!(view.eye(), DVec3::from(eye));

    assert_eq!(Light::directional(up).unwrap(), Light::directional(DVec3::Y).unwrap());
    assert_eq!(Light::point(eye, 0.1, 9.0).unwrap().position(), Some(DVec3::from(eye)));
    Light::spot(eye, forward, 0.5, 0.1, 9.0).unwrap();
    Light::hemisphere(eye, forward, 0.1, 9.0).unwrap();

    let (min, max) = (Point3 { x: -5.0, y: 0.0, z: -5.0 }, Point3 { x: 5.0, y: 3.0, z: 5.0 });
    Scene::from_box(min, max).unwrap();
    ConvexScene::new(min, max, &[]).unwrap();
    let single = Aabb::new(Point3 { x: 1.0_f32, y: 2.0, z: 3.0 }.into(), Point3 { x: 4.0, y: 5.0, z: 6.0 }.into());
    assert_eq!(single.max.z, 6.0);
}

#[test]
fn results_become_mint() {
    let view = View::perspective((0.0, 2.0, 9.0), DVec3::NEG_Z, DVec3::Y, 1.0, 1.5, 0.1, 50.0).unwrap();
    let light = Light::directional((0.3, 1.0, 0.2)).unwrap();
    let scene = Scene::from_box((-5.0, 0.0, -5.0), (5.0, 3.0, 5.0)).unwrap();
    let focus = Focus::new(&view, &light, &scene);
    let Outcome::Map(map) = focus.fit(&Settings::default()) else { panic!("no map") };

    let matrix: ColumnMatrix4<f32> = map.matrix().into();
    assert_eq!([matrix.x.w, matrix.y.w, matrix.z.w, matrix.w.w], map.matrix().row(3).to_array());
    let matrix: ColumnMatrix4<f64> = map.shadow_from_world().into();
    assert_eq!(DMat4::from(matrix), map.shadow_from_world());

    for &vertex in focus.visible().vertices() {
        let point: Point3<f64> = vertex.into();
        assert_eq!([point.x, point.y, point.z], vertex.to_array());
        let step: Vector3<f64> = map.footprint(vertex).unwrap().along_x.into();
        assert!(step.x.is_finite());
        assert!(focus.visible().meets_sphere(point, 0.0));
    }
}
