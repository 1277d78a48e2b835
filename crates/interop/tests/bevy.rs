//! Bevy's mathematics, whose glam is not the one that shadowfit uses where both are newest.

use bevy_math::{DVec3, Mat4, Vec3};
use interop::{CLIP_FROM_EYE, EYE, EYE_FROM_WORLD, FORWARD, SUN, UP, map, place, single, view};
use shadowfit::{ClipSpace, Light, View};

#[test]
fn there() {
    let [eye, forward, up] = [EYE, FORWARD, UP].map(|vector| DVec3::from(vector).as_vec3());
    assert_eq!(View::perspective(eye, forward, up, 1.0, 1.5, 0.1, 50.0), view());
    assert_eq!(Light::directional(DVec3::from(SUN)), Light::directional(SUN));
    assert_eq!(Light::point(Vec3::new(0.0, 3.0, 0.0), 0.1, 9.0), Light::point([0.0, 3.0, 0.0], 0.1, 9.0));
    let [view, lens] = [EYE_FROM_WORLD, CLIP_FROM_EYE].map(|matrix| Mat4::from_cols_array_2d(&single(matrix)));
    let view = View::from_matrices(view.to_cols_array_2d(), lens.to_cols_array_2d(), ClipSpace::WGPU);
    assert_eq!(view.map(|view| view.eye().to_array()), Ok(EYE));
}

#[test]
fn and_back() {
    let matrix = Mat4::from_cols_array_2d(&map().caster_matrix().to_cols_array_2d());
    assert_eq!((matrix * Vec3::new(1.0, 0.5, -1.0).extend(1.0)).to_array(), place([1.0, 0.5, -1.0]));
}
