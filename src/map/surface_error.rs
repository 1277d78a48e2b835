//! The error of a map at the surfaces in view: one number that goes with the pixels it gets wrong.

use crate::convex::Plane;
use crate::focus::Focus;
use crate::input::view::Image;
use crate::map::shadow_map::ShadowMap;
use crate::seen::SeenPoint;
use crate::settings::objective::{BIAS, LEAST_INCIDENCE, SLOPE};
use glam::{DVec2, DVec3};

/// The error of a map at the surfaces in view, in pixels ([`ShadowMap::surface_error`]).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct SurfaceError {
    /// The mean over pixels of [`Self::texel`] plus half of [`Self::bias`]: what [`Objective::Mean`](crate::warp::Objective::Mean)
    /// minimises.
    pub mean: f64,
    /// The root mean square of the same, which predicts the number of wrong pixels best.
    pub rms: f64,
    /// The mean over pixels of the mean side of a texel.
    pub texel: f64,
    /// The mean over pixels of the bias distance that the slope needs.
    pub bias: f64,
    /// The largest sum of both.
    pub worst: f64,
    /// The pixels that the surfaces stand for.
    pub pixels: f64,
}

impl ShadowMap {
    /// The error of the map at the surfaces in view: the number that [`Warp::Best`](crate::Warp::Best) minimises, comparable between
    /// maps, sizes, warps and cascades. `None` without lit surfaces.
    #[must_use]
    pub fn surface_error(&self, focus: &Focus<'_>) -> Option<SurfaceError> {
        let image = Image::new(focus.view(), self.settings.image_height());
        let (mut sum, mut texels, mut biases, mut pixels, mut worst) = (0.0, 0.0, 0.0, 0.0, 0.0_f64);
        focus.for_each_surface(|point| {
            let Some((texel, bias)) = self.at_surface(&image, &point) else { return };
            let error = texel + BIAS * bias;
            sum += error * error * point.pixels;
            texels += texel * point.pixels;
            biases += bias * point.pixels;
            pixels += point.pixels;
            worst = worst.max(error);
        });
        let root = |square: f64| DVec2::splat(square).sqrt().x;
        (pixels > 0.0).then(|| SurfaceError {
            mean: texels / pixels + BIAS * biases / pixels,
            rms: root(sum / pixels),
            texel: texels / pixels,
            bias: biases / pixels,
            worst,
            pixels,
        })
    }

    /// The mean side of a texel on the surface, and the distance by which its slope's bias detaches shadows, in pixels; `None` where
    /// the light does not fall on the surface.
    fn at_surface(&self, image: &Image, point: &SeenPoint) -> Option<(f64, f64)> {
        let position = point.position;
        let [x, y, z, w] = &self.rows;
        let at = w.at(position);
        let gradient = |row: &Plane| (row.normal - w.normal * (row.at(position) / at)) / at;
        let (x, y, z) = (gradient(x), gradient(y), gradient(z));
        let ray = -self.light.direction_from(position);
        let texel = 2.0 / self.settings.sides();
        let pixel = image.pixel(position);
        let normal = point.normal.and_then(DVec3::try_normalize);
        if normal.is_some_and(|normal| -normal.dot(ray) < LEAST_INCIDENCE) {
            return None;
        }
        // Steps that change one of x and y by one and leave the other: along the surface, or across the ray.
        let across = normal.unwrap_or(ray);
        let volume = x.dot(y.cross(across));
        let steps = [y.cross(across) * (texel.x / volume), across.cross(x) * (texel.y / volume)];
        let (mut side, mut bias) = (0.0, 0.0);
        for step in steps {
            let length = if normal.is_some() { image.step(position, step).length() } else { step.length() / pixel };
            side += 0.5 * length;
            let deeper = z.dot(step).abs() / z.dot(ray) / pixel;
            // In a slope of 45°, besides what w makes of depth.
            bias += SLOPE * (deeper + if normal.is_some() { 0.0 } else { length });
        }
        (side.is_finite() && bias.is_finite()).then_some((side, bias))
    }
}
