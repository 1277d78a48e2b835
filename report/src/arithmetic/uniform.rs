//! The crate's uniform map of a sun, by the formulas of its documentation, in any of the numbers: a box in the light's own axes
//! around what is visible.

use shadowfit::Map;
use shadowfit::glam::DVec3;

use super::stability::arithmetic::Real;
use super::stability::linear::{M4, V3, add, at, cross, dot, length, one, sub, through, times, unit, vector};
use super::stability::setup::Setup;

/// How large the box is: half of its width and height, and where it begins and ends along the light, from the eye.
pub(crate) struct Extent<T> {
    half: [T; 2],
    near: T,
    far: T,
}

impl<T: Real> Extent<T> {
    /// The crate's choice, which has room for what f32 rounds.
    pub(crate) fn of(map: &Map) -> Self {
        let (window, depth) = (map.window(), map.depth());
        Self {
            half: [window.width, window.height].map(|side| T::of(side) / T::of(2.0)),
            near: T::of(depth.near),
            far: T::of(depth.far),
        }
    }
}

/// World to clip space, z from 0 to 1, of a sun that shines from `to_sun`. What is not given of the extent is found: the box
/// then has no room to spare, and begins where the scene does.
pub(crate) fn uniform<T: Real>(
    setup: &Setup,
    to_sun: DVec3,
    visible: &[V3<T>],
    extent: Option<Extent<T>>,
) -> M4<T> {
    let frame = setup.camera.frame::<T>();
    let axis = unit(&vector(-to_sun));
    let (u, v) = across(&axis, &frame.forward, &frame.up);
    let [u, v, along] = [u, v, axis].map(|axis| through(&axis, &frame.eye));
    let bounds = [&u, &v].map(|row| bounds(visible.iter().map(|p| at(row, p))));
    let Extent { half, near, far } = extent.unwrap_or_else(|| {
        let half = bounds.each_ref().map(|(min, max)| (max.clone() - min.clone()) / T::of(2.0));
        let corners = (0..8_u32).map(|corner| {
            let of = |axis: usize| if corner >> axis & 1 == 0 { setup.min[axis] } else { setup.max[axis] };
            at(&along, &[0, 1, 2].map(|axis| T::of(of(axis))))
        });
        let far = self::bounds(visible.iter().map(|p| at(&along, p))).1;
        Extent { half, near: self::bounds(corners).0, far }
    });
    let row = |row, middle: &T, half: &T| times(&sub(row, &times(&one(), middle)), &(T::of(1.0) / half.clone()));
    let [x, y] = bounds.map(|(min, max)| (min + max) / T::of(2.0));
    [row(&u, &x, &half[0]), row(&v, &y, &half[1]), row(&along, &near, &(far - near.clone())), one()]
}

/// The least and the largest; zeros of none.
fn bounds<T: Real>(values: impl Iterator<Item = T>) -> (T, T) {
    let pairs = values.map(|value| (value.clone(), value));
    let both = pairs.reduce(|(min, max), (value, _)| (min.least(value.clone()), max.most(value)));
    both.unwrap_or_else(|| (T::of(0.0), T::of(0.0)))
}

/// The axes across a direction: see the crate's `frame`.
fn across<T: Real>(along: &V3<T>, forward: &V3<T>, up: &V3<T>) -> (V3<T>, V3<T>) {
    let seen = sub(forward, &times(along, &dot(forward, along)));
    let sum = sub(along, up);
    let turned = sub(forward, &times(&sum, &(T::of(2.0) * dot(forward, &sum) / dot(&sum, &sum))));
    let mixed = add(&seen, &times(&turned, &(T::of(1.0) - length(&seen)).most(T::of(0.0))));
    let second = unit(&sub(&mixed, &times(along, &dot(&mixed, along))));
    (unit(&cross(along, &second)), second)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arithmetic::setups;
    use crate::arithmetic::stability::linear::rows_of;
    use crate::arithmetic::stability::setup::Lamp;
    use shadowfit::{ClipSpace, Focus, Warp};

    #[test]
    fn the_formulas_are_the_crates() {
        let mut suns = 0;
        for setup in setups::random(20).taken {
            let Lamp::Sun(to_sun) = setup.lamp else { continue };
            let settings = setup.settings().with_warp(Warp::Uniform);
            let outcome = Focus::new(&setup.camera.view(), &setup.lamp.light(), &setup.scene()).fit(&settings);
            let map = outcome.map().expect("a sun has a map");
            let visible: Vec<V3<f64>> = setup.visible().into_iter().map(vector).collect();
            let rows = uniform(&setup, to_sun, &visible, Some(Extent::of(map)));
            let theirs = rows_of(&map.shadow_from_world_in(ClipSpace::WGPU));
            for p in &visible {
                let [ours, theirs] = [&rows, &theirs].map(|rows| {
                    let [x, y, z, w] = rows.each_ref().map(|row| at(row, p));
                    DVec3::new(x, y, z) / w
                });
                assert!(ours.abs_diff_eq(theirs, 1e-12), "{setup:?}: {ours} {theirs}");
            }
            suns += 1;
        }
        assert!(suns > 5, "{suns} suns");
    }
}
