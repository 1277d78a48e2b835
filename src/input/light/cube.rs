//! The faces of a cube around a light: several maps where one frustum cannot serve.

use crate::math::bounds::{least, most};
use glam::DVec3;

/// A face of the cube around a light at a position, in the order of the layers of a cube map.
///
/// ```text
///      0   1   2   3   4   5
///     +x  −x  +y  −y  +z  −z
/// ```
///
/// A face takes the directions **away** from the light that its axis is nearest to, the axis of the world with the
/// largest component. [`Light::cube_face`](crate::Light::cube_face) is the part of a light within one of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum CubeFace {
    /// +x.
    PositiveX,
    /// −x.
    NegativeX,
    /// +y.
    PositiveY,
    /// −y.
    NegativeY,
    /// +z.
    PositiveZ,
    /// −z.
    NegativeZ,
}

impl CubeFace {
    /// The six, in the order of the layers of a cube map.
    pub const ALL: [Self; 6] =
        [Self::PositiveX, Self::NegativeX, Self::PositiveY, Self::NegativeY, Self::PositiveZ, Self::NegativeZ];

    /// The largest overlap of neighbouring faces, see [`Light::cube_face`](crate::Light::cube_face): sides 63° from the
    /// axis.
    pub const MAX_OVERLAP: f64 = 1.0;

    /// The unit direction from the light through the middle of the face.
    #[must_use]
    pub const fn axis(self) -> DVec3 {
        match self {
            Self::PositiveX => DVec3::X,
            Self::NegativeX => DVec3::NEG_X,
            Self::PositiveY => DVec3::Y,
            Self::NegativeY => DVec3::NEG_Y,
            Self::PositiveZ => DVec3::Z,
            Self::NegativeZ => DVec3::NEG_Z,
        }
    }

    /// The face that a direction **away** from the light goes through, which need not be unit length. On a seam it is
    /// the first of the faces that meet there, and so it is for a direction without length.
    #[must_use]
    pub fn of(direction_from_light: DVec3) -> Self {
        let along = |face: Self| face.axis().dot(direction_from_light);
        Self::ALL.into_iter().fold(
            Self::PositiveX,
            |nearest, face| {
                if along(face) > along(nearest) { face } else { nearest }
            },
        )
    }

    /// The overlap of neighbouring faces with which a filter that reads `reach` texels to each side of a point finds, in
    /// the uniform map of the face that the point is in, all casters that it should: for
    /// [`Light::cube_face`](crate::Light::cube_face). Maps have `map_size` texels a side, or on the shorter one
    /// ([`Settings::map_size`](crate::Settings::map_size)), `border` of them around what is visible. At most
    /// [`Self::MAX_OVERLAP`], which falls short where a map has fewer than 40 texels for each of `reach`; 0 for a `reach`
    /// that is negative or no number.
    ///
    /// Let o be the overlap, r the reach, and n the texels within the border. What is visible in the widened face lies
    /// in a cone of tangent √2 (1 + o) around the face's axis, and no cone that holds it is narrower than the one whose
    /// axis is the map's. Its window is therefore at most 2√2 (1 + o) wide in tangents, and r texels across and r down
    /// are a step of at most
    ///
    /// ```text
    ///     √2 · r · 2√2 (1 + o) / n
    /// ```
    ///
    /// on a plane at distance 1, which turns a ray by no larger an angle. A ray in the face itself has at least 1/√3 of
    /// its length along the axis, and the sine of its angle to a widened side is at least
    ///
    /// ```text
    ///     o / (√3 √(1 + (1 + o)²))
    /// ```
    ///
    /// so that it stays inside for o ≥ 4√3 (r/n) (1 + o) √(1 + (1 + o)²). With x = 4√6 r/n that holds for o = x/(1 − 2x),
    /// up to o = 3/4; 4√6 is rounded up to 10 for the padding of the window.
    ///
    /// Of a map of a whole face, whose axis is the face's own, a fifth of this is enough. A warped map has no such bound:
    /// its texels are as wide as the warp makes them at the seam.
    #[must_use]
    pub fn overlap(reach: f64, map_size: u32, border: u32) -> f64 {
        let inner = f64::from(map_size) - 2.0 * f64::from(border);
        let reach = most(reach, 0.0);
        let room = inner - 20.0 * reach;
        if room > 0.0 { least(10.0 * reach / room, Self::MAX_OVERLAP) } else { Self::MAX_OVERLAP }
    }
}
