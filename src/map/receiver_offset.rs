//! Receiver offsets, folded into the matrix that receivers are tested with.

use crate::convex::Plane;
use crate::error::{Expected, InputError, MAX_COORDINATE, check};
use crate::map::linear_depth::LinearDepth;
use glam::DVec4;

/// How much nearer to the light receivers are tested than they are: a bias on the receiver's side, folded into its matrix
/// ([`ShadowMap::receiver_matrix_with`](crate::ShadowMap::receiver_matrix_with)).
///
/// It costs nothing at run time, is exact whatever the warp, and covers what a rasteriser's slope-scaled bias cannot:
/// rounding, curved facets, creases. `docs/depth.md` derives it.
///
/// | offset | moves a receiver towards the light by |
/// |---|---|
/// | [`ReceiverOffset::world`], directional light | h world units |
/// | [`ReceiverOffset::world`], light at a position | h world units or more, for every receiver |
/// | [`ReceiverOffset::relative`] | k/(1 + k) of its distance; k world units under a directional light |
/// | [`ReceiverOffset::depth`], [`ReceiverOffset::and_depth`] | what changes its depth by β |
///
/// The depth that k takes off goes with 1/w, as rounding in f32 does. Negative numbers move receivers away. Offsets are given
/// as if depth grew away from the light, 0 to 1; reversed depth and depth from −1 are taken care of.
///
/// ```
#[doc = include_str!("../examples/sun.txt")]
/// use shadowfit::depth::ReceiverOffset;
///
/// let place = map.texture_from_world().project_point3(ground);
/// for offset in [ReceiverOffset::world(0.1)?, ReceiverOffset::relative(0.1)?, ReceiverOffset::depth(0.01)?] {
///     let moved = map.texture_from_world_with(&offset).project_point3(ground);
///     assert!((moved - place).truncate().length() < 1e-12 && moved.z < place.z);
/// }
/// # Ok::<(), shadowfit::InputError>(())
/// ```
#[doc(alias = "receiver bias")]
#[doc(alias = "depth offset")]
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
    /// Moves receivers towards the light by `distance` world units.
    ///
    /// Local lights have no parallel rays, and no matrix moves all receivers by one distance: every receiver is moved by
    /// at least so much, and those nearest to the light and farthest from it, on the axis of the map, by just so much.
    /// None is moved by more than half of the nearest receiver's distance.
    ///
    /// # Errors
    ///
    /// Names `"distance"` when it is not finite or too large.
    ///
    /// ```
    #[doc = include_str!("../examples/sun.txt")]
    /// use shadowfit::depth::ReceiverOffset;
    ///
    /// let moved = map.texture_from_world_with(&ReceiverOffset::world(0.1)?).project_point3(ground);
    /// let nearer = map.texture_from_world().project_point3(ground + 0.1 * sun.direction_from(ground));
    /// assert!((moved - nearer).length() < 1e-9);
    /// assert!(ReceiverOffset::world(f64::NAN).is_err());
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    pub fn world(distance: f64) -> Result<Self, InputError> {
        Ok(Self { towards: Towards::World(check::coordinate("distance", distance)?), depth: 0.0 })
    }

    /// Moves receivers by a part of their distance to the light: to the homogeneous point X + `part` · l, with l as
    /// [`Light::homogeneous`](crate::Light::homogeneous) gives it.
    ///
    /// Under a light at a position that is `part`/(1 + `part`) of the distance, which grows with distance as footprints
    /// of texels do: the form for point lights and spots. A directional light has no distance, and its unit is the
    /// world's: there it is the same as [`Self::world`].
    ///
    /// # Errors
    ///
    /// Names `"part"` when it is not finite, too large, or less than −1/2: from −1 on there is no such point.
    ///
    /// ```
    #[doc = include_str!("../examples/spot.txt")]
    /// use shadowfit::depth::ReceiverOffset;
    ///
    /// let moved = map.texture_from_world_with(&ReceiverOffset::relative(0.25)?).project_point3(floor);
    /// let light = spot.position().expect("a spot has one");
    /// let nearer = map.texture_from_world().project_point3(floor.lerp(light, 0.2)); // 0.25/1.25
    /// assert!((moved - nearer).length() < 1e-9);
    /// assert!(ReceiverOffset::relative(-1.0).is_err());
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    pub fn relative(part: f64) -> Result<Self, InputError> {
        let part = check::within("part", part, Expected::Within { least: -0.5, most: MAX_COORDINATE })?;
        Ok(Self::of(part, 0.0))
    }

    /// Takes `depth` off the depth of receivers, where the depth range is 1.
    ///
    /// # Errors
    ///
    /// Names `"depth"` when it is not finite or too large.
    ///
    /// ```
    #[doc = include_str!("../examples/sun.txt")]
    /// use shadowfit::depth::ReceiverOffset;
    ///
    /// let place = map.texture_from_world().project_point3(ground);
    /// let moved = map.texture_from_world_with(&ReceiverOffset::depth(0.001)?).project_point3(ground);
    /// assert!((place.z - moved.z - 0.001).abs() < 1e-12);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    pub fn depth(depth: f64) -> Result<Self, InputError> {
        Self::of(0.0, 0.0).and_depth(depth)
    }

    /// The same offset, and `depth` taken off besides, where the depth range is 1.
    ///
    /// # Errors
    ///
    /// Names `"depth"` when it is not finite or too large.
    ///
    /// ```
    /// use shadowfit::depth::ReceiverOffset;
    ///
    /// let offset = ReceiverOffset::relative(0.01)?.and_depth(0.001)?;
    /// assert_ne!(offset, ReceiverOffset::relative(0.01)?);
    /// assert_eq!(offset.and_depth(-0.001)?, ReceiverOffset::relative(0.01)?);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    pub fn and_depth(self, depth: f64) -> Result<Self, InputError> {
        Ok(Self { depth: check::coordinate("depth", self.depth + depth)?, ..self })
    }

    /// [`Self::relative`] and [`Self::and_depth`] for numbers that the crate has found.
    pub(crate) const fn of(part: f64, depth: f64) -> Self {
        Self { towards: Towards::Relative(part), depth }
    }

    /// The factor of a distance from the light, and the part of the depth range that is then taken off it.
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
