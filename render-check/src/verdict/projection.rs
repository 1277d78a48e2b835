//! Maps as places: where in a map a point falls, where a surface passes a place, and how steep it is there.

use std::fmt;

use shadowfit::glam::{DVec2, DVec3};

/// How a map lays out the world in its texels.
///
/// A place is a column, counted in texels from the left edge, a row, counted from the top edge, and a depth from 0 to 1
/// away from the light, whatever the map's clip space. All points on one ray of light have one column and row.
///
/// The verdict knows nothing else of a map's geometry: a map that is no frustum implements this, and is judged.
pub trait Projection: fmt::Debug + Sync {
    /// Texels a side.
    fn size(&self) -> u32;

    /// Where a point falls; `None` where the map has no place for it, as behind a frustum.
    fn place(&self, point: DVec3) -> Option<DVec3>;

    /// The point that falls on a place, on the plane through `point` across `normal`; `None` where the ray of light
    /// through that place does not meet the plane.
    ///
    /// `point` lies within a few texels of what is found: places are asked for around one that was seen.
    fn on_plane(&self, point: DVec3, normal: DVec3, place: DVec2) -> Option<DVec3>;

    /// How much the depth of the plane through `point` across `normal` changes, at that point, from one column to the
    /// next and from one row to the next; never negative. `None` where the light sees the plane from its edge.
    fn slopes(&self, point: DVec3, normal: DVec3) -> Option<DVec2>;

    /// What a bias by slope adds to the depth of a plane with these slopes, at most. A rasteriser multiplies the larger one.
    fn slope_bias(&self, _depth: f64, slopes: DVec2, slope: f64) -> f64 {
        slope * slopes.max_element()
    }

    /// How far a card can carry a point within the map, by the rounding of what it computes in f32 and by what it makes of
    /// the map's shape: texels across, and depth.
    fn rounding(&self, point: DVec3) -> (f64, f64);

    /// How much farther than it lies a plane with these slopes may be drawn, at a depth, where a map bends lines that a card
    /// draws straight.
    fn bend(&self, _depth: f64, _slopes: DVec2) -> f64 {
        0.0
    }

    /// How much larger a texel is than a pixel at a point, see [`shadowfit::ShadowMap::aliasing`]; infinite outside of the map.
    fn aliasing(&self, point: DVec3) -> f64;

    /// The texel that holds a place, as an index into rows from the top; `None` outside of the map.
    fn index(&self, place: DVec2) -> Option<usize> {
        let size = f64::from(self.size());
        let is_inside = place.cmpge(DVec2::ZERO).all() && place.cmplt(DVec2::splat(size)).all();
        is_inside.then(|| place.y as usize * self.size() as usize + place.x as usize)
    }
}
