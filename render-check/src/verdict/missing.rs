//! Missing casters: casters that a map should hold but does not, because they were clipped or culled.
//!
//! A wrong pixel says little about its cause. This test inspects the map itself, at the texel of the pixel's
//! surface point, and reports a missing caster only where no sampling, bias or rounding can explain the stored
//! depth.
//!
//! Nine light rays pass through the texel and end on the receiver's tangent plane: one through its centre, where
//! the rasteriser samples; four offset by 1/16 texel, so that a caster's edge near the centre is clearly on one
//! side; and four offset by 1/256 texel, the rasteriser's grid, as a triangle thinner than 1/16 texel, seen almost
//! edge-on, may be snapped over the centre with its own slope and bias. A caster is missing where all rays hit
//! drawn faces of one surface, the largest depth that these faces can have been stored with is less than the
//! smallest depth of the receiver, and the map nevertheless holds a larger depth than that. The caster must also
//! lie in front of the receiver's own point: at grazing incidence the tangent plane runs on behind other objects
//! within a texel, and what stands in front of it there, beyond all visible surfaces, is rightly culled. One
//! surface means that the triangles touch the one hit by the centre's ray: two leaves above each other may both
//! have an edge at the centre, and a rasteriser sees between them.
//!
//! The largest stored depth of a face is its depth plus
//!
//! - the rasteriser's bias, as configured;
//! - its slope over 1/256 texel, along columns and rows: a rasteriser snaps vertices to such a grid, by half a step
//!   at most, which moves no point of a triangle farther than its vertices; the other half step is left for the
//!   interpolation of depth;
//! - the step between representable depths;
//! - the rounding error of the f32 matrix at that point;
//! - for paraboloids, the depth error of straight edges.
//!
//! The receiver's depth may be off by the depth step and the matrix's rounding too.
//!
//! For maps tested between two layers the first layer is inspected: as with first depth, it must hold the caster or
//! something nearer. Where the midpoint of the layers lets light past a caster all the same, that is a property of
//! the test, and counts as false light.

use shadowfit::glam::{DVec2, DVec3};

use super::comparison::Comparison;
use super::rendered::DrawnMap;
use super::surface::Surface;
use crate::scene::Mesh;

/// The offset of the outer rays from the texel's centre, in texels, where the f32 matrix is exact.
const OFF_CENTRE: f64 = 1.0 / 16.0;

/// The rasteriser's grid, in projection.
pub(super) const SUBTEXEL: f64 = 1.0 / 256.0;

impl Comparison<'_> {
    /// Whether a caster is missing from the map in the receiver's texel.
    ///
    /// Outside the map nothing is stored.
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
        // At grazing incidence the tangent plane leaves image and scene within a texel.
        let own = self.nearest_receiver(map, receiver.point);
        own.is_some_and(|own| farthest_caster < own)
            && farthest_caster < nearest_receiver
            && nearest_receiver < stored
    }

    /// At a point of the map, the largest depth that the caster there can have been stored with, and the smallest
    /// depth of the receiver's tangent plane; `None` where no drawn face is in front of that plane, or one that is
    /// seen edge-on from the light.
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

    /// The smallest depth that a receiver at a point can have.
    fn nearest_receiver(&self, map: &DrawnMap<'_>, point: DVec3) -> Option<f64> {
        let (_, rounding) = map.projection.rounding(point);
        Some(map.projection.place(point)?.z - self.rendered.depth_step - rounding)
    }
}

/// The result of one light ray.
struct Depths {
    /// The caster's triangle.
    triangle: usize,
    /// The largest depth that the caster can have been stored with.
    caster: f64,
    /// The smallest depth that the receiver can have.
    receiver: f64,
}

/// Whether two triangles are the same or share a corner.
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

    /// Two triangles with a common corner, and between them one seen almost edge-on from the light: 1/25 texel wide
    /// where it passes 1/500 texel beside a texel's centre, with a slope whose bias exceeds the distance to the
    /// receiver. A rasteriser may draw it over the centre.
    #[test]
    fn a_sliver_beside_a_texels_centre_may_be_what_is_stored() {
        let map = fake::fitted(&SUN, &fake::settings().with_warp(shadowfit::Warp::Uniform));
        let centre = DVec2::splat(128.5);
        // From offsets in columns and rows from the centre, and depth.
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
            let drawn = DrawnMap { projection: &frustum, depths: &depths, is_reversed: false, bias, derived: None };
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
        // Without a bias it is no deeper than its corners, so the caster is certainly missing.
        assert!(is_missing(&[left, sliver, right], 0.0));
    }
}
