//! Virtual samples: depths of a plane at places where it was not seen, against the matrix, in f64 and as a shader has them.

use glam::{DVec2, DVec3, Vec3};
use proptest::prelude::*;
use shadowfit::{
    ClipSpace, DepthFormat, Light, Scene, Settings, ShadowMap, View, Warp,
    depth::{ComparisonTolerance, Decision, MIN_SIN_INCIDENCE, RASTER_GRID, TangentPlane},
    fit,
};
use testkit::arbitrary::{Numbers, case, run, settings};
use testkit::claims::virtual_samples::{
    allows_for_rounding, depths_are_exact, direction, in_a_shader, projected, rules_hold_where_planes_are_seen,
    rules_only_cut_short, shaders_find_them,
};

#[test]
fn depths_on_planes_are_exact() {
    run(3000, &(case(), settings(), any::<u64>()), |(case, settings, seed)| {
        depths_are_exact(&case, &settings, seed);
    });
}

#[test]
fn shaders_find_them_to_what_f32_can_tell() {
    run(3000, &(case(), settings(), any::<u64>()), |(case, settings, seed)| {
        shaders_find_them(&case, &settings, seed);
    });
}

#[test]
fn tolerances_cover_what_f32_can_tell() {
    run(6000, &(case(), settings(), any::<u64>()), |(case, settings, seed)| {
        allows_for_rounding(&case, &settings, seed);
    });
}

/// Both ways in f32, relative to the eye, for roofs and walls under a sun and a lamp: slopes from gradients at the point,
/// and the plane taken through the inverse of the matrix, as in the paper: 1.4 to 2 times as far off on planes at 45° to the
/// light, 2 to 9 times on planes that it grazes at a degree.
#[test]
fn slopes_at_the_point_err_less_than_the_inverse() {
    for light in [Light::directional((0.4, 0.5, 0.5)), Light::point((3.0, 8.0, -20.0), 0.05, f64::INFINITY)] {
        let map = ground(&light.expect("sound"), ClipSpace::WGPU, Warp::Perspective);
        let inverse = map.texture_from_world().inverse().transpose().as_mat4();
        let mut numbers = Numbers(5);
        for steep in [false, true] {
            let (mut at_point, mut through_inverse): (f64, f64) = (0.0, 0.0);
            for (x, z) in (-20..=20).flat_map(|x| (-40..=-2).map(move |z| (f64::from(x), f64::from(z)))) {
                let position = Vec3::new(x as f32, 1.0, z as f32) * 0.2;
                let towards = map_light(&map, position.as_dvec3());
                let across = direction(&mut numbers).cross(towards).normalize();
                let normal = if steep { across + 0.02 * towards } else { across + towards };
                let Some(plane) = TangentPlane::new(&map, position.as_dvec3(), normal) else { continue };
                let place = (plane.place() + 1.0 / 1024.0).as_vec2();
                let expected = plane.depth_at(place.as_dvec2());
                let normal = normal.as_vec3();
                let (projected, slopes) = in_a_shader(map.receiver_matrix(), position, normal);
                let found = projected.z + slopes.dot(place - projected.truncate());
                let there = inverse * normal.extend(-normal.dot(position));
                let inverted = -(there.x * place.x + there.y * place.y + there.w) / there.z;
                at_point = at_point.max((f64::from(found) - expected).abs());
                through_inverse = through_inverse.max((f64::from(inverted) - expected).abs());
            }
            assert!(
                at_point < through_inverse,
                "{at_point:e} at the point, {through_inverse:e} through the inverse"
            );
        }
    }
}

/// Towards the light of a map.
fn map_light(map: &ShadowMap, point: DVec3) -> DVec3 {
    let texture = map.texture_from_world();
    let w = texture.row(3);
    let gradient = |i: usize| (texture.row(i) - projected(texture, point)[i] * w).truncate();
    gradient(0).cross(gradient(1)).normalize()
}

/// The ground from a person's height, under a light, as a map.
fn ground(light: &Light, clip: ClipSpace, warp: Warp) -> ShadowMap {
    let view = View::perspective((0.0, 1.7, 0.0), (0.0, -0.3, -1.0), DVec3::Y, 1.0, 1.6, 0.1, 60.0).expect("sound");
    let scene = Scene::from_box((-30.0, 0.0, -30.0), (30.0, 5.0, 30.0)).expect("sound");
    let settings = Settings::new(256, 1080).expect("sound").with_border(4).expect("sound");
    let settings = settings.with_clip(clip).with_warp(warp);
    fit(&view, light, &scene, &settings).into_map().expect("one map does")
}

fn grounds() -> Vec<ShadowMap> {
    let lights = [Light::directional((0.4, 0.3, 0.5)), Light::point((3.0, 4.0, -9.0), 0.1, f64::INFINITY)];
    let mut maps = Vec::new();
    for light in lights.map(|light| light.expect("sound")) {
        for clip in [ClipSpace::WGPU, ClipSpace::OPENGL, ClipSpace::VULKAN.reversed()] {
            maps.extend([Warp::Uniform, Warp::Perspective].map(|warp| ground(&light, clip, warp)));
        }
    }
    maps
}

/// Points of the ground in view, and the plane of each.
fn on_ground(map: &ShadowMap) -> Vec<TangentPlane> {
    let points =
        (-80..=80).flat_map(|x| (-100..=-10).map(move |z| DVec3::new(f64::from(x), 0.0, f64::from(z)) * 0.07));
    let planes = points.filter_map(|point| TangentPlane::new(map, point, DVec3::Y));
    planes.filter(|plane| plane.place().clamp(DVec2::splat(0.02), DVec2::splat(0.98)) == plane.place()).collect()
}

/// The depth that the map holds for a plane, at the centre of a texel, in steps of a format and off by the rasteriser's
/// half of a step of its grid in the worst direction.
fn stored_plane(map: &ShadowMap, plane: TangentPlane, format: Option<DepthFormat>) -> impl Fn(u32, u32) -> f64 {
    let size = f64::from(map.settings().map_size());
    let reversed = map.settings().clip().depth.is_reversed();
    move |x, y| {
        let exact = plane.depth_at((DVec2::new(f64::from(x), f64::from(y)) + 0.5) / size);
        let Some(format) = format else { return exact };
        let shift = 0.5 * RASTER_GRID / size * plane.slopes().abs().element_sum();
        let nearer = if reversed { exact + shift } else { exact - shift };
        let step = format.step(1.0);
        (nearer / step).round() * step
    }
}

#[test]
fn a_plane_never_shadows_itself_without_any_bias() {
    for map in grounds() {
        let planes = on_ground(&map);
        assert!(planes.len() > 1000, "{}", planes.len());
        for plane in planes {
            for format in [None, Some(DepthFormat::Unorm16), Some(DepthFormat::Unorm24)] {
                let stored = stored_plane(&map, plane, format);
                // Exact depths need nothing but what f64 rounds; stored ones the tolerance of their format.
                let tolerance = |reach| match format {
                    Some(format) => map.comparison_tolerance(format, reach).expect("a reach"),
                    None => ComparisonTolerance::constant(1e-12),
                };
                let mean = |taps: u32| plane.mean(taps, &tolerance(0.5 * f64::from(taps)), &stored);
                let tests = [plane.blended(&tolerance(1.0), &stored)].into_iter().chain([1, 2, 3, 5, 8].map(mean));
                for sampled in tests {
                    assert!((sampled.share - 1.0).abs() < 1e-12, "{plane:?}: {sampled:?} in {format:?}");
                    assert_ne!(sampled.rule, Decision::NonePass);
                }
            }
        }
    }
}

/// Hard case 33: a sheet has its own depth stored; with < in place of ≤ it would shadow itself.
#[test]
fn a_thin_sheet_passes_by_at_most() {
    let map = &grounds()[0];
    // A plane across the light: one depth everywhere, the same number in the map and in the test.
    let point = DVec3::new(0.0, 0.0, -4.0);
    let sheet = TangentPlane::new(map, point, DVec3::new(0.4, 0.3, 0.5)).expect("in the map");
    let none = ComparisonTolerance::constant(0.0);
    for sampled in [sheet.blended(&none, |_, _| sheet.depth()), sheet.mean(3, &none, |_, _| sheet.depth())] {
        assert_eq!((sampled.share, sampled.rule), (1.0, Decision::AllPass), "{:?}", sheet.slopes());
    }
}

#[test]
fn what_lies_before_the_plane_at_every_texel_shadows_it() {
    for map in grounds() {
        let away = if map.settings().clip().depth.is_reversed() { -1.0 } else { 1.0 };
        for plane in on_ground(&map) {
            let own = stored_plane(&map, plane, None);
            // By more than the tolerance, but by far less than the plane's depth changes from texel to texel.
            let tolerance = ComparisonTolerance::constant(1e-9);
            let before = away * (2.0 * plane.tolerance(&tolerance) + 1e-12);
            let stored = |x, y| own(x, y) - before;
            for sampled in [plane.blended(&tolerance, stored), plane.mean(3, &tolerance, stored)] {
                assert_eq!(sampled.share, 0.0, "{plane:?}");
                assert_ne!(sampled.rule, Decision::AllPass);
            }
        }
    }
}

/// Against a test that asks the plane at every texel, on depths at random about the plane: where the rules differ from it,
/// the point passes against all texels or against none.
#[test]
fn the_first_two_rules_only_cut_short() {
    run(400, &any::<u64>(), |seed| {
        let mut numbers = Numbers(seed);
        let maps = grounds();
        let map = &maps[(numbers.part() * maps.len() as f64) as usize];
        let planes = on_ground(map);
        rules_only_cut_short(map, planes[(numbers.part() * planes.len() as f64) as usize], seed);
    });
    run(2000, &(case(), settings(), any::<u64>()), |(case, settings, seed)| {
        rules_hold_where_planes_are_seen(&case, &settings, seed);
    });
}

#[test]
fn a_plane_from_its_edge_has_a_slope_with_an_end() {
    for map in grounds() {
        let point = DVec3::new(1.0, 0.5, -6.0);
        let towards = map.texture_from_world();
        // Across the light's ray: the cross product of the gradients runs along it.
        let gradient = |i: usize| {
            let w = towards.row(3);
            (towards.row(i) - projected(towards, point)[i] * w).truncate()
        };
        let along = gradient(0).cross(gradient(1)).normalize();
        let edge_on = along.any_orthonormal_vector();
        let [least, steep] = [edge_on, edge_on + along * 1e-9].map(|normal| TangentPlane::new(&map, point, normal));
        for plane in [least, steep] {
            let slopes = plane.expect("in the map").slopes();
            assert!(slopes.is_finite(), "{slopes}");
            assert!(
                slopes.length()
                    <= 1.01 / MIN_SIN_INCIDENCE * gradient(2).length()
                        / gradient(0).length().min(gradient(1).length()),
                "{slopes}"
            );
        }
        for normal in [DVec3::ZERO, DVec3::NAN, DVec3::splat(f64::INFINITY)] {
            assert_eq!(TangentPlane::new(&map, point, normal), None);
        }
    }
}

#[test]
fn a_point_behind_the_map_has_no_plane() {
    let map = ground(
        &Light::spot((0.0, 4.0, -5.0), (0.0, -1.0, -0.2), 0.7, 0.1, 30.0).expect("sound"),
        ClipSpace::WGPU,
        Warp::Uniform,
    );
    assert_eq!(TangentPlane::new(&map, DVec3::new(0.0, 9.0, -5.0), DVec3::Y), None);
    assert!(TangentPlane::new(&map, DVec3::new(0.0, 0.0, -5.0), DVec3::Y).is_some());
}
