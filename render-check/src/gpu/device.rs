//! The graphics adapter, and helpers to create resources on it.

use std::collections::HashMap;
use std::sync::Mutex;

use anyhow::{Context, Result, anyhow};
use pollster::block_on;
use shadowfit::glam::Mat4;
use wgpu::util::{BufferInitDescriptor, DeviceExt as _};

use super::pipeline_key::PipelineKey;

/// The error without an adapter.
const NO_ADAPTER: &str = "no graphics adapter was found: install a Vulkan driver (on Debian, `apt-get install \
                          mesa-vulkan-drivers` has one in software), or use `render-check draw`, which needs none";

/// A GPU, or a software driver.
pub struct Gpu {
    pub(super) device: wgpu::Device,
    pub(super) queue: wgpu::Queue,
    name: String,
    is_software: bool,
    /// The pipelines that were built so far.
    pub(super) pipelines: Mutex<HashMap<PipelineKey, wgpu::RenderPipeline>>,
    /// Nanoseconds per tick of a timestamp, where timestamps are supported.
    pub(super) tick: Option<f64>,
}

impl Gpu {
    /// Opens the adapter that the environment names (`WGPU_ADAPTER_NAME`), else the fastest one.
    ///
    /// # Errors
    ///
    /// When there is none, with a hint.
    pub fn new() -> Result<Self> {
        block_on(Self::open())
    }

    async fn open() -> Result<Self> {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle_from_env());
        let adapter = match std::env::var("WGPU_ADAPTER_NAME") {
            Ok(_) => wgpu::util::initialize_adapter_from_env(&instance, None).await.map_err(anyhow::Error::from),
            Err(_) => {
                let power_preference = wgpu::PowerPreference::HighPerformance;
                let options = wgpu::RequestAdapterOptions { power_preference, ..Default::default() };
                instance.request_adapter(&options).await.map_err(anyhow::Error::from)
            }
        }
        .context(NO_ADAPTER)?;
        let info = adapter.get_info();
        let timestamps = adapter.features() & wgpu::Features::TIMESTAMP_QUERY;
        let description = wgpu::DeviceDescriptor {
            label: None,
            required_features: timestamps,
            // All of the adapter's limits: maps of 8192² texels and scenes of a million triangles need them.
            required_limits: adapter.limits(),
            ..Default::default()
        };
        let (device, queue) = adapter
            .request_device(&description)
            .await
            .with_context(|| format!("the graphics adapter '{}' cannot be used", info.name))?;
        let tick = (!timestamps.is_empty()).then(|| f64::from(queue.get_timestamp_period()));
        let (name, is_software) =
            (format!("{} ({})", info.name, info.backend), info.device_type == wgpu::DeviceType::Cpu);
        Ok(Self { device, queue, name, is_software, pipelines: Mutex::default(), tick })
    }

    /// The adapter's name and graphics API.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Whether it is a software driver: then times are CPU times.
    #[must_use]
    pub fn is_software(&self) -> bool {
        self.is_software
    }

    /// The largest texture size.
    #[must_use]
    pub fn largest_texture(&self) -> u32 {
        self.device.limits().max_texture_dimension_2d
    }

    /// Runs `work` and returns the device's errors, which would panic otherwise.
    pub(super) fn guarded<T>(&self, what: &str, work: impl FnOnce() -> Result<T>) -> Result<T> {
        let scopes = [wgpu::ErrorFilter::Validation, wgpu::ErrorFilter::OutOfMemory, wgpu::ErrorFilter::Internal]
            .map(|filter| self.device.push_error_scope(filter));
        let result = work();
        let mut complaint = None;
        for scope in scopes.into_iter().rev() {
            complaint = block_on(scope.pop()).or(complaint);
        }
        match complaint {
            Some(error) => Err(anyhow!("{error}")).with_context(|| format!("{}: {what}", self.name)),
            None => result,
        }
    }

    pub(super) fn uniforms(&self, matrices: &[Mat4]) -> wgpu::Buffer {
        self.numbers(matrices.iter().flat_map(Mat4::to_cols_array), wgpu::BufferUsages::UNIFORM)
    }

    /// A storage buffer.
    pub(super) fn storage(&self, numbers: impl IntoIterator<Item = f32>) -> wgpu::Buffer {
        self.numbers(numbers, wgpu::BufferUsages::STORAGE)
    }

    fn numbers(&self, numbers: impl IntoIterator<Item = f32>, usage: wgpu::BufferUsages) -> wgpu::Buffer {
        let numbers: Vec<f32> = numbers.into_iter().collect();
        let contents = bytemuck::cast_slice(&numbers);
        self.device.create_buffer_init(&BufferInitDescriptor { label: None, contents, usage })
    }

    pub(super) fn shader(&self, source: &str) -> wgpu::ShaderModule {
        let source = wgpu::ShaderSource::Wgsl(source.into());
        self.device.create_shader_module(wgpu::ShaderModuleDescriptor { label: None, source })
    }

    /// A texture to render to and sample, with its view.
    pub(super) fn target(&self, size: [u32; 2], format: wgpu::TextureFormat) -> (wgpu::Texture, wgpu::TextureView) {
        let texture = self.layers(size, 1, format);
        let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        (texture, view)
    }

    /// The same as an array texture, without views.
    pub(super) fn layers(
        &self,
        [width, height]: [u32; 2],
        count: u32,
        format: wgpu::TextureFormat,
    ) -> wgpu::Texture {
        let mut usage = wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING;
        if !format.is_depth_stencil_format() {
            usage |= wgpu::TextureUsages::COPY_SRC;
        }
        self.device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size: wgpu::Extent3d { width, height, depth_or_array_layers: count },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage,
            view_formats: &[],
        })
    }

    pub(super) fn bindings(
        &self,
        pipeline: &wgpu::RenderPipeline,
        resources: &[wgpu::BindingResource<'_>],
    ) -> wgpu::BindGroup {
        let entries: Vec<wgpu::BindGroupEntry<'_>> = (0..)
            .zip(resources)
            .map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource: resource.clone() })
            .collect();
        let layout = &pipeline.get_bind_group_layout(0);
        self.device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout, entries: &entries })
    }
}
