//! Values of the camera's own depth buffer, back as depths.

use glam::DVec3;
use proptest::prelude::*;
use shadowfit::{
    View,
    input::{DepthRange, Lens},
};
use testkit::arbitrary::{Numbers, Together, case, run};

#[test]
fn what_the_projection_stores_is_the_depth_it_came_from() {
    run(3000, &(case(), any::<u64>()), |(case, seed)| {
        let view = Together::of(&case).view;
        let rows = view.clip_from_world().transpose();
        let mut numbers = Numbers(seed);
        for _ in 0..8 {
            // Any depth, those close to the near plane as likely as far ones.
            let far = if view.far().is_finite() { view.far() } else { view.near() * 1e9 };
            let depth = view.near() + (far - view.near()) * 10_f64.powf(-9.0 * numbers.part());
            let point = (view.eye() + view.forward() * depth).extend(1.0);
            // From −1 at the near plane to 1 at the far one, off by what two rows of four products are off by.
            let w = rows.w_axis.dot(point);
            let z = rows.z_axis.dot(point) / w;
            let terms = |row: glam::DVec4| row.abs().dot(point.abs()) + row.truncate().abs().dot(view.eye().abs());
            let slack = 16.0 * f64::EPSILON * (terms(rows.z_axis) + terms(rows.w_axis)) / w;
            for (range, stored) in [
                (DepthRange::ZeroToOne, 0.5 + 0.5 * z),
                (DepthRange::NegativeOneToOne, 0.5 + 0.5 * z),
                (DepthRange::ZeroToOneReversed, 0.5 - 0.5 * z),
                (DepthRange::NegativeOneToOneReversed, 0.5 - 0.5 * z),
            ] {
                let found = view.depth_of(stored, range);
                // A perspective stores 1/depth, between 1/near and 1/far; its differences count depth² as much.
                let slack = match view.lens() {
                    Lens::Perspective => found.max(depth) * found.max(depth) / view.near() * slack,
                    Lens::Orthographic => (view.far() - view.near()) * slack,
                };
                let slack = slack + 16.0 * f64::EPSILON * (depth.abs() + view.eye().abs().max_element());
                assert!((found - depth).abs() <= slack, "{range:?}: {stored} is {found}, not {depth} to {slack:e}");
            }
        }
    });
}

#[test]
fn values_beyond_the_ends_are_the_ends() {
    let view = |far| View::perspective(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 1.0, 1.6, 0.5, far).expect("sound");
    for far in [100.0, f64::INFINITY] {
        let depth = |stored, range| view(far).depth_of(stored, range);
        for (near_end, far_end, range) in
            [(-0.5, 1.5, DepthRange::ZeroToOne), (2.0, -1.0, DepthRange::ZeroToOneReversed)]
        {
            assert_eq!((depth(near_end, range), depth(far_end, range)), (0.5, far));
            assert!((0.5..=far).contains(&depth(f64::NAN, range)));
        }
    }
    // Reversed and without end a float's smallest steps are the farthest away.
    let tiny = f64::from(f32::MIN_POSITIVE);
    assert_eq!(view(f64::INFINITY).depth_of(tiny, DepthRange::ZeroToOneReversed), 0.5 / tiny);
    let flat = View::orthographic(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 3.0, 1.6, -2.0, 6.0).expect("sound");
    assert_eq!(flat.depth_of(0.25, DepthRange::ZeroToOne), 0.0);
    assert_eq!(flat.depth_of(0.25, DepthRange::NegativeOneToOneReversed), 4.0);
}
