//! A camera's depth buffer, reduced to tiles.

use crate::error::{Expected, InputError, check};
use crate::input::clip_space::DepthRange;

/// One tile of a reduced depth buffer: what `wgsl::DEPTH_TILES` writes on the card, and [`DepthTile::reduce`] makes on
/// the CPU.
///
/// Depths are as stored in the buffer, from 0 to 1.
///
/// ```
/// use shadowfit::seen::DepthTile;
///
/// assert_eq!(size_of::<DepthTile>(), DepthTile::SIZE);
/// assert!(DepthTile::EMPTY.is_empty());
/// ```
#[doc(alias = "Hi-Z")]
#[doc(alias = "SDSM")]
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct DepthTile {
    /// The least stored depth of the pixels that show a surface.
    pub least: f32,
    /// The greatest.
    pub greatest: f32,
    /// The stored depth at the sample, the pixel with a surface that is nearest to the tile's middle.
    pub depth: f32,
    /// The change of stored depth from the sample to the next pixel to the right and to the next one down: the smaller one of both
    /// sides, 0 where neither shows a surface. On a plane stored depth is an affine function in the image, so that this and
    /// [`Self::depth`] give the plane.
    pub slope: [f32; 2],
    /// The sample's pixel in the image, from the left and from the top.
    pub pixel: [u16; 2],
    /// The number of pixels that show a surface.
    pub pixels: u32,
}

impl DepthTile {
    /// The size of a tile in bytes.
    pub const SIZE: usize = 28;

    /// A tile that shows no surface.
    pub const EMPTY: Self =
        Self { least: 1.0, greatest: 0.0, depth: 0.0, slope: [0.0; 2], pixel: [0; 2], pixels: 0 };

    /// Whether the tile shows no surface.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.pixels == 0
    }

    /// A tile from the bytes that a card wrote, little-endian as every GPU has it.
    ///
    /// ```
    /// use shadowfit::seen::DepthTile;
    ///
    /// let tile = DepthTile { least: 0.25, greatest: 0.5, pixels: 9, ..DepthTile::EMPTY };
    /// assert_eq!(DepthTile::from_bytes(&tile.to_bytes()), tile);
    /// ```
    #[must_use]
    pub fn from_bytes(bytes: &[u8; Self::SIZE]) -> Self {
        let word = |index: usize| {
            let at = 4 * index;
            [bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]]
        };
        let float = |index| f32::from_le_bytes(word(index));
        let pixel = u32::from_le_bytes(word(5));
        Self {
            least: float(0),
            greatest: float(1),
            depth: float(2),
            slope: [float(3), float(4)],
            pixel: [(pixel & 0xffff) as u16, (pixel >> 16) as u16],
            pixels: u32::from_le_bytes(word(6)),
        }
    }

    /// The bytes of a tile, as a card writes them.
    #[must_use]
    pub fn to_bytes(&self) -> [u8; Self::SIZE] {
        let [x, y] = self.pixel.map(u32::from);
        let words = [
            self.least.to_bits(),
            self.greatest.to_bits(),
            self.depth.to_bits(),
            self.slope[0].to_bits(),
            self.slope[1].to_bits(),
            x | y << 16,
            self.pixels,
        ];
        let mut bytes = [0; Self::SIZE];
        for (bytes, word) in bytes.as_chunks_mut().0.iter_mut().zip(words) {
            *bytes = word.to_le_bytes();
        }
        bytes
    }

    /// Reduces a depth buffer of rows from the top to rows of tiles, as the card does.
    ///
    /// Pixels at the depth of the far plane, as a cleared buffer has it, show no surface.
    ///
    /// # Errors
    ///
    /// Names `"image"` when it has no pixels or more than 65,535 across or down, `"tile"` when it is 0 or more than 32,768, and
    /// `"depths"` when there are not as many as pixels.
    ///
    /// ```
    /// use shadowfit::{input::DepthRange, seen::DepthTile};
    ///
    /// // A wall to the left, the sky to the right, in reversed depth.
    /// let depths = [0.5, 0.5, 0.0, 0.0, 0.25, 0.25, 0.0, 0.0];
    /// let tiles: Vec<_> = DepthTile::reduce(&depths, [4, 2], 2, DepthRange::ZeroToOneReversed)?.collect();
    /// assert_eq!((tiles[0].least, tiles[0].greatest, tiles[0].pixels), (0.25, 0.5, 4));
    /// assert!(tiles[1].is_empty());
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    pub fn reduce(
        depths: &[f32],
        image: [u32; 2],
        tile: u32,
        range: DepthRange,
    ) -> Result<impl Iterator<Item = Self> + '_, InputError> {
        let grid = Grid::new(image, tile)?;
        let pixels = f64::from(image[0]) * f64::from(image[1]);
        check::within("depths", depths.len() as f64, Expected::Within { least: pixels, most: pixels })?;
        let buffer = Buffer { depths, grid, is_reversed: range.is_reversed() };
        Ok((0..grid.len()).map(move |index| buffer.tile(index)))
    }
}

/// How an image is cut into tiles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Grid {
    /// The image, in pixels across and down.
    pub(crate) image: [u32; 2],
    /// The side of a tile in pixels.
    pub(crate) tile: u32,
}

impl Grid {
    /// The largest tile: twice the distance from its middle, squared, fits into the 31 bits that a shader has for it.
    const MOST_TILE: u32 = 1 << 15;

    pub(crate) fn new(image: [u32; 2], tile: u32) -> Result<Self, InputError> {
        for side in image {
            check::within("image", side.into(), Expected::Within { least: 1.0, most: f64::from(u16::MAX) })?;
        }
        check::within("tile", tile.into(), Expected::Within { least: 1.0, most: Self::MOST_TILE.into() })?;
        Ok(Self { image, tile })
    }

    /// Tiles across and down.
    pub(crate) fn tiles(&self) -> [u32; 2] {
        self.image.map(|side| side.div_ceil(self.tile))
    }

    pub(crate) fn len(&self) -> usize {
        let [across, down] = self.tiles();
        across as usize * down as usize
    }

    /// The first pixel of a tile and the one past its last, across and down.
    pub(crate) fn pixels(&self, index: usize) -> [[u32; 2]; 2] {
        let across = self.tiles()[0];
        let (column, row) = (index as u32 % across, index as u32 / across);
        let first = [column * self.tile, row * self.tile];
        let end = [0, 1].map(|axis| (first[axis] + self.tile).min(self.image[axis]));
        [first, end]
    }
}

/// A depth buffer in memory.
struct Buffer<'a> {
    depths: &'a [f32],
    grid: Grid,
    is_reversed: bool,
}

impl Buffer<'_> {
    /// The stored depth of a pixel that shows a surface.
    fn surface(&self, x: i64, y: i64) -> Option<f32> {
        let [width, height] = self.grid.image.map(i64::from);
        if x < 0 || y < 0 || x >= width || y >= height {
            return None;
        }
        let depth = *self.depths.get((y * width + x) as usize)?;
        let is_surface = if self.is_reversed { depth > 0.0 } else { depth < 1.0 };
        // NaN is no surface.
        (is_surface && (0.0..=1.0).contains(&depth)).then_some(depth)
    }

    fn tile(&self, index: usize) -> DepthTile {
        let [first, end] = self.grid.pixels(index);
        let mut tile = DepthTile::EMPTY;
        let mut nearest = u32::MAX;
        for y in first[1]..end[1] {
            for x in first[0]..end[0] {
                let Some(depth) = self.surface(x.into(), y.into()) else { continue };
                tile.least = if depth < tile.least { depth } else { tile.least };
                tile.greatest = if depth > tile.greatest { depth } else { tile.greatest };
                tile.pixels += 1;
                // Twice the distance to the middle, squared.
                let apart = [(x, 0), (y, 1)].map(|(at, axis)| (2 * at + 1).abs_diff(first[axis] + end[axis]));
                let apart = apart[0] * apart[0] + apart[1] * apart[1];
                if apart < nearest {
                    nearest = apart;
                    (tile.depth, tile.pixel) = (depth, [x as u16, y as u16]);
                }
            }
        }
        if tile.is_empty() {
            return DepthTile::EMPTY;
        }
        let [x, y] = tile.pixel.map(i64::from);
        let change = |dx: i64, dy: i64| {
            let after = self.surface(x + dx, y + dy).map(|depth| depth - tile.depth);
            let before = self.surface(x - dx, y - dy).map(|depth| tile.depth - depth);
            match (after, before) {
                (Some(after), Some(before)) => {
                    if before.abs() < after.abs() {
                        before
                    } else {
                        after
                    }
                }
                (one, other) => one.or(other).unwrap_or(0.0),
            }
        };
        tile.slope = [change(1, 0), change(0, 1)];
        tile
    }
}
