//! What programs read: a run's results as JSON.

use serde::Serialize;
use shadowfit::glam::DVec3;
use shadowfit::{ShadowMap, View};

use super::fitted_maps::{Drawn, FittedMap};
use super::map_run::{MapRun, Times};
use super::options::Options;
use super::prediction::Prediction;
use crate::gpu::{Filter, MapPass};
use crate::maps::{ClipConvention, Layout, NoMap, Slicing, Technique};
use crate::stage::StageLight;
use crate::verdict::Verdict;

/// The camera of a report.
#[derive(Clone, Debug, Serialize)]
pub struct CameraReport {
    /// Where it is, in world space.
    pub eye: [f64; 3],
    /// Where it looks, of length one.
    pub forward: [f64; 3],
    /// The near plane's distance, in world units.
    pub near: f64,
    /// The far plane's distance; nothing where it is infinite.
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
    /// The light, as the command line spells it.
    pub light: String,
    /// What the camera's perspective makes of it.
    pub class: String,
    /// How the texels are spread.
    pub technique: Technique,
    /// Texels along each side.
    pub map_size: u32,
    /// How the view is cut into slices; nothing where it is not.
    pub slicing: Option<Slicing>,
    /// Whose clip space the matrix is for.
    pub clip: ClipConvention,
    /// How the map is read.
    pub filter: Filter,
    /// What came of it.
    #[serde(flatten)]
    pub result: RunResult,
}

/// What came of a run.
#[derive(Clone, Debug, Serialize)]
#[serde(untagged)]
pub enum RunResult {
    /// A map, or several.
    Maps(Box<MapsReport>),
    /// No map.
    NoMap {
        /// The crate's own words.
        no_map: String,
        /// Pixels that are in shadow in truth, where the crate said that no shadow needs a map.
        missing: usize,
    },
}

/// What came of maps.
#[derive(Clone, Debug, Serialize)]
pub struct MapsReport {
    /// How many maps were drawn, a pass each.
    pub passes: usize,
    /// How many parts of the light were left out, as nothing there needs a map.
    pub left_out: usize,
    /// The texels of all maps.
    pub texels: u64,
    /// Each map that was drawn.
    pub maps: Vec<MapReport>,
    /// What was drawn into them.
    pub drawn: Drawn,
    /// The share of the compared pixels where virtual samples decided; nothing with a filter that has none.
    pub used_plane: Option<f64>,
    /// How long it took.
    pub times: Times,
    /// What the fit says of them.
    #[serde(flatten)]
    pub prediction: Prediction,
    /// How they compare with the truth.
    #[serde(flatten)]
    pub verdict: Verdict,
}

/// One map.
#[derive(Clone, Debug, Serialize)]
pub struct MapReport {
    /// The middle direction of the part of the light that it is for; zeros for all of the light.
    pub axis: [f64; 3],
    /// The depths before the eye that it is for, from and to; nothing for all, and infinite as nothing.
    pub depths: Option<[f64; 2]>,
    /// How far the warp's camera moved back, in world units; nothing for a paraboloid.
    pub shift: Option<f64>,
    /// How much of the warp is left out, see [`shadowfit::ShadowMap::weakening`]; nothing for a paraboloid.
    pub weakening: Option<f64>,
    /// Why it has no warp although one was asked for.
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
    /// Of a run.
    #[must_use]
    pub fn new(view: &View, light: &StageLight, options: &Options, run: &Result<MapRun, NoMap>) -> Self {
        let result = match run {
            Ok(run) => RunResult::Maps(Box::new(MapsReport::new(run))),
            Err(none) => RunResult::NoMap {
                no_map: none.to_string(),
                missing: match none {
                    NoMap::Empty(_) => light.truth.shadowed(),
                    // An answer that promises nothing: other maps serve.
                    NoMap::Surrounded(_) => 0,
                },
            },
        };
        Self {
            light: light.spec.to_string(),
            class: shadowfit::warp::classify(view, &light.light).kind.to_string(),
            technique: options.technique,
            map_size: options.map_size,
            slicing: options.slicing,
            clip: options.clip,
            filter: options.filter,
            result,
        }
    }

    /// Pixels that are lit because a caster was clipped or culled, or because there is no map though there should be.
    #[must_use]
    pub fn missing(&self) -> usize {
        match &self.result {
            RunResult::Maps(maps) => maps.verdict.counts.missing,
            RunResult::NoMap { missing, .. } => *missing,
        }
    }
}
