//! Planes, as covectors.

use super::exact::sum_of_products;
use crate::error::{InputError, check};
use glam::{DMat4, DVec3, DVec4};

/// An oriented plane: inside where `normal · x + offset ≥ 0`. The normal points inwards and need not be unit length.
///
/// The same four numbers are a covector: a linear function of homogeneous points, `(normal, offset) · (x, w)`. Rows of
/// projection matrices are covectors, which is how they turn into planes and back (`docs/design.md`, section 2).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Plane {
    /// Inward normal, not necessarily unit length; the zero vector for a covector that is constant on points.
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

    /// The plane through `point`.
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

    /// The same as [`Self::on`], but right to a few roundings of itself instead of its terms, and zero only where it is.
    #[must_use]
    pub(crate) fn exactly_on(&self, homogeneous: DVec4) -> f64 {
        sum_of_products(self.to_row().to_array(), homogeneous.to_array())
    }

    /// The same plane with a normal of unit length; unchanged if the normal is zero.
    #[must_use]
    pub fn normalized(&self) -> Self {
        let length = self.normal.length();
        if length > 0.0 { *self * length.recip() } else { *self }
    }

    /// The plane moved outwards by what rounding can make of it at points no farther out than `extent` on each axis: in
    /// doubt a body grows and never shrinks.
    ///
    /// With M the magnitude `|normal| · extent + |offset|` and u = 2⁻⁵³, a vertex that a cut makes is to lie outside of
    /// the plane that cut, and so are all that later cuts make on the same face. What can carry it inwards:
    ///
    /// | | u M |
    /// |---|---|
    /// | the normal's length and the offset that goes with it, of a plane that cuts a scene's box | 8 |
    /// | the sum of the offset and this slack | 1 |
    /// | the plane's value at either end of the edge | 4 |
    /// | the part of the edge up to the plane | 3 |
    /// | the vertex on that edge, here and for each of the at most 57 planes that cut later | 3 · 58 |
    ///
    /// which is 190, less than 192. Why no cut then loses anything is said at [`Polyhedron`](super::Polyhedron).
    ///
    /// Of the planes that a hull's plane is the sum of, it covers what the sum loses: each counts by the value of the
    /// other at the light, which is right to 130 u of itself, and the division and the sum take 3 u more.
    #[must_use]
    pub(crate) fn loosened(&self, extent: DVec3) -> Self {
        let magnitude = self.normal.abs().dot(extent) + self.offset.abs();
        Self::new(self.normal, self.offset + Self::SLACK * magnitude)
    }

    /// What planes are moved outwards by, of the sum of the magnitudes of their terms: 192 roundings.
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

/// From `[x, y, z, offset]`, as other libraries keep planes: inside where `x·X + y·Y + z·Z + offset ≥ 0`.
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
