//! The texels of a map as places: where in them a point falls, where a surface passes one, and how steep it is there.

use shadowfit::glam::{DVec2, DVec3, DVec4, Vec4Swizzles};
use shadowfit::{ClipSpace, Map, Origin};

/// Rounding of one row of an f32 matrix at a point, relative to the sum of the magnitudes of its four terms: at most six
/// units in the last place for the products and their sum, and two for what is rounded after the division by w.
const F32_ROUNDING: f64 = 8.0 / 16_777_216.0;

/// A map's projection as places in its texels.
///
/// A place is a column, counted in texels from the left edge, a row, counted from the top edge, and a depth from 0 to 1
/// away from the light, whatever the map's clip space.
#[derive(Clone, Copy, Debug)]
pub(super) struct Texels {
    /// The rows of the matrix: x, y up, depth from 0 to 1, and w, each to be divided by w.
    x: DVec4,
    y: DVec4,
    depth: DVec4,
    w: DVec4,
    /// Texels a side.
    size: u32,
    /// What the f32 matrix takes positions relative to, in world space.
    origin: DVec3,
}

impl Texels {
    /// The texels of a map that was fitted to a view with its eye there.
    pub(super) fn new(map: &Map, eye: DVec3) -> Self {
        let clip_from_world = map.shadow_from_world_in(ClipSpace::WGPU);
        let [x, y, depth, w] = [0, 1, 2, 3].map(|i| clip_from_world.row(i));
        let origin = match map.settings().origin() {
            Origin::World => DVec3::ZERO,
            Origin::Eye => eye,
        };
        Self { x, y, depth, w, size: map.settings().map_size(), origin }
    }

    /// Texels for each unit of clip space, which is two units wide.
    fn scale(&self) -> f64 {
        0.5 * f64::from(self.size)
    }

    /// Where a point falls; `None` behind the map, where w is not positive.
    pub(super) fn place(&self, point: DVec3) -> Option<DVec3> {
        let point = point.extend(1.0);
        let w = self.w.dot(point);
        let clip = DVec3::new(self.x.dot(point), self.y.dot(point), self.depth.dot(point)) / w;
        let place = DVec3::new(self.scale() * (clip.x + 1.0), self.scale() * (1.0 - clip.y), clip.z);
        (w > 0.0).then_some(place)
    }

    /// The texel that holds a place, as an index into rows from the top; `None` outside of the map.
    pub(super) fn index(&self, place: DVec2) -> Option<usize> {
        let size = f64::from(self.size);
        let is_inside = place.cmpge(DVec2::ZERO).all() && place.cmplt(DVec2::splat(size)).all();
        is_inside.then(|| place.y as usize * self.size as usize + place.x as usize)
    }

    /// The point that falls on a place, on the plane through `point` across `normal`; `None` where the ray of light
    /// through that place does not meet the plane.
    pub(super) fn on_plane(&self, point: DVec3, normal: DVec3, place: DVec2) -> Option<DVec3> {
        // A column is a plane through the light, and so is a row: the point is where both meet the third plane. It is
        // found relative to `point`, which lies close by, so that large coordinates cancel but once.
        let column = self.x - (place.x / self.scale() - 1.0) * self.w;
        let row = self.y - (1.0 - place.y / self.scale()) * self.w;
        let [along_column, along_row] = steps_on_plane(column.xyz(), row.xyz(), normal)?;
        let off = DVec2::new(column.dot(point.extend(1.0)), row.dot(point.extend(1.0)));
        let found = point - off.x * along_column - off.y * along_row;
        (found.is_finite() && self.w.dot(found.extend(1.0)) > 0.0).then_some(found)
    }

    /// How much the depth of the plane through `point` across `normal` changes from one column to the next and from one
    /// row to the next; never negative. It is the same everywhere on the plane. `None` where the light sees the plane
    /// from its edge.
    pub(super) fn slopes(&self, point: DVec3, normal: DVec3) -> Option<DVec2> {
        let w = self.w.dot(point.extend(1.0));
        let gradient = |row: DVec4| (row.xyz() - row.dot(point.extend(1.0)) / w * self.w.xyz()) / w;
        let [along_x, along_y] = steps_on_plane(gradient(self.x), gradient(self.y), normal)?;
        let depth = gradient(self.depth) / self.scale();
        let slopes = DVec2::new(depth.dot(along_x), depth.dot(along_y)).abs();
        slopes.is_finite().then_some(slopes)
    }

    /// How far the rounding of the f32 matrix can carry a point within the map: texels across, and depth.
    pub(super) fn rounding(&self, point: DVec3) -> (f64, f64) {
        let magnitude = |row: DVec4| {
            let terms = row.xyz() * (point - self.origin);
            terms.abs().element_sum() + row.dot(self.origin.extend(1.0)).abs()
        };
        let relative = F32_ROUNDING / self.w.dot(point.extend(1.0)).abs();
        // Rounding of w counts for x, y and depth too, none of which is more than one after the division.
        let of = |row: DVec4| relative * (magnitude(row) + magnitude(self.w));
        (self.scale() * of(self.x).max(of(self.y)), of(self.depth))
    }
}

/// The steps along a plane that change one of two functions by one and the other by none, from the functions' gradients
/// and the plane's normal; `None` where there are no such steps.
fn steps_on_plane(first: DVec3, second: DVec3, normal: DVec3) -> Option<[DVec3; 2]> {
    let volume = first.dot(second.cross(normal));
    (volume != 0.0).then(|| [second.cross(normal) / volume, normal.cross(first) / volume])
}
