//! Stable maps: texels that stay where they are in the world, whatever the camera does.
//!
//! Each property runs some thousands of cases from a fixed seed; `SHADOWFIT_CASES=100000` in the environment runs that many
//! of each instead.

#![allow(clippy::disallowed_methods, reason = "angles and powers spread the cases, they are no part of a fit")]

mod arbitrary;

use std::cell::Cell;

use arbitrary::{Together, case, points_of, run, settings};
use glam::{DMat4, DQuat, DVec2, DVec3, DVec4, Vec3, Vec4};
use proptest::prelude::*;
use shadowfit::{
    Aabb, ClipSpace, ConvexScene, CubeFace, Focus, InputError, Light, Map, Origin, Refusal, Scene, Settings,
    Surrounded, View, Warp, fit,
};

/// Where a camera is, from the middle of the scene, and how it is turned from looking along −z.
#[derive(Clone, Copy, Debug)]
struct Pose {
    eye: [f64; 3],
    turn: DQuat,
}

/// What a camera keeps.
#[derive(Clone, Copy, Debug)]
struct Lens {
    fov_y: f64,
    aspect: f64,
    near: f64,
    far: f64,
    orthographic: bool,
}

impl Lens {
    fn view(&self, middle: DVec3, pose: &Pose) -> View {
        let Self { fov_y, aspect, near, far, orthographic } = *self;
        let (eye, forward, up) = (middle + DVec3::from(pose.eye), pose.turn * DVec3::NEG_Z, pose.turn * DVec3::Y);
        let view = if orthographic {
            View::orthographic(eye, forward, up, 0.1 * far, aspect, near, far)
        } else {
            View::perspective(eye, forward, up, fov_y, aspect, near, far)
        };
        view.expect("a legal view")
    }

    /// The radius of the smallest ball around V, by thirds: the middle is on the axis, and the farthest corner's distance
    /// from it is convex along that.
    fn radius(&self) -> f64 {
        let corners = self.view(DVec3::ZERO, &Pose { eye: [0.0; 3], turn: DQuat::IDENTITY }).corners();
        let corners = corners.expect("a finite far plane");
        let farthest =
            |depth: f64| corners.iter().map(|corner| corner.distance(DVec3::NEG_Z * depth)).fold(0.0, f64::max);
        let (mut low, mut high) = (self.near, self.far);
        for _ in 0..200 {
            let third = (high - low) / 3.0;
            if farthest(low + third) > farthest(high - third) { low += third } else { high -= third }
        }
        farthest(low)
    }
}

fn lens() -> impl Strategy<Value = Lens> {
    (0.3..2.0, 0.5..2.5, 0.05..1.0, 5.0..300.0, any::<bool>())
        .prop_map(|(fov_y, aspect, near, far, orthographic)| Lens { fov_y, aspect, near, far, orthographic })
}

fn pose() -> impl Strategy<Value = Pose> {
    let eye = (-200.0..200.0, 0.0..40.0, -200.0..200.0).prop_map(|(x, y, z)| [x, y, z]);
    (eye, arbitrary::rotation()).prop_map(|(eye, turn)| Pose { eye, turn })
}

/// Not far from another pose, so that much is visible from both.
fn next_to(pose: Pose) -> impl Strategy<Value = Pose> {
    let axis = prop::array::uniform3(-1.0..1.0);
    (prop::array::uniform3(-3.0..3.0), axis, -0.4..0.4).prop_map(move |(step, axis, angle): ([f64; 3], _, f64)| {
        Pose {
            eye: (DVec3::from(pose.eye) + DVec3::from(step)).to_array(),
            turn: DQuat::from_scaled_axis(DVec3::from(axis).normalize_or_zero() * angle) * pose.turn,
        }
    })
}

fn two_poses() -> impl Strategy<Value = [Pose; 2]> {
    prop_oneof![
        (pose(), pose()).prop_map(|(one, other)| [one, other]),
        pose().prop_flat_map(|one| next_to(one).prop_map(move |other| [one, other])),
    ]
}

/// Where the scene is.
fn middle() -> impl Strategy<Value = DVec3> {
    let far_out = |distance: f64| arbitrary::rotation().prop_map(move |turn| (turn * DVec3::X * distance).round());
    prop_oneof![Just(DVec3::ZERO), far_out(1e4), far_out(1e6)]
}

/// The forms that a scene comes in, 800 by 60 by 800 about its middle.
#[derive(Clone, Copy, Debug)]
enum Form {
    Block,
    Flat,
    Convex,
    Lists,
}

fn form() -> impl Strategy<Value = Form> {
    prop::sample::select(vec![Form::Block, Form::Flat, Form::Convex, Form::Lists])
}

impl Form {
    fn with<T>(self, middle: DVec3, use_it: impl FnOnce(&Scene<'_>) -> T) -> T {
        let (min, max) = (middle + DVec3::new(-400.0, 0.0, -400.0), middle + DVec3::new(400.0, 60.0, 400.0));
        let flat = DVec3::new(max.x, min.y, max.z);
        let tip = (min + max) * 0.5 + DVec3::Y * 100.0;
        let convex = ConvexScene::around([min, flat, min + DVec3::X * 800.0, min + DVec3::Z * 800.0, tip]);
        let boxes =
            [Aabb::new(min.as_vec3(), flat.as_vec3()), Aabb::new(middle.as_vec3(), middle.as_vec3() + 20.0)];
        let scene: Result<Scene<'_>, InputError> = match self {
            Self::Block => Scene::from_box(min, max),
            Self::Flat => Scene::from_box(min, flat),
            Self::Convex => Ok(Scene::from_convex(convex.as_ref().expect("a convex scene"))),
            Self::Lists => Scene::new(&boxes, &boxes),
        };
        use_it(&scene.expect("a legal scene"))
    }
}

/// A map of four texels a side or more, square or not, odd sizes and sizes that are no powers of two among them.
fn stable() -> impl Strategy<Value = Settings> {
    let size = || prop::sample::select(vec![4, 5, 64, 1000, 1023, 2048, 4096]);
    let sides = prop_oneof![size().prop_map(|size| (size, size)), (size(), size())];
    (sides, 0.0..0.25).prop_map(|((width, height), border)| {
        let border = (f64::from(width.min(height)) * border) as u32;
        let settings = Settings::new(2048, 1080).and_then(|settings| settings.with_map_sides(width, height));
        let settings = settings.and_then(|settings| settings.with_border(border));
        settings.expect("legal sizes").with_warp(Warp::Stable)
    })
}

/// Rows of the matrix: clip x and y from −1 to 1.
fn rows(map: &Map) -> DMat4 {
    map.shadow_from_world_in(ClipSpace::WGPU).transpose()
}

/// Where a point is in the map, in texels.
fn texels(map: &Map, point: DVec3) -> DVec2 {
    let place = map.shadow_from_world_in(ClipSpace::WGPU).project_point3(point).truncate();
    (place * 0.5 + 0.5) * arbitrary::sides(map.settings())
}

/// How far two numbers are from differing by a whole one.
fn off_whole(difference: DVec2) -> f64 {
    (difference - difference.round()).abs().max_element()
}

/// The sides of a texel of a directional light's map, in world units.
fn sides(map: &Map) -> DVec2 {
    DVec2::new(map.window().width, map.window().height) / arbitrary::sides(map.settings())
}

/// Texels have the same sides to the bit, axes the same direction to the bit, and the grids of two views lie on one another.
/// The window is as wide as the ball around V, the border, a texel, 1/128, and what rounding a side to 13 bits adds.
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
            poses.map(|pose| fit(&lens.view(middle, &pose), &light, scene, &settings).map().copied())
        });
        let [Some(one), Some(other)] = maps else { return };
        counted.set(counted.get() + 1);
        assert_eq!([one.refusal(), other.refusal()], [None; 2]);
        let size = arbitrary::sides(&settings);
        let inner = size - 2.0 * f64::from(settings.border()) - 1.0;
        let room = (1.0 + 1.0 / 128.0) * (1.0 + 1.0 / 4096.0) * (1.0 + 1e-12);
        let largest = 2.0 * lens.radius() * room / inner * size;
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
            let [one, other] = views.map(|view| fit(&view, &light, scene, &settings).map().copied());
            let (Some(one), Some(other)) = (one, other) else { return };
            for point in points_of(&Focus::new(&views[0], &light, scene).visible(), seed) {
                let terms = |map: &Map| {
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

/// The place in the map of a position that is an f32 too, as a vertex shader finds it: x, y, z and at the end the offset.
fn texels_in_f32(map: &Map, position: Vec3) -> DVec2 {
    let matrix = map.matrix();
    let columns = [matrix.x_axis, matrix.y_axis, matrix.z_axis, matrix.w_axis];
    let [x, y, z, offset]: [Vec4; 4] = columns;
    let place = ((x * position.x + y * position.y) + z * position.z) + offset;
    assert_eq!(place.w, 1.0);
    (DVec2::new(place.x.into(), place.y.into()) * 0.5 + 0.5) * arbitrary::sides(map.settings())
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
            let [one, other] = views.map(|view| fit(&view, &light, scene, &settings).map().copied());
            let (Some(one), Some(other)) = (one, other) else { return };
            let bodies = views.map(|view| Focus::new(&view, &light, scene).visible());
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
            let [one, other] = views.map(|view| fit(&view, &light, scene, &settings).map().copied());
            let (Some(one), Some(other)) = (one, other) else { return };
            pairs.set(pairs.get() + 1);
            if sides(&one) != sides(&other) {
                // Grown by other powers of two.
                let times = (sides(&one) / sides(&other)).to_array();
                assert!(times.iter().all(|times| times.log2().fract() == 0.0), "{times:?}");
                other_steps.set(other_steps.get() + 1);
                return;
            }
            let bodies = views.map(|view| Focus::new(&view, &light, scene).visible());
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

/// The window that what is visible needs is inside of the one that is there, in every case: no slack is left to roundings of
/// f64, since the room for those of f32 is far larger.
#[test]
fn the_window_holds_what_is_visible() {
    run(5000, &(case(), settings(), any::<u64>()), |(case, settings, seed)| {
        let together = Together::of(&case);
        let focus = together.focus();
        let [map, uniform] = [Warp::Stable, Warp::Uniform].map(|warp| focus.fit(&settings.with_warp(warp)));
        let (Some(map), Some(uniform)) = (map.map().copied(), uniform.map().copied()) else { return };
        let size = arbitrary::sides(&settings);
        if map.refusal().is_some() {
            assert_eq!(map.matrix(), uniform.matrix());
            return;
        }
        let border = f64::from(settings.border());
        for point in points_of(&focus.visible(), seed) {
            // Where f32 may put a point anywhere, nothing is promised of it.
            if !together.is_served(point) || map.place_rounding(point) > 0.25 * size.min_element() {
                continue;
            }
            let place = texels(&map, point);
            let is_inside = place.min_element() >= border && place.cmple(size - border).all();
            assert!(is_inside, "{point} is at {place} of {size}");
        }
    });
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
        *Form::Block.with(middle, |scene| fit(&view, &light, scene, &settings)).map().expect("one map does")
    });
    let times = sides(&in_world) / sides(&about_eye);
    assert!(
        times.min_element() > 1.0 && times.to_array().iter().all(|times| times.log2().fract() == 0.0),
        "{times}"
    );
    // A line of the coarse grid, half of its map's texels to the side of its middle, is a line of the fine one. The map's
    // texels are at most 10⁸ from the origin, with a few roundings of 2⁻⁵².
    let lines = |map: &Map| {
        let rows = rows(map);
        DVec2::new(rows.x_axis.w, rows.y_axis.w) * 1024.0 * sides(map) / sides(&about_eye)
    };
    assert!(off_whole(lines(&about_eye)) < 1e-6 && off_whole(lines(&in_world)) < 1e-6);
    // No texel is smaller than what f32 makes of places, and w adds next to nothing.
    assert!(in_world.window().rounding <= 1.01, "{}", in_world.window().rounding);
}

/// S is smaller than V, which has no end: nothing of the window moves at all, whatever the camera does, and depth not often.
#[test]
fn a_scene_that_is_smaller_than_the_view_has_one_window() {
    let endless = lens().prop_map(|lens| Lens { far: 1e6, orthographic: false, ..lens });
    let light = arbitrary::rotation();
    run(1000, &(endless, two_poses(), middle(), light, stable(), any::<bool>()), |case| {
        let (lens, poses, middle, sun, settings, infinite) = case;
        let settings = settings.with_origin(Origin::Eye);
        let light = Light::directional(sun * DVec3::Y).expect("a legal light");
        for form in [Form::Block, Form::Flat, Form::Convex] {
            form.with(middle, |scene| {
                let maps = poses.map(|pose| {
                    let view = lens.view(middle, &pose);
                    let eye = middle + DVec3::from(pose.eye);
                    let slope = (0.5 * lens.fov_y).tan();
                    let endless = View::perspective(
                        eye,
                        view.forward(),
                        view.up(),
                        2.0 * slope.atan(),
                        lens.aspect,
                        lens.near,
                        f64::INFINITY,
                    );
                    let view = if infinite { endless.expect("a legal view") } else { view };
                    fit(&view, &light, scene, &settings).map().copied()
                });
                let [Some(one), Some(other)] = maps else { return };
                let (a, b) = (rows(&one), rows(&other));
                assert_eq!([a.x_axis, a.y_axis, a.w_axis], [b.x_axis, b.y_axis, b.w_axis]);
            });
        }
    });
}

/// Spots and faces of cubes have one window, and the same rows to the bit.
#[test]
fn lamps_with_a_frustum_of_their_own_have_one_window() {
    let lamp = (prop::array::uniform3(-20.0..20.0), arbitrary::rotation(), 0.1..1.4, 10.0..300.0, 0..12_usize);
    let cases = (lens(), two_poses(), middle(), lamp, stable(), any::<bool>());
    let [counted, grown] = [(); 2].map(|()| Cell::new(0_usize));
    run(3000, &cases, |(lens, poses, middle, (at, turn, half_angle, range, kind), settings, endless)| {
        let settings = settings.with_origin(Origin::Eye);
        let range = if endless { f64::INFINITY } else { range };
        let position = middle + DVec3::from(at) + DVec3::Y * 25.0;
        let axis = turn * DVec3::X;
        let face = |light: Light| light.cube_face(CubeFace::ALL[kind % 6], 0.1);
        let light = match kind {
            0..4 => Light::spot(position, axis, half_angle, 0.1, range),
            4..8 => Light::point(position, 0.1, range).and_then(face),
            _ => Light::hemisphere(position, axis, 0.1, range).and_then(face),
        };
        let light = light.expect("a legal light");
        for form in [Form::Block, Form::Lists] {
            form.with(middle, |scene| {
                let maps =
                    poses.map(|pose| fit(&lens.view(middle, &pose), &light, scene, &settings).map().copied());
                let [Some(one), Some(other)] = maps else { return };
                counted.set(counted.get() + 1);
                assert_eq!([one.refusal(), other.refusal()], [None; 2]);
                let [a, b] = [&one, &other].map(|map| {
                    let rows = rows(map);
                    [rows.x_axis, rows.y_axis, rows.w_axis]
                });
                if sides(&one) != sides(&other) {
                    // Next to a lamp f32 may need more, above all with an eye that is far from it.
                    grown.set(grown.get() + 1);
                    let times = (sides(&one) / sides(&other)).to_array();
                    assert!(times.iter().all(|times| times.log2().fract() == 0.0), "{times:?}");
                } else if endless {
                    let times = a[2].truncate().length() / b[2].truncate().length();
                    let times = 2.0_f64.powi(times.log2().round() as i32);
                    assert_eq!(a, b.map(|row| row * times));
                } else {
                    assert_eq!(a, b);
                }
            });
        }
    });
    assert!(counted.get() > 300, "{} maps", counted.get());
    // Measured: one in fifty.
    assert!(grown.get() * 20 < counted.get(), "{} of {}", grown.get(), counted.get());
}

/// What a spot lights is what its map is for.
#[test]
fn the_map_of_a_spot_is_as_wide_as_its_cone() {
    let view = View::perspective((0.0, 5.0, 20.0), DVec3::NEG_Z, DVec3::Y, 1.0, 1.6, 0.1, 100.0).expect("sound");
    let scene = Scene::from_box((-50.0, 0.0, -50.0), (50.0, 10.0, 50.0)).expect("sound");
    let settings = Settings::default().with_warp(Warp::Stable);
    for half_angle in [0.2, 0.7, 1.2] {
        let light = Light::spot((0.0, 9.0, 0.0), (0.3, -1.0, 0.2), half_angle, 0.1, 60.0).expect("sound");
        let map = *fit(&view, &light, &scene, &settings).map().expect("one map does");
        let wide = 2.0 * half_angle.tan() * 2048.0 / 2046.0;
        for side in [map.window().width, map.window().height] {
            assert!(side >= wide && side <= wide * (1.0 + 1.0 / 128.0) * (1.0 + 1.0 / 4096.0), "{side} {wide}");
        }
    }
}

/// Both ends of the depth range are whole steps from the world's origin, a sixteenth of the window each.
#[test]
fn depth_ranges_of_a_sun_move_in_steps() {
    let cases = (lens(), two_poses(), form(), arbitrary::rotation(), stable());
    run(1000, &cases, |(lens, poses, form, sun, settings)| {
        let settings = settings.with_origin(Origin::Eye);
        let light = Light::directional(sun * DVec3::Y).expect("a legal light");
        form.with(DVec3::ZERO, |scene| {
            let maps =
                poses.map(|pose| fit(&lens.view(DVec3::ZERO, &pose), &light, scene, &settings).map().copied());
            let [Some(one), Some(other)] = maps else { return };
            let ends = |map: &Map| {
                let row = rows(map).z_axis;
                let length = row.truncate().length().recip();
                [-row.w * length, (1.0 - row.w) * length]
            };
            let step = one.window().width.max(one.window().height) / 16.0;
            // A step is made of 13 bits, a little more than that part of the window.
            let steps = |step: f64| [ends(&one), ends(&other)].concat().into_iter().map(move |end| end / step);
            let step = rounded_up(step);
            for steps in steps(step) {
                assert!((steps - steps.round()).abs() <= 1e-9 * steps.abs().max(1.0), "{steps}");
            }
            if ends(&one) == ends(&other) {
                assert_eq!(rows(&one).z_axis, rows(&other).z_axis);
            }
        });
    });
}

/// To 13 bits.
fn rounded_up(number: f64) -> f64 {
    let unit = 2.0_f64.powi(number.log2().floor() as i32 - 12);
    (number / unit).ceil() * unit
}

/// A walk of six units while turning by a radian, a thousand kilometres out: the light's depth is the same in most frames, and
/// texels are in all.
///
/// The ball around V has a radius of 103 and its middle is 100 before the eye, so that the depth of what is visible, and the
/// place of the window, move by 106 at most: 8 steps of a sixteenth of the window, and one begun. Casters in the window
/// begin at the top of the scene, which slants by 0.45 across the light: 4 steps, and one begun.
#[test]
fn a_walk_changes_depth_rarely_and_texels_never() {
    let middle = DVec3::new(1e6, 0.0, -1e6);
    let lens = Lens { fov_y: 1.0, aspect: 1.6, near: 0.1, far: 100.0, orthographic: false };
    let settings = Settings::default().with_warp(Warp::Stable).with_origin(Origin::Eye);
    let light = Light::directional((0.4, 1.0, 0.2)).expect("sound");
    let maps: Vec<(Map, DVec3)> = (0..100)
        .map(|frame| {
            let frame = f64::from(frame);
            let turn = DQuat::from_rotation_y(0.01 * frame) * DQuat::from_rotation_x(-0.1);
            let pose = Pose { eye: [0.05 * frame, 1.7, -0.03 * frame], turn };
            let view = lens.view(middle, &pose);
            let fitted = Form::Block.with(middle, |scene| fit(&view, &light, scene, &settings));
            (*fitted.map().expect("one map does"), view.eye())
        })
        .collect();
    let (first, first_eye) = &maps[0];
    let at = middle + DVec3::new(3.0, 0.0, -20.0);
    let in_f32 = |map: &Map, eye: DVec3| texels_in_f32(map, (at - eye).as_vec3());
    for (map, eye) in &maps {
        assert_eq!(sides(map), sides(first));
        // A row's terms are 3·10⁷ texels, with four roundings of 2⁻⁵² in either map.
        assert!(off_whole(texels(map, at) - texels(first, at)) < 1e-7);
        // As said above, with d and half about the radius of the ball: 2¹⁰ · 2⁻²¹ · 7.5 for either map.
        assert!(off_whole(in_f32(map, *eye) - in_f32(first, *first_eye)) < 0.008);
    }
    let depths: Vec<_> = maps.iter().map(|(map, _)| rows(map).z_axis).collect();
    let changes = depths.windows(2).filter(|pair| pair[0] != pair[1]).count();
    assert!(changes <= 14, "{changes} changes");
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
                fit(&view.expect("a legal view"), &light, scene, &settings).map().copied()
            });
            let [Some(one), Some(other)] = maps else { return };
            assert_eq!(sides(&one), sides(&other));
            assert_eq!(rows(&one).x_axis.truncate(), rows(&other).x_axis.truncate());
        });
    });
}

/// Lights and views that no stable map is for have the uniform one, and say why.
#[test]
fn refusals() {
    let settings = Settings::default();
    let eye = DVec3::new(0.0, 5.0, 30.0);
    let view = |far| View::perspective(eye, (0.0, -0.2, -1.0), DVec3::Y, 1.0, 1.6, 0.1, far).expect("sound");
    let (min, max) = (DVec3::new(-50.0, 0.0, -50.0), DVec3::new(50.0, 10.0, 20.0));
    let bounds = Scene::from_box(min, max).expect("sound");
    let boxes = [Aabb::new(min.as_vec3(), max.as_vec3())];
    let lists = Scene::new(&boxes, &boxes).expect("sound");
    let above = DVec3::new(0.0, 60.0, -10.0);
    let sun = Light::directional((0.3, 1.0, 0.2)).expect("sound");
    let point = Light::point(above, 0.1, f64::INFINITY).expect("sound");
    let hemisphere = Light::hemisphere(above, DVec3::NEG_Y, 0.1, 200.0).expect("sound");
    let spot = |half_angle| Light::spot(above, DVec3::NEG_Y, half_angle, 0.1, 200.0).expect("sound");
    let face = point.cube_face(CubeFace::NegativeY, 0.1).expect("sound");
    let cases = [
        (sun, bounds, 100.0, None),
        (sun, bounds, f64::INFINITY, None),
        (sun, lists, 100.0, None),
        (sun, lists, f64::INFINITY, Some(Refusal::Endless)),
        (point, bounds, 100.0, Some(Refusal::NoRegion)),
        (hemisphere, bounds, 100.0, Some(Refusal::NoRegion)),
        (spot(0.8), bounds, f64::INFINITY, None),
        (spot(0.8), lists, f64::INFINITY, None),
        (spot(1.5705), bounds, 100.0, Some(Refusal::NoRegion)),
        (face, bounds, f64::INFINITY, None),
    ];
    for (light, scene, far, refusal) in cases {
        let map = |warp| *fit(&view(far), &light, &scene, &settings.with_warp(warp)).map().expect("one map does");
        let (stable, uniform) = (map(Warp::Stable), map(Warp::Uniform));
        assert_eq!(stable.refusal(), refusal, "{light:?}, far {far}");
        assert_eq!(uniform.refusal(), None);
        assert_eq!(stable.matrix() == uniform.matrix(), refusal.is_some(), "{light:?}, far {far}");
        assert_eq!([stable.warp_ratio(), stable.weakening()], [1.0; 2]);
    }
}

/// What no map is for has no stable one.
#[test]
fn lamps_among_what_is_visible_have_none() {
    let view = View::perspective((0.0, 1.7, 0.0), DVec3::NEG_Z, DVec3::Y, 1.0, 1.6, 0.1, 100.0).expect("sound");
    let scene = Scene::from_box((-5.0, 0.0, -9.0), (5.0, 4.0, 2.0)).expect("sound");
    let light = Light::point((0.0, 2.0, -3.0), 0.1, 40.0).expect("sound");
    let settings = Settings::default().with_warp(Warp::Stable);
    assert_eq!(fit(&view, &light, &scene, &settings), shadowfit::Outcome::Surrounded(Surrounded));
}
