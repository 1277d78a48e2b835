//! Planes, as covectors.

use glam::{DMat4, DVec3, DVec4};

/// An oriented plane: inside where `normal · x + offset ≥ 0`. The normal points inwards and need not be unit length.
///
/// The same four numbers are a covector: a linear function of homogeneous points, `(normal, offset) · (x, w)`. Rows of
/// projection matrices are covectors, which is how they turn into planes and back (DESIGN: "rows of C").
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

    /// The same plane with a normal of unit length; unchanged if the normal is zero.
    #[must_use]
    pub fn normalized(&self) -> Self {
        let length = self.normal.length();
        if length > 0.0 { *self * length.recip() } else { *self }
    }

    /// The plane moved outwards by what rounding can make of it at points no farther out than `extent` on each axis.
    ///
    /// In doubt a body grows and never shrinks. A vertex comes out of a chain of interpolations, each within three
    /// roundings of its edge, and one evaluation of this plane costs four more: `SLACK` roundings of the largest term
    /// cover a dozen interpolations, and no case that the exact oracle in `tests` was asked about needs more.
    #[must_use]
    pub(crate) fn loosened(&self, extent: DVec3) -> Self {
        /// Roundings allowed for, see above.
        const SLACK: f64 = 48.0;
        let magnitude = self.normal.abs().dot(extent) + self.offset.abs();
        Self::new(self.normal, self.offset + SLACK * f64::EPSILON * magnitude)
    }

    /// The plane as a row: `(normal, offset)`.
    #[must_use]
    pub fn to_row(&self) -> DVec4 {
        self.normal.extend(self.offset)
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
