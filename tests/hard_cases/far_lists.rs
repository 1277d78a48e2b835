//! Lists of boxes far from the origin: in double precision, rounded outwards, and relative to a point of their own.

use crate::place::{in_f32, is_inside};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use shadowfit::glam::{DVec3, Vec3};
use shadowfit::{Aabb, Focus, Light, Origin, Outcome, Scene, Settings, View, input::DAabb};

/// Where single precision has steps of half a unit.
const FAR: DVec3 = DVec3::new(6e6, 0.0, -6e6);

fn view() -> View {
    View::perspective(FAR + DVec3::new(0.0, 2.0, 9.0), (0.0, -0.2, -1.0), (0.0, 1.0, 0.0), 1.0, 1.5, 0.1, 60.0)
        .expect("sound")
}

/// Small boxes about the origin.
fn boxes() -> Vec<DAabb> {
    let mut rng = StdRng::seed_from_u64(11);
    let mut place =
        move || DVec3::new(rng.random_range(-8.0..8.0), rng.random_range(0.0..3.0), rng.random_range(-8.0..4.0));
    let small =
        (0..200).map(|_| (place(), place().abs() * 0.05)).map(|(at, half)| DAabb::new(at - half, at + half));
    // Of this one the nearest numbers of single precision are all inside.
    small.chain([DAabb::new([-9.2, 0.0, -9.2], [9.2, 3.2, 5.2])]).collect()
}

/// Of the corners that are in view, how many there are, and how many are not in the map of a scene.
fn lost(scene: &Scene<'_>) -> (usize, usize) {
    let light = Light::directional((0.3, 1.0, 0.2)).expect("sound");
    let settings = Settings::default().with_origin(Origin::Eye);
    let Outcome::Map(map) = Focus::new(&view(), &light, scene).fit(&settings) else { panic!("no map") };
    let (mut seen, mut lost) = (0, 0);
    for one in boxes() {
        for corner in 0..8 {
            let side = DVec3::new(f64::from(corner & 1), f64::from(corner >> 1 & 1), f64::from(corner >> 2));
            let point = FAR + one.min + (one.max - one.min) * side;
            if view().planes().iter().all(|plane| plane.at(point) >= 0.0) {
                seen += 1;
                lost += usize::from(!is_inside(in_f32(&map, point)));
            }
        }
    }
    (seen, lost)
}

#[test]
fn nothing_is_lost_of_boxes_far_out() {
    let near = boxes();
    let far: Vec<DAabb> = near.iter().map(|one| DAabb::new(one.min + FAR, one.max + FAR)).collect();
    let outwards: Vec<Aabb> = far.iter().map(|one| Aabb::from(*one)).collect();
    let single: Vec<Aabb> = near.iter().map(|one| Aabb::from(*one)).collect();
    let to_nearest: Vec<Aabb> =
        far.iter().map(|one| Aabb { min: one.min.as_vec3(), max: one.max.as_vec3() }).collect();

    let scenes = [
        Scene::new(&far, &far),
        Scene::new(&outwards, &outwards),
        Scene::relative_to(FAR, &near, &near),
        Scene::relative_to(FAR, &single, &single),
    ];
    for scene in scenes {
        let (seen, lost) = lost(&scene.expect("sound"));
        assert!(seen > 200, "{seen}");
        assert_eq!(lost, 0, "of {seen}");
    }
    // What the doors are for.
    let (_, lost) = lost(&Scene::new(&to_nearest, &to_nearest).expect("sound"));
    assert!(lost > 0);
}

/// Boxes of their own origin and boxes in double precision are the same scene, but for a rounding.
#[test]
fn both_doors_make_the_same_map() {
    let near = boxes();
    let far: Vec<DAabb> = near.iter().map(|one| DAabb::new(one.min + FAR, one.max + FAR)).collect();
    let light = Light::point(FAR + DVec3::new(0.0, 9.0, 0.0), 0.1, 60.0).expect("sound");
    let scenes = [Scene::new(&far, &far), Scene::relative_to(FAR, &near, &near)];
    let [one, other] =
        scenes.map(|scene| match Focus::new(&view(), &light, &scene.expect("sound")).fit(&Settings::default()) {
            Outcome::Map(map) => *map.window(),
            none => panic!("{none:?}"),
        });
    assert!((one.width / other.width - 1.0).abs() < 1e-6 && (one.height / other.height - 1.0).abs() < 1e-6);
}

#[test]
fn rounding_is_outwards_by_no_more_than_a_step() {
    let mut rng = StdRng::seed_from_u64(12);
    for _ in 0..10_000 {
        let scale = 10_f64.powi(rng.random_range(-6..9));
        let min = DVec3::from([(); 3].map(|()| rng.random_range(-1.0..1.0))) * scale;
        let max = min + DVec3::from([(); 3].map(|()| rng.random_range(0.0..1.0))) * scale;
        let one = Aabb::new(min, max);
        assert!(one.min.as_dvec3().cmple(min).all() && one.max.as_dvec3().cmpge(max).all());
        let inner = [one.min.map(f32::next_up), one.max.map(f32::next_down)].map(Vec3::as_dvec3);
        assert!(inner[0].cmpgt(min).all() && inner[1].cmplt(max).all());
        // What single precision has already stays.
        let again = Aabb::new(one.min, one.max.as_dvec3());
        assert_eq!(again, one);
    }
    let origin = Scene::relative_to([f64::NAN, 0.0, 0.0], &[Aabb::EMPTY], &[]).expect_err("not a number");
    assert_eq!(origin.to_string(), "origin.x is NaN");
    let moved = Scene::relative_to([1e12, 0.0, 0.0], &[Aabb::new([0.0; 3], [5e11; 3])], &[]).expect_err("too far");
    assert_eq!((moved.field, moved.component), ("casters", Some("max.x")));
}
