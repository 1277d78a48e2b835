//! The key of the pipeline cache.

/// All parameters of a pipeline.
#[derive(PartialEq, Eq, Hash)]
pub(super) struct PipelineKey {
    pub(super) shader: String,
    /// With the bits of the values, as `f64` is not `Eq`.
    pub(super) constants: Vec<(String, u64)>,
    pub(super) takes_geometry: bool,
    pub(super) has_fragments: bool,
    pub(super) primitive: wgpu::PrimitiveState,
    pub(super) depth: Option<wgpu::DepthStencilState>,
    pub(super) targets: Vec<wgpu::TextureFormat>,
}
