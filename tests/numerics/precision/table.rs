//! One view by hand: how far behind its caster a shadow begins on the ground, and how large a texel is there.

use shadowfit::glam::DVec3;
use shadowfit::{
    Aabb, DepthFormat, Light, Outcome, Scene, Settings, ShadowMap, View, Warp, fit,
    plan::{Budget, Object, Objects, Projection, plan},
};

/// A near plane and a distance from the origin.
const CASES: [(f64, f64); 9] = [
    (0.1, 0.0),
    (0.01, 0.0),
    (1e-4, 0.0),
    (1e-5, 0.0),
    (0.01, 1e3),
    (0.1, 1e4),
    (0.1, 35_400.0),
    (1e-5, 35_400.0),
    (0.1, 1e5),
];

fn view(near: f64, x: f64) -> View {
    View::perspective((x + 0.3, 4.0, 20.0), (0.2, -0.3, -1.0), DVec3::Y, 1.0, 1.6, near, 300.0)
        .expect("a legal view")
}

fn sun() -> Light {
    Light::directional((0.5, 0.8, 0.3)).expect("a direction")
}

/// How far behind its caster a shadow begins on the ground eleven metres ahead, and the longest side of a texel there.
fn measured(map: &ShadowMap, x: f64) -> [f64; 2] {
    let point = DVec3::new(x + 2.3, 0.0, 11.0);
    let bias = map.bias(DepthFormat::Unorm24, 1.0).expect("a legal reach");
    [map.bias_distance(point, DVec3::Y, &bias), map.footprint(point).expect("in the map").longest()]
}

fn fitted(near: f64, x: f64, warp: Warp) -> [f64; 2] {
    let scene = Scene::from_box((x - 60.0, -1.0, -60.0), (x + 60.0, 9.0, 60.0)).expect("a legal box");
    let outcome = fit(&view(near, x), &sun(), &scene, &Settings::default().with_warp(warp));
    measured(outcome.map().expect("one map does"), x)
}

/// The map of whoever asks for nothing has its shadows begin no farther behind their casters than the uniform map, at any near
/// plane and wherever in the world.
#[test]
fn shadows_begin_where_those_of_the_uniform_map_do() {
    println!("near, x: bias and texel of the default map, of light-space, of uniform");
    for (near, x) in CASES {
        let uniform = fitted(near, x, Warp::Uniform);
        let best = fitted(near, x, Warp::default());
        let light_space = fitted(near, x, Warp::LightSpace);
        println!("{near:7}, {x:6}: {best:.3?} {light_space:.3?} {uniform:.3?}");
        for [bias, _] in [best, light_space] {
            assert!(bias <= 1.25 * uniform[0], "near {near}, {x} m out: {bias} against {}", uniform[0]);
        }
        assert!(
            best[1] <= 1.6 * uniform[1],
            "near {near}, {x} m out: a texel of {} against {}",
            best[1],
            uniform[1]
        );
    }
}

/// The planner chooses no other.
#[test]
fn a_plan_is_no_worse() {
    for (near, x) in CASES {
        let corner = |x: f64, y: f64, z: f64| DVec3::new(x, y, z).as_vec3();
        let ground = Aabb::new(corner(x - 60.0, -1.0, -60.0), corner(x + 60.0, 0.0, 60.0));
        let tower = Aabb::new(corner(x, 0.0, -10.0), corner(x + 4.0, 9.0, -6.0));
        let objects = Objects::new(&[ground, tower].map(Object::new)).expect("legal boxes");
        let plan = plan(&view(near, x), &[sun()], &objects, &Budget::new(Settings::default()));
        let [pass] = plan.lights()[0].passes() else { panic!("one pass") };
        let Projection::Frustum(map) = pass.projection() else { panic!("one matrix") };
        let scene = Scene::from_box((x - 60.0, -1.0, -60.0), (x + 60.0, 9.0, 60.0)).expect("a legal box");
        let uniform = fit(plan.view(), &sun(), &scene, &map.settings().with_warp(Warp::Uniform));
        let Outcome::Map(uniform) = uniform else { panic!("one map does") };
        let (planned, uniform) = (measured(map, x), measured(&uniform, x));
        assert!(planned[0] <= 1.25 * uniform[0], "near {near}, {x} m out: {planned:?} against {uniform:?}");
    }
}
