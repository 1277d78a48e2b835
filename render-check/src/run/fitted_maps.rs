//! The maps of one light, fitted as in a renderer: one for each part of the light that needs one.

use std::ops::Range;
use std::sync::Arc;

use anyhow::{Context, Result, ensure};
use serde::Serialize;
use shadowfit::glam::DVec3;
use shadowfit::{
    Empty, Focus, FocusForm, Light, Outcome, Settings, ShadowMap,
    depth::DepthBias,
    focus::{ConvexBody, Plane},
    omni::{CubeFace, Paraboloids},
};

use super::cut::{Cut, Cutting};
use super::options::Options;
use crate::gpu::{Geometry, MapDraw, MapPass, ShadowMaps};
use crate::maps::{Layout, NoMap, Split, map_or_reason};
use crate::scene::{Mesh, Object};
use crate::stage::Stage;

/// A map with its casters.
#[derive(Clone, Debug)]
pub struct FittedMap {
    /// The map.
    pub map: Layout,
    /// How it is drawn.
    pub pass: MapPass,
    /// The bias of the pass, where it is the one derived from the map.
    pub bias: Option<DepthBias>,
    /// The objects drawn into it: those that intersect H.
    pub objects: Vec<usize>,
}

impl FittedMap {
    /// A map that is drawn with these options.
    ///
    /// # Errors
    ///
    /// When the filter's reach is invalid.
    pub fn of(map: Layout, options: &Options, objects: Vec<usize>) -> Result<Self> {
        let (pass, bias) = (options.pass(&map)?, options.derived_bias(&map)?);
        Ok(Self { map, pass, bias, objects })
    }

    /// Fits a frustum, warm-started from the previous frame's map if there is one, and culls the casters against H;
    /// or returns the reason for no map.
    fn new(
        stage: &Stage<'_>,
        focus: &Focus<'_>,
        options: &Options,
        before: Option<&ShadowMap>,
    ) -> Result<Result<Self, NoMap>> {
        let map = match map_or_reason(fitted(focus, before, &options.settings(stage)?)) {
            Ok(map) => Layout::Frustum(map),
            Err(none) => return Ok(Err(none)),
        };
        let objects = casters(stage, &focus.caster_volume(FocusForm::ReceiverHull), |_| true);
        Ok(Ok(Self::of(map, options, objects)?))
    }
}

/// Fits a frustum, warm-started from the previous frame's map if there is one.
fn fitted(focus: &Focus<'_>, before: Option<&ShadowMap>, settings: &Settings) -> Outcome {
    before.map_or_else(|| focus.fit(settings), |before| focus.fit_warm(before, settings))
}

/// The objects that intersect a convex body and pass a filter.
fn casters(stage: &Stage<'_>, body: &ConvexBody, is_other: impl Fn(&Object) -> bool) -> Vec<usize> {
    let objects = stage.tracer.mesh().objects.iter().enumerate();
    let meets = |object: &Object| body.intersects_aabb(object.min, object.max) && is_other(object);
    objects.filter(|(_, object)| meets(object)).map(|(index, _)| index).collect()
}

/// Whether any part of an object's box is in front of a plane, or at most `behind` behind it.
fn is_before(plane: &Plane, behind: f64, object: &Object) -> bool {
    let farthest = DVec3::select(plane.normal.cmpgt(DVec3::ZERO), object.max, object.min);
    plane.at(farthest) >= -behind
}

/// The maps of a light.
#[derive(Clone, Debug)]
pub struct FittedMaps {
    /// Which map covers which points.
    pub split: Split,
    /// The light of each frustum, such as a cube face; for paraboloids and cascades, the light itself.
    pub lights: Vec<Light>,
    /// One map for each part of the split; `None` for a part that needs none.
    pub maps: Vec<Option<FittedMap>>,
    /// The tessellated casters of paraboloids, if any.
    pub cut: Option<Arc<Cut>>,
}

/// The casters left by culling against H, over all maps.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Drawn {
    /// Objects drawn; an object in several maps counts in each.
    pub objects: usize,
    /// Objects in the scene.
    pub of_objects: usize,
    /// Triangles drawn, after tessellation; a triangle in several maps counts in each.
    pub triangles: usize,
    /// Triangles in the scene, before tessellation.
    pub of_triangles: usize,
    /// The time of tessellation, in milliseconds; `None` without tessellation.
    pub cut_ms: Option<f64>,
}

impl FittedMaps {
    /// Fits each part of the light; or returns the reason for no map at all.
    ///
    /// # Errors
    ///
    /// When the settings are invalid, or casters cannot be tessellated.
    pub fn new(stage: &Stage<'_>, light: &Light, options: &Options) -> Result<Result<Self, NoMap>> {
        Self::after(None, stage, light, options)
    }

    /// The same, warm-started from the previous frame's maps if there are any.
    ///
    /// # Errors
    ///
    /// As [`Self::new`].
    pub fn after(
        before: Option<&Self>,
        stage: &Stage<'_>,
        light: &Light,
        options: &Options,
    ) -> Result<Result<Self, NoMap>> {
        let is_paraboloid = options.technique.is_paraboloid();
        ensure!(
            options.cascading.is_none() || !(is_paraboloid || options.technique.has_faces()),
            "cascades have a frustum each: '{}' takes no --cascades",
            options.technique
        );
        if is_paraboloid && light.position().is_some() {
            return Self::paraboloids(stage, light, options);
        }
        let (split, lights) = parts(stage, light, options)?;
        let mut maps = Vec::new();
        let mut reason = NoMap::Empty(Empty::NoReceivers);
        for (part, focus) in foci(stage, &split, &lights).iter().enumerate() {
            match FittedMap::new(stage, focus, options, before.and_then(|before| before.frustum(part)))? {
                Ok(map) => maps.push(Some(map)),
                Err(none @ NoMap::Surrounded(_)) => return Ok(Err(none)),
                Err(none) => {
                    // If any part has receivers, the light as a whole lacks casters, not receivers.
                    if none == NoMap::Empty(Empty::NoCasters) {
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
        let focus = stage.focus(light);
        let settings = options.settings(stage)?;
        let fitted = focus.paraboloids(&settings);
        let split = match &fitted {
            Paraboloids::Empty(empty) => return Ok(Err(NoMap::Empty(*empty))),
            Paraboloids::Two([map, _]) => Split::halves(map.position(), map.axis()),
            Paraboloids::One(_) | Paraboloids::Directional => Split::whole(),
        };
        let body = focus.caster_volume(FocusForm::ReceiverHull);
        let (min, max) = stage.tracer.bounds();
        let mut maps = Vec::new();
        for map in fitted.maps() {
            let reach = (max - min).length() + map.far();
            // As far behind the light as the map's border covers.
            let square = f64::from(map.clip_scale().length_squared()) / 2.0;
            let behind = (1.0 - square) / (1.0 + square) * reach;
            let objects = casters(stage, &body, |object| is_before(&map.clip_plane(), behind, object));
            maps.push(Some(FittedMap::of(Layout::Paraboloid(map.clone()), options, objects)?));
        }
        Ok(Ok(Self::of(stage, split, vec![*light], maps, options.cut)?))
    }

    /// Takes fitted maps, one for each part of a split, and tessellates the casters of paraboloids.
    ///
    /// # Errors
    ///
    /// When casters cannot be tessellated, or do not fit into GPU memory.
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
        // The other hemisphere's map bends edges in the same way.
        let cut = match maps.iter().flatten().next().map(|map| &map.map) {
            Some(Layout::Paraboloid(map)) => Cut::new(stage.gpu, origin, mesh, &is_drawn, map, cutting)?,
            _ => None,
        };
        Ok(Self { split, lights, maps, cut: cut.map(Arc::new) })
    }

    /// The frustum map of a part, if it has one.
    #[must_use]
    pub fn frustum(&self, part: usize) -> Option<&ShadowMap> {
        match &self.maps.get(part)?.as_ref()?.map {
            Layout::Frustum(map) => Some(map),
            Layout::Paraboloid(_) => None,
        }
    }

    /// Whether any of the warm-started maps jumped, see [`ShadowMap::jumped`].
    #[must_use]
    pub fn jumped(&self) -> bool {
        (0..self.maps.len()).filter_map(|part| self.frustum(part)).any(ShadowMap::jumped)
    }

    /// The focus of each part's map; for paraboloids one focus for both.
    #[must_use]
    pub fn foci(&self, stage: &Stage<'_>) -> Vec<Focus<'static>> {
        foci(stage, &self.split, &self.lights)
    }

    /// Fits all maps again, warm-started from the previous frame's if there are any, to be timed; returns the
    /// number of maps.
    #[must_use]
    pub fn fit_again(&self, before: Option<&Self>, stage: &Stage<'_>, settings: &Settings) -> usize {
        let is_paraboloid = self.maps.iter().flatten().any(|map| matches!(map.map, Layout::Paraboloid(_)));
        let maps = |part: usize, focus: &Focus<'_>| {
            if is_paraboloid {
                focus.paraboloids(settings).maps().len()
            } else {
                let before = before.and_then(|before| before.frustum(part));
                usize::from(fitted(focus, before, settings).map().is_some())
            }
        };
        if let (Split::Depths { cuts, .. }, [light]) = (&self.split, &self.lights[..]) {
            return stage.cascades(light, *cuts, settings).map_or(0, |cascades| {
                (0..).zip(cascades.iter()).map(|(part, cascade)| maps(part, &cascade.focus)).sum()
            });
        }
        let of_light = |(part, light)| maps(part, &stage.focus(light));
        self.lights.iter().enumerate().map(of_light).sum()
    }

    /// Draws the casters.
    ///
    /// # Errors
    ///
    /// When the GPU reports an error.
    pub fn draw(&self, stage: &Stage<'_>) -> Result<ShadowMaps> {
        let casters = self.casters_of_all(stage);
        ShadowMaps::draw(stage.gpu, self.geometry(stage), &self.split, &self.draws(&casters))
    }

    /// Draws the casters again, where they were drawn before.
    ///
    /// # Errors
    ///
    /// When the GPU reports an error.
    pub fn draw_again(&self, stage: &Stage<'_>, shadow_maps: &mut ShadowMaps) -> Result<()> {
        let casters = self.casters_of_all(stage);
        shadow_maps.draw_again(stage.gpu, self.geometry(stage), &self.draws(&casters))
    }

    /// The draw parameters of each part.
    fn draws<'a>(&'a self, casters: &'a [Vec<Range<u32>>]) -> Vec<Option<MapDraw<'a>>> {
        let of = |(map, casters): (&'a Option<FittedMap>, &'a Vec<_>)| {
            map.as_ref().map(|FittedMap { map, pass, .. }| MapDraw { map, casters, pass: *pass })
        };
        self.maps.iter().zip(casters).map(of).collect()
    }

    /// The casters' triangles of each part.
    fn casters_of_all(&self, stage: &Stage<'_>) -> Vec<Vec<Range<u32>>> {
        let of = |map: &Option<FittedMap>| map.as_ref().map(|map| self.casters(stage, map)).unwrap_or_default();
        self.maps.iter().map(of).collect()
    }

    /// The casters' geometry on the GPU.
    fn geometry<'a>(&'a self, stage: &'a Stage<'a>) -> &'a Geometry {
        self.cut.as_ref().map_or(&stage.geometry, |cut| &cut.geometry)
    }

    /// The casters' triangles of a map.
    fn casters(&self, stage: &Stage<'_>, map: &FittedMap) -> Vec<Range<u32>> {
        let mesh = self.mesh(stage);
        map.objects.iter().map(|&object| mesh.objects[object].triangles.clone()).collect()
    }

    /// The casters' mesh.
    fn mesh<'a>(&'a self, stage: &Stage<'a>) -> &'a Mesh {
        self.cut.as_ref().map_or(stage.tracer.mesh(), |cut| &cut.mesh)
    }

    /// The numbers of casters drawn.
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

/// The parts of a light with a map each; cascades share one light. Suns and spots, which need no cube, have one map
/// with every technique.
fn parts(stage: &Stage<'_>, light: &Light, options: &Options) -> Result<(Split, Vec<Light>)> {
    if let Some(cascading) = options.cascading {
        let cuts = cascading.cuts(options.technique.stays_put());
        let cascades = stage.cascades(light, cuts, &options.settings(stage)?)?;
        return Ok((Split::cascades(cuts, cascades), vec![*light]));
    }
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

/// The focus of each part.
fn foci(stage: &Stage<'_>, split: &Split, lights: &[Light]) -> Vec<Focus<'static>> {
    match split {
        Split::Directions { .. } => lights.iter().map(|light| stage.focus(light)).collect(),
        Split::Depths { cascades, .. } => cascades.iter().map(|cascade| cascade.focus.clone()).collect(),
    }
}
