//! The scene S: bounds of casters and receivers.

mod boxes;
mod convex;
mod region;

pub use boxes::{Aabb, Bounding, DAabb};
pub use convex::ConvexScene;

pub(crate) use boxes::Boxes;
#[cfg(not(feature = "alloc"))]
use boxes::checked_box;
#[cfg(feature = "alloc")]
pub(crate) use boxes::{checked_box, of_boxes};
pub(crate) use region::Region;

use crate::error::{InputError, check};
use crate::input::numbers::vector;
use glam::DVec3;

/// The scene S: bounds of casters and receivers, as one box, a convex body, or lists of boxes.
///
/// A scene may be empty, or have no casters or no receivers: the fit's outcome is then [`Empty`](crate::Empty).
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
/// // The same ground six million units away, in boxes relative to a point next to the eye.
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

/// The bounds of a scene.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Bounds<'a> {
    Nothing,
    Box {
        min: DVec3,
        max: DVec3,
    },
    Convex(&'a ConvexScene),
    /// `extent` holds the largest absolute coordinates of the casters.
    Lists {
        casters: Boxes<'a>,
        receivers: Boxes<'a>,
        extent: DVec3,
    },
}

impl<'a> Scene<'a> {
    /// A scene whose casters and receivers all lie in one world-space box. The box may be flat, or empty as [`Aabb::EMPTY`].
    ///
    /// ```
    /// use shadowfit::Scene;
    ///
    /// assert!(Scene::from_box((-200.0, 0.0, -200.0), (200.0, 30.0, 200.0)).is_ok());
    /// let error = Scene::from_box((-200.0, 30.0, -200.0), (200.0, 0.0, 200.0)).unwrap_err();
    /// assert_eq!(error.to_string(), "max.y (0) must be no less than min.y (30)");
    /// ```
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

    /// A scene whose casters and receivers all lie in one convex body.
    ///
    /// ```
    /// use shadowfit::{Focus, Light, Scene, View, input::ConvexScene};
    ///
    /// let view = View::perspective((0.0, 1.0, 9.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.1, 50.0)?;
    /// let roof = [[-3.0, 0.0, -2.0], [3.0, 0.0, -2.0], [0.0, 3.0, -2.0], [-3.0, 0.0, 2.0], [3.0, 0.0, 2.0], [0.0, 3.0, 2.0]];
    /// let body = ConvexScene::around(roof)?;
    /// let focus = Focus::new(&view, &Light::directional((0.4, 1.0, 0.2))?, &Scene::from_convex(&body));
    /// assert!((focus.receiver_volume().volume() - 36.0).abs() < 1e-6); // half of its box
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub const fn from_convex(body: &'a ConvexScene) -> Self {
        Self { bounds: Bounds::Convex(body) }
    }

    /// A scene of boxes of casters and of receivers, usually one for each object; an object that does both is in both lists. The
    /// lists are borrowed, not copied. Lists and boxes may be empty.
    ///
    /// Boxes are in world space, in f32 or f64 ([`Aabb`], [`DAabb`]). [`Aabb::new`] rounds f64 coordinates outwards: rounded to
    /// nearest, a box may lose parts of its object.
    ///
    /// ```
    /// use shadowfit::{Aabb, Scene};
    ///
    /// let (ground, tree) = (Aabb::new([-50.0, 0.0, -50.0], [50.0, 0.0, 50.0]), Aabb::new([3.0, 0.0, -9.0], [5.0, 4.0, -7.0]));
    /// assert!(Scene::new(&[ground, tree], &[ground]).is_ok());
    /// let broken = Aabb::new([0.0, f64::NAN, 0.0], [1.0, 1.0, 1.0]);
    /// assert_eq!(Scene::new(&[ground, broken], &[ground]).unwrap_err().to_string(), "casters[1].min.y is NaN");
    /// ```
    ///
    /// # Errors
    ///
    /// Names `"casters"` or `"receivers"`, with the index, when a box is not finite, too large, or out of order.
    pub fn new<B: Bounding>(casters: &'a [B], receivers: &'a [B]) -> Result<Self, InputError> {
        Self::about(DVec3::ZERO, casters, receivers)
    }

    /// A scene as of [`Self::new`] with boxes relative to `origin`, a point of world space, for engines with camera-relative or
    /// cell coordinates. View and light stay in world space. Boxes are moved to world space in f64 and rounded outwards.
    ///
    /// ```
    /// use shadowfit::{Aabb, Focus, Light, Scene, View};
    ///
    /// let view = View::perspective((6e6, 1.7, 0.0), (0.0, -0.2, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.1, 500.0)?;
    /// let ground = [Aabb::new([-50.0, 0.0, -50.0], [50.0, 0.0, 50.0])];
    /// let scene = Scene::relative_to((6e6, 0.0, 0.0), &ground, &ground)?;
    /// let focus = Focus::new(&view, &Light::directional((0.4, 1.0, 0.2))?, &scene);
    /// let (min, max) = focus.receiver_volume().bounds().expect("ground in view");
    /// assert!(min.x > 6e6 - 51.0 && max.x < 6e6 + 51.0);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// As [`Self::new`], also where a box is too large once it is moved; names `"origin"` when it is not finite or too large.
    #[doc(alias = "camera-relative rendering")]
    #[doc(alias = "floating origin")]
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

    /// As [`Self::new`], for boxes that were checked before.
    #[cfg(feature = "alloc")]
    pub(crate) fn of_checked(casters: &'a [Aabb], receivers: &'a [Aabb]) -> Self {
        let [casters, receivers] = [casters, receivers].map(|boxes| Boxes::new(boxes, DVec3::ZERO));
        Self { bounds: Bounds::Lists { casters, receivers, extent: casters.extent() } }
    }
}
