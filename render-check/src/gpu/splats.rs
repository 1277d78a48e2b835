//! Points of clouds drawn into a shadow map as quads.

use std::ops::Range;
use std::time::Duration;

use anyhow::Result;

use super::device::Gpu;
use super::geometry::Geometry;
use super::pass::{Pass, PipelineKind};
use super::shaders;

/// How a point of a cloud is drawn into a map. The camera always sees hexagons.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, serde::Serialize, clap::ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum Points {
    /// Its disc as a hexagon of four triangles
    #[default]
    Discs,
    /// Its disc as a splat: a bounding quad, with fragments outside the disc discarded
    Splats,
    /// A single texel: leaves holes where points are farther apart than texels
    Texels,
}

impl Points {
    /// Relative to the radius: no useful disc is a thousand texels large.
    fn scale(self) -> f64 {
        match self {
            Self::Discs | Self::Splats => 1.0,
            Self::Texels => 1.0 / 1024.0,
        }
    }
}

/// Draws discs into a map, after the triangles.
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
