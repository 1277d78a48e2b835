//! The comparison of a rendered image with the truth.

use anyhow::{Result, ensure};
use rayon::prelude::*;

use super::cluster;
use super::comparison::Comparison;
use super::mark::Mark;
use super::rendered::Rendered;
use super::report::{Aliasing, Counts, Verdict};
use super::surface::Surface;
use super::truth::{Truth, TruthImage};
use crate::trace::Tracer;

/// Compares a rendered image with the truth, pixel by pixel.
///
/// `tracer` must be the one that traced the truth.
///
/// # Errors
///
/// When the numbers of pixels, parts or texels differ, or the filter's reach is invalid.
pub fn judge(truth: &TruthImage, rendered: &Rendered<'_>, tracer: &Tracer) -> Result<Verdict> {
    let [width, height] = truth.size();
    ensure!(
        rendered.lit.len() == truth.pixels().len(),
        "the renderer lit {} pixels of a picture of {width} x {height}: both must be of one size",
        rendered.lit.len()
    );
    ensure!(
        rendered.maps.len() == rendered.split.parts(),
        "the renderer drew {} maps of a light in {} parts: each part has a map or none",
        rendered.maps.len(),
        rendered.split.parts()
    );
    for map in rendered.maps.iter().flatten() {
        let texels_a_side = map.projection.size();
        ensure!(
            map.depths.len() == texels_a_side as usize * texels_a_side as usize,
            "the renderer drew {} texels of a map of {texels_a_side} x {texels_a_side}: draw it as it was fitted",
            map.depths.len()
        );
    }
    ensure!(
        rendered.reach >= 0.5 && rendered.reach.is_finite(),
        "a filter reads half a texel away or more, not {}",
        rendered.reach
    );
    let comparison = Comparison { truth, rendered, tracer };
    let marks: Vec<Mark> = (0..truth.pixels().len()).into_par_iter().map(|index| comparison.mark(index)).collect();
    let compared = || truth.pixels().par_iter().filter_map(Truth::compared);
    let aliasing =
        |surface: &Surface| rendered.map_at(surface.point).map(|map| map.projection.aliasing(surface.point));
    Ok(Verdict {
        counts: Counts::of(&marks, truth.shadowed()),
        worst_cluster: cluster::worst_cluster(truth, &marks),
        aliasing: Aliasing::of(compared().filter_map(|(surface, _)| aliasing(surface)).collect()),
        beyond_bias: comparison.beyond_bias(&marks),
        marks,
    })
}

impl Comparison<'_> {
    fn mark(&self, index: usize) -> Mark {
        let pixel = &self.truth.pixels()[index];
        let Some((surface, lit)) = pixel.compared() else {
            return if pixel.surface().is_some() { Mark::Unlit } else { Mark::Sky };
        };
        if (self.rendered.lit[index] >= 0.5) == lit {
            return Mark::Right;
        }
        let Some(map) = self.rendered.map_at(surface.point) else {
            // This part was left without a map because nothing should cast into it, yet something does.
            return if lit { Mark::FalseShadow } else { Mark::Missing };
        };
        if !lit && self.is_caster_missing(map, surface) {
            Mark::Missing
        } else if self.is_edge_in_texels(map.projection, surface, lit) {
            Mark::EdgeTexel
        } else if self.is_edge_in_pixels(index, lit) {
            Mark::EdgePixel
        } else if lit {
            Mark::FalseShadow
        } else {
            Mark::FalseLight
        }
    }
}
