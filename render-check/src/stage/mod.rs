//! One camera in one scene: what all lights and techniques share.

mod extent;
mod framing;

use anyhow::Result;
use shadowfit::glam::DVec3;
use shadowfit::input::{DAabb, DepthRange};
use shadowfit::seen::Seen;
use shadowfit::{Focus, Light, Origin, Scene, Settings, View, cascades::Cascades};

pub use extent::{lamp_near, least_lamp_near, scene_box};
pub use framing::{CameraRequest, choose_camera, choose_view};

use crate::gpu::{Geometry, Gpu, Surfaces};
use crate::maps::{self, Cuts};
use crate::scene::LightSpec;
use crate::trace::Tracer;
use crate::verdict::TruthImage;

/// A camera in a scene, with its visible surfaces.
pub struct Stage<'a> {
    /// The GPU.
    pub gpu: &'a Gpu,
    /// The scene, for rays.
    pub tracer: &'a Tracer<'a>,
    /// The scene's box, S.
    pub bounds: Scene<'static>,
    /// The camera, V.
    pub view: View,
    /// The view that maps are fitted to: the camera's, or narrowed to the depth range of its visible surfaces.
    pub fitted_view: View,
    /// The visible surfaces, as the camera's depth buffer shows them.
    pub seen: Seen<'static>,
    /// Whether maps are fitted to them.
    pub fits_seen: bool,
    /// Width and height of its image, in pixels.
    pub size: [u32; 2],
    /// The origin of the maps' matrices.
    pub origin: Origin,
    /// The casters' geometry on the GPU, relative to that origin.
    pub geometry: Geometry,
    /// The visible surfaces.
    pub surfaces: Surfaces,
    /// The near plane of local lights, in world units, if given.
    lamp_near: Option<f64>,
}

impl<'a> Stage<'a> {
    /// Draws the camera pass.
    ///
    /// # Errors
    ///
    /// When the scene is too large for the fit or for the GPU.
    pub fn new(gpu: &'a Gpu, tracer: &'a Tracer<'a>, view: &View, size: [u32; 2]) -> Result<Self> {
        let geometry = Geometry::upload(gpu, tracer.mesh(), view.eye())?;
        let surfaces = Surfaces::draw(gpu, &geometry, view, size)?;
        let bounds = scene_box(tracer.mesh())?;
        let origin = Origin::Eye;
        // Few, and as long-lived as the stages that share them.
        let tiles = surfaces.depth_tiles(gpu, surfaces.tile())?.leak();
        let seen = Seen::from_tiles(view, DepthRange::ZeroToOneReversed, size, surfaces.tile(), tiles)?;
        Ok(Self {
            gpu,
            tracer,
            bounds,
            view: *view,
            fitted_view: *view,
            seen,
            fits_seen: false,
            size,
            origin,
            geometry,
            surfaces,
            lamp_near: None,
        })
    }

    /// The same with maps, casters and receivers in world space, rounded to f32. The camera pass is unaffected.
    ///
    /// # Errors
    ///
    /// When the GPU reports an error.
    pub fn in_world_space(self) -> Result<Self> {
        let surfaces = Surfaces::draw_about(self.gpu, &self.geometry, &self.view, self.size, DVec3::ZERO)?;
        let geometry = Geometry::upload(self.gpu, self.tracer.mesh(), DVec3::ZERO)?;
        Ok(Self { origin: Origin::World, geometry, surfaces, ..self })
    }

    /// The same with maps fitted to the depth range of the visible surfaces, read back from the GPU.
    ///
    /// # Errors
    ///
    /// When the GPU reports an error.
    pub fn narrowed(self) -> Result<Self> {
        Ok(Self { fitted_view: self.surfaces.narrowed(self.gpu, &self.view)?, ..self })
    }

    /// The same with a box for each object instead of one for all.
    ///
    /// # Errors
    ///
    /// When an object is too large for the fit.
    pub fn with_boxes(self) -> Result<Self> {
        let objects = self.tracer.mesh().objects.iter();
        let boxes: Vec<DAabb> = objects.map(|object| DAabb { min: object.min, max: object.max }).collect();
        let boxes: &'static [DAabb] = boxes.leak();
        Ok(Self { bounds: Scene::new(boxes, boxes)?, ..self })
    }

    /// The same with maps fitted to the visible surfaces.
    #[must_use]
    pub fn seeing(self) -> Self {
        Self { fits_seen: true, ..self }
    }

    /// The focus of a light.
    #[must_use]
    pub fn focus(&self, light: &Light) -> Focus<'static> {
        let focus = Focus::new(&self.fitted_view, light, &self.bounds);
        if self.fits_seen { focus.with_seen(&self.seen) } else { focus }
    }

    /// The cascades of a light, for maps of these settings.
    ///
    /// # Errors
    ///
    /// For stabilised cascades of a view with an infinite far plane.
    pub fn cascades(&self, light: &Light, cuts: Cuts, settings: &Settings) -> Result<Cascades<'static>> {
        let cascades = maps::cascades(&self.fitted_view, light, &self.bounds, cuts, &self.seen, settings)?;
        Ok(if self.fits_seen { cascades.with_seen(&self.seen) } else { cascades })
    }

    /// The same with another near plane for local lights, if one is given.
    #[must_use]
    pub fn with_lamp_near(self, lamp_near: Option<f64>) -> Self {
        Self { lamp_near, ..self }
    }

    /// The near plane of a local light, in world units; [`lamp_near`] by default.
    #[must_use]
    pub fn lamp_near(&self, spec: &LightSpec) -> f64 {
        self.lamp_near.unwrap_or_else(|| lamp_near(self.tracer, spec))
    }

    /// A light for the fit, with its ray-traced truth.
    ///
    /// # Errors
    ///
    /// When the light is invalid.
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
    /// The light, as given.
    pub spec: LightSpec,
    /// The light, for the fit.
    pub light: Light,
    /// The truth about every pixel.
    pub truth: TruthImage,
}
