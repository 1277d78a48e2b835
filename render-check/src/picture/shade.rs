//! Shading of ray hits.

use shadowfit::glam::{DVec3, FloatExt};

use super::canvas::{Colour, mix};
use crate::scene::{LightSpec, Mesh};
use crate::trace::{Hit, Ray, Tracer};

/// How a light falls on surfaces.
#[derive(Clone, Copy, Debug)]
pub struct Lighting {
    light: LightSpec,
    /// The distance from a local light at which it is as bright as a sun.
    full_at: f64,
}

impl Lighting {
    /// The light, with a brightness that exposes `subject` well.
    #[must_use]
    pub fn new(light: LightSpec, subject: DVec3) -> Self {
        let full_at = light.position().map_or(1.0, |position| position.distance(subject));
        Self { light, full_at }
    }

    /// Lambert's law with a ray-traced shadow, plus unshadowed ambient light from the sky.
    #[must_use]
    pub fn shade(&self, tracer: &Tracer, hit: &Hit, ray: &Ray) -> Colour {
        self.shade_by(tracer.mesh(), hit, ray, |direction_to_light, distance| {
            if tracer.is_shadowed(hit, ray, direction_to_light, distance) { 0.0 } else { 1.0 }
        })
    }

    /// The same with given shadows: `lit` returns the lit fraction, 0 to 1, for the direction to the light and its
    /// distance; it is only called where the light contributes.
    #[must_use]
    pub(super) fn shade_by(
        &self,
        mesh: &Mesh,
        hit: &Hit,
        ray: &Ray,
        lit: impl FnOnce(DVec3, f64) -> f64,
    ) -> Colour {
        let base = mesh.colours[hit.triangle];
        let normal = hit.shading_normal;
        let sky = 0.13 + 0.07 * normal.y + 0.06 * normal.dot(-ray.direction).max(0.0);
        let direct = 0.95 * self.direct(hit, ray, lit);
        let light = [sky + direct, sky + 0.94 * direct, 1.2 * sky + 0.84 * direct];
        [0, 1, 2].map(|i| base[i] * light[i] as f32)
    }

    /// The direct light: 1 where a surface faces it at the reference distance, unshadowed.
    fn direct(&self, hit: &Hit, ray: &Ray, lit: impl FnOnce(DVec3, f64) -> f64) -> f64 {
        let (direction_to_light, distance) = match self.light.position() {
            Some(position) => ((position - hit.point).normalize_or(DVec3::Y), position.distance(hit.point)),
            None => (self.sun_direction(), f64::INFINITY),
        };
        let cosine = hit.shading_normal.dot(direction_to_light);
        // The geometric normal must face the light too: a smooth normal may face it where the flat triangle does
        // not.
        let side = if hit.is_back_face(ray) { -1.0 } else { 1.0 };
        let strength = self.strength(direction_to_light, distance);
        if cosine <= 0.0 || side * hit.face_normal.dot(direction_to_light) <= 0.0 || strength <= 0.0 {
            return 0.0;
        }
        cosine * strength * lit(direction_to_light, distance)
    }

    fn sun_direction(&self) -> DVec3 {
        match self.light {
            LightSpec::Sun { direction_to_light } => direction_to_light.normalize_or(DVec3::Y),
            _ => DVec3::Y,
        }
    }

    fn strength(&self, direction_to_light: DVec3, distance: f64) -> f64 {
        // Inverse-square falloff, bounded close to the light.
        let fading = |range: f64| {
            let relative = distance / self.full_at;
            if distance > range { 0.0 } else { 2.0 / (1.0 + relative * relative) }
        };
        match self.light {
            LightSpec::Sun { .. } => 1.0,
            LightSpec::Point { range, .. } => fading(range),
            LightSpec::Spot { position, target, cone_degrees, range } => {
                let axis = (target - position).normalize_or(DVec3::NEG_Y);
                let edge = (0.5 * cone_degrees).to_radians().cos();
                // A narrow soft edge inside the cone: the outer 1/30 of 1 − cos.
                let inner = edge.lerp(1.0, 1.0 / 30.0);
                let cosine = axis.dot(-direction_to_light);
                fading(range) * ((cosine - edge) / (inner - edge)).clamp(0.0, 1.0)
            }
        }
    }
}

/// The background: paler at the bottom, where `height` is 0, than at the top, where it is 1.
#[must_use]
pub(super) fn background(height: f32) -> Colour {
    mix([0.78, 0.82, 0.86], [0.36, 0.47, 0.62], height)
}
