//! The camera's view of the scene, with the caster volume H drawn over it.

use image::RgbImage;
use shadowfit::View;

use anyhow::Result;

use super::canvas::{BODY_COLOUR, Canvas, Sample, encode};
use super::lines::{Line, Pen, draw_lines};
use super::shade::{Lighting, background};
use super::text;
use crate::output::progress;
use crate::trace::{Lens, Tracer};

/// Ray-casts the camera's picture, lit and shadowed by one light, and draws the edges of H over it.
///
/// # Errors
///
/// When the view's matrix has no inverse.
pub fn camera_view(
    view: &View,
    lighting: &Lighting,
    tracer: &Tracer,
    body: &[Line],
    [width, height]: [u32; 2],
) -> Result<RgbImage> {
    let lens = Lens::of_view(view)?;
    let bar = progress::bar("the camera's view", 0);
    let mut canvas = Canvas::render(width, height, &bar, |x, y, width, height| {
        let seen = lens.ray_through_pixel(x, y, width, height).and_then(|ray| Some((ray, tracer.first_hit(&ray)?)));
        match seen {
            Some((ray, hit)) => Sample { colour: lighting.shade(tracer, &hit, &ray), distance: hit.distance },
            None => Sample { colour: background(1.0 - y as f32 / height as f32), distance: f64::INFINITY },
        }
    });
    draw_lines(&mut canvas, &lens, body, &Pen::new(BODY_COLOUR));
    let mut image = canvas.to_image();
    let colour = image::Rgb(BODY_COLOUR.map(encode));
    text::caption(&mut image, &[("H, dashed where hidden", colour)]);
    Ok(image)
}
