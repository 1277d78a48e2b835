//! What holds for every fit, over views, lights and scenes at random.
//!
//! Each property runs some thousands of cases from a fixed seed; `SHADOWFIT_CASES=100000` in the
//! environment runs that many of each instead. A failing case is made smaller and printed as the
//! Rust expression that makes it.

mod arbitrary;

use arbitrary::{
    Case, Frame, LightParams, Pose, SceneParams, SceneStore, Similarity, ViewParams, case, clip_space, number_bits,
    plane, rotation, run,
};
use glam::{DMat4, DQuat, DVec2, DVec3, DVec4, Vec4};
use proptest::prelude::*;
use shadowfit::{
    Body, ClipSpace, ConvexScene, DepthFormat, DepthRange, Focus, Form, Light, Map, Origin, Outcome, Plane, Scene, Settings,
    Shift, View, Warp, classify,
};

/// Settings of every kind.
fn settings() -> impl Strategy<Value = Settings> {
    let warp = prop_oneof![Just(Warp::Uniform), Just(Warp::Perspective)];
    let shift = prop_oneof![Just(Shift::None), Just(Shift::Back(Form::Paper)), Just(Shift::Back(Form::Tight))];
    let origin = prop_oneof![Just(Origin::World), Just(Origin::Eye)];
    let size = prop::sample::select(vec![4, 512, 2048, 16384]);
    (warp, shift, origin, clip_space(), size, 0..=1_u32).prop_map(|(warp, shift, origin, clip, size, border)| {
        let settings = Settings::new(size, 1080).and_then(|settings| settings.with_border(border));
        let settings = settings.expect("legal sizes");
        settings.with_warp(warp).with_shift(shift).with_clip(clip).with_origin(origin)
    })
}

/// A case brought together.
struct Together {
    view: View,
    light: Light,
    store: SceneStore,
}

impl Together {
    fn of(case: &Case) -> Self {
        let (view, light) = case.build();
        Self { view, light, store: case.scene.store() }
    }

    fn focus(&self) -> Focus<'_> {
        let scene = self.store.scene().expect("the scene is accepted");
        Focus::new(&self.view, &self.light, &scene)
    }

    /// Whether a map answers for a point: nothing nearer to a lamp than its near distance casts.
    fn is_served(&self, point: DVec3) -> bool {
        // A point at the near distance itself may have been rounded to either side of it.
        let near = self.light.near() * (1.0 + 1e-9);
        self.light.position().is_none_or(|position| position.distance(point) >= near)
    }
}

/// The vertices of a body and convex combinations of them.
fn points_of(body: &Body, weights: &[[f64; 4]]) -> Vec<DVec3> {
    let vertices = body.vertices();
    let mut points = vertices.to_vec();
    if vertices.is_empty() {
        return points;
    }
    for (first, weights) in weights.iter().enumerate() {
        // A stride that is prime to all small counts reaches every vertex.
        let corners = (0..4).map(|i| vertices[(first * 7 + i * 5) % vertices.len()]);
        let total: f64 = weights.iter().sum();
        points.push(corners.zip(weights).map(|(corner, weight)| corner * (weight / total)).sum());
    }
    points
}

fn weights() -> impl Strategy<Value = Vec<[f64; 4]>> {
    prop::collection::vec(prop::array::uniform4(1e-6..1.0), 16)
}

/// What the f32 matrix makes of a position that is an f32 too, as a vertex shader does it.
fn in_f32(map: &Map, view: &View, point: DVec3) -> Vec4 {
    let origin = match map.settings().origin() {
        Origin::World => DVec3::ZERO,
        Origin::Eye => view.eye(),
    };
    map.matrix() * (point - origin).as_vec3().extend(1.0)
}

/// Whether a point is inside the clip volume of a convention, `inner` of the way to its sides.
fn is_inside(clip: ClipSpace, position: Vec4, inner: f64) -> bool {
    let [x, y, z, w] = position.to_array().map(f64::from);
    let (near, far) = match clip.depth {
        DepthRange::ZeroToOne | DepthRange::ZeroToOneReversed => (0.0, w),
        DepthRange::NegativeOneToOne | DepthRange::NegativeOneToOneReversed => (-w, w),
    };
    w > 0.0 && x.abs() <= inner * w && y.abs() <= inner * w && near <= z && z <= far
}

#[test]
fn maps_hold_what_they_must() {
    run(5000, &(case(), settings(), weights()), |(case, settings, weights)| {
        let together = Together::of(&case);
        let focus = together.focus();
        let Outcome::Map(map) = focus.fit(&settings) else { return };
        // The border is measured in f64 after the division, which is a rounding more than the map answers for.
        let border = f64::from(settings.border()) / f64::from(settings.map_size());
        let inner = (1.0 - 2.0 * border) * (1.0 + f64::EPSILON);
        for (name, body, inner) in [("R", focus.visible(), inner), ("H", focus.body(Form::Tight), 1.0)] {
            for point in points_of(&body, &weights) {
                if !together.is_served(point) {
                    continue;
                }
                let position = in_f32(&map, &together.view, point);
                assert!(
                    is_inside(settings.clip(), position, inner),
                    "{name}: {point} is at {position}, {} of the window",
                    position.truncate() / position.w
                );
            }
        }
    });
}

/// A row of a matrix at a point, and how far rounding can carry it.
///
/// A row is a combination of planes through the light or the eye and through the middle of what is visible: a few dozen
/// roundings of terms as large as its normal times those points.
fn at(row: DVec4, point: DVec3, reach: DVec3) -> (f64, f64) {
    const ROUNDINGS: f64 = 64.0 * f64::EPSILON;
    let terms = row.truncate().abs().dot(point.abs() + reach) + row.w.abs();
    (row.dot(point.extend(1.0)), ROUNDINGS * terms)
}

/// Coordinates after the division by w, how far rounding can carry them, and w itself.
fn projected(matrix: &DMat4, point: DVec3, reach: DVec3) -> (DVec3, DVec3, f64) {
    let rows = matrix.transpose();
    let (w, w_slack) = at(rows.w_axis, point, reach);
    let coordinates = [rows.x_axis, rows.y_axis, rows.z_axis].map(|row| {
        let (value, slack) = at(row, point, reach);
        let least = (w - w_slack).max(f64::MIN_POSITIVE);
        (value / w, (slack + (value / w).abs() * w_slack) / least)
    });
    (DVec3::from(coordinates.map(|(value, _)| value)), DVec3::from(coordinates.map(|(_, slack)| slack)), w)
}

#[test]
fn rays_keep_their_place_and_gain_depth() {
    let parts = prop::collection::vec(0.0..1.0, 4);
    run(5000, &(case(), settings(), weights(), parts), |(case, settings, weights, parts)| {
        let together = Together::of(&case);
        let focus = together.focus();
        let Outcome::Map(map) = focus.fit(&settings) else { return };
        let matrix = map.shadow_from_world_in(ClipSpace::WGPU);
        let l = together.light.homogeneous();
        let (min, max) = case.scene.bounds();
        let (min, max) = (DVec3::from(min), DVec3::from(max));
        let reach = min.abs().max(max.abs()) + together.view.eye().abs() + l.truncate().abs() * l.w;
        for point in points_of(&focus.visible(), &weights) {
            if !together.is_served(point) {
                continue;
            }
            let (end, end_slack, end_w) = projected(&matrix, point, reach);
            assert!(end_w > 0.0, "{point} has w {end_w}");
            for part in &parts {
                // Beyond the near distance of a lamp; twice as far as the scene is large from the sun, so that many a
                // caster is behind the eye.
                let to_light = match together.light.position() {
                    Some(position) => {
                        let arm = position - point;
                        arm * (1.0 - together.light.near() / arm.length()).max(0.0)
                    }
                    None => l.truncate() * (2.0 * (max - min).length()),
                };
                let caster = point + to_light * *part;
                let (start, start_slack, start_w) = projected(&matrix, caster, reach);
                assert!(start_w > 0.0, "{caster} has w {start_w}");
                let slack = end_slack + start_slack;
                let moved = (start - end).abs();
                assert!(moved.x <= slack.x && moved.y <= slack.y, "{caster} and {point} differ by {moved}");
                assert!(start.z <= end.z + slack.z, "{caster} at {} is behind {point} at {}", start.z, end.z);
            }
        }
    });
}

/// A camera on a landscape and a light about its camera plane.
#[derive(Clone, Copy, Debug)]
struct Crossing {
    view: ViewParams,
    /// Amounts of the view's right and up, the direction towards the sun or where a lamp is.
    across: [f64; 2],
    lamp: bool,
    half_width: f64,
    height: f64,
}

impl Crossing {
    fn strategy() -> impl Strategy<Value = Self> {
        let across = (0.0..std::f64::consts::TAU, 0.5..50.0, any::<bool>()).prop_map(
            |(angle, distance, lamp): (f64, f64, bool)| {
                let distance = if lamp { distance } else { 1.0 };
                ([angle.cos() * distance, angle.sin() * distance], lamp)
            },
        );
        let pose = (1.0..10.0, -0.5..0.3).prop_map(|(height, pitch)| Pose {
            eye: [0.0, height, 0.0],
            forward: [0.0, pitch, -1.0],
            up: [0.0, 1.0, 0.0],
        });
        let view = (pose, 0.5..1.8, 0.05..1.0, prop_oneof![Just(None), (50.0..1000.0).prop_map(Some)])
            .prop_map(|(pose, fov_y, near, far)| ViewParams::Perspective { pose, fov_y, aspect: 1.5, near, far });
        (view, across, 20.0..500.0, 5.0..50.0).prop_map(|(view, (across, lamp), half_width, height)| Self {
            view,
            across,
            lamp,
            half_width,
            height,
        })
    }

    fn light(&self, view: &View, depth: f64) -> Light {
        let offset = view.right() * self.across[0] + view.up() * self.across[1] + view.forward() * depth;
        let light = if self.lamp {
            Light::point(view.eye() + offset, 1e-3, f64::INFINITY)
        } else {
            Light::directional(offset)
        };
        light.expect("a legal light")
    }
}

#[test]
fn maps_change_continuously_across_the_camera_plane() {
    run(500, &(Crossing::strategy(), settings()), |(crossing, settings)| {
        let view = crossing.view.build().expect("a legal view");
        let reach = DVec3::new(crossing.half_width, 0.0, crossing.half_width);
        let scene = Scene::from_box(-reach, reach + DVec3::Y * crossing.height).expect("a legal scene");
        let fit = |depth: f64| {
            let light = crossing.light(&view, depth);
            let focus = Focus::new(&view, &light, &scene);
            focus.fit(&settings).map().copied()
        };
        let Some(middle) = fit(0.0) else { return };
        assert_eq!(fit(-0.0).map(|map| map.matrix()), Some(middle.matrix()));
        let visible = Focus::new(&view, &crossing.light(&view, 0.0), &scene).visible();
        let place = |map: &Map, point: DVec3| {
            let (place, slack, _) = projected(&map.shadow_from_world(), point, reach + view.eye().abs());
            (place, slack.max_element())
        };
        let mut steepest: f64 = 0.0;
        for k in 0..=16 {
            for depth in [10_f64.powi(-k), -10_f64.powi(-k)] {
                let Some(map) = fit(depth) else { continue };
                for &point in visible.vertices() {
                    let ((a, a_slack), (b, b_slack)) = (place(&map, point), place(&middle, point));
                    let change = (a - b).abs().max_element();
                    if k < 4 {
                        steepest = steepest.max(change / depth.abs());
                    } else {
                        // Kinks where another vertex begins to limit the warp may double a slope and double it again.
                        let allowed = 4.0 * steepest * depth.abs() + a_slack + b_slack;
                        assert!(change <= allowed, "λw = {depth:e}: {point} moves by {change:e}, not {allowed:e}");
                    }
                }
            }
        }
    });
}
