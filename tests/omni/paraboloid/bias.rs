//! What a test against a paraboloid map needs added, and what that costs.

use glam::{DVec2, DVec3, Vec4Swizzles};
use proptest::prelude::*;
use shadowfit::{DepthFormat, Origin, Settings, depth::ReceiverOffset, input::InputErrorKind};

use super::{both, direction_about, from_light};
use testkit::arbitrary::{Case, LightParams, Numbers, Pose, SceneParams, ViewParams, case, run, settings};
use testkit::claims::paraboloid::{noise_is_at_least_that_of_points, texels_per_unit};

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
            let all = stored(plane, place, texel, bias.slope_scale.into());
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
        assert!(
            f64::from(bias.slope_scale) >= reach && f64::from(bias.slope_scale) <= 1.05 * reach + 0.15,
            "{bias:?}"
        );
        assert!(wasted < 2.0, "{wasted}");
    }
}

#[test]
fn noise_over_distances_is_at_least_that_of_points() {
    run(1000, &(case(), settings(), any::<u64>()), |(case, settings, seed)| {
        noise_is_at_least_that_of_points(&case, &settings, seed);
    });
}

/// Found by fuzzing: what is visible nearer to a lamp than its near distance, where f32 may be coarser than the bias says.
#[test]
fn a_lamp_whose_near_distance_is_more_than_a_64th_of_the_far_one() {
    let eye = [-889_952.529_488_397_2, 3_960_198.508_393_239, -5_967_787.605_544_975];
    let forward = [0.849_309_840_038_248_4, -0.507_314_636_319_967_9, -0.145_961_143_424_349_7];
    let up = [-0.008_133_827_129_749_355, 0.966_213_227_623_424_5, -889_952.529_488_397_2];
    let case = Case {
        view: ViewParams::Perspective {
            pose: Pose { eye, forward, up },
            fov_y: 1.160_183_013_721_833_4,
            aspect: 2.451_334_792_737_055_7,
            near: 118_411.213_856_317_66,
            far: Some(3_848_575.173_398_229),
        },
        light: LightParams::Point {
            position: [-721_809.788_623_954_5, 2_568_868.675_100_858, -5_967_787.605_544_975],
            near: 432_363.512_672_132_35,
            range: Some(15_543_670.619_403_91),
        },
        scene: SceneParams::Bounds {
            min: [-2_636_171.264_696_424_4, 2_516_576.100_060_51, -5_967_787.605_544_977],
            max: [-721_809.788_623_954_5, 3_960_182.295_036_04, -2_417_422.639_127_861],
        },
    };
    let settings = Settings::new(16384, 1080).expect("sound").with_origin(Origin::Eye);
    for seed in 0..100 {
        noise_is_at_least_that_of_points(&case, &settings, seed);
    }
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
            (ReceiverOffset::world(0.25), 0.25),
            (ReceiverOffset::relative(0.25), 0.2 * away),
            (ReceiverOffset::depth(0.25), 0.25 * range),
            (ReceiverOffset::world(-0.25), -0.25),
        ] {
            let q =
                map.receiver_matrix_with(&offset.expect("sound")) * (point - map.origin()).as_vec3().extend(1.0);
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
    let slope = f64::from(bias.slope_scale) * texel * 0.75;
    assert!(facing > 0.0 && facing < 1e-4 * (map.far() - map.near()), "{facing}");
    assert!((slanted - facing - slope).abs() < 0.01 * slope, "{slanted}, not {slope}");
    assert_eq!(map.bias_distance(point, from_light(&map, DVec3::X), &bias), f64::INFINITY);
    for (reach, problem) in
        [(0.4, InputErrorKind::TooSmall), (1e9, InputErrorKind::TooLarge), (f64::NAN, InputErrorKind::NotFinite)]
    {
        let error = map.bias(DepthFormat::Float32, reach).expect_err("no reach");
        assert_eq!((error.field, error.problem), ("reach", problem));
    }
    assert_eq!(bias.in_shader().y, bias.slope_scale);
}
