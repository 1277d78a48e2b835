//! Paraboloid maps: one hemisphere of a point light in one map.

mod bias;
mod cut;
mod fit;
mod rounding;

pub use fit::Paraboloids;
pub use rounding::ParaboloidRounding;

use crate::convex::{Plane, matrix_from_rows};
use crate::input::clip_space::{TextureOrigin, YAxis};
use crate::input::light::Light;
use crate::input::view::View;
use crate::map::quality::{DepthFormat, Footprint};
use crate::settings::Settings;
use glam::{DMat4, DVec2, DVec3, Mat4, Vec2, Vec4};

/// A fitted paraboloid map: the hemisphere of a point light that its axis points into (Brabec, Annen & Seidel 2002, §3).
///
/// A ray from the light along the unit direction d, in the frame of the map with z along its axis, has the place
///
/// ```text
///     (u, v) = d.xy / (1 + d.z)              d = (2u, 2v, 1 − s) / (1 + s)     with s = u² + v²
/// ```
///
/// in the unit disc; the rim is where d.z = 0. Texels are square everywhere, and twice as wide in the middle as at the rim.
/// Depth is the distance from the light, linear from the near distance to the far one. The map of the other hemisphere is the
/// same with the axis turned, [`Self::opposite`].
///
/// # Drawing with it
///
/// The projection is no matrix, but all of it that differs from map to map is. The renderer uploads
/// [`Self::caster_matrix`], [`Self::clip_scale`] and [`Self::texture_scale`]; for each vertex
///
/// ```text
///     q        = matrix · (position, 1)
///     (u, v)   = q.xy / (|q.xyz| + q.z)
///     clip     = ((u, v) · clip_scale, 0, 1)
///     depth    = |q.xyz| − q.w
/// ```
///
/// The fragment shader writes the depth of the triangle's plane and discards fragments behind [`Self::clip_plane`]:
/// `wgsl::PARABOLOID` has both. Straight edges must be short enough for the arcs that they stand
/// for: [`Self::largest_edge`] says how short, [`Self::edge_error`] and [`Self::edge_depth_error`] what error is left.
///
/// ```
#[doc = include_str!("../../examples/room.txt")]
/// let q = map.caster_matrix() * floor.as_vec3().extend(1.0);
/// let place = q.truncate().truncate() / (q.truncate().length() + q.z);
/// assert!(place.length() < 1.0); // inside the disc: below the light
/// assert!((0.0..=1.0).contains(&(q.truncate().length() - q.w)));
///
/// assert_eq!((map.axis(), map.position()), (DVec3::NEG_Y, DVec3::new(0.0, 2.0, 0.0)));
/// assert!(map.near() < lamp.near() && map.far() > floor.distance(map.position()));
/// assert_eq!((map.light(), map.view(), map.settings().map_size()), (&lamp, &view, 512));
/// assert_eq!(map.origin(), DVec3::ZERO);
/// # Ok::<(), shadowfit::InputError>(())
/// ```
///
/// # Guarantees
///
/// With points of R at least the light's near distance from the light:
///
/// - a point of R is inside the disc of the map whose hemisphere it is in, to rounding, and its depth, evaluated in f32,
///   is from 0 to 1. As for [`ShadowMap`](crate::ShadowMap) there is an exception: a light so far from the origin that f32
///   cannot tell its near distance is served from where it can;
/// - points on a ray from the light share their (u, v), and depth grows away from the light.
#[doc(alias = "DPSM")]
#[doc(alias = "dual paraboloid")]
#[doc(alias = "omnidirectional shadow")]
#[doc(alias = "hemisphere map")]
#[derive(Clone, Debug, PartialEq)]
pub struct Paraboloid {
    position: DVec3,
    x_axis: DVec3,
    y_axis: DVec3,
    axis: DVec3,
    near: f64,
    far: f64,
    view: View,
    light: Light,
    settings: Settings,
}

impl Paraboloid {
    /// The matrix to upload for drawing casters: from a position relative to [`Self::origin`] to `q = (direction · r,
    /// near) / (far − near)`, with r the distance from the light and the direction in the frame of the map.
    ///
    /// ```
    #[doc = include_str!("../../examples/room.txt")]
    /// let q = map.caster_matrix() * floor.as_vec3().extend(1.0);
    /// let depth = q.truncate().length() - q.w;
    /// assert!((f64::from(depth) - map.project(floor).expect("below the light").z).abs() < 1e-6);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn caster_matrix(&self) -> Mat4 {
        (self.paraboloid_from_world() * DMat4::from_translation(self.origin())).as_mat4()
    }

    /// World space to q in f64: [`Self::caster_matrix`] before it is rounded.
    ///
    /// ```
    #[doc = include_str!("../../examples/room.txt")]
    /// let q = map.paraboloid_from_world() * floor.extend(1.0);
    /// let rounded = map.caster_matrix() * floor.as_vec3().extend(1.0);
    /// assert!((q - rounded.as_dvec4()).length() < 1e-6);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn paraboloid_from_world(&self) -> DMat4 {
        let scale = self.range().recip();
        let [x, y, z] =
            [self.x_axis, self.y_axis, self.axis].map(|axis| Plane::through(axis, self.position) * scale);
        matrix_from_rows([x, y, z, Plane::ONE * (self.near * scale)])
    }

    /// The factors from (u, v) to x and y of clip space in the convention of the settings.
    ///
    /// They leave room for the border of the settings around the disc, and cannot be part of the matrix, because the length
    /// of q must be the same all around.
    ///
    /// ```
    #[doc = include_str!("../../examples/room.txt")]
    /// let inner = 510.0 / 512.0; // a border of one texel on each side
    /// assert_eq!(map.clip_scale(), Vec2::splat(inner));
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn clip_scale(&self) -> Vec2 {
        let inner = self.settings.inner().x as f32;
        Vec2::new(inner, if self.settings.clip().y == YAxis::Up { inner } else { -inner })
    }

    /// The numbers from (u, v) and depth to texture space: factors for x and y, to which ½ is added, and a factor and a
    /// summand that give the depth that the depth buffer holds.
    ///
    /// ```
    #[doc = include_str!("../../examples/room.txt")]
    /// let scale = map.texture_scale();
    /// assert_eq!((scale.x, scale.y), (255.0 / 512.0, -255.0 / 512.0)); // wgpu's rows go down
    /// assert_eq!((scale.z, scale.w), (1.0, 0.0)); // depth as it is
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn texture_scale(&self) -> Vec4 {
        let (clip, half) = (self.settings.clip(), 0.5 * self.settings.inner().x as f32);
        // Only OpenGL stores the bottom row first while y points up.
        let up = (clip.y, clip.texture_origin) == (YAxis::Up, TextureOrigin::BottomLeft);
        let (factor, summand) = if clip.depth.is_reversed() { (-1.0, 1.0) } else { (1.0, 0.0) };
        Vec4::new(half, if up { half } else { -half }, factor, summand)
    }

    /// The place (u, v, depth) of a point: (u, v) in the unit disc for the map's own hemisphere and outside of it for the
    /// other, depth 0 at the near distance and 1 at the far one.
    ///
    /// `None` where there is no direction or no place for it: at the light, and straight behind it.
    ///
    /// ```
    #[doc = include_str!("../../examples/room.txt")]
    /// let place = map.project(floor).expect("below the light");
    /// assert!(place.truncate().length() < 1.0 && (0.0..=1.0).contains(&place.z));
    /// assert_eq!(map.project(map.position()), None);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn project(&self, point: DVec3) -> Option<DVec3> {
        let arm = self.local(point);
        let distance = arm.length();
        // r + z cancels behind the light. There (r + z)(r − z) = x² + y² does not.
        let reach =
            if arm.z >= 0.0 { distance + arm.z } else { arm.truncate().length_squared() / (distance - arm.z) };
        let place = arm.truncate() / reach;
        (reach > 0.0 && place.is_finite()).then(|| place.extend((distance - self.near) / self.range()))
    }

    /// The point in world space at a place (u, v, depth) of the map, the inverse of [`Self::project`].
    ///
    /// In the frame of the map the two undo each other to a few roundings of the distance in any direction that has a
    /// place, also straight behind the light as nearly as numbers go; in the world, to the rounding of its coordinates.
    ///
    /// ```
    #[doc = include_str!("../../examples/room.txt")]
    /// let place = map.project(floor).expect("below the light");
    /// assert!(map.unproject(place).distance(floor) < 1e-12);
    /// assert!(map.unproject(DVec3::ZERO).distance(map.position() + map.near() * map.axis()) < 1e-12);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn unproject(&self, place: DVec3) -> DVec3 {
        let (across, distance) = (place.truncate(), self.near + place.z * self.range());
        let square = across.length_squared();
        // Divided by s where s is large, so that it may even be infinite.
        let direction = if square <= 1.0 {
            (across * 2.0).extend(1.0 - square) / (1.0 + square)
        } else {
            let part = square.recip();
            (across * (2.0 * part)).extend(part - 1.0) / (part + 1.0)
        };
        self.position + self.in_world(direction) * distance
    }

    /// The plane through the light that bounds the hemisphere, in world space; its normal is the axis. Casters wholly
    /// behind it need not be drawn.
    ///
    /// ```
    #[doc = include_str!("../../examples/room.txt")]
    /// assert!(map.clip_plane().at(floor) > 0.0 && map.clip_plane().at(floor + 3.0 * up) < 0.0);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn clip_plane(&self) -> Plane {
        Plane::through(self.axis, self.position)
    }

    /// The map of the other hemisphere, with the same depths: turned about the frame's y axis by half a turn.
    ///
    /// ```
    #[doc = include_str!("../../examples/room.txt")]
    /// assert_eq!(map.opposite(), other);
    /// assert_eq!(other.axis(), -map.axis());
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn opposite(&self) -> Self {
        Self { x_axis: -self.x_axis, axis: -self.axis, ..*self }
    }

    /// The patch that one texel covers at a point, across the light's ray: a square, seen from the light under the angle
    /// `2 (1 + d.z) / n` where the diameter of the disc is n texels. `None` where [`Self::project`] has no place.
    ///
    /// ```
    #[doc = include_str!("../../examples/room.txt")]
    /// let texel = map.footprint(floor).expect("below the light");
    /// assert!((texel.longest() / texel.shortest() - 1.0).abs() < 1e-12);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn footprint(&self, point: DVec3) -> Option<Footprint> {
        let place = self.project(point)?.truncate();
        let arm = self.local(point);
        let distance = arm.length();
        let direction = arm / distance;
        // The derivative of d by u is (1 + d.z) times the unit vector (1, 0, −u) − u d, and of v likewise.
        let texel = distance * (1.0 + direction.z) / self.texels_per_unit();
        let [along_x, along_y] = [DVec3::new(1.0, 0.0, -place.x), DVec3::new(0.0, 1.0, -place.y)];
        Some(Footprint {
            along_x: self.in_world(along_x - direction * place.x) * texel,
            along_y: self.in_world(along_y - direction * place.y) * texel,
        })
    }

    /// Aliasing at a point: the side of a texel's footprint over the side of a pixel, as for
    /// [`ShadowMap::aliasing`](crate::ShadowMap::aliasing).
    ///
    /// ```
    #[doc = include_str!("../../examples/room.txt")]
    /// let texel = map.footprint(floor).expect("below the light").longest();
    /// assert_eq!(map.aliasing(floor), Some(texel / map.pixel_size(floor)));
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn aliasing(&self, point: DVec3) -> Option<f64> {
        let pixel = self.pixel_size(point);
        self.footprint(point).map(|texel| texel.longest() / pixel)
    }

    /// The side of a pixel at a point in world space, across the view axis, in world units.
    ///
    /// ```
    #[doc = include_str!("../../examples/room.txt")]
    /// assert!(map.pixel_size(floor) < map.pixel_size(floor - 2.0 * DVec3::Z)); // farther from the eye
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn pixel_size(&self, point: DVec3) -> f64 {
        self.view.pixel_size(point, self.settings.image_height())
    }

    /// The distance along the light's ray, in world units, that one step of a depth format makes at a point.
    ///
    /// ```
    #[doc = include_str!("../../examples/room.txt")]
    /// let step = map.depth_resolution(floor, DepthFormat::Unorm16);
    /// assert!((step - (map.far() - map.near()) / 65_535.0).abs() < 1e-12); // the same everywhere
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn depth_resolution(&self, point: DVec3, format: DepthFormat) -> f64 {
        let depth = (point.distance(self.position) - self.near) / self.range();
        let stored = if self.settings.clip().depth.is_reversed() { 1.0 - depth } else { depth };
        format.step(stored) * self.range()
    }

    /// The distance from the light where depth is 0, in world units: the light's near distance, less room for the rounding of
    /// f32.
    #[must_use]
    pub const fn near(&self) -> f64 {
        self.near
    }

    /// The distance from the light where depth is 1, in world units: that of the farthest point of R, and padding.
    #[must_use]
    pub const fn far(&self) -> f64 {
        self.far
    }

    /// The unit direction, away from the light, to the middle of the hemisphere.
    #[must_use]
    pub const fn axis(&self) -> DVec3 {
        self.axis
    }

    /// The position of the light in world space.
    #[must_use]
    pub const fn position(&self) -> DVec3 {
        self.position
    }

    /// The settings the map was fitted with. Warp and shift do not apply to a paraboloid map, and it is square: of
    /// settings that are not, only the shorter side is used ([`Settings::map_size`]).
    #[must_use]
    pub const fn settings(&self) -> &Settings {
        &self.settings
    }

    /// The light the map was fitted for.
    #[must_use]
    pub const fn light(&self) -> &Light {
        &self.light
    }

    /// The view the map was fitted for.
    #[must_use]
    pub const fn view(&self) -> &View {
        &self.view
    }

    fn range(&self) -> f64 {
        self.far - self.near
    }

    /// The point that positions are relative to in the f32 matrix, see [`ShadowMap::origin`](crate::ShadowMap::origin).
    #[must_use]
    pub fn origin(&self) -> DVec3 {
        self.settings.origin().of(&self.view, &self.light)
    }

    /// Texels for a step of 1 in u or v.
    fn texels_per_unit(&self) -> f64 {
        0.5 * f64::from(self.settings.map_size()) * self.settings.inner().x
    }

    /// A point in the frame of the map, the light in the middle.
    fn local(&self, point: DVec3) -> DVec3 {
        let arm = point - self.position;
        let across = DVec2::new(self.x_axis.dot(arm), self.y_axis.dot(arm));
        across.extend(self.axis.dot(arm))
    }

    /// A direction out of the frame of the map.
    fn in_world(&self, direction: DVec3) -> DVec3 {
        self.x_axis * direction.x + self.y_axis * direction.y + self.axis * direction.z
    }
}
