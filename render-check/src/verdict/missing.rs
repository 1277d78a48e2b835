//! Missing casters: what a map ought to hold and does not, because it was clipped or culled.
//!
//! Whether a pixel of the picture is wrong says little about why. This looks into the map itself, at the texel that the
//! pixel's point falls in, and flags it only where no sampling, bias or rounding can explain what is there.
//!
//! Nine rays of light go through the texel: through its centre, where the rasteriser samples, through four places a
//! sixteenth of a texel off, so that a caster's edge close to the centre leaves no doubt of which side it is on, and
//! through four a 256th off, the rasteriser's grid: a triangle thinner than a sixteenth, which the light sees nearly from its
//! edge, may come to lie over the centre there, with a slope and a bias that are its own. Each
//! ends on the receiver's tangent plane. A caster is missing where all of them meet drawn faces of one surface, where the
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

use super::comparison::Comparison;
use super::rendered::DrawnMap;
use super::surface::Surface;
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
        let centre = place.floor() + 0.5;
        let around = [SUBTEXEL + across, OFF_CENTRE + across]
            .into_iter()
            .flat_map(|off| [DVec2::X, DVec2::NEG_X, DVec2::Y, DVec2::NEG_Y].map(|way| off * way));
        let (mut farthest_caster, mut nearest_receiver) = (f64::NEG_INFINITY, f64::INFINITY);
        let mut surface = None;
        for step in [DVec2::ZERO].into_iter().chain(around) {
            let Some(depths) = self.caster_and_receiver(map, receiver, centre + step) else {
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
    use crate::maps::Split;
    use crate::scene::{MeshBuilder, Part};
    use crate::trace::Tracer;
    use crate::verdict::fake::{self, Fake, SUN};
    use crate::verdict::{Bias, Frustum, Projection as _, Truth};

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

    /// Two triangles with a common corner, and between them one that the light sees nearly from its edge: a 25th of a texel
    /// wide where it passes a 500th of a texel beside a texel's centre, and with a slope whose bias is more than there is
    /// room for. A rasteriser may take it for what the centre shows.
    #[test]
    fn a_sliver_beside_a_texels_centre_may_be_what_is_stored() {
        let map = fake::fitted(&SUN, &fake::settings().with_warp(shadowfit::Warp::Uniform));
        let centre = DVec2::splat(128.5);
        // From columns and rows beside the centre, and depth.
        let at = |column: f64, row: f64, depth: f64| {
            let clip = (centre + DVec2::new(column, row)) / 128.0 - 1.0;
            map.clip_from_world().inverse().project_point3(DVec3::new(clip.x, -clip.y, depth))
        };
        let (edge, above, below) = (0.002, 0.5, 0.6);
        let [first, second] = [at(edge, -10.0, above), at(edge, 10.0, above)];
        let deeper = at(edge + 0.08, 10.0, above + 0.02);
        let corners = [first, second, deeper, at(-10.0, 0.0, above), at(10.0, 0.0, above + 0.02)];
        let mesh_of = |triangles: &[[u32; 3]]| {
            let part = Part { positions: &corners, normals: &[], triangles, colour: [1.0; 3] };
            let mut builder = MeshBuilder::default();
            builder.add(&part, DMat4::IDENTITY);
            builder.finish().0
        };
        let is_missing = |triangles: &[[u32; 3]], slope: f64| {
            let mesh = mesh_of(triangles);
            let tracer = Tracer::new(&mesh).expect("it has triangles");
            let truth = fake::truth(&SUN, &tracer);
            assert!(truth.pixels().iter().any(|pixel| !matches!(pixel, Truth::Sky)));
            let frustum = Frustum::new(&map);
            // Nothing is stored.
            let depths = vec![1.0; 256 * 256];
            let bias = Bias { constant: 0.0, slope };
            let drawn = DrawnMap { projection: &frustum, depths: &depths, is_reversed: false, bias };
            let (split, maps) = (Split::whole(), [Some(drawn)]);
            let rendered = Fake::default().hand_over(&split, &maps, &[]);
            let comparison = Comparison { truth: &truth, rendered: &rendered, tracer: &tracer };
            let point = at(0.1, 0.1, below);
            assert!(frustum.place(point).is_some_and(|place| place.truncate().floor() == centre.floor()));
            let normal = DVec3::new(0.5, 1.0, 0.3).normalize();
            comparison.is_caster_missing(&drawn, &Surface { point, normal, triangle: 0 })
        };
        let (left, sliver, right) = ([0, 1, 3], [0, 1, 2], [0, 2, 4]);
        assert!(!is_missing(&[left, sliver, right], 1.0));
        // Without a bias it is no deeper than its corners, and what should be stored is missing for certain.
        assert!(is_missing(&[left, sliver, right], 0.0));
    }
}
