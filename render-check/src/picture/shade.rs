//! The colour of what a ray meets.

use shadowfit::glam::{DVec3, FloatExt};

use super::canvas::{Colour, mix};
use crate::scene::{LightSpec, Mesh};
use crate::trace::{Hit, Ray, Tracer};

/// How a light falls on surfaces.
#[derive(Clone, Copy, Debug)]
pub struct Lighting {
    light: LightSpec,
    /// The distance from a lamp at which its light is as bright as a sun's.
    full_at: f64,
}

impl Lighting {
    /// The light, so bright that what is at `subject` looks well exposed.
    #[must_use]
    pub fn new(light: LightSpec, subject: DVec3) -> Self {
        let full_at = light.position().map_or(1.0, |position| position.distance(subject));
        Self { light, full_at }
    }

    /// Lambert's law with a ray-traced shadow, over a soft light from the sky that nothing shadows.
    #[must_use]
    pub fn shade(&self, tracer: &Tracer, hit: &Hit, ray: &Ray) -> Colour {
        self.shade_by(tracer.mesh(), hit, ray, |direction_to_light, distance| {
            if tracer.is_shadowed(hit, ray, direction_to_light, distance) { 0.0 } else { 1.0 }
        })
    }

    /// The same with shadows from elsewhere: `lit` is asked which share of the light arrives, 0 to 1, given the
    /// direction towards the light and its distance; it is not asked where there is no light to shadow.
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

    /// What arrives from the light itself: 1 where a surface faces it, unshadowed and at the full distance.
    fn direct(&self, hit: &Hit, ray: &Ray, lit: impl FnOnce(DVec3, f64) -> f64) -> f64 {
        let (direction_to_light, distance) = match self.light.position() {
            Some(position) => ((position - hit.point).normalize_or(DVec3::Y), position.distance(hit.point)),
            None => (self.sun_direction(), f64::INFINITY),
        };
        let cosine = hit.shading_normal.dot(direction_to_light);
        // The face, too, must be turned to the light: a smooth normal may see what its flat triangle cannot.
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
        // Fades with the square of the distance, but not without bound close to the lamp.
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
                // A narrow soft edge inside the cone: the outer thirtieth of 1 − cos.
                let inner = edge.lerp(1.0, 1.0 / 30.0);
                let cosine = axis.dot(-direction_to_light);
                fading(range) * ((cosine - edge) / (inner - edge)).clamp(0.0, 1.0)
            }
        }
    }
}

/// What is seen where nothing is: paler towards the bottom, where `height` is 0, than at the top, where it is 1.
#[must_use]
pub(super) fn background(height: f32) -> Colour {
    mix([0.78, 0.82, 0.86], [0.36, 0.47, 0.62], height)
}
