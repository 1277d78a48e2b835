//! Offsets of receivers, folded into the matrix that they are tested with.

use crate::convex::Plane;
use crate::error::{Expected, InputError, MAX_COORDINATE, check};
use crate::map::linear_depth::LinearDepth;
use glam::DVec4;

/// How much nearer to the light receivers are tested than they are.
///
/// With e the row of depth, c that of w and l the light, c·l = 0 and so for any number or affine function g
///
/// ```text
///     e·(X + g l)   e·X + g e·l
///     ----------- = -----------         a = a·(X + g l), likewise b: (u, v) stay
///     c·(X + g l)       c·X
/// ```
///
/// so that the row e + (e·l) g gives a point the depth that X + g l has: exactly that of a point on the same ray nearer to
/// the light, whatever the warp. An offset costs nothing at run time, and where a rasteriser's bias knows the slope of the
/// caster alone, it may be what a slope cannot cover: rounding, curved facets, creases.
///
/// | offset | g | moves a receiver towards the light by |
/// |---|---|---|
/// | [`ReceiverOffset::world`], directional light | h | h world units |
/// | [`ReceiverOffset::world`], light at a position | a chord of h/(a − h) | h world units or more, wherever something is visible |
/// | [`ReceiverOffset::relative`] | k | k/(1 + k) of its distance; k world units under a directional light |
/// | [`ReceiverOffset::depth`], [`ReceiverOffset::and_depth`] | | what changes its depth by β: the row is e − β c |
///
/// As rounding in f32 does, the depth that k takes off goes with 1/w.
///
/// Negative numbers move receivers away. Reversed depth and depth from −1 are taken care of: offsets are given as if depth
/// grew away from the light, 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "stored::ReceiverOffset")
)]
pub struct ReceiverOffset {
    towards: Towards,
    depth: f64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
enum Towards {
    World(f64),
    Relative(f64),
}

impl ReceiverOffset {
    /// Towards the light by `distance` world units.
    ///
    /// A light at a position moves no two receivers along parallel rays, and no matrix moves them all by one distance:
    /// every visible one is moved by at least so much, and those nearest to the light and farthest from it, on the axis of
    /// the map, by just so much. None is moved by more than half of what the nearest is away from the light.
    ///
    /// # Errors
    ///
    /// Names `"distance"` when it is not finite or too large.
    pub fn world(distance: f64) -> Result<Self, InputError> {
        Ok(Self { towards: Towards::World(check::coordinate("distance", distance)?), depth: 0.0 })
    }

    /// To the homogeneous point X + `part` · l, see [`Light::homogeneous`](crate::Light::homogeneous): towards a light at
    /// a position by `part`/(1 + `part`) of the distance to it, which grows with distance as footprints of texels do, the
    /// form for lamps. The unit of a directional light, which has no distance, is the world's: there it is the same as
    /// [`Self::world`].
    ///
    /// # Errors
    ///
    /// Names `"part"` when it is not finite, too large, or less than −1/2: from −1 on there is no such point.
    pub fn relative(part: f64) -> Result<Self, InputError> {
        let part = check::within("part", part, Expected::Within { least: -0.5, most: MAX_COORDINATE })?;
        Ok(Self::of(part, 0.0))
    }

    /// Nearer by `depth`, where the depth range is 1.
    ///
    /// # Errors
    ///
    /// Names `"depth"` when it is not finite or too large.
    pub fn depth(depth: f64) -> Result<Self, InputError> {
        Self::of(0.0, 0.0).and_depth(depth)
    }

    /// The same, and then nearer by `depth`, where the depth range is 1.
    ///
    /// # Errors
    ///
    /// Names `"depth"` when it is not finite or too large.
    pub fn and_depth(self, depth: f64) -> Result<Self, InputError> {
        Ok(Self { depth: check::coordinate("depth", self.depth + depth)?, ..self })
    }

    /// [`Self::relative`] and [`Self::and_depth`] for numbers that the crate has found.
    pub(crate) const fn of(part: f64, depth: f64) -> Self {
        Self { towards: Towards::Relative(part), depth }
    }

    /// What a distance from the light is multiplied by, and what is then taken off it, in parts of a depth range.
    pub(crate) fn of_distance(&self, range: f64) -> (f64, f64) {
        match self.towards {
            Towards::Relative(part) => (1.0 / (1.0 + part), self.depth),
            Towards::World(distance) => (1.0, distance / range + self.depth),
        }
    }

    /// The row of depth, 0 to 1, with this offset in it.
    pub(crate) fn depth_row(&self, depth: Plane, w: Plane, light: DVec4, along: &LinearDepth) -> Plane {
        let part = match self.towards {
            Towards::Relative(part) => Plane::ONE * part,
            Towards::World(distance) if light.w == 0.0 => Plane::ONE * distance,
            Towards::World(distance) => along.part_of_light(distance),
        };
        depth + part * depth.on(light) - w * self.depth
    }
}

/// Offsets as they are stored: the same values, checked again when they are read.
#[cfg(feature = "serde")]
mod stored {
    use super::{InputError, Towards};

    #[derive(serde::Deserialize)]
    pub(super) struct ReceiverOffset {
        towards: Towards,
        depth: f64,
    }

    impl TryFrom<ReceiverOffset> for super::ReceiverOffset {
        type Error = InputError;
        fn try_from(offset: ReceiverOffset) -> Result<Self, InputError> {
            match offset.towards {
                Towards::World(distance) => Self::world(distance),
                Towards::Relative(part) => Self::relative(part),
            }?
            .and_depth(offset.depth)
        }
    }
}
