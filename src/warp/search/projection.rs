//! From points on surfaces to numbers on the chart of rays.

use super::chart::Chart;
use crate::input::view::Image;
use crate::seen::SeenPoint;
use crate::settings::objective::{BIAS, LEAST_INCIDENCE, SLOPE};
use crate::warp::rays::Rays;
use glam::{DVec2, DVec3};

/// The numbers of one point, in the order of [`Four`].
pub(super) type Values = [f32; 10];

/// From points in the world to numbers on the chart.
pub(super) struct Projection<'a> {
    pub(super) image: Image,
    pub(super) rays: &'a Rays,
    pub(super) chart: &'a Chart,
    /// The distance of zero depth along the axis.
    pub(super) zero: f64,
}

impl Projection<'_> {
    /// The numbers of a point; `None` where hardly any light falls on its surface.
    pub(super) fn of(&self, point: &SeenPoint) -> Option<Values> {
        let Self { image, rays, chart, zero } = self;
        let (ray, w) = rays.through(point.position);
        let axes = rays.axes();
        // The ray with a unit step along the axis.
        let towards = if rays.local { axes[0] * ray.x + axes[1] * ray.y + axes[2] } else { axes[2] };
        let size = if rays.local { w } else { 1.0 };
        let pixel = image.pixel(point.position);
        // Depth along the axis becomes a distance along the ray, in pixels.
        let along = towards.length() / pixel;
        let (form, slope, side) = match point.normal.and_then(DVec3::try_normalize) {
            Some(normal) => {
                let incidence = -normal.dot(towards);
                if incidence < LEAST_INCIDENCE * towards.length() {
                    return None;
                }
                let slope = DVec2::new(normal.dot(axes[0]), normal.dot(axes[1])) * (size / incidence);
                let steps = [axes[0] * size + towards * slope.x, axes[1] * size + towards * slope.y];
                let [a, b] = steps.map(|step| image.step(point.position, step));
                ([a.dot(a), a.dot(b), b.dot(b)], slope, 1.0)
            }
            None => {
                // Across the ray, in a slope of 45°.
                let unit = towards.normalize();
                let steps = [axes[0], axes[1]].map(|axis| (axis - unit * axis.dot(unit)) * size);
                let slope = DVec2::new(axes[2].dot(steps[0]), axes[2].dot(steps[1]));
                let [a, b] = steps.map(|step| step / pixel);
                ([a.dot(a), a.dot(b), b.dot(b)], slope, 1.0 + 2.0 * BIAS * SLOPE)
            }
        };
        let tilt = if rays.local { w * (w / zero - 1.0) } else { rays.along.at(point.position) - zero };
        let (ray, half) = ((ray - chart.middle) / chart.half, chart.half);
        let [xx, xy, yy] = [form[0] * half.x * half.x, form[1] * half.x * half.y, form[2] * half.y * half.y];
        let bias = BIAS * SLOPE * along;
        let slope = slope * half * bias;
        let values =
            [ray.x, ray.y, xx, xy, yy, slope.x, slope.y, tilt * bias, side, point.pixels].map(|value| value as f32);
        values.iter().all(|value| value.is_finite()).then_some(values)
    }
}
