//! What every pixel of the camera's picture ought to show: the surface there, and what the light does to it.

use anyhow::{Result, bail, ensure};
use rayon::prelude::*;
use shadowfit::View;

use super::share::share;
use super::source::{Illumination, Source};
use super::surface::{PixelRays, Surface};
use crate::gpu::Surfaces;
use crate::output::progress;
use crate::scene::LightSpec;
use crate::trace::Tracer;

/// What a pixel shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Truth {
    /// No surface.
    Sky,
    /// A point of a surface, and what the light does there.
    Seen(Surface, Illumination),
}

impl Truth {
    /// The point that is seen, if any.
    #[must_use]
    pub fn surface(&self) -> Option<&Surface> {
        match self {
            Self::Sky => None,
            Self::Seen(surface, _) => Some(surface),
        }
    }

    /// The point that is seen and whether the light reaches it, where a renderer must ask the map to know.
    #[must_use]
    pub fn compared(&self) -> Option<(&Surface, bool)> {
        match self {
            Self::Seen(surface, Illumination::Shadow) => Some((surface, false)),
            Self::Seen(surface, Illumination::Lit) => Some((surface, true)),
            Self::Sky | Self::Seen(_, Illumination::Unlit | Illumination::Either) => None,
        }
    }
}

/// The truth about one view and one light.
///
/// Surfaces are those that a renderer saw, so that what is compared is the shadow alone; where they are, and what the
/// light does there, is found in f64.
///
/// A point is in shadow where the ray from it to the light meets a triangle, from either side. The ray starts a hair off
/// the surface, along the face's normal on the side that is seen ([`Tracer::off_surface`]): no triangle casts a shadow
/// on itself, nor on another in the same plane. To a lamp the ray ends where the lamp's map begins, and what lies between
/// there and the lamp leaves it open which the point is.
#[derive(Clone, Debug)]
pub struct TruthImage {
    view: View,
    source: Source,
    size: [u32; 2],
    pixels: Vec<Truth>,
}

impl TruthImage {
    /// Traces a picture of `width` × `height` pixels.
    ///
    /// `triangles` says which triangle of the tracer's mesh the renderer saw at the middle of each pixel, row by row from
    /// the top, and [`Surfaces::SKY`] where it saw none. `lamp_near` is the distance from a lamp, in world units, at which its
    /// shadow map begins; a sun has none.
    ///
    /// # Errors
    ///
    /// When the numbers of pixels differ, when a triangle is none of the mesh's, or when the light or the view makes no
    /// sense.
    pub fn trace(
        view: &View,
        [width, height]: [u32; 2],
        triangles: &[u32],
        light: &LightSpec,
        lamp_near: f64,
        tracer: &Tracer,
    ) -> Result<Self> {
        let (mesh, count) = (tracer.mesh(), triangles.len());
        ensure!(
            count > 0 && count == width as usize * height as usize,
            "a picture of {width} x {height} pixels needs a triangle for each, not {count} of them"
        );
        let known = mesh.triangles.len();
        if let Some(unknown) = triangles.iter().find(|&&t| t != Surfaces::SKY && t as usize >= known) {
            bail!(
                "the renderer saw triangle {unknown} of a mesh that has {known}: it must draw the mesh that is traced"
            );
        }
        let source = Source::new(light, lamp_near)?;
        let rays = PixelRays::new(view, [width, height])?;
        let bar = progress::bar("the truth", height as usize);
        let mut pixels = vec![Truth::Sky; count];
        let rows = pixels.par_chunks_mut(width as usize).zip(triangles.par_chunks(width as usize));
        rows.enumerate().for_each(|(y, (pixels, triangles))| {
            for (x, (pixel, &triangle)) in pixels.iter_mut().zip(triangles).enumerate() {
                let ray = if triangle == Surfaces::SKY { None } else { rays.through(x as u32, y as u32) };
                if let Some(ray) = ray {
                    let surface = Surface::seen(mesh, triangle as usize, &ray);
                    *pixel = Truth::Seen(surface, illumination(&source, tracer, &surface));
                }
            }
            bar.inc(1);
        });
        bar.finish_and_clear();
        Ok(Self { view: *view, source, size: [width, height], pixels })
    }

    /// The view that was traced.
    #[must_use]
    pub fn view(&self) -> &View {
        &self.view
    }

    /// Pixels across and down.
    #[must_use]
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Row by row from the top.
    #[must_use]
    pub fn pixels(&self) -> &[Truth] {
        &self.pixels
    }

    /// How many pixels are compared.
    #[must_use]
    pub fn compared(&self) -> usize {
        self.pixels.iter().filter_map(Truth::compared).count()
    }

    /// The share of the compared pixels for which something is so, 0 to 1; `is_so` has an entry for each pixel.
    #[must_use]
    pub fn share(&self, is_so: &[bool]) -> f64 {
        let compared = self.pixels.iter().zip(is_so).filter(|(pixel, _)| pixel.compared().is_some());
        share(compared.filter(|&(_, &is_so)| is_so).count(), self.compared())
    }

    /// How many of them are in shadow.
    #[must_use]
    pub fn shadowed(&self) -> usize {
        self.pixels.iter().filter_map(Truth::compared).filter(|&(_, lit)| !lit).count()
    }

    /// The share of the light that arrives in each pixel, row by row from the top: 1 where the light reaches what is
    /// seen, else 0. It is what a perfect renderer would hand over.
    #[must_use]
    pub fn lit(&self) -> Vec<f32> {
        self.pixels
            .iter()
            .map(|pixel| if pixel.compared().is_some_and(|(_, lit)| lit) { 1.0 } else { 0.0 })
            .collect()
    }

    /// The light of the picture.
    pub(super) fn source(&self) -> &Source {
        &self.source
    }

    /// The up to eight pixels around the one at `index`.
    pub(super) fn around(&self, index: usize) -> impl Iterator<Item = &Truth> {
        neighbours(self.size, index).map(|neighbour| &self.pixels[neighbour])
    }
}

fn illumination(source: &Source, tracer: &Tracer, surface: &Surface) -> Illumination {
    if source.reaches(surface) {
        source.illumination(tracer, surface.point, surface.normal)
    } else {
        Illumination::Unlit
    }
}

/// The indices of the up to eight pixels around one, in a picture of `width` × `height` pixels stored row by row.
pub(super) fn neighbours([width, height]: [u32; 2], index: usize) -> impl Iterator<Item = usize> {
    let (width, height) = (width as usize, height as usize);
    let (x, y) = (index % width, index / width);
    let span = |at: usize, count: usize| at.saturating_sub(1)..(at + 2).min(count);
    span(y, height).flat_map(move |y| span(x, width).map(move |x| y * width + x)).filter(move |&i| i != index)
}
