//! Lines in space, drawn over a picture: solid where visible, faintly dashed where hidden.

use shadowfit::glam::{DVec2, DVec3, DVec4};

use super::canvas::{Canvas, Colour, mix};
use crate::trace::Lens;

/// Both ends of a line, in world space.
pub type Line = (DVec3, DVec3);

/// How lines are drawn.
#[derive(Clone, Copy, Debug)]
pub struct Pen {
    /// Linear RGB.
    pub colour: Colour,
    /// Half the width, in samples of the canvas.
    pub radius: f64,
    /// The opacity of visible parts, 0 to 1.
    pub opacity: f32,
    /// The opacity of hidden parts.
    pub hidden_opacity: f32,
}

impl Pen {
    /// A pen of this colour with default widths.
    #[must_use]
    pub const fn new(colour: Colour) -> Self {
        Self { colour, radius: 1.7, opacity: 1.0, hidden_opacity: 0.55 }
    }
}

/// The depth tolerance, in sample widths: lines that lie in a surface should be visible.
const DEPTH_SLACK: f64 = 2.0;

/// A dash of a hidden line and the gap after it, in samples.
const DASH: f64 = 7.0;

/// Draws lines over a canvas that shows the scene through `lens`.
pub fn draw_lines(canvas: &mut Canvas, lens: &Lens, lines: &[Line], pen: &Pen) {
    // Coverage is accumulated first, so that crossings are not painted twice.
    let mut ink = vec![0.0_f32; canvas.samples.len()];
    for line in lines {
        stroke(canvas, lens, line, pen, &mut ink);
    }
    for (sample, ink) in canvas.samples.iter_mut().zip(ink) {
        sample.colour = mix(sample.colour.map(|c| c.min(1.0)), pen.colour, ink);
    }
}

fn stroke(canvas: &Canvas, lens: &Lens, line: &Line, pen: &Pen, ink: &mut [f32]) {
    let Some((start, end)) = clip_to_picture(lens, line) else {
        return;
    };
    let size = DVec2::new(f64::from(canvas.width), f64::from(canvas.height));
    let to_samples = |ndc: DVec3| 0.5 * size * DVec2::new(ndc.x + 1.0, 1.0 - ndc.y);
    let length = (to_samples(end) - to_samples(start)).length();
    let steps = (2.0 * length).ceil().max(1.0);
    for step in 0..=steps as u32 {
        let along = f64::from(step) / steps;
        // After division by w straight lines are straight, and depth is linear along them.
        let ndc = start.lerp(end, along);
        let place = to_samples(ndc);
        let opacity = if is_hidden(canvas, lens, ndc, place, 2.0 / size) {
            let in_gap = (along * length).rem_euclid(2.0 * DASH) > DASH;
            if in_gap { continue } else { pen.hidden_opacity }
        } else {
            pen.opacity
        };
        stamp(canvas, ink, place, pen.radius, opacity);
    }
}

/// Clips a line to the lens, with a margin beyond the picture's edges; returns its ends in normalised device
/// coordinates.
fn clip_to_picture(lens: &Lens, line: &Line) -> Option<(DVec3, DVec3)> {
    const EDGE: f64 = 1.02;
    // Inside where the dot product is not negative. The first four together imply w ≥ 0. The near plane's slack
    // keeps lines that lie in it, as the near end of H does in its shadow map.
    const INSIDE: [DVec4; 5] = [
        DVec4::new(1.0, 0.0, 0.0, EDGE),
        DVec4::new(-1.0, 0.0, 0.0, EDGE),
        DVec4::new(0.0, 1.0, 0.0, EDGE),
        DVec4::new(0.0, -1.0, 0.0, EDGE),
        DVec4::new(0.0, 0.0, 1.0, 1e-6),
    ];
    let [start, end] = [line.0, line.1].map(|p| lens.clip_from_world() * p.extend(1.0));
    let (mut from, mut to) = (0.0_f64, 1.0_f64);
    for plane in INSIDE {
        let (a, b) = (plane.dot(start), plane.dot(end));
        match (a >= 0.0, b >= 0.0) {
            (true, true) => {}
            (false, false) => return None,
            (true, false) => to = to.min(a / (a - b)),
            (false, true) => from = from.max(a / (a - b)),
        }
    }
    if from > to {
        return None;
    }
    let [start, end] = [from, to].map(|t| start.lerp(end, t)).map(|clip| clip.truncate() / clip.w);
    (start.is_finite() && end.is_finite()).then_some((start, end))
}

/// Whether the point at `ndc` is hidden. Neighbouring samples are tested too: where a line lies in a surface seen
/// at a grazing angle, the next sample can be much nearer.
fn is_hidden(canvas: &Canvas, lens: &Lens, ndc: DVec3, place: DVec2, sample_extent: DVec2) -> bool {
    let (Some(point), Some(ray)) = (lens.unproject(ndc), lens.ray(ndc.truncate())) else {
        return false;
    };
    let distance = (point - ray.origin).dot(ray.direction);
    let sample_width = lens.unproject(ndc + DVec3::X * sample_extent.x).map_or(0.0, |next| next.distance(point));
    let mut farthest_shown = 0.0_f64;
    for_samples_around(canvas, place, 2.0, |index, _| {
        farthest_shown = farthest_shown.max(canvas.samples[index].distance);
    });
    distance > farthest_shown + DEPTH_SLACK * sample_width
}

fn stamp(canvas: &Canvas, ink: &mut [f32], place: DVec2, radius: f64, opacity: f32) {
    for_samples_around(canvas, place, radius + 1.0, |index, distance| {
        let coverage = (radius + 0.5 - distance).clamp(0.0, 1.0) as f32;
        ink[index] = ink[index].max(coverage * opacity);
    });
}

/// Visits the samples of a square around a position, with the index of each and its distance from the position.
fn for_samples_around(canvas: &Canvas, place: DVec2, reach: f64, mut visit: impl FnMut(usize, f64)) {
    let range =
        |centre: f64, size: u32| (centre - reach).max(0.0) as u32..((centre + reach).max(0.0) as u32 + 1).min(size);
    for y in range(place.y, canvas.height) {
        for x in range(place.x, canvas.width) {
            let centre = DVec2::new(f64::from(x), f64::from(y)) + 0.5;
            visit(canvas.index(x, y), centre.distance(place));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::Sample;

    fn lens() -> Lens {
        Lens::parallel(DVec3::ZERO, [DVec3::X, DVec3::Y, DVec3::NEG_Z], DVec2::ONE, 10.0).expect("sound")
    }

    fn canvas(distance: f64) -> Canvas {
        Canvas { width: 40, height: 40, samples: vec![Sample { colour: [0.0; 3], distance }; 1600] }
    }

    fn red_in_row(canvas: &Canvas, y: u32) -> usize {
        (0..40).filter(|&x| canvas.samples[canvas.index(x, y)].colour[0] > 0.9).count()
    }

    /// A horizontal line at depth 5 across the middle, reaching far out of the picture on both sides.
    const LINE: Line = (DVec3::new(-9.0, 0.0, -5.0), DVec3::new(9.0, 0.0, -5.0));

    #[test]
    fn a_line_in_sight_is_solid_from_edge_to_edge() {
        let mut canvas = canvas(f64::INFINITY);
        draw_lines(&mut canvas, &lens(), &[LINE], &Pen::new([1.0, 0.0, 0.0]));
        assert_eq!((red_in_row(&canvas, 20), red_in_row(&canvas, 30)), (40, 0));
    }

    #[test]
    fn a_hidden_line_is_fainter_and_dashed() {
        let mut canvas = canvas(4.0);
        draw_lines(&mut canvas, &lens(), &[LINE], &Pen::new([1.0, 0.0, 0.0]));
        let reds: Vec<f32> = (0..40).map(|x| canvas.samples[canvas.index(x, 20)].colour[0]).collect();
        assert!(reds.iter().all(|&red| red < 0.6) && reds.contains(&0.0) && reds.iter().any(|&red| red > 0.5));
    }

    #[test]
    fn a_line_in_a_surface_is_in_sight() {
        let mut canvas = canvas(5.0);
        draw_lines(&mut canvas, &lens(), &[LINE], &Pen::new([1.0, 0.0, 0.0]));
        assert_eq!(red_in_row(&canvas, 20), 40);
    }

    #[test]
    fn a_line_behind_the_eye_is_not_drawn() {
        let mut canvas = canvas(f64::INFINITY);
        let behind = (LINE.0 * DVec3::new(1.0, 1.0, -1.0), LINE.1 * DVec3::new(1.0, 1.0, -1.0));
        draw_lines(&mut canvas, &lens(), &[behind], &Pen::new([1.0, 0.0, 0.0]));
        assert_eq!(red_in_row(&canvas, 20), 0);
    }
}
