//! What a paraboloid map holds, and what f32 makes of it.

use shadowfit::glam::{DVec3, Vec2, Vec3, Vec4, Vec4Swizzles};
use shadowfit::{
    DepthFormat, Empty, Light, Settings,
    omni::{Paraboloid, Paraboloids},
};

use crate::arbitrary::{Case, Together, points_of};

pub fn texels_per_unit(settings: &Settings) -> f64 {
    0.5 * f64::from(settings.map_size()) - f64::from(settings.border())
}

/// The WGSL, in f32.
pub struct Shader {
    pub place: DVec3,
    pub clip: Vec2,
    /// Whether the fragment shader keeps the vertex.
    pub kept: bool,
    pub texture: Vec4,
}

pub fn shader(map: &Paraboloid, position: Vec3) -> Shader {
    let q = map.caster_matrix() * position.extend(1.0);
    let (clip_scale, texture_scale) = (map.clip_scale(), map.texture_scale());
    let distance = q.xyz().length();
    let divisor = (distance + q.z).max(1e-6 * distance + 1e-30);
    let (place, depth) = (q.xy() / divisor, distance - q.w);
    let read = place * texture_scale.xy() + 0.5;
    Shader {
        place: place.extend(depth).as_dvec3(),
        clip: place * clip_scale,
        kept: clip_scale.x * clip_scale.x * (1.0 - 2.0 * (q.z / divisor)) <= 1.0,
        texture: read.extend(depth * texture_scale.z + texture_scale.w).extend(q.z),
    }
}

/// Asserts that f32 moves what is visible by no more than a map says.
pub fn carries_no_farther_than_it_says(case: &Case, settings: &Settings, seed: u64) {
    let together = Together::of(case);
    let focus = together.focus();
    for map in focus.paraboloids(settings).maps() {
        for point in points_of(&focus.receiver_volume(), seed) {
            let exact = match map.project(point) {
                Some(place) if map.clip_plane().at(point) >= 0.0 => place,
                _ => continue,
            };
            let rounding = map.rounding(point);
            let shader = shader(map, (point - map.origin()).as_vec3());
            let off = shader.place - exact;
            assert!(off.z.abs() <= rounding.depth, "{point}: depth off by {}, {rounding:?}", off.z);
            let texels = off.truncate().length() * texels_per_unit(settings);
            assert!(texels <= rounding.texels, "{point}: off by {texels}, {rounding:?}");
        }
    }
}

/// Asserts that the hemispheres of a case, its lamp put among what is visible where `among` says so, hold all that is
/// visible; says how many there are.
pub fn holds_what_it_must(case: &Case, settings: &Settings, seed: u64, among: bool) -> usize {
    let mut together = Together::of(case);
    // Lamps are seldom among what is visible; every other case has one put there.
    if let Some(&within) = points_of(&together.focus().receiver_volume(), !seed).last()
        && among
    {
        let near = together.light.near().max(1e-6 * within.length().max(1.0));
        together.light = Light::point(within, near, f64::INFINITY).expect("sound");
    }
    let focus = together.focus();
    let visible = focus.receiver_volume();
    let fitted = focus.paraboloids(settings);
    // R is cut from the scene, and its points are known to what can be known there.
    let (min, max) = case.scene.bounds();
    let scene = DVec3::from(min).abs().max(DVec3::from(max).abs());
    match &fitted {
        Paraboloids::Empty(Empty::NoCasters) => return 0,
        Paraboloids::Empty(_) => assert!(visible.is_empty()),
        Paraboloids::Directional => assert_eq!(together.light.position(), None),
        Paraboloids::One(_) => {}
        Paraboloids::Two([front, back]) => {
            assert_eq!(&front.opposite(), back);
            // Neither is for nothing.
            for map in [front, back] {
                assert!(visible.vertices().iter().any(|&point| map.clip_plane().at(point) > 0.0));
            }
        }
    }
    for point in points_of(&visible, seed) {
        let Some(map) =
            fitted.maps().iter().max_by(|a, b| a.clip_plane().at(point).total_cmp(&b.clip_plane().at(point)))
        else {
            continue;
        };
        if !together.is_served(point) {
            continue;
        }
        // A point of R is as far outside of a plane as rounding can carry it.
        let behind = -map.clip_plane().at(point);
        let extent = scene.max(point.abs()).max(map.position().abs()).element_sum();
        assert!(behind <= 512.0 * f64::EPSILON * extent, "{point} is {behind} behind the rim");
        let rounding = map.rounding(point);
        let depth = shader(map, (point - map.origin()).as_vec3()).place.z;
        // Where f32 does not know the near distance from nothing it is as it is.
        let is_near_known = map.near() > 0.75 * together.light.near();
        assert!(depth >= 0.0 || !is_near_known, "{point} is at {depth}, {rounding:?}");
        assert!(depth <= 1.0, "{point} is at {depth}");
        assert!(rounding.depth <= 2.0 / 1_048_576.0, "{point}: {rounding:?}");
    }
    fitted.maps().len()
}

/// Asserts that the bias covers the noise of what is far enough from the lamp.
pub fn noise_is_at_least_that_of_points(case: &Case, settings: &Settings, seed: u64) {
    let together = Together::of(case);
    let focus = together.focus();
    for map in focus.paraboloids(settings).maps() {
        let bias = map.bias(DepthFormat::Unorm24, 0.5).expect("a reach");
        for point in points_of(&focus.receiver_volume(), seed) {
            let far_enough = together.is_served(point) && point.distance(map.position()) >= map.far() / 64.0;
            if map.clip_plane().at(point) < 0.0 || !far_enough {
                continue;
            }
            let rounding = map.rounding(point);
            // The receiver's and the caster's.
            assert!(2.0 * rounding.depth <= bias.receiver, "{point}: {rounding:?}, {bias:?}");
            assert!(rounding.texels <= f64::from(bias.slope_scale) - 0.5, "{point}: {rounding:?}, {bias:?}");
        }
    }
}
