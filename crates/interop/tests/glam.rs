//! The glam that shadowfit uses.

use interop::{CLIP_FROM_EYE, EYE, EYE_FROM_WORLD, FORWARD, SUN, UP, map, place, single, view, view_of_matrices};
use shadowfit::glam::{DMat4, DVec3, Mat4, Vec3, Vec3A};
use shadowfit::{ClipSpace, Light, View};

#[test]
fn there() {
    let [eye, forward, up] = [EYE, FORWARD, UP].map(DVec3::from);
    assert_eq!(View::perspective(eye, forward, up, 1.0, 1.5, 0.1, 50.0), view());
    assert_eq!(View::perspective(eye.as_vec3(), forward, Vec3A::Y, 1.0, 1.5, 0.1, 50.0), view());
    assert_eq!(Light::directional(Vec3::new(0.25, 1.0, 0.5)), Light::directional(SUN));
    let (view, lens) = (DMat4::from_cols_array_2d(&EYE_FROM_WORLD), DMat4::from_cols_array_2d(&CLIP_FROM_EYE));
    let view = View::from_matrices(view, lens, ClipSpace::WGPU);
    assert_eq!(view, view_of_matrices());
    let single = Mat4::from_cols_array_2d(&single(EYE_FROM_WORLD));
    assert!(View::from_matrices(single, lens, ClipSpace::WGPU).is_ok());
}

#[test]
fn and_back() {
    let matrix = Mat4::from_cols_array_2d(&map().caster_matrix().to_cols_array_2d());
    assert_eq!((matrix * Vec3::new(1.0, 0.5, -1.0).extend(1.0)).to_array(), place([1.0, 0.5, -1.0]));
}
