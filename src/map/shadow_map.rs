//! A fitted map: the matrices a renderer uploads, and what they cost and give.

use crate::convex::{Plane, matrix_from_rows};
use crate::input::clip_space::ClipSpace;
use crate::input::light::Light;
use crate::input::view::View;
use crate::map::linear_depth::LinearDepth;
use crate::map::quality::{
    DepthFormat, Footprint, depth_resolution, depth_slopes, footprint, linear_depth_resolution,
};
use crate::map::receiver_offset::ReceiverOffset;
use crate::math::bounds::{Interval, Rectangle};
use crate::settings::fallback::WarpFallback;
use crate::settings::{Origin, Settings};
use crate::warp::rays::Rays;
use crate::warp::rounding::{AWAY_FROM_LAMP, MapNoise};
use crate::warp::virtual_camera::VirtualCamera;
use glam::{DMat4, DVec2, DVec3, Mat4};

/// A fitted shadow map.
///
/// # Guarantees
///
/// With R what is visible and lit, H the tight focus body, and points at least the light's near distance from it:
///
/// - every point of R and of H, taken through the f32 matrix in f32, lies inside the clip volume, and R keeps the border
///   of the settings from its sides. There are three exceptions: a point where f32 loses half of w or more, as next to a
///   lamp of millimetres a thousand kilometres from the origin in [`Origin::World`], is anywhere; a caster so near to a light at
///   a position that f32 cannot tell where it stands to within a thousandth of the window, or a receiver to within a 64th, may be
///   off by its rounding; and where casters and receivers have lists of their own, a receiver may be nearer to the light than
///   the first caster, and is lit;
/// - points on a ray from the light share their (x, y), and depth grows away from the light: the test is 'less', or
///   'greater' for a reversed clip space, whatever the class of the light;
/// - w > 0, so that no caster wraps around, wherever it is, also behind the eye.
#[derive(Clone, Debug, PartialEq)]
pub struct ShadowMap {
    /// World to clip, depth 0 to 1, y up.
    pub(crate) rows: [Plane; 4],
    pub(crate) view: View,
    pub(crate) light: Light,
    pub(crate) settings: Settings,
    pub(crate) camera: VirtualCamera,
    pub(crate) window: Window,
    pub(crate) depth: DepthSpan,
    pub(crate) along: LinearDepth,
    pub(crate) noise: MapNoise,
    pub(crate) weakening: f64,
    /// By how much of the uniform map's w the best map was mixed, see [`Proposed::mixed`](crate::warp::Proposed).
    pub(crate) mixed: f64,
    pub(crate) fallback: Option<WarpFallback>,
    pub(crate) jumped: bool,
    pub(crate) warp_ratio: f64,
}

/// The window of a map: what its x and y cover.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Window {
    /// Width of the map across the ray in its middle: world units for a directional light, tangents (world units at
    /// distance 1) for any other.
    pub width: f64,
    /// Height, in the same units.
    pub height: f64,
    /// The part of the width and height that is neither border nor needed by what is visible, added to cover the
    /// rounding of the f32 matrix, because what is visible has no extent of its own, or, in a stable map, as room for
    /// all that the camera may turn to.
    pub padding: (f64, f64),
    /// How far f32 can carry anything visible across the map, in the matrix and in positions, in texels:
    /// thousandths of one in most uniform maps, more where a strong warp or coordinates far out cost f32 its last bits.
    /// It is the most there is anywhere, for [`ShadowMap::place_rounding`] of a point.
    pub rounding: f64,
}

impl Window {
    pub(crate) fn new(needed: &Rectangle, padded: &Rectangle, inner: DVec2, rounding: f64) -> Self {
        let padding = 1.0 - needed.half / (padded.half * inner);
        Self { width: 2.0 * padded.half.x, height: 2.0 * padded.half.y, padding: padding.into(), rounding }
    }
}

/// The depth range of a map, on the ray in its middle.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct DepthSpan {
    /// Distance of the near plane along the map's axis in world units, from the light, or from the eye when the light
    /// is infinitely far away. A plane of equal depth is slanted under a warp, and this is where the ray in the middle meets
    /// it; infinite where that does not, because all casters of a list are off to one side.
    #[cfg_attr(feature = "serde", serde(with = "crate::math::infinity"))]
    pub near: f64,
    /// Distance of the far plane, likewise; infinite where padding has moved it beyond every point.
    #[cfg_attr(feature = "serde", serde(with = "crate::math::infinity"))]
    pub far: f64,
    /// How far f32 can carry the depth of anything visible, in the matrix and in positions, where the depth range is 1:
    /// the noise that a bias must cover besides the depth format's own. It is the most there is anywhere; at a point it may
    /// be far less ([`ShadowMap::depth_rounding`]), as it falls with 1/w.
    ///
    /// Ranges are made so long that, where w is largest, it is at most about 2⁻²⁰, 16 steps of 24 bits, and what f32 loses
    /// of w besides: some steps in a uniform map, more in a strong warp.
    pub rounding: f64,
}

impl DepthSpan {
    /// From depths of the homography, whose depth 0 is at distance `zero` along the axis, seen from `eye`.
    pub(crate) fn new(rays: &Rays, zero: f64, depth: &Interval, eye: DVec3, rounding: f64) -> Self {
        // On the ray in the middle c is w: z = along − zero for a directional light, 1 − zero/along for any other.
        let along = |z: f64| match rays.local {
            true if z < 1.0 => zero / (1.0 - z),
            true => f64::INFINITY,
            false => zero + z - rays.along.at(eye),
        };
        Self { near: along(depth.min), far: along(depth.max), rounding }
    }
}

impl ShadowMap {
    /// The matrix to upload: positions relative to [`Self::origin`], in world space unless the settings say otherwise, to clip
    /// space in the convention of the settings.
    #[must_use]
    pub fn caster_matrix(&self) -> Mat4 {
        self.about_origin(self.clip_from_world()).as_mat4()
    }

    /// The matrix from the same positions to texture space: after division by w, (x, y) are texture coordinates in
    /// [0, 1]² and z is what the depth buffer holds.
    #[must_use]
    pub fn receiver_matrix(&self) -> Mat4 {
        self.about_origin(self.texture_from_world()).as_mat4()
    }

    /// World space to clip space in the convention of the settings.
    #[must_use]
    pub fn clip_from_world(&self) -> DMat4 {
        self.clip_from_world_in(self.settings.clip())
    }

    /// World space to clip space in any convention.
    #[must_use]
    pub fn clip_from_world_in(&self, clip: ClipSpace) -> DMat4 {
        matrix_from_rows(clip.rows_from_wgpu(self.rows))
    }

    /// World space to texture space, see [`Self::receiver_matrix`].
    #[must_use]
    pub fn texture_from_world(&self) -> DMat4 {
        matrix_from_rows(self.settings.clip().texture_rows_from_wgpu(self.rows))
    }

    /// [`Self::receiver_matrix`] for receivers that are tested as if they lay nearer to the light: what to upload for the
    /// shadow test, while casters are drawn with [`Self::caster_matrix`].
    ///
    /// Only depth changes, and with it nothing that the fit promises of the window. A receiver that is moved out of the
    /// near end of the depth range is lit: clamp depth to [0, 1] in the shader, or compare as it is.
    #[must_use]
    pub fn receiver_matrix_with(&self, offset: &ReceiverOffset) -> Mat4 {
        self.about_origin(self.texture_from_world_with(offset)).as_mat4()
    }

    /// World space to texture space with an offset, see [`Self::receiver_matrix_with`].
    #[must_use]
    pub fn texture_from_world_with(&self, offset: &ReceiverOffset) -> DMat4 {
        matrix_from_rows(self.settings.clip().texture_rows_from_wgpu(self.rows_with(offset)))
    }

    /// [`Self::receiver_matrix_with`] in clip space, for shaders that go from there to texture coordinates themselves: depth is
    /// that of clip space, from −1 to 1 where the settings say so.
    #[must_use]
    pub fn receiver_clip_matrix_with(&self, offset: &ReceiverOffset) -> Mat4 {
        self.about_origin(self.clip_from_world_with(offset)).as_mat4()
    }

    /// World space to clip space with an offset, see [`Self::receiver_clip_matrix_with`].
    #[must_use]
    pub fn clip_from_world_with(&self, offset: &ReceiverOffset) -> DMat4 {
        matrix_from_rows(self.settings.clip().rows_from_wgpu(self.rows_with(offset)))
    }

    fn rows_with(&self, offset: &ReceiverOffset) -> [Plane; 4] {
        let [x, y, z, w] = self.rows;
        [x, y, offset.depth_row(z, w, self.light.homogeneous(), &self.along), w]
    }

    /// Depth as a linear function of world space, for maps that a shader writes: the distance along the map's axis, 0 at
    /// the first and 1 at the last of all that casts in the window or is visible. For positions relative to the eye its
    /// offset is its value at the eye.
    #[must_use]
    pub fn linear_depth(&self) -> Plane {
        self.along.linear_depth()
    }

    /// What positions are relative to in the f32 matrices, in world space: subtract it in f64 before they become f32.
    #[must_use]
    pub fn origin(&self) -> DVec3 {
        self.settings.origin().of(&self.view, &self.light)
    }

    /// The matrix for positions relative to the origin of the settings.
    pub(crate) fn about_origin(&self, from_world: DMat4) -> DMat4 {
        match self.settings.origin() {
            Origin::World => from_world,
            Origin::Eye | Origin::Light => from_world * DMat4::from_translation(self.origin()),
        }
    }

    /// What one texel covers at a point, across the ray from the light; `None` outside of the map (w ≤ 0).
    #[must_use]
    pub fn footprint(&self, point: DVec3) -> Option<Footprint> {
        footprint(&self.rows, -self.light.direction_from(point), point, self.settings.sides())
    }

    /// Aliasing at a point: the longer side of a texel's footprint over the side of a pixel's, both across their rays.
    /// At 1 a texel is as large as a pixel, above it is larger and shows. `None` outside of the map.
    ///
    /// On a surface a texel is stretched by 1/cos of the angle between its normal and the light, and a pixel by 1/cos of
    /// that between its normal and the view, so that what is seen there is this times cos(view, normal)/cos(light, normal).
    /// Stamminger & Drettakis (2002, §1.1) have that factor in their formula; the words beside it call β the angle between
    /// light and normal, which contradicts it.
    #[must_use]
    pub fn aliasing(&self, point: DVec3) -> Option<f64> {
        let pixel = self.pixel_size(point);
        self.footprint(point).map(|texel| texel.longest() / pixel)
    }

    /// The side of a pixel at a point, across the view axis, in world units.
    #[must_use]
    pub fn pixel_size(&self, point: DVec3) -> f64 {
        self.view.pixel_size(point, self.settings.image_height())
    }

    /// How much the depth of the plane through a point across `normal` (of any length) changes from one texel to the next,
    /// across and down, where the depth range is 1; never negative, and the same all over the plane. `None` outside of the
    /// map and where the light sees the plane from its edge.
    #[must_use]
    pub fn depth_slopes(&self, point: DVec3, normal: DVec3) -> Option<DVec2> {
        depth_slopes(&self.rows, point, normal, self.settings.sides())
    }

    /// How far f32 can carry the depth of a visible point no nearer to the light than its near distance, in the matrix and
    /// in positions, where the depth range is 1: [`DepthSpan::rounding`] at most, and no more than a constant over w. Next
    /// to a lamp, where w is small, it is hundreds of times what it is on all that is lit by it. A receiver before the near
    /// end of the range, as there are among lists, may be off by its depth times that, and is lit. Infinite outside of
    /// the map.
    #[must_use]
    pub fn depth_rounding(&self, point: DVec3) -> f64 {
        self.noise.depth.at(self.w_at(point))
    }

    /// How far f32 can carry such a point across the map, in texels: [`Window::rounding`] at most, and no more than a
    /// constant over w.
    #[must_use]
    pub fn place_rounding(&self, point: DVec3) -> f64 {
        self.noise.place.at(self.w_at(point))
    }

    /// The part of the depth range of a light at a position that lies in the air beside it: nearer, along the axis of the map, than
    /// a 16th of the way to the far end. 0 for a directional light.
    ///
    /// Depth is hyperbolic. With a near distance of a thousandth of the far one it is 0.985, and all that is lit shares the rest of the
    /// steps. Next to 1 it says that the near distance costs precision; what casters allow says
    /// [`Light::distance_to_casters`](crate::Light::distance_to_casters).
    #[must_use]
    pub fn depth_beside_light(&self) -> f64 {
        let DepthSpan { near, far, .. } = self.depth;
        if self.light.position().is_none() || near >= far {
            return 0.0;
        }
        let beside = (far * AWAY_FROM_LAMP).clamp(near, far);
        (near.recip() - beside.recip()) / (near.recip() - far.recip())
    }

    /// w at a point, as the matrices have it but for rounding: positive in front of the light, and at most 1 where anything is
    /// visible.
    #[must_use]
    pub fn w_at(&self, point: DVec3) -> f64 {
        self.rows[3].at(point)
    }

    /// The distance along the ray from the light, in world units, that one step of a depth format makes at a point.
    ///
    /// Depth is z/w as a rasteriser stores it: hyperbolic along a ray wherever w changes along it, which is in every map
    /// but a directional light's uniform one. See [`Self::linear_depth_resolution`] for the other way.
    #[must_use]
    pub fn depth_resolution(&self, point: DVec3, format: DepthFormat) -> f64 {
        let reversed = self.settings.clip().depth.is_reversed();
        depth_resolution(&self.rows, -self.light.direction_from(point), point, format, reversed)
    }

    /// The same where a shader stores [`Self::linear_depth`] instead: one distance for all steps of a fixed-point format
    /// along a ray, where hyperbolic depth has the finer steps towards the light and the coarser ones at the far end
    /// (Kilgard 2000).
    #[must_use]
    pub fn linear_depth_resolution(&self, point: DVec3, format: DepthFormat) -> f64 {
        linear_depth_resolution(&self.linear_depth(), -self.light.direction_from(point), point, format)
    }

    /// The settings the map was fitted with.
    #[must_use]
    pub const fn settings(&self) -> &Settings {
        &self.settings
    }

    /// The camera whose perspective warps the map.
    #[must_use]
    pub const fn camera(&self) -> &VirtualCamera {
        &self.camera
    }

    /// What the map's x and y cover.
    #[must_use]
    pub const fn window(&self) -> &Window {
        &self.window
    }

    /// What the map's depth covers.
    #[must_use]
    pub const fn depth(&self) -> &DepthSpan {
        &self.depth
    }

    /// Why the map is the uniform one although another was asked for; `None` where it is what was asked for.
    #[must_use]
    pub const fn fallback(&self) -> Option<WarpFallback> {
        self.fallback
    }

    /// The largest w over the least w on what is visible, against the uniform map's: how strong the warp is. 1 for a
    /// uniform map.
    #[must_use]
    pub const fn warp_ratio(&self) -> f64 {
        self.warp_ratio
    }

    /// The part of w, on the ray in the middle, that is the uniform map's: 0 for the warp as it was proposed or found, 1 for no warp
    /// at all, and more where the paper's w is negative on that ray. A warp is weakened where f32 could not evaluate it, the more
    /// the larger a part of a texel f32 takes in the uniform map; the best map also where less of a warp gives finer texels and a
    /// smaller bias at what may be seen.
    #[must_use]
    pub const fn weakening(&self) -> f64 {
        self.weakening
    }

    /// Whether something visible jumps by more than a 32nd of the map from the map before to this one
    /// ([`Focus::fit_warm`](crate::Focus::fit_warm)): because the local minimum that the search stayed with is no more, or is worse than a closed form.
    #[must_use]
    pub const fn jumped(&self) -> bool {
        self.jumped
    }
}
