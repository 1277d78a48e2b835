//! The projection of a frustum map: one matrix.

use shadowfit::depth::DepthBias;
use shadowfit::glam::{DVec2, DVec3, DVec4, Vec4Swizzles};
use shadowfit::{ClipSpace, ShadowMap};

use super::projection::Projection;

/// The rounding error of one row of an f32 matrix at a point, relative to the sum of the magnitudes of its four
/// terms: at most six ulps for the products and their sum, and two for the roundings after the division by w.
const F32_ROUNDING: f64 = 8.0 / 16_777_216.0;

/// The projection of a fitted [`ShadowMap`].
#[derive(Clone, Debug)]
pub struct Frustum {
    map: ShadowMap,
    /// The rows of the matrix: x, y up, depth from 0 to 1, and w, each to be divided by w.
    x: DVec4,
    y: DVec4,
    depth: DVec4,
    w: DVec4,
    /// The origin of the f32 matrix, in world space.
    origin: DVec3,
}

impl Frustum {
    /// The projection of a map.
    #[must_use]
    pub fn new(map: &ShadowMap) -> Self {
        let clip_from_world = map.clip_from_world_in(ClipSpace::WGPU);
        let [x, y, depth, w] = [0, 1, 2, 3].map(|i| clip_from_world.row(i));
        let origin = map.origin();
        Self { map: map.clone(), x, y, depth, w, origin }
    }

    /// Texels for each unit of clip space, which is two units wide.
    fn scale(&self) -> f64 {
        0.5 * f64::from(self.size())
    }
}

impl Projection for Frustum {
    fn size(&self) -> u32 {
        self.map.settings().map_size()
    }

    /// There is no such point behind the map, where w is not positive.
    fn place(&self, point: DVec3) -> Option<DVec3> {
        let point = point.extend(1.0);
        let w = self.w.dot(point);
        let clip = DVec3::new(self.x.dot(point), self.y.dot(point), self.depth.dot(point)) / w;
        let place = DVec3::new(self.scale() * (clip.x + 1.0), self.scale() * (1.0 - clip.y), clip.z);
        (w > 0.0).then_some(place)
    }

    fn on_plane(&self, point: DVec3, normal: DVec3, place: DVec2) -> Option<DVec3> {
        // A column is a plane through the light, and so is a row: the point is their intersection with the given
        // plane. It is computed relative to `point`, which is nearby, so that large coordinates cancel only once.
        let column = self.x - (place.x / self.scale() - 1.0) * self.w;
        let row = self.y - (1.0 - place.y / self.scale()) * self.w;
        let [along_column, along_row] = steps_on_plane(column.xyz(), row.xyz(), normal)?;
        let off = DVec2::new(column.dot(point.extend(1.0)), row.dot(point.extend(1.0)));
        let found = point - off.x * along_column - off.y * along_row;
        (found.is_finite() && self.w.dot(found.extend(1.0)) > 0.0).then_some(found)
    }

    /// The slopes are constant over the plane.
    fn slopes(&self, point: DVec3, normal: DVec3) -> Option<DVec2> {
        let w = self.w.dot(point.extend(1.0));
        let gradient = |row: DVec4| (row.xyz() - row.dot(point.extend(1.0)) / w * self.w.xyz()) / w;
        let [along_x, along_y] = steps_on_plane(gradient(self.x), gradient(self.y), normal)?;
        let depth = gradient(self.depth) / self.scale();
        let slopes = DVec2::new(depth.dot(along_x), depth.dot(along_y)).abs();
        slopes.is_finite().then_some(slopes)
    }

    fn rounding(&self, point: DVec3) -> (f64, f64) {
        let magnitude = |row: DVec4| {
            let terms = row.xyz() * (point - self.origin);
            terms.abs().element_sum() + row.dot(self.origin.extend(1.0)).abs()
        };
        let relative = F32_ROUNDING / self.w.dot(point.extend(1.0)).abs();
        // The rounding of w also affects x, y and depth, none of which exceeds one after the division.
        let of = |row: DVec4| relative * (magnitude(row) + magnitude(self.w));
        (self.scale() * of(self.x).max(of(self.y)), of(self.depth))
    }

    fn bias_distance(&self, point: DVec3, normal: DVec3, bias: &DepthBias) -> f64 {
        self.map.bias_distance(point, normal, bias)
    }

    fn aliasing(&self, point: DVec3) -> f64 {
        self.map.aliasing(point).unwrap_or(f64::INFINITY)
    }
}

/// The vectors in a plane that change one of two functions by one and leave the other unchanged, from the
/// functions' gradients and the plane's normal; `None` where there are none.
fn steps_on_plane(first: DVec3, second: DVec3, normal: DVec3) -> Option<[DVec3; 2]> {
    let volume = first.dot(second.cross(normal));
    (volume != 0.0).then(|| [second.cross(normal) / volume, normal.cross(first) / volume])
}

#[cfg(test)]
mod tests {
    use shadowfit::Warp;

    use super::*;
    use crate::trace::Lens;
    use crate::verdict::fake::{self, LAMP, SUN};

    #[test]
    fn places_on_a_plane_are_where_they_should_be() {
        let (normal, point) = (DVec3::new(0.2, 0.9, -0.3).normalize(), DVec3::new(0.4, 0.2, -0.6));
        for (light, warp) in [(SUN, Warp::Uniform), (SUN, Warp::Perspective), (LAMP, Warp::Perspective)] {
            let map = fake::fitted(&light, &fake::settings().with_warp(warp));
            let frustum = Frustum::new(&map);
            let lens = Lens::new(map.clip_from_world_in(ClipSpace::WGPU)).expect("invertible");
            let place = frustum.place(point).expect("in the map");
            let clip = lens.project(point);
            let expected = DVec3::new(128.0 * (1.0 + clip.x), 128.0 * (1.0 - clip.y), clip.z);
            assert!((place - expected).length() < 1e-10, "{place}, not {expected}");
            assert_eq!(frustum.index(place.truncate()), Some(place.y as usize * 256 + place.x as usize));

            let slopes = frustum.slopes(point, normal).expect("not seen from its edge");
            for (step, slope) in [(DVec2::X, slopes.x), (DVec2::Y, slopes.y), (-7.5 * DVec2::Y, 7.5 * slopes.y)] {
                let aside = frustum.on_plane(point, normal, place.truncate() + step).expect("it meets the plane");
                assert!((aside - point).dot(normal).abs() < 1e-12);
                let aside = frustum.place(aside).expect("in the map");
                assert!((aside.truncate() - place.truncate() - step).length() < 1e-9, "{aside}");
                assert!(((aside.z - place.z).abs() - slope).abs() < 1e-12, "{} and {slope}", aside.z - place.z);
            }
        }
    }

    #[test]
    fn a_plane_seen_from_its_edge_is_endlessly_steep() {
        let map = fake::fitted(&SUN, &fake::settings());
        let frustum = Frustum::new(&map);
        let slopes = frustum.slopes(DVec3::new(0.4, 0.2, -0.6), DVec3::new(1.0, -0.5, 0.0).normalize());
        assert!(slopes.is_none_or(|slopes| slopes.max_element() > 1e9), "{slopes:?}");
    }

    #[test]
    fn what_is_beside_the_map_has_no_texel() {
        let map = fake::fitted(&SUN, &fake::settings());
        let frustum = Frustum::new(&map);
        for outside in [DVec2::new(-0.1, 3.0), DVec2::new(3.0, 256.0), DVec2::new(f64::NAN, 3.0)] {
            assert_eq!(frustum.index(outside), None);
        }
        assert_eq!(frustum.index(DVec2::new(255.9, 1.0)), Some(511));
    }

    #[test]
    fn rounding_covers_what_the_f32_matrix_does() {
        let map = fake::fitted(&LAMP, &fake::settings());
        let frustum = Frustum::new(&map);
        let matrix = map.caster_matrix();
        for i in 0..1000 {
            let point =
                DVec3::new(f64::from(i % 10) - 4.5, 0.13 * f64::from(i / 100), 0.7 - f64::from(i / 10 % 10)) * 0.77;
            let clip = matrix * point.as_vec3().extend(1.0);
            let clip = (clip.truncate() / clip.w).as_dvec3();
            let place = frustum.place(point).expect("in the map");
            let (across, depth) = frustum.rounding(point);
            let off = (DVec3::new(128.0 * (1.0 + clip.x), 128.0 * (1.0 - clip.y), clip.z) - place).abs();
            assert!(off.x <= across && off.y <= across && off.z <= depth, "{off} and {across}, {depth}");
            assert!(across < 1e-2 && depth < 1e-4, "{across}, {depth}");
        }
    }
}
