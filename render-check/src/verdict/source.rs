//! The light as the source of rays: what it reaches, and what stands in its way.

use anyhow::Result;
use shadowfit::Light;
use shadowfit::glam::DVec3;

use super::surface::Surface;
use crate::scene::LightSpec;
use crate::trace::{Ray, Tracer};

/// What the light does to a point of a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Illumination {
    /// It does not reach the point, whatever stands where: the side that is seen is turned away from the light, or the
    /// point lies outside of the light's cone or range, or nearer to a lamp than its map begins. A renderer shades such
    /// points black without asking the map, so they are not compared.
    Unlit,
    /// Something stands in its way.
    Shadow,
    /// It reaches the point.
    Lit,
    /// All that stands in its way is nearer to the lamp than its map begins. No caster is to be there, and where one is,
    /// it casts or does not: a map begins at a plane and holds some of what is so near. Such points are not compared.
    Either,
}

/// A light together with the distance at which its shadow map begins.
#[derive(Clone, Copy, Debug)]
pub(super) struct Source {
    spec: LightSpec,
    light: Light,
}

impl Source {
    /// The light, with `near` in world units; a sun has none and ignores it.
    ///
    /// # Errors
    ///
    /// When the light makes no sense.
    pub(super) fn new(spec: &LightSpec, near: f64) -> Result<Self> {
        Ok(Self { spec: *spec, light: spec.to_light(near)? })
    }

    /// Whether any of its light falls on the side of the surface that is seen, were nothing else there: the side is
    /// turned to the light, within its range and its cone, and not so near to it that the map has not begun.
    pub(super) fn reaches(&self, surface: &Surface) -> bool {
        let direction_to_light = self.light.direction_from(surface.point);
        surface.normal.dot(direction_to_light) > 0.0
            && match self.spec {
                LightSpec::Sun { .. } => true,
                LightSpec::Point { range, .. } => self.is_between_near_and(range, surface.point),
                LightSpec::Spot { position, target, cone_degrees, range } => {
                    let axis = (target - position).normalize_or_zero();
                    let cosine = axis.dot(-direction_to_light);
                    cosine > (0.5 * cone_degrees).to_radians().cos()
                        && self.is_between_near_and(range, surface.point)
                }
            }
    }

    fn is_between_near_and(&self, range: f64, point: DVec3) -> bool {
        (self.light.near()..=range).contains(&self.distance_from(point))
    }

    /// Whether anything stands between a point on a surface with this unit normal, on the lit side, and the light, and
    /// whether it is as far from a lamp as casters are to be.
    pub(super) fn illumination(&self, tracer: &Tracer, point: DVec3, normal: DVec3) -> Illumination {
        let (origin, direction) = (tracer.off_surface(point, normal), self.light.direction_from(point));
        let is_blocked = |length| length > 0.0 && tracer.is_blocked(&Ray { origin, direction, length });
        let distance = self.distance_from(point);
        if is_blocked(distance - self.light.near()) {
            Illumination::Shadow
        } else if self.light.position().is_some() && is_blocked(distance - tracer.surface_offset()) {
            // What is a hair from the lamp is on neither side of it.
            Illumination::Either
        } else {
            Illumination::Lit
        }
    }

    /// The ray of light that ends at a point: from where a lamp's map begins, or from beyond the scene for a sun.
    /// `None` for a point nearer to a lamp than that.
    pub(super) fn ray_to(&self, tracer: &Tracer, point: DVec3) -> Option<Ray> {
        let direction_to_light = self.light.direction_from(point);
        let length = if self.light.position().is_some() {
            self.distance_from(point) - self.light.near()
        } else {
            // Half a diagonal leads out of the box from its middle; a whole one leaves no doubt.
            let (min, max) = tracer.bounds();
            point.distance(0.5 * (min + max)) + (max - min).length()
        };
        let origin = point + length * direction_to_light;
        (length > 0.0).then_some(Ray { origin, direction: -direction_to_light, length })
    }

    fn distance_from(&self, point: DVec3) -> f64 {
        self.light.position().map_or(f64::INFINITY, |position| position.distance(point))
    }
}
