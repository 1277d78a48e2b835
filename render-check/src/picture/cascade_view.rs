//! The cascade of each pixel.

use image::{Rgb, RgbImage};

use super::canvas::{Colour, encode};
use super::text;
use crate::maps::Split;
use crate::verdict::{Truth, TruthImage};

/// A picture tinted by cascade, brightness preserved.
///
/// `rendered` is a picture of the truth's size, as [`shaded`](super::shaded) makes one.
#[must_use]
pub fn tinted(rendered: &RgbImage, truth: &TruthImage, split: &Split) -> RgbImage {
    let mut image = rendered.clone();
    for (pixel, seen) in image.pixels_mut().zip(truth.pixels()) {
        if let Truth::Seen(surface, _) = seen {
            let brightness = pixel.0.iter().map(|&channel| f32::from(channel)).sum::<f32>() / (3.0 * 255.0);
            let tint = COLOURS[split.part_of(surface.point) % COLOURS.len()];
            // Bright surfaces keep their colour, and dark ones stay visible.
            pixel.0 = tint.map(|channel| encode(channel * (0.12 + brightness * brightness)));
        }
    }
    let numbers: Vec<String> = (1..=split.parts()).map(|number| format!("{number} ")).collect();
    let mut parts = vec![("cascade: ", Rgb(TEXT.map(encode)))];
    parts.extend(numbers.iter().zip(COLOURS).map(|(number, colour)| (number.as_str(), Rgb(colour.map(encode)))));
    text::caption(&mut image, &parts);
    image
}

/// A colour for each cascade; neighbours contrast.
const COLOURS: [Colour; 8] = [
    [1.0, 0.25, 0.16],
    [0.30, 0.95, 0.28],
    [0.25, 0.45, 1.0],
    [1.0, 0.85, 0.20],
    [0.85, 0.30, 1.0],
    [0.20, 0.95, 0.95],
    [1.0, 0.55, 0.12],
    [0.60, 0.62, 0.72],
];

const TEXT: Colour = [0.75, 0.75, 0.72];

#[cfg(test)]
mod tests {
    use shadowfit::Scene;
    use shadowfit::cascades::{CascadeSplits, Cascades, SplitScheme};

    use super::*;
    use crate::maps::Cuts;
    use crate::trace::Tracer;
    use crate::verdict::fake::{self, LAMP_NEAR, SUN};

    #[test]
    fn each_cascade_has_a_colour_of_its_own() {
        let mesh = fake::mesh();
        let truth = fake::truth(&SUN, &Tracer::new(&mesh).expect("it has triangles"));
        let [width, height] = truth.size();
        let grey = RgbImage::from_pixel(width, height, Rgb([128; 3]));
        let (min, max) = mesh.bounds();
        let scene = Scene::from_box(min, max).expect("sound");
        let light = SUN.to_light(LAMP_NEAR).expect("sound");
        let cuts = CascadeSplits::Visible { count: 3, split: SplitScheme::Uniform };
        let cascades = Cascades::new(&fake::view(), &light, &scene, cuts, 0.0).expect("a finite view");
        let split = Split::cascades(Cuts::Splits(cuts), cascades);
        let image = tinted(&grey, &truth, &split);
        let mut seen = [0; 3];
        // Above the caption.
        for (index, pixel) in truth.pixels().iter().enumerate().take((width * (height - 30)) as usize) {
            let shown = image.get_pixel(index as u32 % width, index as u32 / width).0;
            let largest = (0..3).max_by_key(|&channel| shown[channel]);
            match pixel.surface().map(|surface| split.part_of(surface.point)) {
                None => assert_eq!(shown, [128; 3]),
                Some(part) => {
                    assert_eq!(largest, Some(part), "{shown:?}");
                    seen[part] += 1;
                }
            }
        }
        assert!(seen.iter().all(|&pixels| pixels > 100), "{seen:?}");
    }
}
