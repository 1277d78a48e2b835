//! The maps of one light, fitted as a renderer fits them: one for each part of the light that needs one.

use std::ops::Range;
use std::sync::Arc;

use anyhow::{Context, Result};
use serde::Serialize;
use shadowfit::glam::DVec3;
use shadowfit::{Body, CubeFace, Empty, Focus, Form, Light, Paraboloids, Plane, Settings, fit};

use crate::cut::{Cut, Cutting};
use crate::fitting::{NoMap, map_or_reason};
use crate::gpu::{MapDraw, MapPass, ShadowMaps};
use crate::layout::Layout;
use crate::run::Options;
use crate::scene::{Mesh, Object};
use crate::split::Split;
use crate::stage::Stage;

/// A map, and the casters that belong in it.
#[derive(Clone, Debug)]
pub struct FittedMap {
    /// The map.
    pub map: Layout,
    /// How it is drawn.
    pub pass: MapPass,
    /// The mesh's objects that are drawn into it, those that meet H.
    pub objects: Vec<usize>,
}

impl FittedMap {
    /// Fits a frustum as a renderer does and culls the casters against H; or says why there is no map.
    fn new(stage: &Stage<'_>, light: &Light, options: &Options) -> Result<Result<Self, NoMap>> {
        let focus = Focus::new(&stage.fitted_view, light, &stage.bounds);
        let map = match map_or_reason(focus.fit(&options.settings(stage)?)) {
            Ok(map) => Layout::Frustum(map),
            Err(none) => return Ok(Err(none)),
        };
        let objects = casters(stage, &focus.body(Form::Tight), |_| true);
        Ok(Ok(Self { map, pass: options.pass(&map)?, objects }))
    }
}

/// The objects that meet a body and are no others.
fn casters(stage: &Stage<'_>, body: &Body, is_other: impl Fn(&Object) -> bool) -> Vec<usize> {
    let objects = stage.tracer.mesh().objects.iter().enumerate();
    let meets = |object: &Object| body.meets_box(object.min, object.max) && is_other(object);
    objects.filter(|(_, object)| meets(object)).map(|(index, _)| index).collect()
}

/// Whether any of an object's box is before a plane, or behind it by no more than a distance.
fn is_before(plane: &Plane, behind: f64, object: &Object) -> bool {
    let farthest = DVec3::select(plane.normal.cmpgt(DVec3::ZERO), object.max, object.min);
    plane.at(farthest) >= -behind
}

/// The maps of a light.
#[derive(Clone, Debug)]
pub struct FittedMaps {
    /// Which map answers for which points.
    pub split: Split,
    /// The part of the light that each frustum is for; for paraboloids, the light.
    pub lights: Vec<Light>,
    /// One for each part of the split; `None` for a part that needs none.
    pub maps: Vec<Option<FittedMap>>,
    /// The casters as they are drawn into paraboloids, where they are cut.
    pub cut: Option<Arc<Cut>>,
}

/// What culling against H left to draw, over all maps.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Drawn {
    /// Objects drawn; those in several maps count in each.
    pub objects: usize,
    /// Objects there are.
    pub of_objects: usize,
    /// Triangles drawn, as they are cut; those in several maps count in each.
    pub triangles: usize,
    /// Triangles there are before any cut.
    pub of_triangles: usize,
    /// How long it took to cut them for paraboloids, in milliseconds; nothing where they are not cut.
    pub cut_ms: Option<f64>,
}

impl FittedMaps {
    /// Fits each part of the light; or says why there is no map at all.
    ///
    /// # Errors
    ///
    /// When the settings cannot be used, or casters cannot be cut.
    pub fn new(stage: &Stage<'_>, light: &Light, options: &Options) -> Result<Result<Self, NoMap>> {
        if options.technique.is_paraboloid() && light.position().is_some() {
            return Self::paraboloids(stage, light, options);
        }
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
        if maps.iter().all(Option::is_none) {
            return Ok(Err(reason));
        }
        Ok(Ok(Self::of(stage, split, lights, maps, options.cut)?))
    }

    fn paraboloids(stage: &Stage<'_>, light: &Light, options: &Options) -> Result<Result<Self, NoMap>> {
        let focus = Focus::new(&stage.fitted_view, light, &stage.bounds);
        let settings = options.settings(stage)?;
        let fitted = focus.paraboloids(&settings);
        let split = match &fitted {
            Paraboloids::Empty(empty) => return Ok(Err(NoMap::Empty(*empty))),
            Paraboloids::Two([map, _]) => Split::halves(map.position(), map.axis()),
            Paraboloids::One(_) | Paraboloids::Directional => Split::whole(),
        };
        let body = focus.body(Form::Tight);
        let (min, max) = stage.tracer.bounds();
        let mut maps = Vec::new();
        for map in fitted.maps() {
            let reach = (max - min).length() + map.far();
            // As far behind the light as the border shows.
            let square = f64::from(map.clip_scale().length_squared()) / 2.0;
            let behind = (1.0 - square) / (1.0 + square) * reach;
            let objects = casters(stage, &body, |object| is_before(&map.clip_plane(), behind, object));
            let map = Layout::Paraboloid(*map);
            maps.push(Some(FittedMap { map, pass: options.pass(&map)?, objects }));
        }
        Ok(Ok(Self::of(stage, split, vec![*light], maps, options.cut)?))
    }

    /// Of maps that were fitted before, one for each part of a split; cuts what is drawn into paraboloids.
    ///
    /// # Errors
    ///
    /// When casters cannot be cut, or the card has no room for them.
    pub fn of(
        stage: &Stage<'_>,
        split: Split,
        lights: Vec<Light>,
        maps: Vec<Option<FittedMap>>,
        cutting: Cutting,
    ) -> Result<Self> {
        let (mesh, origin) = (stage.tracer.mesh(), stage.geometry.origin());
        let mut is_drawn = vec![false; mesh.objects.len()];
        for &object in maps.iter().flatten().flat_map(|map| &map.objects) {
            is_drawn[object] = true;
        }
        // The other hemisphere's map bends edges alike.
        let cut = match maps.iter().flatten().next().map(|map| &map.map) {
            Some(Layout::Paraboloid(map)) => Cut::new(stage.gpu, origin, mesh, &is_drawn, map, cutting)?,
            _ => None,
        };
        Ok(Self { split, lights, maps, cut: cut.map(Arc::new) })
    }

    /// Fits all again, for the time that it takes; how many maps there are.
    #[must_use]
    pub fn fit_again(&self, stage: &Stage<'_>, settings: &Settings) -> usize {
        let is_paraboloid = self.maps.iter().flatten().any(|map| matches!(map.map, Layout::Paraboloid(_)));
        let maps = |light: &Light| {
            if is_paraboloid {
                Focus::new(&stage.fitted_view, light, &stage.bounds).paraboloids(settings).maps().len()
            } else {
                usize::from(fit(&stage.fitted_view, light, &stage.bounds, settings).map().is_some())
            }
        };
        self.lights.iter().map(maps).sum()
    }

    /// Draws the casters.
    ///
    /// # Errors
    ///
    /// When the card refuses.
    pub fn draw(&self, stage: &Stage<'_>) -> Result<ShadowMaps> {
        let casters: Vec<_> = self.maps.iter().flatten().map(|map| self.casters(stage, map)).collect();
        let mut casters = casters.iter();
        let draws: Vec<_> = self
            .maps
            .iter()
            .map(|map| {
                let FittedMap { map, pass, .. } = map.as_ref()?;
                Some(MapDraw { map: *map, casters: casters.next()?, pass: *pass })
            })
            .collect();
        let geometry = self.cut.as_ref().map_or(&stage.geometry, |cut| &cut.geometry);
        ShadowMaps::draw(stage.gpu, geometry, &self.split, &draws)
    }

    /// The triangles of what is drawn into a map.
    fn casters(&self, stage: &Stage<'_>, map: &FittedMap) -> Vec<Range<u32>> {
        let mesh = self.mesh(stage);
        map.objects.iter().map(|&object| mesh.objects[object].triangles.clone()).collect()
    }

    /// What is drawn of.
    fn mesh<'a>(&'a self, stage: &Stage<'a>) -> &'a Mesh {
        self.cut.as_ref().map_or(stage.tracer.mesh(), |cut| &cut.mesh)
    }

    /// What belongs in the maps.
    #[must_use]
    pub fn drawn(&self, stage: &Stage<'_>) -> Drawn {
        let casters = || self.maps.iter().flatten().flat_map(|map| self.casters(stage, map));
        Drawn {
            objects: casters().count(),
            of_objects: stage.tracer.mesh().objects.len(),
            triangles: casters().map(|triangles| triangles.len()).sum(),
            of_triangles: stage.tracer.mesh().triangles.len(),
            cut_ms: self.cut.as_ref().map(|cut| cut.time.as_secs_f64() * 1e3),
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
