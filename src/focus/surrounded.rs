//! Lights that no single frustum serves.

use crate::math::angle;
use core::fmt;
use glam::DVec2;

/// The light stands among what is visible and lit: no cone from it that is narrower than a half space, by a little, holds all of
/// that, and so no single frustum does.
///
/// [`Self::half_angle`] says how far the light is from being served: one map serves half angles up to
/// [`Self::MAX_HALF_ANGLE`]. So a point light above the middle of a floor that is 20 wide, all of it in view, needs to be 0.0196
/// above it; a point light in a corner of a box is served, on an edge or a face of one it is not.
///
/// What serves instead: the light cut into parts, one fit each (the faces of a cube, [`Light::cube_face`](crate::Light::cube_face), or
/// [`Light::spot`](crate::Light::spot)s where it is needed), or, for a [`Light::hemisphere`](crate::Light::hemisphere) or a pair of them,
/// paraboloid maps (Brabec, Annen & Seidel 2002).
///
/// ```
/// use shadowfit::{Light, Outcome, Scene, Settings, Surrounded, View, fit};
///
/// let view = View::perspective((0.0, 40.0, 0.0), (0.0, -1.0, 0.0), (0.0, 0.0, -1.0), 1.0, 1.0, 0.1, 100.0)?;
/// let floor = Scene::from_box((-10.0, 0.0, -10.0), (10.0, 0.0, 10.0))?;
/// let [low, high] = [0.01, 0.1].map(|height| Light::point((0.0, height, 0.0), 1e-4, 100.0));
/// let Outcome::Surrounded(why) = fit(&view, &low?, &floor, &Settings::default()) else { panic!("a map") };
/// assert!(why.half_angle() > Surrounded::MAX_HALF_ANGLE && why.half_angle() < 1.5702);
/// assert!(matches!(fit(&view, &high?, &floor, &Settings::default()), Outcome::Map(_)));
/// # Ok::<(), shadowfit::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Surrounded {
    half_angle: f64,
}

impl Surrounded {
    /// The largest half angle of a cone that one map serves, in radians: arccos 1/512, 89.89°. A frustum's tangent is 512 there.
    pub const MAX_HALF_ANGLE: f64 = 1.568_843_200_553_131;

    /// From the cosine of half of the narrowest cone.
    pub(crate) fn by(cosine: f64) -> Self {
        let sine = DVec2::new(1.0 - cosine * cosine, 0.0).sqrt().x;
        Self { half_angle: angle::of_vector(cosine, sine) }
    }

    /// Half of the angle of the narrowest cone from the light that holds all that is visible and lit, in radians: more than
    /// [`Self::MAX_HALF_ANGLE`], unless the light's near distance is lost in the rounding of its position, and π/2 where every
    /// plane through the light has some of it on both sides.
    #[must_use]
    pub const fn half_angle(&self) -> f64 {
        self.half_angle
    }
}

impl fmt::Display for Surrounded {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "the light stands among what is visible: {:.3}° from the axis of the narrowest cone around it, where one map \
             holds {:.3}°; fit the faces of a cube around the light, or use paraboloid maps",
            self.half_angle.to_degrees(),
            Self::MAX_HALF_ANGLE.to_degrees(),
        )
    }
}
