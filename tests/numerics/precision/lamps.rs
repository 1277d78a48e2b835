//! Lamps far from the origin.

use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use shadowfit::glam::{DVec3, Vec3};
use shadowfit::{
    Aabb, DepthFormat, Focus, Light, Origin, Scene, Settings, ShadowMap, View, Warp,
    omni::CubeFace,
    plan::{Budget, Object, Objects, plan},
};

/// How far from the origin, in metres.
const DISTANCES: [f64; 6] = [0.0, 1e2, 1e3, 1e4, 3e4, 1e5];

/// A cube's face of 512² of a lamp that reaches 20 m, and a wall 15 m away.
fn face(at: f64, origin: Origin) -> (ShadowMap, DVec3) {
    let lamp = DVec3::new(at, 3.0, 0.6 * at);
    let view = View::perspective(lamp + DVec3::new(2.0, 0.0, 25.0), DVec3::NEG_Z, DVec3::Y, 1.2, 1.6, 0.1, 100.0);
    let light = Light::point(lamp, 0.05, 20.0).and_then(|lamp| lamp.cube_face(CubeFace::NegativeZ, 0.0));
    let (view, light) = (view.expect("a legal view"), light.expect("a lamp has faces"));
    let scene = Scene::from_box(lamp - 30.0, lamp + 30.0).expect("a legal box");
    let settings = Settings::new(512, 1080).expect("legal sizes").with_warp(Warp::Uniform).with_origin(origin);
    let map = Focus::new(&view, &light, &scene).fit(&settings).into_map().expect("a map");
    (map, lamp + DVec3::new(2.0, 1.0, -15.0))
}

/// The longest side of a texel on the wall, and how far behind its caster a shadow begins there.
fn measured(at: f64, origin: Origin) -> [f64; 2] {
    let (map, wall) = face(at, origin);
    let bias = map.bias(DepthFormat::Unorm24, 1.0).expect("a legal reach");
    let texel = map.footprint(wall).expect("in the map").longest();
    [texel, map.bias_distance(wall, DVec3::Z, &bias)]
}

/// About the light texels and bias are the same everywhere; in world space texels are, as far as f32 tells places on the wall, and
/// what bias costs is told.
#[test]
fn a_lamps_map_is_the_same_wherever_it_stands() {
    let at_home = measured(0.0, Origin::Light);
    for origin in [Origin::World, Origin::Eye, Origin::Light] {
        for at in DISTANCES {
            let [texel, bias] = measured(at, origin);
            println!("{origin:?}, {at} m out: texel {texel:.4}, bias {bias:.4}");
            let most_texel = if origin == Origin::World && at > 1e4 { 1.25 } else { 1.05 };
            assert!(texel <= most_texel * at_home[0], "{origin:?}, {at} m out: {texel}");
            match origin {
                Origin::Light => assert!(bias <= 1.1 * at_home[1], "{at} m out: {bias}"),
                // A lamp 25 m from the eye is as one 25 m from the origin, wherever that is.
                Origin::Eye => assert!(bias <= 1.1 * measured(0.0, Origin::Eye)[1], "{at} m out: {bias}"),
                _ => assert!(bias >= at_home[1]),
            }
        }
    }
}

/// A thousand lamps of 10 to 25 m among ten thousand boxes of a square kilometre, near distance 5 cm, in world space: as many
/// texels as the plan's own rule asks for, and not for what f32 does beside lamps.
#[test]
fn a_thousand_lamps_ask_for_no_texels_for_the_air_beside_them() {
    const HALF: f32 = 500.0;
    let random = &mut StdRng::seed_from_u64(1);
    let ground = Aabb::new(Vec3::new(-HALF, -1.0, -HALF), Vec3::new(HALF, 0.0, HALF));
    let mut objects = vec![Object::new(ground)];
    objects.extend((1..10_000).map(|_| {
        let mut number = |low: f32, high: f32| random.random_range(low..high);
        let size = Vec3::new(number(1.0, 12.0), number(1.0, 20.0), number(1.0, 12.0));
        let min = Vec3::new(number(-HALF, HALF), 0.0, number(-HALF, HALF));
        Object::new(Aabb::new(min, min + size))
    }));
    let half = f64::from(HALF);
    let mut number = |low: f64, high: f64| random.random_range(low..high);
    let lights: Vec<Light> = (0..1000)
        .map(|_| {
            let position = DVec3::new(number(-half, half), number(2.0, 8.0), number(-half, half));
            Light::point(position, 0.05, number(10.0, 25.0)).expect("a legal light")
        })
        .collect();
    let view = View::perspective((0.0, 30.0, 0.0), (0.3, -0.1, -1.0), DVec3::Y, 1.0, 1.6, 0.1, 1000.0);
    let objects = Objects::new(&objects).expect("legal boxes");
    let budget = Budget::new(Settings::new(1024, 1080).expect("legal sizes"));
    let plan = plan(&view.expect("a legal view"), &lights, &objects, &budget);
    println!("{} million texels in {} passes", plan.texels() / 1_000_000, plan.passes());
    assert!(plan.texels() <= 170_000_000, "{}", plan.texels());
}
