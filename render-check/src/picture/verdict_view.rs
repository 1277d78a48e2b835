//! Pictures of a comparison: the rendered image, the truth, their difference, and the aliasing of the map.
//!
//! Not supersampled, so that a picture shows exactly the pixels that were compared.

use image::{Rgb, RgbImage};
use shadowfit::glam::DVec3;

use super::canvas::{Colour, encode, mix};
use super::map_view::DepthMap;
use super::shade::{Lighting, background};
use super::text;
use crate::maps::Layout;
use crate::scene::Mesh;
use crate::trace::{Hit, Ray};
use crate::verdict::{Mark, Truth, TruthImage};

/// The scene shaded with a lit fraction per pixel: the rendered one, or the true one of [`TruthImage::lit`].
///
/// `lit` is the lit fraction, 0 to 1, row by row from the top; pixels beyond its end are dark. It is ignored on
/// surfaces that face away from the light or are out of its range. `mesh` is the one that was traced.
#[must_use]
pub fn shaded(truth: &TruthImage, lighting: &Lighting, mesh: &Mesh, lit: &[f32]) -> RgbImage {
    let eye = truth.view().eye();
    picture(truth.size(), |index, height| match &truth.pixels()[index] {
        Truth::Sky => background(height),
        Truth::Seen(surface, _) => {
            let ray = Ray {
                origin: eye,
                direction: (surface.point - eye).normalize_or(truth.view().forward()),
                length: surface.point.distance(eye),
            };
            let hit = Hit::along(&ray, ray.length, mesh, surface.triangle);
            lighting.shade_by(mesh, &hit, &ray, |_, _| lit.get(index).copied().map_or(0.0, f64::from))
        }
    })
}

/// The difference: the pixels' marks in colours, over the true picture in dim greys.
///
/// `true_picture` is what [`shaded`] makes of the truth; `marks` go row by row from the top.
#[must_use]
pub fn difference(true_picture: &RgbImage, marks: &[Mark]) -> RgbImage {
    let (width, height) = true_picture.dimensions();
    let mut image = picture([width, height], |index, _| {
        let [r, g, b] = true_picture.get_pixel(index as u32 % width, index as u32 / width).0;
        let grey = (0.2126 * f32::from(r) + 0.7152 * f32::from(g) + 0.0722 * f32::from(b)) / 255.0;
        let ground = [DIM * grey * grey; 3];
        marks.get(index).and_then(|mark| colour_of(*mark)).unwrap_or(ground)
    });
    let legend = [
        ("false shadow ", Mark::FalseShadow),
        ("false light ", Mark::FalseLight),
        ("missing caster ", Mark::Missing),
        ("edge", Mark::EdgeTexel),
    ];
    let parts = legend.map(|(what, mark)| (what, Rgb(colour_of(mark).unwrap_or(TEXT).map(encode))));
    text::caption(&mut image, &parts);
    image
}

/// The largest brightness of the greys under the marks.
const DIM: f32 = 0.16;

const TEXT: Colour = [0.75, 0.75, 0.72];

fn colour_of(mark: Mark) -> Option<Colour> {
    match mark {
        Mark::Sky | Mark::Unlit | Mark::Right => None,
        Mark::FalseShadow => Some([1.0, 0.03, 0.02]),
        Mark::FalseLight => Some([0.06, 0.30, 1.0]),
        Mark::Missing => Some([1.0, 0.0, 0.8]),
        Mark::EdgeTexel | Mark::EdgePixel => Some([0.33, 0.17, 0.01]),
    }
}

/// The aliasing, texel size over pixel size: blue below 1, pale at 1, then yellow, red and pink above. Pixels that
/// are not compared, and those for which `aliasing` returns `None`, are dark.
#[must_use]
pub fn aliasing_map(truth: &TruthImage, aliasing: impl Fn(DVec3) -> Option<f64>) -> RgbImage {
    let mut image = picture(truth.size(), |index, _| {
        let compared = truth.pixels()[index].compared();
        compared.and_then(|(surface, _)| aliasing(surface.point)).map_or(NOT_COMPARED, ramp)
    });
    let scale = ["1/8 ", "1/4 ", "1/2 ", "1 ", "2 ", "4 ", "8 ", "16 ", "32 ", "64"];
    let mut parts = vec![("texel / pixel: ", Rgb(TEXT.map(encode)))];
    parts.extend(
        scale.iter().zip(LEAST_LOG2..).map(|(&text, log2)| (text, Rgb(ramp(2_f64.powi(log2)).map(encode)))),
    );
    text::caption(&mut image, &parts);
    image
}

const NOT_COMPARED: Colour = [0.012, 0.013, 0.016];

/// The logarithm of the aliasing at the ramp's lower end.
const LEAST_LOG2: i32 = -3;

/// The colours of aliasing at successive powers of two, clamped at both ends.
const RAMP: [Colour; 10] = [
    [0.02, 0.04, 0.45],
    [0.03, 0.14, 0.75],
    [0.10, 0.42, 0.85],
    [0.75, 0.85, 0.80],
    [0.90, 0.75, 0.15],
    [0.95, 0.42, 0.03],
    [0.85, 0.14, 0.02],
    [0.62, 0.01, 0.10],
    [0.70, 0.05, 0.45],
    [0.95, 0.45, 0.90],
];

fn ramp(aliasing: f64) -> Colour {
    let step = (aliasing.log2() - f64::from(LEAST_LOG2)).clamp(0.0, RAMP.len() as f64 - 1.0);
    let lower = (step as usize).min(RAMP.len() - 2);
    mix(RAMP[lower], RAMP[lower + 1], (step - lower as f64) as f32)
}

/// The rendered map: near is light, far is dark, in every clip space.
///
/// `depths` are those of [`crate::verdict::DrawnMap`]; texels beyond their end count as empty.
#[must_use]
pub fn stored_map(map: &Layout, depths: &[f32]) -> RgbImage {
    let (size, reversed) = (map.settings().map_size(), map.settings().clip().depth.is_reversed());
    let mut depths: Vec<f32> = depths.iter().map(|&d| if reversed { 1.0 - d } else { d }).collect();
    depths.resize(size as usize * size as usize, 1.0);
    DepthMap { size, depths }.to_image()
}

/// Images from left to right, with a line between.
#[must_use]
pub fn side_by_side(maps: &[RgbImage]) -> RgbImage {
    const LINE: u32 = 2;
    let width: u32 = maps.iter().map(|map| map.width() + LINE).sum();
    let height = maps.iter().map(RgbImage::height).max().unwrap_or(0);
    let mut image = RgbImage::from_pixel(width.saturating_sub(LINE), height, Rgb(TEXT.map(encode)));
    let mut left = 0;
    for map in maps {
        image::imageops::replace(&mut image, map, left, 0);
        left += i64::from(map.width() + LINE);
    }
    image
}

/// A picture from a function of pixel index, row by row from the top, and height in the picture: 0 at the bottom, 1
/// at the top.
fn picture([width, height]: [u32; 2], colour: impl Fn(usize, f32) -> Colour) -> RgbImage {
    RgbImage::from_fn(width, height, |x, y| {
        let index = y as usize * width as usize + x as usize;
        Rgb(colour(index, 1.0 - (y as f32 + 0.5) / height as f32).map(encode))
    })
}

#[cfg(test)]
mod tests {
    use shadowfit::ClipSpace;

    use super::*;
    use crate::trace::{Faces, Tracer};
    use crate::verdict::fake::{self, Fake, SIZE, SUN};

    fn brightness(image: &RgbImage, index: usize) -> u32 {
        let [width, _] = SIZE;
        image.get_pixel(index as u32 % width, index as u32 / width).0.map(u32::from).iter().sum()
    }

    #[test]
    fn the_truth_is_bright_in_the_light_and_dark_in_shadow() {
        let mesh = fake::mesh();
        let tracer = Tracer::new(&mesh).expect("it has triangles");
        let (truth, lighting) = (fake::truth(&SUN, &tracer), Lighting::new(SUN, DVec3::ZERO));
        let image = shaded(&truth, &lighting, &mesh, &truth.lit());
        let all_lit = shaded(&truth, &lighting, &mesh, &vec![1.0; truth.pixels().len()]);
        for (index, pixel) in truth.pixels().iter().enumerate() {
            let [shown, lit] = [&image, &all_lit].map(|image| brightness(image, index));
            match pixel.compared() {
                Some((surface, false)) if surface.normal.y > 0.9 => {
                    assert!(3 * shown < 2 * lit, "{shown} and {lit}")
                }
                Some((_, false)) => assert!(shown <= lit),
                _ => assert_eq!(shown, lit, "shadows change nothing"),
            }
        }
    }

    #[test]
    fn marks_are_coloured_and_the_rest_is_grey() {
        let marks = [Mark::Right, Mark::FalseShadow, Mark::FalseLight, Mark::Missing, Mark::EdgeTexel, Mark::Sky];
        // High enough that the caption leaves the upper half alone.
        let white = RgbImage::from_pixel(marks.len() as u32, 60, Rgb([255; 3]));
        let image = difference(&white, &marks);
        let [ground, red, blue, magenta, amber, sky] = [0, 1, 2, 3, 4, 5].map(|x| image.get_pixel(x, 0).0);
        assert!(ground == sky && ground[0] == ground[1] && ground[1] == ground[2] && ground[0] < 128, "{ground:?}");
        assert!(red[0] > 200 && red[1] < 100 && red[2] < 100, "{red:?}");
        assert!(blue[2] > 200 && blue[0] < 100, "{blue:?}");
        assert!(magenta[0] > 200 && magenta[2] > 200 && magenta[1] < 50, "{magenta:?}");
        assert!(amber[0] > amber[1] && amber[1] > amber[2] && amber[0] < 180, "{amber:?}");
    }

    #[test]
    fn aliasing_goes_from_blue_over_pale_to_red() {
        let [fine, even, coarse] = [0.2, 1.0, 10.0].map(ramp);
        assert!(fine[2] > 2.0 * fine[0] && coarse[0] > 4.0 * coarse[2]);
        assert!(even.iter().all(|&c| c > 0.7));
        assert_eq!((ramp(0.01), ramp(f64::INFINITY)), (RAMP[0], RAMP[9]));

        let mesh = fake::mesh();
        let truth = fake::truth(&SUN, &Tracer::new(&mesh).expect("it has triangles"));
        let map = fake::fitted(&SUN, &fake::settings());
        let image = aliasing_map(&truth, |point| map.aliasing(point));
        // Above the caption.
        for (index, pixel) in truth.pixels().iter().enumerate().take(pixels_above_caption()) {
            let is_bright = brightness(&image, index) > 250;
            assert_eq!(is_bright, pixel.compared().is_some(), "pixel {index}");
        }
    }

    fn pixels_above_caption() -> usize {
        (SIZE[0] * (SIZE[1] - 30)) as usize
    }

    #[test]
    fn a_reversed_map_looks_like_any_other() {
        let mesh = fake::mesh();
        let tracer = Tracer::new(&mesh).expect("it has triangles");
        let image = |clip: ClipSpace| {
            let map = fake::fitted(&SUN, &fake::settings().with_clip(clip));
            let drawn = Fake { faces: Faces::All, ..Fake::default() }.draw(&map, &tracer);
            stored_map(&Layout::Frustum(map), &drawn)
        };
        let [forward, reversed] = [ClipSpace::WGPU, ClipSpace::WGPU.reversed()].map(image);
        let differs = |(a, b): (&Rgb<u8>, &Rgb<u8>)| a.0[0].abs_diff(b.0[0]) > 1;
        assert_eq!(forward.pixels().zip(reversed.pixels()).filter(|&pair| differs(pair)).count(), 0);
        assert!(forward.pixels().any(|texel| texel.0[0] > 200) && forward.pixels().any(|texel| texel.0[0] < 60));
    }
}
