//! The camera's image, in pixels.

use crate::convex::Plane;
use crate::input::view::View;
use glam::{DVec2, DVec3};

/// What a view shows of steps in the world, in pixels.
pub(crate) struct Image {
    x: Plane,
    y: Plane,
    w: Plane,
    /// Pixels from the middle of the image to its sides.
    half: DVec2,
    view: View,
    height: u32,
}

impl Image {
    /// The image of a view, so many pixels high.
    pub(crate) fn new(view: &View, height: u32) -> Self {
        let [x, y, _, w] = view.rows(view.near(), view.far());
        let half = 0.5 * f64::from(height);
        Self { x, y, w, half: DVec2::new(half * view.aspect(), half), view: *view, height }
    }

    /// The move in the image of a small step from a point.
    pub(crate) fn step(&self, point: DVec3, step: DVec3) -> DVec2 {
        let at = self.w.at(point);
        let row = |row: &Plane| (row.normal - self.w.normal * (row.at(point) / at)).dot(step) / at;
        DVec2::new(row(&self.x), row(&self.y)) * self.half
    }

    /// The side of a pixel at a point, in world units.
    pub(crate) fn pixel(&self, point: DVec3) -> f64 {
        self.view.pixel_size(point, self.height)
    }
}
