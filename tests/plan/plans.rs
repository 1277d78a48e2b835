//! What holds for every plan, over towns, views and lights at random; and a scene for each answer a plan can give.

use glam::DVec3;
use rand::SeedableRng as _;
use rand::rngs::StdRng;
use shadowfit::{
    Aabb, Filter, Light, Settings, View, Warp,
    mesh::Solidity,
    plan::{Budget, Kind, LightPlan, Object, Objects, Reason, Surface, plan},
};
use testkit::claims::planner::{
    keeps_every_receiver_in_view, keeps_to_its_texels, loses_no_caster, sees_no_more_in_less, warps_to_gain,
};
use testkit::claims::town::LitTown;

/// How many towns.
fn towns() -> u64 {
    let asked = std::env::var("SHADOWFIT_CASES").ok();
    asked.map_or(300, |count| count.parse::<u64>().expect("SHADOWFIT_CASES is a number") / 10)
}

/// Gives so many towns, each with so many lights and the numbers that made it, to a claim.
fn each_town(towns: u64, lights: usize, mut claim: impl FnMut(&mut StdRng, &LitTown)) {
    for seed in 0..towns {
        // So that a failure says which town it was.
        println!("town {seed}");
        let mut rng = StdRng::seed_from_u64(seed);
        let town = LitTown::at_random(&mut rng, lights);
        claim(&mut rng, &town);
    }
}

#[test]
fn no_caster_is_lost() {
    let (mut checked, mut kinds) = (0, std::collections::BTreeMap::<String, u32>::new());
    each_town(towns(), 6, |rng, town| {
        let (casters, of_lights) = loses_no_caster(rng, town);
        checked += casters;
        of_lights.iter().for_each(|kind| *kinds.entry(format!("{kind:?}")).or_default() += 1);
    });
    println!("{checked} casters between what is seen and its light; {kinds:?}");
    assert!(checked > 10 * towns(), "only {checked}");
    assert_eq!(kinds.len(), 6, "every kind is chosen: {kinds:?}");
}

#[test]
fn the_view_keeps_every_receiver() {
    each_town(towns(), 0, keeps_every_receiver_in_view);
}

#[test]
fn no_warp_is_coarser_than_none() {
    let mut warped = 0;
    each_town(towns(), 6, |_, town| warped += warps_to_gain(town));
    assert!(warped > towns() / 10, "only {warped}");
}

#[test]
fn a_plan_keeps_to_its_texels() {
    each_town(towns() / 4, 20, |_, town| keeps_to_its_texels(town));
}

#[test]
fn a_smaller_view_sees_no_more() {
    let mut dark = 0;
    each_town(towns(), 6, |rng, town| dark += sees_no_more_in_less(rng, town));
    assert!(dark > towns() / 10, "only {dark}");
}

/// A thing between two corners, solid unless told otherwise, whose edges are short.
fn thing(min: [f32; 3], max: [f32; 3]) -> Object {
    let bounds = Aabb::new(min, max);
    Object { surface: Surface::Mesh(Solidity::Watertight), longest_edge: 1e-3, ..Object::new(bounds) }
}

/// A square on the ground of so many units to each side of the origin.
fn ground(half: f32) -> Object {
    thing([-half, -0.1, -half], [half, 0.0, half])
}

fn tower() -> Object {
    thing([2.0, 0.0, -12.0], [4.0, 9.0, -10.0])
}

/// A person's view along −z, in an image 720 pixels high.
fn looking_ahead() -> View {
    View::perspective((0.0, 1.7, 0.0), (0.0, -0.2, -1.0), DVec3::Y, 1.0, 1.6, 0.1, 500.0).expect("sound")
}

fn looking_down() -> View {
    View::perspective((0.0, 10.0, 0.0), DVec3::NEG_Y, DVec3::Z, 1.0, 1.0, 0.1, 50.0).expect("sound")
}

/// With the paper's warp, whose back-shift a plan chooses and gives reasons for.
fn at_most(size: u32) -> Budget {
    Budget::new(Settings::new(size, 720).expect("sound sizes").with_warp(Warp::Perspective))
}

fn sun() -> Light {
    Light::directional((0.4, 1.0, 0.2)).expect("sound")
}

fn lamp(position: [f64; 3], range: f64) -> Light {
    Light::point(position, 0.01, range).expect("sound")
}

fn planned(view: &View, light: Light, objects: &[Object], budget: &Budget) -> LightPlan {
    let objects = Objects::new(objects).expect("sound objects");
    plan(view, &[light], &objects, budget).lights()[0].clone()
}

/// Asserts the kind of a plan and that a reason like this is among its reasons.
macro_rules! assert_because {
    ($plan:expr, $kind:expr, $($reason:pat),+) => {
        let plan = $plan;
        assert_eq!(plan.kind(), $kind, "{:?}", plan.reasons());
        $(assert!(plan.reasons().iter().any(|reason| matches!(reason, $reason)), "{:?}", plan.reasons());)+
    };
}

#[test]
fn a_lamp_that_reaches_nothing_in_view_has_no_map() {
    let behind = planned(&looking_ahead(), lamp([0.0, 3.0, 40.0], 6.0), &[ground(50.0), tower()], &at_most(1024));
    assert_because!(behind, Kind::Nothing, Reason::NoReceivers);
}

#[test]
fn a_light_on_what_nothing_casts_on_has_no_map() {
    let alone = [Object { casts: false, ..ground(50.0) }];
    assert_because!(planned(&looking_ahead(), sun(), &alone, &at_most(1024)), Kind::Nothing, Reason::NoCasters);
}

#[test]
fn a_map_fine_enough_is_uniform_and_no_larger_than_needed() {
    let plan = planned(&looking_down(), sun(), &[ground(3.0), thing([0.0; 3], [1.0; 3])], &at_most(8192));
    assert_because!(&plan, Kind::Uniform, Reason::UniformEnough, Reason::SmallerMap(_), Reason::AllSolid);
    assert!(plan.aliasing() <= 1.0 && plan.passes()[0].map_size() < 8192, "{plan:?}");
}

/// Maps are square, and as large as the shorter side of the settings' map.
#[test]
fn a_budget_that_is_not_square_is_that_of_its_shorter_side() {
    let planned = |budget: &Budget| planned(&looking_ahead(), sun(), &[ground(50.0), tower()], budget);
    let square = Settings::new(256, 720).expect("sound");
    let expected = planned(&Budget::new(square));
    assert_eq!(expected.passes()[0].map_size(), 256);
    for (width, height) in [(256, 4096), (4096, 256)] {
        let settings = square.with_map_sides(width, height).expect("sound");
        let plan = planned(&Budget::new(settings));
        assert_eq!(format!("{plan:?}"), format!("{expected:?}"));
    }
}

#[test]
fn no_warp_is_made_where_none_is_wanted() {
    let settings = Settings::new(256, 720).expect("sound").with_warp(Warp::Uniform);
    let plan = planned(&looking_ahead(), sun(), &[ground(50.0), tower()], &Budget::new(settings));
    assert_because!(plan, Kind::Uniform, Reason::NoWarpWanted, Reason::TexelsShow(_));
}

#[test]
fn along_the_view_a_warp_is_no_finer() {
    let above = Light::directional(DVec3::Y).expect("sound");
    let plan = planned(&looking_down(), above, &[ground(50.0), thing([0.0; 3], [1.0; 3])], &at_most(64));
    assert_because!(plan, Kind::Uniform, Reason::WarpNoFiner(_));
}

#[test]
fn across_a_long_view_a_warp_is_finer() {
    let plan = planned(&looking_ahead(), sun(), &[ground(50.0), tower()], &at_most(1024));
    assert_because!(plan, Kind::Warped, Reason::WarpFiner(_), Reason::ShiftFiner(_));
}

#[test]
fn the_best_matrix_is_planned_with_where_nobody_chooses() {
    let budget = Budget::new(Settings::new(1024, 720).expect("sound sizes"));
    let plan = planned(&looking_ahead(), sun(), &[ground(50.0), tower()], &budget);
    assert_because!(&plan, Kind::Warped, Reason::WarpFiner(_));
    let finer = plan.reasons().iter().find_map(|reason| match reason {
        Reason::WarpFiner(part) => Some(*part),
        _ => None,
    });
    assert!(finer.is_some_and(|part| part < 0.5), "{finer:?}");
}

#[test]
fn under_a_sun_ahead_the_camera_stays() {
    let ahead = Light::directional((0.4, 1.0, -0.8)).expect("sound");
    let plan = planned(&looking_ahead(), ahead, &[ground(50.0), tower()], &at_most(1024));
    assert_because!(plan, Kind::Warped, Reason::WarpFiner(_), Reason::NoShiftFiner(_));
}

#[test]
fn a_lamp_above_ground_that_is_cut_finely_has_one_paraboloid() {
    let low = lamp([0.0, 0.5, -8.0], f64::INFINITY);
    let plan =
        planned(&looking_ahead(), low, &[ground(50.0), thing([1.0, 0.0, -9.0], [1.2, 0.2, -8.8])], &at_most(512));
    assert_because!(plan, Kind::Paraboloid, Reason::WideFrustum(_), Reason::OneHemisphere);
}

/// Ground and walls around a lamp.
fn court() -> [Object; 4] {
    [
        ground(20.0),
        thing([-6.0, 0.0, -15.0], [-5.0, 6.0, -3.0]),
        thing([5.0, 0.0, -15.0], [6.0, 6.0, -3.0]),
        thing([-6.0, 0.0, -16.0], [6.0, 6.0, -15.0]),
    ]
}

#[test]
fn a_lamp_among_what_is_cut_finely_has_two_paraboloids() {
    let plan = planned(&looking_ahead(), lamp([0.0, 2.0, -9.0], 30.0), &court(), &at_most(512));
    assert_because!(plan, Kind::DualParaboloid, Reason::Surrounded, Reason::TwoHemispheres);
}

#[test]
fn a_lamp_among_what_is_not_has_the_faces_of_a_cube() {
    let coarse = court().map(|object| Object { longest_edge: 10.0, ..object });
    let plan = planned(&looking_ahead(), lamp([0.0, 2.0, -9.0], 30.0), &coarse, &at_most(512));
    assert_because!(plan, Kind::CubeFaces, Reason::Surrounded, Reason::CoarseCasters, Reason::Faces(_));
}

#[test]
fn maps_keep_to_the_texels_of_all_lights() {
    let budget = at_most(1024).with_texels(1 << 18);
    let plan = planned(&looking_ahead(), sun(), &[ground(50.0), tower()], &budget);
    assert_because!(&plan, Kind::Warped, Reason::OverBudget(512));
    assert_eq!(plan.texels(), 1 << 18);
}

#[test]
fn flat_sheets_are_tested_by_virtual_samples_where_a_bias_would_show() {
    let sheet = Object { surface: Surface::FlatSheets, ..tower() };
    let plan = planned(&looking_ahead(), sun(), &[ground(50.0), sheet], &at_most(256));
    assert_because!(&plan, Kind::Warped, Reason::BiasShows(_), Reason::TexelsShow(_));
    assert!(plan.virtual_samples() && plan.passes().iter().all(|pass| pass.bias().is_none()));
}

/// Nothing is small enough that the least map has several texels for each pixel.
#[test]
fn flat_sheets_are_tested_with_a_bias_where_it_is_hidden_and_texels_with_it() {
    let [small, sheet] = [ground(0.1), thing([0.0; 3], [0.1; 3])];
    let sheet = Object { surface: Surface::FlatSheets, ..sheet };
    let plan = planned(&looking_down(), sun(), &[small, sheet], &at_most(4096));
    assert_because!(&plan, Kind::Uniform, Reason::BiasHidden(_), Reason::TexelsHidden(_));
    assert_eq!(plan.filter(), Filter::Nearest);
    assert!(plan.passes().iter().all(|pass| pass.bias().is_some()));
}

#[test]
fn sheets_that_curve_are_tested_with_a_bias() {
    let sheet = Object { surface: Surface::Mesh(Solidity::Open), ..tower() };
    let plan = planned(&looking_ahead(), sun(), &[ground(50.0), sheet], &at_most(256));
    assert_because!(&plan, Kind::Warped, Reason::SheetsCurve, Reason::TexelsShow(_));
    assert!(!plan.virtual_samples() && plan.passes().iter().all(|pass| pass.bias().is_some()));
}

#[test]
fn points_are_tested_with_a_bias() {
    let cloud = Object { surface: Surface::Points, ..tower() };
    let plan = planned(&looking_ahead(), sun(), &[ground(50.0), cloud], &at_most(1024));
    assert_because!(plan, Kind::Warped, Reason::PointsCast);
}

#[test]
fn texels_no_larger_than_pixels_are_not_filtered_widely() {
    let budget = at_most(8192).with_filter(Filter::Pcf(5));
    let plan = planned(&looking_down(), sun(), &[ground(3.0), thing([0.0; 3], [1.0; 3])], &budget);
    assert_because!(&plan, Kind::Uniform, Reason::TexelsBlend(_));
    assert_eq!(plan.filter(), Filter::Hardware2x2);
}
