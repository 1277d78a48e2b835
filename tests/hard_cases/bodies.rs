//! Rows 17 to 25: bodies where signs are hard to tell. `oracle` asserts over cases at random that nothing of the exact
//! bodies is lost and that little is gained; here each case has its name.

use shadowfit::glam::DVec3;
use shadowfit::{
    Empty, Focus, FocusForm, Light, Origin, Outcome, Scene, View,
    focus::{ConvexBody, Plane},
    input::ConvexScene,
};

use crate::place::{assert_holds, in_f32, is_inside, lamp, map, settings, sun, turned_view, view, wide};
use crate::sweep::{about, powers, steps};
use testkit::stability::arithmetic::Big;
use testkit::stability::bodies::{hull, vertices};
use testkit::stability::linear::{V4, homogeneous};
use testkit::stability::measure::Ours;
use testkit::stability::setup::{Lamp, Setup};

type Planes = Vec<V4<Big>>;

fn exact(planes: &[Plane]) -> Planes {
    planes.iter().map(|plane| homogeneous(plane.to_row())).collect()
}

fn of_box(min: DVec3, max: DVec3) -> Planes {
    let slab = |axis: usize| {
        let normal = DVec3::AXES[axis];
        [normal.extend(-min[axis]), (-normal).extend(max[axis])].map(homogeneous)
    };
    (0..3).flat_map(slab).collect()
}

/// R and H in the paper's form hold the exact ones. Returns R.
fn assert_nothing_is_lost(
    view: &View,
    light: &Light,
    scene: &Scene<'_>,
    of_scene: &Planes,
    what: &str,
) -> ConvexBody {
    let focus = Focus::new(view, light, scene);
    let lit = [of_scene.clone(), exact(light.planes().as_slice())].concat();
    let of_view = exact(view.planes().as_slice());
    let visible = focus.receiver_volume();
    assert_holds(&visible, &vertices(&[lit.clone(), of_view.clone()].concat()), &what);
    let hull = hull(&of_view, &homogeneous(light.homogeneous()));
    assert_holds(&focus.caster_volume(FocusForm::ViewHull), &vertices(&[lit, hull].concat()), &what);
    visible
}

fn assert_box_is_kept(view: &View, light: &Light, min: DVec3, max: DVec3, what: &str) -> ConvexBody {
    let scene = Scene::from_box(min, max).expect("sound");
    assert_nothing_is_lost(view, light, &scene, &of_box(min, max), what)
}

/// Nothing in view, nothing lit: `Empty`, and no body. Where it is a matter of roundings, empty or a map.
#[test]
fn row_17_nothing_to_be_seen() {
    let view = view();
    let light = sun(DVec3::new(0.3, 1.0, 0.2));
    let fit = |light: &Light, z: f64| {
        let scene = Scene::from_box((-5.0, -5.0, z), (5.0, 5.0, 20.0)).expect("sound");
        let focus = Focus::new(&view, light, &scene);
        (focus.receiver_volume(), focus.caster_volume(FocusForm::ReceiverHull), focus.fit(&settings()))
    };
    // The scene ends before the near plane, at it, and beyond.
    for by in about(0.0).map(|by| -1.0 + by).chain(steps(-1.0)) {
        let (visible, body, outcome) = fit(&light, by);
        match outcome {
            Outcome::Empty(why) => {
                assert!(by > -1.0, "{by:e} in view");
                assert_eq!(why, Empty::NoReceivers);
                assert!(visible.is_empty() && body.is_empty() && visible.bounds().is_none());
            }
            Outcome::Map(map) => {
                // In doubt bodies grow: by 96 ε of terms of 20 (`Plane::loosened`).
                assert!(by <= -1.0 + 96.0 * f64::EPSILON * 40.0, "{by:e} out of view");
                assert!(map.caster_matrix().is_finite());
            }
            other @ Outcome::Surrounded(_) => panic!("{other:?}"),
        }
    }
    // A cone that points out of the scene, beyond its side, at it, and with a tip of its light before it.
    for by in about(0.0) {
        let begins = 0.125 * 0.2_f64.cos();
        let spot = Light::spot((5.0 - begins + by, 0.0, -10.0), DVec3::X, 0.2, 0.125, 100.0).expect("sound");
        let (visible, _, outcome) = fit(&spot, -50.0);
        // Closer than that, roundings decide.
        if by.abs() > 96.0 * f64::EPSILON * 100.0 {
            assert_eq!(visible.is_empty(), by > 0.0, "{by:e}");
        }
        if visible.is_empty() {
            assert!(matches!(outcome, Outcome::Empty(Empty::NoReceivers)), "{by:e}: {outcome:?}");
        } else if let Outcome::Map(map) = outcome {
            assert!(map.caster_matrix().is_finite(), "{by:e}");
        }
    }
}

/// A plate, a rod and a point as scenes, and boxes that shrink to them: a legal fit, its padding stated.
#[test]
fn row_18_scenes_without_extent() {
    let view = turned_view();
    let middle = view.eye() + view.forward() * 20.0;
    for size in powers().filter(|size| *size > 0.0).chain([0.0, f64::MIN_POSITIVE]) {
        for half in [
            DVec3::new(5.0, size, 5.0),
            DVec3::new(5.0, size, size),
            DVec3::new(size, 5.0, size),
            DVec3::splat(size),
        ] {
            let (min, max) = (middle - half, middle + half);
            for light in [sun(DVec3::new(0.3, 1.0, 0.2)), sun(DVec3::Y), lamp(middle + DVec3::new(3.0, 30.0, 1.0))]
            {
                let visible = assert_box_is_kept(&view, &light, min, max, &format!("{half}"));
                let scene = Scene::from_box(min, max).expect("sound");
                let map = map(&view, &light, &scene, &settings());
                assert!(map.window().width > 0.0 && map.window().height > 0.0, "{half}: {:?}", map.window());
                let (x, y) = map.window().padding;
                assert!(x > 0.0 && x <= 1.0 && y > 0.0 && y <= 1.0, "{half}: {x} {y}");
                if size == 0.0 && half.max_element() == 0.0 {
                    assert!(x > 1.0 - 1e-6 && y > 1.0 - 1e-6, "a point needs nothing: all is padding");
                }
                assert!(map.depth().near < map.depth().far);
                for &p in visible.vertices() {
                    assert!(is_inside(in_f32(&map, p)), "{half}, {light:?}: {p}");
                }
            }
        }
    }
}

/// A ground edge-on to the light, and nearly so from either side.
#[test]
fn row_19_ground_edge_on_to_the_light() {
    let view =
        View::perspective((0.0, 8.0, 0.0), (0.0, -0.25, -1.0), DVec3::Y, 1.0, 1.5, 1.0, 100.0).expect("sound");
    let (min, max) = (DVec3::new(-64.0, 0.0, -64.0), DVec3::new(64.0, 0.0, 64.0));
    let scene = Scene::from_box(min, max).expect("sound");
    for by in about(0.0) {
        for light in
            [sun(DVec3::new(1.0, by, 0.0)), sun(DVec3::new(0.6, by, -0.8)), lamp(DVec3::new(200.0, by, -20.0))]
        {
            let visible = assert_box_is_kept(&view, &light, min, max, &format!("{light:?}"));
            let map = map(&view, &light, &scene, &settings());
            assert!(map.window().width > 0.0 && map.window().height > 0.0, "{by:e}: {:?}", map.window());
            for &p in visible.vertices() {
                assert!(is_inside(in_f32(&map, p)), "{by:e}: {p}");
            }
        }
    }
}

/// Boxes that touch V from outside and from inside, planes through a common vertex and edge: never less than the exact body,
/// to the last step.
#[test]
fn row_20_vertices_on_planes() {
    // Slopes of one: planes through lattice points.
    let view = View::perspective(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, std::f64::consts::FRAC_PI_2, 1.0, 1.0, 8.0)
        .expect("sound");
    for light in [
        sun(DVec3::Y),
        sun(DVec3::new(1.0, 1.0, 0.0)),
        sun(DVec3::new(0.0, 0.0, 1.0)),
        lamp(DVec3::new(4.0, 4.0, -4.0)),
    ] {
        for z in steps(-1.0).chain(steps(-8.0)).chain([-4.0]) {
            for x in steps(4.0).step_by(2) {
                // Touching from within, and from beyond the edge between a side and the near or the far plane.
                for (min, max) in [
                    (DVec3::new(-x, -x, z), DVec3::new(x, x, 0.0)),
                    (DVec3::new(-x, -x, -9.0), DVec3::new(x, x, z)),
                    (DVec3::new(x, -1.0, -4.0), DVec3::new(9.0, 1.0, z.max(-4.0))),
                    (DVec3::new(x, x, -4.0), DVec3::new(9.0, 9.0, -4.0)),
                ] {
                    assert_box_is_kept(&view, &light, min, max, &format!("{light:?}, {min} {max}"));
                }
            }
        }
    }
    // Four cuts of a box through one of its vertices, and through one of its edges, moved by steps.
    let light = sun(DVec3::new(0.3, 1.0, 0.2));
    for by in steps(0.0).chain(steps(4.0).map(|x| x - 4.0)).chain(powers()) {
        let corner = DVec3::new(2.0, 2.0, -2.0);
        let normals = [
            DVec3::new(-1.0, -1.0, 0.0),
            DVec3::new(-1.0, 0.0, 1.0),
            DVec3::new(0.0, -1.0, 1.0),
            DVec3::new(-1.0, -1.0, 1.0),
        ];
        let cuts = normals.map(|normal| Plane::through(normal, corner + DVec3::X * by));
        let (min, max) = (DVec3::new(-2.0, -2.0, -6.0), DVec3::new(2.0, 2.0, -2.0));
        let convex = ConvexScene::new(min, max, &cuts).expect("sound");
        let scene = Scene::from_convex(&convex);
        let planes = [of_box(min, max), exact(&cuts)].concat();
        assert_nothing_is_lost(&view, &light, &scene, &planes, &format!("{by:e}"));
    }
}

/// Narrow views and thin slabs between all but parallel planes: outwards.
#[test]
fn row_21_nearly_parallel_planes() {
    let (min, max) = (DVec3::splat(-64.0), DVec3::splat(64.0));
    for size in powers().filter(|size| *size > 1e-9 && *size < 0.05) {
        for light in [sun(DVec3::new(0.3, 1.0, 0.2)), lamp(DVec3::new(30.0, 40.0, 10.0))] {
            let view = View::perspective((3.0, -2.0, 7.0), (0.48, -0.6, 0.64), DVec3::Y, size, 1.6, 0.5, 200.0)
                .expect("sound");
            assert_box_is_kept(&view, &light, min, max, &format!("field of view {size:e}"));
            // A slab whose sides are turned against each other by that much: a wedge that ends within the scene or not.
            let view = turned_view();
            let cuts =
                [Plane::new(DVec3::new(size, 1.0, 0.0), 1.0), Plane::new(DVec3::new(0.0, -1.0, size), 1.0 + size)];
            let convex = ConvexScene::new(min, max, &cuts).expect("sound");
            let planes = [of_box(min, max), exact(&cuts)].concat();
            assert_nothing_is_lost(
                &view,
                &light,
                &Scene::from_convex(&convex),
                &planes,
                &format!("wedge {size:e}"),
            );
        }
    }
}

/// A bar through the frustum: neither has a vertex inside of the other.
#[test]
fn row_22_box_and_frustum_that_cross() {
    let view = View::perspective(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 1.0, 1.0, 1.0, 100.0).expect("sound");
    let light = sun(DVec3::new(0.3, 1.0, 0.2));
    let slope = view.half_height(1.0);
    for half in [1e-9, 1e-3, 1.0, 5.0] {
        let (min, max) = (DVec3::new(-200.0, -half, -20.0 - half), DVec3::new(200.0, half, -20.0 + half));
        let visible = assert_box_is_kept(&view, &light, min, max, &format!("{half}"));
        for corner in view.corners().expect("finite") {
            assert!(corner.cmplt(min).any() || corner.cmpgt(max).any(), "a corner of V in the bar");
        }
        assert_eq!(visible.vertices().len(), 8);
        // A prism with ends along the frustum's sides: the mean width times the height and the depth.
        let expected = 2.0 * slope * 20.0 * (2.0 * half) * (2.0 * half);
        let rounding = 96.0 * f64::EPSILON * 200.0 * (2.0 * slope * 20.0) * 8.0 * (half + 1e-12);
        assert!((visible.volume() - expected).abs() <= rounding + 1e-12 * expected, "{half}: {}", visible.volume());
    }
}

/// One inside of the other, and both the same: eight corners, six faces, no vertex twice.
#[test]
fn row_23_one_inside_the_other_and_equal_ones() {
    let light = sun(DVec3::new(0.3, 1.0, 0.2));
    let frustum = view();
    let cube = View::orthographic(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 2.0, 1.0, -2.0, 2.0).expect("sound");
    let corners = |view: &View| view.corners().expect("finite");
    let of = |min: f64, max: f64| (DVec3::splat(min), DVec3::splat(max));
    // Planes stand 96 ε of terms of three times 400 outwards, and meet at more than half of a right angle.
    let beyond = 2.0 * 96.0 * f64::EPSILON * 1200.0;
    for (view, (min, max), volume) in [
        // The frustum inside the box: a pyramid's frustum between 1 and 100.
        (&frustum, of(-400.0, 400.0), 4.0 * 1.5 * frustum.half_height(1.0).powi(2) * (1e6 - 1.0) / 3.0),
        (&cube, of(-400.0, 400.0), 64.0),
        // The box inside the frustum.
        (&cube, of(-1.0, 1.0), 8.0),
        (&frustum, (DVec3::new(-0.5, -0.5, -12.0), DVec3::new(0.5, 0.5, -11.0)), 1.0),
        // Both the same.
        (&cube, of(-2.0, 2.0), 64.0),
    ] {
        let visible = assert_box_is_kept(view, &light, min, max, &format!("{min} {max}"));
        assert_eq!(
            (visible.vertices().len(), visible.faces().count(), visible.edges().count()),
            (8, 6, 12),
            "{min} {max}"
        );
        assert!((visible.volume() - volume).abs() <= 1e-9 * volume, "{}", visible.volume());
        let expected = [corners(view).to_vec(), (0..8).map(|i| corner(min, max, i)).collect()].concat();
        for vertex in visible.vertices() {
            assert!(expected.iter().any(|p| p.distance(*vertex) <= beyond), "{vertex} is new");
        }
    }
    // Equal but for steps.
    for side in steps(2.0) {
        assert_box_is_kept(&cube, &light, DVec3::splat(-side), DVec3::splat(side), &format!("{side:e}"));
    }
}

fn corner(min: DVec3, max: DVec3, index: u32) -> DVec3 {
    DVec3::new(
        if index & 1 == 0 { min.x } else { max.x },
        if index & 2 == 0 { min.y } else { max.y },
        if index & 4 == 0 { min.z } else { max.z },
    )
}

/// A hundredth, a thousandth and a million times the usual size: the same body, scaled; by powers of two to the last bit.
/// (`properties::scaling_by_a_power_of_two_changes_no_bit`.)
#[test]
fn row_24_scenes_of_every_scale() {
    let body = |scale: f64, form: Option<FocusForm>| {
        let eye = DVec3::new(3.0, 8.0, 7.0) * scale;
        let view = View::perspective(eye, (0.48, -0.6, 0.64), DVec3::Y, 1.1, 1.6, 0.5 * scale, 200.0 * scale)
            .expect("sound");
        let light =
            Light::point(DVec3::new(10.0, 40.0, 30.0) * scale, 0.125 * scale, f64::INFINITY).expect("sound");
        let scene = Scene::from_box(DVec3::new(-64.0, 0.0, -64.0) * scale, DVec3::new(64.0, 20.0, 64.0) * scale)
            .expect("sound");
        let focus = Focus::new(&view, &light, &scene);
        assert!(focus.fit(&settings()).map().expect("one map does").caster_matrix().is_finite());
        form.map_or_else(|| focus.receiver_volume(), |form| focus.caster_volume(form))
    };
    for form in [None, Some(FocusForm::ViewHull), Some(FocusForm::ReceiverHull)] {
        let usual = body(1.0, form);
        for exponent in (-24..=24).step_by(4) {
            let scale = 2_f64.powi(exponent);
            let expected: Vec<_> = usual.vertices().iter().map(|vertex| vertex * scale).collect();
            assert_eq!(body(scale, form).vertices(), expected);
        }
        for scale in [1e-6, 1e-3, 1e-2, 1e3, 1e6] {
            let scaled = body(scale, form);
            let shape = |body: &ConvexBody| (body.vertices().len(), body.faces().count(), body.edges().count());
            assert_eq!(shape(&scaled), shape(&usual), "{scale:e}");
            for (vertex, expected) in scaled.vertices().iter().zip(usual.vertices()) {
                // Vertices where planes meet at a tenth move ten times as far as the planes, 96 ε of terms of 300.
                let allowed = 2.0 * 96.0 * f64::EPSILON * 300.0 * 10.0;
                assert!((*vertex / scale - *expected).length() <= allowed, "{scale:e}: {vertex} {expected}");
            }
        }
    }
}

/// Everything 10⁷ from the origin, and on the way there: nothing lost, and the matrix about the eye as good as at home.
/// (`conventions::far_away_positions_relative_to_the_eye_keep_their_texel`.)
#[test]
fn row_25_everything_far_from_the_origin() {
    for k in 0..=8 {
        let offset = DVec3::new(1.0, -1.0, 1.0) * f64::from(10_f32.powi(k));
        let mut setup = Setup::outdoors(Lamp::Sun(DVec3::new(0.4, 0.75, -0.3).as_vec3().as_dvec3()));
        setup.camera.eye += offset;
        setup.camera.forward = DVec3::new(0.25, -0.125, -1.0);
        (setup.min, setup.max) = (setup.min + offset, setup.max + offset);
        setup.origin = Origin::Eye;
        let light = setup.lamp.light();
        assert_box_is_kept(&setup.camera.view(), &light, setup.min, setup.max, &format!("1e{k}"));
        let Ours { errors: ours, bounds } = Ours::new(&setup);
        assert!(ours[1].most <= bounds[1], "1e{k}: {:e}, {:e}", ours[1].most, bounds[1]);
        // Four roundings of f32 of the clip volume, and those of f64 coordinates so large, in a window of a hundred.
        let allowed = 4.0 / 16_777_216.0 + 64.0 * f64::EPSILON * 10_f64.powi(k) / 100.0;
        assert!(ours[1].most <= allowed, "1e{k}: {:e}", ours[1].most);
        assert_eq!((ours[1].wrapped, ours[1].disorder), (0, 0));
    }
    // And in f32 positions: wide scenes are in their maps, about the eye.
    let map = map(&view(), &sun(DVec3::Y), &wide(), &settings().with_origin(Origin::Eye));
    assert!(map.caster_matrix().is_finite());
}
