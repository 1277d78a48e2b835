//! Buffers and textures read back to main memory.

use anyhow::{Context, Result};
use bytemuck::Pod;

use super::device::Gpu;

/// The bytes of a mappable buffer, once all submitted work is done.
pub(super) fn bytes(gpu: &Gpu, buffer: &wgpu::Buffer) -> Result<Vec<u8>> {
    buffer.map_async(wgpu::MapMode::Read, .., |_| {});
    gpu.device.poll(wgpu::PollType::wait_indefinitely()).context("the graphics card stopped answering")?;
    let bytes = buffer.get_mapped_range(..).context("the graphics card's answer cannot be read")?.to_vec();
    buffer.unmap();
    Ok(bytes)
}

/// The texels of a texture, row by row from the top.
pub(super) fn texels<T: Pod>(gpu: &Gpu, texture: &wgpu::Texture) -> Result<Vec<T>> {
    let (width, height) = (texture.width() as usize, texture.height() as usize);
    let row = width * size_of::<T>();
    // Rows in buffers start at multiples of 256 bytes.
    let padded_row = row.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT as usize);
    let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: (padded_row * height) as u64,
        usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    encoder.copy_texture_to_buffer(
        texture.as_image_copy(),
        wgpu::TexelCopyBufferInfo {
            buffer: &buffer,
            layout: wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(padded_row as u32),
                rows_per_image: None,
            },
        },
        texture.size(),
    );
    gpu.queue.submit([encoder.finish()]);
    let bytes = bytes(gpu, &buffer)?;
    Ok(bytes.chunks_exact(padded_row).flat_map(|padded| bytemuck::pod_collect_to_vec(&padded[..row])).collect())
}
