//! Short labels in finished pictures.

use font8x8::legacy::BASIC_LEGACY;
use image::{Rgb, RgbImage};

/// The side of a letter's square, in pixels: the font's 8 × 8 dots, doubled.
pub(super) const LETTER: u32 = 8 * SCALE;

const SCALE: u32 = 2;

/// Writes a line of text with its top left corner at a position, clipped to the picture.
pub(super) fn write(image: &mut RgbImage, text: &str, left: u32, top: u32, colour: Rgb<u8>) {
    for (i, letter) in text.chars().enumerate() {
        let rows = BASIC_LEGACY.get(letter as usize).copied().unwrap_or(BASIC_LEGACY['?' as usize]);
        for (y, x) in (0..LETTER).flat_map(|y| (0..LETTER).map(move |x| (y, x))) {
            let is_set = rows[(y / SCALE) as usize] >> (x / SCALE) & 1 == 1;
            if let (true, Some(pixel)) =
                (is_set, image.get_pixel_mut_checked(left + i as u32 * LETTER + x, top + y))
            {
                *pixel = colour;
            }
        }
    }
}

/// Writes a line in the bottom left corner, on a dark ground so that it is readable over anything.
pub(super) fn caption(image: &mut RgbImage, parts: &[(&str, Rgb<u8>)]) {
    const MARGIN: u32 = 6;
    let letters: usize = parts.iter().map(|(text, _)| text.chars().count()).sum();
    let (width, height) = image.dimensions();
    let strip = LETTER + 2 * MARGIN;
    for y in height.saturating_sub(strip)..height {
        for x in 0..(letters as u32 * LETTER + 2 * MARGIN).min(width) {
            let pixel = image.get_pixel_mut(x, y);
            *pixel = Rgb(pixel.0.map(|c| c / 4));
        }
    }
    let mut left = MARGIN;
    for (text, colour) in parts {
        write(image, text, left, height.saturating_sub(strip) + MARGIN, *colour);
        left += text.chars().count() as u32 * LETTER;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_leave_their_dots() {
        let mut image = RgbImage::new(64, 20);
        write(&mut image, "I.", 2, 2, Rgb([255; 3]));
        let dots = |columns: std::ops::Range<u32>| {
            columns.filter(|&x| (0..20).any(|y| image.get_pixel(x, y).0[0] > 0)).count()
        };
        assert!(dots(2..18) > 0 && dots(18..34) > 0 && dots(34..64) == 0);
    }

    #[test]
    fn text_too_long_for_a_picture_is_cut_off() {
        let mut image = RgbImage::new(10, 10);
        caption(&mut image, &[("much too long", Rgb([255; 3]))]);
    }
}
