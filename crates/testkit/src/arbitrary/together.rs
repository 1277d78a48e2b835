//! A case brought together: what the crate makes of its numbers, settings for its fit, and points to try the map on.

use proptest::prelude::*;
use shadowfit::glam::{DVec2, DVec3};
use shadowfit::{
    Effort, Focus, FocusForm, Light, Origin, Settings, View, Warp,
    focus::{ConvexBody, Plane},
    warp::Shift,
};

use super::{Case, SceneStore, clip_space};

/// The warps with a closed form, and none.
pub const FORMS: [Warp; 4] = [Warp::Uniform, Warp::Perspective, Warp::LightSpace, Warp::Trapezoidal];

/// All of them.
pub const WARPS: [Warp; 7] = [
    Warp::Uniform,
    Warp::Stable,
    Warp::Perspective,
    Warp::LightSpace,
    Warp::Trapezoidal,
    Warp::Best(Effort::Rough),
    Warp::Best(Effort::Good),
];

/// Settings of every kind.
pub fn settings() -> impl Strategy<Value = Settings> {
    let warp = prop::sample::select(&WARPS);
    let shift = prop_oneof![
        Just(Shift::None),
        Just(Shift::Back(FocusForm::ViewHull)),
        Just(Shift::Back(FocusForm::ReceiverHull))
    ];
    let origin = prop_oneof![Just(Origin::World), Just(Origin::Eye), Just(Origin::Light)];
    let square = [4, 512, 2048, 16384].map(|size| (size, size));
    let other = [(4, 4096), (16384, 64), (2048, 512), (1000, 3000)];
    let sides = prop::sample::select([square, other].concat());
    (warp, shift, origin, clip_space(), sides, 0..=1_u32).prop_map(
        |(warp, shift, origin, clip, (width, height), border)| {
            let settings = Settings::new(2048, 1080).and_then(|settings| settings.with_map_sides(width, height));
            let settings = settings.and_then(|settings| settings.with_border(border));
            let settings = settings.expect("legal sizes");
            settings.with_warp(warp).with_shift(shift).with_clip(clip).with_origin(origin)
        },
    )
}

/// Texels of a map across and down.
pub fn sides(settings: &Settings) -> DVec2 {
    let (width, height) = settings.map_sides();
    DVec2::new(width.into(), height.into())
}

/// Settings of maps that follow the view continuously: no stable ones, which stay where they are, and none that a search
/// may find elsewhere from one view to the next.
pub fn following() -> impl Strategy<Value = Settings> {
    settings().prop_filter("follows the view", |settings| FORMS.contains(&settings.warp()))
}

/// A case brought together.
pub struct Together {
    pub view: View,
    pub light: Light,
    pub store: SceneStore,
}

impl Together {
    pub fn of(case: &Case) -> Self {
        let (view, light) = case.build();
        Self { view, light, store: case.scene.store() }
    }

    pub fn focus(&self) -> Focus<'_> {
        let scene = self.store.scene().expect("the scene is accepted");
        Focus::new(&self.view, &self.light, &scene)
    }

    /// Whether a map answers for a point: nothing nearer to a lamp than its near distance casts.
    pub fn is_served(&self, point: DVec3) -> bool {
        // A point at the near distance itself may have been rounded to either side of it.
        let near = self.light.near() * (1.0 + 1e-9);
        self.light.position().is_none_or(|position| position.distance(point) >= near)
    }

    /// Points of H: from points of R towards the light, as far as the planes of H reach and to somewhere on the way.
    ///
    /// The vertices of H as computed may be a few roundings outside of hull(R, l), which is nothing to a caster but
    /// much to a light that grazes a flat scene.
    pub fn casters(&self, body: &ConvexBody, visible: &[DVec3], seed: u64) -> Vec<DVec3> {
        let mut numbers = Numbers(!seed);
        let l = self.light.homogeneous();
        let mut points = Vec::new();
        for &point in visible {
            let towards = l.truncate() - point * l.w;
            let most = if l.w > 0.0 { 1.0 } else { f64::INFINITY };
            let exit = |plane: Plane| {
                let slope = plane.normal.dot(towards);
                if slope < 0.0 { plane.at(point) / -slope } else { f64::INFINITY }
            };
            let reach = body.planes().map(exit).fold(most, f64::min);
            // Among lists H need not hold what is visible.
            if reach.is_finite() && body.contains(point) {
                points.extend([1.0, numbers.part()].map(|part| point + towards * (reach * part)));
            }
        }
        points
    }
}

/// The vertices of a body and sixteen convex combinations of them, chosen by a seed.
pub fn points_of(body: &ConvexBody, seed: u64) -> Vec<DVec3> {
    let vertices = body.vertices();
    let mut points = vertices.to_vec();
    if vertices.is_empty() {
        return points;
    }
    let mut numbers = Numbers(seed);
    for _ in 0..16 {
        let corners = [(); 4].map(|()| (vertices[numbers.below(vertices.len())], numbers.part() + 1e-6));
        let total: f64 = corners.iter().map(|(_, weight)| weight).sum();
        points.push(corners.iter().map(|(corner, weight)| corner * (weight / total)).sum());
    }
    points
}

/// Numbers from a seed (SplitMix64), where a strategy of their own would drown a failing case in numbers.
pub struct Numbers(pub u64);

impl Numbers {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ self.0 >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ mixed >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ mixed >> 31
    }

    /// From 0 to 1, 1 excluded.
    pub fn part(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn below(&mut self, count: usize) -> usize {
        (self.part() * count as f64) as usize
    }
}
