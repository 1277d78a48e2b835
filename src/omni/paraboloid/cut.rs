//! How finely things must be cut for a paraboloid map, and what straight edges make of it.
//!
//! A rasteriser joins the places of two vertices by a straight line and interpolates depths along it, where the map of a
//! straight edge is an arc. With the vertices along the unit directions d₁, d₂ at the distances r₁, r₂, their places x₁, x₂
//! and factors λ₁ + λ₂ = 1:
//!
//! ```text
//!     cᵢ = 1 + |xᵢ|² = 2 / (1 + dᵢ.z)       cᵢ dᵢ = (2 xᵢ, 1 − |xᵢ|²)
//!     x  = Σ λᵢ xᵢ                           Σ λᵢ cᵢ dᵢ = (2x, 1 − |x|² − e)     with e = λ₁ λ₂ |x₁ − x₂|²
//! ```
//!
//! The right hand side is the direction of x but for e, and the left hand side is that of a point of the edge. So each
//! fragment has a point of the edge of its own, `Σ λᵢ cᵢ/rᵢ · pᵢ / Σ λᵢ cᵢ/rᵢ`, beside whose place it is drawn: in the
//! middle of an edge along the rim by 1 − cos(α/2), and nowhere in the hemisphere by more. And that point is at the
//! distance
//!
//! ```text
//!     |Σ λᵢ cᵢ dᵢ| / Σ λᵢ cᵢ  ·  Σ λᵢ cᵢ / Σ λᵢ gᵢ       with gᵢ = cᵢ/rᵢ = 2/hᵢ,  hᵢ = rᵢ (1 + dᵢ.z)
//! ```
//!
//! where Σ λᵢ rᵢ is drawn. The first quotient is from cos(α/2) to 1. The second is a harmonic mean of r₁ and r₂, and the
//! arithmetic one is above it by `λ₁ λ₂ (r₂ − r₁)(g₁ − g₂) / Σ λᵢ gᵢ`, whose extreme over λ is
//! `(r₂ − r₁)(√h₂ − √h₁) / (√h₂ + √h₁)`.

use super::Paraboloid;
use crate::math::angle;
use core::f64::consts::FRAC_PI_2;
use glam::{DVec2, DVec3};

impl Paraboloid {
    /// How far from its arc, at most, a straight edge is drawn that the light sees under an angle of so many radians: n/2 ·
    /// (1 − cos(angle/2)) texels, where the diameter of the disc is n.
    ///
    /// Each fragment of the edge is drawn no farther than that from the place of a point of the edge, for all points of the
    /// edge that are in the hemisphere, wherever its ends are. An edge along the rim gets there. Inside of a triangle of
    /// such edges it may be 4/3 of it: Σ λᵢλⱼ is at most 1/4 for two vertices and 1/3 for three.
    #[must_use]
    pub fn edge_error(&self, angle: f64) -> f64 {
        let (sine, _) = angle::sine_cosine(0.25 * angle);
        2.0 * sine * sine * self.texels_per_unit()
    }

    /// The angle in radians, seen from the light, that edges may have to be drawn at most so many texels from their arcs:
    /// the inverse of [`Self::edge_error`], but no more than a right angle, and 0 for an error that is not positive.
    #[must_use]
    pub fn largest_edge(&self, texels: f64) -> f64 {
        // sin²(π/8), for a right angle.
        const MOST: f64 = 0.146_446_609_406_726_24;
        let square = (0.5 * texels / self.texels_per_unit()).clamp(0.0, MOST);
        let [cosine, sine] = DVec2::new(1.0 - square, square).sqrt().to_array();
        if square > 0.0 { (4.0 * angle::of_vector(cosine, sine)).min(FRAC_PI_2) } else { 0.0 }
    }

    /// How far the depths that are drawn along a straight edge from `a` to `b`, both in the hemisphere, can be from those of
    /// the edge, in world units along the ray: what a bias must cover besides the map's own rounding.
    ///
    /// An edge that the light sees face on, under the angle α at the distance r, is drawn too far away by at most
    /// r (1 − cos(α/2)). Where its ends are at different distances, (r₂ − r₁)(√h₂ − √h₁)/(√h₂ + √h₁) is added, with h = r + z
    /// and z the distance along the axis; on a plane that the light grazes this is the larger part by far. It can be less
    /// than 0, too near, where h grows while r does not. Inside of a triangle of small such edges it may be 4/3 of that.
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
