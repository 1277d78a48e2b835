//! The camera's depth buffer, reduced to tiles on the GPU.

use anyhow::Result;
use shadowfit::seen::DepthTile;
use shadowfit::{View, input::DepthRange};

use super::device::Gpu;
use super::surfaces::Surfaces;
use super::{read_back, shaders};

/// Tiles across the image.
const TILES_ACROSS: u32 = 30;

/// Relative margin of a narrowed view around the depths read back. f32 depths are off by about a millionth, and by
/// more at grazing angles, as the rasteriser snaps vertices to a grid of 1/256 pixel. A thousandth hardly changes a
/// warp.
const MARGIN: f64 = 1.0 / 1024.0;

impl Surfaces {
    /// The view, narrowed to the depth range of its visible surfaces (Stamminger & Drettakis 2002, §6): the GPU
    /// reduces the depth buffer to tiles, which are read back. Unchanged where no surface is visible. `view` is the
    /// one that was drawn.
    ///
    /// # Errors
    ///
    /// When the GPU reports an error.
    pub fn narrowed(&self, gpu: &Gpu, view: &View) -> Result<View> {
        let tiles = self.depth_tiles(gpu, self.tile())?;
        let seen = || tiles.iter().filter(|tile| !tile.is_empty());
        let Some(least) = seen().map(|tile| tile.least).reduce(f32::min) else { return Ok(*view) };
        let greatest = seen().map(|tile| tile.greatest).fold(least, f32::max);
        // The camera's depth buffer is reversed.
        let depth = |stored: f32| view.depth_of(stored.into(), DepthRange::ZeroToOneReversed);
        let near = (depth(greatest) * (1.0 - MARGIN)).max(view.near());
        let far = (depth(least) * (1.0 + MARGIN)).min(view.far());
        Ok(view.narrowed(near, far)?)
    }

    /// The side of a tile in pixels, where nothing asks for another.
    #[must_use]
    pub fn tile(&self) -> u32 {
        self.size[0].div_ceil(TILES_ACROSS)
    }

    /// The depth buffer in tiles of so many pixels a side, row by row from the top.
    ///
    /// # Errors
    ///
    /// When the GPU reports an error.
    pub fn depth_tiles(&self, gpu: &Gpu, tile: u32) -> Result<Vec<DepthTile>> {
        gpu.guarded("the depths in view", || self.reduced(gpu, tile))
    }

    fn reduced(&self, gpu: &Gpu, tile: u32) -> Result<Vec<DepthTile>> {
        let [across, down] = self.size.map(|pixels| pixels.div_ceil(tile));
        let pipeline = gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: None,
            layout: None,
            module: &gpu.shader(&shaders::depth_tiles()),
            entry_point: Some("reduce"),
            compilation_options: wgpu::PipelineCompilationOptions {
                constants: &[("tile", tile.into())],
                ..wgpu::PipelineCompilationOptions::default()
            },
            cache: None,
        });
        let buffer = |usage| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: None,
                size: u64::from(across) * u64::from(down) * DepthTile::SIZE as u64,
                usage,
                mapped_at_creation: false,
            })
        };
        let tiles = buffer(wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC);
        let readable = buffer(wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST);
        let entry = |binding, resource| wgpu::BindGroupEntry { binding, resource };
        let bindings = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &pipeline.get_bind_group_layout(0),
            entries: &[
                entry(0, wgpu::BindingResource::TextureView(&self.depths)),
                entry(1, tiles.as_entire_binding()),
            ],
        });
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            pass.set_pipeline(&pipeline);
            pass.set_bind_group(0, &bindings, &[]);
            pass.dispatch_workgroups(across, down, 1);
        }
        encoder.copy_buffer_to_buffer(&tiles, 0, &readable, 0, tiles.size());
        gpu.queue.submit([encoder.finish()]);
        let bytes = read_back::bytes(gpu, &readable)?;
        Ok(bytes.as_chunks().0.iter().map(DepthTile::from_bytes).collect())
    }
}
