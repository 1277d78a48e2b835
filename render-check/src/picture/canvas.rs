//! A canvas of linear colours and depths, and its conversion to a PNG.

use std::path::Path;

use anyhow::{Context, Result};
use image::{Rgb, RgbImage};
use indicatif::ProgressBar;
use rayon::prelude::*;

/// Linear RGB.
pub type Colour = [f32; 3];

/// The edges of H.
pub(super) const BODY_COLOUR: Colour = [1.0, 0.28, 0.02];

/// The camera's frustum.
pub(super) const FRUSTUM_COLOUR: Colour = [0.03, 0.30, 0.95];

/// Samples across and down each pixel.
pub(super) const SAMPLES: u32 = 2;

/// One sample of a picture.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// The colour.
    pub colour: Colour,
    /// The distance along its ray, in world units; infinite where nothing is hit.
    pub distance: f64,
}

/// A supersampled picture: 2 × 2 samples make a pixel.
#[derive(Clone, Debug)]
pub struct Canvas {
    /// Samples in a row.
    pub width: u32,
    /// Rows of samples; row 0 is at the top.
    pub height: u32,
    /// Row by row.
    pub samples: Vec<Sample>,
}

impl Canvas {
    /// Fills a canvas for a picture of this size in pixels. `sample` gets column, row, and the numbers of columns
    /// and rows, in parallel.
    pub fn render(
        width: u32,
        height: u32,
        progress: &ProgressBar,
        sample: impl Fn(u32, u32, u32, u32) -> Sample + Sync,
    ) -> Self {
        let (width, height) = (width * SAMPLES, height * SAMPLES);
        progress.set_length(u64::from(height));
        let blank = Sample { colour: [0.0; 3], distance: f64::INFINITY };
        let mut samples = vec![blank; width as usize * height as usize];
        samples.par_chunks_mut(width as usize).enumerate().for_each(|(y, row)| {
            for (x, place) in row.iter_mut().enumerate() {
                *place = sample(x as u32, y as u32, width, height);
            }
            progress.inc(1);
        });
        progress.finish_and_clear();
        Self { width, height, samples }
    }

    /// The index of a sample in `samples`.
    #[must_use]
    pub fn index(&self, x: u32, y: u32) -> usize {
        y as usize * self.width as usize + x as usize
    }

    /// The finished picture.
    #[must_use]
    pub fn to_image(&self) -> RgbImage {
        RgbImage::from_fn(self.width / SAMPLES, self.height / SAMPLES, |x, y| {
            let mut sum = [0.0; 3];
            for (dx, dy) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
                let sample = self.samples[self.index(SAMPLES * x + dx, SAMPLES * y + dy)];
                sum = [0, 1, 2].map(|i| sum[i] + sample.colour[i].clamp(0.0, 1.0));
            }
            Rgb(sum.map(|c| encode(c / (SAMPLES * SAMPLES) as f32)))
        })
    }
}

/// A linear intensity as an sRGB byte.
#[must_use]
pub(super) fn encode(linear: f32) -> u8 {
    let linear = linear.clamp(0.0, 1.0);
    let encoded = if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 };
    (255.0 * encoded).round() as u8
}

/// Mixes two colours; `amount` 0 is the first and 1 the second.
#[must_use]
pub(super) fn mix(first: Colour, second: Colour, amount: f32) -> Colour {
    [0, 1, 2].map(|i| first[i] + amount * (second[i] - first[i]))
}

/// Writes a picture as PNG.
///
/// # Errors
///
/// When the file cannot be written.
pub fn save(image: &RgbImage, path: &Path) -> Result<()> {
    image.save(path).with_context(|| format!("cannot write the picture '{}'", path.display()))
}
