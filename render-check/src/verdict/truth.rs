//! The truth about every pixel of the camera's image: its surface point, and whether the light reaches it.

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

/// The truth about a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Truth {
    /// No surface.
    Sky,
    /// A visible surface point, and how the light reaches it.
    Seen(Surface, Illumination),
}

impl Truth {
    /// The visible surface point, if any.
    #[must_use]
    pub fn surface(&self) -> Option<&Surface> {
        match self {
            Self::Sky => None,
            Self::Seen(surface, _) => Some(surface),
        }
    }

    /// The visible surface point and whether it is lit, where that depends on shadows; `None` for pixels that are
    /// not compared.
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
/// The visible triangles are the renderer's, so that only shadows are compared; surface points and shadows are
/// computed in f64.
///
/// A point is in shadow where the ray from it to the light hits a triangle, front or back. The ray starts slightly
/// off the surface, along the face's normal on the visible side ([`Tracer::off_surface`]), so that no triangle
/// shadows itself or a coplanar one. For a local light the ray ends at its near plane; points blocked only beyond
/// that are not compared ([`Illumination::Either`]).
#[derive(Clone, Debug)]
pub struct TruthImage {
    view: View,
    source: Source,
    size: [u32; 2],
    pixels: Vec<Truth>,
}

impl TruthImage {
    /// Traces an image of `width` × `height` pixels.
    ///
    /// `triangles` holds the index of the visible triangle at the centre of each pixel, row by row from the top,
    /// and [`Surfaces::SKY`] where there is none. `lamp_near` is the near plane of a local light, in world units; a
    /// sun has none.
    ///
    /// # Errors
    ///
    /// When the numbers of pixels differ, a triangle is not one of the mesh, or light or view are invalid.
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

    /// The number of compared pixels.
    #[must_use]
    pub fn compared(&self) -> usize {
        self.pixels.iter().filter_map(Truth::compared).count()
    }

    /// The fraction of compared pixels for which `is_so` is true, 0 to 1; it has an entry for each pixel.
    #[must_use]
    pub fn share(&self, is_so: &[bool]) -> f64 {
        let compared = self.pixels.iter().zip(is_so).filter(|(pixel, _)| pixel.compared().is_some());
        share(compared.filter(|&(_, &is_so)| is_so).count(), self.compared())
    }

    /// The number of compared pixels in shadow.
    #[must_use]
    pub fn shadowed(&self) -> usize {
        self.pixels.iter().filter_map(Truth::compared).filter(|&(_, lit)| !lit).count()
    }

    /// The true lit fraction of each pixel, row by row from the top: 1 where the surface is lit, else 0.
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

    /// The up to eight neighbours of the pixel at `index`.
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

/// The indices of a pixel's up to eight neighbours, in an image of `width` × `height` pixels stored row by row.
pub(super) fn neighbours([width, height]: [u32; 2], index: usize) -> impl Iterator<Item = usize> {
    let (width, height) = (width as usize, height as usize);
    let (x, y) = (index % width, index / width);
    let span = |at: usize, count: usize| at.saturating_sub(1)..(at + 2).min(count);
    span(y, height).flat_map(move |y| span(x, width).map(move |x| y * width + x)).filter(move |&i| i != index)
}
