//! The depth range of the visible surfaces, from the camera's depth buffer.

use anyhow::Result;
use shadowfit::{View, input::DepthRange};
use wgpu::util::{BufferInitDescriptor, DeviceExt as _};

use super::device::Gpu;
use super::surfaces::Surfaces;
use super::{read_back, shaders};

/// Pixels across and down that one workgroup of the shader reads.
const TILE: u32 = 16;

/// Relative margin of a narrowed view around the depths read back. f32 depths are off by about a millionth, and by
/// more at grazing angles, as the rasteriser snaps vertices to a grid of 1/256 pixel. A thousandth hardly changes a
/// warp.
const MARGIN: f64 = 1.0 / 1024.0;

impl Surfaces {
    /// The view, narrowed to the depth range of its visible surfaces (Stamminger & Drettakis 2002, §6): the GPU
    /// reduces the depth buffer to two numbers, which are read back. Unchanged where no surface is visible. `view`
    /// is the one that was drawn.
    ///
    /// # Errors
    ///
    /// When the GPU reports an error.
    pub fn narrowed(&self, gpu: &Gpu, view: &View) -> Result<View> {
        let ends = gpu.guarded("the depths in view", || self.depth_ends(gpu))?;
        let Some([least, greatest]) = ends else { return Ok(*view) };
        // The camera's depth buffer is reversed.
        let depth = |stored: f32| view.depth_of(stored.into(), DepthRange::ZeroToOneReversed);
        let near = (depth(greatest) * (1.0 - MARGIN)).max(view.near());
        let far = (depth(least) * (1.0 + MARGIN)).min(view.far());
        Ok(view.narrowed(near, far)?)
    }

    /// The least and the greatest value in the depth buffer; `None` where there is no surface.
    fn depth_ends(&self, gpu: &Gpu) -> Result<Option<[f32; 2]>> {
        let module = &gpu.shader(shaders::DEPTH_ENDS);
        let pipeline = gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: None,
            layout: None,
            module,
            entry_point: Some("reduce"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        let none = [u32::MAX, 0];
        let ends = gpu.device.create_buffer_init(&BufferInitDescriptor {
            label: None,
            contents: bytemuck::cast_slice(&none),
            usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
        });
        let readable = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: ends.size(),
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let entry = |binding, resource| wgpu::BindGroupEntry { binding, resource };
        let bindings = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &pipeline.get_bind_group_layout(0),
            entries: &[
                entry(0, wgpu::BindingResource::TextureView(&self.depths)),
                entry(1, ends.as_entire_binding()),
            ],
        });
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            pass.set_pipeline(&pipeline);
            pass.set_bind_group(0, &bindings, &[]);
            let [across, down] = self.size.map(|pixels| pixels.div_ceil(TILE));
            pass.dispatch_workgroups(across, down, 1);
        }
        encoder.copy_buffer_to_buffer(&ends, 0, &readable, 0, ends.size());
        gpu.queue.submit([encoder.finish()]);
        let bits: Vec<u32> = bytemuck::pod_collect_to_vec(&read_back::bytes(gpu, &readable)?);
        Ok((bits != none).then(|| [f32::from_bits(bits[0]), f32::from_bits(bits[1])]))
    }
}
