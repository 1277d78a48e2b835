//! Normal-offset bias: a receiver moved so far along its normal is nearer to the light than its plane is at any texel that a
//! filter reads, with all that the bias covers to spare.

use std::cell::Cell;

use glam::{DMat4, DVec2, DVec3};
use proptest::prelude::*;
use shadowfit::{ClipSpace, DepthFormat, Focus, Outcome, Settings, ShadowMap, depth::ReceiverOffset};

use super::{lamp, outdoors, scene, sun, view};
use testkit::arbitrary::{Together, case, points_of, run, settings};

/// The plane's own depth at a place: where the ray through it meets the plane.
fn depth_on_plane(map: &ShadowMap, from_texture: &DMat4, place: DVec2, point: DVec3, normal: DVec3) -> Option<f64> {
    let [near, far] = [0.25, 0.75].map(|depth| from_texture.project_point3(place.extend(depth)));
    let (to_far, to_plane) = ((far - near).dot(normal), (point - near).dot(normal));
    let at = near + (far - near) * (to_plane / to_far);
    (at.is_finite() && map.w_at(at) > 0.0).then(|| map.texture_from_world().project_point3(at).z)
}

fn forward(settings: Settings) -> Settings {
    settings.with_clip(ClipSpace::WGPU)
}

#[test]
fn moved_receivers_are_clear_of_their_plane() {
    let checked = Cell::new(0_u32);
    let cases = (case(), settings(), prop::array::uniform3(-1.0..1.0), 0.5..2.5, any::<u64>());
    run(2000, &cases, |(case, settings, normal, reach, seed)| {
        let together = Together::of(&case);
        let focus = together.focus();
        let Outcome::Map(map) = focus.fit(&forward(settings)) else { return };
        let bias = map.bias(DepthFormat::Float32, reach).expect("a reach");
        let from_texture = map.texture_from_world().inverse();
        let sides = DVec2::new(f64::from(map.settings().map_sides().0), f64::from(map.settings().map_sides().1));
        for point in points_of(&focus.receiver_volume(), seed) {
            if !together.is_served(point) {
                continue;
            }
            let Some(normal) = DVec3::from(normal).try_normalize() else { return };
            let normal = if normal.dot(together.light.direction_from(point)) < 0.0 { -normal } else { normal };
            let offset = map.normal_offset(point, normal, &bias);
            if !offset.is_finite() || normal.dot(together.light.direction_from(point)) < 1e-2 {
                continue;
            }
            let most = map.normal_offset_at(point, &bias);
            assert!(offset <= most * (1.0 + 1e-6), "{offset} of at most {most}");
            let moved = map.texture_from_world().project_point3(point + normal * offset);
            let slopes = map.depth_slopes(point, normal).expect("a plane");
            for corner in [DVec2::ONE, DVec2::NEG_ONE, DVec2::new(1.0, -1.0), DVec2::new(-1.0, 1.0), DVec2::ZERO] {
                let place = moved.truncate() + corner * reach / sides;
                let Some(stored) = depth_on_plane(&map, &from_texture, place, point, normal) else { continue };
                // What is left is at least the constant, and what two inverses of a matrix lose.
                let lost = 1e-7 + 1e-6 * slopes.max_element() + map.depth_rounding(point);
                if moved.z.abs() < 4.0 && stored.abs() < 4.0 {
                    assert!(moved.z < stored + lost, "{} is behind {stored} at {point}", moved.z);
                    checked.set(checked.get() + 1);
                }
            }
        }
    });
    assert!(checked.get() > 1000, "{}", checked.get());
}

/// In units of a texel: the slope times the sine of the angle, and a little for noise, in a uniform map of a sun.
#[test]
fn offsets_are_as_long_as_they_should_be() {
    let map = outdoors(&sun(), &Settings::default().with_warp(shadowfit::Warp::Uniform));
    let bias = map.bias(DepthFormat::Float32, 1.0).expect("a reach");
    let point = DVec3::new(0.0, 0.0, -4.0);
    let side = map.footprint(point).expect("in the map").longest();
    let towards = sun().direction_from(point);
    let across = towards.any_orthonormal_vector();
    for degrees in [0, 10, 30, 60, 80, 89] {
        let (sine, cosine) = f64::from(degrees).to_radians().sin_cos();
        let offset = map.normal_offset(point, towards * cosine + across * sine, &bias);
        let noise = (bias.receiver + 2e-7) / 0.01 * cosine;
        let whole = f64::from(bias.slope_scale) * side * sine;
        assert!(offset <= whole + noise + 1e-4 && offset >= 0.6 * whole, "{degrees}°: {offset} of {whole}");
        assert!(offset <= map.normal_offset_at(point, &bias));
    }
    // Either side of the plane, and any length of its normal.
    let normal = towards + across;
    let offset = map.normal_offset(point, normal, &bias);
    for other in [-normal, normal * 1e-3] {
        assert!((map.normal_offset(point, other, &bias) / offset - 1.0).abs() < 1e-12);
    }
    assert_eq!(map.normal_offset(point, DVec3::ZERO, &bias), f64::INFINITY);
}

/// The largest is that of the vertices and the middles of edges, and between them there is hardly more.
#[test]
fn the_largest_offset_covers_what_is_visible() {
    let worst = Cell::new(0.0_f64);
    run(600, &(case(), settings(), any::<u64>()), |(case, settings, seed)| {
        let together = Together::of(&case);
        let focus = together.focus();
        let Outcome::Map(map) = focus.fit(&settings) else { return };
        let bias = map.bias(DepthFormat::Float32, 1.0).expect("a reach");
        let largest = map.largest_normal_offset(&focus, &bias);
        assert!(!largest.is_nan());
        for point in points_of(&focus.receiver_volume(), seed) {
            if together.is_served(point) && largest.is_finite() {
                worst.set(worst.get().max(map.normal_offset_at(point, &bias) / largest));
            }
        }
    });
    println!("the largest normal offset in R is at most {:.4} times that of vertices and middles", worst.get());
    assert!(worst.get() < 1.1, "{}", worst.get());
}

/// Offsets in clip space are those in texture space.
#[test]
fn offsets_in_clip_space() {
    for clip in [ClipSpace::WGPU, ClipSpace::WGPU.reversed(), ClipSpace::OPENGL, ClipSpace::VULKAN.reversed()] {
        for light in [sun(), lamp()] {
            let map = outdoors(&light, &Settings::default().with_clip(clip));
            let offset = map.bias(DepthFormat::Unorm24, 1.0).expect("a reach").offset();
            assert_eq!(map.clip_from_world_with(&ReceiverOffset::depth(0.0).expect("none")), map.clip_from_world());
            for point in Focus::new(&view(), &light, &scene()).receiver_volume().vertices() {
                let [in_clip, in_texture] =
                    [map.clip_from_world_with(&offset), map.texture_from_world_with(&offset)];
                let (in_clip, in_texture) = (in_clip.project_point3(*point), in_texture.project_point3(*point));
                let depth = match clip.depth {
                    shadowfit::input::DepthRange::NegativeOneToOne
                    | shadowfit::input::DepthRange::NegativeOneToOneReversed => 0.5 * in_clip.z + 0.5,
                    _ => in_clip.z,
                };
                assert!((depth - in_texture.z).abs() < 1e-12, "{depth}, {}", in_texture.z);
                assert!((0.5 * in_clip.x + 0.5 - in_texture.x).abs() < 1e-12);
                assert!(map.w_at(*point) > 0.0);
            }
            let single = map.receiver_clip_matrix_with(&offset).as_dmat4();
            assert!((single - map.clip_from_world_with(&offset)).abs_diff_eq(DMat4::ZERO, 1e-3));
        }
    }
}

/// Who forgot to negate it had every other pixel wrong.
#[test]
fn biases_have_the_sign_of_their_clip_space() {
    for light in [sun(), lamp()] {
        for format in super::FORMATS {
            let bias =
                |clip| outdoors(&light, &Settings::default().with_clip(clip)).bias(format, 1.0).expect("a reach");
            for clip in [ClipSpace::WGPU, ClipSpace::OPENGL, ClipSpace::VULKAN] {
                let (one, other) = (bias(clip), bias(clip.reversed()));
                assert!(one.constant > 0 && one.slope_scale > 0.0);
                assert_eq!((other.constant, other.slope_scale), (-one.constant, -one.slope_scale));
                assert_eq!(other.constant_alone(), one.constant_alone().map(|constant| -constant));
            }
        }
    }
}
