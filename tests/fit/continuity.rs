//! The matrix is a continuous function of every input: of each number of the view, the light and the scene.
//!
//! `SHADOWFIT_CASES=100000` in the environment tries that many set-ups and inputs instead of some thousands.

use glam::DVec3;
use proptest::prelude::*;
use shadowfit::{Focus, Light, Scene, Settings, ShadowMap, View};
use testkit::arbitrary::{FORMS, following, run};
use testkit::claims::rays::projected;

/// The numbers that a set-up is made of, by what they are.
#[rustfmt::skip]
const INPUTS: [&str; 27] = [
    "eye x", "eye y", "eye z", "forward x", "forward y", "forward z", "up x", "up y", "up z", "fov_y", "aspect",
    "near", "far", "light x", "light y", "light z", "axis x", "axis y", "axis z", "half_angle", "lamp near",
    "range", "scene min", "scene max", "scene bottom", "scene top", "scene front",
];

/// The largest coordinates.
const SIZE: f64 = 100.0;

/// What a light is.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Sun,
    Lamp,
    Spot,
    Hemisphere,
}

/// A camera about a scene, and a light about both.
#[derive(Clone, Debug)]
struct SetUp {
    kind: Kind,
    numbers: [f64; INPUTS.len()],
}

impl SetUp {
    fn strategy() -> impl Strategy<Value = Self> {
        let kind = prop_oneof![Just(Kind::Sun), Just(Kind::Lamp), Just(Kind::Spot), Just(Kind::Hemisphere)];
        let triple = |reach: f64| prop::array::uniform3(-reach..reach);
        let camera = (triple(20.0), triple(1.0), triple(0.3), 0.3..2.0, 0.5..2.0, 0.05..2.0, 20.0..500.0);
        let light = (triple(40.0), triple(1.0), 0.2..1.4, 0.01..0.5, 30.0..500.0);
        let scene = (5.0..SIZE, 5.0..SIZE, -20.0..0.0, 1.0..30.0, 5.0..SIZE);
        (kind, camera, light, scene).prop_map(|(kind, camera, light, scene)| {
            let (eye, forward, up, fov_y, aspect, near, far) = camera;
            let (place, axis, half_angle, light_near, range) = light;
            let (min, max, bottom, top, front) = scene;
            let vectors = [eye, forward, [up[0], 1.0, up[2]]].concat();
            let numbers = [
                &vectors[..],
                &[fov_y, aspect, near, far],
                &place,
                &axis,
                &[half_angle, light_near, range, min, max, bottom, top, front],
            ];
            Self { kind, numbers: numbers.concat().try_into().expect("as many as there are names") }
        })
    }

    /// None where the numbers are no set-up: a camera that looks straight up.
    fn parts(&self) -> Option<(View, Light, Scene<'static>)> {
        let n = &self.numbers;
        let vector = |first: usize| DVec3::new(n[first], n[first + 1], n[first + 2]);
        let view = View::perspective(vector(0), vector(3), vector(6), n[9], n[10], n[11], n[12]).ok()?;
        let (place, axis) = (vector(13), vector(16));
        let light = match self.kind {
            Kind::Sun => Light::directional(place),
            Kind::Lamp => Light::point(place, n[20], n[21]),
            Kind::Spot => Light::spot(place, axis, n[19], n[20], n[21]),
            Kind::Hemisphere => Light::hemisphere(place, axis, n[20], n[21]),
        };
        let scene = Scene::from_box((-n[22], n[24], -n[26]), (n[23], n[25], n[22]));
        Some((view, light.ok()?, scene.ok()?))
    }

    fn fit(&self, settings: &Settings) -> Option<ShadowMap> {
        let (view, light, scene) = self.parts()?;
        Focus::new(&view, &light, &scene).fit(settings).into_map()
    }

    /// The same with one number changed by a part of what its kind is large.
    fn changed(&self, input: usize, by: f64) -> Self {
        let mut changed = self.clone();
        let size = match INPUTS[input].split(' ').next() {
            Some("eye" | "scene") => SIZE,
            Some("light") if self.kind != Kind::Sun => SIZE,
            Some("near" | "far" | "lamp" | "range") => changed.numbers[input],
            _ => 1.0,
        };
        changed.numbers[input] += by * size;
        changed
    }
}

/// Asserts that the map of a set-up is a continuous function of one of its numbers.
fn check(set_up: &SetUp, settings: &Settings, input: usize) {
    let Some(middle) = set_up.fit(settings) else { return };
    let (view, light, scene) = set_up.parts().expect("it was fitted");
    let visible = Focus::new(&view, &light, &scene).receiver_volume();
    let reach = DVec3::splat(SIZE) + view.eye().abs() + light.position().unwrap_or(DVec3::ZERO).abs();
    let place = |map: &ShadowMap, point: DVec3| {
        let (place, slack, _) = projected(&map.clip_from_world(), point, reach);
        (place, slack.max_element())
    };
    // How far a change of one number by that part of it moves anything.
    let moved = |input: usize, by: f64| {
        let map = set_up.changed(input, by).fit(settings)?;
        let change = |&point: &DVec3| (place(&map, point).0 - place(&middle, point).0).abs().max_element();
        Some(visible.vertices().iter().map(change).fold(0.0, f64::max))
    };
    let steepest = |input: usize, exponents: std::ops::Range<i32>| {
        let slopes = exponents.flat_map(|k| [10_f64.powi(-k), -10_f64.powi(-k)]);
        slopes.filter_map(|by| Some(moved(input, by)? / by.abs())).fold(0.0, f64::max)
    };
    // What rounding does to a fit, a few roundings of all the numbers would do too.
    let slopes: f64 = (0..INPUTS.len()).map(|input| steepest(input, 5..7)).sum();
    let slack = visible.vertices().iter().map(|&point| place(&middle, point).1).fold(0.0, f64::max);
    let rounding = 64.0 * f64::EPSILON * slopes + 2.0 * slack;
    let steepest = steepest(input, 2..8);
    for k in 8..=16 {
        for by in [10_f64.powi(-k), -10_f64.powi(-k)] {
            let Some(change) = moved(input, by) else { continue };
            // Kinks, where another vertex begins to limit the warp, may double a slope and double it again.
            let allowed = 4.0 * steepest * by.abs() + rounding;
            assert!(change <= allowed, "{} by {by:e}: moves by {change:e}, not {allowed:e}", INPUTS[input]);
        }
    }
}

#[test]
fn the_matrix_is_continuous_in_every_input() {
    run(4000, &(SetUp::strategy(), following(), 0..INPUTS.len()), |(set_up, settings, input)| {
        check(&set_up, &settings, input);
    });
}

/// Many corners of what a wide spot lights are on the sides of its cone, equally far from its axis. Which of them the axis
/// was found by was a matter of rounding, and with it half of its digits.
#[test]
fn corners_that_are_equally_far_from_the_axis() {
    let numbers = [
        [15.730_640_491_396_425, 11.047_521_135_992_4, 0.0, 0.0, 0.0, -0.933_840_316_610_303, 0.0, 1.0, 0.0]
            .as_slice(),
        &[1.689_852_761_249_664_3, 0.935_681_698_152_141_6, 0.05, 475.198_912_731_417_86],
        &[0.0, 0.0, -21.587_315_777_690_46, 0.0, 0.289_004_278_030_164_04, -0.333_880_559_163_568_8],
        &[1.387_952_824_283_345_9, 0.01, 30.0, 5.0, 5.0, -17.815_554_196_464_575, 1.0, 92.421_791_159_626_78],
    ];
    let set_up = SetUp { kind: Kind::Spot, numbers: numbers.concat().try_into().expect("one for each input") };
    for warp in FORMS {
        for input in 0..INPUTS.len() {
            check(&set_up, &Settings::default().with_warp(warp), input);
        }
    }
}
