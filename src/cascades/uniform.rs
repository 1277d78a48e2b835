//! The data that a shader needs about cascades, as one block of memory.

use super::{CascadeLayout, CascadeMaps, Cascades};
use crate::map::receiver_offset::ReceiverOffset;
use crate::map::shadow_map::ShadowMap;

/// The data that a shader needs about cascades: `struct shadowfit_Cascades` of `wgsl::CASCADES`, byte for byte
/// ([`CascadeMaps::uniform`]).
///
/// Cascades without a map have the layer −1, and so have those past the last. Their other numbers are zero, but for depths:
/// the last cascade, and those past it, end at the largest f32.
#[doc(alias = "cascade uniform buffer")]
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct CascadeUniform {
    /// For each cascade the columns of the matrix that receivers are tested with: from positions to texture coordinates
    /// in the texture that holds all maps, and to the depth to compare there.
    pub texture_from_origin: [[f32; 16]; Cascades::MAX],
    /// The least and the largest texture coordinates inside the border of each cascade's map.
    pub inner: [[f32; 4]; Cascades::MAX],
    /// The view depth where each cascade ends.
    pub far: [f32; Cascades::MAX],
    /// The view depth from which on the next cascade is blended in.
    pub blend: [f32; Cascades::MAX],
    /// The layer of each cascade's map; −1 for none.
    pub layer: [i32; Cascades::MAX],
}

impl CascadeUniform {
    /// The size of the block in bytes.
    pub const SIZE: usize = size_of::<Self>();

    const NONE: Self = Self {
        texture_from_origin: [[0.0; 16]; Cascades::MAX],
        inner: [[0.0; 4]; Cascades::MAX],
        far: [f32::MAX; Cascades::MAX],
        blend: [f32::MAX; Cascades::MAX],
        layer: [-1; Cascades::MAX],
    };

    /// The block as bytes, little-endian as every GPU has it.
    ///
    /// ```
    #[doc = include_str!("../examples/cascades.txt")]
    /// use shadowfit::cascades::CascadeUniform;
    ///
    /// let uniform = maps.uniform(CascadeLayout::Array, |_| None);
    /// let bytes = uniform.to_bytes();
    /// assert_eq!(bytes.len(), CascadeUniform::SIZE);
    /// assert_eq!(bytes[..4], uniform.texture_from_origin[0][0].to_le_bytes());
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn to_bytes(&self) -> [u8; Self::SIZE] {
        let mut bytes = [0; Self::SIZE];
        let floats = self.texture_from_origin.as_flattened().iter().chain(self.inner.as_flattened());
        let floats = floats.chain(&self.far).chain(&self.blend).map(|float| float.to_le_bytes());
        let words = floats.chain(self.layer.map(i32::to_le_bytes));
        for (bytes, word) in bytes.as_chunks_mut().0.iter_mut().zip(words) {
            *bytes = word;
        }
        bytes
    }
}

impl CascadeMaps<'_, '_> {
    /// The data that a shader needs about the cascades and their maps, kept as `layout` says.
    ///
    /// `offset` gives the receiver offset of each map, if it has one: that of its bias, see
    /// [`ShadowMap::receiver_matrix_with`].
    ///
    /// ```
    #[doc = include_str!("../examples/cascades.txt")]
    /// let biased = maps.uniform(CascadeLayout::Array, |map| map.bias(DepthFormat::Unorm24, 1.0).ok().map(|bias| bias.offset()));
    /// assert_eq!(biased.layer, [0, 1, 2, 3, -1, -1, -1, -1]);
    /// assert_eq!(biased.far[0], cascades[0].far as f32);
    /// assert_ne!(biased.texture_from_origin, maps.uniform(CascadeLayout::Array, |_| None).texture_from_origin);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn uniform(
        &self,
        layout: CascadeLayout,
        mut offset: impl FnMut(&ShadowMap) -> Option<ReceiverOffset>,
    ) -> CascadeUniform {
        let mut uniform = CascadeUniform::NONE;
        // The last cascade has no end, and nothing to blend in.
        let cut = self.cascades.iter().take(self.cascades.len() - 1);
        for (cascade, (far, blend)) in cut.zip(uniform.far.iter_mut().zip(&mut uniform.blend)) {
            (*far, *blend) = (cascade.far as f32, cascade.blend as f32);
        }
        for (index, map) in self.maps() {
            let Some(tile) = self.tile(index, layout) else { continue };
            let (least, most) = tile.inner(self.settings.border());
            uniform.texture_from_origin[index] = tile.receiver_matrix(map, offset(map).as_ref()).to_cols_array();
            uniform.inner[index] = [least.x, least.y, most.x, most.y].map(|place| place as f32);
            uniform.layer[index] = tile.layer as i32;
        }
        uniform
    }
}
