//! What holds for every fit, over views, lights and scenes at random.
//!
//! Each property runs some thousands of cases from a fixed seed; `SHADOWFIT_CASES=100000` in the
//! environment runs that many of each instead. A failing case is made smaller and printed as the
//! Rust expression that makes it.

use glam::{DQuat, DVec3};
use proptest::prelude::*;
use shadowfit::{
    Aabb, DepthFormat, Effort, Focus, FocusForm, Light, Origin, Scene, Settings, ShadowMap, View, Warp,
    focus::{ConvexBody, Plane},
    input::ConvexScene,
    warp::Shift,
};
use testkit::arbitrary::{
    Case, LightParams, Pose, SceneParams, Together, ViewParams, case, following, rotation, run, settings,
};
use testkit::claims::anything::{anything, makes_a_fit_or_a_typed_error};
use testkit::claims::rays::{self, projected};
use testkit::claims::results::exercise;
use testkit::claims::scaling;

#[test]
fn rays_keep_their_place_and_gain_depth() {
    run(5000, &(case(), settings(), any::<u64>()), |(case, settings, seed)| {
        rays::keep_their_place(&case, &settings, seed);
    });
}

#[test]
fn rays_end_in_the_map() {
    run(5000, &(case(), settings(), any::<u64>()), |(case, settings, seed)| {
        rays::end_in_the_map(&case, &settings, seed);
    });
}

/// A camera on a landscape and a light about its camera plane.
#[derive(Clone, Copy, Debug)]
struct Crossing {
    view: ViewParams,
    /// Amounts of the view's right and up, the direction towards the sun or where a lamp is.
    across: [f64; 2],
    lamp: bool,
    half_width: f64,
    height: f64,
}

impl Crossing {
    const LAMP_NEAR: f64 = 0.1;

    fn strategy() -> impl Strategy<Value = Self> {
        let across = (0.0..std::f64::consts::TAU, 0.5..50.0, any::<bool>()).prop_map(
            |(angle, distance, lamp): (f64, f64, bool)| {
                let distance = if lamp { distance } else { 1.0 };
                ([angle.cos() * distance, angle.sin() * distance], lamp)
            },
        );
        let pose = (1.0..10.0, -0.5..0.3).prop_map(|(height, pitch)| Pose {
            eye: [0.0, height, 0.0],
            forward: [0.0, pitch, -1.0],
            up: [0.0, 1.0, 0.0],
        });
        let view = (pose, 0.5..1.8, 0.05..1.0, prop_oneof![Just(None), (50.0..1000.0).prop_map(Some)])
            .prop_map(|(pose, fov_y, near, far)| ViewParams::Perspective { pose, fov_y, aspect: 1.5, near, far });
        (view, across, 20.0..500.0, 5.0..50.0).prop_map(|(view, (across, lamp), half_width, height)| Self {
            view,
            across,
            lamp,
            half_width,
            height,
        })
    }

    fn light(&self, view: &View, depth: f64) -> Light {
        let offset = view.right() * self.across[0] + view.up() * self.across[1] + view.forward() * depth;
        let light = if self.lamp {
            Light::point(view.eye() + offset, Self::LAMP_NEAR, f64::INFINITY)
        } else {
            Light::directional(offset)
        };
        light.expect("a legal light")
    }
}

#[test]
fn maps_change_continuously_across_the_camera_plane() {
    run(500, &(Crossing::strategy(), following()), |(crossing, settings)| {
        let view = crossing.view.build().expect("a legal view");
        let reach = DVec3::new(crossing.half_width, 0.0, crossing.half_width);
        let scene = Scene::from_box(-reach, reach + DVec3::Y * crossing.height).expect("a legal scene");
        let fit = |depth: f64| {
            let light = crossing.light(&view, depth);
            let focus = Focus::new(&view, &light, &scene);
            focus.fit(&settings).into_map()
        };
        let Some(middle) = fit(0.0) else { return };
        assert_eq!(fit(-0.0).map(|map| map.caster_matrix()), Some(middle.caster_matrix()));
        let visible = Focus::new(&view, &crossing.light(&view, 0.0), &scene).receiver_volume();
        let place = |map: &ShadowMap, point: DVec3| {
            let (place, slack, _) = projected(&map.clip_from_world(), point, reach + view.eye().abs());
            (place, slack.max_element())
        };
        // What rounding does to a fit, a light that is somewhere else by some roundings of the coordinates would do too.
        let rounding = 64.0 * f64::EPSILON * (reach.max_element() + crossing.height);
        // The depth range begins this near to a lamp, where roundings of the coordinates are a larger part.
        let at_near = if crossing.lamp { rounding / Crossing::LAMP_NEAR } else { 0.0 };
        let mut steepest: f64 = 0.0;
        for k in 0..=16 {
            for depth in [10_f64.powi(-k), -10_f64.powi(-k)] {
                let Some(map) = fit(depth) else { continue };
                for &point in visible.vertices() {
                    let ((a, a_slack), (b, b_slack)) = (place(&map, point), place(&middle, point));
                    let change = (a - b).abs().max_element();
                    if k < 8 {
                        steepest = steepest.max(change / depth.abs());
                    } else {
                        // Kinks, where another vertex begins to limit the warp, may double a slope and double it again.
                        let allowed = 4.0 * steepest * (depth.abs() + rounding) + a_slack + b_slack + at_near;
                        assert!(change <= allowed, "λw = {depth:e}: {point} moves by {change:e}, not {allowed:e}");
                    }
                }
            }
        }
    });
}

/// Found at random: beginnings of the search that end at one map, either way up.
#[test]
fn a_best_map_that_may_be_either_way_up() {
    let pose = Pose {
        eye: [0.0, 1.055_588_935_149_324_4, 0.0],
        forward: [0.0, -0.368_229_545_031_406_4, -1.0],
        up: [0.0, 1.0, 0.0],
    };
    let (fov_y, near) = (1.133_112_814_490_666_8, 0.642_963_131_074_602_2);
    let crossing = Crossing {
        view: ViewParams::Perspective { pose, fov_y, aspect: 1.5, near, far: None },
        across: [-0.930_942_694_997_348_9, 0.365_165_303_158_82],
        lamp: false,
        half_width: 199.013_579_141_260_4,
        height: 29.184_626_737_097_48,
    };
    let view = crossing.view.build().expect("a legal view");
    let reach = DVec3::new(crossing.half_width, 0.0, crossing.half_width);
    let scene = Scene::from_box(-reach, reach + DVec3::Y * crossing.height).expect("a legal scene");
    let maps = [0.0, 1e-8, -1e-8].map(|depth| {
        let light = crossing.light(&view, depth);
        let focus = Focus::new(&view, &light, &scene);
        (focus.receiver_volume(), focus.fit(&best(16384, 64)).into_map().expect("a map"))
    });
    let (visible, first) = &maps[0];
    for (_, map) in &maps[1..] {
        for &point in visible.vertices() {
            let moved =
                map.texture_from_world().project_point3(point) - first.texture_from_world().project_point3(point);
            // In a map so wide the error hardly depends on the warp, and the search, in f32, ends anywhere in a flat valley. The other
            // way up the corners would move by all of the map.
            assert!(moved.truncate().abs().max_element() < 1.0 / 2.0, "{point} moves by {moved}");
        }
    }
}

/// Settings of the best map of a size.
fn best(width: u32, height: u32) -> Settings {
    let settings = Settings::default().with_border(0).and_then(|settings| settings.with_map_sides(width, height));
    settings.expect("legal sizes").with_warp(Warp::Best(Effort::Good))
}

#[test]
fn scaling_by_a_power_of_two_changes_no_bit() {
    run(2000, &(case(), settings(), -20..=20_i32), |(case, settings, exponent)| {
        scaling::changes_no_bit(&case, &settings, exponent);
    });
}

/// A view, a light and a slanted block, to be turned and moved together.
#[derive(Clone, Copy, Debug)]
struct Movable {
    eye: [f64; 3],
    fov_y: f64,
    /// Towards the sun, or where a lamp is.
    light: [f64; 3],
    lamp: bool,
    centre: [f64; 3],
    half: [f64; 3],
    slant: DQuat,
}

impl Movable {
    fn strategy() -> impl Strategy<Value = Self> {
        let triple = |reach: f64| prop::array::uniform3(-reach..reach);
        let half = prop::array::uniform3(1.0..10.0);
        (triple(20.0), 0.5..1.5, triple(50.0), any::<bool>(), triple(10.0), half, rotation())
            .prop_filter(
                "the eye and the light are off the origin, which one looks at and the other shines on",
                |(eye, _, light, ..)| [*eye, *light].iter().all(|point| DVec3::from(*point).length() > 1.0),
            )
            .prop_map(|(eye, fov_y, light, lamp, centre, half, slant)| Self {
                eye,
                fov_y,
                light,
                lamp,
                centre,
                half,
                slant,
            })
    }

    /// The fit after a motion, and R.
    fn fit(&self, settings: &Settings, turn: DQuat, offset: DVec3) -> (Option<ShadowMap>, ConvexBody) {
        let moved = |point: DVec3| turn * point + offset;
        let eye = DVec3::from(self.eye);
        let up = DVec3::Y + eye.any_orthogonal_vector() * 0.1;
        let view = View::perspective(moved(eye), turn * -eye, turn * up, self.fov_y, 1.5, 0.1, 200.0);
        let light = DVec3::from(self.light);
        let light = if self.lamp {
            Light::point(moved(light), 0.1, f64::INFINITY)
        } else {
            Light::directional(turn * light)
        };
        let (centre, half) = (moved(self.centre.into()), DVec3::from(self.half));
        let planes = DVec3::AXES.map(|axis| {
            let normal = turn * (self.slant * axis);
            [normal, -normal].map(|normal| Plane::through(normal, centre - normal * half.dot(axis)))
        });
        let room = DVec3::splat(2.0 * half.length());
        let block = ConvexScene::new(centre - room, centre + room, planes.as_flattened()).expect("a block");
        let scene = Scene::from_convex(&block);
        let (view, light) = (view.expect("a legal view"), light.expect("a legal light"));
        let focus = Focus::new(&view, &light, &scene);
        (focus.fit(settings).into_map(), focus.receiver_volume())
    }
}

#[test]
fn turning_and_moving_everything_changes_nothing() {
    let offset = prop::array::uniform3(-100.0..100.0);
    run(2000, &(Movable::strategy(), following(), rotation(), offset), |(movable, settings, turn, offset)| {
        // The rounding of f32 depends on the axes and, about the origin of the world, on where that is.
        let settings = settings.with_origin(Origin::Eye);
        let offset = DVec3::from(offset);
        let (here, visible) = movable.fit(&settings, DQuat::IDENTITY, DVec3::ZERO);
        let (there, moved) = movable.fit(&settings, turn, offset);
        assert_eq!(visible.is_empty(), moved.is_empty());
        let (Some(here), Some(there)) = (&here, &there) else {
            assert_eq!(here.is_some(), there.is_some());
            return;
        };
        // Where it limits the warp, the warp depends on them too.
        if (here.weakening() - there.weakening()).abs() > 1e-9 {
            return;
        }
        let clip = |map: &ShadowMap, turn: DQuat, offset: DVec3| -> Vec<DVec3> {
            let matrix = map.clip_from_world();
            visible.vertices().iter().map(|&point| matrix.project_point3(turn * point + offset)).collect()
        };
        let (here, there) = (clip(here, DQuat::IDENTITY, DVec3::ZERO), clip(there, turn, offset));
        for axis in 0..3 {
            // What covers the rounding of f32 moves and stretches x, y and z, each
            // by itself, so that parts of the way from the least to the largest stay.
            let parts = |places: &[DVec3]| -> Option<Vec<f64>> {
                let least = places.iter().map(|place| place[axis]).fold(f64::INFINITY, f64::min);
                let most = places.iter().map(|place| place[axis]).fold(f64::NEG_INFINITY, f64::max);
                let spread = most - least;
                (spread > 1e-2).then(|| places.iter().map(|place| (place[axis] - least) / spread).collect())
            };
            let (Some(here), Some(there)) = (parts(&here), parts(&there)) else { continue };
            for (a, b) in here.iter().zip(&there) {
                // Less than f32 can tell apart near the sides of the clip volume.
                assert!((a - b).abs() < f64::from(f32::EPSILON), "axis {axis}: {a} became {b}");
            }
        }
    });
}

#[test]
fn no_result_is_nan() {
    run(5000, &(case(), settings()), |(case, settings)| {
        let together = Together::of(&case);
        let scene = together.store.scene().expect("the scene is accepted");
        exercise(&together.view, &together.light, &scene, &settings);
    });
}

#[test]
fn any_numbers_make_a_fit_or_a_typed_error() {
    run(10_000, &(anything(), case(), settings()), |(any, legal, settings)| {
        makes_a_fit_or_a_typed_error(&any, &legal, &settings);
    });
}

/// A vertex of R at a lamp but for a rounding: no ray leads there, and w is zero as far as f64 can tell.
#[test]
fn lamp_a_rounding_away_from_a_corner_of_what_is_visible() {
    let view = View::perspective(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 1.0, 1.0, 0.1, 100.0).expect("a legal view");
    let corner = DVec3::new(0.3, 0.2, -4.7);
    let scene = Scene::from_box(corner, corner + DVec3::new(1.1, 0.7, 1.3)).expect("a legal scene");
    for index in 0..9_usize.pow(3) {
        let steps = [index % 9, index / 9 % 9, index / 81].map(|digit| digit as f64 - 4.0);
        let position = corner + DVec3::from(steps) * f64::EPSILON;
        for axis in [DVec3::NEG_Z, DVec3::ONE, DVec3::new(1.0, 0.0, 1.0)] {
            let lamps = [Light::point(position, 0.01, 100.0), Light::hemisphere(position, axis, 0.01, 100.0)];
            for light in lamps {
                exercise(&view, &light.expect("a legal light"), &scene, &Settings::default());
            }
        }
    }
}

/// Nothing that is visible is as far from the lamp as where it begins to cast.
#[test]
fn lamp_whose_near_distance_reaches_beyond_what_is_visible() {
    let eye = DVec3::new(1e6, 0.0, 0.0);
    let view = View::perspective(eye, DVec3::Z, DVec3::Y, 1.5, 1.0, 0.001, 0.005).expect("a legal view");
    let scene = Scene::from_box(eye - DVec3::splat(0.8), eye + DVec3::splat(0.8)).expect("a legal scene");
    let flat = Scene::from_box(eye + DVec3::new(-0.8, 0.0, -0.8), eye + DVec3::new(0.8, 0.002, 0.8));
    for scene in [scene, flat.expect("a legal scene")] {
        for position in [eye, eye - DVec3::Z * 1e-3, eye + DVec3::X * 1e-3] {
            for axis in [DVec3::Z, DVec3::new(-0.7, 0.2, 0.68)] {
                let light = Light::hemisphere(position, axis, 0.03, f64::INFINITY).expect("a legal light");
                let settings = Settings::default().with_warp(Warp::Uniform);
                for settings in [settings, settings.with_warp(Warp::Perspective)] {
                    exercise(&view, &light, &scene, &settings);
                    exercise(&view, &light, &scene, &settings.with_origin(Origin::Eye));
                }
            }
        }
    }
}

/// Found by fuzzing: where the map begins in depth, at the corner where the only caster is, the ray in the middle never comes.
#[test]
fn casters_of_a_list_that_are_all_off_to_one_side() {
    let eye = [48.194_483_578_650_96, 9.928_537_469_235_506, -31.059_436_741_518_088];
    let forward = [-0.982_455_607_628_362_5, -0.383_264_245_429_698_4, 0.186_496_592_568_296_23];
    let (fov_y, aspect) = (1.295_621_593_877_389, 0.693_009_676_189_929_9);
    let view =
        View::perspective(eye, forward, DVec3::Y, fov_y, aspect, 0.059_711_555_603_759_98, 1_178.171_356_658_947_2);
    let position = [705.324_430_724_851_4, 1_131.186_833_234_152_8, -313.517_486_177_905_14];
    let axis = [-0.126_285_209_196_612_26, -0.659_095_026_776_971_6, -0.741_381_003_004_548_9];
    let light = Light::hemisphere(position, axis, 116.734_752_513_018_92, f64::INFINITY);
    let aabb = |[min, max]: [[f32; 3]; 2]| Aabb::new(min, max);
    let casters = [aabb([[-706.5983, -1244.3206, 558.4742], [-617.66895, -1073.641, 1225.076]])];
    let receivers = [
        [[-1327.0049, -248.08102, -16.570423], [-572.18225, 584.2471, 1316.6333]],
        [[-984.0922, -1244.3206, 236.80075], [525.5531, -411.71515, 831.54333]],
        [[-706.5983, -1028.9315, -492.48926], [48.22429, -1028.9315, 840.7145]],
        [[-706.5983, -411.71515, 174.11261], [803.04694, 1253.4956, 174.11261]],
        [[-706.5983, -411.71515, -269.93503], [48.22429, -22.179192, -269.93503]],
    ];
    let receivers = receivers.map(aabb);
    let scene = Scene::new(&casters, &receivers).expect("a legal scene");
    let (view, light) = (view.expect("a legal view"), light.expect("a legal light"));
    for origin in [Origin::World, Origin::Eye, Origin::Light] {
        let settings = Settings::default().with_warp(Warp::Perspective).with_shift(Shift::None).with_origin(origin);
        exercise(&view, &light, &scene, &settings);
        let map = Focus::new(&view, &light, &scene).fit(&settings).into_map().expect("one map does");
        // It begins far behind the light's near distance, if not nowhere: there the middle of the window has no casters.
        assert!(map.depth().near > 10.0 * light.near(), "{:?}", map.depth());
    }
}

/// Found by fuzzing: a warp may change by its ratio over all that is visible, and where that has an extent of 10⁻³⁶ in a
/// direction in which c changes, the slope of c all but left f32.
#[test]
fn a_slope_over_a_length_that_is_too_small_to_see() {
    let scene = Scene::from_box(DVec3::ZERO, DVec3::Z * 14.054_687_5).expect("a legal scene");
    let light = Light::point((1.261_168_617_892_335_4e-44, 0.0, 0.0), 0.996_093_75, 3.2e10).expect("a legal light");
    for exponent in 30..=44 {
        let eye = DVec3::splat(6.0 * 10_f64.powi(-exponent));
        let up = (7.053_073_726_297_957e-38, 0.0, 1.0);
        let (half, aspect) = (85.332_031_25, 85.332_031_25);
        let view = View::orthographic(eye, DVec3::Y, up, half, aspect, -0.976_562_5, 0.0).expect("a legal view");
        exercise(&view, &light, &scene, &Settings::default());
        let map = Focus::new(&view, &light, &scene).fit(&Settings::default()).into_map().expect("one map does");
        // No more than a thousand by a billionth of what is seen.
        let most = map.caster_matrix().to_cols_array().into_iter().map(f32::abs).fold(0.0, f32::max);
        assert!(most <= 1e13, "10^-{exponent}: {most:e}");
        let bias = map.bias(DepthFormat::Unorm16, 0.5).expect("a legal reach");
        assert!(map.receiver_matrix_with(&bias.offset()).is_finite());
    }
}

/// Found at random: a plain that a lamp in it sees from its edge, a line for which the best window was a line too, as long as the
/// map is wide. Nothing but roundings said what can cast in it.
#[test]
fn casters_on_a_plain_that_is_seen_from_its_edge() {
    let (side, height) = (415_962_756.247_404_1, 82_560.586_476_160_39);
    let pose = Pose {
        eye: [0.0, 1e6, 0.0],
        forward: [0.345_610_183_423_970_76, -0.077_884_130_869_525_6, 0.938_378_175_957_672_9],
        up: [0.0, 1.0, 0.0],
    };
    let (fov_y, aspect, near) = (1.047_581_237_416_787, 2.059_691_084_312_887_7, 1_292_938.990_687_527);
    let position = [-718_861_672.000_232_8, height, -side];
    let case = Case {
        view: ViewParams::Perspective { pose, fov_y, aspect, near, far: None },
        light: LightParams::Point { position, near: 463_772.257_644_592_6, range: Some(8_635_935_517.329_243) },
        scene: SceneParams::Bounds { min: [-side, height, -side], max: [side, height, side] },
    };
    for (width, height) in [(16384, 64), (64, 16384), (2048, 2048)] {
        let settings = best(width, height).with_shift(Shift::Back(FocusForm::ReceiverHull));
        for origin in [Origin::World, Origin::Eye, Origin::Light] {
            rays::end_in_the_map(&case, &settings.with_origin(origin), 11_880_504_949_425_668_649);
        }
    }
}
