//! Offsets: receivers tested as if they were nearer to the light.

use std::cell::Cell;

use glam::{DMat4, DVec3, DVec4, Vec4Swizzles};
use proptest::prelude::*;
use shadowfit::{
    ClipSpace, Focus, InputError, Light, Origin, Outcome, Settings, ShadowMap, depth::ReceiverOffset,
    input::InputErrorKind,
};

use super::{lamp, outdoors, scene, sun, view};
use testkit::arbitrary::{Together, case, points_of, run, settings};

/// The most that two ways to compute a depth may differ by: a few dozen roundings of the terms of the rows, which are
/// combinations of planes through the light, so that its own coordinates count.
fn slack(matrix: &DMat4, light: &Light, point: DVec3) -> f64 {
    let (rows, l) = (matrix.transpose(), light.homogeneous());
    let terms = |row: DVec4| row.xyz().abs().dot(point.abs() + l.truncate().abs()) + row.w.abs();
    let all = terms(rows.x_axis) + terms(rows.y_axis) + terms(rows.z_axis) + terms(rows.w_axis);
    64.0 * f64::EPSILON * all / rows.w_axis.dot(point.extend(1.0))
}

/// `X + part · l`, as a point.
fn towards(light: &Light, point: DVec3, part: f64) -> DVec3 {
    let l = light.homogeneous();
    (point + part * l.truncate()) / (1.0 + part * l.w)
}

/// Depth away from the light.
fn away(map: &ShadowMap, depth: f64) -> f64 {
    if map.settings().clip().depth.is_reversed() { 1.0 - depth } else { depth }
}

#[test]
fn offsets_are_the_depths_of_points_nearer_to_the_light() {
    let amount = prop_oneof![3 => 0.0..0.5, 1 => -0.3..0.0, 1 => Just(0.0)];
    let checked = Cell::new(0_u32);
    run(3000, &(case(), settings(), amount, any::<u64>()), |(case, settings, amount, seed)| {
        let together = Together::of(&case);
        let focus = together.focus();
        let Outcome::Map(map) = focus.fit(&settings) else { return };
        let plain = map.texture_from_world();
        let light = &together.light;
        // A world length that is something in this scene.
        let (min, max) = case.scene.bounds();
        let length = amount * (DVec3::from(max) - DVec3::from(min)).length();
        let relative = map.texture_from_world_with(&ReceiverOffset::relative(amount).expect("legal"));
        let depth = map.texture_from_world_with(&ReceiverOffset::depth(amount).expect("legal"));
        let both = ReceiverOffset::relative(amount).and_then(|offset| offset.and_depth(0.01));
        let both = map.texture_from_world_with(&both.expect("legal"));
        let world = map.texture_from_world_with(&ReceiverOffset::world(length).expect("legal"));
        let visible = focus.receiver_volume();
        for point in points_of(&visible, seed) {
            if !together.is_served(point) {
                continue;
            }
            let here = plain.project_point3(point);
            let same = |matrix: &DMat4, instead: DVec3, more: f64| {
                let (offset, moved) = (matrix.project_point3(point), plain.project_point3(instead));
                let slack =
                    slack(matrix, light, point) + slack(&plain, light, instead) + slack(&plain, light, point);
                // What w is off by counts as often as depth is large, which it is where a point is moved out of the map.
                let slack = slack * (1.0 + moved.z.abs());
                assert_eq!(offset.truncate(), here.truncate());
                assert!((offset - moved).truncate().abs().max_element() <= slack, "{offset}, not {moved}");
                let off = away(&map, offset.z) - away(&map, moved.z) + more;
                assert!(off.abs() <= slack, "{point}: depth is off by {off}, slack {slack}");
            };
            same(&relative, towards(light, point, amount), 0.0);
            same(&depth, point, amount);
            same(&both, towards(light, point, amount), 0.01);
            match light.position() {
                None => same(&world, towards(light, point, length), 0.0),
                Some(position) => {
                    let distance = position.distance(point);
                    let (moved, slack) = moved_by(&plain, &world, light, position, point);
                    // Nothing can be told of a lamp so near, or so far out, that f64 loses most of where it stands. No
                    // point is moved by more than half of what the nearest is away, along the axis.
                    let along = visible.vertices().iter().map(|&at| along_axis(&map, light, at));
                    let nearest = along.fold(f64::INFINITY, f64::min);
                    if slack < 1e-3 * distance && length > 0.0 {
                        let asked = length.min(0.49 * nearest);
                        assert!(moved >= asked - slack, "{moved} of {asked} at {point}, slack {slack}");
                        checked.set(checked.get() + 1);
                    }
                }
            }
        }
    });
    assert!(checked.get() > 5_000, "{}", checked.get());
}

/// How far an offset's matrix moves a point towards a lamp, and how far rounding can carry that.
fn moved_by(plain: &DMat4, offset: &DMat4, light: &Light, position: DVec3, point: DVec3) -> (f64, f64) {
    let row = |matrix: &DMat4, at: DVec3| matrix.transpose().z_axis.dot(at.extend(1.0));
    // e·(X + g l) is linear in g, which moves X by g/(1 + g) of its distance.
    let of_light = row(plain, position);
    let part = (row(offset, point) - row(plain, point)) / of_light;
    let w = plain.transpose().w_axis.dot(point.extend(1.0));
    let slack = (slack(plain, light, point) + slack(offset, light, point)) * w / of_light.abs();
    let distance = position.distance(point);
    // Less than the part is off by, and as much of it again where e·l is.
    (distance * part / (1.0 + part), distance * slack * (2.0 + part.abs()))
}

/// The distance of a point from the light along the axis of the map, which linear depth grows along.
fn along_axis(map: &ShadowMap, light: &Light, point: DVec3) -> f64 {
    let position = light.position().expect("a lamp");
    map.linear_depth().normal.normalize().dot(point - position)
}

#[test]
fn offsets_in_f32_are_the_ones_in_f64() {
    for light in [sun(), lamp()] {
        for clip in [ClipSpace::WGPU, ClipSpace::WGPU.reversed(), ClipSpace::OPENGL, ClipSpace::VULKAN.reversed()] {
            for origin in [Origin::World, Origin::Eye, Origin::Light] {
                let map = outdoors(&light, &Settings::default().with_clip(clip).with_origin(origin));
                let about = DMat4::from_translation(map.origin());
                for offset in
                    [ReceiverOffset::world(0.1), ReceiverOffset::relative(0.01), ReceiverOffset::depth(1e-3)]
                        .map(Result::unwrap)
                {
                    let matrix = map.texture_from_world_with(&offset) * about;
                    assert_eq!(map.receiver_matrix_with(&offset), matrix.as_mat4());
                }
                let none = ReceiverOffset::depth(0.0).expect("legal");
                assert_eq!(map.receiver_matrix_with(&none), map.receiver_matrix());
            }
        }
    }
}

/// What a lamp's receivers are moved by, along the axis: what was asked for at both ends, and more between.
#[test]
fn a_world_distance_under_a_lamp_is_a_chord() {
    let map = outdoors(&lamp(), &Settings::default());
    let focus = Focus::new(&view(), &lamp(), &scene());
    let position = lamp().position().expect("a lamp");
    let (plain, moved) =
        (map.texture_from_world(), map.texture_from_world_with(&ReceiverOffset::world(0.05).expect("legal")));
    let by = |point: DVec3| {
        let row = |matrix: &DMat4| matrix.transpose().z_axis.dot(point.extend(1.0));
        let part = (row(&moved) - row(&plain)) / plain.transpose().z_axis.dot(position.extend(1.0));
        position.distance(point) * part / (1.0 + part)
    };
    let all: Vec<f64> = focus.receiver_volume().vertices().iter().map(|&point| by(point)).collect();
    let (least, most) =
        (all.iter().copied().fold(f64::INFINITY, f64::min), all.iter().copied().fold(0.0, f64::max));
    // Off the axis of the map by up to 60°, distance is up to twice what it is along the axis.
    assert!((0.05..0.2).contains(&least) && most < 0.2, "{least} to {most}");
}

#[test]
fn offsets_that_make_no_sense_are_refused() {
    let refused = |offset: Result<ReceiverOffset, InputError>| {
        let error = offset.expect_err("no sense");
        (error.field, error.problem)
    };
    let error = |field, problem| (field, problem);
    assert_eq!(refused(ReceiverOffset::world(f64::NAN)), error("distance", InputErrorKind::NotFinite));
    assert_eq!(refused(ReceiverOffset::world(1e13)), error("distance", InputErrorKind::TooLarge));
    assert_eq!(refused(ReceiverOffset::relative(f64::INFINITY)), error("part", InputErrorKind::NotFinite));
    assert_eq!(refused(ReceiverOffset::relative(-0.6)), error("part", InputErrorKind::TooSmall));
    assert_eq!(refused(ReceiverOffset::depth(f64::NEG_INFINITY)), error("depth", InputErrorKind::NotFinite));
}
