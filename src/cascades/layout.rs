//! The layout of cascades' maps: in layers of a texture array, or in an atlas.

use crate::map::receiver_offset::ReceiverOffset;
use crate::map::shadow_map::ShadowMap;
use glam::{DMat4, DVec2, Mat4};

/// How the maps of cascades are kept.
#[doc(alias = "shadow atlas")]
#[doc(alias = "texture array")]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum CascadeLayout {
    /// Each in a layer of a texture array.
    #[default]
    Array,
    /// All in one texture, in a grid as near to a square as their number and their shape allow.
    Atlas,
}

/// The size of a texture for maps.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct TextureExtent {
    /// Texels across.
    pub width: u32,
    /// Texels down.
    pub height: u32,
    /// Layers.
    pub layers: u32,
}

/// The part of a texture that a map lies in.
#[doc(alias = "viewport")]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct AtlasTile {
    /// The layer.
    pub layer: u32,
    /// The corner with the least coordinates, in texels: where the viewport begins that the map is drawn through.
    pub corner: (u32, u32),
    /// Texels across and down.
    pub size: (u32, u32),
    /// The texture.
    pub extent: TextureExtent,
}

impl CascadeLayout {
    /// Tiles across and down for so many maps of a size.
    fn grid(self, maps: u32, (width, height): (u32, u32)) -> (u32, u32) {
        match self {
            Self::Array => (1, 1),
            Self::Atlas => {
                // The least that makes it no higher than wide, if any does.
                let across = (1..=maps).find(|across| across * width >= maps.div_ceil(*across) * height);
                let across = across.unwrap_or(maps).max(1);
                (across, maps.div_ceil(across).max(1))
            }
        }
    }

    /// The texture for so many maps of so many texels across and down.
    pub(super) fn extent(self, maps: u32, size: (u32, u32)) -> TextureExtent {
        let (across, down) = self.grid(maps, size);
        let layers = match self {
            Self::Array => maps,
            Self::Atlas => maps.min(1),
        };
        TextureExtent { width: across * size.0, height: down * size.1, layers }
    }

    /// The tile of one of so many maps.
    pub(super) fn tile(self, index: u32, maps: u32, size: (u32, u32)) -> AtlasTile {
        let (across, _) = self.grid(maps, size);
        let (layer, column, row) = match self {
            Self::Array => (index, 0, 0),
            Self::Atlas => (0, index % across, index / across),
        };
        AtlasTile { layer, corner: (column * size.0, row * size.1), size, extent: self.extent(maps, size) }
    }
}

impl AtlasTile {
    /// The scale and the offset from texture coordinates in the map to those in the texture: `place * scale + offset`.
    ///
    /// ```
    #[doc = include_str!("../examples/cascades.txt")]
    /// let tile = maps.tile(1, CascadeLayout::Atlas).expect("a map");
    /// let (scale, offset) = tile.texture_from_map();
    /// assert_eq!((scale.x, scale.y, offset.x, offset.y), (0.5, 0.5, 0.5, 0.0));
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn texture_from_map(&self) -> (DVec2, DVec2) {
        let whole = texels((self.extent.width, self.extent.height));
        (texels(self.size) / whole, texels(self.corner) / whole)
    }

    /// The matrix that receivers are tested with in this texture: [`ShadowMap::receiver_matrix`], or
    /// [`ShadowMap::receiver_matrix_with`] an offset, with texture coordinates in the texture.
    ///
    /// Rounding of its last row moves a place by as much of the texture as it would of the map: in texels, up to 2c + 1
    /// times as far in column or row c.
    ///
    /// ```
    #[doc = include_str!("../examples/cascades.txt")]
    /// let (index, map) = maps.maps().last().expect("a map");
    /// let tile = maps.tile(index, CascadeLayout::Atlas).expect("a map");
    /// let ground = view.eye() + 100.0 * view.forward();
    /// let place = tile.receiver_matrix(map, None).project_point3(ground.as_vec3());
    /// assert!(place.x > 0.5 && place.y > 0.5 && place.max_element() < 1.0); // the last of 2 × 2
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn receiver_matrix(&self, map: &ShadowMap, offset: Option<&ReceiverOffset>) -> Mat4 {
        let map_from_world = match offset {
            Some(offset) => map.texture_from_world_with(offset),
            None => map.texture_from_world(),
        };
        let (scale, offset) = self.texture_from_map();
        let texture_from_map = DMat4::from_translation(offset.extend(0.0)) * DMat4::from_scale(scale.extend(1.0));
        map.about_origin(texture_from_map * map_from_world).as_mat4()
    }

    /// The range of texture coordinates, in the texture, that receivers have in the map: inside its border of `border`
    /// texels. A filter that reads no farther than the border reads nothing of another map there.
    ///
    /// ```
    #[doc = include_str!("../examples/cascades.txt")]
    /// let tile = maps.tile(0, CascadeLayout::Atlas).expect("a map");
    /// let (least, most) = tile.inner(2);
    /// assert_eq!((least.x, most.x), (2.0 / 2048.0, 1022.0 / 2048.0));
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn inner(&self, border: u32) -> (DVec2, DVec2) {
        let (scale, offset) = self.texture_from_map();
        let part = f64::from(border) / texels(self.size);
        (offset + scale * part, offset + scale * (1.0 - part))
    }
}

fn texels((across, down): (u32, u32)) -> DVec2 {
    DVec2::new(across.into(), down.into())
}
