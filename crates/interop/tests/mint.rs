//! mint: vectors, points and matrices by columns.

use interop::{CLIP_FROM_EYE, EYE, EYE_FROM_WORLD, FORWARD, SUN, UP, map, single, view, view_of_matrices};
use mint::{ColumnMatrix4, Point3, Vector3};
use shadowfit::{ClipSpace, Light, View};

#[test]
fn there() {
    let view_of =
        View::perspective(Point3::from(EYE), Vector3::from(FORWARD), Vector3::from(UP), 1.0, 1.5, 0.1, 50.0);
    assert_eq!(view_of, view());
    assert_eq!(Light::directional(Vector3 { x: 0.25_f32, y: 1.0, z: 0.5 }), Light::directional(SUN));
    let (view, lens) = (ColumnMatrix4::from(EYE_FROM_WORLD), ColumnMatrix4::from(single(CLIP_FROM_EYE)));
    assert!(View::from_matrices(view, lens, ClipSpace::WGPU).is_ok());
    assert_eq!(View::from_matrices(view, ColumnMatrix4::from(CLIP_FROM_EYE), ClipSpace::WGPU), view_of_matrices());
}

#[test]
fn and_back() {
    let matrix = ColumnMatrix4::from(map().caster_matrix().to_cols_array_2d());
    assert_eq!([matrix.x.w, matrix.y.w, matrix.z.w, matrix.w.w], map().caster_matrix().row(3).to_array());
    let point: Point3<f64> = map().camera().eye.to_array().into();
    assert!(point.x.is_finite());
}
