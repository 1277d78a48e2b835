//! The fit of paraboloid maps: which hemispheres, and how deep.

use super::Paraboloid;
use crate::convex::{Plane, Polyhedron};
use crate::error::{InputError, check};
use crate::fit::Empty;
use crate::focus::{Focus, FocusForm};
use crate::input::numbers::vector;
use crate::math::frame;
use crate::settings::Settings;
use core::slice;
use glam::DVec3;

/// Result of fitting paraboloid maps ([`Focus::paraboloids`]).
///
/// ```
#[doc = include_str!("../../examples/room.txt")]
/// let two = focus.paraboloids(&settings);
/// assert_eq!(two.maps(), [map, other]);
/// let sun = Light::directional((0.4, 1.0, 0.2))?;
/// assert_eq!(Focus::new(&view, &sun, &scene).paraboloids(&settings), Paraboloids::Directional);
/// # Ok::<(), shadowfit::InputError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[expect(clippy::large_enum_variant, reason = "a box would need a heap")]
pub enum Paraboloids {
    /// No map is needed.
    Empty(Empty),
    /// The light is infinitely far away and has no hemispheres: [`Focus::fit`] serves every such light.
    Directional,
    /// One map holds all receivers.
    One(Paraboloid),
    /// A map for each hemisphere, with the same depths: the second is the first one's
    /// [opposite](Paraboloid::opposite).
    Two([Paraboloid; 2]),
}

impl Paraboloids {
    /// The maps: none, one or two.
    #[must_use]
    pub const fn maps(&self) -> &[Paraboloid] {
        match self {
            Self::Empty(_) | Self::Directional => &[],
            Self::One(map) => slice::from_ref(map),
            Self::Two(maps) => maps,
        }
    }
}

impl Focus<'_> {
    /// Fits one or two paraboloid maps to a light at a position. A point light inside of its receivers gets two, with the
    /// world's y axis between the hemispheres; for another axis see [`Self::paraboloids_about`].
    ///
    /// ```
    #[doc = include_str!("../../examples/room.txt")]
    /// assert_eq!(focus.paraboloids(&settings).maps().len(), 2);
    /// let ceiling = Light::point((0.0, 3.0, 0.0), 0.05, 10.0)?;
    /// assert_eq!(Focus::new(&view, &ceiling, &scene).paraboloids(&settings).maps().len(), 1);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[doc(alias = "dual paraboloid")]
    #[doc(alias = "DPSM")]
    #[must_use]
    pub fn paraboloids(&self, settings: &Settings) -> Paraboloids {
        self.fit_paraboloids(DVec3::NEG_Y, settings)
    }

    /// Fits one or two paraboloid maps, the first of them around `axis`, which points away from the light and need not be
    /// unit length.
    ///
    /// ```text
    ///     a spot or a hemisphere        one map around the light's own axis
    ///     R on one side of the light    one map around `axis` or against it, where that will do, or else around the
    ///                                   normal of a plane of R that the light is not inside of, planes of the scene first
    ///     R around the light            two maps, around `axis` and against it
    /// ```
    ///
    /// The axis is fixed in the world: with one that followed the view, texels would move over what stands still, and
    /// shadow edges would swim. Straight down is a good axis: the seam is then level with the light, and everything below
    /// a ceiling light is in one map. Only for a light out of view, where a plane of the view decides, does the map turn
    /// with the camera, for half of the cost.
    ///
    /// # Errors
    ///
    /// Names `"axis"` when it is zero or not finite.
    ///
    /// ```
    #[doc = include_str!("../../examples/room.txt")]
    /// let maps = focus.paraboloids_about((1.0, 0.0, 0.0), &settings)?;
    /// assert_eq!(maps.maps()[0].axis(), DVec3::X);
    /// assert!(focus.paraboloids_about((0.0, 0.0, 0.0), &settings).is_err());
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    pub fn paraboloids_about<F: Into<f64>>(
        &self,
        axis: impl Into<[F; 3]>,
        settings: &Settings,
    ) -> Result<Paraboloids, InputError> {
        Ok(self.fit_paraboloids(check::direction("axis", vector(axis))?, settings))
    }

    fn fit_paraboloids(&self, fixed: DVec3, settings: &Settings) -> Paraboloids {
        let mut body = Polyhedron::EMPTY;
        let mut separating = Separating::from(self.light().position().unwrap_or_default());
        self.cut_visible(&mut body, |plane, _| separating.consider(plane));
        if body.is_empty() {
            return Paraboloids::Empty(Empty::NoReceivers);
        }
        let Some(position) = self.light().position() else { return Paraboloids::Directional };
        let far = body.positions().map(|point| point.distance(position)).fold(0.0, f64::max);
        // All receivers may be nearer to the light than any caster.
        if far <= self.light().near() || self.caster_volume(FocusForm::ReceiverHull).is_empty() {
            return Paraboloids::Empty(Empty::NoCasters);
        }
        let around = |axis: DVec3| {
            // A frame that no camera moves.
            let (x_axis, y_axis) = frame::of_light(axis);
            let (view, light, settings) = (*self.view(), *self.light(), settings.squared());
            let near = light.near();
            Paraboloid { position, x_axis, y_axis, axis, near, far, view, light, settings }.padded(body.positions())
        };
        if let Some(axis) = self.light().axis() {
            return Paraboloids::One(around(axis));
        }
        let first = around(fixed);
        let opposite = first.opposite();
        let holds_all = |map: &Paraboloid| {
            let plane = map.clip_plane();
            body.positions().all(|point| separating.is_behind(&plane, point))
        };
        match separating.axis {
            _ if holds_all(&first) => Paraboloids::One(first),
            _ if holds_all(&opposite) => Paraboloids::One(opposite),
            Some(axis) => Paraboloids::One(around(axis)),
            None => Paraboloids::Two([first, opposite]),
        }
    }
}

/// Looks among the planes of R, a convex body, for one that the light is not inside of. There is one exactly where one
/// hemisphere holds all of R.
struct Separating {
    light: DVec3,
    /// The plane's unit normal.
    axis: Option<DVec3>,
}

impl Separating {
    /// Roundings between a vertex and the exact one, a plane moved outwards and the exact one, and in their evaluation. A
    /// light in a plane of R, as on a ceiling, is not to have a map for its other side.
    const ROUNDINGS: f64 = 128.0 * f64::EPSILON;

    const fn from(light: DVec3) -> Self {
        Self { light, axis: None }
    }

    fn consider(&mut self, plane: Plane) {
        if self.axis.is_none() && plane.at(self.light) <= Self::slack(&plane, self.light) {
            self.axis = plane.normal.try_normalize();
        }
    }

    /// Whether a point is on the inner side of a plane, or on it but for rounding.
    fn is_behind(&self, plane: &Plane, point: DVec3) -> bool {
        plane.at(point) >= -Self::slack(plane, point.abs().max(self.light.abs()))
    }

    fn slack(plane: &Plane, extent: DVec3) -> f64 {
        Self::ROUNDINGS * (plane.normal.abs().dot(extent.abs()) + plane.offset.abs())
    }
}
