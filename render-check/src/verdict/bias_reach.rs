//! Whether false light ends where the bias does.
//!
//! A bias lights receivers close behind their casters, up to [`shadowfit::ShadowMap::bias_distance`]. Each pixel with false light
//! is compared with that in all texels that its filter reads. A texel stores the depth of the caster at its centre; the receiver
//! passes the test there if it is nearer to the light than the point that lies the bias distance behind that caster. A pixel
//! that is beyond this point in every texel is not lit by the bias.
//!
//! A rasteriser and f32 may move another point of the caster to the texel's centre: casters at these places count too. In a
//! map that bends lines, so does the depth by which an edge is off. There is no other tolerance: the bias covers what f32 does to
//! depths.

use rayon::prelude::*;
use shadowfit::depth::DepthBias;
use shadowfit::glam::DVec2;

use super::comparison::Comparison;
use super::edge::centres_within;
use super::mark::Mark;
use super::missing::SUBTEXEL;
use super::projection::Projection;
use super::surface::Surface;

impl Comparison<'_> {
    /// The number of pixels with false light beyond the bias.
    pub(super) fn beyond_bias(&self, marks: &[Mark]) -> usize {
        let pixels = self.truth.pixels().par_iter().zip(marks);
        let false_light = pixels.filter(|&(_, mark)| *mark == Mark::FalseLight);
        false_light.filter_map(|(pixel, _)| pixel.surface()).filter(|surface| self.is_beyond_bias(surface)).count()
    }

    fn is_beyond_bias(&self, receiver: &Surface) -> bool {
        let Some(map) = self.rendered.map_at(receiver.point) else {
            return false;
        };
        let (Some(bias), Some(place)) = (&map.derived, map.projection.place(receiver.point)) else {
            return false;
        };
        let (across, _) = map.projection.rounding(receiver.point);
        let off = SUBTEXEL + across;
        let around = [DVec2::ZERO, DVec2::X, DVec2::NEG_X, DVec2::Y, DVec2::NEG_Y].map(|way| off * way);
        let texels = centres_within(place.truncate(), self.rendered.reach + across);
        !texels.flat_map(|centre| around.map(|step| centre + step)).any(|sampled| {
            let end = self.end_of_light(map.projection, receiver, bias, sampled);
            end.is_none_or(|end| place.z <= end)
        })
    }

    /// The largest depth at which a receiver passes the test against the caster at a place; `None` where there is no caster
    /// before the receiver's tangent plane.
    fn end_of_light(
        &self,
        projection: &dyn Projection,
        receiver: &Surface,
        bias: &DepthBias,
        place: DVec2,
    ) -> Option<f64> {
        let point = projection.on_plane(receiver.point, receiver.normal, place)?;
        let ray = self.truth.source().ray_to(self.tracer, point)?;
        let caster = self.tracer.first_hit_of(&ray, self.rendered.faces)?;
        let distance = projection.bias_distance(caster.point, caster.face_normal, bias);
        let end = projection.place(caster.point + distance * ray.direction).map(|place| place.z);
        let slopes = projection.slopes(caster.point, caster.face_normal);
        // An infinite bias distance: everything behind the caster is lit.
        Some(match (end, slopes) {
            (Some(end), Some(slopes)) if end.is_finite() => end + projection.bend(end, slopes),
            _ => f64::INFINITY,
        })
    }
}

#[cfg(test)]
mod tests {
    use shadowfit::depth::DepthBias;
    use shadowfit::{DepthFormat, ShadowMap, Warp};

    use crate::maps::Split;
    use crate::trace::Tracer;
    use crate::verdict::fake::{self, Fake, LAMP, SPOT, SUN};
    use crate::verdict::{Bias, DrawnMap, Frustum, Verdict, judge};

    /// The verdict on a lookup with this bias on the receiver's side, stated as the bias derived from the map.
    fn verdict(map: &ShadowMap, light: &crate::scene::LightSpec, bias: &DepthBias, look_up_bias: f64) -> Verdict {
        let mesh = fake::mesh();
        let tracer = Tracer::new(&mesh).expect("it has triangles");
        let truth = fake::truth(light, &tracer);
        let drawn_bias = Bias { constant: 6e-8, slope: bias.slope_scale.into() };
        let fake = Fake { bias: drawn_bias, look_up_bias, look_up_slope: 0.0, ..Fake::default() };
        let depths = fake.draw(map, &tracer);
        let lit = fake.light(map, &depths, &truth, &mesh);
        let frustum = Frustum::new(map);
        let drawn = DrawnMap {
            projection: &frustum,
            depths: &depths,
            is_reversed: false,
            bias: drawn_bias,
            derived: Some(*bias),
        };
        let (split, maps) = (Split::whole(), [Some(drawn)]);
        judge(&truth, &fake.hand_over(&split, &maps, &lit), &tracer).expect("sound inputs")
    }

    #[test]
    fn false_light_ends_at_the_bias_distance_unless_the_bias_is_larger() {
        for light in [SUN, LAMP, SPOT] {
            let map = fake::fitted(&light, &fake::settings().with_warp(Warp::Uniform));
            let bias = map.bias(DepthFormat::Float32, 0.5).expect("a valid reach");
            assert_eq!(verdict(&map, &light, &bias, bias.receiver).beyond_bias, 0, "{light}");
            // The whole depth range: everything is lit.
            let Verdict { counts, beyond_bias, .. } = verdict(&map, &light, &bias, 1.0);
            assert!(beyond_bias > 500 && beyond_bias == counts.false_light, "{light}: {beyond_bias}, {counts:?}");
        }
    }
}
