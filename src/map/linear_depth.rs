//! Distances along a map's axis: linear depth, and world distances as parts of the way to a local light.

use crate::convex::Plane;
use crate::math::bounds::Interval;
use crate::warp::rays::Rays;
use crate::warp::rounding::QUIET;

/// Distances along the axis of a map: of the receivers, and of the range of linear depth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LinearDepth {
    /// Distance along the axis from the light or, when it is infinitely far away, from a point of the map's own.
    distance: Plane,
    /// Of the receivers.
    visible: Interval,
    /// The range of linear depth.
    range: Interval,
}

impl LinearDepth {
    /// `nearest` is where the first caster in the window is, `rounding` the error of distances in f32, `least` the least
    /// length of a range.
    pub(crate) fn new(rays: &Rays, nearest: f64, visible: Interval, rounding: f64, least: f64) -> Self {
        // As a depth range is padded: both ends by the rounding, and the length for a scene seen from straight above.
        let missing = 0.5 * (least.max(QUIET * rounding) - (visible.max - nearest)).max(0.0);
        let range = Interval { min: nearest - rounding - missing, max: visible.max + rounding + missing };
        Self { distance: rays.along, visible, range }
    }

    /// The same with another range of linear depth.
    pub(crate) fn with_range(self, range: impl FnOnce(&Interval) -> Interval) -> Self {
        Self { range: range(&self.range), ..self }
    }

    /// Distance as depth from 0 to 1.
    pub(crate) fn linear_depth(&self) -> Plane {
        (self.distance - Plane::ONE * self.range.min) * (self.range.max - self.range.min).recip()
    }

    /// The g for which every receiver X, moved to X + g (p, 1), is nearer to a light at p by `distance` or more.
    ///
    /// X + g (p, 1) is the point X moved towards p by the part g/(1 + g) of its distance D: h/(D − h) moves it by h. D is at
    /// least the distance a along the axis, and the chord of the convex function h/(a − h) over all receivers lies above it.
    /// Exact at both ends, on the axis; a constant g would be too much by the ratio of the ends at the far one.
    ///
    /// No point is moved by more than half of the nearest receiver's distance along the axis.
    pub(crate) fn part_of_light(&self, distance: f64) -> Plane {
        let (near, far) = (self.visible.min, self.visible.max);
        let h = distance.min(0.5 * near);
        let scale = h / ((near - h) * (far - h));
        (Plane::ONE * (near + far - h) - self.distance) * scale
    }
}
