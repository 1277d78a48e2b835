//! The projection of a map: from world space to texels and depth and back, and slopes.

use std::fmt;

use shadowfit::depth::DepthBias;
use shadowfit::glam::{DVec2, DVec3};

/// The projection of a map.
///
/// A *place* in a map is a column, in texels from the left edge, a row, in texels from the top edge, and a depth
/// from 0 to 1 away from the light, independent of the map's clip space. All points of a light ray share column and
/// row.
///
/// The verdict needs nothing else of a map's geometry, so that any kind of map can be judged by implementing this.
pub trait Projection: fmt::Debug + Sync {
    /// Texels per side.
    fn size(&self) -> u32;

    /// The place of a point; `None` outside the map's domain, as behind a frustum.
    fn place(&self, point: DVec3) -> Option<DVec3>;

    /// The point at the column and row of `place` on the plane through `point` with `normal`; `None` where the
    /// light ray misses the plane.
    ///
    /// `point` is within a few texels of the result.
    fn on_plane(&self, point: DVec3, normal: DVec3, place: DVec2) -> Option<DVec3>;

    /// The absolute depth slopes of the plane through `point` with `normal`, per column and per row. `None` where
    /// the light sees the plane edge-on.
    fn slopes(&self, point: DVec3, normal: DVec3) -> Option<DVec2>;

    /// The largest depth that a slope-scaled bias adds to a plane with these slopes. A rasteriser scales the larger
    /// one.
    fn slope_bias(&self, _depth: f64, slopes: DVec2, slope: f64) -> f64 {
        slope * slopes.max_element()
    }

    /// The largest error of a drawn point, from f32 rounding and from edges drawn straight: in texels, and in
    /// depth.
    fn rounding(&self, point: DVec3) -> (f64, f64);

    /// The largest depth error, away from the light, of a plane with these slopes at a depth, in maps that bend
    /// edges which the rasteriser draws straight.
    fn bend(&self, _depth: f64, _slopes: DVec2) -> f64 {
        0.0
    }

    /// How far behind a caster a receiver may be and still be lit with a bias derived from the map, in world units along
    /// the light ray through a point of the caster, see [`shadowfit::ShadowMap::bias_distance`].
    fn bias_distance(&self, point: DVec3, normal: DVec3, bias: &DepthBias) -> f64;

    /// The aliasing at a point, texel size over pixel size, see [`shadowfit::ShadowMap::aliasing`]; infinite
    /// outside the map.
    fn aliasing(&self, point: DVec3) -> f64;

    /// The index of the texel at a place, row by row from the top; `None` outside the map.
    fn index(&self, place: DVec2) -> Option<usize> {
        let size = f64::from(self.size());
        let is_inside = place.cmpge(DVec2::ZERO).all() && place.cmplt(DVec2::splat(size)).all();
        is_inside.then(|| place.y as usize * self.size() as usize + place.x as usize)
    }
}
