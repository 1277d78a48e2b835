//! The scene S: bounds of what casts shadows and of what receives them.

mod boxes;
mod convex;
mod region;

pub use boxes::{Aabb, Bounding, DAabb};
pub use convex::ConvexScene;

pub(crate) use boxes::Boxes;
#[cfg(not(feature = "std"))]
use boxes::checked_box;
#[cfg(feature = "std")]
pub(crate) use boxes::{checked_box, of_boxes};
pub(crate) use region::Region;

use crate::error::{InputError, check};
use crate::input::numbers::vector;
use glam::DVec3;

/// Bounds of the scene: everything that casts or receives shadows lies inside.
///
/// A scene may be empty, or have no casters or no receivers: a fit says so ([`Empty`](crate::Empty)).
///
/// ```
/// use shadowfit::{Aabb, Empty, Light, Outcome, Scene, Settings, View, fit};
///
/// let view = View::perspective((0.0, 1.7, 0.0), (0.0, -0.2, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.1, 500.0)?;
/// let sun = Light::directional((0.4, 1.0, 0.2))?;
/// let ground = [Aabb::new([-200.0, 0.0, -200.0], [200.0, 0.0, 200.0])];
/// let outcome = fit(&view, &sun, &Scene::new(&[], &ground)?, &Settings::default());
/// assert_eq!(outcome, Outcome::Empty(Empty::NoCasters));
///
/// // The same ground six million units away, as boxes about a point next to the eye.
/// let away = [6e6, 0.0, 0.0];
/// let view = View::perspective((6e6, 1.7, 0.0), (0.0, -0.2, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.1, 500.0)?;
/// let scene = Scene::relative_to(away, &ground, &ground)?;
/// assert!(fit(&view, &sun, &scene, &Settings::default()).map().is_some());
/// # Ok::<(), shadowfit::InputError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Scene<'a> {
    pub(crate) bounds: Bounds<'a>,
}

/// The forms that a scene's bounds come in.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Bounds<'a> {
    Nothing,
    Box {
        min: DVec3,
        max: DVec3,
    },
    Convex(&'a ConvexScene),
    /// With the largest absolute coordinates of the casters.
    Lists {
        casters: Boxes<'a>,
        receivers: Boxes<'a>,
        extent: DVec3,
    },
}

impl<'a> Scene<'a> {
    /// Everything lies in one box, which may be flat, or empty as [`Aabb`] has it.
    ///
    /// # Errors
    ///
    /// Names `"min"` or `"max"` when it is not finite, too large, or out of order.
    pub fn from_box<F: Into<f64>, G: Into<f64>>(
        min: impl Into<[F; 3]>,
        max: impl Into<[G; 3]>,
    ) -> Result<Self, InputError> {
        let bounds = checked_box(vector(min), vector(max))?;
        Ok(Self { bounds: bounds.map_or(Bounds::Nothing, |(min, max)| Bounds::Box { min, max }) })
    }

    /// Everything lies in one convex body.
    #[must_use]
    pub const fn from_convex(body: &'a ConvexScene) -> Self {
        Self { bounds: Bounds::Convex(body) }
    }

    /// Boxes of what casts and boxes of what receives, usually one an object; an object that does both is in both
    /// lists. The fit reads the lists, it does not copy them. Either may have nothing in it, and boxes may be empty.
    ///
    /// Boxes are in world space, in single or in double precision ([`Aabb`], [`DAabb`]). Where single precision is too coarse for
    /// coordinates, round them outwards ([`Aabb::new`] does), or they lose what they should hold.
    ///
    /// # Errors
    ///
    /// Names `"casters"` or `"receivers"`, with the index, when a box is not finite, too large, or out of order.
    pub fn new<B: Bounding>(casters: &'a [B], receivers: &'a [B]) -> Result<Self, InputError> {
        Self::about(DVec3::ZERO, casters, receivers)
    }

    /// The same for boxes relative to a point of the world, as engines keep them that draw about the eye or in cells. View and
    /// light stay in world space. Boxes are moved in double precision and outwards.
    ///
    /// # Errors
    ///
    /// As [`Self::new`], where boxes may be too large once they are moved, and names `"origin"` when it is not finite or too
    /// large.
    pub fn relative_to<F: Into<f64>, B: Bounding>(
        origin: impl Into<[F; 3]>,
        casters: &'a [B],
        receivers: &'a [B],
    ) -> Result<Self, InputError> {
        Self::about(check::point("origin", vector(origin))?, casters, receivers)
    }

    fn about<B: Bounding>(origin: DVec3, casters: &'a [B], receivers: &'a [B]) -> Result<Self, InputError> {
        let casters = Boxes::new(casters, origin).checked("casters")?;
        let receivers = Boxes::new(receivers, origin).checked("receivers")?;
        Ok(Self { bounds: Bounds::Lists { casters, receivers, extent: casters.extent() } })
    }

    /// The same as [`Self::new`] for boxes that are known to be sound.
    #[cfg(feature = "std")]
    pub(crate) fn of_checked(casters: &'a [Aabb], receivers: &'a [Aabb]) -> Self {
        let [casters, receivers] = [casters, receivers].map(|boxes| Boxes::new(boxes, DVec3::ZERO));
        Self { bounds: Bounds::Lists { casters, receivers, extent: casters.extent() } }
    }
}
