//! The numbers that a body is computed in: f32, f64 and exact rationals.

use std::ops::{Add, Div, Mul, Sub};

use dashu_ratio::RBig;

/// A number with what the plain construction needs: four operations and an order.
pub(crate) trait Number:
    Clone + PartialOrd + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    /// The distance from 1 to the next number; zero where there is none.
    const EPSILON: f64;

    /// The nearest to a finite number.
    fn of(value: f64) -> Self;
    /// The nearest in f64.
    fn to_f64(&self) -> f64;

    /// The magnitude.
    fn magnitude(self) -> Self {
        let zero = Self::of(0.0);
        if self < zero { zero - self } else { self }
    }
}

impl Number for f32 {
    const EPSILON: f64 = Self::EPSILON as f64;

    fn of(value: f64) -> Self {
        value as Self
    }

    fn to_f64(&self) -> f64 {
        (*self).into()
    }

    fn magnitude(self) -> Self {
        self.abs()
    }
}

impl Number for f64 {
    const EPSILON: f64 = Self::EPSILON;

    fn of(value: f64) -> Self {
        value
    }

    fn to_f64(&self) -> f64 {
        *self
    }

    fn magnitude(self) -> Self {
        self.abs()
    }
}

impl Number for RBig {
    const EPSILON: f64 = 0.0;

    fn of(value: f64) -> Self {
        Self::try_from(value).expect("planes and boxes that the crate takes are finite")
    }

    fn to_f64(&self) -> f64 {
        Self::to_f64(self).value()
    }
}

/// A homogeneous point, or a plane: normal and offset, inside where normal · x + offset ≥ 0.
pub(crate) type Row<T> = [T; 4];

/// The value of a plane at a homogeneous point.
pub(crate) fn on<T: Number>([a, b, c, d]: &Row<T>, [x, y, z, w]: &Row<T>) -> T {
    a.clone() * x.clone() + b.clone() * y.clone() + c.clone() * z.clone() + d.clone() * w.clone()
}

/// The value of a plane at a position.
pub(crate) fn at<T: Number>([a, b, c, d]: &Row<T>, [x, y, z]: &[T; 3]) -> T {
    a.clone() * x.clone() + b.clone() * y.clone() + c.clone() * z.clone() + d.clone()
}
