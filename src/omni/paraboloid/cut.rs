//! How finely meshes must be cut for a paraboloid map, and the errors that straight edges make.
//!
//! A rasteriser joins the places of two vertices by a straight line, where the map of a straight edge is an arc, and
//! interpolates depth along it. `docs/lights-all-around.md` derives both errors: each fragment belongs to a point of the edge
//! beside whose place it is drawn, and at another distance than the one interpolated.

use super::Paraboloid;
use crate::math::angle;
use core::f64::consts::FRAC_PI_2;
use glam::{DVec2, DVec3};

impl Paraboloid {
    /// The farthest, in texels, that a straight edge is drawn from its arc, if the light sees the edge under an angle in
    /// radians: n/2 · (1 − cos(angle/2)), with n the diameter of the disc in texels.
    ///
    /// Each fragment of the edge is drawn no farther than that from the place of a point of the edge, for all points of the
    /// edge that are in the hemisphere, wherever its ends are. An edge along the rim gets there. Inside of a triangle of
    /// such edges it may be 4/3 of it: Σ λᵢλⱼ is at most 1/4 for two vertices and 1/3 for three.
    ///
    /// ```
    #[doc = include_str!("../../examples/room.txt")]
    /// assert!(map.edge_error(0.1) < map.edge_error(0.2));
    /// assert!((map.edge_error(map.largest_edge(0.5)) - 0.5).abs() < 1e-9);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn edge_error(&self, angle: f64) -> f64 {
        let (sine, _) = angle::sine_cosine(0.25 * angle);
        2.0 * sine * sine * self.texels_per_unit()
    }

    /// The angle in radians, seen from the light, under which edges are drawn at most so many texels from their arcs:
    /// the inverse of [`Self::edge_error`], but no more than a right angle, and 0 for an error that is not positive.
    ///
    /// ```
    #[doc = include_str!("../../examples/room.txt")]
    /// let angle = map.largest_edge(0.5); // half a texel
    /// assert!((0.1..0.2).contains(&angle)); // for a `Tessellator`
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn largest_edge(&self, texels: f64) -> f64 {
        // sin²(π/8), for a right angle.
        const MOST: f64 = 0.146_446_609_406_726_24;
        let square = (0.5 * texels / self.texels_per_unit()).clamp(0.0, MOST);
        let [cosine, sine] = DVec2::new(1.0 - square, square).sqrt().to_array();
        if square > 0.0 { (4.0 * angle::of_vector(cosine, sine)).min(FRAC_PI_2) } else { 0.0 }
    }

    /// The largest error of depth along a straight edge from `a` to `b`, both in the hemisphere, in world units along the
    /// ray: what a bias must cover besides the map's own rounding where depth is left to the rasteriser.
    ///
    /// An edge that the light sees face on, under the angle α at the distance r, is drawn too far away by at most
    /// r (1 − cos(α/2)). Where its ends are at different distances, (r₂ − r₁)(√h₂ − √h₁)/(√h₂ + √h₁) is added, with h = r + z
    /// and z the distance along the axis; on a plane that the light grazes this is the larger part by far. It can be less
    /// than 0, too near, where h grows while r does not. Inside of a triangle of small such edges it may be 4/3 of that.
    ///
    /// ```
    #[doc = include_str!("../../examples/room.txt")]
    /// let (short, long) = (floor + 0.1 * DVec3::X, floor + DVec3::X);
    /// assert!(map.edge_depth_error(floor, short) < map.edge_depth_error(floor, long));
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn edge_depth_error(&self, a: DVec3, b: DVec3) -> f64 {
        let (a, b) = (self.local(a), self.local(b));
        let (near, far) = (a.length(), b.length());
        // 1 − cos(α/2) from sin(α/2), which does not cancel.
        let half = 0.5 * (a.normalize_or_zero() - b.normalize_or_zero()).length();
        let square = (half * half).min(1.0);
        let roots = DVec3::new(near + a.z, far + b.z, 1.0 - square).max(DVec3::ZERO).sqrt();
        let sum = roots.x + roots.y;
        let uneven: f64 = if sum > 0.0 { (far - near) * (roots.y - roots.x) / sum } else { 0.0 };
        uneven.abs() + near.max(far) * square / (1.0 + roots.z)
    }
}
