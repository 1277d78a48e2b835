//! Planes as covectors.

use super::exact::sum_of_products;
use crate::error::{InputError, check};
use glam::{DMat4, DVec3, DVec4};

/// An oriented plane: inside where `normal · x + offset ≥ 0`. The normal points inwards and may have any length.
///
/// The same four numbers are a covector, a linear function of homogeneous points: `(normal, offset) · (x, w)`. Rows of projection
/// matrices are covectors, so that planes of a frustum are sums and differences of rows.
///
/// ```
/// use shadowfit::{focus::Plane, glam::{DVec3, DVec4}};
///
/// let ceiling = Plane::new(DVec3::new(0.0, -2.0, 0.0), 6.0); // inside below y = 3
/// assert_eq!(ceiling, Plane::from([0.0, -2.0, 0.0, 6.0]));
/// assert_eq!(ceiling, Plane::through(DVec3::new(0.0, -2.0, 0.0), DVec3::new(7.0, 3.0, 7.0)));
/// assert_eq!((ceiling.at(DVec3::ZERO), ceiling.at(DVec3::Y * 4.0)), (6.0, -2.0)); // in units of the normal
/// assert_eq!(ceiling.normalized().at(DVec3::ZERO), 3.0); // a distance
/// assert_eq!(ceiling.on(DVec4::Y), -2.0); // along the direction +y it decreases
/// assert_eq!(ceiling.to_row(), DVec4::new(0.0, -2.0, 0.0, 6.0));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Plane {
    /// The inward normal, of any length; zero for a covector that is constant on points.
    pub normal: DVec3,
    /// The value at the origin.
    pub offset: f64,
}

impl Plane {
    /// The covector that is 1 on every point: the plane at infinity.
    pub const ONE: Self = Self::new(DVec3::ZERO, 1.0);

    /// A plane from its inward normal and its value at the origin.
    #[must_use]
    pub const fn new(normal: DVec3, offset: f64) -> Self {
        Self { normal, offset }
    }

    /// The plane with this inward normal through `point`.
    #[must_use]
    pub fn through(normal: DVec3, point: DVec3) -> Self {
        Self::new(normal, -normal.dot(point))
    }

    /// The value at a point: positive inside, negative outside, in units of the normal's length.
    #[must_use]
    pub fn at(&self, point: DVec3) -> f64 {
        self.normal.dot(point) + self.offset
    }

    /// The value at a homogeneous point: `w = 1` for points, `w = 0` for directions.
    #[must_use]
    pub fn on(&self, homogeneous: DVec4) -> f64 {
        self.normal.dot(homogeneous.truncate()) + self.offset * homogeneous.w
    }

    /// As [`Self::on`], with an error of a few roundings of the value itself instead of its terms: its sign is exact.
    #[must_use]
    pub(crate) fn exactly_on(&self, homogeneous: DVec4) -> f64 {
        sum_of_products(self.to_row().to_array(), homogeneous.to_array())
    }

    /// The same plane with a unit normal, so that values are signed distances; unchanged if the normal is zero.
    #[must_use]
    pub fn normalized(&self) -> Self {
        let length = self.normal.length();
        if length > 0.0 { *self * length.recip() } else { *self }
    }

    /// The plane moved outwards by a bound on rounding at points up to `extent` on each axis: bodies may grow and never shrink.
    ///
    /// The slack is 192 · 2⁻⁵³ of the magnitude `|normal| · extent + |offset|`, so that every vertex of a cut, and of all later cuts
    /// on the same face, lies outside of the exact plane. `docs/numerics.md` lists the roundings; [`Polyhedron`] has the proof that
    /// no cut loses anything then.
    ///
    /// [`Polyhedron`]: super::Polyhedron
    #[must_use]
    pub(crate) fn loosened(&self, extent: DVec3) -> Self {
        let magnitude = self.normal.abs().dot(extent) + self.offset.abs();
        Self::new(self.normal, self.offset + Self::SLACK * magnitude)
    }

    /// The slack of [`Self::loosened`], relative to the sum of magnitudes: 192 roundings.
    pub(crate) const SLACK: f64 = 96.0 * f64::EPSILON;

    /// The plane with a unit normal, if it is finite and has a direction.
    pub(crate) fn checked(&self, field: &'static str) -> Result<Self, InputError> {
        let normal = check::direction(field, self.normal).map_err(|error| {
            error.of_component(match error.component {
                Some("x") => "normal.x",
                Some("y") => "normal.y",
                Some("z") => "normal.z",
                _ => "normal",
            })
        })?;
        let offset = check::coordinate(field, self.offset * (normal.dot(self.normal)).recip())
            .map_err(|error| error.of_component("offset"))?;
        Ok(Self::new(normal, offset))
    }

    /// The plane as a row: `(normal, offset)`.
    #[must_use]
    pub fn to_row(&self) -> DVec4 {
        self.normal.extend(self.offset)
    }
}

/// From `[x, y, z, offset]`, the form of other libraries: inside where `x·X + y·Y + z·Z + offset ≥ 0`.
impl<F: Into<f64>> From<[F; 4]> for Plane {
    fn from(row: [F; 4]) -> Self {
        let [x, y, z, offset] = row.map(Into::into);
        Self::new(DVec3::new(x, y, z), offset)
    }
}

impl core::ops::Add for Plane {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::new(self.normal + other.normal, self.offset + other.offset)
    }
}

impl core::ops::Sub for Plane {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::new(self.normal - other.normal, self.offset - other.offset)
    }
}

impl core::ops::Mul<f64> for Plane {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        Self::new(self.normal * factor, self.offset * factor)
    }
}

impl core::ops::Neg for Plane {
    type Output = Self;
    fn neg(self) -> Self {
        self * -1.0
    }
}

/// The matrix with these four covectors as its rows.
pub(crate) fn matrix_from_rows(rows: [Plane; 4]) -> DMat4 {
    let [x, y, z, w] = rows.map(|row| row.to_row());
    DMat4::from_cols(x, y, z, w).transpose()
}
