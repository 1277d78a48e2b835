//! The maps of one light, fitted as a renderer fits them: one for each part of the light that needs one.

use std::ops::Range;

use anyhow::{Context, Result};
use serde::Serialize;
use shadowfit::glam::DVec3;
use shadowfit::{CubeFace, Empty, Focus, Form, Light, Map};

use crate::fitting::{NoMap, map_or_reason};
use crate::gpu::{MapDraw, MapPass, ShadowMaps};
use crate::run::Options;
use crate::scene::Mesh;
use crate::split::Split;
use crate::stage::Stage;
use crate::verdict::{Frustum, Projection};

/// A map, and the casters that belong in it.
#[derive(Clone, Debug)]
pub struct FittedMap {
    /// The map.
    pub map: Map,
    /// How it is drawn.
    pub pass: MapPass,
    /// The objects that meet H, as indices into those of the mesh.
    pub objects: Vec<usize>,
}

impl FittedMap {
    /// Fits a map as a renderer does and culls the casters against H; or says why there is no map.
    fn new(stage: &Stage<'_>, light: &Light, options: &Options) -> Result<Result<Self, NoMap>> {
        let focus = Focus::new(&stage.fitted_view, light, &stage.bounds);
        let map = match map_or_reason(focus.fit(&options.settings(stage.size[1])?)) {
            Ok(map) => map,
            Err(none) => return Ok(Err(none)),
        };
        let body = focus.body(Form::Tight);
        let objects = &stage.tracer.mesh().objects;
        let meets = |&object: &usize| body.meets_box(objects[object].min, objects[object].max);
        let objects = (0..objects.len()).filter(meets).collect();
        Ok(Ok(Self { map, pass: options.pass(&map)?, objects }))
    }

    /// How it lays out the world, fitted to a view with its eye there.
    #[must_use]
    pub fn projection(&self, eye: DVec3) -> Box<dyn Projection> {
        Box::new(Frustum::new(&self.map, eye))
    }

    fn casters(&self, mesh: &Mesh) -> Vec<Range<u32>> {
        self.objects.iter().map(|&object| mesh.objects[object].triangles.clone()).collect()
    }
}

/// The maps of a light.
#[derive(Clone, Debug)]
pub struct FittedMaps {
    /// Which map answers for which points.
    pub split: Split,
    /// The part of the light that each is for.
    pub lights: Vec<Light>,
    /// One for each part of the split; `None` for a part that needs none.
    pub maps: Vec<Option<FittedMap>>,
}

/// What culling against H left to draw, over all maps.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Drawn {
    /// Objects drawn; those in several maps count in each.
    pub objects: usize,
    /// Objects there are.
    pub of_objects: usize,
    /// Triangles drawn; those in several maps count in each.
    pub triangles: usize,
    /// Triangles there are.
    pub of_triangles: usize,
}

impl FittedMaps {
    /// Fits each part of the light; or says why there is no map at all.
    ///
    /// # Errors
    ///
    /// When the settings cannot be used.
    pub fn new(stage: &Stage<'_>, light: &Light, options: &Options) -> Result<Result<Self, NoMap>> {
        let (split, lights) = parts(light, options)?;
        let mut maps = Vec::new();
        let mut reason = NoMap::Empty(Empty::NothingVisible);
        for light in &lights {
            match FittedMap::new(stage, light, options)? {
                Ok(map) => maps.push(Some(map)),
                Err(none @ NoMap::Surrounded(_)) => return Ok(Err(none)),
                Err(none) => {
                    // Where one part has something to shade, nothing casts on it is what the light as a whole says.
                    if none == NoMap::Empty(Empty::NothingCasts) {
                        reason = none;
                    }
                    maps.push(None);
                }
            }
        }
        let has_map = maps.iter().any(Option::is_some);
        Ok(if has_map { Ok(Self { split, lights, maps }) } else { Err(reason) })
    }

    /// Draws the casters.
    ///
    /// # Errors
    ///
    /// When the card refuses.
    pub fn draw(&self, stage: &Stage<'_>) -> Result<ShadowMaps> {
        let mesh = stage.tracer.mesh();
        let casters: Vec<_> = self.maps.iter().map(|map| map.as_ref().map(|map| map.casters(mesh))).collect();
        let with_casters = self.maps.iter().zip(&casters).map(|(map, casters)| map.as_ref().zip(casters.as_ref()));
        let draws: Vec<_> = with_casters
            .map(|both| both.map(|(map, casters)| MapDraw { map: &map.map, casters, pass: map.pass }))
            .collect();
        ShadowMaps::draw(stage.gpu, &stage.geometry, &self.split, &draws)
    }

    /// What belongs in the maps.
    #[must_use]
    pub fn drawn(&self, mesh: &Mesh) -> Drawn {
        let casters = || self.maps.iter().flatten().flat_map(|map| map.casters(mesh));
        Drawn {
            objects: casters().count(),
            of_objects: mesh.objects.len(),
            triangles: casters().map(|triangles| triangles.len()).sum(),
            of_triangles: mesh.triangles.len(),
        }
    }
}

/// The parts of a light that have a map each, and which points belong to which. A light that needs no cube around it, a
/// sun or a spot, has one map whatever the technique.
fn parts(light: &Light, options: &Options) -> Result<(Split, Vec<Light>)> {
    let overlap = CubeFace::overlap(options.filter.reach(), options.map_size, options.border());
    match light.position() {
        Some(position) if options.technique.has_faces() && light.cube_face(CubeFace::PositiveX, 0.0).is_ok() => {
            let faces = CubeFace::ALL.map(|face| light.cube_face(face, overlap));
            let lights = faces.into_iter().collect::<Result<_, _>>().context("the light has no faces")?;
            Ok((Split::cube(position), lights))
        }
        _ => Ok((Split::whole(), vec![*light])),
    }
}
