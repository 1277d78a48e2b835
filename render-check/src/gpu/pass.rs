//! Render pipelines and passes, with their GPU times.

use std::ops::Range;
use std::sync::PoisonError;
use std::time::Duration;

use anyhow::Result;

use super::device::Gpu;
use super::geometry::Geometry;
use super::pipeline_key::PipelineKey;
use super::read_back;

/// A pipeline's parameters, as far as they differ here.
pub(super) struct PipelineKind<'a> {
    pub(super) shader: &'a str,
    pub(super) constants: &'a [(&'a str, f64)],
    pub(super) takes_geometry: bool,
    /// Whether there is a fragment shader; without one a pass writes depth alone.
    pub(super) has_fragments: bool,
    pub(super) primitive: wgpu::PrimitiveState,
    pub(super) depth: Option<wgpu::DepthStencilState>,
    pub(super) targets: &'a [wgpu::TextureFormat],
}

impl PipelineKind<'_> {
    /// The pipeline, cached after its first use. A software driver compiles new pipelines while it draws, which
    /// would count as the pass's time in every frame.
    pub(super) fn build(&self, gpu: &Gpu) -> wgpu::RenderPipeline {
        let mut pipelines = gpu.pipelines.lock().unwrap_or_else(PoisonError::into_inner);
        pipelines.entry(self.key()).or_insert_with(|| self.build_anew(gpu)).clone()
    }

    fn key(&self) -> PipelineKey {
        PipelineKey {
            shader: self.shader.to_owned(),
            constants: self.constants.iter().map(|(name, value)| ((*name).to_owned(), value.to_bits())).collect(),
            takes_geometry: self.takes_geometry,
            has_fragments: self.has_fragments,
            primitive: self.primitive,
            depth: self.depth.clone(),
            targets: self.targets.to_vec(),
        }
    }

    fn build_anew(&self, gpu: &Gpu) -> wgpu::RenderPipeline {
        let module = &gpu.shader(self.shader);
        let compilation_options =
            wgpu::PipelineCompilationOptions { constants: self.constants, ..Default::default() };
        let geometry = [Some(wgpu::VertexBufferLayout {
            array_stride: 12,
            step_mode: wgpu::VertexStepMode::Vertex,
            attributes: &Geometry::ATTRIBUTES,
        })];
        let targets: Vec<_> = self.targets.iter().map(|&format| Some(format.into())).collect();
        gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: None,
            layout: None,
            vertex: wgpu::VertexState {
                module,
                entry_point: Some("vertex"),
                compilation_options: compilation_options.clone(),
                buffers: if self.takes_geometry { &geometry } else { &[] },
            },
            primitive: self.primitive,
            depth_stencil: self.depth.clone(),
            multisample: wgpu::MultisampleState::default(),
            fragment: self.has_fragments.then_some(wgpu::FragmentState {
                module,
                entry_point: Some("fragment"),
                compilation_options,
                targets: &targets,
            }),
            multiview_mask: None,
            cache: None,
        })
    }
}

/// The state of a depth buffer that is written where the comparison passes.
pub(super) fn depth_state(
    format: wgpu::TextureFormat,
    compare: wgpu::CompareFunction,
    bias: wgpu::DepthBiasState,
) -> wgpu::DepthStencilState {
    wgpu::DepthStencilState {
        format,
        depth_write_enabled: Some(true),
        depth_compare: Some(compare),
        stencil: wgpu::StencilState::default(),
        bias,
    }
}

/// The vertices of a full-screen triangle.
pub(super) const FULL_SCREEN: Range<u32> = 0..3;

/// The parameters of a pass.
pub(super) struct Pass<'a> {
    pub(super) pipeline: &'a wgpu::RenderPipeline,
    pub(super) bindings: &'a wgpu::BindGroup,
    pub(super) colours: &'a [&'a wgpu::TextureView],
    /// The depth buffer and how it is loaded.
    pub(super) depth: Option<(&'a wgpu::TextureView, wgpu::LoadOp<f32>)>,
    /// The vertex buffer; none for a full-screen triangle.
    pub(super) geometry: Option<&'a Geometry>,
    pub(super) draws: &'a [Range<u32>],
}

impl Pass<'_> {
    /// Runs the pass with colours cleared to zero, and waits for it. Returns the GPU time, where timestamps are
    /// supported.
    pub(super) fn run(&self, gpu: &Gpu) -> Result<Option<Duration>> {
        let clock = gpu.tick.map(|tick| (tick, Clock::new(gpu)));
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        {
            let colours: Vec<_> = self.colours.iter().map(|view| Some(cleared(view))).collect();
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                color_attachments: &colours,
                depth_stencil_attachment: self.depth.map(|(view, load)| wgpu::RenderPassDepthStencilAttachment {
                    view,
                    depth_ops: Some(wgpu::Operations { load, store: wgpu::StoreOp::Store }),
                    stencil_ops: None,
                }),
                timestamp_writes: clock.as_ref().map(|(_, clock)| clock.around_pass()),
                ..Default::default()
            });
            pass.set_pipeline(self.pipeline);
            pass.set_bind_group(0, self.bindings, &[]);
            if let Some(geometry) = self.geometry {
                pass.set_vertex_buffer(0, geometry.buffer.slice(..));
            }
            for vertices in self.draws {
                pass.draw(vertices.clone(), 0..1);
            }
        }
        if let Some((_, clock)) = &clock {
            encoder.resolve_query_set(&clock.queries, 0..2, &clock.resolved, 0);
            encoder.copy_buffer_to_buffer(&clock.resolved, 0, &clock.readable, 0, 16);
        }
        gpu.queue.submit([encoder.finish()]);
        clock.map(|(tick, clock)| clock.read(gpu, tick)).transpose()
    }
}

fn cleared(view: &wgpu::TextureView) -> wgpu::RenderPassColorAttachment<'_> {
    wgpu::RenderPassColorAttachment {
        view,
        depth_slice: None,
        resolve_target: None,
        ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT), store: wgpu::StoreOp::Store },
    }
}

/// Two timestamps, before and after a pass.
struct Clock {
    queries: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    readable: wgpu::Buffer,
}

impl Clock {
    fn new(gpu: &Gpu) -> Self {
        let description = wgpu::QuerySetDescriptor { label: None, ty: wgpu::QueryType::Timestamp, count: 2 };
        let buffer = |usage| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: None,
                size: 16,
                usage,
                mapped_at_creation: false,
            })
        };
        Self {
            queries: gpu.device.create_query_set(&description),
            resolved: buffer(wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC),
            readable: buffer(wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST),
        }
    }

    fn around_pass(&self) -> wgpu::RenderPassTimestampWrites<'_> {
        wgpu::RenderPassTimestampWrites {
            query_set: &self.queries,
            beginning_of_pass_write_index: Some(0),
            end_of_pass_write_index: Some(1),
        }
    }

    fn read(&self, gpu: &Gpu, tick: f64) -> Result<Duration> {
        let bytes = read_back::bytes(gpu, &self.readable)?;
        let ticks: &[u64] = bytemuck::cast_slice(&bytes);
        let elapsed = ticks[1].saturating_sub(ticks[0]);
        Ok(Duration::from_secs_f64(elapsed as f64 * tick * 1e-9))
    }
}
