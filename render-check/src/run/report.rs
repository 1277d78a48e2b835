//! The results of a run, as written to JSON.

use serde::Serialize;
use shadowfit::glam::DVec3;
use shadowfit::{ShadowMap, View};

use super::fitted_maps::{Drawn, FittedMap};
use super::map_run::{MapRun, Times};
use super::options::Options;
use super::prediction::Prediction;
use crate::gpu::{Filter, MapPass};
use crate::maps::{Cascading, ClipConvention, Layout, NoMap, Technique};
use crate::stage::StageLight;
use crate::verdict::Verdict;

/// The camera of a report.
#[derive(Clone, Debug, Serialize)]
pub struct CameraReport {
    /// Position, in world space.
    pub eye: [f64; 3],
    /// View direction, of unit length.
    pub forward: [f64; 3],
    /// The near plane's distance, in world units.
    pub near: f64,
    /// The far plane's distance; `None` where it is infinite.
    pub far: Option<f64>,
}

impl From<&View> for CameraReport {
    fn from(view: &View) -> Self {
        Self {
            eye: view.eye().to_array(),
            forward: view.forward().to_array(),
            near: view.near(),
            far: view.far().is_finite().then(|| view.far()),
        }
    }
}

/// One run.
#[derive(Clone, Debug, Serialize)]
pub struct RunReport {
    /// The light, in the command line's spelling.
    pub light: String,
    /// Its class: where the camera's perspective maps the light.
    pub class: String,
    /// The technique.
    pub technique: Technique,
    /// Texels along each side.
    pub map_size: u32,
    /// How the view is split into cascades; `None` where it is not.
    pub cascading: Option<Cascading>,
    /// The clip space of the matrix.
    pub clip: ClipConvention,
    /// The filter.
    pub filter: Filter,
    /// The result.
    #[serde(flatten)]
    pub result: RunResult,
}

/// The result of a run.
#[derive(Clone, Debug, Serialize)]
#[serde(untagged)]
pub enum RunResult {
    /// A map, or several.
    Maps(Box<MapsReport>),
    /// No map.
    NoMap {
        /// The crate's reason.
        no_map: String,
        /// Pixels that are in shadow by the truth although the crate reported that no map is needed.
        missing: usize,
    },
}

/// The result of a run with maps.
#[derive(Clone, Debug, Serialize)]
pub struct MapsReport {
    /// Maps drawn, one pass each.
    pub passes: usize,
    /// Parts of the light that need no map.
    pub left_out: usize,
    /// The texels of all maps.
    pub texels: u64,
    /// Each map that was drawn.
    pub maps: Vec<MapReport>,
    /// The numbers of casters drawn.
    pub drawn: Drawn,
    /// The share of the compared pixels that virtual samples decided; `None` with filters that use none.
    pub used_plane: Option<f64>,
    /// The times.
    pub times: Times,
    /// The predicted aliasing.
    #[serde(flatten)]
    pub prediction: Prediction,
    /// The comparison with ray-traced truth.
    #[serde(flatten)]
    pub verdict: Verdict,
}

/// One map.
#[derive(Clone, Debug, Serialize)]
pub struct MapReport {
    /// The axis of its part of the light; zero for the whole light.
    pub axis: [f64; 3],
    /// The depth range of its cascade; `None` without cascades, and `null` for an infinite end.
    pub depths: Option<[f64; 2]>,
    /// The back-shift of the virtual camera, in world units; `None` for a paraboloid.
    pub shift: Option<f64>,
    /// How much the warp was weakened, see [`shadowfit::ShadowMap::weakening`]; `None` for a paraboloid.
    pub weakening: Option<f64>,
    /// Why the fit fell back to a uniform map, if it did.
    pub refusal: Option<String>,
    /// How the map was drawn.
    pub pass: MapPass,
}

impl MapReport {
    fn new(axis: DVec3, depths: Option<[f64; 2]>, fitted: &FittedMap) -> Self {
        let map = match &fitted.map {
            Layout::Frustum(map) => Some(map),
            Layout::Paraboloid(_) => None,
        };
        Self {
            axis: axis.to_array(),
            depths,
            shift: map.map(|map| map.camera().shift),
            weakening: map.map(ShadowMap::weakening),
            refusal: map.and_then(ShadowMap::fallback).map(|refusal| refusal.to_string()),
            pass: fitted.pass,
        }
    }
}

impl MapsReport {
    fn new(run: &MapRun) -> Self {
        let fitted = &run.fitted;
        let split = &fitted.split;
        let report = |(part, map): (usize, &Option<FittedMap>)| {
            Some(MapReport::new(split.axis(part), split.depths(part), map.as_ref()?))
        };
        let maps: Vec<_> = fitted.maps.iter().enumerate().filter_map(report).collect();
        Self {
            passes: maps.len(),
            left_out: fitted.maps.len() - maps.len(),
            texels: run.depths.iter().map(|depths| depths.len() as u64).sum(),
            maps,
            drawn: run.drawn,
            used_plane: run.used_plane,
            times: run.times,
            prediction: run.prediction,
            verdict: run.verdict.clone(),
        }
    }
}

impl RunReport {
    /// The report of a run.
    #[must_use]
    pub fn new(view: &View, light: &StageLight, options: &Options, run: &Result<MapRun, NoMap>) -> Self {
        let result = match run {
            Ok(run) => RunResult::Maps(Box::new(MapsReport::new(run))),
            Err(none) => RunResult::NoMap {
                no_map: none.to_string(),
                missing: match none {
                    NoMap::Empty(_) => light.truth.shadowed(),
                    // This reason does not claim that no map is needed: other kinds of maps are.
                    NoMap::Surrounded(_) => 0,
                },
            },
        };
        Self {
            light: light.spec.to_string(),
            class: shadowfit::warp::classify(view, &light.light).kind.to_string(),
            technique: options.technique,
            map_size: options.map_size,
            cascading: options.cascading,
            clip: options.clip,
            filter: options.filter,
            result,
        }
    }

    /// Pixels that are lit because a caster was clipped or culled, or because a map is missing.
    #[must_use]
    pub fn missing(&self) -> usize {
        match &self.result {
            RunResult::Maps(maps) => maps.verdict.counts.missing,
            RunResult::NoMap { missing, .. } => *missing,
        }
    }
}
