//! What a plan must do: lose no caster, keep what is seen, warp to gain, keep to its texels, and see no more in less.

use rand::{Rng, RngExt as _};
use shadowfit::glam::{DVec3, Vec3};
use shadowfit::{
    Aabb, ClipSpace, Focus, Light, Scene, View, Warp,
    focus::Plane,
    omni::CubeFace,
    plan::{Budget, Kind, LightPlan, Object, Objects, Pass, Plan, Projection, Reason, plan},
};

use super::town::{LitTown, in_box};

fn planned(town: &LitTown, budget: &Budget) -> Plan {
    plan(&town.view, &town.lights, &Objects::new(&town.objects).expect("a sound town"), budget)
}

/// Asserts that what stands between something visible and a light is drawn, and is in the map before it; says how many
/// such casters there were, and what the lights were given.
pub fn loses_no_caster(rng: &mut impl Rng, town: &LitTown) -> (u64, Vec<Kind>) {
    let plan = planned(town, &town.budget);
    let checked = town.lights.iter().zip(plan.lights());
    let checked = checked
        .map(|(light, of_light)| check_casters(rng, &town.objects, &town.view, light, &plan, of_light))
        .sum();
    (checked, plan.lights().iter().map(LightPlan::kind).collect())
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
            map.clip_from_world_in(ClipSpace::WGPU).project_point3(point)
        }
        Projection::Paraboloid(paraboloid) => paraboloid.project(point).expect("not behind the pole"),
    }
}

/// Checks random casters of one light; returns how many there were.
fn check_casters(
    rng: &mut impl Rng,
    town: &[Object],
    view: &View,
    light: &Light,
    plan: &Plan,
    of_light: &LightPlan,
) -> u64 {
    let mut checked = 0;
    let is_inside = |planes: &[Plane], point| planes.iter().all(|plane| plane.at(point) >= 0.0);
    for _ in 0..100 {
        let receiver = &town[rng.random_range(0..town.len())];
        let seen = in_box(rng, &receiver.bounds);
        if !receiver.receives
            || !is_inside(view.planes().as_slice(), seen)
            || !is_inside(light.planes().as_slice(), seen)
        {
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
            if is_too_near || !is_inside(light.planes().as_slice(), caster) {
                continue;
            }
            for (id, object) in (0..).zip(town) {
                let Aabb { min, max } = object.bounds;
                let holds = caster.cmpge(min.as_dvec3()).all() && caster.cmple(max.as_dvec3()).all();
                if !object.casts || !holds {
                    continue;
                }
                checked += 1;
                let words = || format!("{light:?} at {seen}, behind {caster} of object {id}");
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

/// Asserts that all that receives in the view is in the plan's view.
pub fn keeps_every_receiver_in_view(rng: &mut impl Rng, town: &LitTown) {
    let plan = planned(town, &town.budget);
    for object in town.objects.iter().filter(|object| object.receives) {
        for _ in 0..50 {
            let point = in_box(rng, &object.bounds);
            if town.view.planes().iter().all(|plane| plane.at(point) >= 0.0) {
                assert!(plan.view().planes().iter().all(|plane| plane.at(point) >= 0.0), "{point} is out of view");
            }
        }
    }
}

/// Asserts that a warp is chosen only where its error at the surfaces in view is less than without one; says how many were.
pub fn warps_to_gain(town: &LitTown) -> u64 {
    let budget = &town.budget;
    let unwarped = Budget::new(budget.settings().with_warp(Warp::Uniform)).with_filter(budget.filter());
    let (free, uniform) = (planned(town, budget), planned(town, &unwarped));
    let boxes = |is: fn(&Object) -> bool| -> Vec<Aabb> {
        town.objects.iter().filter(|object| is(object)).map(|object| object.bounds).collect()
    };
    let (casters, receivers) = (boxes(|object| object.casts), boxes(|object| object.receives));
    let scene = Scene::new(&casters, &receivers).expect("legal boxes");
    let mut warped = 0;
    for ((light, free_light), uniform_light) in town.lights.iter().zip(free.lights()).zip(uniform.lights()) {
        if (free_light.kind(), uniform_light.kind()) == (Kind::Warped, Kind::Uniform) {
            warped += 1;
            let (pass, without) = (&free_light.passes()[0], &uniform_light.passes()[0]);
            let (size, uniform_size) = (pass.map_size(), without.map_size());
            assert!(size <= uniform_size, "{size} and {uniform_size} texels");
            let focus = Focus::new(free.view(), light, &scene);
            let error = |pass: &Pass| match pass.projection() {
                Projection::Frustum(map) => map.surface_error(&focus).map(|error| error.mean),
                _ => None,
            };
            if let Some((with, without)) = error(pass).zip(error(without)) {
                assert!(size < uniform_size || with < without, "{with} and {without}");
            }
        }
    }
    warped
}

/// Asserts that a plan has no more texels than it may, unless no map could be smaller.
pub fn keeps_to_its_texels(town: &LitTown) {
    let most = planned(town, &town.budget).texels() / 3;
    let within = planned(town, &town.budget.with_texels(most));
    let smallest = within.lights().iter().flat_map(LightPlan::passes).all(|pass| pass.map_size() <= 64);
    assert!(within.texels() <= most || smallest, "{} of {most}", within.texels());
}

/// Asserts that a part of the view's depth range has nothing in view that all of it has not: neither depths nor lit
/// receivers; says for how many lights there were none of these.
///
/// A box that only touches the view may be in it or not, by the rounding of either. So the whole view is planned with every
/// box grown by what is large beside any rounding.
///
/// That fewer casters are drawn is not claimed. A box is passed over where one plane of the focus body has it outside, and
/// the larger body may have such a plane, beside an edge of the smaller one, that the smaller one has not: both draw what
/// they need, and one of them a box more.
pub fn sees_no_more_in_less(rng: &mut impl Rng, town: &LitTown) -> u64 {
    let (near, far) = (town.view.near(), town.view.far());
    let reach = if far.is_finite() { far - near } else { 200.0 };
    let from = near + rng.random_range(0.0..0.9) * reach;
    let to = from + rng.random_range(0.05..1.0) * (near + reach - from);
    let Ok(view) = town.view.narrowed(from, to) else { return 0 };
    let extent =
        town.objects.iter().map(|object| object.bounds.min.abs().max(object.bounds.max.abs()).max_element());
    let growth = Vec3::splat(1e-5 * extent.fold(0.0, f32::max));
    let grown = |object: &Object| {
        let Aabb { min, max } = object.bounds;
        Object { bounds: Aabb::new(min - growth, max + growth), ..*object }
    };
    let grown: Vec<Object> = town.objects.iter().map(grown).collect();
    let all = plan(&town.view, &town.lights, &Objects::new(&grown).expect("a sound town"), &town.budget);
    let part = plan(&view, &town.lights, &Objects::new(&town.objects).expect("a sound town"), &town.budget);
    let mut dark = 0;
    for ((light, of_all), of_part) in town.lights.iter().zip(all.lights()).zip(part.lights()) {
        let sees = |plan: &LightPlan| !plan.reasons().contains(&Reason::NoReceivers);
        if !sees(of_all) {
            dark += 1;
            assert!(!sees(of_part), "{light:?} from {from} to {to} has {:?}", of_part.reasons());
        }
    }
    let range = |view: &View| (view.near(), view.far());
    let [of_all, of_part] = [&all, &part].map(|plan| range(plan.view()));
    // Where no receiver is in view there is nothing to narrow a view to, and it stays as it was.
    if of_part != range(&view) {
        assert!(of_all.0 <= of_part.0 && of_part.1 <= of_all.1, "from {from} to {to}: {of_all:?} and {of_part:?}");
    }
    dark
}
