//! Rows 9 to 14: casters about the camera plane, and lamps among what they light.

use shadowfit::glam::{DVec3, DVec4};
use shadowfit::{
    Focus, Light, Outcome, Scene, View,
    omni::{CubeFace, Paraboloids},
};

use crate::place::{assert_order, in_f32, is_inside, lamp, map, place, settings, slack, sun, view, visible, wide};
use crate::sweep::{about, powers, steps};

/// A caster whose depth before the eye goes through zero is somewhere, and moves in proportion.
#[test]
fn row_09_caster_on_the_camera_plane() {
    let (view, scene) = (view(), wide());
    for light in [sun(DVec3::new(0.1, 1.0, 1.0)), lamp(DVec3::new(1.0, 30.0, 25.0))] {
        let map = map(&view, &light, &scene, &settings());
        let at = |depth: f64| place(&map, DVec3::new(0.5, 3.0, -depth));
        let middle = at(0.0);
        assert!(middle.is_finite());
        let per_unit = (at(0.1) - middle).abs().max_element() / 0.1;
        let rounding = 2.0 * slack(&map, DVec3::new(0.5, 3.0, 0.0), 400.0);
        for depth in about(0.0) {
            let change = (at(depth) - middle).abs().max_element();
            assert!(change <= 2.0 * per_unit * depth.abs() + rounding, "{light:?}, {depth:e}: {change:e}");
        }
    }
}

/// A caster behind the eye is in the map, at its receiver's place and before it, in f32 too.
#[test]
fn row_10_caster_behind_the_eye() {
    let (view, scene) = (view(), wide());
    for light in
        [sun(DVec3::new(0.0, 1.0, 1.0)), sun(DVec3::new(0.2, 0.1, 1.0)), lamp(DVec3::new(10.0, 80.0, 300.0))]
    {
        let l = light.homogeneous();
        let map = map(&view, &light, &scene, &settings());
        for receiver in visible(&view, &light, &scene) {
            let towards = l.truncate() - receiver * l.w;
            // Where the ray comes out of the scene, or nearly so.
            let reach = (0..3).map(|i| (400.0 - towards[i].signum() * receiver[i]) / towards[i].abs());
            let reach = reach.fold(if l.w > 0.0 { 0.99 } else { f64::INFINITY }, f64::min);
            // Where the camera plane is crossed, a little of it, and all the way.
            let plane = -view.depth(receiver) / view.forward().dot(towards);
            for part in [plane, plane + 1e-12, plane + 1e-6, 0.5 * (plane + reach), reach] {
                let caster = receiver + towards * part;
                assert!(part <= reach && view.depth(caster) <= 1e-9);
                let (ours, theirs) = (place(&map, caster), place(&map, receiver));
                let slack = slack(&map, caster, 400.0) + slack(&map, receiver, 400.0);
                assert!((ours - theirs).truncate().abs().max_element() <= slack, "{ours} {theirs}, {slack:e}");
                assert!(ours.z < theirs.z);
                assert!(is_inside(in_f32(&map, caster)), "{caster} is at {ours}");
            }
        }
    }
}

/// the camera's own depth.
#[test]
fn row_11_plane_c_grazes_what_is_visible() {
    let scene = wide();
    for (near, far) in [(1.0, 100.0), (1e-3, 100.0), (1e-6, 300.0)] {
        let view = View::perspective(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 1.0, 1.5, near, far).expect("sound");
        // Lights from the middle of the image to beside it: somewhere on the way c = 0 passes each corner of R.
        for step in 0..=400 {
            let light = sun(DVec3::new(0.0, f64::from(step) / 200.0, -1.0));
            let map = map(&view, &light, &scene, &settings());
            let w = map.clip_from_world().row(3);
            let points = visible(&view, &light, &scene);
            let ws = points.iter().map(|p| w.dot(p.extend(1.0)));
            let (least, most) = ws.fold((f64::INFINITY, 0.0_f64), |(a, b), w| (a.min(w), b.max(w)));
            assert!(least > 0.0);
            let depth_ratio = (far / near).min(1e6);
            // The roundings of w where it is least, as large as those of 1 where it is largest.
            let slack = 1.0 + 64.0 * f64::EPSILON * 400.0 * most / least;
            assert!(map.warp_ratio() <= depth_ratio * slack, "{step}: {}", map.warp_ratio());
            assert!((most / least / map.warp_ratio() - 1.0).abs() <= slack - 1.0, "the report says what it is");
        }
    }
}

/// A lamp in R, on its boundary, a few steps beside it: a map, or the answer that says what serves instead, which does.
#[test]
fn row_12_lamp_inside_what_is_visible() {
    let view = view();
    let scene = Scene::from_box((-30.0, -20.0, -90.0), (30.0, 20.0, 10.0)).expect("sound");
    let surrounded = |position: DVec3| {
        let light = lamp(position);
        match Focus::new(&view, &light, &scene).fit(&settings()) {
            Outcome::Surrounded(why) => {
                let text = why.to_string();
                assert!(text.contains("cube") && text.contains("paraboloid"), "{text}");
                true
            }
            Outcome::Map(map) => {
                assert!(map.caster_matrix().is_finite());
                false
            }
            Outcome::Empty(why) => panic!("{why}"),
        }
    };
    assert!(surrounded(DVec3::new(0.0, 0.0, -30.0)));
    // Below the ceiling of S in view, at it, and above.
    for by in powers() {
        let is_inside = surrounded(DVec3::new(0.0, 20.0 + by, -60.0));
        assert!(is_inside || by > -1e-12, "{by:e} inside");
        assert!(!is_inside || by < 20.0 / 512.0, "{by:e} outside is nearer than 89.9° of opening");
    }
    // On a face, an edge and a corner of R, to the last bit.
    for z in steps(-60.0).chain(steps(-90.0)) {
        for y in steps(20.0) {
            surrounded(DVec3::new(0.0, y, z));
            surrounded(DVec3::new(30.0, y, z));
        }
    }
    // What serves.
    let light = lamp(DVec3::new(0.0, 0.0, -30.0));
    let Paraboloids::Two(_) = Focus::new(&view, &light, &scene).paraboloids(&settings()) else {
        panic!("a lamp among what is visible has two paraboloids");
    };
    for face in CubeFace::ALL {
        let face = light.cube_face(face, 0.0).expect("a lamp that shines all around");
        let outcome = Focus::new(&view, &face, &scene).fit(&settings());
        assert!(!matches!(outcome, Outcome::Surrounded(_)));
    }
}

/// A lamp in S and outside of R: depth begins where the lamp does, however near that is.
#[test]
fn row_13_lamp_inside_the_scene() {
    let (view, scene) = (view(), wide());
    let position = DVec3::new(0.0, 80.0, -50.0);
    for k in 0..=12 {
        let near = 10_f64.powi(-k);
        let light = Light::point(position, near, f64::INFINITY).expect("sound");
        let map = map(&view, &light, &scene, &settings());
        assert!(map.depth().near > 0.0 && map.depth().near < map.depth().far, "{near:e}: {:?}", map.depth());
        for receiver in visible(&view, &light, &scene) {
            let behind = place(&map, receiver);
            let arm = position - receiver;
            let caster = position - arm * (near / arm.length());
            let before = place(&map, caster);
            assert!(before.is_finite() && before.z < behind.z && behind.z <= 1.0, "{near:e}: {before} {behind}");
            // A place so near to the lamp rounds as coarsely as the lamp's own.
            let slack = slack(&map, caster, 400.0);
            assert!(before.z >= -slack, "{near:e}: {before}, {slack:e}");
        }
    }
}

/// side, whose order is the reverse.
#[test]
fn row_14_light_given_as_minus_l() {
    let (view, scene) = (view(), wide());
    let direction = DVec3::new(0.3, 0.8, -0.2);
    let unit = sun(direction);
    for exponent in [-900, -60, -1, 1, 60, 900] {
        assert_eq!(sun(direction * 2_f64.powi(exponent)), unit);
    }
    for light in [unit, sun(-direction), lamp(DVec3::new(3.0, 30.0, -2.0)), lamp(DVec3::new(-3.0, -30.0, 2.0))] {
        let DVec4 { w, .. } = light.homogeneous();
        assert!(w.to_bits() == 0.0_f64.to_bits() || w == 1.0);
        let map = map(&view, &light, &scene, &settings());
        assert_order(&map, &light, &visible(&view, &light, &scene));
    }
    let [there, opposite] = [unit, sun(-direction)].map(|light| map(&view, &light, &scene, &settings()));
    let (a, b) = (DVec3::new(0.0, 0.0, -20.0), DVec3::new(0.0, 0.0, -20.0) + direction);
    assert!(place(&there, b).z < place(&there, a).z && place(&opposite, b).z > place(&opposite, a).z);
}
