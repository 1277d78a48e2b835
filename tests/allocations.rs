//! A fit, its bodies, its report and culling allocate nothing, whatever the light, the scene and the settings.

use allocation_counter::measure;
use shadowfit::glam::{DVec3, Vec3, Vec4};
use shadowfit::{
    Aabb, ClipSpace, DepthFormat, Effort, Focus, FocusForm, Light, Origin, Outcome, Scene, Settings, View, Warp,
    cascades::{CascadeLayout, CascadeSplits, Cascades, SplitScheme},
    fit,
    input::{ConvexScene, DepthRange},
    multiview::SharedFocus,
    seen::{DepthTile, Seen},
    warp::{Shift, classify},
};
use std::hint::black_box;

/// Allocations made by this thread; the test runner's own threads do not count.
fn allocations(work: impl FnOnce()) -> u64 {
    measure(work).count_total
}

fn views() -> Vec<View> {
    let eye = DVec3::new(2.0, 3.0, 12.0);
    let forward = DVec3::new(0.1, -0.2, -1.0);
    vec![
        View::perspective(eye, forward, DVec3::Y, 1.0, 1.6, 0.1, 80.0).unwrap(),
        View::perspective(eye, forward, DVec3::Y, 1.0, 1.6, 0.1, f64::INFINITY).unwrap(),
        View::orthographic(eye, forward, DVec3::Y, 8.0, 1.6, 0.1, 80.0).unwrap(),
        // Sees nothing of the scene.
        View::perspective(eye, -forward, DVec3::Y, 0.3, 1.0, 0.1, 80.0).unwrap(),
    ]
}

fn lights() -> Vec<Light> {
    let above = DVec3::new(1.0, 9.0, -4.0);
    vec![
        Light::directional(DVec3::new(0.3, 1.0, 0.4)).unwrap(),
        Light::directional(DVec3::new(0.0, 0.5, -1.0)).unwrap(),
        Light::point(above, 0.1, f64::INFINITY).unwrap(),
        Light::point(DVec3::new(3.0, 8.0, 30.0), 0.1, 60.0).unwrap(),
        Light::spot(above, DVec3::new(0.2, -1.0, 0.1), 0.7, 0.1, 40.0).unwrap(),
        Light::hemisphere(above, DVec3::NEG_Y, 0.1, 40.0).unwrap(),
        // Among what is visible.
        Light::point(DVec3::new(1.0, 2.0, -3.0), 0.1, 40.0).unwrap(),
    ]
}

fn boxes() -> Vec<Aabb> {
    let corner = |index: i32| Vec3::new((index % 5 * 4 - 8) as f32, 0.0, (index / 5 * 4 - 12) as f32);
    (0..25).map(|index| Aabb::new(corner(index), corner(index) + Vec3::new(1.0, 3.0, 2.0))).collect()
}

fn settings() -> Vec<Settings> {
    let clips = [ClipSpace::WGPU, ClipSpace::VULKAN.reversed(), ClipSpace::OPENGL, ClipSpace::OPENGL.reversed()];
    let shifts = [Shift::None, Shift::Back(FocusForm::ReceiverHull), Shift::Back(FocusForm::ViewHull)];
    let mut all = Vec::new();
    let named = [Warp::Uniform, Warp::Stable, Warp::Perspective, Warp::LightSpace, Warp::Trapezoidal];
    for warp in named
        .into_iter()
        .chain([Effort::ClosedForms, Effort::Rough, Effort::Good, Effort::Thorough].map(Warp::Best))
    {
        for shift in shifts {
            for clip in clips {
                for origin in [Origin::World, Origin::Eye, Origin::Light] {
                    let base = Settings::new(1024, 720).unwrap().with_border(3).unwrap();
                    // A map that is not square is searched for in more ways.
                    let base = if origin == Origin::Eye { base.with_map_sides(2048, 512).unwrap() } else { base };
                    all.push(base.with_warp(warp).with_shift(shift).with_clip(clip).with_origin(origin));
                }
            }
        }
    }
    all
}

/// Runs a check for every view, light and form of scene.
fn for_each_case(mut check: impl FnMut(&View, &Light, &Scene<'_>)) {
    let (min, max) = (DVec3::new(-10.0, 0.0, -14.0), DVec3::new(10.0, 4.0, 8.0));
    let boxes = boxes();
    let convex = ConvexScene::around([min, max, DVec3::new(0.0, 12.0, 0.0)]).unwrap();
    let scenes =
        [Scene::from_box(min, max).unwrap(), Scene::from_convex(&convex), Scene::new(&boxes, &boxes[5..]).unwrap()];
    for view in &views() {
        for light in &lights() {
            for scene in &scenes {
                check(view, light, scene);
            }
        }
    }
}

#[test]
fn the_counter_counts() {
    assert_eq!(allocations(|| drop(black_box(Box::new(1)))), 1);
}

#[test]
fn constructors() {
    let boxes = boxes();
    let (eye, min, max) = (DVec3::new(2.0, 3.0, 12.0), DVec3::splat(-9.0), DVec3::splat(9.0));
    let count = allocations(|| {
        let view = black_box(View::perspective(eye, -eye, DVec3::Y, 1.0, 1.6, 0.1, 80.0)).unwrap();
        black_box(View::from_clip_from_world(view.clip_from_world(), ClipSpace::OPENGL)).unwrap();
        black_box(Light::spot(eye, -eye, 0.7, 0.1, 40.0)).unwrap();
        black_box(Scene::new(&boxes, &boxes)).unwrap();
        black_box(ConvexScene::around([eye, min, max])).unwrap();
        black_box(Light::directional(DVec3::ZERO)).unwrap_err();
    });
    assert_eq!(count, 0);
}

#[test]
fn fits() {
    let settings = settings();
    let (mut maps, mut empty, mut surrounded) = (0, 0, 0);
    for_each_case(|view, light, scene| {
        for settings in &settings {
            let mut outcome = None;
            let count = allocations(|| outcome = Some(fit(view, light, scene, settings)));
            assert_eq!(count, 0, "{view:?} {light:?} {settings:?}");
            match outcome {
                Some(Outcome::Map(_)) => maps += 1,
                Some(Outcome::Empty(_)) => empty += 1,
                _ => surrounded += 1,
            }
        }
    });
    assert!(maps > 0 && empty > 0 && surrounded > 0, "{maps}, {empty}, {surrounded}");
}

#[test]
fn fits_of_several_views() {
    let views = views();
    for light in lights() {
        let scene = Scene::from_box((-20.0, 0.0, -20.0), (20.0, 8.0, 20.0)).unwrap();
        for warp in [Warp::Uniform, Warp::Stable, Warp::default()] {
            let settings = Settings::default().with_warp(warp);
            let count = allocations(|| {
                let shared = SharedFocus::new(&views, &light, &scene).unwrap();
                black_box((
                    shared.fit(&settings),
                    shared.sharing(&settings),
                    shared.bodies(FocusForm::ReceiverHull).count(),
                ));
            });
            assert_eq!(count, 0, "{light:?} {warp:?}");
        }
    }
}

#[test]
fn tiles_and_fits_to_them() {
    let depths: Vec<f32> = (0..160 * 100).map(|pixel| 0.002 + 1e-7 * pixel as f32).collect();
    let (image, range) = ([160, 100], DepthRange::ZeroToOneReversed);
    let mut tiles = vec![DepthTile::EMPTY; 160];
    for_each_case(|view, light, scene| {
        let count = allocations(|| {
            let reduced = DepthTile::reduce(&depths, image, 10, range).unwrap();
            tiles.iter_mut().zip(reduced).for_each(|(tile, reduced)| *tile = reduced);
            let seen = Seen::from_tiles(view, range, image, 10, &tiles).unwrap();
            let focus = Focus::new(view, light, scene).with_seen(&seen);
            black_box(focus.fit(&Settings::default()));
        });
        assert_eq!(count, 0, "{view:?} {light:?}");
    });
}

#[test]
fn bodies_and_their_faces() {
    for_each_case(|view, light, scene| {
        let count = allocations(|| {
            let focus = Focus::new(view, light, scene);
            for body in [
                focus.receiver_volume(),
                focus.caster_volume(FocusForm::ReceiverHull),
                focus.caster_volume(FocusForm::ViewHull),
            ] {
                black_box((body.volume(), body.bounds(), body.contains(view.eye())));
                black_box((body.planes().count(), body.faces().count(), body.edges().count()));
            }
            black_box(classify(view, light).near_cases().count());
        });
        assert_eq!(count, 0, "{view:?} {light:?}");
    });
}

#[test]
fn reports() {
    let (mut reports, receivers) = (0, boxes());
    for_each_case(|view, light, scene| {
        let focus = Focus::new(view, light, scene);
        let Outcome::Map(map) = focus.fit(&Settings::default()) else { return };
        let count = allocations(|| {
            black_box(map.report(&focus));
            black_box((map.aliasing_over(&focus), focus.aliasing_lower_bound(&Settings::default())));
            black_box(map.aliasing_over_receivers(&focus, &receivers));
            black_box((map.caster_matrix(), map.receiver_matrix()));
            let bias = map.bias(DepthFormat::Float32, 1.0).unwrap();
            black_box((map.receiver_matrix_with(&bias.offset()), map.linear_depth()));
            for &point in focus.receiver_volume().vertices() {
                black_box((map.aliasing(point), map.depth_resolution(point, DepthFormat::Float32)));
            }
        });
        assert_eq!(count, 0, "{view:?} {light:?}");
        reports += 1;
    });
    assert!(reports > 0);
}

#[test]
fn culling() {
    let boxes = boxes();
    let spheres: Vec<Vec4> = boxes.iter().map(|one| ((one.min + one.max) * 0.5).extend(2.0)).collect();
    let mut meets = vec![false; boxes.len()];
    for_each_case(|view, light, scene| {
        let count = allocations(|| {
            let body = Focus::new(view, light, scene).caster_volume(FocusForm::ReceiverHull);
            let culler = body.culler();
            culler.boxes(&boxes, &mut meets);
            culler.spheres(&spheres, &mut meets);
            black_box((body.intersects_aabb(view.eye(), view.eye()), body.intersects_sphere(view.eye(), 1.0)));
        });
        assert_eq!(count, 0, "{view:?} {light:?}");
    });
}

#[test]
fn cascades() {
    let mut maps = 0;
    for_each_case(|view, light, scene| {
        for cuts in [
            CascadeSplits::Visible { count: 8, split: SplitScheme::Practical(0.5) },
            CascadeSplits::At(&[1.0, 5.0, 30.0]),
        ] {
            let count = allocations(|| {
                let cascades = Cascades::new(view, light, scene, cuts, 0.1).unwrap();
                let fitted = cascades.fit(&Settings::default());
                black_box((cascades.index_at(3.0), cascades.blend_at(3.0)));
                black_box(fitted.report());
                for layout in [CascadeLayout::Array, CascadeLayout::Atlas] {
                    black_box(fitted.uniform(layout, |_| None).to_bytes());
                }
                maps += fitted.maps().count();
            });
            assert_eq!(count, 0, "{view:?} {light:?} {cuts:?}");
        }
    });
    assert!(maps > 0);
}
