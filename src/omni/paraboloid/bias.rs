//! The bias of a paraboloid map, for casters in the shader and for receivers in the matrix.

use super::Paraboloid;
use crate::depth::bias::{DepthBias, GRID, LEAST_HEIGHT, checked_reach, stepped};
use crate::error::InputError;
use crate::map::quality::DepthFormat;
use crate::map::receiver_offset::ReceiverOffset;
use glam::{DMat4, DVec2, DVec3, Mat4, Vec2};

/// The bias covers the noise of places from this part of the far distance on. Nearer to the light a texel is smaller than
/// the rounding of positions in f32.
const QUIET_FROM: f64 = 1.0 / 64.0;

impl Paraboloid {
    /// The depth bias with which no plane has shadow acne in this map, for `shadowfit_paraboloid_depth`
    /// (`wgsl::PARABOLOID`), which adds it itself: a rasteriser's slopes are not those of the plane.
    ///
    /// `reach` is as for [`ShadowMap::bias`](crate::ShadowMap::bias). The shader takes [`DepthBias::in_shader`],
    /// receivers take [`Self::receiver_matrix_with`] with [`DepthBias::offset`]. The shader writes the farthest distance
    /// of the plane within the reach, so that half of the slope of a [`ShadowMap`](crate::ShadowMap) suffices.
    /// `docs/lights-all-around.md` has the derivation and what it assumes.
    ///
    /// # Errors
    ///
    /// Names `"reach"` when it is not finite, below 0.5 or above [`Settings::MAX_SIZE`](crate::Settings::MAX_SIZE).
    ///
    /// ```
    #[doc = include_str!("../../examples/room.txt")]
    /// let bias = map.bias(DepthFormat::Unorm24, Filter::Hardware2x2.reach())?;
    /// assert!(bias.slope_scale > 1.0 && bias.receiver > 0.0);
    /// assert!(map.bias(DepthFormat::Unorm24, 0.0).is_err());
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    pub fn bias(&self, format: DepthFormat, reach: f64) -> Result<DepthBias, InputError> {
        let reach = checked_reach(reach)?;
        let noise = self.noise_between(self.near.max(QUIET_FROM * self.far), self.far);
        let reach = reach + noise.texels;
        let corner = GRID + noise.texels;
        let height = LEAST_HEIGHT.max(8.0 * corner);
        let left = 1.0 - 4.0 * corner / height;
        // Of an error of a corner, at most so much is found at the receiver.
        let spread = (1.0 + 2.0 * core::f64::consts::SQRT_2 * reach / height) / left;
        let slope = reach + spread * corner;
        let receiver = noise.depth + spread * noise.depth;
        Ok(DepthBias {
            format,
            constant: 1,
            slope_scale: stepped(slope),
            receiver,
            relative: 0.0,
            most: receiver,
            places: noise.texels,
        })
    }

    /// The matrix to upload for testing receivers: [`Self::caster_matrix`] with a receiver offset in it.
    ///
    /// Depth is distance, so that every kind of offset is exact for all receivers: [`ReceiverOffset::world`] moves each
    /// by just that distance, [`ReceiverOffset::relative`] by just that part.
    ///
    /// ```
    #[doc = include_str!("../../examples/room.txt")]
    /// use shadowfit::depth::ReceiverOffset;
    ///
    /// let depth = |matrix: shadowfit::glam::Mat4| {
    ///     let q = matrix * floor.as_vec3().extend(1.0);
    ///     q.truncate().length() - q.w
    /// };
    /// let moved = depth(map.caster_matrix()) - depth(map.receiver_matrix_with(&ReceiverOffset::world(0.1)?));
    /// assert!((f64::from(moved) * (map.far() - map.near()) - 0.1).abs() < 1e-5);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn receiver_matrix_with(&self, offset: &ReceiverOffset) -> Mat4 {
        let (part, nearer) = offset.of_distance(self.range());
        // (u, v) do not change with the length of q. The last row holds the part that is taken off the distance.
        let mut matrix = DMat4::from_scale(DVec3::splat(part))
            * self.paraboloid_from_world()
            * DMat4::from_translation(self.origin());
        matrix.w_axis.w += nearer;
        matrix.as_mat4()
    }

    /// Peter-panning: how far behind a caster a receiver may be and still be lit, in world units along the light's ray
    /// through a point on the caster, on a plane across `normal` (of any length), where the ray goes through the middle
    /// of a texel. Infinite where no distance is so much larger.
    ///
    /// ```
    #[doc = include_str!("../../examples/room.txt")]
    /// let bias = map.bias(DepthFormat::Unorm24, 1.0)?;
    /// let gap = map.bias_distance(floor, up, &bias);
    /// assert!(0.0 < gap && gap < 0.1);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[doc(alias = "peter-panning")]
    #[must_use]
    pub fn bias_distance(&self, point: DVec3, normal: DVec3, bias: &DepthBias) -> f64 {
        let (distance, Some(slopes)) = (point.distance(self.position), self.distance_slopes(point, normal)) else {
            return f64::INFINITY;
        };
        let relative = f64::from(bias.slope_scale) * slopes.abs().element_sum() / distance;
        let stored = if relative < 1.0 { distance / (1.0 - relative) } else { f64::INFINITY };
        let unit = *bias.format.bias_unit(1.0).end();
        let added = f64::from(bias.constant) * unit + bias.receiver + bias.format.step(0.5);
        stored - distance + added * self.range()
    }

    /// The slopes of a plane's distance from the light at a point of it, in world units: the change to the next texel
    /// across and to the next one up. The normal may have any length. `None` where the light sees the plane from its edge
    /// or the map has no place for the point.
    ///
    /// ```
    #[doc = include_str!("../../examples/room.txt")]
    /// let below = floor.with_x(0.0).with_z(0.0); // where the light looks straight down
    /// assert!(map.distance_slopes(below, up).expect("a place").length() < 1e-12);
    /// assert!(map.distance_slopes(floor, up).expect("a place").length() > 1e-4);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn distance_slopes(&self, point: DVec3, normal: DVec3) -> Option<DVec2> {
        let texel = self.footprint(point)?;
        let ray = (point - self.position).normalize();
        let across = DVec2::new(normal.dot(texel.along_x), normal.dot(texel.along_y));
        let slopes = -across / normal.dot(ray);
        slopes.is_finite().then_some(slopes)
    }
}

impl DepthBias {
    /// The constant, as a depth, and the slope scale, as `shadowfit_paraboloid_depth` takes them
    /// (`wgsl::PARABOLOID`).
    ///
    /// ```
    #[doc = include_str!("../../examples/room.txt")]
    /// let bias = map.bias(DepthFormat::Unorm24, 1.0)?;
    /// assert!(bias.in_shader().x > 0.0);
    /// assert_eq!(bias.in_shader().y, bias.slope_scale);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn in_shader(&self) -> Vec2 {
        let unit = *self.format.bias_unit(1.0).end();
        Vec2::new((f64::from(self.constant) * unit) as f32, self.slope_scale)
    }
}
