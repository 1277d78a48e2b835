//! One camera before one scene: what all lights and all techniques share.

mod extent;
mod framing;

use anyhow::Result;
use shadowfit::glam::DVec3;
use shadowfit::{Light, Origin, Scene, View};

pub use extent::{lamp_near, least_lamp_near, scene_box};
pub use framing::{CameraRequest, choose_camera, choose_view};

use crate::gpu::{Geometry, Gpu, Surfaces};
use crate::scene::LightSpec;
use crate::trace::Tracer;
use crate::verdict::TruthImage;

/// A camera before a scene, drawn.
pub struct Stage<'a> {
    /// The card that draws.
    pub gpu: &'a Gpu,
    /// The scene, as rays meet it.
    pub tracer: &'a Tracer<'a>,
    /// The scene's box, S.
    pub bounds: Scene<'static>,
    /// The camera, V.
    pub view: View,
    /// What maps are fitted to: the camera, or what of its depth something is seen in.
    pub fitted_view: View,
    /// Width and height of its image, in pixels.
    pub size: [u32; 2],
    /// What the maps' matrices take positions relative to.
    pub origin: Origin,
    /// The triangles on the card that maps are drawn of, relative to that.
    pub geometry: Geometry,
    /// What the camera sees.
    pub surfaces: Surfaces,
    /// The distance from lamps at which their maps begin, in world units, where somebody says.
    lamp_near: Option<f64>,
}

impl<'a> Stage<'a> {
    /// Draws what the camera sees.
    ///
    /// # Errors
    ///
    /// When the scene is too large for the fit or for the card.
    pub fn new(gpu: &'a Gpu, tracer: &'a Tracer<'a>, view: &View, size: [u32; 2]) -> Result<Self> {
        let geometry = Geometry::upload(gpu, tracer.mesh(), view.eye())?;
        let surfaces = Surfaces::draw(gpu, &geometry, view, size)?;
        let bounds = scene_box(tracer.mesh())?;
        let origin = Origin::Eye;
        Ok(Self {
            gpu,
            tracer,
            bounds,
            view: *view,
            fitted_view: *view,
            size,
            origin,
            geometry,
            surfaces,
            lamp_near: None,
        })
    }

    /// The same with maps of positions in world space, as f32 has them there. What the camera sees stays what it is.
    ///
    /// # Errors
    ///
    /// When the card refuses.
    pub fn in_world_space(self) -> Result<Self> {
        let surfaces = Surfaces::draw_about(self.gpu, &self.geometry, &self.view, self.size, DVec3::ZERO)?;
        let geometry = Geometry::upload(self.gpu, self.tracer.mesh(), DVec3::ZERO)?;
        Ok(Self { origin: Origin::World, geometry, surfaces, ..self })
    }

    /// The same with maps that are fitted to what of the camera's depth something is seen in, read back from the card.
    ///
    /// # Errors
    ///
    /// When the card refuses.
    pub fn narrowed(self) -> Result<Self> {
        Ok(Self { fitted_view: self.surfaces.narrowed(self.gpu, &self.view)?, ..self })
    }

    /// The same with lamps whose maps begin at another distance, if one is given.
    #[must_use]
    pub fn with_lamp_near(self, lamp_near: Option<f64>) -> Self {
        Self { lamp_near, ..self }
    }

    /// The distance from a lamp at which its map begins, in world units; see [`lamp_near`] where nobody says.
    #[must_use]
    pub fn lamp_near(&self, spec: &LightSpec) -> f64 {
        self.lamp_near.unwrap_or_else(|| lamp_near(self.tracer, spec))
    }

    /// A light, as the fit takes it and as rays see it from here.
    ///
    /// # Errors
    ///
    /// When the light makes no sense.
    pub fn light(&self, spec: LightSpec) -> Result<StageLight> {
        let near = self.lamp_near(&spec);
        let light = spec.to_light(near)?;
        let triangles = &self.surfaces.triangles;
        let truth = TruthImage::trace(&self.view, self.size, triangles, &spec, near, self.tracer)?;
        Ok(StageLight { spec, light, truth })
    }
}

/// A light on a stage.
pub struct StageLight {
    /// As it was written.
    pub spec: LightSpec,
    /// As the fit takes it.
    pub light: Light,
    /// What rays say of every pixel.
    pub truth: TruthImage,
}
