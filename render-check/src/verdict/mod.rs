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
mod frustum;
mod hemisphere;
mod missing;
mod projection;
mod report;
mod source;
mod surface;
mod truth;

use anyhow::{Result, ensure};
use rayon::prelude::*;
use shadowfit::glam::DVec3;

pub use cluster::{Cluster, Fault};
pub use frustum::Frustum;
pub use hemisphere::Hemisphere;
pub use projection::Projection;
pub use report::{Aliasing, Counts, Mark, Verdict, share};
pub use surface::Surface;
pub use truth::{Illumination, Truth, TruthImage};

use crate::gpu::MapPass;
use crate::split::Split;
use crate::trace::{Faces, Tracer};

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

/// A map that was drawn and looked up.
#[derive(Clone, Copy, Debug)]
pub struct DrawnMap<'a> {
    /// How it lays out the world.
    pub projection: &'a dyn Projection,
    /// The depths that it holds, row by row from the top: 0 near and 1 far, the other way round where it `is_reversed`.
    pub depths: &'a [f32],
    /// Whether depth 1 is next to the light.
    pub is_reversed: bool,
    /// What the rasteriser added to its depths.
    pub bias: Bias,
}

impl DrawnMap<'_> {
    /// The depth of a texel, growing away from the light.
    fn depth(&self, texel: usize) -> f64 {
        let stored = f64::from(self.depths[texel]);
        if self.is_reversed { 1.0 - stored } else { stored }
    }
}

/// What a renderer hands over, but for the triangles, which the truth was traced from.
#[derive(Clone, Copy, Debug)]
pub struct Rendered<'a> {
    /// Which map answers for which points.
    pub split: &'a Split,
    /// The map of each part of the split; `None` for a part that was left out, as nothing there needs a map: all of it
    /// counts as lit.
    pub maps: &'a [Option<DrawnMap<'a>>],
    /// The share of the light that the shadow test let through in each pixel, 0 to 1, row by row from the top; from one
    /// half on it counts as lit. What it says of pixels that are not compared plays no part.
    pub lit: &'a [f32],
    /// Which sides of triangles were drawn into the maps, as the light sees them.
    pub faces: Faces,
    /// The largest step from one depth that the maps can store to the next.
    pub depth_step: f64,
    /// How many texels away from a point the filter reads: 0.5 for the nearest texel, 1 for 2 × 2, n/2 for n × n.
    pub reach: f64,
}

impl<'a> Rendered<'a> {
    /// The map that answers for a point, if its part has one.
    fn map_at(&self, point: DVec3) -> Option<&'a DrawnMap<'a>> {
        self.maps[self.split.part_of(point)].as_ref()
    }
}

/// Compares what was rendered with the truth, pixel by pixel.
///
/// `tracer` must be the one that the truth was traced with.
///
/// # Errors
///
/// When the numbers of pixels, of parts or of texels differ, or when the filter reaches nowhere.
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
        marks,
    })
}

/// All that it takes to judge a pixel.
struct Comparison<'a> {
    truth: &'a TruthImage,
    rendered: &'a Rendered<'a>,
    tracer: &'a Tracer<'a>,
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
            // Nothing was to shadow this part, and something does; there is no map that could have drawn a shadow.
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

#[cfg(test)]
pub(crate) mod fake;
#[cfg(test)]
mod tests;
