//! The points of clouds in a shadow map, as quads.

use std::ops::Range;
use std::time::Duration;

use anyhow::Result;

use super::device::Gpu;
use super::geometry::Geometry;
use super::pass::{Pass, PipelineKind};
use super::shaders;

/// What is drawn into a map for a point of a cloud. The camera sees the hexagons of discs in each case.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, serde::Serialize, clap::ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum Points {
    /// The hexagon of its disc, four triangles like any others
    #[default]
    Discs,
    /// Its disc, cut from the rectangle that it just fits into, by the crate's shader function
    Splats,
    /// A single texel: full of holes where points are farther apart than texels
    Texels,
}

impl Points {
    /// Of a disc's radius: no disc worth drawing is a thousand texels large.
    fn scale(self) -> f64 {
        match self {
            Self::Discs | Self::Splats => 1.0,
            Self::Texels => 1.0 / 1024.0,
        }
    }
}

/// A map that discs are to be drawn into, after the triangles.
pub(super) struct SplatPass<'a> {
    pub(super) points: Points,
    pub(super) size: u32,
    pub(super) light: &'a wgpu::Buffer,
    pub(super) view: &'a wgpu::TextureView,
    pub(super) depth: wgpu::DepthStencilState,
}

impl SplatPass<'_> {
    /// Draws ranges of the geometry's discs.
    pub(super) fn run(&self, gpu: &Gpu, geometry: &Geometry, discs: &[Range<u32>]) -> Result<Option<Duration>> {
        let pipeline = PipelineKind {
            shader: &shaders::splats(),
            constants: &[("map_size", self.size.into()), ("scale", self.points.scale())],
            takes_geometry: false,
            has_fragments: true,
            primitive: wgpu::PrimitiveState::default(),
            depth: Some(self.depth.clone()),
            targets: &[],
        }
        .build(gpu);
        let draws: Vec<Range<u32>> = discs.iter().map(|discs| 6 * discs.start..6 * discs.end).collect();
        let resources = [self.light.as_entire_binding(), geometry.discs.as_entire_binding()];
        let pass = Pass {
            pipeline: &pipeline,
            bindings: &gpu.bindings(&pipeline, &resources),
            colours: &[],
            depth: Some((self.view, wgpu::LoadOp::Load)),
            geometry: None,
            draws: &draws,
        };
        pass.run(gpu)
    }
}
