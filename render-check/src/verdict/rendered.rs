//! What a renderer hands over to be judged.

use shadowfit::glam::DVec3;

use super::frustum::Frustum;
use super::hemisphere::Hemisphere;
use super::projection::Projection;
use crate::gpu::MapPass;
use crate::maps::{Layout, Split};
use crate::trace::Faces;

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
    pub(super) fn depth(&self, texel: usize) -> f64 {
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
    pub(super) fn map_at(&self, point: DVec3) -> Option<&'a DrawnMap<'a>> {
        self.maps[self.split.part_of(point)].as_ref()
    }
}

/// How a map lays out the world, for the verdict.
#[must_use]
pub fn projection(map: &Layout) -> Box<dyn Projection> {
    match map {
        Layout::Frustum(map) => Box::new(Frustum::new(map)),
        Layout::Paraboloid(map) => Box::new(Hemisphere::new(map)),
    }
}
