//! Depth buffers read back to main memory.

use anyhow::Result;

use super::device::Gpu;
use super::pass::{FULL_SCREEN, Pass, PipelineKind};
use super::{read_back, shaders};

/// The depths of a depth buffer, row by row from the top.
pub(super) fn depths(gpu: &Gpu, view: &wgpu::TextureView, size: u32) -> Result<Vec<f32>> {
    let format = wgpu::TextureFormat::R32Float;
    let (copy, copy_view) = gpu.target([size, size], format);
    let pipeline = PipelineKind {
        shader: shaders::COPY_DEPTH,
        constants: &[],
        takes_geometry: false,
        has_fragments: true,
        primitive: wgpu::PrimitiveState::default(),
        depth: None,
        targets: &[format],
    }
    .build(gpu);
    let pass = Pass {
        pipeline: &pipeline,
        bindings: &gpu.bindings(&pipeline, &[wgpu::BindingResource::TextureView(view)]),
        colours: &[&copy_view],
        depth: None,
        geometry: None,
        draws: &[FULL_SCREEN],
    };
    pass.run(gpu)?;
    read_back::texels(gpu, &copy)
}
