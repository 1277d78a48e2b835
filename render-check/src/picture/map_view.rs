//! Ray-cast shadow maps as pictures of their depths.

use image::{Rgb, RgbImage};
use rayon::prelude::*;

use super::canvas::{BODY_COLOUR, Canvas, Sample, encode};
use super::lines::{Line, Pen, draw_lines};
use super::text;
use crate::output::progress;
use crate::trace::{Lens, Tracer};

/// The largest side of a map's picture, in texels.
const MOST_TEXELS: u32 = 1024;

/// The margin around and between maps, in pixels.
const GAP: u32 = 12;

const GROUND: Rgb<u8> = Rgb([24, 26, 30]);
const TEXT: Rgb<u8> = Rgb([225, 225, 220]);
/// The colour of texels without a surface.
const NOTHING: Rgb<u8> = Rgb([38, 44, 64]);

/// The depths of a square shadow map, found by a ray through the middle of each texel.
#[derive(Clone, Debug)]
pub struct DepthMap {
    /// Texels along each side.
    pub size: u32,
    /// Row by row from the top; 0 at the near end of the map's depth range, 1 at the far end and where nothing is
    /// hit.
    pub depths: Vec<f32>,
}

impl DepthMap {
    /// Casts a map through the lens of its matrix.
    #[must_use]
    pub fn cast(lens: &Lens, size: u32, tracer: &Tracer) -> Self {
        let bar = progress::bar("a shadow map", size as usize);
        let mut depths = vec![1.0; size as usize * size as usize];
        depths.par_chunks_mut(size as usize).enumerate().for_each(|(y, row)| {
            for (x, depth) in row.iter_mut().enumerate() {
                let ray = lens.ray_through_pixel(x as u32, y as u32, size, size);
                if let Some(hit) = ray.and_then(|ray| tracer.first_hit(&ray)) {
                    *depth = lens.project(hit.point).z.clamp(0.0, 1.0) as f32;
                }
            }
            bar.inc(1);
        });
        bar.finish_and_clear();
        Self { size, depths }
    }

    /// The map in greys: near is light and far is dark, normalised to the depths that occur.
    #[must_use]
    pub fn to_image(&self) -> RgbImage {
        let met = self.depths.iter().copied().filter(|&d| d < 1.0);
        let (near, far) = met.fold((f32::INFINITY, f32::NEG_INFINITY), |(a, b), d| (a.min(d), b.max(d)));
        let scale = if far > near { 1.0 / (far - near) } else { 0.0 };
        RgbImage::from_fn(self.size, self.size, |x, y| match self.depths[(y * self.size + x) as usize] {
            depth if depth < 1.0 => Rgb([(235.0 - 195.0 * (depth - near) * scale).round() as u8; 3]),
            _ => NOTHING,
        })
    }
}

/// A map's title and its lens.
pub type TitledMap = (String, Lens);

/// Casts maps of `size` texels and puts them side by side, each with the edges of H as seen through the map.
#[must_use]
pub fn maps_view(maps: &[TitledMap], size: u32, tracer: &Tracer, body: &[Line]) -> RgbImage {
    let shown = size.min(MOST_TEXELS);
    let top = 2 * GAP + text::LETTER;
    let width = GAP + maps.len() as u32 * (shown + GAP);
    let mut image = RgbImage::from_pixel(width, top + shown + GAP, GROUND);
    for (left, (title, lens)) in (GAP..).step_by((shown + GAP) as usize).zip(maps) {
        text::write(&mut image, title, left, GAP, TEXT);
        let map = with_lines(DepthMap::cast(lens, shown, tracer).to_image(), lens, body);
        image::imageops::replace(&mut image, &map, i64::from(left), i64::from(top));
    }
    image
}

/// Draws thin lines over a finished map, hidden parts included.
fn with_lines(map: RgbImage, lens: &Lens, lines: &[Line]) -> RgbImage {
    let blank = Sample { colour: [0.0; 3], distance: f64::INFINITY };
    let (width, height) = map.dimensions();
    let mut overlay = Canvas { width, height, samples: vec![blank; (width * height) as usize] };
    let pen = Pen { colour: [1.0; 3], radius: 0.7, opacity: 0.75, hidden_opacity: 0.75 };
    draw_lines(&mut overlay, lens, lines, &pen);
    let body_colour = BODY_COLOUR.map(encode);
    RgbImage::from_fn(width, height, |x, y| {
        let ink = overlay.samples[overlay.index(x, y)].colour[0];
        let texel = map.get_pixel(x, y).0;
        Rgb([0, 1, 2].map(|i| (f32::from(texel[i]) * (1.0 - ink) + f32::from(body_colour[i]) * ink).round() as u8))
    })
}
