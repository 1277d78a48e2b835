//! A fitted shadow map: the matrices to upload, its window and depth range, and what it resolves at a point.

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
use crate::warp::rounding::{AWAY_FROM_LIGHT, MapNoise};
use crate::warp::virtual_camera::VirtualCamera;
use glam::{DMat4, DVec2, DVec3, Mat4};

/// A fitted shadow map: the matrices to upload, and what the map resolves.
///
/// [`fit`](crate::fit()) makes it. Casters are drawn with [`Self::caster_matrix`], and receivers are tested with
/// [`Self::receiver_matrix_with`] the offset of the map's [bias](Self::bias).
///
/// ```
#[doc = include_str!("../examples/sun.txt")]
/// let clip = map.caster_matrix().project_point3(ground.as_vec3()); // the vertex shader of the shadow pass
/// assert!(clip.x.abs() < 1.0 && clip.y.abs() < 1.0 && (0.0..=1.0).contains(&clip.z));
/// let place = map.receiver_matrix().project_point3(ground.as_vec3()); // the shader that lights the ground
/// assert!((place.x - (0.5 + 0.5 * clip.x)).abs() < 1e-5 && (place.z - clip.z).abs() < 1e-6);
///
/// assert_eq!(map.settings(), &settings);
/// assert_eq!(map.fallback(), None); // the warp of the settings was made,
/// assert!(map.warp_ratio() > 1.0 && map.weakening() < 1.0); // and bends the map.
/// assert!(!map.jumped());
/// assert!(map.window().width > 0.0 && map.depth().near < map.depth().far);
/// assert!(map.camera().shift >= 0.0);
/// # Ok::<(), shadowfit::InputError>(())
/// ```
///
/// # What a map can do
///
/// | topic | methods | in `src/` |
/// |---|---|---|
/// | matrices in f32, to upload | [`caster_matrix`](Self::caster_matrix), [`receiver_matrix`](Self::receiver_matrix), [`receiver_matrix_with`](Self::receiver_matrix_with), [`receiver_clip_matrix_with`](Self::receiver_clip_matrix_with), [`origin`](Self::origin) | `map/shadow_map.rs` |
/// | matrices in f64 | [`clip_from_world`](Self::clip_from_world), [`clip_from_world_in`](Self::clip_from_world_in), [`clip_from_world_with`](Self::clip_from_world_with), [`texture_from_world`](Self::texture_from_world), [`texture_from_world_with`](Self::texture_from_world_with) | `map/shadow_map.rs` |
/// | window and depth range | [`window`](Self::window), [`depth`](Self::depth), [`linear_depth`](Self::linear_depth), [`depth_beside_light`](Self::depth_beside_light), [`w_at`](Self::w_at) | `map/shadow_map.rs` |
/// | how the fit went | [`settings`](Self::settings), [`camera`](Self::camera), [`fallback`](Self::fallback), [`warp_ratio`](Self::warp_ratio), [`weakening`](Self::weakening), [`jumped`](Self::jumped) | `map/shadow_map.rs` |
/// | resolution at a point | [`footprint`](Self::footprint), [`pixel_size`](Self::pixel_size), [`aliasing`](Self::aliasing), [`depth_slopes`](Self::depth_slopes), [`depth_resolution`](Self::depth_resolution), [`linear_depth_resolution`](Self::linear_depth_resolution) | `map/shadow_map.rs`, `map/quality.rs` |
/// | rounding of f32 at a point | [`depth_rounding`](Self::depth_rounding), [`place_rounding`](Self::place_rounding) | `map/shadow_map.rs` |
/// | resolution over all receivers | [`report`](Self::report), [`aliasing_over`](Self::aliasing_over), [`aliasing_over_receivers`](Self::aliasing_over_receivers) | `map/report.rs`, `map/aliasing.rs` |
/// | bias against shadow acne | [`bias`](Self::bias), [`bias_distance`](Self::bias_distance), [`normal_offset`](Self::normal_offset), [`normal_offset_at`](Self::normal_offset_at), [`largest_normal_offset`](Self::largest_normal_offset) | `depth/bias.rs`, `depth/normal_offset.rs` |
/// | virtual samples | [`comparison_tolerance`](Self::comparison_tolerance), [`TangentPlane::new`](crate::depth::TangentPlane::new) | `depth/tolerance.rs`, `depth/virtual_sample.rs` |
/// | point clouds | [`splat`](Self::splat), [`disc_splat`](Self::disc_splat) | `depth/splat.rs` |
///
/// # Guarantees
///
/// With R the receiver volume, H the tight caster volume, and points at least the light's near distance from it:
///
/// - every point of R and of H, taken through the f32 matrix in f32, lies inside the clip volume, and R keeps the border
///   of the settings from its sides. There are three exceptions. A point where f32 loses half of w or more may land anywhere:
///   next to a point light of millimetres, a thousand kilometres from the origin, in [`Origin::World`]. A caster so near to a
///   local light that f32 cannot tell its place to within a thousandth of the window, or a receiver to within a 64th, may be
///   off by its rounding. Where casters and receivers have lists of their own, a receiver may be nearer to the light than
///   the first caster, and is lit;
/// - points on a ray from the light share their (x, y), and depth grows away from the light: the test is 'less', or
///   'greater' for a reversed clip space, whatever the class of the light;
/// - w > 0, so that no caster wraps around, wherever it is, also behind the eye.
#[doc(alias = "shadow matrix")]
#[doc(alias = "light view-projection")]
#[doc(alias = "light-space matrix")]
#[doc(alias = "world to shadow")]
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
    pub(crate) fallback: Option<WarpFallback>,
    pub(crate) jumped: bool,
    pub(crate) warp_ratio: f64,
}

/// The window of a map: what its x and y cover, as [`ShadowMap::window`] gives it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Window {
    /// Width of the map across the ray in its middle: world units for a directional light, tangents (world units at
    /// distance 1) for any other.
    pub width: f64,
    /// Height, in the same units.
    pub height: f64,
    /// The part of the width and height that is neither border nor needed by the receivers. It covers the rounding of the
    /// f32 matrix, and in a stable map it is room for all that the camera may turn to. It is also added where the
    /// receivers have no extent of their own.
    pub padding: (f64, f64),
    /// The farthest that f32 moves any receiver across the map, in the matrix and in positions, in texels: thousandths of
    /// one in most uniform maps, more under a strong warp or far from the origin. The maximum over the receivers of
    /// [`ShadowMap::place_rounding`].
    pub rounding: f64,
}

impl Window {
    pub(crate) fn new(needed: &Rectangle, padded: &Rectangle, inner: DVec2, rounding: f64) -> Self {
        let padding = 1.0 - needed.half / (padded.half * inner);
        Self { width: 2.0 * padded.half.x, height: 2.0 * padded.half.y, padding: padding.into(), rounding }
    }
}

/// The depth range of a map on the ray in its middle, as [`ShadowMap::depth`] gives it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct DepthSpan {
    /// Distance of the near plane along the map's axis in world units, from the light, or from the eye when the light is
    /// infinitely far away. Under a warp a plane of equal depth is slanted, and this is where the ray in the middle meets it;
    /// infinite where it does not, because all casters of a list are off to one side.
    #[cfg_attr(feature = "serde", serde(with = "crate::math::infinity"))]
    pub near: f64,
    /// Distance of the far plane, likewise; infinite where padding has moved it beyond every point.
    #[cfg_attr(feature = "serde", serde(with = "crate::math::infinity"))]
    pub far: f64,
    /// The most that f32 changes the depth of any receiver, in the matrix and in positions, where the depth range is 1: the
    /// noise that a bias must cover besides that of the depth format. At a point it may be far less
    /// ([`ShadowMap::depth_rounding`]), as it falls with 1/w.
    ///
    /// Ranges are made so long that, where w is largest, it is at most about 2⁻²⁰, 16 steps of 24 bits, and what f32 loses
    /// of w besides: some steps in a uniform map, more under a strong warp.
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
    /// The matrix that casters are drawn with, in f32: the light's view-projection.
    ///
    /// It takes positions relative to [`Self::origin`] (world space unless the settings say otherwise) to clip space in the
    /// convention of the settings.
    ///
    /// ```
    #[doc = include_str!("../examples/sun.txt")]
    /// let clip = map.caster_matrix() * ground.as_vec3().extend(1.0);
    /// assert!(clip.w > 0.0 && clip.x.abs() < clip.w && clip.y.abs() < clip.w);
    /// let columns: [[f32; 4]; 4] = map.caster_matrix().to_cols_array_2d(); // for a uniform buffer
    /// assert_eq!(columns[3][3], map.caster_matrix().w_axis.w);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[doc(alias = "light_view_proj")]
    #[doc(alias = "light view-projection")]
    #[doc(alias = "shadow_from_world")]
    #[must_use]
    pub fn caster_matrix(&self) -> Mat4 {
        self.about_origin(self.clip_from_world()).as_mat4()
    }

    /// The matrix that receivers are tested with, in f32, without a bias: from positions as for [`Self::caster_matrix`] to
    /// texture space.
    ///
    /// After division by w, (x, y) are texture coordinates in [0, 1]² and z is the depth to compare with what the map stores
    /// (Kilgard 2000). For a test with a bias see [`Self::receiver_matrix_with`].
    ///
    /// ```
    #[doc = include_str!("../examples/sun.txt")]
    /// let place = map.receiver_matrix().project_point3(ground.as_vec3());
    /// assert!(place.min_element() > 0.0 && place.max_element() < 1.0);
    /// let towards_light = ground + DVec3::from(sun.direction_from(ground));
    /// let nearer = map.receiver_matrix().project_point3(towards_light.as_vec3());
    /// assert!((nearer - place).truncate().length() < 1e-4); // on one ray: one texel
    /// assert!(nearer.z < place.z); // depth grows away from the light
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[doc(alias = "texture matrix")]
    #[doc(alias = "shadow coordinate")]
    #[doc(alias = "shadow texture matrix")]
    #[doc(alias = "bias matrix")]
    #[must_use]
    pub fn receiver_matrix(&self) -> Mat4 {
        self.about_origin(self.texture_from_world()).as_mat4()
    }

    /// World space to clip space in the convention of the settings, in f64: [`Self::caster_matrix`] before it is rounded.
    ///
    /// ```
    #[doc = include_str!("../examples/sun.txt")]
    /// let clip = map.clip_from_world().project_point3(ground);
    /// let rounded = map.caster_matrix().project_point3(ground.as_vec3());
    /// assert!((clip - rounded.as_dvec3()).length() < 1e-5);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[doc(alias = "shadow_from_world")]
    #[must_use]
    pub fn clip_from_world(&self) -> DMat4 {
        self.clip_from_world_in(self.settings.clip())
    }

    /// World space to clip space in a convention other than that of the settings, in f64.
    ///
    /// ```
    #[doc = include_str!("../examples/sun.txt")]
    /// let reversed = map.clip_from_world_in(ClipSpace::WGPU.reversed()).project_point3(ground);
    /// let depth = map.clip_from_world().project_point3(ground).z;
    /// assert!((reversed.z - (1.0 - depth)).abs() < 1e-12);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn clip_from_world_in(&self, clip: ClipSpace) -> DMat4 {
        matrix_from_rows(clip.rows_from_wgpu(self.rows))
    }

    /// World space to texture space, in f64: [`Self::receiver_matrix`] before it is rounded.
    ///
    /// ```
    #[doc = include_str!("../examples/sun.txt")]
    /// let place = map.texture_from_world().project_point3(ground);
    /// let rounded = map.receiver_matrix().project_point3(ground.as_vec3());
    /// assert!((place - rounded.as_dvec3()).length() < 1e-5);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn texture_from_world(&self) -> DMat4 {
        matrix_from_rows(self.settings.clip().texture_rows_from_wgpu(self.rows))
    }

    /// The matrix that receivers are tested with when a [`ReceiverOffset`] moves them towards the light, in f32. Casters are
    /// drawn with [`Self::caster_matrix`] all the same.
    ///
    /// Only depth differs from [`Self::receiver_matrix`], and nothing that the fit promises of the window. A receiver that is
    /// moved out of the near end of the depth range is lit: clamp depth to [0, 1] in the shader, or compare as it is.
    ///
    /// ```
    #[doc = include_str!("../examples/sun.txt")]
    /// let bias = map.bias(DepthFormat::Unorm24, Filter::Hardware2x2.reach())?;
    /// let biased = map.receiver_matrix_with(&bias.offset()).project_point3(ground.as_vec3());
    /// let place = map.receiver_matrix().project_point3(ground.as_vec3());
    /// assert_eq!(biased.truncate(), place.truncate());
    /// assert!(biased.z < place.z);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[doc(alias = "biased texture matrix")]
    #[must_use]
    pub fn receiver_matrix_with(&self, offset: &ReceiverOffset) -> Mat4 {
        self.about_origin(self.texture_from_world_with(offset)).as_mat4()
    }

    /// World space to texture space with a receiver offset, in f64: [`Self::receiver_matrix_with`] before it is rounded.
    ///
    /// ```
    #[doc = include_str!("../examples/sun.txt")]
    /// use shadowfit::depth::ReceiverOffset;
    ///
    /// let offset = ReceiverOffset::depth(0.01)?; // a hundredth of the depth range
    /// let place = map.texture_from_world().project_point3(ground);
    /// let moved = map.texture_from_world_with(&offset).project_point3(ground);
    /// assert!((moved.z - (place.z - 0.01)).abs() < 1e-12);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn texture_from_world_with(&self, offset: &ReceiverOffset) -> DMat4 {
        matrix_from_rows(self.settings.clip().texture_rows_from_wgpu(self.rows_with(offset)))
    }

    /// [`Self::receiver_matrix_with`] in clip space, in f32, for shaders that go on to texture coordinates themselves:
    /// depth is that of clip space, from −1 to 1 where the settings say so.
    ///
    /// ```
    #[doc = include_str!("../examples/sun.txt")]
    /// let offset = map.bias(DepthFormat::Float32, 1.0)?.offset();
    /// let clip = map.receiver_clip_matrix_with(&offset).project_point3(ground.as_vec3());
    /// let place = map.receiver_matrix_with(&offset).project_point3(ground.as_vec3());
    /// assert!((clip.z - place.z).abs() < 1e-6 && (0.5 + 0.5 * clip.x - place.x).abs() < 1e-5);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn receiver_clip_matrix_with(&self, offset: &ReceiverOffset) -> Mat4 {
        self.about_origin(self.clip_from_world_with(offset)).as_mat4()
    }

    /// World space to clip space with a receiver offset, in f64: [`Self::receiver_clip_matrix_with`] before it is rounded.
    ///
    /// ```
    #[doc = include_str!("../examples/sun.txt")]
    /// use shadowfit::depth::ReceiverOffset;
    ///
    /// let moved = map.clip_from_world_with(&ReceiverOffset::world(0.05)?).project_point3(ground);
    /// let nearer = map.clip_from_world().project_point3(ground + 0.05 * sun.direction_from(ground));
    /// assert!((moved - nearer).length() < 1e-9); // tested as if it were 5 cm nearer to the sun
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn clip_from_world_with(&self, offset: &ReceiverOffset) -> DMat4 {
        matrix_from_rows(self.settings.clip().rows_from_wgpu(self.rows_with(offset)))
    }

    fn rows_with(&self, offset: &ReceiverOffset) -> [Plane; 4] {
        let [x, y, z, w] = self.rows;
        [x, y, offset.depth_row(z, w, self.light.homogeneous(), &self.along), w]
    }

    /// Depth as a linear function of world space, for maps whose shader writes depth itself: the distance along the map's
    /// axis, 0 at the first caster in the window and 1 at the last receiver (Kilgard 2000).
    ///
    /// For positions relative to the eye, the plane's offset is its value at the eye.
    ///
    /// ```
    #[doc = include_str!("../examples/spot.txt")]
    /// let depth = map.linear_depth();
    /// let middle = depth.at(floor + 2.0 * up) - depth.at(floor + up); // a step of a metre,
    /// let below = depth.at(floor + up) - depth.at(floor); // the same anywhere
    /// assert!((middle - below).abs() < 1e-12 && (0.0..=1.0).contains(&depth.at(floor)));
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[doc(alias = "distance map")]
    #[must_use]
    pub fn linear_depth(&self) -> Plane {
        self.along.linear_depth()
    }

    /// The point in world space that positions are relative to in the f32 matrices: subtract it in f64, then round to f32.
    ///
    /// ```
    #[doc = include_str!("../examples/sun.txt")]
    /// assert_eq!(map.origin(), DVec3::ZERO); // by default the world's
    /// let relative = focus.fit(&settings.with_origin(shadowfit::Origin::Eye)).into_map().expect("as before");
    /// let place = relative.receiver_matrix().project_point3((ground - relative.origin()).as_vec3());
    /// assert_eq!(relative.origin(), view.eye());
    /// assert!((place - map.receiver_matrix().project_point3(ground.as_vec3())).length() < 1e-4);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[doc(alias = "camera-relative rendering")]
    #[doc(alias = "floating origin")]
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

    /// The patch that one texel covers at a point in world space, across the light's ray, in world units; `None` outside
    /// of the map (w ≤ 0).
    ///
    /// ```
    #[doc = include_str!("../examples/sun.txt")]
    /// let texel = map.footprint(ground).expect("in the map");
    /// assert!(0.0 < texel.shortest() && texel.longest() < 0.1); // finer than 10 cm
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[doc(alias = "texel size")]
    #[must_use]
    pub fn footprint(&self, point: DVec3) -> Option<Footprint> {
        footprint(&self.rows, -self.light.direction_from(point), point, self.settings.sides())
    }

    /// Aliasing at a point in world space: the longer side of a texel's footprint over the side of a pixel, both across their
    /// rays. At 1 a texel is as large as a pixel; at 10 shadow edges are stairs of ten pixels. `None` outside of the map.
    ///
    /// On a surface a texel is stretched by 1/cos of the angle between its normal and the light, and a pixel by 1/cos of
    /// that between its normal and the view, so that on screen it is this times cos(view, normal)/cos(light, normal)
    /// (Stamminger & Drettakis 2002, §1.1; the words beside their formula call β the angle between light and normal, which
    /// contradicts it).
    ///
    /// ```
    #[doc = include_str!("../examples/sun.txt")]
    /// let aliasing = map.aliasing(ground).expect("in the map");
    /// let texel = map.footprint(ground).expect("in the map").longest();
    /// assert_eq!(aliasing, texel / map.pixel_size(ground));
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[doc(alias = "perspective aliasing")]
    #[must_use]
    pub fn aliasing(&self, point: DVec3) -> Option<f64> {
        let pixel = self.pixel_size(point);
        self.footprint(point).map(|texel| texel.longest() / pixel)
    }

    /// The side of a pixel at a point in world space, across the view axis, in world units.
    ///
    /// ```
    #[doc = include_str!("../examples/sun.txt")]
    /// let (near, far) = (map.pixel_size(ground), map.pixel_size(ground + 2.0 * (ground - view.eye())));
    /// assert!((far / near - 3.0).abs() < 1e-9); // it grows with view depth
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn pixel_size(&self, point: DVec3) -> f64 {
        self.view.pixel_size(point, self.settings.image_height())
    }

    /// The slopes of depth, across and down, on the plane through a point across `normal` (of any length): how much depth
    /// changes from one texel to the next, where the depth range is 1. Never negative, and the same all over the plane.
    ///
    /// `None` outside of the map and where the light sees the plane from its edge.
    ///
    /// ```
    #[doc = include_str!("../examples/sun.txt")]
    /// let slopes = map.depth_slopes(ground, up).expect("the sun is above the ground");
    /// assert!(slopes.min_element() >= 0.0 && slopes.max_element() < 0.01);
    /// assert!(map.depth_slopes(ground, sun.direction_from(ground).any_orthogonal_vector()).is_none_or(|edge| edge.length() > 1e6));
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn depth_slopes(&self, point: DVec3, normal: DVec3) -> Option<DVec2> {
        depth_slopes(&self.rows, point, normal, self.settings.sides())
    }

    /// The most that f32 changes the depth of a receiver at a point, in the matrix and in positions, where the depth range is
    /// 1: at most [`DepthSpan::rounding`], and no more than a constant over w.
    ///
    /// Next to a local light, where w is small, it is hundreds of times what it is on the receivers. A receiver before
    /// the near end of the range, as there are with lists of casters, may be off by its depth times that, and is lit.
    /// Infinite outside of the map.
    ///
    /// ```
    #[doc = include_str!("../examples/spot.txt")]
    /// let (on_floor, at_light) = (map.depth_rounding(floor), map.depth_rounding(floor + 3.9 * up));
    /// assert!(on_floor < at_light && at_light <= map.depth().rounding);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn depth_rounding(&self, point: DVec3) -> f64 {
        self.noise.depth.at(self.w_at(point))
    }

    /// The farthest that f32 moves a receiver at a point across the map, in texels: at most [`Window::rounding`], and no more
    /// than a constant over w. Infinite outside of the map.
    ///
    /// ```
    #[doc = include_str!("../examples/spot.txt")]
    /// assert!(map.place_rounding(floor) < 1.0 / 64.0 && map.place_rounding(floor) <= map.window().rounding);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn place_rounding(&self, point: DVec3) -> f64 {
        self.noise.place.at(self.w_at(point))
    }

    /// The part of the depth range of a local light, 0 to 1, that is spent on points closer to it than 1/16 of the farthest
    /// receiver's axial distance. 0 for a directional light.
    ///
    /// Depth is hyperbolic: with a near distance of a thousandth of the far one it is 0.985, and the receivers share the
    /// rest of the steps. Next to 1 it says that the near distance costs precision;
    /// [`Light::distance_to_casters`](crate::Light::distance_to_casters) says how large it may be.
    ///
    /// ```
    #[doc = include_str!("../examples/spot.txt")]
    /// assert!(map.depth_beside_light() > 0.9); // a near distance of a centimetre, and nothing casts there
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[doc(alias = "near plane")]
    #[must_use]
    pub fn depth_beside_light(&self) -> f64 {
        let DepthSpan { near, far, .. } = self.depth;
        if self.light.position().is_none() || near >= far {
            return 0.0;
        }
        let beside = (far * AWAY_FROM_LIGHT).clamp(near, far);
        (near.recip() - beside.recip()) / (near.recip() - far.recip())
    }

    /// The w that the matrices give a point in world space, but for rounding: positive in front of the light, and at most
    /// 1 at receivers.
    ///
    /// ```
    #[doc = include_str!("../examples/spot.txt")]
    /// assert!(map.w_at(floor + 3.0 * up) < map.w_at(floor) && map.w_at(floor) <= 1.0);
    /// assert!(map.w_at(floor + 9.0 * up) < 0.0); // behind the spot
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn w_at(&self, point: DVec3) -> f64 {
        self.rows[3].at(point)
    }

    /// The distance along the light's ray, in world units, that one step of a depth format makes at a point.
    ///
    /// Depth is z/w as a rasteriser stores it: hyperbolic along a ray wherever w changes along it, which is in every map
    /// but a directional light's uniform one. Infinite outside of the map.
    ///
    /// ```
    #[doc = include_str!("../examples/spot.txt")]
    /// let at = |point| map.depth_resolution(point, DepthFormat::Unorm24);
    /// assert!(at(floor + 3.0 * up) < at(floor)); // finer next to the light
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn depth_resolution(&self, point: DVec3, format: DepthFormat) -> f64 {
        let reversed = self.settings.clip().depth.is_reversed();
        depth_resolution(&self.rows, -self.light.direction_from(point), point, format, reversed)
    }

    /// The same where a shader stores [`Self::linear_depth`] instead: one distance for all steps of a fixed-point format
    /// along a ray, where hyperbolic depth has finer steps towards the light and coarser ones at the far end (Kilgard
    /// 2000).
    ///
    /// ```
    #[doc = include_str!("../examples/spot.txt")]
    /// let at = |point| map.linear_depth_resolution(point, DepthFormat::Unorm24);
    /// assert!((at(floor + up) / at(floor) - 1.0).abs() < 1e-9);
    /// assert!(at(floor) < map.depth_resolution(floor, DepthFormat::Unorm24));
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn linear_depth_resolution(&self, point: DVec3, format: DepthFormat) -> f64 {
        linear_depth_resolution(&self.linear_depth(), -self.light.direction_from(point), point, format)
    }

    /// The settings that the map was fitted with.
    #[must_use]
    pub const fn settings(&self) -> &Settings {
        &self.settings
    }

    /// The virtual camera whose perspective warps the map, with its back-shift (Stamminger & Drettakis 2002, §3).
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

    /// Why the map is uniform although another warp was asked for; `None` where it is what was asked for.
    #[must_use]
    pub const fn fallback(&self) -> Option<WarpFallback> {
        self.fallback
    }

    /// How strong the warp is: the ratio of the largest to the least w at receivers, over that of the uniform map. 1 for a
    /// uniform map.
    #[must_use]
    pub const fn warp_ratio(&self) -> f64 {
        self.warp_ratio
    }

    /// How much of the warp is left out: the part of w, on the ray in the middle, that is the uniform map's. 0 for the
    /// warp as it was proposed or found, 1 for no warp at all, and more where the paper's w is negative on that ray.
    ///
    /// A warp is weakened where f32 could not evaluate it, the more the larger the part of a texel that f32 takes in the
    /// uniform map. The best map is weakened also where less of a warp gives finer texels and a smaller bias at the
    /// receivers.
    #[must_use]
    pub const fn weakening(&self) -> f64 {
        self.weakening
    }

    /// Whether a receiver jumps by more than a 32nd of the map from the previous map to this one
    /// ([`Focus::fit_warm`](crate::Focus::fit_warm)), because the local minimum that the search stayed with is gone, or
    /// is worse than a closed form.
    #[must_use]
    pub const fn jumped(&self) -> bool {
        self.jumped
    }
}
