//! What a renderer made of a map, against ray-traced truth.
//!
//! A renderer draws a scene from a view with shadows from a fitted map and hands over what it has: which triangle each
//! pixel shows, how much light it let through there, and the map as it was drawn. [`TruthImage`] finds, in f64, what the
//! light really does at each of these points; [`judge`] compares the two and says of every wrong pixel why it is wrong:
//!
//! 1. **missing caster**: the map does not hold something that it should. A fitted map never has any;
//! 2. **edge**: the edge of a true shadow is closer than a map of this resolution can tell, or next to the pixel;
//! 3. **false shadow** and **false light**: the rest.

mod cluster;
mod edge;
mod missing;
mod report;
mod source;
mod surface;
mod texels;
mod truth;

use anyhow::{Result, ensure};
use rayon::prelude::*;
use shadowfit::Map;

pub use cluster::{Cluster, Fault};
pub use report::{Aliasing, Counts, Mark, Verdict, share};
pub use surface::Surface;
pub use truth::{Illumination, Truth, TruthImage};

use crate::gpu::MapPass;
use crate::trace::{Faces, Tracer};
use texels::Texels;

/// What a rasteriser added at most to the depths of a map, away from the light.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bias {
    /// This much depth, where the map's depth range is 1.
    pub constant: f64,
    /// This many times the larger of the depth's changes from one column of texels to the next and from one row to the
    /// next.
    pub slope: f64,
}

impl Bias {
    /// The most that a card can have added in a pass.
    #[must_use]
    pub fn most(pass: &MapPass) -> Self {
        // A triangle that reaches out of the map can have depths from 1 on.
        let unit = *pass.format.bias_unit(1.0).end();
        Self { constant: f64::from(pass.bias.constant) * unit, slope: pass.bias.slope.into() }
    }
}

/// What a renderer hands over, but for the triangles, which the truth was traced from.
#[derive(Clone, Copy, Debug)]
pub struct Rendered<'a> {
    /// The map that was drawn and looked up.
    pub map: &'a Map,
    /// The share of the light that the shadow test let through in each pixel, 0 to 1, row by row from the top; from one
    /// half on it counts as lit. What it says of pixels that are not compared plays no part.
    pub lit: &'a [f32],
    /// The depths that the map holds, row by row from the top (clip y = +1), whatever the map's clip space: 0 near and 1
    /// far, the other way round where that space is reversed.
    pub depths: &'a [f32],
    /// Which sides of triangles were drawn into the map, as the light sees them.
    pub faces: Faces,
    /// What the rasteriser added to their depths.
    pub bias: Bias,
    /// The largest step from one depth that the map can store to the next.
    pub depth_step: f64,
    /// How many texels away from a point the filter reads: 0.5 for the nearest texel, 1 for 2 × 2, n/2 for n × n.
    pub reach: f64,
}

impl Rendered<'_> {
    /// The depth of a texel, growing away from the light.
    fn depth(&self, texel: usize) -> f64 {
        let stored = f64::from(self.depths[texel]);
        if self.map.settings().clip().depth.is_reversed() { 1.0 - stored } else { stored }
    }
}

/// Compares what was rendered with the truth, pixel by pixel.
///
/// `tracer` must be the one that the truth was traced with.
///
/// # Errors
///
/// When the numbers of pixels or of texels differ, or when the filter reaches nowhere.
pub fn judge(truth: &TruthImage, rendered: &Rendered<'_>, tracer: &Tracer) -> Result<Verdict> {
    let ([width, height], texels_a_side) = (truth.size(), rendered.map.settings().map_size());
    ensure!(
        rendered.lit.len() == truth.pixels().len(),
        "the renderer lit {} pixels of a picture of {width} x {height}: both must be of one size",
        rendered.lit.len()
    );
    ensure!(
        rendered.depths.len() == texels_a_side as usize * texels_a_side as usize,
        "the renderer drew {} texels of a map of {texels_a_side} x {texels_a_side}: draw it as it was fitted",
        rendered.depths.len()
    );
    ensure!(
        rendered.reach >= 0.5 && rendered.reach.is_finite(),
        "a filter reads half a texel away or more, not {}",
        rendered.reach
    );
    let comparison = Comparison { truth, rendered, tracer, texels: Texels::new(rendered.map, truth.view().eye()) };
    let marks: Vec<Mark> = (0..truth.pixels().len()).into_par_iter().map(|index| comparison.mark(index)).collect();
    let compared = || truth.pixels().par_iter().filter_map(Truth::compared);
    let aliasing = |surface: &Surface| rendered.map.aliasing(surface.point).unwrap_or(f64::INFINITY);
    Ok(Verdict {
        counts: Counts::of(&marks, truth.shadowed()),
        worst_cluster: cluster::worst_cluster(truth, &marks),
        aliasing: Aliasing::of(compared().map(|(surface, _)| aliasing(surface)).collect()),
        marks,
    })
}

/// All that it takes to judge a pixel.
struct Comparison<'a> {
    truth: &'a TruthImage,
    rendered: &'a Rendered<'a>,
    tracer: &'a Tracer<'a>,
    texels: Texels,
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
        if !lit && self.is_caster_missing(surface) {
            Mark::Missing
        } else if self.is_edge_in_texels(surface, lit) {
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

#[cfg(test)]
pub(crate) mod fake;
#[cfg(test)]
mod tests;
