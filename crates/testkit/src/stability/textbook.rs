//! The textbook's construction, as it is usually coded: transform the light by the camera's matrix, divide by w, look
//! from there at the middle of the unit cube, fit a frustum to the cube, multiply (Stamminger & Drettakis 2002, §3.2).

use super::arithmetic::Real;
use super::linear::{M4, V3, V4, at, cross, dot, length, one, product, sub, through, times, unit};
use super::setup::Setup;

/// The nearest that the light's near plane may be, in units of the cube's half.
const NEAR: f64 = 0.01;

/// World to the shadow map's clip space, z from 0 to 1. Where the light is inverted, λw < 0, depth runs the other way.
pub fn textbook<T: Real>(setup: &Setup) -> M4<T> {
    let camera = &setup.camera;
    let frame = camera.frame::<T>();
    let (near, far) = (T::of(camera.near), T::of(camera.far));
    let range = far.clone() - near.clone();
    let [x, y] = frame.across.clone();
    let z = sub(
        &times(&frame.depth, &((far.clone() + near.clone()) / range.clone())),
        &times(&one(), &(T::of(2.0) * far * near / range)),
    );
    let clip_from_world = [x, y, z, frame.depth];

    let l = setup.lamp.homogeneous();
    let [x, y, z, w]: V4<T> = clip_from_world.each_ref().map(|row| dot(row, &l));
    let light_from_world = if w == T::of(0.0) {
        let view = looking(&unit(&[-x, -y, -z]), &[0.0; 3].map(T::of));
        product(&parallel(&view), &view)
    } else {
        let place = [x / w.clone(), y / w.clone(), z / w];
        let view = looking(&unit(&place.clone().map(|x| -x)), &place);
        product(&perspective(&view), &view)
    };
    product(&light_from_world, &clip_from_world)
}

/// A view matrix that looks along a unit direction from a point, depth growing away from it.
fn looking<T: Real>(axis: &V3<T>, from: &V3<T>) -> M4<T> {
    let up = if axis[1].abs() < T::of(0.99) { [0.0, 1.0, 0.0] } else { [1.0, 0.0, 0.0] }.map(T::of);
    let side = unit(&cross(axis, &up));
    let up = cross(&side, axis);
    [through(&side, from), through(&up, from), through(axis, from), one()]
}

/// The corners of the unit cube as a view matrix puts them.
fn corners<T: Real>(view: &M4<T>) -> Vec<V3<T>> {
    (0..8_u32)
        .map(|corner| {
            let corner = [0, 1, 2].map(|axis| T::of(if corner >> axis & 1 == 0 { -1.0 } else { 1.0 }));
            [0, 1, 2].map(|row| at(&view[row], &corner))
        })
        .collect()
}

/// The least and the largest of some numbers; zeros where there are none, as when all of them are NaN.
pub fn extent<T: Real>(values: impl Iterator<Item = T>) -> (T, T) {
    let pairs = values.map(|value| (value.clone(), value));
    let both = pairs.reduce(|(min, max), (value, _)| (min.least(value.clone()), max.most(value)));
    both.unwrap_or_else(|| (T::of(0.0), T::of(0.0)))
}

fn parallel<T: Real>(view: &M4<T>) -> M4<T> {
    let corners = corners(view);
    let row = |axis: usize, low: f64| {
        let (min, max) = extent(corners.iter().map(|corner| corner[axis].clone()));
        // From `low` to 1.
        let scale = T::of(1.0 - low) / (max - min.clone());
        let mut row = [0.0; 4].map(T::of);
        (row[axis], row[3]) = (scale.clone(), T::of(low) - min * scale);
        row
    };
    [row(0, -1.0), row(1, -1.0), row(2, 0.0), one()]
}

fn perspective<T: Real>(view: &M4<T>) -> M4<T> {
    let corners = corners(view);
    let (near, far) = extent(corners.iter().map(|corner| corner[2].clone()));
    let near = near.most(T::of(NEAR));
    let before = || corners.iter().filter(|corner| corner[2] >= near);
    let row = |axis: usize| {
        let (min, max) = extent(before().map(|corner| corner[axis].clone() / corner[2].clone()));
        let (sum, difference) = (max.clone() + min.clone(), max - min);
        let mut row = [0.0; 4].map(T::of);
        (row[axis], row[2]) = (T::of(2.0) / difference.clone(), -sum / difference);
        row
    };
    let length = far.clone() - near.clone();
    let depth = [T::of(0.0), T::of(0.0), far.clone() / length.clone(), -(far * near.clone()) / length];
    [row(0), row(1), depth, [0.0, 0.0, 1.0, 0.0].map(T::of)]
}

/// Whether the light, as a point after the camera's perspective, is nearer to the middle of the cube than its corners:
/// some of them may lie behind its image plane.
pub fn is_beside_the_cube(setup: &Setup) -> bool {
    let camera = &setup.camera;
    let frame = camera.frame::<f64>();
    let l = setup.lamp.homogeneous::<f64>();
    let w = dot(&frame.depth, &l);
    let ratio = camera.near / camera.far;
    let z = ((1.0 + ratio) * w - 2.0 * camera.near * l[3]) / (1.0 - ratio);
    let place = [dot(&frame.across[0], &l) / w, dot(&frame.across[1], &l) / w, z / w];
    length(&place) < 3.0_f64.sqrt()
}
