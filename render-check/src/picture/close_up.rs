//! Magnified parts of pictures.

use std::str::FromStr;

use image::imageops::{FilterType, crop_imm, resize};
use image::{Rgb, RgbImage};

use super::text;

/// A square of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CloseUp {
    /// Its centre pixel, from the top left corner.
    pub middle: [u32; 2],
    /// Pixels along its side.
    pub side: u32,
}

/// The side of a magnified part, in pixels, rounded to a multiple of the source pixels.
const SHOWN: u32 = 240;

const TEXT: Rgb<u8> = Rgb([225, 225, 220]);

impl CloseUp {
    /// The square of a picture, magnified, with a title; pixels outside the picture are left out.
    #[must_use]
    pub fn of(&self, image: &RgbImage, title: &str) -> RgbImage {
        let [left, top] = self.middle.map(|middle| middle.saturating_sub(self.side / 2));
        let part = crop_imm(image, left, top, self.side, self.side).to_image();
        let times = (SHOWN / self.side).max(1);
        let mut part = resize(&part, times * part.width(), times * part.height(), FilterType::Nearest);
        text::caption(&mut part, &[(title, TEXT)]);
        part
    }
}

/// Reads `X,Y,SIDE`.
impl FromStr for CloseUp {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers: Result<Vec<u32>, _> = text.split(',').map(|part| part.trim().parse()).collect();
        match numbers.as_deref() {
            Ok(&[x, y, side]) if side > 0 => Ok(Self { middle: [x, y], side }),
            _ => Err(format!("'{text}' should be a pixel and a number of pixels: X,Y,SIDE")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_become_squares() {
        let image = RgbImage::from_fn(64, 64, |x, y| Rgb([x as u8, y as u8, 7]));
        let part = CloseUp { middle: [32, 40], side: 24 }.of(&image, "");
        assert_eq!(part.dimensions(), (240, 240));
        for (x, y) in [(0, 0), (9, 9), (10, 59), (239, 100)] {
            let [across, down] = [x, y].map(|place| (place / 10) as u8);
            assert_eq!(part.get_pixel(x, y).0, [20 + across, 28 + down, 7]);
        }
        assert_eq!("32, 40,24".parse(), Ok(CloseUp { middle: [32, 40], side: 24 }));
        let cut_off = CloseUp { middle: [63, 63], side: 24 }.of(&image, "");
        assert_eq!(cut_off.dimensions(), (130, 130));
    }
}
