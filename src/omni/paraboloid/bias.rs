//! The bias that a paraboloid map needs, and receivers moved towards the light.

use super::Paraboloid;
use crate::depth::bias::{DepthBias, GRID, LEAST_HEIGHT, checked_reach, stepped};
use crate::error::InputError;
use crate::map::quality::DepthFormat;
use crate::map::receiver_offset::ReceiverOffset;
use glam::{DMat4, DVec2, DVec3, Mat4, Vec2};

/// Places are as noisy as the bias says from this part of the far distance on. Nearer to the light a texel is smaller than
/// what f32 knows of positions.
const QUIET_FROM: f64 = 1.0 / 64.0;

impl Paraboloid {
    /// The bias with which no plane shadows itself in this map, for `shadowfit_paraboloid_depth`
    /// ([`wgsl::PARABOLOID`](crate::wgsl::PARABOLOID)), which adds it itself. A rasteriser cannot: the depths that it knows
    /// are not those of the plane.
    ///
    /// `reach` is as for [`ShadowMap::bias`](crate::ShadowMap::bias). The shader takes [`DepthBias::in_shader`], receivers take
    /// [`Self::receiver_matrix_with`] with [`DepthBias::offset`].
    ///
    /// # Derivation
    ///
    /// The plane n · x = 1, the light in the middle, is met along the unit direction d at the distance 1/(n · d). In the map
    /// n · d is not affine, but nearly so: with ω = 1/k, k texels to a unit of (u, v), the second derivative of d along any
    /// direction is at most 4 ω² a square texel. Over places R no farther than r from T, across and down,
    ///
    /// ```text
    ///     n·d(R) ≥ n·d(T) − r (|n·dₓ| + |n·dᵧ|) − 4 r² ω² |n|
    /// ```
    ///
    /// and what the shader writes is 1 over the right hand side: **the farthest distance of the plane within the reach**, and
    /// no less than any receiver's, also where the light grazes the plane and slopes alone would say nothing. For this the
    /// slope multiplies the sum of the changes across and down, where a rasteriser's multiplies the larger one, and it is
    /// half of what [`ShadowMap::bias`](crate::ShadowMap::bias) would give.
    ///
    /// That leaves rounding, as derived for [`DepthBias`]: corners of the triangle are off by s = t + 1/256 texels across and
    /// by ε in depth, and of that k = 1 + 2√2 r/h, of 1 − 4 s/h, is found at the receiver. The slope is r + k s/(1 − 4 s/h).
    /// ε is that of the receiver and of the corners, and of the interpolation of what the shader takes, for triangles whose
    /// corners are no more than twice as far from the light as each other.
    ///
    /// # What it takes for granted
    ///
    /// - t is that of places no nearer to the light than a 64th of the far distance, nor than its near distance; nearer, f32 may
    ///   be coarser than that.
    /// - h is a texel, or eight times s where that is more.
    /// - It is about planes, as for [`DepthBias`].
    ///
    /// # Errors
    ///
    /// Names `"reach"` when it is not finite, below 0.5 or above [`Settings::MAX_SIZE`](crate::Settings::MAX_SIZE).
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

    /// The matrix for receivers: [`Self::caster_matrix`] with an offset in it.
    ///
    /// Depth is distance, so that every kind of offset is exactly what it says, for all receivers:
    /// [`ReceiverOffset::world`] moves each by just that distance, [`ReceiverOffset::relative`] by just that part.
    #[must_use]
    pub fn receiver_matrix_with(&self, offset: &ReceiverOffset) -> Mat4 {
        let (part, nearer) = offset.of_distance(self.range());
        // (u, v) do not change with the length of q. The last row holds what is taken off the distance.
        let mut matrix = DMat4::from_scale(DVec3::splat(part))
            * self.paraboloid_from_world()
            * DMat4::from_translation(self.origin());
        matrix.w_axis.w += nearer;
        matrix.as_mat4()
    }

    /// How far behind a caster a receiver may be and still be lit, in world units along the ray through a point on the
    /// caster: what the bias costs, on a plane across `normal` (of any length), where the ray goes through the middle of a
    /// texel. Infinite where no distance is so much larger.
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

    /// How much the distance of a plane from the light changes, at a point of it, to the next texel across and to the next
    /// one up, in world units; the normal may have any length. `None` where the light sees the plane from its edge or the
    /// map has no place for the point.
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
    /// The constant, as a depth, and the slope: what `shadowfit_paraboloid_depth` takes
    /// ([`wgsl::PARABOLOID`](crate::wgsl::PARABOLOID)).
    #[must_use]
    pub fn in_shader(&self) -> Vec2 {
        let unit = *self.format.bias_unit(1.0).end();
        Vec2::new((f64::from(self.constant) * unit) as f32, self.slope_scale)
    }
}
