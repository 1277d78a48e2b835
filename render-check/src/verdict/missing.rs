//! Missing casters: what a map ought to hold and does not, because it was clipped or culled.
//!
//! Whether a pixel of the picture is wrong says little about why. This looks into the map itself, at the texel that the
//! pixel's point falls in, and flags it only where no sampling, bias or rounding can explain what is there.
//!
//! Five rays of light go through the texel: through its centre, where the rasteriser samples, and through four places a
//! sixteenth of a texel off, so that a caster's edge close to the centre leaves no doubt of which side it is on. Each
//! ends on the receiver's tangent plane. A caster is missing where all five meet drawn faces of one surface, where the
//! farthest depth that these faces can have been stored with lies before the nearest depth of the receiver, and where the
//! map yet holds a depth beyond that. It must lie before the receiver's own point, too: where the light grazes the receiver
//! its tangent plane runs on behind other things within a texel, and what stands before it there, and beyond all that is
//! seen, is rightly culled. One surface: the triangles touch the one that the centre's ray meets. Among leaves
//! two may lie above each other with the edges of both at the centre, and a rasteriser sees between them.
//!
//! The farthest depth of a face is its depth plus
//!
//! - the rasteriser's bias, as it is stated;
//! - its slope over a 256th of a texel, in columns and rows: a rasteriser rounds corners of triangles to such a grid,
//!   half a step at most, which carries each point of a triangle no farther than its corners; the other half is left for
//!   the interpolation of depth;
//! - the step between depths that the map can store;
//! - what the f32 matrix can be off by at that point;
//! - in a map that bends lines, what a straight edge makes of depth.
//!
//! The receiver's depth may be off by the step and by what the matrix is off as well.
//!
//! Of a map that is tested between two layers it is the first layer that is looked into. A caster belongs in the map where
//! that holds it or something nearer, as with first depth; that the middle of the layers may let light past it all the same
//! is a matter of the test, and false light.

use shadowfit::glam::{DVec2, DVec3};

use super::surface::Surface;
use super::{Comparison, DrawnMap};
use crate::scene::Mesh;

/// How far off a texel's centre the other rays go, in texels, where the f32 matrix is exact.
const OFF_CENTRE: f64 = 1.0 / 16.0;

/// The rasteriser's grid, in projection.
const SUBTEXEL: f64 = 1.0 / 256.0;

impl Comparison<'_> {
    /// Whether a map misses a caster in the texel that the point of a receiver falls in.
    ///
    /// A point outside of the map counts as one before which nothing is stored.
    pub(super) fn is_caster_missing(&self, map: &DrawnMap<'_>, receiver: &Surface) -> bool {
        let Some(place) = map.projection.place(receiver.point).map(|place| place.truncate()) else {
            return false;
        };
        let stored = map.projection.index(place).map_or(f64::INFINITY, |texel| map.depth(texel));
        let (across, _) = map.projection.rounding(receiver.point);
        let (centre, off) = (place.floor() + 0.5, OFF_CENTRE + across);
        let (mut farthest_caster, mut nearest_receiver) = (f64::NEG_INFINITY, f64::INFINITY);
        let mut surface = None;
        for step in [DVec2::ZERO, DVec2::X, DVec2::NEG_X, DVec2::Y, DVec2::NEG_Y] {
            let Some(depths) = self.caster_and_receiver(map, receiver, centre + off * step) else {
                return false;
            };
            if !touch(self.tracer.mesh(), *surface.get_or_insert(depths.triangle), depths.triangle) {
                return false;
            }
            farthest_caster = farthest_caster.max(depths.caster);
            nearest_receiver = nearest_receiver.min(depths.receiver);
        }
        // Where the light grazes the receiver, its tangent plane leaves the picture and the scene within a texel.
        let own = self.nearest_receiver(map, receiver.point);
        own.is_some_and(|own| farthest_caster < own)
            && farthest_caster < nearest_receiver
            && nearest_receiver < stored
    }

    /// At a place of the map, the farthest depth with which the caster there can have been stored, and the nearest that
    /// the receiver's tangent plane can have; `None` where no drawn face stands before that plane, or one that the light
    /// sees from its edge.
    fn caster_and_receiver(&self, map: &DrawnMap<'_>, receiver: &Surface, place: DVec2) -> Option<Depths> {
        let (projection, depth_step) = (map.projection, self.rendered.depth_step);
        let point = projection.on_plane(receiver.point, receiver.normal, place)?;
        let ray = self.truth.source().ray_to(self.tracer, point)?;
        let caster = self.tracer.first_hit_of(&ray, self.rendered.faces)?;
        let slopes = projection.slopes(caster.point, caster.face_normal)?;
        let depth = projection.place(caster.point)?.z;
        let bias = map.bias.constant + projection.slope_bias(depth, slopes, map.bias.slope);
        let (_, caster_rounding) = projection.rounding(caster.point);
        let tolerance =
            SUBTEXEL * slopes.element_sum() + depth_step + caster_rounding + projection.bend(depth, slopes);
        Some(Depths {
            triangle: caster.triangle,
            caster: depth + bias + tolerance,
            receiver: self.nearest_receiver(map, point)?,
        })
    }

    /// The nearest depth that a receiver at a point can have.
    fn nearest_receiver(&self, map: &DrawnMap<'_>, point: DVec3) -> Option<f64> {
        let (_, rounding) = map.projection.rounding(point);
        Some(map.projection.place(point)?.z - self.rendered.depth_step - rounding)
    }
}

/// What one ray of light says.
struct Depths {
    /// The caster's triangle.
    triangle: usize,
    /// The farthest depth that the caster can have been stored with.
    caster: f64,
    /// The nearest depth that the receiver can have.
    receiver: f64,
}

/// Whether two triangles are the same or have a corner in common.
fn touch(mesh: &Mesh, one: usize, other: usize) -> bool {
    let (a, b) = (mesh.corners(one), mesh.corners(other));
    a.iter().any(|corner| b.contains(corner))
}

#[cfg(test)]
mod tests {
    use shadowfit::glam::DMat4;

    use super::*;
    use crate::scene::{MeshBuilder, Part};

    #[test]
    fn triangles_touch_at_corners_whoever_owns_them() {
        let corners = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::ONE];
        let part = Part { positions: &corners, normals: &[], triangles: &[[0, 1, 2], [1, 3, 2]], colour: [1.0; 3] };
        let mut builder = MeshBuilder::default();
        builder.add(&part, DMat4::IDENTITY);
        builder.add(&part, DMat4::from_translation(DVec3::X));
        builder.add(&part, DMat4::from_translation(DVec3::Z));
        let (mesh, _) = builder.finish();
        assert!(touch(&mesh, 0, 0) && touch(&mesh, 0, 1) && touch(&mesh, 0, 2));
        assert!(!touch(&mesh, 0, 4) && !touch(&mesh, 2, 4));
    }
}
