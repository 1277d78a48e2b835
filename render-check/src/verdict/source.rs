//! Light rays: what a light reaches, and what blocks it.

use anyhow::Result;
use shadowfit::Light;
use shadowfit::glam::DVec3;

use super::surface::Surface;
use crate::scene::LightSpec;
use crate::trace::{Ray, Tracer};

/// How a light reaches a surface point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Illumination {
    /// Unlit whatever casts shadows: the visible side faces away from the light, or the point is outside the
    /// light's cone or range, or closer to a local light than its near plane. A renderer shades such points black
    /// without a shadow test, so they are not compared.
    Unlit,
    /// In shadow: something blocks the light.
    Shadow,
    /// Lit.
    Lit,
    /// Blocked only by something closer to a local light than its near plane. Casters should not be there; one that
    /// is may cast or not, as the near plane of a map cuts through it. Such points are not compared.
    Either,
}

/// A light with its near plane.
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
    /// When the light is invalid.
    pub(super) fn new(spec: &LightSpec, near: f64) -> Result<Self> {
        Ok(Self { spec: *spec, light: spec.to_light(near)? })
    }

    /// Whether an unblocked light would reach the visible side of the surface: it faces the light, within its cone
    /// and between its near plane and its range.
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

    /// How the light reaches a surface point with this unit normal, which is on the lit side.
    pub(super) fn illumination(&self, tracer: &Tracer, point: DVec3, normal: DVec3) -> Illumination {
        let (origin, direction) = (tracer.off_surface(point, normal), self.light.direction_from(point));
        let is_blocked = |length| length > 0.0 && tracer.is_blocked(&Ray { origin, direction, length });
        let distance = self.distance_from(point);
        if is_blocked(distance - self.light.near()) {
            Illumination::Shadow
        } else if self.light.position().is_some() && is_blocked(distance - tracer.surface_offset()) {
            // A surface through the light itself is on neither side of it.
            Illumination::Either
        } else {
            Illumination::Lit
        }
    }

    /// The light ray that ends at a point, starting at the near plane of a local light, or outside the scene for a
    /// sun. `None` for a point closer to a local light than its near plane.
    pub(super) fn ray_to(&self, tracer: &Tracer, point: DVec3) -> Option<Ray> {
        let direction_to_light = self.light.direction_from(point);
        let length = if self.light.position().is_some() {
            self.distance_from(point) - self.light.near()
        } else {
            // Half a diagonal leads out of the box from its middle; a whole one is safe.
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
