//! Arrays, tuples and literals, in single and double precision.

use interop::{CLIP_FROM_EYE, EYE, EYE_FROM_WORLD, FORWARD, SUN, UP, single, view, view_of_matrices};
use shadowfit::{ClipSpace, Light, Scene, View};

#[test]
fn literals() {
    let one = View::perspective([0.0, 2.0, 9.0], (0.0, -0.25, -1.0), [0, 1, 0], 1.0, 1.5, 0.1, 50.0);
    assert_eq!(one, view());
    assert_eq!(Light::directional((0.25, 1.0, 0.5)), Light::directional(SUN));
    assert_eq!(Light::directional([0.25_f32, 1.0, 0.5]), Light::directional(SUN));
    assert!(Light::spot((0.0, 3.0, 0.0), [0.0_f32, -1.0, 0.0], 0.5, 0.1, 9.0).is_ok());
    assert!(Scene::from_box((-5.0, 0.0, -5.0), [5.0_f32, 3.0, 5.0]).is_ok());
}

#[test]
fn both_precisions() {
    let (eye, forward, up) = (EYE.map(|x| x as f32), FORWARD.map(|x| x as f32), UP.map(|x| x as f32));
    assert_eq!(View::perspective(eye, forward, up, 1.0, 1.5, 0.1, 50.0), view());
    let both = View::from_matrices(single(EYE_FROM_WORLD), CLIP_FROM_EYE, ClipSpace::WGPU);
    assert_eq!(both, view_of_matrices());
    let [x, y, z] = view_of_matrices().map(|view| view.eye().to_array()).expect("a camera");
    assert_eq!([x, y, z], EYE);
}

#[test]
fn results() {
    let matrix: [[f32; 4]; 4] = interop::map().caster_matrix().to_cols_array_2d();
    let flat: [f32; 16] = interop::map().caster_matrix().to_cols_array();
    assert_eq!(matrix.as_flattened(), flat);
}
