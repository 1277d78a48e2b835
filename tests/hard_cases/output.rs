//! Rows 29 to 35: what is uploaded, sampled and compared.

use shadowfit::glam::{DVec3, Vec3};
use shadowfit::{
    Aabb, Filter, Focus, Light, Scene, Settings, ShadowMap, View, Warp,
    depth::{ComparisonTolerance, Decision, TangentPlane},
    omni::Paraboloids,
};
#[cfg(feature = "alloc")]
use shadowfit::{
    depth::{Culling, DepthTest},
    mesh::Solidity,
};

use crate::place::{in_f32, is_inside, lamp, map, place, settings, sun, turned_view, wide};
use crate::sweep::{about, powers};

/// Suns and lamps above and to the side, before the camera plane, about it and behind, none in the view.
fn lights(view: &View) -> Vec<Light> {
    let towards = |depth: f64| view.right() * 0.6 + view.up() * 0.8 + view.forward() * depth;
    let suns = [0.0, 1e-8, -1e-4, 0.1, -0.5, 3.0, -3.0].map(|depth| sun(towards(depth)));
    let lamps = [0.0, 1e-8, -1e-4, 0.1, -0.5, -3.0].map(|depth| lamp(view.eye() + towards(depth) * 60.0));
    suns.into_iter().chain(lamps).collect()
}

/// R inside the window and H inside the depth range after the matrix and the position are rounded to f32.
/// (`single_precision::maps_hold_what_they_must` over cases at random.)
#[test]
fn row_29_rounding_to_f32() {
    let view = turned_view();
    let floor = Scene::from_box((-90.0, -20.0, -90.0), (90.0, -10.0, 90.0)).expect("sound");
    for scene in [wide(), floor] {
        for light in lights(&view) {
            for warp in [Warp::Uniform, Warp::Perspective] {
                let focus = Focus::new(&view, &light, &scene);
                let map = focus.fit(&settings().with_warp(warp)).into_map().expect("one map does");
                let visible = focus.receiver_volume();
                let body = focus.caster_volume(shadowfit::FocusForm::ReceiverHull);
                for &p in visible.vertices() {
                    assert!(is_inside(in_f32(&map, p)), "{light:?}, {warp:?}: {p} of R");
                    // H on the ray: as far towards the light as its planes go.
                    let towards = light.direction_from(p);
                    let exit = body.planes().filter_map(|plane| {
                        let slope = plane.normal.dot(towards);
                        (slope < 0.0).then(|| plane.at(p) / -slope)
                    });
                    let most = light.position().map_or(f64::INFINITY, |l| l.distance(p) - 1.0);
                    let caster = p + towards * exit.fold(most, f64::min).max(0.0);
                    assert!(is_inside(in_f32(&map, caster)), "{light:?}, {warp:?}: {caster} of H");
                }
            }
        }
    }
}

/// What a hardware filter reads for a receiver at the very edge of the window is inside the map: clamp-to-edge is never
/// asked.
#[test]
fn row_30_receiver_at_the_edge_of_the_window() {
    let view = turned_view();
    for filter in [Filter::Nearest, Filter::Hardware2x2, Filter::Pcf(5)] {
        for size in [64, 512, 2048] {
            let settings = Settings::new(size, 1080).and_then(|s| s.with_border(filter.border())).expect("sound");
            for light in lights(&view) {
                let focus = Focus::new(&view, &light, &wide());
                let map = focus.fit(&settings).into_map().expect("one map does");
                let mut nearest = f64::INFINITY;
                for &p in focus.receiver_volume().vertices() {
                    let coordinates = map.receiver_matrix() * p.as_vec3().extend(1.0);
                    for i in 0..2 {
                        let texel = f64::from(coordinates[i]) / f64::from(coordinates[3]) * f64::from(size);
                        // The middles of the texels that are read lie no farther away.
                        let room = texel.min(f64::from(size) - texel);
                        nearest = nearest.min(room);
                        assert!(room >= filter.reach(), "{filter:?}, {size}: {room} texels from the edge");
                    }
                }
                // Something is at the edge of what is left: the border is no larger than asked for, but for padding.
                let (x, y) = map.window().padding;
                let padding = 0.5 * f64::from(size) * x.max(y);
                assert!(nearest <= f64::from(settings.border()) + padding + 1e-3, "{nearest}");
            }
        }
    }
}

/// Receivers deeper than the farthest caster, by ever more: their depth is in range and beyond every caster's.
#[test]
fn row_31_receiver_deeper_than_the_farthest_caster() {
    let view = View::perspective(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 1.0, 1.5, 0.5, 1e6).expect("sound");
    let caster = [Aabb::new(Vec3::new(-1.0, -1.0, -11.0), Vec3::new(1.0, 1.0, -9.0))];
    for k in 0..=4 {
        let wall = 20.0 * 10_f32.powi(k);
        let receiver = [Aabb::new(Vec3::new(-wall, -wall, -wall), Vec3::new(wall, wall, -wall))];
        let scene = Scene::new(&caster, &receiver).expect("sound");
        for light in [sun(DVec3::Z), sun(DVec3::new(0.1, 0.05, 1.0)), lamp(DVec3::new(1.0, 2.0, 5.0))] {
            let focus = Focus::new(&view, &light, &scene);
            let map = focus.fit(&settings()).into_map().expect("the caster shades the wall");
            for &p in focus.receiver_volume().vertices() {
                let clip = in_f32(&map, p);
                assert!(clip.z <= clip.w, "{wall}, {light:?}: {p} is clipped at {}", clip.z / clip.w);
                let (min, max) = (caster[0].min.as_dvec3(), caster[0].max.as_dvec3());
                for corner in [min, max] {
                    assert!(place(&map, p).z > place(&map, corner).z, "{wall}, {light:?}: {p}");
                    assert!(
                        (0.0..=1.0).contains(&place(&map, corner).z),
                        "{wall}, {light:?}: the caster is clipped"
                    );
                }
            }
        }
    }
}

/// A map of a floor under a slanting sun, and the floor's plane at a point of it.
fn floor(warp: Warp) -> (ShadowMap, TangentPlane) {
    let view = View::perspective((0.0, 1.7, 0.0), (0.0, -0.3, -1.0), DVec3::Y, 1.0, 1.6, 0.1, 60.0).expect("sound");
    let scene = Scene::from_box((-30.0, 0.0, -30.0), (30.0, 5.0, 30.0)).expect("sound");
    let map = map(&view, &sun(DVec3::new(0.4, 0.3, 0.5)), &scene, &settings().with_warp(warp));
    let plane = TangentPlane::new(&map, DVec3::new(0.3, 0.0, -5.0), DVec3::Y).expect("in the map");
    (map, plane)
}

fn centre(map: &ShadowMap, x: u32, y: u32) -> shadowfit::glam::DVec2 {
    let size = f64::from(map.settings().map_size());
    shadowfit::glam::DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5) / size
}

/// A solid on the floor, touching it, and a hair above. A first depth stores its lit side, a second depth its far one: where
/// that is the foot, at the floor's own depth, the floor is lit, by ≤, and so it is as far from the contact as what is stored
/// lies within the tolerance; whatever is nearer to the light by more shadows it. (`DepthTest` says so of each test.)
#[test]
fn row_32_caster_touching_its_receiver() {
    #[cfg(feature = "alloc")]
    {
        assert_eq!(DepthTest::First.culling(Solidity::Watertight), Culling::None);
        assert_eq!(DepthTest::Second.culling(Solidity::Watertight), Culling::Front);
    }
    let (map, plane) = floor(Warp::Perspective);
    for tolerance in powers().filter(|x| *x > 0.0) {
        let tolerance = ComparisonTolerance::constant(tolerance);
        let allowed = plane.tolerance(&tolerance);
        let at = |nearer: f64| plane.blended(&tolerance, |x, y| plane.depth_at(centre(&map, x, y)) - nearer).share;
        // Comparisons of depths round: a few steps of numbers below one.
        let rounding = 8.0 * f64::EPSILON;
        for height in powers().map(f64::abs) {
            let share = at(height);
            if height <= allowed - rounding {
                assert_eq!(share, 1.0, "{height:e} above the floor, within {allowed:e}: detached, lit");
            }
            if height > allowed + rounding {
                assert_eq!(share, 0.0, "{height:e} above the floor, beyond {allowed:e}: shadow");
            }
        }
        // The foot: the floor's own depth.
        assert_eq!(at(0.0), 1.0);
    }
}

/// One rule, ≤: a sheet across the light has its own depth stored, and a step nearer is already before it.
/// (`virtual_samples::a_thin_sheet_passes_by_at_most`.)
#[test]
fn row_33_at_most_and_not_less() {
    // In a uniform map the sun's depth is the same all over it.
    let (map, _) = floor(Warp::Uniform);
    let sheet = TangentPlane::new(&map, DVec3::new(0.0, 0.5, -4.0), DVec3::new(0.4, 0.3, 0.5)).expect("in the map");
    let depth = sheet.depth();
    // What is left of slopes across the light is rounding.
    let none = ComparisonTolerance::constant(0.0);
    assert!(sheet.tolerance(&none) <= 1e-15, "{:e}", sheet.tolerance(&none));
    let stored = |depth: f64| [sheet.blended(&none, |_, _| depth), sheet.mean(3, &none, |_, _| depth)];
    for own in stored(depth) {
        assert_eq!((own.share, own.rule), (1.0, Decision::AllPass));
    }
    for beyond in powers().map(f64::abs).filter(|by| *by >= 1e-14) {
        for (sampled, share) in
            stored(depth + beyond).map(|s| (s, 1.0)).into_iter().chain(stored(depth - beyond).map(|s| (s, 0.0)))
        {
            assert_eq!(sampled.share, share, "{beyond:e}: {sampled:?}");
        }
    }
}

/// Directions up to straight behind: the place and the point undo each other, and the other half has its own map.
/// (`paraboloid::project_and_unproject_undo_each_other`.)
#[test]
fn row_34_paraboloid_at_the_back_axis() {
    let view = View::perspective((0.5, 2.0, 9.0), (0.0, 0.1, -1.0), DVec3::Y, 1.0, 1.5, 0.1, 100.0).expect("sound");
    let scene = Scene::from_box((-5.0, -3.0, -10.0), (5.0, 3.0, 10.0)).expect("sound");
    // At the origin, so that the world's numbers round no more than the frame's.
    let focus = Focus::new(&view, &lamp(DVec3::ZERO), &scene);
    let Paraboloids::Two(maps) = focus.paraboloids(&settings()) else {
        panic!("the lamp is among what is visible")
    };
    for map in maps {
        let axis = map.axis();
        let across = axis.any_orthonormal_vector();
        let behind = powers().map(f64::abs).map(|angle| {
            let (sin, cos) = angle.sin_cos();
            -axis * cos + across * sin
        });
        let at_rim = about(0.0).map(|angle| axis * angle + across);
        for direction in behind.chain(at_rim) {
            let point = direction * 3.0;
            // An angle that the world's coordinates cannot hold is straight behind.
            let Some(place) = map.project(point) else {
                assert!(direction.dot(axis) <= -1.0 + f64::EPSILON, "{direction}");
                continue;
            };
            assert!(place.is_finite());
            let back = map.unproject(place);
            let allowed = 16.0 * f64::EPSILON * (3.0 + map.far());
            assert!((back - point).length() <= allowed, "{direction}: {back}");
            // One of the two has it in its disc, both on the rim.
            let opposite = map.opposite();
            let Some(other) = opposite.project(point) else { continue };
            let radii = [place, other].map(|place| place.truncate().length());
            assert!(radii[0].min(radii[1]) <= 1.0 + 4.0 * f64::EPSILON, "{direction}: {radii:?}");
            assert!((opposite.unproject(other) - point).length() <= allowed, "{direction}");
        }
        assert_eq!(map.project(-axis * 3.0), None);
        assert!(map.clip_plane().at(-axis * 3.0) < 0.0);
    }
}

/// d ∝ cos(view, normal) / cos(light, normal): a texel on a plane is as long as across the ray over the cosine to the light,
/// and seen as long as that times the cosine to the viewer.
#[test]
fn row_35_foreshortening_by_view_and_light() {
    let view =
        View::orthographic((0.0, 50.0, 50.0), (0.0, -1.0, -1.0), DVec3::Y, 20.0, 1.0, 0.0, 100.0).expect("sound");
    let scene = Scene::from_box(DVec3::splat(-10.0), DVec3::splat(10.0)).expect("sound");
    for light in [sun(DVec3::new(0.0, 1.0, 0.2)), sun(DVec3::new(0.0, 1.0, -1.0)), sun(DVec3::new(0.0, 0.2, 1.0))] {
        let map = map(&view, &light, &scene, &settings().with_warp(Warp::Uniform));
        let texture_from_world = map.texture_from_world();
        let l = light.homogeneous().truncate();
        // Planes about the axis that is across light and view both.
        for degrees in (0..360).step_by(5) {
            let (sin, cos) = f64::from(degrees).to_radians().sin_cos();
            let normal = DVec3::new(0.0, cos, sin);
            let along = DVec3::new(0.0, -sin, cos);
            let (to_light, to_view) = (normal.dot(l).abs(), normal.dot(view.forward()).abs());
            if to_light < 1e-2 {
                continue;
            }
            // How far along the plane it is from a texel to the next one in y.
            let v = |p: DVec3| texture_from_world.project_point3(p).y * f64::from(map.settings().map_size());
            let step = (v(along) - v(DVec3::ZERO)).recip().abs();
            let texel = map.footprint(DVec3::ZERO).expect("in the map").along_y.length();
            assert!((step * to_light / texel - 1.0).abs() <= 1e-9, "{degrees}: {step} {texel} {to_light}");
            let seen = step * along.cross(view.forward()).length();
            assert!((seen - texel * to_view / to_light).abs() <= 1e-9 * texel / to_light, "{degrees}: {seen}");
        }
    }
}
