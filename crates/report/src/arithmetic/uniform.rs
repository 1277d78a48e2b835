//! The crate's uniform map of a sun, by the formulas of its documentation, in any of the numbers: a box in the light's own axes
//! around what is visible.

use shadowfit::ShadowMap;
use shadowfit::glam::DVec3;

use testkit::stability::arithmetic::Real;
use testkit::stability::linear::{M4, V3, at, one, sub, through, times, unit, vector};
use testkit::stability::ours::across;
use testkit::stability::setup::Setup;
use testkit::stability::textbook::extent as extent_of;

/// How large the box is: half of its width and height, and where it begins and ends along the light, from the eye.
pub(crate) struct Extent<T> {
    half: [T; 2],
    near: T,
    far: T,
}

impl<T: Real> Extent<T> {
    /// The crate's choice, which has room for what f32 rounds.
    pub(crate) fn of(map: &ShadowMap) -> Self {
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
    let bounds = [&u, &v].map(|row| extent_of(visible.iter().map(|p| at(row, p))));
    let Extent { half, near, far } = extent.unwrap_or_else(|| {
        let half = bounds.each_ref().map(|(min, max)| (max.clone() - min.clone()) / T::of(2.0));
        let corners = (0..8_u32).map(|corner| {
            let of = |axis: usize| if corner >> axis & 1 == 0 { setup.min[axis] } else { setup.max[axis] };
            at(&along, &[0, 1, 2].map(|axis| T::of(of(axis))))
        });
        let far = extent_of(visible.iter().map(|p| at(&along, p))).1;
        Extent { half, near: extent_of(corners).0, far }
    });
    let row = |row, middle: &T, half: &T| times(&sub(row, &times(&one(), middle)), &(T::of(1.0) / half.clone()));
    let [x, y] = bounds.map(|(min, max)| (min + max) / T::of(2.0));
    [row(&u, &x, &half[0]), row(&v, &y, &half[1]), row(&along, &near, &(far - near.clone())), one()]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arithmetic::setups;
    use shadowfit::{ClipSpace, Focus, Warp};
    use testkit::stability::linear::rows_of;
    use testkit::stability::setup::Lamp;

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
            let theirs = rows_of(&map.clip_from_world_in(ClipSpace::WGPU));
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
