//! The grid of texels: the same for all cameras.

use super::cameras::{
    Form, Lens, Pose, form, lens, middle, next_to, off_whole, pose, rows, sides, stable, texels, texels_in_f32,
    two_poses,
};
use glam::{DMat4, DQuat, DVec2, DVec3, DVec4};
use proptest::prelude::*;
use shadowfit::{ClipSpace, Focus, Light, Origin, Settings, ShadowMap, View, Warp, fit};
use std::cell::Cell;
use testkit::arbitrary::{self, points_of, run};

/// Texels have the same sides to the bit, axes the same direction to the bit, and the grids of two views lie on one another.
/// The window is as wide as the ball around V, the border, a texel, 1/128, and what rounding a side to 13 bits adds. The ball
/// has room for a frame moved by a pixel across and one up, whose diagonal is 2√2 of the image's half height over its height.
///
/// A row's offset is −2k/N, made of the exact product of k and a texel's side by two more roundings, of 1/half and of the
/// product with that: with ε = 2⁻⁵² it is off by ε of itself at most, in texels N/2 times that. There are two maps, and
/// the difference is exact to half as much again.
#[test]
fn cameras_that_move_and_turn_keep_extent_and_grid() {
    let cases = (lens(), two_poses(), middle(), form(), arbitrary::rotation(), stable());
    let counted = Cell::new(0_usize);
    run(3000, &cases, |(lens, poses, middle, form, sun, settings)| {
        let settings = settings.with_origin(Origin::Eye);
        let light = Light::directional(sun * DVec3::Y).expect("a legal light");
        let maps = form.with(middle, |scene| {
            poses.map(|pose| fit(&lens.view(middle, &pose), &light, scene, &settings).into_map())
        });
        let [Some(one), Some(other)] = maps else { return };
        counted.set(counted.get() + 1);
        assert_eq!([one.fallback(), other.fallback()], [None; 2]);
        let size = arbitrary::sides(&settings);
        let inner = size - 2.0 * f64::from(settings.border()) - 1.0;
        let room = (1.0 + 1.0 / 128.0) * (1.0 + 1.0 / 4096.0) * (1.0 + 1e-12);
        let jittered = 1.0 + 8_f64.sqrt() / f64::from(settings.image_height());
        let largest = 2.0 * lens.radius() * jittered * room / inner * size;
        let window = DVec2::new(one.window().width, one.window().height);
        assert!(window.cmple(largest).all(), "{window} of at most {largest}");
        assert_eq!(sides(&one), sides(&other));
        let (a, b) = (rows(&one), rows(&other));
        for (a, b, size) in [(a.x_axis, b.x_axis, size.x), (a.y_axis, b.y_axis, size.y)] {
            assert_eq!(a.truncate(), b.truncate());
            let apart = (a.w - b.w) * 0.5 * size;
            let bound = 1.5 * f64::EPSILON * (a.w.abs() + b.w.abs()) * 0.5 * size;
            assert!((apart - apart.round()).abs() <= bound, "grids are {apart} texels apart, within {bound:e}");
        }
        assert_eq!(a.w_axis, b.w_axis);
    });
    assert!(counted.get() > 300, "{} maps", counted.get());
}

/// In f64 a point of the world stays where it is in its texel: its row is a sum of four terms with a relative error of ε
/// each, and the division by w, which is 1, and the step to texels take as much again of a coordinate that may be as large.
#[test]
fn points_stay_where_they_are_in_their_texels() {
    let cases = (lens(), two_poses(), middle(), form(), arbitrary::rotation(), (stable(), any::<u64>()));
    run(3000, &cases, |(lens, poses, middle, form, sun, (settings, seed))| {
        let light = Light::directional(sun * DVec3::Y).expect("a legal light");
        let settings = settings.with_origin(Origin::Eye);
        form.with(middle, |scene| {
            let views = poses.map(|pose| lens.view(middle, &pose));
            let [one, other] = views.map(|view| fit(&view, &light, scene, &settings).into_map());
            let (Some(one), Some(other)) = (one, other) else { return };
            for point in points_of(&Focus::new(&views[0], &light, scene).receiver_volume(), seed) {
                let terms = |map: &ShadowMap| {
                    let rows = rows(map);
                    let terms = |row: DVec4| row.truncate().abs().dot(point.abs()) + row.w.abs();
                    terms(rows.x_axis).max(terms(rows.y_axis)) + 1.0
                };
                let size = arbitrary::sides(&settings);
                let bound = 4.0 * f64::EPSILON * (terms(&one) + terms(&other)) * size;
                let moved = texels(&one, point) - texels(&other, point);
                let off = (moved - moved.round()).abs();
                assert!(off.cmple(bound).all(), "{point} moves by {off} of a texel, not {bound}");
            }
        });
    });
}

/// About the eye a point stays where it is in its texel to what f32 makes of either map, and that does not depend on where the
/// eye is but for what f64 loses.
///
/// For points no farther than d from the eye on any axis, the first three terms of a row, of length 1/half, are at most
/// √3 d/half together, and so the fourth, its value at the eye, is at most that and 1: eight roundings of f32 of these, and
/// of w thrice. Moving the rows to the eye loses 32 roundings of f64 of terms of |eye|/half.
#[test]
fn points_stay_where_they_are_in_f32_about_the_eye() {
    let size = 2048;
    let settings = Settings::new(size, 1080).expect("legal sizes").with_warp(Warp::Stable).with_origin(Origin::Eye);
    let poses = pose().prop_flat_map(|one| next_to(one).prop_map(move |other| [one, other]));
    let cases = (lens(), poses, middle(), form(), arbitrary::rotation(), any::<u64>());
    let counted = Cell::new(0_usize);
    run(3000, &cases, |(lens, poses, middle, form, sun, seed)| {
        let light = Light::directional(sun * DVec3::Y).expect("a legal light");
        form.with(middle, |scene| {
            let views = poses.map(|pose| lens.view(middle, &pose));
            let [one, other] = views.map(|view| fit(&view, &light, scene, &settings).into_map());
            let (Some(one), Some(other)) = (one, other) else { return };
            let bodies = views.map(|view| Focus::new(&view, &light, scene).receiver_volume());
            for ((map, view), body) in [&one, &other].into_iter().zip(&views).zip(&bodies) {
                let distances = body.vertices().iter().map(|vertex| (vertex - view.eye()).abs().max_element());
                let (d, root) = (distances.fold(0.0, f64::max), 3.0_f64.sqrt());
                let half = sides(map).min_element() * 0.5 * f64::from(size);
                let of_f32 = 8.0 / 16_777_216.0 * (2.0 * root * d / half + 1.0 + 3.0);
                let of_f64 = 32.0 * f64::EPSILON * (root * view.eye().abs().max_element() / half + 4.0);
                let bound = 0.5 * f64::from(size) * (of_f32 + of_f64) * (1.0 + 1e-6);
                assert!(map.window().rounding <= bound, "{} {bound}", map.window().rounding);
            }
            for point in points_of(&bodies[0], seed) {
                if !bodies[1].contains(point) {
                    continue;
                }
                counted.set(counted.get() + 1);
                let [a, b] = [(&one, &views[0]), (&other, &views[1])]
                    .map(|(map, view)| texels_in_f32(map, (point - view.eye()).as_vec3()));
                let bound = one.place_rounding(point) + other.place_rounding(point);
                let off = off_whole(a - b);
                assert!(off <= bound, "{point} moves by {off:e} of a texel, not {bound:e}");
            }
        });
    });
    assert!(counted.get() > 1000, "{} points", counted.get());
}

/// About the world's origin f32 may make anything of a point's place within the steps of its coordinates, but it makes the
/// same of it in each frame.
///
/// Rows have the same normals to the bit, so that the sum of the first three terms has the same bits too. The offset 2k/N of
/// a map whose size is a power of two is exact in f32 below k = 2²⁴, so that what differs is the last sum, whose result is no
/// larger than 1: half of 2⁻²⁴ of the clip volume in each map, N/2 texels. No k is larger, because no texel is smaller than
/// eight roundings of f32, 2⁻²¹, of coordinates.
#[test]
fn points_stay_where_they_are_in_f32_about_the_origin() {
    let poses = pose().prop_flat_map(|one| next_to(one).prop_map(move |other| [one, other]));
    let size = prop::sample::select(vec![64, 512, 2048, 4096]);
    let cases = (lens(), poses, middle(), form(), arbitrary::rotation(), (size, any::<u64>()));
    let [counted, pairs, other_steps] = [(); 3].map(|()| Cell::new(0_usize));
    run(3000, &cases, |(lens, poses, middle, form, sun, (size, seed))| {
        let settings = Settings::new(size, 1080).expect("legal sizes").with_warp(Warp::Stable);
        let light = Light::directional(sun * DVec3::Y).expect("a legal light");
        form.with(middle, |scene| {
            let views = poses.map(|pose| lens.view(middle, &pose));
            let [one, other] = views.map(|view| fit(&view, &light, scene, &settings).into_map());
            let (Some(one), Some(other)) = (one, other) else { return };
            pairs.set(pairs.get() + 1);
            if sides(&one) != sides(&other) {
                // Grown by other powers of two.
                let times = (sides(&one) / sides(&other)).to_array();
                assert!(times.iter().all(|times| times.log2().fract() == 0.0), "{times:?}");
                other_steps.set(other_steps.get() + 1);
                return;
            }
            let bodies = views.map(|view| Focus::new(&view, &light, scene).receiver_volume());
            for point in points_of(&bodies[0], seed) {
                if !bodies[1].contains(point) {
                    continue;
                }
                counted.set(counted.get() + 1);
                let [a, b] = [&one, &other].map(|map| texels_in_f32(map, point.as_vec3()));
                let (off, bound) = (off_whole(a - b), f64::from(size) / 33_554_432.0);
                assert!(off <= bound, "{point} moves by {off:e} of a texel, not {bound:e}");
            }
        });
    });
    assert!(counted.get() > 1000, "{} points", counted.get());
    // Measured: one in two thousand.
    assert!(other_steps.get() * 100 < pairs.get(), "{} of {}", other_steps.get(), pairs.get());
}

/// Where coordinates have steps that are larger than the texels, those double until they are not, and the lines that stay are the
/// same ones.
#[test]
fn texels_grow_by_powers_of_two() {
    let middle = DVec3::new(1e7, 0.0, 2e6);
    let lens = Lens { fov_y: 1.0, aspect: 1.6, near: 0.1, far: 100.0, orthographic: false };
    let view = lens.view(middle, &Pose { eye: [3.0, 1.7, 9.0], turn: DQuat::IDENTITY });
    let light = Light::directional((0.4, 1.0, 0.2)).expect("sound");
    let [about_eye, in_world] = [Origin::Eye, Origin::World].map(|origin| {
        let settings = Settings::default().with_warp(Warp::Stable).with_origin(origin);
        Form::Block.with(middle, |scene| fit(&view, &light, scene, &settings)).into_map().expect("one map does")
    });
    let times = sides(&in_world) / sides(&about_eye);
    assert!(
        times.min_element() > 1.0 && times.to_array().iter().all(|times| times.log2().fract() == 0.0),
        "{times}"
    );
    // A line of the coarse grid, half of its map's texels to the side of its middle, is a line of the fine one. The map's
    // texels are at most 10⁸ from the origin, with a few roundings of 2⁻⁵².
    let lines = |map: &ShadowMap| {
        let rows = rows(map);
        DVec2::new(rows.x_axis.w, rows.y_axis.w) * 1024.0 * sides(map) / sides(&about_eye)
    };
    assert!(off_whole(lines(&about_eye)) < 1e-6 && off_whole(lines(&in_world)) < 1e-6);
    // No texel is smaller than what f32 makes of places, and w adds next to nothing.
    assert!(in_world.window().rounding <= 1.01, "{}", in_world.window().rounding);
}

/// A view whose numbers come of matrices, which are taken apart with other roundings at every turn.
#[test]
fn views_by_their_matrices_have_one_grid_too() {
    let (near, far) = (0.1, 150.0);
    let depth = far / (near - far);
    let projection = DMat4::from_cols(
        DVec4::X * 1.2,
        DVec4::Y * 2.1,
        DVec4::new(0.1, -0.2, depth, -1.0),
        DVec4::Z * (near * depth),
    );
    let settings = Settings::default().with_warp(Warp::Stable).with_origin(Origin::Eye);
    run(500, &(two_poses(), arbitrary::rotation()), |(poses, sun)| {
        let light = Light::directional(sun * DVec3::Y).expect("a legal light");
        Form::Block.with(DVec3::ZERO, |scene| {
            let maps = poses.map(|pose| {
                let world_from_eye = DMat4::from_rotation_translation(pose.turn, pose.eye.into());
                let view = View::from_matrices(world_from_eye.inverse(), projection, ClipSpace::WGPU);
                fit(&view.expect("a legal view"), &light, scene, &settings).into_map()
            });
            let [Some(one), Some(other)] = maps else { return };
            assert_eq!(sides(&one), sides(&other));
            assert_eq!(rows(&one).x_axis.truncate(), rows(&other).x_axis.truncate());
        });
    });
}
