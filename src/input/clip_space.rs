//! Clip conventions: the directions and ranges of depth and y in a projection matrix.

use crate::convex::Plane;

/// The depth range of clip space: the values at the near and the far plane.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum DepthRange {
    /// 0 near, 1 far: wgpu, Direct3D, Metal, Vulkan. The depth test is 'less'.
    #[default]
    ZeroToOne,
    /// 1 near, 0 far: reversed z on the same APIs. The depth test is 'greater'.
    #[doc(alias = "reversed z")]
    #[doc(alias = "reverse z")]
    ZeroToOneReversed,
    /// −1 near, 1 far: OpenGL. The depth test is 'less'.
    NegativeOneToOne,
    /// 1 near, −1 far: OpenGL drawn with the depth test 'greater'.
    NegativeOneToOneReversed,
}

/// Which way y runs in clip space.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum YAxis {
    /// +1 is the top: wgpu, Direct3D, Metal, OpenGL.
    #[default]
    Up,
    /// +1 is the bottom: Vulkan.
    Down,
}

/// The corner of a texture with the coordinates (0, 0).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum TextureOrigin {
    /// Top left: wgpu, Direct3D, Metal, Vulkan.
    #[default]
    TopLeft,
    /// Bottom left: OpenGL. With `glClipControl(GL_UPPER_LEFT, …)` choose [`Self::TopLeft`] and y up; for images drawn upside
    /// down without it, choose this and y down.
    BottomLeft,
}

/// A clip convention: the depth range and y axis of a graphics API, for matrices read ([`View::from_matrices`]) and written
/// ([`Settings::with_clip`]).
///
/// [`View::from_matrices`]: crate::View::from_matrices
/// [`Settings::with_clip`]: crate::Settings::with_clip
///
/// ```
/// use shadowfit::{ClipSpace, input::{DepthRange, TextureOrigin, YAxis}};
///
/// assert_eq!(ClipSpace::default(), ClipSpace::WGPU);
/// assert_eq!(ClipSpace::VULKAN.y, YAxis::Down);
/// assert_eq!(ClipSpace::OPENGL.depth, DepthRange::NegativeOneToOne);
/// assert_eq!(ClipSpace::OPENGL.texture_origin, TextureOrigin::BottomLeft);
/// ```
#[doc(alias = "NDC")]
#[doc(alias = "clip convention")]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ClipSpace {
    /// The depth range.
    pub depth: DepthRange,
    /// The direction of y.
    pub y: YAxis,
    /// The origin of texture coordinates; only matrices to texture space depend on it.
    pub texture_origin: TextureOrigin,
}

impl DepthRange {
    /// Whether the near plane has the larger value, so that the depth test is 'greater'.
    ///
    /// ```
    /// use shadowfit::ClipSpace;
    ///
    /// assert!(!ClipSpace::WGPU.depth.is_reversed());
    /// assert!(ClipSpace::WGPU.reversed().depth.is_reversed());
    /// ```
    #[must_use]
    pub const fn is_reversed(self) -> bool {
        matches!(self, Self::ZeroToOneReversed | Self::NegativeOneToOneReversed)
    }

    /// The near and the far plane, not negative inside, of a matrix by its rows z and w.
    ///
    /// Where a plane is the row z itself, it is not computed from sums with w: a reversed far plane would lose its digits there.
    pub(crate) fn ends<T>(self, z: T, w: T) -> [T; 2]
    where
        T: Copy + core::ops::Add<Output = T> + core::ops::Sub<Output = T>,
    {
        match self {
            Self::ZeroToOne => [z, w - z],
            Self::ZeroToOneReversed => [w - z, z],
            Self::NegativeOneToOne => [w + z, w - z],
            Self::NegativeOneToOneReversed => [w - z, w + z],
        }
    }
}

impl ClipSpace {
    /// wgpu, WebGPU, Direct3D and Metal: depth 0 to 1, y up, textures from the top left.
    pub const WGPU: Self =
        Self { depth: DepthRange::ZeroToOne, y: YAxis::Up, texture_origin: TextureOrigin::TopLeft };
    /// Vulkan: as [`Self::WGPU`] with y down.
    pub const VULKAN: Self = Self { y: YAxis::Down, ..Self::WGPU };
    /// OpenGL: depth −1 to 1, y up, textures from the bottom left.
    pub const OPENGL: Self =
        Self { depth: DepthRange::NegativeOneToOne, y: YAxis::Up, texture_origin: TextureOrigin::BottomLeft };

    /// The same convention with near and far exchanged: reversed z.
    ///
    /// ```
    /// use shadowfit::{ClipSpace, input::DepthRange};
    ///
    /// assert_eq!(ClipSpace::WGPU.reversed().depth, DepthRange::ZeroToOneReversed);
    /// assert_eq!(ClipSpace::OPENGL.reversed().reversed(), ClipSpace::OPENGL);
    /// ```
    #[doc(alias = "reversed z")]
    #[must_use]
    pub const fn reversed(self) -> Self {
        let depth = match self.depth {
            DepthRange::ZeroToOne => DepthRange::ZeroToOneReversed,
            DepthRange::ZeroToOneReversed => DepthRange::ZeroToOne,
            DepthRange::NegativeOneToOne => DepthRange::NegativeOneToOneReversed,
            DepthRange::NegativeOneToOneReversed => DepthRange::NegativeOneToOne,
        };
        Self { depth, ..self }
    }

    /// Rows of this convention from rows with depth 0 to 1 and y up.
    pub(crate) fn rows_from_wgpu(self, [x, y, z, w]: [Plane; 4]) -> [Plane; 4] {
        let y = match self.y {
            YAxis::Up => y,
            YAxis::Down => -y,
        };
        let z = match self.depth {
            DepthRange::ZeroToOne => z,
            DepthRange::ZeroToOneReversed => w - z,
            DepthRange::NegativeOneToOne => z * 2.0 - w,
            DepthRange::NegativeOneToOneReversed => w - z * 2.0,
        };
        [x, y, z, w]
    }

    /// Rows of the texture-space matrix from rows with depth 0 to 1 and y up: after the division, (x, y) are texture
    /// coordinates in [0, 1]² and z is the value in the depth buffer.
    ///
    /// It is the product `Tscale · Tbias · Plight · Vlight` of Kilgard (2000), for world positions: without his multiplication by
    /// the inverse of the eye's view.
    pub(crate) fn texture_rows_from_wgpu(self, [x, y, z, w]: [Plane; 4]) -> [Plane; 4] {
        // Only OpenGL stores the bottom row first while y points up; everywhere else the first row is the top one.
        let up = (self.y, self.texture_origin) == (YAxis::Up, TextureOrigin::BottomLeft);
        let v = if up { (w + y) * 0.5 } else { (w - y) * 0.5 };
        let depth = if self.depth.is_reversed() { w - z } else { z };
        [(w + x) * 0.5, v, depth, w]
    }
}
