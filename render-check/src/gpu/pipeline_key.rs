//! How pipelines that were built are found again.

/// All that a pipeline is made of, to know it by.
#[derive(PartialEq, Eq, Hash)]
pub(super) struct PipelineKey {
    pub(super) shader: String,
    /// The bits of the numbers.
    pub(super) constants: Vec<(String, u64)>,
    pub(super) takes_geometry: bool,
    pub(super) has_fragments: bool,
    pub(super) primitive: wgpu::PrimitiveState,
    pub(super) depth: Option<wgpu::DepthStencilState>,
    pub(super) targets: Vec<wgpu::TextureFormat>,
}
