//! The projection of a paraboloid map.

use shadowfit::depth::DepthBias;
use shadowfit::glam::{DVec2, DVec3};
use shadowfit::omni::Paraboloid;

use super::projection::Projection;
use crate::maps::BENT;

/// The projection of a fitted [`Paraboloid`].
#[derive(Clone, Debug)]
pub struct Hemisphere {
    map: Paraboloid,
}

impl Hemisphere {
    /// The projection of a map.
    #[must_use]
    pub fn new(map: &Paraboloid) -> Self {
        Self { map: map.clone() }
    }

    /// Texels for a step of 1 in u or v.
    fn scale(&self) -> f64 {
        self.middle() - f64::from(self.map.settings().border())
    }

    fn middle(&self) -> f64 {
        0.5 * f64::from(self.size())
    }
}

impl Projection for Hemisphere {
    fn size(&self) -> u32 {
        self.map.settings().map_size()
    }

    /// There is none for the light itself, nor straight behind it.
    fn place(&self, point: DVec3) -> Option<DVec3> {
        let place = self.map.project(point)?;
        let across = DVec2::new(place.x, -place.y) * self.scale() + self.middle();
        Some(across.extend(place.z))
    }

    fn on_plane(&self, point: DVec3, normal: DVec3, place: DVec2) -> Option<DVec3> {
        let across = (place - self.middle()) / self.scale();
        let far_off = self.map.unproject(DVec3::new(across.x, -across.y, 1.0));
        let ray = far_off - self.map.position();
        // Relative to `point`, which is nearby.
        let along = ray * (normal.dot(point - self.map.position()) / normal.dot(ray));
        let found = self.map.position() + along;
        (found.is_finite() && along.dot(ray) > 0.0).then_some(found)
    }

    fn slopes(&self, point: DVec3, normal: DVec3) -> Option<DVec2> {
        let slopes = self.map.distance_slopes(point, normal)?;
        Some(slopes.abs() / (self.map.far() - self.map.near()))
    }

    /// The largest deviation of a caster that is tessellated finely enough: see [`Paraboloid::edge_error`]. Other
    /// casters may be missing from the map.
    fn rounding(&self, point: DVec3) -> (f64, f64) {
        let rounding = self.map.rounding(point);
        (rounding.texels + 4.0 / 3.0 * BENT, rounding.depth)
    }

    /// The largest depth of the plane within the reach of the bias.
    fn slope_bias(&self, depth: f64, slopes: DVec2, slope: f64) -> f64 {
        let range = self.map.far() - self.map.near();
        let distance = depth + self.map.near() / range;
        let relative = slope * slopes.element_sum() / distance;
        // The plane's curvature within the reach is negligible.
        let curved = 1.0 - 1.01 * relative - 1e-4;
        if curved > 0.0 { distance / curved - distance } else { f64::INFINITY }
    }

    /// Along a tessellated edge of the largest length the distance r from the light changes by Δ. The rasteriser
    /// interpolates distances linearly where the true ones are harmonic, see [`Paraboloid::edge_depth_error`]: too
    /// far by (r₂ − r₁)²/(√r₂ + √r₁)², which is at most Δ²/r for any r in between. Where Δ ≥ r the light sees the
    /// plane edge-on, and the edge may start at the light.
    fn bend(&self, depth: f64, slopes: DVec2) -> f64 {
        let change = self.map.largest_edge(BENT) * self.scale() * slopes.element_sum();
        let distance = depth + self.map.near() / (self.map.far() - self.map.near());
        if change < distance { 4.0 / 3.0 * change * change / distance } else { f64::INFINITY }
    }

    fn bias_distance(&self, point: DVec3, normal: DVec3, bias: &DepthBias) -> f64 {
        self.map.bias_distance(point, normal, bias)
    }

    fn aliasing(&self, point: DVec3) -> f64 {
        self.map.aliasing(point).unwrap_or(f64::INFINITY)
    }
}

#[cfg(test)]
mod tests {
    use shadowfit::{Focus, Light, Scene, Settings};

    use super::*;
    use crate::verdict::fake;

    #[test]
    fn places_on_a_plane_are_where_they_should_be() {
        let light = Light::point(DVec3::new(0.4, 1.5, -0.7), 0.01, f64::INFINITY).expect("sound");
        let (min, max) = fake::mesh().bounds();
        let scene = Scene::from_box(min, max).expect("sound");
        let settings = Settings::new(256, 128).and_then(|settings| settings.with_border(4)).expect("sound");
        let fitted = Focus::new(&fake::view(), &light, &scene).paraboloids(&settings);
        assert!(!fitted.maps().is_empty());
        for map in fitted.maps() {
            let hemisphere = Hemisphere::new(map);
            let normal = DVec3::new(0.2, 0.9, -0.3).normalize();
            let point = map.position() + map.axis() * 1.1 + 0.4 * map.axis().any_orthonormal_vector();
            let place = hemisphere.place(point).expect("in the map");
            let expected = map.project(point).expect("in the map");
            assert_eq!(place, DVec3::new(128.0 + 124.0 * expected.x, 128.0 - 124.0 * expected.y, expected.z));
            assert_eq!(hemisphere.index(place.truncate()), Some(place.y as usize * 256 + place.x as usize));
            let slopes = hemisphere.slopes(point, normal).expect("not seen from its edge");
            for (step, slope) in [(DVec2::X, slopes.x), (DVec2::Y, slopes.y)] {
                let step = 1e-3 * step;
                let aside =
                    hemisphere.on_plane(point, normal, place.truncate() + step).expect("it meets the plane");
                assert!(normal.dot(aside - point).abs() < 1e-12);
                let there = hemisphere.place(aside).expect("in the map");
                assert!((there.truncate() - place.truncate() - step).length() < 1e-9);
                // Over the width of the map the depth slope changes by a few times its own size.
                assert!(((there.z - place.z).abs() / 1e-3 - slope).abs() < 1e-4 * slope + 1e-7, "{there} {place}");
            }
        }
    }
}
