//! The reasons for a plan's choices.

use core::fmt;

/// The reason for one choice of a plan, in words by `Display`.
///
/// ```
/// use shadowfit::plan::Reason;
///
/// assert_eq!(Reason::AllSolid.to_string(), "second depth, no bias: every caster is watertight");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Reason {
    /// No map: no receiver is in view and lit.
    NoReceivers,
    /// No map: nothing casts on a receiver.
    NoCasters,
    /// One uniform map: it is fine enough.
    UniformEnough,
    /// One uniform map: the settings ask for no warp.
    NoWarpWanted,
    /// One uniform map: a warp would be no better, or not enough so. Its error at the surfaces in view would be so many times as
    /// large.
    WarpNoFiner(f64),
    /// One warped map: its error at the surfaces in view, texels and bias ([`SurfaceError`](crate::map::SurfaceError)), is so many
    /// times the uniform map's (less than 1).
    WarpFiner(f64),
    /// The warp's camera is moved back: without, texels would be so many times as large.
    ShiftFiner(f64),
    /// The warp's camera is not moved back: with that, texels would be so many times as large.
    NoShiftFiner(f64),
    /// No single frustum: the light stands among its receivers.
    Surrounded,
    /// No frustum, though one would hold all receivers: it is so wide that its worst texel would be so many times as large.
    WideFrustum(f64),
    /// One paraboloid: one hemisphere holds all receivers.
    OneHemisphere,
    /// Two paraboloids: the edges of all casters are short enough for such maps, and two passes are fewer than those of a
    /// cube.
    TwoHemispheres,
    /// No paraboloid: an edge of a caster is too long, seen from the light, for a map that bends lines.
    CoarseCasters,
    /// Cube faces: so many of the six have receivers and casters.
    Faces(u32),
    /// The nearest caster is so far from the light, more than twice its near distance: a near distance of as much would make
    /// depth finer everywhere.
    NearTooSmall(f64),
    /// Smaller than the budget allows: still fine enough with so many texels a side.
    SmallerMap(u32),
    /// Smaller than the light needs, to keep to the texels of all lights: at most so many a side.
    OverBudget(u32),
    /// Second depth without a bias: every caster is watertight.
    AllSolid,
    /// First depth with a bias: some casters are open meshes that are not flat.
    SheetsCurve,
    /// First depth with a bias: some casters are flat sheets, and the bias moves shadows by so few pixels, or the map is a
    /// paraboloid, which has no virtual samples.
    BiasHidden(f64),
    /// Virtual samples: some casters are flat sheets, and a bias would move shadows by so many pixels.
    BiasShows(f64),
    /// First depth with a bias: some casters are point clouds.
    PointsCast,
    /// The nearest texel alone: the largest texel is this part of a pixel, so that a filter would hide nothing.
    TexelsHidden(f64),
    /// The sampler's own filter, though a wider one is allowed: the largest texel is this part of a pixel, so that no more
    /// is needed.
    TexelsBlend(f64),
    /// The widest filter that is allowed: the largest texel is so many times as large as a pixel.
    TexelsShow(f64),
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoReceivers => f.write_str("no map: no receiver is in view and lit"),
            Self::NoCasters => f.write_str("no map: nothing can cast on a receiver in view"),
            Self::UniformEnough => f.write_str("uniform: fine enough without a warp"),
            Self::NoWarpWanted => f.write_str("uniform: the settings ask for no warp"),
            Self::WarpNoFiner(part) => {
                write!(f, "uniform: the error of a warp would be {part:.2} times as large")
            }
            Self::WarpFiner(part) => write!(f, "warped: the error is {part:.2} times the uniform map's"),
            Self::ShiftFiner(times) => {
                write!(f, "moved back: without, texels would be {times:.2} times as large")
            }
            Self::NoShiftFiner(times) => {
                write!(f, "not moved back: with that, texels would be {times:.2} times as large")
            }
            Self::Surrounded => f.write_str("no single frustum: the light stands among its receivers"),
            Self::WideFrustum(times) => {
                write!(f, "no frustum: it is so wide that the worst texel would be {times:.2} times as large")
            }
            Self::OneHemisphere => f.write_str("one paraboloid: one hemisphere holds all receivers"),
            Self::TwoHemispheres => f.write_str("two paraboloids: fewer passes than cube faces"),
            Self::CoarseCasters => {
                f.write_str("no paraboloid: an edge of a caster is too long for a map that bends lines")
            }
            Self::Faces(6) => f.write_str("six cube faces: each has receivers and casters"),
            Self::Faces(count) => {
                write!(f, "{count} of six cube faces: the others have no receivers or no casters")
            }
            Self::NearTooSmall(distance) => {
                write!(
                    f,
                    "the nearest caster is {distance:.3} from the light: a near distance of as much would make depth finer"
                )
            }
            Self::SmallerMap(size) => write!(f, "{size} texels a side are fine enough"),
            Self::OverBudget(size) => write!(f, "{size} texels a side: more would exceed the budget of all lights"),
            Self::AllSolid => f.write_str("second depth, no bias: every caster is watertight"),
            Self::SheetsCurve => {
                f.write_str("first depth with a bias: some casters are open meshes that are not flat")
            }
            Self::BiasHidden(pixels) => {
                write!(f, "first depth with a bias: it moves shadows by {pixels:.2} pixels at most")
            }
            Self::BiasShows(pixels) => {
                write!(f, "virtual samples: a bias would move shadows by {pixels:.1} pixels")
            }
            Self::PointsCast => f.write_str("first depth with a bias: some casters are point clouds"),
            Self::TexelsHidden(part) => {
                write!(
                    f,
                    "nearest texel: the largest texel is {part:.2} pixels, so that a filter would hide nothing"
                )
            }
            Self::TexelsBlend(part) => {
                write!(f, "2 × 2 texels: the largest texel is {part:.2} pixels, so that no wider filter is needed")
            }
            Self::TexelsShow(times) => write!(f, "the widest filter: the largest texel is {times:.2} pixels"),
        }
    }
}
