//! Cameras that move and turn, and where a stable map puts things.

use glam::{DMat4, DQuat, DVec2, DVec3, Vec3, Vec4};
use proptest::prelude::*;
use shadowfit::{Aabb, ClipSpace, InputError, Scene, Settings, ShadowMap, View, Warp, input::ConvexScene};
use testkit::arbitrary::{self};

/// Where a camera is, from the middle of the scene, and how it is turned from looking along −z.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pose {
    pub(crate) eye: [f64; 3],
    pub(crate) turn: DQuat,
}

/// What a camera keeps.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lens {
    pub(crate) fov_y: f64,
    pub(crate) aspect: f64,
    pub(crate) near: f64,
    pub(crate) far: f64,
    pub(crate) orthographic: bool,
}

impl Lens {
    pub(crate) fn view(&self, middle: DVec3, pose: &Pose) -> View {
        let Self { fov_y, aspect, near, far, orthographic } = *self;
        let (eye, forward, up) = (middle + DVec3::from(pose.eye), pose.turn * DVec3::NEG_Z, pose.turn * DVec3::Y);
        let view = if orthographic {
            View::orthographic(eye, forward, up, 0.1 * far, aspect, near, far)
        } else {
            View::perspective(eye, forward, up, fov_y, aspect, near, far)
        };
        view.expect("a legal view")
    }

    /// The radius of the smallest ball around V, by thirds: the middle is on the axis, and the farthest corner's distance
    /// from it is convex along that.
    pub(crate) fn radius(&self) -> f64 {
        let corners = self.view(DVec3::ZERO, &Pose { eye: [0.0; 3], turn: DQuat::IDENTITY }).corners();
        let corners = corners.expect("a finite far plane");
        let farthest =
            |depth: f64| corners.iter().map(|corner| corner.distance(DVec3::NEG_Z * depth)).fold(0.0, f64::max);
        let (mut low, mut high) = (self.near, self.far);
        for _ in 0..200 {
            let third = (high - low) / 3.0;
            if farthest(low + third) > farthest(high - third) { low += third } else { high -= third }
        }
        farthest(low)
    }
}

pub(crate) fn lens() -> impl Strategy<Value = Lens> {
    (0.3..2.0, 0.5..2.5, 0.05..1.0, 5.0..300.0, any::<bool>())
        .prop_map(|(fov_y, aspect, near, far, orthographic)| Lens { fov_y, aspect, near, far, orthographic })
}

pub(crate) fn pose() -> impl Strategy<Value = Pose> {
    let eye = (-200.0..200.0, 0.0..40.0, -200.0..200.0).prop_map(|(x, y, z)| [x, y, z]);
    (eye, arbitrary::rotation()).prop_map(|(eye, turn)| Pose { eye, turn })
}

/// Not far from another pose, so that much is visible from both.
pub(crate) fn next_to(pose: Pose) -> impl Strategy<Value = Pose> {
    let axis = prop::array::uniform3(-1.0..1.0);
    (prop::array::uniform3(-3.0..3.0), axis, -0.4..0.4).prop_map(move |(step, axis, angle): ([f64; 3], _, f64)| {
        Pose {
            eye: (DVec3::from(pose.eye) + DVec3::from(step)).to_array(),
            turn: DQuat::from_scaled_axis(DVec3::from(axis).normalize_or_zero() * angle) * pose.turn,
        }
    })
}

pub(crate) fn two_poses() -> impl Strategy<Value = [Pose; 2]> {
    prop_oneof![
        (pose(), pose()).prop_map(|(one, other)| [one, other]),
        pose().prop_flat_map(|one| next_to(one).prop_map(move |other| [one, other])),
    ]
}

/// Where the scene is.
pub(crate) fn middle() -> impl Strategy<Value = DVec3> {
    let far_out = |distance: f64| arbitrary::rotation().prop_map(move |turn| (turn * DVec3::X * distance).round());
    prop_oneof![Just(DVec3::ZERO), far_out(1e4), far_out(1e6)]
}

/// The forms that a scene comes in, 800 by 60 by 800 about its middle.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Form {
    Block,
    Flat,
    Convex,
    Lists,
}

pub(crate) fn form() -> impl Strategy<Value = Form> {
    prop::sample::select(vec![Form::Block, Form::Flat, Form::Convex, Form::Lists])
}

impl Form {
    pub(crate) fn with<T>(self, middle: DVec3, use_it: impl FnOnce(&Scene<'_>) -> T) -> T {
        let (min, max) = (middle + DVec3::new(-400.0, 0.0, -400.0), middle + DVec3::new(400.0, 60.0, 400.0));
        let flat = DVec3::new(max.x, min.y, max.z);
        let tip = (min + max) * 0.5 + DVec3::Y * 100.0;
        let convex = ConvexScene::around([min, flat, min + DVec3::X * 800.0, min + DVec3::Z * 800.0, tip]);
        let boxes =
            [Aabb::new(min.as_vec3(), flat.as_vec3()), Aabb::new(middle.as_vec3(), middle.as_vec3() + 20.0)];
        let scene: Result<Scene<'_>, InputError> = match self {
            Self::Block => Scene::from_box(min, max),
            Self::Flat => Scene::from_box(min, flat),
            Self::Convex => Ok(Scene::from_convex(convex.as_ref().expect("a convex scene"))),
            Self::Lists => Scene::new(&boxes, &boxes),
        };
        use_it(&scene.expect("a legal scene"))
    }
}

/// A map of four texels a side or more, square or not, odd sizes and sizes that are no powers of two among them.
pub(crate) fn stable() -> impl Strategy<Value = Settings> {
    let size = || prop::sample::select(vec![4, 5, 64, 1000, 1023, 2048, 4096]);
    let sides = prop_oneof![size().prop_map(|size| (size, size)), (size(), size())];
    (sides, 0.0..0.25).prop_map(|((width, height), border)| {
        let border = (f64::from(width.min(height)) * border) as u32;
        let settings = Settings::new(2048, 1080).and_then(|settings| settings.with_map_sides(width, height));
        let settings = settings.and_then(|settings| settings.with_border(border));
        settings.expect("legal sizes").with_warp(Warp::Stable)
    })
}

/// Rows of the matrix: clip x and y from −1 to 1.
pub(crate) fn rows(map: &ShadowMap) -> DMat4 {
    map.clip_from_world_in(ClipSpace::WGPU).transpose()
}

/// Where a point is in the map, in texels.
pub(crate) fn texels(map: &ShadowMap, point: DVec3) -> DVec2 {
    let place = map.clip_from_world_in(ClipSpace::WGPU).project_point3(point).truncate();
    (place * 0.5 + 0.5) * arbitrary::sides(map.settings())
}

/// How far two numbers are from differing by a whole one.
pub(crate) fn off_whole(difference: DVec2) -> f64 {
    (difference - difference.round()).abs().max_element()
}

/// The sides of a texel of a directional light's map, in world units.
pub(crate) fn sides(map: &ShadowMap) -> DVec2 {
    DVec2::new(map.window().width, map.window().height) / arbitrary::sides(map.settings())
}

/// The place in the map of a position that is an f32 too, as a vertex shader finds it: x, y, z and at the end the offset.
pub(crate) fn texels_in_f32(map: &ShadowMap, position: Vec3) -> DVec2 {
    let matrix = map.caster_matrix();
    let columns = [matrix.x_axis, matrix.y_axis, matrix.z_axis, matrix.w_axis];
    let [x, y, z, offset]: [Vec4; 4] = columns;
    let place = ((x * position.x + y * position.y) + z * position.z) + offset;
    assert_eq!(place.w, 1.0);
    (DVec2::new(place.x.into(), place.y.into()) * 0.5 + 0.5) * arbitrary::sides(map.settings())
}
