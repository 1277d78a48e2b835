//! The aliasing that a fit predicts, and its lower bound.

use serde::Serialize;
use shadowfit::{Light, Settings};

use super::fitted_maps::FittedMaps;
use crate::stage::Stage;

/// The worst aliasing over the receiver volume, texel size over pixel size, see [`shadowfit::ShadowMap::aliasing`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Prediction {
    /// A value that is attained somewhere, the largest over all maps; `None` for paraboloids.
    pub predicted: Option<f64>,
    /// An upper bound.
    pub predicted_at_most: Option<f64>,
    /// The error at the surfaces in view, see [`shadowfit::ShadowMap::surface_error`]; `None` for paraboloids.
    pub surface_error: Option<f64>,
    /// The means of its two parts.
    pub texel: Option<f64>,
    /// The bias.
    pub bias: Option<f64>,
    /// A lower bound for any parameterization with the same number of texels.
    pub limit: f64,
}

impl Prediction {
    /// The prediction for the maps of a light.
    #[must_use]
    pub fn new(fitted: &FittedMaps, stage: &Stage<'_>, light: &Light) -> Self {
        let foci = fitted.foci(stage);
        let worst = foci.iter().enumerate().filter_map(|(part, focus)| {
            let worst = fitted.frustum(part)?.aliasing_over(focus)?;
            Some((worst.worst, worst.upper_bound))
        });
        let worst = worst.reduce(|one, other| (one.0.max(other.0), one.1.max(other.1)));
        let (mut squares, mut texels, mut biases, mut pixels) = (0.0, 0.0, 0.0, 0.0);
        for (part, focus) in foci.iter().enumerate() {
            let focus = focus.clone().with_seen(&stage.seen);
            let Some(error) = fitted.frustum(part).and_then(|map| map.surface_error(&focus)) else { continue };
            squares += error.rms * error.rms * error.pixels;
            texels += error.texel * error.pixels;
            biases += error.bias * error.pixels;
            pixels += error.pixels;
        }
        let settings = fitted.maps.iter().flatten().next().map(|map| *map.map.settings());
        let maps = fitted.maps.iter().flatten().count();
        Self {
            predicted: worst.map(|(worst, _)| worst),
            predicted_at_most: worst.map(|(_, at_most)| at_most),
            surface_error: (pixels > 0.0).then(|| (squares / pixels).sqrt()),
            texel: (pixels > 0.0).then(|| texels / pixels),
            bias: (pixels > 0.0).then(|| biases / pixels),
            limit: settings.map_or(0.0, |settings| limit(stage, light, &settings, maps)),
        }
    }
}

/// The lower bound for a light with the texels of several maps: it is proportional to one over the root of their
/// number.
fn limit(stage: &Stage<'_>, light: &Light, settings: &Settings, maps: usize) -> f64 {
    stage.focus(light).aliasing_lower_bound(settings) / (maps as f64).sqrt()
}
