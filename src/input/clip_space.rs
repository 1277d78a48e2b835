//! Clip conventions: how a projection matrix, read or written, numbers depth and height.

use crate::convex::Plane;

/// How normalised depth runs from the near plane to the far one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum DepthRange {
    /// 0 near, 1 far: wgpu, Direct3D, Metal, Vulkan. The depth test is 'less'.
    #[default]
    ZeroToOne,
    /// 1 near, 0 far: reversed z on the same APIs. The depth test is 'greater'.
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

/// Which corner of a texture has the coordinates (0, 0).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum TextureOrigin {
    /// Top left: wgpu, Direct3D, Metal, Vulkan.
    #[default]
    TopLeft,
    /// Bottom left: OpenGL. With y down, this is OpenGL drawn upside down, its rasteriser as it is by default; drawn
    /// upright with `glClipControl(GL_UPPER_LEFT, …)`, its textures begin top left and y is up.
    BottomLeft,
}

/// A clip convention: what a graphics API, or a projection matrix made for it, means by depth and by up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ClipSpace {
    /// How depth runs.
    pub depth: DepthRange,
    /// Which way y runs.
    pub y: YAxis,
    /// Where textures begin; only the texture-space matrices depend on it.
    pub texture_origin: TextureOrigin,
}

impl DepthRange {
    /// Whether the near plane has the larger value, so that the depth test is 'greater'.
    #[must_use]
    pub const fn is_reversed(self) -> bool {
        matches!(self, Self::ZeroToOneReversed | Self::NegativeOneToOneReversed)
    }

    /// The near and the far plane, not negative inside, of a matrix by its rows z and w.
    ///
    /// Where a plane is z itself, that keeps all of its digits: beside w, those of a reversed far plane would be lost.
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
    /// coordinates in [0, 1]² and z is what the depth buffer holds.
    ///
    /// It is the product that Kilgard (2000) loads as the texture-coordinate generation planes, `Tscale · Tbias ·
    /// Plight · Vlight`, without his multiplication by the inverse of the eye's view: it takes world positions.
    pub(crate) fn texture_rows_from_wgpu(self, [x, y, z, w]: [Plane; 4]) -> [Plane; 4] {
        // Only OpenGL stores the bottom row first while y points up; everywhere else the first row is the top one.
        let up = (self.y, self.texture_origin) == (YAxis::Up, TextureOrigin::BottomLeft);
        let v = if up { (w + y) * 0.5 } else { (w - y) * 0.5 };
        let depth = if self.depth.is_reversed() { w - z } else { z };
        [(w + x) * 0.5, v, depth, w]
    }
}
