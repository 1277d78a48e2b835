//! The rounding of f32 in a paraboloid map.

use super::Paraboloid;
use glam::DVec3;

/// The farthest that f32 moves a point in a paraboloid map, in the matrix, in positions and in the shader
/// ([`Paraboloid::rounding`]).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ParaboloidRounding {
    /// Across the map, in texels; infinite where f32 cannot tell the point from the light, or from points without a place.
    #[cfg_attr(feature = "serde", serde(with = "crate::math::infinity"))]
    pub texels: f64,
    /// In depth, where the depth range is 1.
    pub depth: f64,
}

/// The unit roundoff of f32.
const UNIT: f64 = 1.0 / 16_777_216.0;

/// Roundings of a row of the matrix at a position, relative to the magnitudes of its terms: the coordinate and the entry
/// on the way in, a product, three sums, and two for terms of second order.
const ROW: f64 = 8.0 * UNIT;

/// The same in f64, for the entries of a matrix about an origin.
const ROW_F64: f64 = 32.0 * f64::EPSILON;

/// `length(v)`, relative: three roundings of a sum of squares, halved by the root, and the four and five that WGSL allows
/// the reciprocal root and the division that it lets a root be made of.
const LENGTH: f64 = 12.0 * UNIT;

/// Of (u, v), relative, after the sum of r and z: five that WGSL allows a division, the factor and the product.
const PLACE: f64 = 7.0 * UNIT;

/// Of depth, where it is 1 at most: turning it to another convention.
const TURN: f64 = 2.0 * UNIT;

/// Interpolation of the terms of a fragment's distance, relative: the division by the divisor, a few roundings of corners
/// up to twice as near, and the half dozen products and sums that the plane is made of.
const INTERPOLATION: f64 = 32.0 * UNIT;

/// A depth range is at least so many times as long as the rounding in it, as for frusta.
const QUIET: f64 = 1_048_576.0;

impl Paraboloid {
    /// The farthest that f32 moves a point of the map's hemisphere, or one behind its rim.
    ///
    /// With δ the rounding of q and h = r + z, all in world units: depth is off by δ, by the rounding of the length and
    /// by that of the near distance; (u, v) = q.xy/h by δ/h and by as much of itself as h is off, 2δ and the roundings of
    /// the length and of the sum.
    ///
    /// ```
    #[doc = include_str!("../../examples/room.txt")]
    /// let rounding = map.rounding(floor);
    /// assert!(rounding.texels < 0.01 && rounding.depth < 1e-5);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn rounding(&self, point: DVec3) -> ParaboloidRounding {
        let arm = self.local(point);
        let (distance, moved) = (arm.length(), self.moved(point));
        let reach = distance + arm.z;
        let of_reach = 2.0 * moved + LENGTH * distance + UNIT * reach;
        let place = self.project(point).map_or(f64::INFINITY, |place| place.truncate().length());
        // The error of h itself makes the quotient larger in turn.
        let left = reach - of_reach;
        let across = if left > 0.0 { (moved + place * of_reach) / left + PLACE * place } else { f64::INFINITY };
        ParaboloidRounding {
            texels: across * self.texels_per_unit(),
            depth: self.of_distance(point) / self.range() + TURN,
        }
    }

    /// The farthest that f32 moves points of the map's hemisphere, and depths that the rasteriser interpolates for a fragment
    /// shader, at distances from the light from `least` to `most`.
    pub(super) fn noise_between(&self, least: f64, most: f64) -> ParaboloidRounding {
        let moved = self.moved_within(least);
        // At the rim h is the distance, and no smaller elsewhere.
        let of_reach = 2.0 * moved + (LENGTH + 2.0 * UNIT) * least;
        let left = least - of_reach;
        let across = if left > 0.0 { (moved + of_reach) / left + PLACE } else { f64::INFINITY };
        let depth = self.moved_within(most) + (LENGTH + INTERPOLATION) * most + 2.0 * UNIT * (most + self.near);
        ParaboloidRounding { texels: across * self.texels_per_unit(), depth: depth / self.range() + TURN }
    }

    /// Rounding of q over points so near to the light.
    fn moved_within(&self, distance: f64) -> f64 {
        let origin = self.origin();
        let offset = (origin - self.position).abs();
        let of_row = |axis: DVec3| {
            let axis = axis.abs();
            ROW * (2.0 * axis.dot(offset) + distance) + ROW_F64 * axis.dot(origin.abs() + self.position.abs())
        };
        DVec3::from([self.x_axis, self.y_axis, self.axis].map(of_row)).length()
    }

    /// Rounding of r less the near distance, in world units.
    fn of_distance(&self, point: DVec3) -> f64 {
        // The length, the entry for the near distance, and the difference of the two.
        let distance = point.distance(self.position);
        self.moved(point) + LENGTH * distance + 2.0 * UNIT * (distance + self.near)
    }

    /// Rounding of q, in world units.
    fn moved(&self, point: DVec3) -> f64 {
        let origin = self.origin();
        let arm = (point - origin).abs();
        let of_row = |axis: DVec3| {
            let (axis, offset) = (axis.abs(), axis.dot(origin - self.position).abs());
            let cancelled = axis.dot(origin.abs() + self.position.abs());
            ROW * (axis.dot(arm) + offset) + ROW_F64 * cancelled
        };
        DVec3::from([self.x_axis, self.y_axis, self.axis].map(of_row)).length()
    }

    /// The same map with a depth range that holds, in f32, all receivers, and all casters no closer to the light than its
    /// near distance; no shorter than [`QUIET`] says.
    ///
    /// The rounding of a distance is convex over space, so that the vertices of R decide.
    pub(super) fn padded(self, visible: impl Iterator<Item = DVec3>) -> Self {
        let rounding = visible.map(|point| self.of_distance(point)).fold(0.0, f64::max);
        let near = self.near - (2.0 * rounding).min(0.5 * self.near);
        let far = (self.far + 2.0 * rounding).max(near + QUIET * rounding);
        Self { near, far, ..self }
    }
}
