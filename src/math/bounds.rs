//! Intervals and rectangles around values.

use glam::DVec2;

/// The smaller of two numbers, neither of them NaN: one instruction, where `f64::min` has to look for NaN.
#[inline]
pub(crate) fn least(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// The larger of two numbers, neither of them NaN.
#[inline]
pub(crate) fn most(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// An interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Interval {
    pub(crate) min: f64,
    pub(crate) max: f64,
}

impl Interval {
    /// The empty interval.
    pub(crate) const EMPTY: Self = Self { min: f64::INFINITY, max: f64::NEG_INFINITY };

    #[inline]
    pub(crate) fn include(&mut self, value: f64) {
        self.min = least(self.min, value);
        self.max = most(self.max, value);
    }

    pub(crate) fn middle(&self) -> f64 {
        0.5 * (self.min + self.max)
    }
}

/// A rectangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rectangle {
    pub(crate) centre: DVec2,
    /// Half the width and height.
    pub(crate) half: DVec2,
}

impl Rectangle {
    /// The rectangle over two intervals.
    pub(crate) fn over(x: &Interval, y: &Interval) -> Self {
        let (min, max) = (DVec2::new(x.min, y.min), DVec2::new(x.max, y.max));
        Self { centre: (min + max) * 0.5, half: (max - min) * 0.5 }
    }

    /// The same centre with other half extents.
    pub(crate) const fn with_half(self, half: DVec2) -> Self {
        Self { half, ..self }
    }

    pub(crate) fn corners(&self) -> [DVec2; 4] {
        [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)]
            .map(|signs| self.centre + self.half * DVec2::from(signs))
    }
}
