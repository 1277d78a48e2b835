//! Paraboloid maps: the projection against its closed forms, what f32 makes of it, what straight edges make of it, and the
//! fit over views, lights and scenes at random.

#![allow(clippy::disallowed_methods, reason = "angles and powers spread the cases, they are no part of a fit")]

mod arbitrary;

use arbitrary::{Numbers, Together, case, points_of, run, settings};
use glam::{DVec2, DVec3, Vec2, Vec3, Vec4, Vec4Swizzles};
use proptest::prelude::*;
use shadowfit::{
    Body, ClipSpace, DepthFormat, Empty, Focus, Light, Offset, Origin, Paraboloid, Paraboloids, Problem, Scene,
    Settings, View,
};
use std::cell::Cell;
use std::f64::consts::{FRAC_PI_2, TAU};

fn view() -> View {
    View::perspective((0.5, 2.0, 9.0), (0.0, 0.1, -1.0), DVec3::Y, 1.0, 1.5, 0.1, 100.0).expect("sound")
}

/// A room of 10 by 6 by 20 about the origin.
fn room() -> Scene<'static> {
    Scene::from_box((-5.0, -3.0, -10.0), (5.0, 3.0, 10.0)).expect("sound")
}

fn lamp(position: [f64; 3]) -> Light {
    Light::point(position, 0.1, f64::INFINITY).expect("sound")
}

/// Both maps of a lamp in the middle of the room.
fn both(settings: &Settings) -> [Paraboloid; 2] {
    match Focus::new(&view(), &lamp([0.0, 0.5, 1.0]), &room()).paraboloids(settings) {
        Paraboloids::Two(maps) => maps,
        other => panic!("the lamp is among what is visible: {other:?}"),
    }
}

fn texels_per_unit(settings: &Settings) -> f64 {
    0.5 * f64::from(settings.map_size()) - f64::from(settings.border())
}

/// Any direction, many of them near the rim, the axis, or straight behind.
fn direction_about(numbers: &mut Numbers) -> DVec3 {
    let (kind, sign) = (numbers.part(), if numbers.part() < 0.5 { -1.0 } else { 1.0 });
    let tiny = 10_f64.powf(-14.0 * numbers.part());
    let angle = match kind {
        _ if kind < 0.5 => (1.0 - 2.0 * numbers.part()).acos(),
        _ if kind < 0.7 => FRAC_PI_2 + sign * tiny,
        _ if kind < 0.85 => tiny,
        _ => std::f64::consts::PI - tiny,
    };
    let around = TAU * numbers.part();
    DVec3::new(angle.sin() * around.cos(), angle.sin() * around.sin(), angle.cos()).normalize()
}

/// The same in the frame of a map.
fn from_light(map: &Paraboloid, local: DVec3) -> DVec3 {
    let place = |u, v| (map.unproject(DVec3::new(u, v, 1.0)) - map.position()).normalize();
    // (1, 0) and (0, 1) are on the rim, along the axes of the frame.
    place(1.0, 0.0) * local.x + place(0.0, 1.0) * local.y + map.axis() * local.z
}

#[test]
fn places_are_those_of_the_paper() {
    for map in both(&Settings::default()) {
        let at = |u: f64, v: f64| map.unproject(DVec3::new(u, v, 0.5)) - map.position();
        let distance = 0.5 * (map.near() + map.far());
        // The middle is the axis, the rim is across it, and outside of the rim is behind.
        assert!((at(0.0, 0.0) - map.axis() * distance).length() <= 1e-14 * distance);
        for around in [0.0_f64, 1.0, 2.0, 4.0] {
            let (v, u) = around.sin_cos();
            assert!(map.clip_plane().at(map.position() + at(u, v)).abs() <= 1e-14 * distance);
            assert!(map.clip_plane().at(map.position() + at(1.1 * u, 1.1 * v)) < 0.0);
            // tan(θ/2) for a direction θ away from the axis.
            let half = at(0.5 * u, 0.5 * v).angle_between(map.axis()) / 2.0;
            assert!((half.tan() - 0.5).abs() <= 1e-6, "{half}");
        }
    }
}

#[test]
fn project_and_unproject_undo_each_other() {
    let mut numbers = Numbers(1);
    // About the origin, so that the world's coordinates are no coarser than the frame's.
    let light = Light::point(DVec3::ZERO, 0.1, f64::INFINITY).expect("sound");
    let focus = Focus::new(&view(), &light, &room());
    for map in focus.paraboloids(&Settings::default()).maps() {
        for _ in 0..20_000 {
            let distance = 20.0 * numbers.part() + 0.01;
            let local = direction_about(&mut numbers);
            let point = from_light(map, local) * distance;
            let place = map.project(point).expect("nothing is exactly behind");
            let back = map.unproject(place);
            // A dozen roundings of the distance and, in depth, of the range.
            let allowed = 16.0 * f64::EPSILON * (distance + map.far());
            assert!((back - point).length() <= allowed, "{local}: {point} {back}");
            // The world's rounding of a point near the rim may put it on either side.
            if local.z.abs() > 1e-15 {
                assert_eq!(place.truncate().length() < 1.0 + 1e-15, local.z > -1e-15, "{local} {place}");
            }
        }
        let opposite = map.opposite();
        assert_eq!(opposite.opposite(), *map);
        assert_eq!(map.project(map.position()), None);
        assert_eq!(
            opposite.project(opposite.unproject(DVec3::new(0.0, 0.0, 1.0))).map(DVec3::truncate),
            Some(DVec2::ZERO)
        );
        assert_eq!(map.project(map.position() - map.axis() * 3.0), None);
        // As near to straight behind as numbers go.
        let place = DVec3::new(3e200, -1e200, 1.0);
        assert!((map.unproject(place) + map.axis() * map.far()).length() <= 1e-12);
    }
}

#[test]
fn both_hemispheres_mirror_each_other() {
    let [front, back] = both(&Settings::default());
    let mut numbers = Numbers(2);
    for _ in 0..1000 {
        let point = front.position() + from_light(&front, direction_about(&mut numbers)) * 3.0;
        let [Some(a), Some(b)] = [front, back].map(|map| map.project(point)) else { continue };
        let (a_place, b_place) = (a.truncate(), b.truncate());
        // Inverse points about the rim, u turned.
        let inverse = a_place * DVec2::new(-1.0, 1.0) / a_place.length_squared();
        assert!((inverse - b_place).length() <= 1e-7 * b_place.length(), "{a} {b}");
        assert_eq!(a.z, b.z);
    }
}

#[test]
fn footprints_are_squares_and_the_numeric_ones() {
    let settings = Settings::new(1024, 1080).and_then(|settings| settings.with_border(5)).expect("sound");
    let mut numbers = Numbers(3);
    for map in both(&settings) {
        for _ in 0..2000 {
            let local = direction_about(&mut numbers);
            let distance = 1.0 + 9.0 * numbers.part();
            // Straight behind, texels are smaller than any step for a difference.
            if local.z < -0.999 {
                continue;
            }
            let point = map.position() + from_light(&map, local) * distance;
            let footprint = map.footprint(point).expect("not behind");
            let angle = (1.0 + local.z) / texels_per_unit(&settings);
            for side in [footprint.along_x, footprint.along_y] {
                assert!((side.length() / (distance * angle) - 1.0).abs() <= 1e-9, "{local}");
                assert!(side.dot(point - map.position()).abs() <= 1e-9 * side.length() * distance);
            }
            assert!(footprint.along_x.dot(footprint.along_y).abs() <= 1e-9 * footprint.area());
            assert!((footprint.longest() / footprint.shortest() - 1.0).abs() <= 1e-6);
            // A thousandth of a texel along either side moves the place by that much, and to that order by no more.
            let place = map.project(point).expect("not behind").truncate();
            for (side, expected) in [(footprint.along_x, DVec2::X), (footprint.along_y, DVec2::Y)] {
                let moved = map.project(point + side * 1e-3).expect("not behind").truncate();
                let texels = (moved - place) * texels_per_unit(&settings) / 1e-3;
                assert!((texels - expected).length() <= 1e-4, "{local}: {texels}");
            }
            let texel = footprint.longest() / map.pixel_size(point);
            assert!((map.aliasing(point).expect("not behind") / texel - 1.0).abs() <= 1e-12);
        }
        let middle = map.position() + map.axis() * 5.0;
        let range = map.far() - map.near();
        assert_eq!(map.depth_resolution(middle, DepthFormat::Unorm16), range / 65_535.0);
    }
}

/// The WGSL, in f32.
struct Shader {
    place: DVec3,
    clip: Vec2,
    /// Whether the fragment shader keeps the vertex.
    kept: bool,
    texture: Vec4,
}

fn shader(map: &Paraboloid, position: Vec3) -> Shader {
    let q = map.matrix() * position.extend(1.0);
    let (clip_scale, texture_scale) = (map.clip_scale(), map.texture_scale());
    let distance = q.xyz().length();
    let divisor = (distance + q.z).max(1e-6 * distance + 1e-30);
    let (place, depth) = (q.xy() / divisor, distance - q.w);
    let read = place * texture_scale.xy() + 0.5;
    Shader {
        place: place.extend(depth).as_dvec3(),
        clip: place * clip_scale,
        kept: clip_scale.x * clip_scale.x * (1.0 - 2.0 * (q.z / divisor)) <= 1.0,
        texture: read.extend(depth * texture_scale.z + texture_scale.w).extend(q.z),
    }
}

fn origin(map: &Paraboloid) -> DVec3 {
    match map.settings().origin() {
        Origin::World => DVec3::ZERO,
        Origin::Eye => map.view().eye(),
    }
}

#[test]
fn f32_carries_points_no_farther_than_the_map_says() {
    run(3000, &(case(), settings(), any::<u64>()), |(case, settings, seed)| {
        let together = Together::of(&case);
        let focus = together.focus();
        for map in focus.paraboloids(&settings).maps() {
            for point in points_of(&focus.visible(), seed) {
                let exact = match map.project(point) {
                    Some(place) if map.clip_plane().at(point) >= 0.0 => place,
                    _ => continue,
                };
                let rounding = map.rounding(point);
                let shader = shader(map, (point - origin(map)).as_vec3());
                let off = shader.place - exact;
                assert!(off.z.abs() <= rounding.depth, "{point}: depth off by {}, {rounding:?}", off.z);
                let texels = off.truncate().length() * texels_per_unit(&settings);
                assert!(texels <= rounding.texels, "{point}: off by {texels}, {rounding:?}");
            }
        }
    });
}

#[test]
fn the_shader_honours_clip_conventions() {
    let clips = [ClipSpace::WGPU, ClipSpace::VULKAN.reversed(), ClipSpace::OPENGL, ClipSpace::OPENGL.reversed()];
    for clip in clips {
        let settings = Settings::new(512, 1080).and_then(|settings| settings.with_border(8)).expect("sound");
        for map in both(&settings.with_clip(clip)) {
            let mut numbers = Numbers(4);
            for _ in 0..200 {
                let local = direction_about(&mut numbers);
                if local.z < -0.5 {
                    continue;
                }
                let point = map.position() + from_light(&map, local) * (1.0 + 7.0 * numbers.part());
                let place = map.project(point).expect("not behind");
                let shader = shader(&map, point.as_vec3());
                let held = if clip.depth.is_reversed() { 1.0 - place.z } else { place.z };
                let inner = 1.0 - 16.0 / 512.0;
                let up = if clip == ClipSpace::VULKAN.reversed() { -1.0 } else { 1.0 };
                let clip_place = DVec2::new(place.x * inner, place.y * inner * up);
                assert!((shader.clip.as_dvec2() - clip_place).length() < 1e-5, "{clip:?}");
                // Only OpenGL has its first row at the bottom.
                let down = if clip.texture_origin == ClipSpace::OPENGL.texture_origin { 1.0 } else { -1.0 };
                let read = DVec3::new(0.5 + 0.5 * inner * place.x, 0.5 + 0.5 * inner * place.y * down, held);
                assert!((shader.texture.xyz().as_dvec3() - read).length() < 1e-5, "{clip:?}");
                if local.z.abs() > 1e-6 {
                    assert_eq!(shader.texture.w >= 0.0, local.z >= 0.0);
                }
                // What is drawn ends with the map.
                let reach = place.truncate().length() * inner;
                if (reach - 1.0).abs() > 1e-5 {
                    assert_eq!(shader.kept, reach <= 1.0, "{local}");
                }
            }
        }
    }
}

#[test]
fn vertices_behind_the_light_are_somewhere_and_cut_off() {
    for map in both(&Settings::default()) {
        for distance in [1e-3, 1.0, 10.0] {
            for local in [DVec3::NEG_Z, DVec3::new(1e-9, 0.0, -1.0), DVec3::new(1e-4, -1e-4, -1.0)] {
                let point = map.position() + from_light(&map, local.normalize()) * distance;
                let shader = shader(&map, point.as_vec3());
                assert!(shader.clip.is_finite() && !shader.kept, "{local} {}", shader.clip);
            }
        }
        let at_light = shader(&map, map.position().as_vec3());
        assert!(at_light.clip.is_finite());
    }
}

/// A part of a straight edge: where it is drawn, the point of the edge whose part it is, and where that should be.
struct Fragment {
    drawn: DVec3,
    point: DVec3,
    exact: DVec3,
}

fn fragment(map: &Paraboloid, [a, b]: [DVec3; 2], part: f64) -> Option<Fragment> {
    let [from, to] = [map.project(a)?, map.project(b)?];
    let [g, h] = [(a, from), (b, to)]
        .map(|(point, place)| (1.0 + place.truncate().length_squared()) / point.distance(map.position()));
    let (g, h) = ((1.0 - part) * g, part * h);
    let point = a + (b - a) * (h / (g + h));
    Some(Fragment { drawn: from.lerp(to, part), point, exact: map.project(point)? })
}

/// Edges near and across the rim, with ends at any two distances.
fn edges(map: &Paraboloid, angle: f64, count: usize) -> Vec<[DVec3; 2]> {
    let mut numbers = Numbers(5);
    let mut all = Vec::new();
    while all.len() < count {
        let first = direction_about(&mut numbers);
        let across = direction_about(&mut numbers).cross(first);
        let (Some(across), true) = (across.try_normalize(), first.z > -angle.sin()) else { continue };
        let second = first * angle.cos() + across * angle.sin();
        let mut distance = || 10_f64.powf(3.0 * numbers.part() - 1.0);
        let ends = [first, second].map(|local| map.position() + from_light(map, local) * distance());
        all.push(ends);
    }
    all
}

#[test]
fn straight_edges_are_drawn_no_farther_off_than_said() {
    for settings in [Settings::default(), Settings::new(256, 1080).and_then(|s| s.with_border(9)).expect("sound")] {
        let [map, _] = both(&settings);
        for angle in [1e-3, 0.02, 0.0884, 0.3, 0.8, FRAC_PI_2] {
            let (mut most, mut most_depth): (f64, f64) = (0.0, 0.0);
            let said = map.edge_error(angle);
            for ends in edges(&map, angle, 20_000) {
                let inside = ends.iter().all(|&end| map.clip_plane().at(end) >= 0.0);
                for part in [0.1, 0.3, 0.5, 0.8] {
                    let Some(Fragment { drawn, point, exact }) = fragment(&map, ends, part) else { continue };
                    if map.clip_plane().at(point) < 0.0 {
                        continue;
                    }
                    let off = (drawn - exact).truncate().length() * texels_per_unit(&settings);
                    // Places near 1 are rounded, and so is the point.
                    let rounding = 64.0 * f64::EPSILON * texels_per_unit(&settings);
                    most = most.max(off / said);
                    assert!(off <= said + rounding, "{angle}: {ends:?} at {part}: {off}, said {said}");
                    if inside {
                        let range = map.far() - map.near();
                        let off = (drawn - exact).z.abs() * range;
                        let said = map.edge_depth_error(ends[0], ends[1]);
                        let rounding = 64.0 * f64::EPSILON * (range + point.distance(map.position()) + 1e3);
                        most_depth = most_depth.max(off / said);
                        assert!(off <= said + rounding, "{angle}: {ends:?} at {part}: {off}, said {said}");
                    }
                }
            }
            assert!(most > 0.9, "{angle}: {most}");
            assert!(most_depth > 0.9, "{angle}: {most_depth}");
            // And along the rim it gets there, in depth too.
            let (sine, cosine) = (0.5 * angle).sin_cos();
            let ends = [sine, -sine].map(|x| map.position() + from_light(&map, DVec3::new(x, cosine, 0.0)) * 3.0);
            let Fragment { drawn, exact, .. } = fragment(&map, ends, 0.5).expect("before the light");
            let off = (drawn - exact).truncate().length() * texels_per_unit(&settings);
            assert!((off / said - 1.0).abs() <= 1e-8, "{off} {said}");
            let off = (drawn - exact).z * (map.far() - map.near());
            let said = map.edge_depth_error(ends[0], ends[1]);
            assert!((off / said - 1.0).abs() <= 1e-6, "{off} {said}");
            assert!((said / (3.0 * 2.0 * (0.25 * angle).sin().powi(2)) - 1.0).abs() <= 1e-6);
        }
    }
}

#[test]
fn the_insides_of_triangles_are_off_by_four_thirds_of_that() {
    let [map, _] = both(&Settings::default());
    let mut numbers = Numbers(6);
    let mut most: f64 = 0.0;
    for _ in 0..20_000 {
        let angle: f64 = 0.1;
        let middle = direction_about(&mut numbers);
        let (across, up) = middle.any_orthonormal_pair();
        let turn = TAU * numbers.part();
        let reach = (2.0 / 3_f64.sqrt() * (0.5 * angle).sin()).asin();
        let corners = [0.0, 1.0, 2.0].map(|third| {
            let (y, x) = (turn + third / 3.0 * TAU).sin_cos();
            map.position() + from_light(&map, middle * reach.cos() + (across * x + up * y) * reach.sin())
        });
        if corners.iter().any(|&corner| map.clip_plane().at(corner) < 0.0) {
            continue;
        }
        let places = corners.map(|corner| map.project(corner).expect("before the light").truncate());
        let drawn = (places[0] + places[1] + places[2]) / 3.0;
        let weights = places.map(|place| 1.0 + place.length_squared());
        let point = corners.iter().zip(weights).map(|(corner, weight)| corner * weight).sum::<DVec3>();
        let point = point / weights.iter().sum::<f64>();
        let exact = map.project(point).expect("before the light").truncate();
        most = most.max((drawn - exact).length() * texels_per_unit(map.settings()) / map.edge_error(angle));
    }
    // 4/3 to the first order in the angle squared.
    assert!(most <= 4.0 / 3.0 * (1.0 + 0.1 * 0.1) && most > 1.2, "{most}");
}

#[test]
fn the_largest_edge_is_the_inverse_of_its_error() {
    let [map, _] = both(&Settings::new(1024, 1080).and_then(|s| s.with_border(0)).expect("sound"));
    for texels in [1e-3, 0.25, 0.5, 1.0, 3.0, 20.0] {
        let angle = map.largest_edge(texels);
        assert!((map.edge_error(angle) / texels - 1.0).abs() <= 1e-12, "{texels}");
        // DESIGN: α = 2 arccos(1 − 2ε/N).
        assert!((angle - 2.0 * (1.0 - texels / 512.0).acos()).abs() <= 1e-9, "{texels}");
    }
    assert!((map.largest_edge(1e9) - FRAC_PI_2).abs() <= 1e-15);
    for texels in [0.0, -1.0, f64::NAN, f64::NEG_INFINITY] {
        assert_eq!(map.largest_edge(texels), 0.0);
    }
}

#[test]
fn hemispheres_hold_what_they_must() {
    let (one, two) = (Cell::new(0), Cell::new(0));
    run(5000, &(case(), settings(), any::<u64>(), any::<bool>()), |(case, settings, seed, among)| {
        let mut together = Together::of(&case);
        // Lamps are seldom among what is visible; every other case has one put there.
        if let Some(&within) = points_of(&together.focus().visible(), !seed).last()
            && among
        {
            let near = together.light.near().max(1e-6 * within.length().max(1.0));
            together.light = Light::point(within, near, f64::INFINITY).expect("sound");
        }
        let focus = together.focus();
        let visible = focus.visible();
        let fitted = focus.paraboloids(&settings);
        // R is cut from the scene, and its points are known to what can be known there.
        let (min, max) = case.scene.bounds();
        let scene = DVec3::from(min).abs().max(DVec3::from(max).abs());
        match fitted {
            Paraboloids::Empty(Empty::NothingVisible) => assert!(visible.is_empty()),
            Paraboloids::Empty(Empty::NothingCasts) => return,
            Paraboloids::Directional => assert_eq!(together.light.position(), None),
            Paraboloids::One(_) => one.set(one.get() + 1),
            Paraboloids::Two([front, back]) => {
                two.set(two.get() + 1);
                assert_eq!(front.opposite(), back);
                // Neither is for nothing.
                for map in [front, back] {
                    assert!(visible.vertices().iter().any(|&point| map.clip_plane().at(point) > 0.0));
                }
            }
        }
        for point in points_of(&visible, seed) {
            let Some(map) =
                fitted.maps().iter().max_by(|a, b| a.clip_plane().at(point).total_cmp(&b.clip_plane().at(point)))
            else {
                continue;
            };
            if !together.is_served(point) {
                continue;
            }
            // A point of R is as far outside of a plane as rounding can carry it.
            let behind = -map.clip_plane().at(point);
            let extent = scene.max(point.abs()).max(map.position().abs()).element_sum();
            assert!(behind <= 512.0 * f64::EPSILON * extent, "{point} is {behind} behind the rim");
            let rounding = map.rounding(point);
            let depth = shader(map, (point - origin(map)).as_vec3()).place.z;
            // Where f32 does not know the near distance from nothing it is as it is.
            let is_near_known = map.near() > 0.75 * together.light.near();
            assert!(depth >= 0.0 || !is_near_known, "{point} is at {depth}, {rounding:?}");
            assert!(depth <= 1.0, "{point} is at {depth}");
            assert!(rounding.depth <= 2.0 / 1_048_576.0, "{point}: {rounding:?}");
        }
    });
    assert!(one.get() > 100 && two.get() > 100, "{one:?} {two:?}");
}

#[test]
fn which_hemispheres() {
    let settings = Settings::default();
    let fit = |light: &Light| Focus::new(&view(), light, &room()).paraboloids(&settings);
    let axis_of = |light: &Light| match fit(light) {
        Paraboloids::One(map) => map.axis(),
        other => panic!("{other:?}"),
    };
    // A hemisphere and a spot have axes of their own.
    let axis = DVec3::new(0.0, -0.8, -0.6);
    assert_eq!(axis_of(&Light::hemisphere(DVec3::ZERO, axis, 0.1, 30.0).expect("sound")), axis);
    assert_eq!(axis_of(&Light::spot(DVec3::ZERO, axis, 0.7, 0.1, 30.0).expect("sound")), axis);
    // A lamp on the ceiling, and almost; one on the floor; one on a wall.
    assert_eq!(axis_of(&lamp([0.0, 3.0, 0.0])), DVec3::NEG_Y);
    assert_eq!(axis_of(&lamp([0.0, 3.0_f64.next_down(), 0.0])), DVec3::NEG_Y);
    assert_eq!(axis_of(&lamp([0.0, -3.0, 0.0])), DVec3::Y);
    assert_eq!(axis_of(&lamp([5.0, 0.0, -4.0])), DVec3::NEG_X);
    // A lamp behind the viewer, to one side of what is visible.
    assert!(axis_of(&lamp([0.0, 0.0, 9.8])).z < 0.0);
    assert!(matches!(fit(&lamp([0.0, 0.0, 0.0])), Paraboloids::Two(_)));
    assert_eq!(fit(&Light::directional(DVec3::Y).expect("sound")), Paraboloids::Directional);
    let far_away = Light::point((900.0, 0.0, 0.0), 0.1, 5.0).expect("sound");
    assert_eq!(fit(&far_away), Paraboloids::Empty(Empty::NothingVisible));
    let dark = Light::point((0.0, 0.0, 0.0), 900.0, 1000.0).expect("sound");
    assert_eq!(fit(&dark), Paraboloids::Empty(Empty::NothingCasts));
}

#[test]
fn the_camera_moves_no_texel() {
    let (light, settings) = (lamp([0.0, 0.0, 0.0]), Settings::default());
    let maps = [0.0, 0.1, 0.3].map(|turn: f64| {
        let forward = DVec3::new(turn.sin(), 0.1, -turn.cos());
        let view = View::perspective((0.5, 1.0, 8.0), forward, DVec3::Y, 1.2, 1.5, 0.1, 50.0).expect("sound");
        match Focus::new(&view, &light, &room()).paraboloids(&settings) {
            Paraboloids::Two([map, _]) => map,
            other => panic!("{other:?}"),
        }
    });
    let point = DVec3::new(1.0, -2.0, 3.0);
    let places = maps.map(|map| map.project(point).map(DVec3::truncate));
    assert!(places.iter().all(|place| *place == places[0] && place.is_some()));
}

#[test]
fn errors_name_the_axis() {
    let (light, settings) = (lamp([0.0; 3]), Settings::default());
    let (view, scene) = (view(), room());
    let focus = Focus::new(&view, &light, &scene);
    for (axis, problem) in [(DVec3::ZERO, Problem::NoDirection), (DVec3::NAN, Problem::NotFinite)] {
        let error = focus.paraboloids_about(axis, &settings).expect_err("no axis");
        assert_eq!((error.field, error.problem), ("axis", problem));
    }
    let fitted = focus.paraboloids_about(DVec3::Z * 3.0, &settings).expect("sound");
    assert_eq!(fitted.maps().iter().map(Paraboloid::axis).collect::<Vec<_>>(), [DVec3::Z, DVec3::NEG_Z]);
    assert_eq!(focus.paraboloids(&settings), focus.paraboloids_about(DVec3::NEG_Y, &settings).expect("sound"));
}

#[test]
fn a_fit_allocates_nothing() {
    let (view, scene) = (view(), room());
    for light in [lamp([0.0; 3]), lamp([0.0, 3.0, 0.0])] {
        let focus = Focus::new(&view, &light, &scene);
        let visible: Body = focus.visible();
        let work = || {
            for map in focus.paraboloids(&Settings::default()).maps() {
                std::hint::black_box((map.matrix(), map.clip_scale(), map.largest_edge(0.5)));
                for &point in visible.vertices() {
                    std::hint::black_box((map.footprint(point), map.rounding(point)));
                }
            }
        };
        assert_eq!(allocation_counter::measure(work).count_total, 0);
    }
}

#[cfg(feature = "wgsl")]
#[test]
fn the_shader_text_is_valid() {
    use naga::front::wgsl;
    use naga::valid::{Capabilities, ValidationFlags, Validator};

    let caller = "
        @group(0) @binding(0) var<uniform> matrix: mat4x4<f32>;
        @group(0) @binding(1) var<uniform> scale: vec4<f32>;
        @vertex fn vertex(@location(0) position: vec3<f32>) -> ShadowfitParaboloidVertex {
            return shadowfit_paraboloid_clip(matrix, scale.xy, position);
        }
        @fragment fn fragment(vertex: ShadowfitParaboloidVertex) -> @builtin(frag_depth) f32 {
            return shadowfit_paraboloid_depth(matrix, scale.xy, scale, vertex, vec2(1e-6, 1.0));
        }
        @fragment fn read(@location(0) position: vec3<f32>) -> @location(0) vec4<f32> {
            return shadowfit_paraboloid_texture(matrix, scale, position);
        }";
    let module = wgsl::parse_str(&format!("{}{caller}", shadowfit::wgsl::PARABOLOID)).expect("it parses");
    let mut validator = Validator::new(ValidationFlags::all(), Capabilities::empty());
    validator.validate(&module).expect("it is valid");
}

/// What the shader writes for the texel at a place on the plane where `plane` · x = 1, the light in the middle, as a
/// distance; in f64.
fn stored(plane: DVec3, place: DVec2, texel: f64, slope: f64) -> f64 {
    let square = place.length_squared();
    let direction = (2.0 * place).extend(1.0 - square) / (1.0 + square);
    let turn = |step: DVec2| {
        let along = place.dot(step);
        (step.extend(-along) - direction * along) * (1.0 + direction.z)
    };
    let changes = [DVec2::X, DVec2::Y].map(|axis| plane.dot(turn(axis * texel)).abs());
    let curved = 4.0 * slope * texel * texel * plane.length();
    let least = plane.dot(direction) - slope * (changes[0] + changes[1] + curved);
    if least > 0.0 { 1.0 / least } else { f64::INFINITY }
}

/// The distance of the plane along the ray at a place.
fn distance(plane: DVec3, place: DVec2) -> Option<f64> {
    let square = place.length_squared();
    let nearness = plane.dot((2.0 * place).extend(1.0 - square) / (1.0 + square));
    (nearness > 0.0).then(|| nearness.recip())
}

#[test]
fn no_plane_shadows_itself_and_less_is_not_enough() {
    let [map, _] = both(&Settings::new(256, 1080).expect("sound"));
    let texel = 1.0 / texels_per_unit(map.settings());
    let mut numbers = Numbers(8);
    for reach in [0.5, 1.0, 2.5] {
        let bias = map.bias(DepthFormat::Float32, reach).expect("a reach");
        let (mut cases, mut too_little, mut wasted) = (0, 0, 0.0_f64);
        while cases < 40_000 {
            let normal = direction_about(&mut numbers);
            let plane = normal / (0.1 + 7.0 * numbers.part());
            let place = DVec2::new(numbers.part() - 0.5, numbers.part() - 0.5) * 2.0;
            if place.length() > 1.0 || distance(plane, place).is_none() {
                continue;
            }
            cases += 1;
            let all = stored(plane, place, texel, bias.slope.into());
            // Half of the reach and nothing for rounding.
            let less = stored(plane, place, texel, 0.5 * reach);
            let mut farthest: f64 = 0.0;
            for (x, y) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0), (0.3, 1.0), (0.0, 0.0)] {
                let read = place + DVec2::new(x, y) * (reach * texel);
                let Some(receiver) = distance(plane, read) else { continue };
                assert!(all >= receiver * (1.0 - 1e-12), "{plane} at {place}: {all} before {receiver}");
                farthest = farthest.max(receiver);
            }
            too_little += usize::from(less < farthest);
            // Where the plane is not grazed within the reach, the bias is no larger than what it must cover by much.
            let here = distance(plane, place).expect("seen");
            if (all - here) < 0.1 * here {
                wasted = wasted.max((all - here) / (farthest - here).max(0.01 * here));
            }
        }
        assert!(too_little * 10 > cases * 9, "{too_little} of {cases}");
        assert!(f64::from(bias.slope) >= reach && f64::from(bias.slope) <= 1.05 * reach + 0.15, "{bias:?}");
        assert!(wasted < 2.0, "{wasted}");
    }
}

#[test]
fn noise_over_distances_is_at_least_that_of_points() {
    run(1000, &(case(), settings(), any::<u64>()), |(case, settings, seed)| {
        let together = Together::of(&case);
        let focus = together.focus();
        for map in focus.paraboloids(&settings).maps() {
            let bias = map.bias(DepthFormat::Unorm24, 0.5).expect("a reach");
            for point in points_of(&focus.visible(), seed) {
                let far_enough = point.distance(map.position()) >= map.far() / 64.0;
                if map.clip_plane().at(point) < 0.0 || !far_enough {
                    continue;
                }
                let rounding = map.rounding(point);
                // The receiver's and the caster's.
                assert!(2.0 * rounding.depth <= bias.receiver, "{point}: {rounding:?}, {bias:?}");
                assert!(rounding.texels <= f64::from(bias.slope) - 0.5, "{point}: {rounding:?}, {bias:?}");
            }
        }
    });
}

#[test]
fn receivers_are_moved_by_just_what_is_asked_for() {
    let [map, _] = both(&Settings::default());
    let mut numbers = Numbers(9);
    let range = map.far() - map.near();
    for _ in 0..500 {
        let local = direction_about(&mut numbers);
        if local.z < 0.0 {
            continue;
        }
        let away = 1.0 + 5.0 * numbers.part();
        let point = map.position() + from_light(&map, local) * away;
        for (offset, moved) in [
            (Offset::world(0.25), 0.25),
            (Offset::relative(0.25), 0.2 * away),
            (Offset::depth(0.25), 0.25 * range),
            (Offset::world(-0.25), -0.25),
        ] {
            let q = map.receiver_matrix(&offset.expect("sound")) * (point - origin(&map)).as_vec3().extend(1.0);
            let length = q.xyz().length();
            let place = (q.xy() / (length + q.z)).as_dvec2();
            let exact = map.project(point).expect("not behind");
            assert!((place - exact.truncate()).length() < 1e-5);
            let depth = f64::from(length - q.w);
            assert!((depth - (exact.z - moved / range)).abs() < 1e-5, "{depth}, not {exact} less {moved}");
        }
    }
}

#[test]
fn what_a_bias_costs_is_a_distance() {
    let [map, _] = both(&Settings::default());
    let bias = map.bias(DepthFormat::Float32, 1.0).expect("a reach");
    let point = map.position() + map.axis() * 2.0;
    let facing = map.bias_distance(point, -map.axis(), &bias);
    let slanted = map.bias_distance(point, from_light(&map, DVec3::new(0.6, 0.0, -0.8)), &bias);
    // In the middle a texel is seen under 4/n.
    let texel = 2.0 * 4.0 / f64::from(map.settings().map_size());
    let slope = f64::from(bias.slope) * texel * 0.75;
    assert!(facing > 0.0 && facing < 1e-4 * (map.far() - map.near()), "{facing}");
    assert!((slanted - facing - slope).abs() < 0.01 * slope, "{slanted}, not {slope}");
    assert_eq!(map.bias_distance(point, from_light(&map, DVec3::X), &bias), f64::INFINITY);
    for (reach, problem) in [(0.4, Problem::TooSmall), (1e9, Problem::TooLarge), (f64::NAN, Problem::NotFinite)] {
        let error = map.bias(DepthFormat::Float32, reach).expect_err("no reach");
        assert_eq!((error.field, error.problem), ("reach", problem));
    }
    assert_eq!(bias.in_shader().y, bias.slope);
}
