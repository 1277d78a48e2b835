//! nalgebra: vectors, points and matrices.

use interop::{CLIP_FROM_EYE, EYE, EYE_FROM_WORLD, FORWARD, SUN, UP, map, place, single, view, view_of_matrices};
use nalgebra::{Matrix4, Point3, Vector3, Vector4};
use shadowfit::{ClipSpace, Light, View};

#[test]
fn there() {
    let view_of =
        View::perspective(Point3::from(EYE), Vector3::from(FORWARD), Vector3::from(UP), 1.0, 1.5, 0.1, 50.0);
    assert_eq!(view_of, view());
    assert_eq!(Light::directional(Vector3::new(0.25_f32, 1.0, 0.5)), Light::directional(SUN));
    let (view, lens) = (Matrix4::from(EYE_FROM_WORLD), Matrix4::from(single(CLIP_FROM_EYE)));
    assert!(View::from_matrices(view, lens, ClipSpace::WGPU).is_ok());
    assert_eq!(View::from_matrices(view, Matrix4::from(CLIP_FROM_EYE), ClipSpace::WGPU), view_of_matrices());
}

#[test]
fn and_back() {
    let matrix = Matrix4::from(map().caster_matrix().to_cols_array_2d());
    let clip: [f32; 4] = (matrix * Vector4::new(1.0, 0.5, -1.0, 1.0)).into();
    for (theirs, ours) in clip.into_iter().zip(place([1.0, 0.5, -1.0])) {
        assert!((theirs - ours).abs() <= 1e-6, "{theirs}, {ours}");
    }
}
