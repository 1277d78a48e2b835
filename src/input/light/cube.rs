//! The faces of a cube around a light: six maps where one frustum does not suffice.

use crate::math::bounds::{least, most};
use glam::DVec3;

/// A face of the cube around a local light, in the order of the layers of a cube map.
///
/// ```text
///      0   1   2   3   4   5
///     +x  −x  +y  −y  +z  −z
/// ```
///
/// A face holds the directions **away** from the light whose largest component is along the face's axis.
/// [`Light::cube_face`](crate::Light::cube_face) is the part of a light within one of them.
#[doc(alias = "cubemap")]
#[doc(alias = "cube map")]
#[doc(alias = "omnidirectional shadow map")]
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
    /// All six faces, in the order of the layers of a cube map.
    pub const ALL: [Self; 6] =
        [Self::PositiveX, Self::NegativeX, Self::PositiveY, Self::NegativeY, Self::PositiveZ, Self::NegativeZ];

    /// The largest overlap of neighbouring faces, see [`Light::cube_face`](crate::Light::cube_face): sides 63° from the
    /// axis.
    pub const MAX_OVERLAP: f64 = 1.0;

    /// The unit direction from the light through the middle of the face, in world space.
    ///
    /// ```
    /// use shadowfit::omni::CubeFace;
    ///
    /// assert!(CubeFace::ALL.iter().all(|&face| CubeFace::of(face.axis()) == face));
    /// ```
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

    /// The face of a direction **away** from the light, of any length. On a seam, and for the zero vector, it is the first of the
    /// faces that meet there.
    ///
    /// ```
    /// use shadowfit::{glam::DVec3, omni::CubeFace};
    ///
    /// let (light, point) = (DVec3::new(0.0, 3.0, 0.0), DVec3::new(1.0, 0.0, -0.5));
    /// assert_eq!(CubeFace::of(point - light), CubeFace::NegativeY);
    /// ```
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

    /// The overlap that a filter needs across the seams of uniform maps: with it, a filter that reads `reach` texels to each side
    /// ([`Filter::reach`](crate::Filter::reach)) finds all casters in the map of the face that its point is in.
    ///
    /// `map_size` is that of the maps in texels, of the shorter side ([`Settings::map_size`](crate::Settings::map_size)), and
    /// `border` the texels around the receivers. At most [`Self::MAX_OVERLAP`], which falls short where a map has fewer than 40
    /// texels for each of `reach`; 0 for a `reach` that is negative or NaN. A warped map has no such bound: its texels at the seam
    /// are as wide as the warp makes them. Where each face is in view as a whole, a fifth suffices. `docs/lights-all-around.md` has
    /// the derivation.
    ///
    /// ```
    /// use shadowfit::{Filter, omni::CubeFace};
    ///
    /// let overlap = CubeFace::overlap(Filter::Pcf(5).reach(), 1024, 3);
    /// assert!(overlap > 0.02 && overlap < 0.03);
    /// assert_eq!(CubeFace::overlap(0.0, 1024, 3), 0.0);
    /// ```
    #[must_use]
    pub fn overlap(reach: f64, map_size: u32, border: u32) -> f64 {
        let inner = f64::from(map_size) - 2.0 * f64::from(border);
        let reach = most(reach, 0.0);
        let room = inner - 20.0 * reach;
        if room > 0.0 { least(10.0 * reach / room, Self::MAX_OVERLAP) } else { Self::MAX_OVERLAP }
    }
}
