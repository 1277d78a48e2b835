//! The renderer's output that is judged.

use shadowfit::depth::DepthBias;
use shadowfit::glam::DVec3;

use super::frustum::Frustum;
use super::hemisphere::Hemisphere;
use super::projection::Projection;
use crate::gpu::MapPass;
use crate::maps::{Layout, Split};
use crate::trace::Faces;

/// An upper bound on the rasteriser's depth bias, away from the light.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bias {
    /// The constant part, relative to the map's depth range.
    pub constant: f64,
    /// The slope scale: times the larger of the depth slopes per column and per row.
    pub slope: f64,
}

impl Bias {
    /// The upper bound for a pass.
    #[must_use]
    pub fn most(pass: &MapPass) -> Self {
        // Triangles that reach out of the map can have depths of 1 and more.
        let unit = *pass.format.bias_unit(1.0).end();
        Self { constant: f64::from(pass.bias.constant) * unit, slope: pass.bias.slope.into() }
    }
}

/// A map as it was drawn.
#[derive(Clone, Copy, Debug)]
pub struct DrawnMap<'a> {
    /// Its projection.
    pub projection: &'a dyn Projection,
    /// The stored depths, row by row from the top: 0 near and 1 far, the other way round where `is_reversed`.
    pub depths: &'a [f32],
    /// Whether depth is reversed, 1 nearest to the light.
    pub is_reversed: bool,
    /// The rasteriser's depth bias.
    pub bias: Bias,
    /// The bias derived from the map, where it was drawn and tested with that.
    pub derived: Option<DepthBias>,
}

impl DrawnMap<'_> {
    /// The depth of a texel, increasing away from the light.
    pub(super) fn depth(&self, texel: usize) -> f64 {
        let stored = f64::from(self.depths[texel]);
        if self.is_reversed { 1.0 - stored } else { stored }
    }
}

/// The renderer's output, except for the visible triangles, which the truth was traced from.
#[derive(Clone, Copy, Debug)]
pub struct Rendered<'a> {
    /// Which map covers which points.
    pub split: &'a Split,
    /// The map of each part of the split; `None` for a part that needs none and counts as lit.
    pub maps: &'a [Option<DrawnMap<'a>>],
    /// The lit fraction of each pixel by the shadow test, 0 to 1, row by row from the top; 1/2 and more count as
    /// lit. Pixels that are not compared are ignored.
    pub lit: &'a [f32],
    /// Which faces were drawn into the maps, as seen from the light.
    pub faces: Faces,
    /// The largest step between representable depths.
    pub depth_step: f64,
    /// The filter's reach, in texels: 0.5 for the nearest texel, 1 for 2 × 2, n/2 for n × n.
    pub reach: f64,
}

impl<'a> Rendered<'a> {
    /// The map that covers a point, if its part has one.
    pub(super) fn map_at(&self, point: DVec3) -> Option<&'a DrawnMap<'a>> {
        self.maps[self.split.part_of(point)].as_ref()
    }
}

/// The projection of a fitted map.
#[must_use]
pub fn projection(map: &Layout) -> Box<dyn Projection> {
    match map {
        Layout::Frustum(map) => Box::new(Frustum::new(map)),
        Layout::Paraboloid(map) => Box::new(Hemisphere::new(map)),
    }
}
