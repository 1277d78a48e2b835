//! What a matrix resolves: texel footprints, slopes of depth and depth resolution.

use crate::convex::Plane;
use core::ops::RangeInclusive;
use glam::{DVec2, DVec3};

/// The patch that one texel covers at a point: a parallelogram across the light's ray
/// ([`ShadowMap::footprint`](crate::ShadowMap::footprint)).
///
/// ```
/// use shadowfit::{glam::DVec3, map::Footprint};
///
/// let texel = Footprint { along_x: DVec3::new(0.2, 0.0, 0.0), along_y: DVec3::new(0.0, 0.0, 0.1) };
/// assert!((texel.longest() - 0.2).abs() < 1e-15 && (texel.shortest() - 0.1).abs() < 1e-15);
/// assert!((texel.area() - 0.02).abs() < 1e-15);
/// ```
#[doc(alias = "texel")]
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Footprint {
    /// The step in world space, across the ray, from a texel to the next one in x.
    pub along_x: DVec3,
    /// The step to the next one in y.
    pub along_y: DVec3,
}

impl Footprint {
    /// The area in square world units.
    #[must_use]
    pub fn area(&self) -> f64 {
        self.along_x.cross(self.along_y).length()
    }

    /// The side of the footprint where it is longest, in world units: the larger singular value of (along x, along y),
    /// which is twice the longer semi-axis of the ellipse that the map makes of a texel's inscribed circle.
    #[must_use]
    pub fn longest(&self) -> f64 {
        self.singular_values().0
    }

    /// The side where it is shortest, in world units: the smaller singular value.
    #[must_use]
    pub fn shortest(&self) -> f64 {
        self.singular_values().1
    }

    fn singular_values(&self) -> (f64, f64) {
        // With y turned by 90° in the plane, σ₁ ± σ₂ = |x ∓ turned|.
        let turned = self.along_x.cross(self.along_y).normalize_or_zero().cross(self.along_y);
        let (sum, difference) = ((self.along_x - turned).length(), (self.along_x + turned).length());
        let longest = 0.5 * (sum + difference);
        // Not half of the difference of the two, which cancels.
        (longest, if longest > 0.0 { self.area() / longest } else { 0.0 })
    }
}

/// The format of a depth buffer, which decides how finely depth is resolved.
#[doc(alias = "Depth24Plus")]
#[doc(alias = "Depth32Float")]
#[doc(alias = "Depth16Unorm")]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum DepthFormat {
    /// 8-bit unsigned normalised: 255 equal steps from 0 to 1. No card has depth buffers of it; a colour channel holds it, in
    /// maps that a shader writes (Brabec, Annen & Seidel 2002; Kilgard 2000 for cards without depth textures).
    Unorm8,
    /// 16-bit unsigned normalised: 65,535 equal steps from 0 to 1.
    Unorm16,
    /// 24-bit unsigned normalised: 16,777,215 equal steps from 0 to 1.
    Unorm24,
    /// 32-bit float: steps that grow with the value, at most 2⁻²⁴ below 1.
    Float32,
}

impl DepthFormat {
    /// The step from a depth in [0, 1] to the next larger one that the format holds.
    ///
    /// ```
    /// use shadowfit::DepthFormat;
    ///
    /// assert_eq!(DepthFormat::Unorm16.step(0.5), 1.0 / 65_535.0);
    /// assert!(DepthFormat::Float32.step(0.01) < DepthFormat::Float32.step(0.9));
    /// ```
    #[must_use]
    pub fn step(self, value: f64) -> f64 {
        match self {
            Self::Unorm8 => 1.0 / 255.0,
            Self::Unorm16 => 1.0 / 65_535.0,
            Self::Unorm24 => 1.0 / 16_777_215.0,
            Self::Float32 => {
                let value = value.clamp(0.0, 1.0) as f32;
                f64::from(value.next_up()) - f64::from(value)
            }
        }
    }

    /// The depth of one unit of constant bias, at least and at most, in a triangle whose largest depth as stored is
    /// `largest`: r of wgpu, Vulkan and `glPolygonOffset`, a `DepthBias` of 1 in Direct3D.
    ///
    /// In fixed point of n bits a unit is 2⁻ⁿ in Direct3D, a hair less than a step of the format, and a Vulkan driver may
    /// take twice that (Mesa's software driver takes two steps). In floating point it is 2^(e − 23) with e the exponent
    /// of `largest`: below 1, where depth is stored, at most 2⁻²⁴, and next to nothing near 0.
    ///
    /// ```
    /// use shadowfit::DepthFormat;
    ///
    /// let unit = DepthFormat::Float32.bias_unit(0.75); // the exponent of 0.75 is −1
    /// assert_eq!(*unit.end(), 0.5_f64.powi(24));
    /// assert!(DepthFormat::Unorm24.bias_unit(0.75).contains(&DepthFormat::Unorm24.step(0.75)));
    /// ```
    #[must_use]
    pub fn bias_unit(self, largest: f64) -> RangeInclusive<f64> {
        let fixed = |values: f64| values.recip()..=2.0 * self.step(1.0);
        match self {
            Self::Unorm8 => fixed(256.0),
            Self::Unorm16 => fixed(65_536.0),
            Self::Unorm24 => fixed(16_777_216.0),
            Self::Float32 => {
                // Without sign and mantissa a number is the power of two below it.
                let power = f32::from_bits((largest.max(0.0) as f32).to_bits() & 0x7f80_0000);
                let unit = f64::from(power) / 8_388_608.0;
                unit..=unit
            }
        }
    }
}

/// The footprint at a point of a texel of a map of so many texels across and down, for a unit ray away from the light.
pub(crate) fn footprint(rows: &[Plane; 4], ray: DVec3, point: DVec3, sides: DVec2) -> Option<Footprint> {
    let [x, y, _, w] = rows;
    let at = w.at(point);
    if at <= 0.0 || at.is_nan() {
        return None;
    }
    // Both gradients vanish along the ray, so that two vectors across it invert them.
    let (x, y) = (gradient(x, w, point), gradient(y, w, point));
    let (along_x, along_y) = (y.cross(ray), ray.cross(x));
    // Clip space is two units wide.
    let texel = 2.0 / sides / x.dot(along_x);
    Some(Footprint { along_x: along_x * texel.x, along_y: along_y * texel.y })
}

/// The gradient of `row`/`w` at a point.
fn gradient(row: &Plane, w: &Plane, point: DVec3) -> DVec3 {
    let at = w.at(point);
    (row.normal - w.normal * (row.at(point) / at)) / at
}

/// How much depth changes on the plane through a point across `normal` from a texel to the next one across and to the
/// next one up, in a map of so many texels across and down, never negative; `None` outside of the map and where the light
/// sees the plane from its edge.
pub(crate) fn depth_slopes(rows: &[Plane; 4], point: DVec3, normal: DVec3, sides: DVec2) -> Option<DVec2> {
    let [x, y, z, w] = rows;
    let at = w.at(point);
    if at <= 0.0 || at.is_nan() {
        return None;
    }
    let (x, y, z) = (gradient(x, w, point), gradient(y, w, point), gradient(z, w, point));
    // The steps on the plane that change one of x/w and y/w by one and leave the other.
    let volume = x.dot(y.cross(normal));
    let (along_x, along_y) = (y.cross(normal) / volume, normal.cross(x) / volume);
    // Clip space is two units wide.
    let slopes = DVec2::new(z.dot(along_x), z.dot(along_y)).abs() * (2.0 / sides);
    slopes.is_finite().then_some(slopes)
}

/// The distance along a unit ray away from the light that one step of a depth format makes at a point; infinite
/// outside of the map.
pub(crate) fn depth_resolution(
    rows: &[Plane; 4],
    ray: DVec3,
    point: DVec3,
    format: DepthFormat,
    reversed: bool,
) -> f64 {
    let [_, _, z, w] = rows;
    let at = w.at(point);
    let depth = z.at(point) / at;
    let slope = (z.normal - w.normal * depth).dot(ray) / at;
    let stored = if reversed { 1.0 - depth } else { depth };
    if at > 0.0 { format.step(stored) / slope } else { f64::INFINITY }
}

/// The same for a depth that is linear in world space.
pub(crate) fn linear_depth_resolution(linear: &Plane, ray: DVec3, point: DVec3, format: DepthFormat) -> f64 {
    let slope = linear.normal.dot(ray);
    if slope > 0.0 { format.step(linear.at(point)) / slope } else { f64::INFINITY }
}
