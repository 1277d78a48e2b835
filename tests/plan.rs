//! What holds for every plan, over towns, views and lights at random; and a scene for each answer a plan can give.

#![cfg(feature = "std")]
#![allow(clippy::disallowed_methods, reason = "angles spread the cases, they are no part of a plan")]

use glam::{DVec3, Vec3};
use rand::rngs::StdRng;
use rand::{RngExt as _, SeedableRng as _};
use shadowfit::glam;
use shadowfit::{
    Aabb, Budget, CubeFace, Filter, Kind, Light, LightPlan, Object, Objects, Pass, Plan, Projection, Reason,
    Settings, Solidity, Surface, View, Warp, plan,
};

/// A ground and some hundred boxes on it and above it, of every surface.
fn town(rng: &mut StdRng) -> Vec<Object> {
    let half = rng.random_range(5.0..80.0_f32);
    let ground = Aabb::new(Vec3::new(-half, -0.1, -half), Vec3::new(half, 0.0, half));
    let mut objects = vec![Object { casts: rng.random_bool(0.5), ..Object::new(ground) }];
    for _ in 0..rng.random_range(3..200) {
        let size = Vec3::new(rng.random_range(0.1..6.0), rng.random_range(0.1..12.0), rng.random_range(0.1..6.0));
        let min = Vec3::new(
            rng.random_range(-half..half),
            if rng.random_bool(0.7) { 0.0 } else { rng.random_range(0.0..20.0) },
            rng.random_range(-half..half),
        );
        let surface = match rng.random_range(0..10) {
            0 => Surface::Points,
            1..3 => Surface::FlatSheets,
            3..5 => Surface::Mesh(Solidity::Open),
            _ => Surface::Mesh(Solidity::Solid),
        };
        objects.push(Object {
            casts: rng.random_bool(0.9),
            receives: rng.random_bool(0.9),
            surface,
            triangles: rng.random_range(1..1000),
            longest_edge: rng.random_range(0.01..1.0),
            ..Object::new(Aabb::new(min, min + size))
        });
    }
    objects
}

fn direction(rng: &mut StdRng) -> DVec3 {
    loop {
        let one = DVec3::from_array([(); 3].map(|()| rng.random_range(-1.0..1.0)));
        if (0.1..1.0).contains(&one.length()) {
            return one;
        }
    }
}

fn view(rng: &mut StdRng) -> View {
    let eye = DVec3::new(rng.random_range(-20.0..20.0), rng.random_range(0.3..15.0), rng.random_range(-20.0..20.0));
    let far = if rng.random_bool(0.2) { f64::INFINITY } else { rng.random_range(5.0..200.0) };
    let fov = rng.random_range(0.2..2.0);
    let near = rng.random_range(0.01..1.0);
    View::perspective(eye, direction(rng) * DVec3::new(1.0, 0.3, 1.0), DVec3::Y, fov, 1.6, near, far)
        .expect("a sound view")
}

fn light(rng: &mut StdRng) -> Light {
    let position =
        DVec3::new(rng.random_range(-30.0..30.0), rng.random_range(0.2..15.0), rng.random_range(-30.0..30.0));
    let (near, range) = (rng.random_range(0.001..0.1), rng.random_range(1.0..60.0));
    let range = if rng.random_bool(0.1) { f64::INFINITY } else { range };
    match rng.random_range(0..5) {
        0 => Light::directional(direction(rng) + DVec3::Y),
        1 => Light::spot(position, direction(rng) - DVec3::Y, rng.random_range(0.1..1.5), near, range),
        2 => Light::hemisphere(position, direction(rng) - DVec3::Y, near, range),
        _ => Light::point(position, near, range),
    }
    .expect("a sound light")
}

fn budget(rng: &mut StdRng) -> Budget {
    let size = 1 << rng.random_range(6..12);
    let warp = if rng.random_bool(0.2) { Warp::Uniform } else { Warp::Perspective };
    let filter = match rng.random_range(0..3) {
        0 => Filter::Nearest,
        1 => Filter::Hardware,
        _ => Filter::PercentageCloser(rng.random_range(2..6)),
    };
    Budget::new(Settings::new(size, 720).expect("sound sizes").with_warp(warp)).with_filter(filter)
}

fn in_box(rng: &mut StdRng, one: &Aabb) -> DVec3 {
    let part = DVec3::from_array([(); 3].map(|()| rng.random_range(0.0..1.0)));
    one.min.as_dvec3() + part * (one.max - one.min).as_dvec3()
}

/// The pass that answers for a point.
fn pass_for<'a>(light: &Light, of_light: &'a LightPlan, point: DVec3) -> Option<&'a Pass> {
    of_light.passes().iter().find(|pass| match pass.projection() {
        Projection::Frustum(_) => true,
        Projection::Face(face, _) => light.position().is_some_and(|at| CubeFace::of(point - at) == *face),
        Projection::Paraboloid(paraboloid) => paraboloid.clip_plane().at(point) >= 0.0,
    })
}

/// Where a pass puts a point: x and y from −1 to 1 inside of the map, depth from 0 to 1.
fn place(pass: &Pass, point: DVec3) -> DVec3 {
    match pass.projection() {
        Projection::Frustum(map) | Projection::Face(_, map) => {
            map.shadow_from_world_in(shadowfit::ClipSpace::WGPU).project_point3(point)
        }
        Projection::Paraboloid(paraboloid) => paraboloid.project(point).expect("not behind the pole"),
    }
}

fn towns() -> u64 {
    let asked = std::env::var("SHADOWFIT_CASES").ok();
    asked.map_or(300, |count| count.parse::<u64>().expect("SHADOWFIT_CASES is a number") / 10)
}

#[test]
fn no_caster_is_lost() {
    let (mut checked, mut kinds) = (0, std::collections::BTreeMap::<String, u32>::new());
    for seed in 0..towns() {
        let rng = &mut StdRng::seed_from_u64(seed);
        let town = town(rng);
        let objects = Objects::new(&town).expect("a sound town");
        let (view, budget) = (view(rng), budget(rng));
        let lights: Vec<Light> = (0..6).map(|_| light(rng)).collect();
        let plan = plan(&view, &lights, &objects, &budget);
        for (light, of_light) in lights.iter().zip(plan.lights()) {
            *kinds.entry(format!("{:?}", of_light.kind())).or_default() += 1;
            checked += check_casters(rng, &town, &view, light, &plan, of_light, seed);
        }
    }
    println!("{checked} casters between what is seen and its light; {kinds:?}");
    assert!(checked > 10 * towns(), "only {checked}");
    assert_eq!(kinds.len(), 6, "every kind is chosen: {kinds:?}");
}

/// Checks random casters of one light; returns how many there were.
fn check_casters(
    rng: &mut StdRng,
    town: &[Object],
    view: &View,
    light: &Light,
    plan: &Plan,
    of_light: &LightPlan,
    seed: u64,
) -> u64 {
    let mut checked = 0;
    let is_inside = |planes: &[shadowfit::Plane], point| planes.iter().all(|plane| plane.at(point) >= 0.0);
    for _ in 0..100 {
        let receiver = &town[rng.random_range(0..town.len())];
        let seen = in_box(rng, &receiver.bounds);
        if !receiver.receives || !is_inside(&view.planes(), seen) || !is_inside(&light.planes(), seen) {
            continue;
        }
        // The planes of L hold all that a light reaches, and corners beyond.
        if light.position().is_some_and(|at| at.distance(seen) > light.range()) {
            continue;
        }
        let to_light = light.position().map_or(60.0 * light.direction_from(seen), |position| position - seen);
        for _ in 0..4 {
            let caster = seen + to_light * rng.random_range(0.0..1.0);
            let is_too_near = light.position().is_some_and(|at| at.distance(caster) < 1.01 * light.near());
            if is_too_near || !is_inside(&light.planes(), caster) {
                continue;
            }
            for (id, object) in (0..).zip(town) {
                let Aabb { min, max } = object.bounds;
                let holds = caster.cmpge(min.as_dvec3()).all() && caster.cmple(max.as_dvec3()).all();
                if !object.casts || !holds {
                    continue;
                }
                checked += 1;
                let words = || format!("town {seed}: {light:?} at {seen}, behind {caster} of object {id}");
                let pass = pass_for(light, of_light, seen).unwrap_or_else(|| panic!("no map, {}", words()));
                assert!(plan.casters(pass).contains(&id), "not drawn, {}", words());
                let (caster, seen) = (place(pass, caster), place(pass, seen));
                assert!((caster - seen).truncate().length() < 1e-6, "{caster} and {seen} in the map, {}", words());
                assert!(seen.truncate().abs().max_element() <= 1.0, "outside of the map, {}", words());
                assert!(caster.z >= 0.0 && caster.z <= seen.z + 1e-9 && seen.z <= 1.0, "depth, {}", words());
            }
        }
    }
    checked
}

#[test]
fn the_view_keeps_every_receiver() {
    for seed in 0..towns() {
        let rng = &mut StdRng::seed_from_u64(seed);
        let town = town(rng);
        let objects = Objects::new(&town).expect("a sound town");
        let view = view(rng);
        let plan = plan(&view, &[], &objects, &budget(rng));
        for object in town.iter().filter(|object| object.receives) {
            for _ in 0..50 {
                let point = in_box(rng, &object.bounds);
                if view.planes().iter().all(|plane| plane.at(point) >= 0.0) {
                    assert!(plan.view().planes().iter().all(|plane| plane.at(point) >= 0.0), "{seed}: {point}");
                }
            }
        }
    }
}

#[test]
fn no_warp_is_coarser_than_none() {
    let mut warped = 0;
    for seed in 0..towns() {
        let rng = &mut StdRng::seed_from_u64(seed);
        let objects = Objects::new(&town(rng)).expect("a sound town");
        let (view, budget) = (view(rng), budget(rng));
        let lights: Vec<Light> = (0..6).map(|_| light(rng)).collect();
        let unwarped = Budget::new(budget.settings().with_warp(Warp::Uniform)).with_filter(budget.filter());
        let free = plan(&view, &lights, &objects, &budget);
        let uniform = plan(&view, &lights, &objects, &unwarped);
        for (free, uniform) in free.lights().iter().zip(uniform.lights()) {
            if (free.kind(), uniform.kind()) == (Kind::Perspective, Kind::Uniform) {
                warped += 1;
                let (size, uniform_size) = (free.passes()[0].map_size(), uniform.passes()[0].map_size());
                assert!(size <= uniform_size, "{seed}: {size} and {uniform_size} texels");
                let is_finer = free.aliasing() < uniform.aliasing() || free.aliasing() <= budget.aliasing();
                assert!(is_finer, "{seed}: {} and {}", free.aliasing(), uniform.aliasing());
            }
        }
    }
    assert!(warped > towns() / 10, "only {warped}");
}

#[test]
fn a_plan_keeps_to_its_texels() {
    for seed in 0..towns() / 4 {
        let rng = &mut StdRng::seed_from_u64(seed);
        let objects = Objects::new(&town(rng)).expect("a sound town");
        let (view, budget) = (view(rng), budget(rng));
        let lights: Vec<Light> = (0..20).map(|_| light(rng)).collect();
        let most = plan(&view, &lights, &objects, &budget).texels() / 3;
        let within = plan(&view, &lights, &objects, &budget.with_texels(most));
        let smallest = within.lights().iter().flat_map(LightPlan::passes).all(|pass| pass.map_size() <= 64);
        assert!(within.texels() <= most || smallest, "{seed}: {} of {most}", within.texels());
    }
}

/// A thing between two corners, solid unless told otherwise, whose edges are short.
fn thing(min: [f32; 3], max: [f32; 3]) -> Object {
    let bounds = Aabb::new(min.into(), max.into());
    Object { surface: Surface::Mesh(Solidity::Solid), longest_edge: 1e-3, ..Object::new(bounds) }
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

fn at_most(size: u32) -> Budget {
    Budget::new(Settings::new(size, 720).expect("sound sizes"))
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
    assert_because!(behind, Kind::Nothing, Reason::NothingVisible);
}

#[test]
fn a_light_on_what_nothing_casts_on_has_no_map() {
    let alone = [Object { casts: false, ..ground(50.0) }];
    assert_because!(planned(&looking_ahead(), sun(), &alone, &at_most(1024)), Kind::Nothing, Reason::NothingCasts);
}

#[test]
fn a_map_fine_enough_is_uniform_and_no_larger_than_needed() {
    let plan = planned(&looking_down(), sun(), &[ground(3.0), thing([0.0; 3], [1.0; 3])], &at_most(8192));
    assert_because!(&plan, Kind::Uniform, Reason::UniformEnough, Reason::SmallerMap(_), Reason::AllSolid);
    assert!(plan.aliasing() <= 1.0 && plan.passes()[0].map_size() < 8192, "{plan:?}");
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
    assert_because!(plan, Kind::Perspective, Reason::WarpFiner(_), Reason::ShiftFiner(_));
}

#[test]
fn under_a_sun_ahead_the_camera_stays() {
    let ahead = Light::directional((0.4, 1.0, -0.8)).expect("sound");
    let plan = planned(&looking_ahead(), ahead, &[ground(50.0), tower()], &at_most(1024));
    assert_because!(plan, Kind::Perspective, Reason::WarpFiner(_), Reason::NoShiftFiner(_));
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
    assert_because!(&plan, Kind::Perspective, Reason::OverBudget(512));
    assert_eq!(plan.texels(), 1 << 18);
}

#[test]
fn flat_sheets_are_tested_by_virtual_samples_where_a_bias_would_show() {
    let sheet = Object { surface: Surface::FlatSheets, ..tower() };
    let plan = planned(&looking_ahead(), sun(), &[ground(50.0), sheet], &at_most(256));
    assert_because!(&plan, Kind::Perspective, Reason::BiasShows(_), Reason::TexelsShow(_));
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
    assert_because!(&plan, Kind::Perspective, Reason::SheetsCurve, Reason::TexelsShow(_));
    assert!(!plan.virtual_samples() && plan.passes().iter().all(|pass| pass.bias().is_some()));
}

#[test]
fn points_are_tested_with_a_bias() {
    let cloud = Object { surface: Surface::Points, ..tower() };
    let plan = planned(&looking_ahead(), sun(), &[ground(50.0), cloud], &at_most(1024));
    assert_because!(plan, Kind::Perspective, Reason::PointsCast);
}

#[test]
fn texels_no_larger_than_pixels_are_not_filtered_widely() {
    let budget = at_most(8192).with_filter(Filter::PercentageCloser(5));
    let plan = planned(&looking_down(), sun(), &[ground(3.0), thing([0.0; 3], [1.0; 3])], &budget);
    assert_because!(&plan, Kind::Uniform, Reason::TexelsBlend(_));
    assert_eq!(plan.filter(), Filter::Hardware);
}
