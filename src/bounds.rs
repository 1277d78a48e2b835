//! Intervals and rectangles around values.

use glam::DVec2;

/// An interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Interval {
    pub(crate) min: f64,
    pub(crate) max: f64,
}

impl Interval {
    /// The least interval around values; upside down for none.
    pub(crate) fn around(values: impl Iterator<Item = f64>) -> Self {
        values.fold(Self { min: f64::INFINITY, max: f64::NEG_INFINITY }, |interval, value| Self {
            min: interval.min.min(value),
            max: interval.max.max(value),
        })
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
    /// The least rectangle around points; there must be one.
    pub(crate) fn around(points: impl Iterator<Item = DVec2>) -> Self {
        let (min, max) = points.fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(min, max), point| {
            (min.min(point), max.max(point))
        });
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
