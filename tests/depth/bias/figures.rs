//! Units, steps, linear depth and what a bias costs.

use glam::DVec3;
use proptest::prelude::*;
use shadowfit::{
    ClipSpace, DepthFormat, Focus, Light, Origin, Outcome, Scene, Settings, View, Warp, depth::DepthBias, fit,
    input::InputErrorKind, omni::CubeFace,
};

use super::{FORMATS, lamp, outdoors, scene, sun, view};
use testkit::arbitrary::{Together, case, points_of, run, settings};

#[test]
fn eight_bits_are_steps_of_a_255th() {
    let format = DepthFormat::Unorm8;
    assert_eq!([0.0, 0.3, 1.0].map(|depth| format.step(depth)), [1.0 / 255.0; 3]);
    let map = outdoors(&sun(), &Settings::default().with_warp(Warp::Uniform));
    let range = map.depth().far - map.depth().near;
    // One 255th of the range.
    let resolution = map.depth_resolution(DVec3::new(0.0, 0.0, 0.0), format);
    assert!((resolution - range / 255.0).abs() < 1e-9 * range, "{resolution} of {range}");
    // What f32 rounds is nothing to so coarse a step, and another map of any kind asks for the same.
    let bias = map.bias(format, 0.5).expect("a legal reach");
    assert_eq!((bias.constant, bias.constant_alone(), bias.slope_scale), (1, Some(2), 1.1875));
    assert!(bias.most < 0.01 * format.step(1.0), "{bias:?}");
}

/// A unit of floating point vanishes where depth does; a unit of fixed point does not.
#[test]
fn units_are_what_the_apis_say() {
    for (format, bits) in [(DepthFormat::Unorm8, 8), (DepthFormat::Unorm16, 16), (DepthFormat::Unorm24, 24)] {
        let unit = format.bias_unit(1e-30);
        assert_eq!((*unit.start(), *unit.end()), (0.5_f64.powi(bits), 2.0 * format.step(0.0)));
    }
    let unit = |largest| *DepthFormat::Float32.bias_unit(largest).end();
    for (largest, exponent) in [(0.25, -2), (0.49, -2), (0.5, -1), (0.999, -1), (1.0, 0), (1e-3, -10)] {
        assert_eq!(unit(largest), 2_f64.powi(exponent - 23), "{largest}");
    }
    assert_eq!([unit(0.0), unit(-1.0), unit(f64::NAN)], [0.0; 3]);
}

#[test]
fn a_reach_makes_sense_or_is_refused() {
    let map = outdoors(&sun(), &Settings::default());
    for (reach, problem) in [
        (f64::NAN, InputErrorKind::NotFinite),
        (f64::INFINITY, InputErrorKind::NotFinite),
        (0.49, InputErrorKind::TooSmall),
        (-1.0, InputErrorKind::TooSmall),
        (65_537.0, InputErrorKind::TooLarge),
    ] {
        let error = map.bias(DepthFormat::Unorm16, reach).expect_err("no such filter");
        assert_eq!((error.field, error.problem), ("reach", problem));
    }
    // Wider filters need more, and all of it is finite.
    let slopes =
        [0.5, 1.0, 1.5, 100.0, 65_536.0].map(|reach| map.bias(DepthFormat::Float32, reach).unwrap().slope_scale);
    assert!(slopes.is_sorted() && slopes[0] < 1.2 && slopes[4].is_finite(), "{slopes:?}");
}

/// A receiver moved away along the ray by the distance that the bias costs has just the depth that is stored.
#[test]
fn what_a_bias_costs_is_a_distance_along_the_ray() {
    for light in [sun(), lamp()] {
        for warp in [Warp::Uniform, Warp::Perspective] {
            let map = outdoors(&light, &Settings::default().with_warp(warp));
            let (point, normal) = (DVec3::new(1.0, 0.5, -2.0), DVec3::new(0.1, 1.0, 0.3));
            for format in FORMATS {
                let bias = map.bias(format, 1.0).expect("a legal reach");
                let distance = map.bias_distance(point, normal, &bias);
                if format == DepthFormat::Unorm8 && distance == f64::INFINITY {
                    // No depth along the ray is so much larger.
                    continue;
                }
                let matrix = map.clip_from_world_in(ClipSpace::WGPU);
                let behind = point - light.direction_from(point) * distance;
                // Textures and clip space have one depth in wgpu's convention.
                let behind = map.texture_from_world_with(&bias.offset()).project_point3(behind).z;
                let slopes = map.depth_slopes(point, normal).expect("not from its edge").length();
                let stored = matrix.project_point3(point).z + bias.bias_in_depth(slopes);
                assert!((behind - stored).abs() < 1e-12, "{format:?}: {behind} and {stored}");
                // Along the plane's own ray nothing is farther than from its edge.
                assert!(distance > 0.0 && distance < map.bias_distance(point, normal.with_y(-0.2), &bias));
            }
        }
    }
    let map = outdoors(&sun(), &Settings::default());
    let bias = map.bias(DepthFormat::Unorm24, 0.5).expect("a legal reach");
    let behind_the_map = DVec3::new(0.0, 0.0, 1e9);
    for (point, normal) in [(DVec3::ZERO, DVec3::ZERO), (behind_the_map, DVec3::Y), (DVec3::NAN, DVec3::Y)] {
        assert_eq!(map.bias_distance(point, normal, &bias), f64::INFINITY, "{point} {normal}");
    }
}

/// A lamp in a room has the air around it in view, where depth is noisy. What that costs on a wall is a few centimetres
/// here; as one number for the whole map it was metres.
#[test]
fn a_lamp_in_view_costs_the_walls_little() {
    let view = View::perspective((0.0, 1.6, 3.0), (0.0, -0.1, -1.0), DVec3::Y, 1.0, 1.6, 0.1, 20.0).expect("sound");
    let scene = Scene::from_box((-4.0, 0.0, -5.0), (4.0, 3.0, 4.0)).expect("sound");
    let lamp = DVec3::new(0.0, 1.5, -2.5);
    let near = 0.009;
    let mut faces = 0;
    for warp in [Warp::Uniform, Warp::Perspective] {
        for clip in [ClipSpace::WGPU, ClipSpace::WGPU.reversed()] {
            let settings = Settings::new(512, 512).expect("sound").with_warp(warp).with_clip(clip);
            let settings = settings.with_origin(Origin::Eye);
            for (face, wall) in [
                (CubeFace::NegativeZ, DVec3::new(0.5, 1.2, -5.0)),
                (CubeFace::NegativeY, DVec3::new(0.5, 0.0, -2.5)),
                (CubeFace::PositiveX, DVec3::new(2.5, 1.2, -2.0)),
            ] {
                let light = Light::point(lamp, near, f64::INFINITY).and_then(|lamp| lamp.cube_face(face, 0.01));
                let map = fit(&view, &light.expect("sound"), &scene, &settings).into_map().expect("a map");
                // Not stretched by what is next to the lamp: the near plane is where its near distance is in a corner of the
                // face, 1/√3 of it on the axis, or half of that, as casters next to a light may double the range.
                assert!(
                    (0.5 * near / 3_f64.sqrt()..near).contains(&map.depth().near),
                    "{face:?}: {:?}",
                    map.depth()
                );
                let bias = map.bias(DepthFormat::Unorm24, 0.5).expect("a legal reach");
                let cost = map.bias_distance(wall, face.axis(), &bias);
                // f32 moves depth by 8 · 2⁻²⁴ · 15/w twice, 15 the sum of terms of w's row, and near/2 is −z·l: about 0.3 % of
                // the distance of 3, three and a half times, and the slope of a texel, which is larger in a warp.
                let most = if warp == Warp::Uniform { 0.04 } else { 0.06 };
                assert!(cost < most, "{warp:?}, {face:?}: {cost} at {wall}, {bias:?}");
                faces += 1;
            }
        }
    }
    assert_eq!(faces, 12);
}

trait BiasInDepth {
    fn bias_in_depth(&self, slope: f64) -> f64;
}

impl BiasInDepth for DepthBias {
    /// The most that may be added to depth on a plane with a gradient so long, with a step for rounding.
    fn bias_in_depth(&self, slope: f64) -> f64 {
        let unit = *self.format.bias_unit(1.0).end();
        f64::from(self.constant) * unit + f64::from(self.slope_scale) * slope + self.format.step(0.5)
    }
}

/// A uniform map of the sun stores linear depth as it is.
#[test]
fn without_a_warp_the_suns_depth_is_linear() {
    let map = outdoors(&sun(), &Settings::default().with_warp(Warp::Uniform));
    let linear = map.linear_depth();
    for point in Focus::new(&view(), &sun(), &scene()).receiver_volume().vertices() {
        let (hyperbolic, linear) = (map.clip_from_world().project_point3(*point).z, linear.at(*point));
        assert!((hyperbolic - linear).abs() < 1e-5, "{hyperbolic} {linear}");
    }
}

#[test]
fn linear_depth_holds_what_is_visible_and_grows_along_rays() {
    run(2000, &(case(), settings(), any::<u64>()), |(case, settings, seed)| {
        let together = Together::of(&case);
        let focus = together.focus();
        let Outcome::Map(map) = focus.fit(&settings) else { return };
        let linear = map.linear_depth();
        let ahead = |point: DVec3| -linear.normal.dot(together.light.direction_from(point));
        for point in points_of(&focus.receiver_volume(), seed) {
            let depth = linear.at(point);
            let slack = 64.0 * f64::EPSILON * (linear.normal.abs().dot(point.abs()) + linear.offset.abs());
            // Next to a light in a corner of R, nearer than anything casts, it begins after the point.
            assert!(depth >= -slack || !together.is_served(point), "{point} at {depth}");
            assert!(depth <= 1.0 + slack, "{point} at {depth}");
            assert!(ahead(point) > 0.0 || !together.is_served(point), "{point}");
        }
    });
}

/// What each format resolves and needs on a lawn, in world units: at what is nearest to the light and farthest from it.
#[test]
fn figures() {
    let mut text = String::new();
    for (name, light, warp) in [
        ("sun, uniform", sun(), Warp::Uniform),
        ("sun, perspective", sun(), Warp::Perspective),
        ("lamp, uniform", lamp(), Warp::Uniform),
        ("lamp, perspective", lamp(), Warp::Perspective),
    ] {
        let map = outdoors(&light, &Settings::default().with_warp(warp));
        text += &format!(
            "{name}: steps of depth, hyperbolic and linear, 4 above the ground, on it, and far off on it\n"
        );
        let points = [DVec3::new(4.0, 4.0, -16.0), DVec3::new(4.0, 0.0, -16.0), DVec3::new(-12.0, 0.0, -30.0)];
        for format in FORMATS {
            let steps = points.map(|point| {
                let (hyperbolic, linear) =
                    (map.depth_resolution(point, format), map.linear_depth_resolution(point, format));
                format!("  {hyperbolic:.1e} {linear:.1e}")
            });
            text += &format!("{:8}{}\n", format!("{format:?}"), steps.concat());
        }
        text += "bias: constant, slope, receiver, relative, and what it costs on the ground\n";
        for format in FORMATS {
            for reach in [0.5, 1.5] {
                let bias = map.bias(format, reach).expect("a legal reach");
                let cost = map.bias_distance(points[1], DVec3::Y, &bias);
                let DepthBias { constant, slope_scale: slope, receiver, relative, .. } = bias;
                text += &format!(
                    "{:8} reach {reach}: {constant} {slope} {receiver:.1e} {relative:.1e}  {cost:.1e}\n",
                    format!("{format:?}")
                );
            }
        }
        text += "\n";
    }
    insta::assert_snapshot!(text);
}
