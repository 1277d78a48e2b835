//! Lights with receivers all around.

use crate::math::angle;
use core::fmt;
use glam::DVec2;

/// The light stands among its receivers: no cone narrower than about a half space holds them all, so that no single map can.
///
/// [`Self::half_angle`] is that of the narrowest cone around R; one map serves up to [`Self::MAX_HALF_ANGLE`]. Above the middle of
/// a floor 20 wide, all of it in view, a point light must be at least 0.0196 high; in a corner of a box it is served, on an edge or
/// a face it is not.
///
/// Use several maps instead: the faces of a cube ([`Light::cube_face`](crate::Light::cube_face)), [`Light::spot`](crate::Light::spot)s
/// where light is needed, or paraboloid maps of a [`Light::hemisphere`](crate::Light::hemisphere) or a pair (Brabec, Annen & Seidel
/// 2002); `docs/lights-all-around.md` compares them.
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
    /// The largest half angle of a cone that one map serves, in radians: arccos 1/512, 89.89°, a tangent of 512.
    pub const MAX_HALF_ANGLE: f64 = 1.568_843_200_553_131;

    /// From the cosine of the half angle.
    pub(crate) fn by(cosine: f64) -> Self {
        let sine = DVec2::new(1.0 - cosine * cosine, 0.0).sqrt().x;
        Self { half_angle: angle::of_vector(cosine, sine) }
    }

    /// The half angle of the narrowest cone from the light around R, in radians. It exceeds [`Self::MAX_HALF_ANGLE`], unless the
    /// light's near distance vanishes in the rounding of its position, and is π/2 where R has points on both sides of every plane
    /// through the light.
    #[must_use]
    pub const fn half_angle(&self) -> f64 {
        self.half_angle
    }
}

impl fmt::Display for Surrounded {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "the light stands among its receivers: the narrowest cone around them has a half angle of {:.3}°, and one map \
             holds {:.3}°; fit the faces of a cube around the light, or use paraboloid maps",
            self.half_angle.to_degrees(),
            Self::MAX_HALF_ANGLE.to_degrees(),
        )
    }
}
