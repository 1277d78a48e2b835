//! Clip spaces by name.

use clap::ValueEnum;
use shadowfit::ClipSpace;

/// A graphics API's clip space, by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum ClipConvention {
    /// Depth 0 to 1, y up
    Wgpu,
    /// Depth 1 to 0, y up
    WgpuReversed,
    /// Depth 0 to 1, y down
    Vulkan,
    /// Depth 1 to 0, y down
    VulkanReversed,
    /// Depth -1 to 1, y up, textures from the bottom
    Opengl,
    /// Depth 1 to -1, y up, textures from the bottom
    OpenglReversed,
}

impl From<ClipConvention> for ClipSpace {
    fn from(clip: ClipConvention) -> Self {
        match clip {
            ClipConvention::Wgpu => Self::WGPU,
            ClipConvention::WgpuReversed => Self::WGPU.reversed(),
            ClipConvention::Vulkan => Self::VULKAN,
            ClipConvention::VulkanReversed => Self::VULKAN.reversed(),
            ClipConvention::Opengl => Self::OPENGL,
            ClipConvention::OpenglReversed => Self::OPENGL.reversed(),
        }
    }
}
