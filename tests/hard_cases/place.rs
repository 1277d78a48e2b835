//! Where maps put points, and how far rounding can carry them.

use shadowfit::glam::{DVec3, Vec4};
use shadowfit::{
    ClipSpace, Focus, Light, Outcome, Scene, Settings, ShadowMap, View, Warp, focus::ConvexBody, warp::Shift,
};

use testkit::stability::arithmetic::{Big, Real};
use testkit::stability::linear::{V4, dot, homogeneous};

/// A camera at the origin that looks along −z, off every lattice.
pub(crate) fn view() -> View {
    View::perspective(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 1.0, 1.5, 1.0, 100.0).expect("sound")
}

/// The same, turned, so that no component of anything is zero.
pub(crate) fn turned_view() -> View {
    View::perspective((3.0, -2.0, 7.0), (0.48, -0.6, 0.64), DVec3::Y, 1.1, 1.6, 0.3, 200.0).expect("sound")
}

/// A box that holds all that these views see.
pub(crate) fn wide() -> Scene<'static> {
    Scene::from_box(DVec3::splat(-400.0), DVec3::splat(400.0)).expect("sound")
}

pub(crate) fn sun(direction: DVec3) -> Light {
    Light::directional(direction).expect("sound")
}

pub(crate) fn lamp(position: DVec3) -> Light {
    Light::point(position, 0.125, f64::INFINITY).expect("sound")
}

/// The perspective warp without a back-shift, so that only the light and the view decide on it.
pub(crate) fn settings() -> Settings {
    Settings::default().with_warp(Warp::Perspective).with_shift(Shift::None)
}

pub(crate) fn map(view: &View, light: &Light, scene: &Scene<'_>, settings: &Settings) -> ShadowMap {
    match Focus::new(view, light, scene).fit(settings) {
        Outcome::Map(map) => map,
        other => panic!("one map does: {other:?}"),
    }
}

/// x, y and z after the division, depth from 0 to 1.
pub(crate) fn place(map: &ShadowMap, point: DVec3) -> DVec3 {
    map.clip_from_world_in(ClipSpace::WGPU).project_point3(point)
}

/// How far the roundings of a fit can carry a coordinate: 64 of terms as large as a row's normal times everything that went
/// into it (as in `tests/properties.rs`), here of coordinates up to `reach`.
pub(crate) fn slack(map: &ShadowMap, point: DVec3, reach: f64) -> f64 {
    let matrix = map.clip_from_world_in(ClipSpace::WGPU);
    let of = |row: usize| {
        let row = matrix.row(row);
        64.0 * f64::EPSILON * (row.truncate().length() * 2.0 * reach + row.w.abs())
    };
    let w = matrix.row(3).dot(point.extend(1.0));
    let place = place(map, point).abs();
    (0..3).map(|row| (of(row) + place[row] * of(3)) / (w - of(3))).fold(0.0, f64::max)
}

/// What a renderer's f32 makes of a position.
pub(crate) fn in_f32(map: &ShadowMap, point: DVec3) -> Vec4 {
    let origin = map.origin();
    map.caster_matrix() * (point - origin).as_vec3().extend(1.0)
}

/// In the clip volume, depth 0 to 1, w > 0.
pub(crate) fn is_inside(clip: Vec4) -> bool {
    clip.w > 0.0 && clip.x.abs() <= clip.w && clip.y.abs() <= clip.w && (0.0..=clip.w).contains(&clip.z)
}

/// The largest change of any point's place between two maps.
pub(crate) fn change(a: &ShadowMap, b: &ShadowMap, points: &[DVec3]) -> f64 {
    points.iter().map(|&p| (place(a, p) - place(b, p)).abs().max_element()).fold(0.0, f64::max)
}

/// That a body holds exact points, homogeneous with w > 0: each is inside every plane, exactly.
pub(crate) fn assert_holds(body: &ConvexBody, points: &[V4<Big>], what: &dyn std::fmt::Debug) {
    assert!(points.is_empty() || !body.is_empty(), "{what:?}: all of it is lost");
    for plane in body.planes() {
        let plane: V4<Big> = homogeneous(plane.to_row());
        for point in points {
            assert!(dot(&plane, point) >= Big::of(0.0), "{what:?}: a vertex is outside of {plane:?}");
        }
    }
}

/// The vertices of R.
pub(crate) fn visible(view: &View, light: &Light, scene: &Scene<'_>) -> Vec<DVec3> {
    Focus::new(view, light, scene).receiver_volume().vertices().to_vec()
}

/// e·l < 0, and casters on the rays of receivers are before them.
pub(crate) fn assert_order(map: &ShadowMap, light: &Light, receivers: &[DVec3]) {
    let l = light.homogeneous();
    let matrix = map.clip_from_world_in(ClipSpace::WGPU);
    assert!(matrix.row(2).dot(l) < 0.0, "{light:?}");
    for &receiver in receivers {
        let behind = place(map, receiver);
        for part in [1e-3, 0.5, 0.99] {
            let caster = match light.position() {
                Some(position) => receiver.lerp(position, part),
                None => receiver + l.truncate() * 1000.0 * part,
            };
            assert!(place(map, caster).z < behind.z, "{light:?}: {caster} is behind {receiver}");
            assert!(matrix.row(3).dot(caster.extend(1.0)) > 0.0, "{light:?}: {caster} wraps around");
        }
    }
}
