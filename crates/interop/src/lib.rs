//! One set-up, as each library writes it down in `tests/`: an eye two metres up that looks ahead and down a little, a sun, and
//! a point light. What the tests compile is what a crate writes that has shadowfit beside the library, whatever version of
//! it.

use shadowfit::{ClipSpace, Focus, InputError, Light, Outcome, Scene, Settings, ShadowMap, View};

/// The eye.
pub const EYE: [f64; 3] = [0.0, 2.0, 9.0];
/// Where it looks.
pub const FORWARD: [f64; 3] = [0.0, -0.25, -1.0];
/// Up.
pub const UP: [f64; 3] = [0.0, 1.0, 0.0];
/// Towards the sun.
pub const SUN: [f64; 3] = [0.25, 1.0, 0.5];
/// The view matrix of an eye at [`EYE`] that looks along −z, by columns.
pub const EYE_FROM_WORLD: [[f64; 4]; 4] =
    [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, -2.0, -9.0, 1.0]];
/// A projection with depth from 0 to 1: near 0.5, far 32, by columns.
pub const CLIP_FROM_EYE: [[f64; 4]; 4] =
    [[1.0, 0.0, 0.0, 0.0], [0.0, 1.5, 0.0, 0.0], [0.0, 0.0, -32.0 / 31.5, -1.0], [0.0, 0.0, -16.0 / 31.5, 0.0]];

/// A view from plain numbers.
///
/// # Errors
///
/// None.
pub fn view() -> Result<View, InputError> {
    View::perspective(EYE, FORWARD, UP, 1.0, 1.5, 0.1, 50.0)
}

/// A view from plain matrices.
///
/// # Errors
///
/// None.
pub fn view_of_matrices() -> Result<View, InputError> {
    View::from_matrices(EYE_FROM_WORLD, CLIP_FROM_EYE, ClipSpace::WGPU)
}

/// Where the eye of a view of matrices is, and what it has in f32.
#[must_use]
pub fn single(matrix: [[f64; 4]; 4]) -> [[f32; 4]; 4] {
    matrix.map(|column| column.map(|entry| entry as f32))
}

/// A map of the sun.
///
/// # Panics
///
/// Never: all of it is sound.
#[must_use]
pub fn map() -> ShadowMap {
    let sound = "plain numbers";
    let (view, sun) = (view().expect(sound), Light::directional(SUN).expect(sound));
    let scene = Scene::from_box((-5.0, 0.0, -5.0), (5.0, 3.0, 5.0)).expect(sound);
    match Focus::new(&view, &sun, &scene).fit(&Settings::default()) {
        Outcome::Map(map) => map,
        none => unreachable!("{none:?}"),
    }
}

/// The place in the map of a point of the scene, by the matrix that is uploaded.
#[must_use]
pub fn place([x, y, z]: [f32; 3]) -> [f32; 4] {
    map().caster_matrix().mul_vec4(shadowfit::glam::Vec4::new(x, y, z, 1.0)).to_array()
}
