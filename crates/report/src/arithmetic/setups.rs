//! What matrices are computed for: cameras, lights and boxes of numbers that f32 holds, so that nothing is lost before a
//! construction begins.

use rand::SeedableRng;
use rand::rngs::StdRng;
use shadowfit::glam::DVec3;
use shadowfit::{Focus, Origin, ShadowMap};

use testkit::outdoors::{self, Kind, TOWN};
use testkit::stability::lights::{in_f32, through_zero};
use testkit::stability::setup::{Camera, Lamp, Setup};

/// Set-ups, and how many were passed over: there is no one map of them, or it has a depth range without an end.
pub(crate) struct Setups {
    pub(crate) taken: Vec<Setup>,
    pub(crate) passed_over: usize,
}

impl Setups {
    fn of(setups: impl IntoIterator<Item = Setup>) -> Self {
        let (taken, passed_over): (Vec<_>, Vec<_>) = setups.into_iter().partition(has_map);
        Self { taken, passed_over: passed_over.len() }
    }
}

/// Somebody in a town, in turn with a sun and a lamp, so many in all.
pub(crate) fn random(count: usize) -> Setups {
    let mut random = StdRng::seed_from_u64(2);
    let mut setups = Vec::with_capacity(count);
    for kind in [Kind::Sun, Kind::Lamp].into_iter().cycle().take(count) {
        let (view, light) = (outdoors::view(&mut random), kind.light(&mut random));
        let at = in_f32_all(light.homogeneous().truncate());
        let camera = Camera {
            eye: in_f32_all(view.eye()),
            forward: in_f32_all(view.forward()),
            up: DVec3::Y,
            fov_y: 1.0,
            aspect: 1.5,
            near: in_f32(view.near()),
            far: in_f32(view.far()),
        };
        let lamp = if kind == Kind::Sun { Lamp::Sun(at) } else { Lamp::At(at) };
        let (min, max) = TOWN;
        setups.push(Setup { camera, lamp, min: min.into(), max: max.into(), origin: Origin::World });
    }
    Setups::of(setups)
}

/// Lights through the camera's plane, along the view, before the viewer and far away; narrow views, large and small scales and
/// places far out; no more than so many of them, evenly spread.
pub(crate) fn hard(most: usize) -> Setups {
    let mut setups = Vec::new();
    let sun = DVec3::new(in_f32(0.4), 0.75, in_f32(-0.3));
    for (_, value) in through_zero() {
        setups.push(Setup::outdoors(Lamp::Sun(DVec3::new(in_f32(0.6), in_f32(0.8), -value))));
        setups.push(Setup::outdoors(Lamp::At(DVec3::new(30.0, 40.0, -value))));
    }
    for k in 1..=16 {
        for towards in [1.0, -1.0] {
            setups.push(Setup::outdoors(Lamp::Sun(DVec3::new(0.0, in_f32(10_f64.powi(-k)), towards))));
        }
    }
    for k in 1..=6 {
        let mut setup = Setup::outdoors(Lamp::Sun(DVec3::new(in_f32(0.1), in_f32(0.2), -1.0)));
        setup.camera.near = 1.0 / 16.0;
        setup.camera.far = in_f32(setup.camera.near * 10_f64.powi(k));
        (setup.min, setup.max) = (DVec3::splat(-4.0 * setup.camera.far), DVec3::splat(4.0 * setup.camera.far));
        setups.push(setup);
    }
    for k in 10..=30 {
        let far = DVec3::new(in_f32(0.6), 0.75, -0.25) * 2_f64.powi(k);
        setups.push(Setup::outdoors(Lamp::At(far)));
    }
    for k in 0..=6 {
        let mut setup = Setup::outdoors(Lamp::Sun(sun));
        setup.camera.fov_y = in_f32(10_f64.powi(-k));
        setup.camera.forward = DVec3::new(0.25, -0.125, -1.0);
        (setup.min, setup.max) = (DVec3::splat(-64.0), DVec3::splat(64.0));
        setups.push(setup);
    }
    let places = [1e-6, 1e-3, 1e3, 1e6].map(|scale| (scale, 0.0));
    for (scale, offset) in places.into_iter().chain([1e3, 1e5, 1e7].map(|offset| (1.0, offset))) {
        let mut setup = Setup::outdoors(Lamp::Sun(sun));
        let moved = |p: DVec3| in_f32_all(p * scale + offset);
        setup.camera.eye = moved(DVec3::new(0.0, 8.0, 0.0));
        setup.camera.forward = DVec3::new(0.0, -0.25, -1.0);
        (setup.camera.near, setup.camera.far) = (in_f32(scale), in_f32(100.0 * scale));
        (setup.min, setup.max) = (moved(DVec3::new(-64.0, -0.5, -64.0)), moved(DVec3::new(64.0, 0.0, 64.0)));
        setups.push(setup);
    }
    let step = setups.len().div_ceil(most).max(1);
    Setups::of(setups.into_iter().step_by(step))
}

fn in_f32_all(v: DVec3) -> DVec3 {
    v.as_vec3().as_dvec3()
}

/// Whether there is one map, of which the depth range ends somewhere: exact numbers have no infinity.
fn has_map(setup: &Setup) -> bool {
    let focus = Focus::new(&setup.camera.view(), &setup.lamp.light(), &setup.scene());
    let outcome = focus.fit(&setup.settings());
    let is_finite = |map: &ShadowMap| {
        let depth = map.depth();
        depth.near.is_finite() && depth.far.is_finite()
    };
    outcome.map().is_some_and(is_finite)
}
