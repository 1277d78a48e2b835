//! The options of a run: how a light's maps are fitted, drawn and filtered.

use anyhow::{Context, Result};
use shadowfit::depth::DepthBias;
use shadowfit::{DepthFormat, Settings};

use super::cut::Cutting;
use crate::gpu::{Bias, Filter, MapPass, Points};
use crate::maps::{Cascading, ClipConvention, Layout, Technique};
use crate::stage::Stage;
use crate::trace::Faces;

/// The options of a run: how a light's maps are fitted, drawn and filtered.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// The technique.
    pub technique: Technique,
    /// Texels along each side.
    pub map_size: u32,
    /// The cascades; `None` for a single map.
    pub cascading: Option<Cascading>,
    /// The clip space of the matrix.
    pub clip: ClipConvention,
    /// The depth buffer's format.
    pub format: DepthFormat,
    /// Which faces are drawn.
    pub faces: Faces,
    /// The filter.
    pub filter: Filter,
    /// How points of clouds are drawn.
    pub points: Points,
    /// How casters are tessellated for paraboloids.
    pub cut: Cutting,
    /// The depth bias; `None` for the map's own, see [`Layout::bias`].
    pub bias: Option<Bias>,
    /// Frames drawn; times are medians over them.
    pub frames: u32,
}

impl Options {
    /// This technique and size with defaults: wgpu's clip space, 24 bits of depth, nearest texel, one frame.
    #[must_use]
    pub fn new(technique: Technique, map_size: u32) -> Self {
        Self {
            technique,
            map_size,
            cascading: None,
            clip: ClipConvention::Wgpu,
            format: DepthFormat::Unorm24,
            faces: Faces::All,
            filter: Filter::Nearest,
            points: Points::default(),
            cut: Cutting::default(),
            bias: None,
            frames: 1,
        }
    }

    /// Technique and map size in words.
    #[must_use]
    pub fn name(&self) -> String {
        let times = self.cascading.map_or_else(String::new, |cascading| format!("{} x ", cascading.count));
        format!("{} {times}{}", self.technique, self.map_size)
    }

    /// How a map is drawn; second depth, layers and virtual samples get no bias, as they need none.
    ///
    /// # Errors
    ///
    /// When the filter's reach is invalid.
    pub fn pass(&self, map: &Layout) -> Result<MapPass> {
        let bias = self.bias.unwrap_or(Bias::NONE);
        let none = MapPass {
            format: self.format,
            faces: self.faces,
            bias,
            receiver: 0.0,
            relative: 0.0,
            points: self.points,
        };
        Ok(self.derived_bias(map)?.map_or(none, |bias| none.with(&bias)))
    }

    /// The bias derived from the map for the filter; `None` where another is set, or none is needed: with second depth,
    /// layers and virtual samples.
    ///
    /// # Errors
    ///
    /// When the filter's reach is invalid.
    pub fn derived_bias(&self, map: &Layout) -> Result<Option<DepthBias>> {
        match (self.bias, self.faces, self.filter) {
            (Some(_), ..) | (None, Faces::Second | Faces::Layers, _) | (None, _, Filter::Virtual(_)) => Ok(None),
            (None, Faces::All | Faces::Front | Faces::Back, _) => {
                map.bias(self.format, self.filter.reach()).map(Some)
            }
        }
    }

    /// The border around the receivers that the filter needs, in texels.
    #[must_use]
    pub fn border(&self) -> u32 {
        self.filter.reach().ceil() as u32
    }

    /// The settings of the fit.
    ///
    /// # Errors
    ///
    /// When the sizes are invalid, or the border leaves no room.
    pub fn settings(&self, stage: &Stage<'_>) -> Result<Settings> {
        let settings = Settings::new(self.map_size, stage.size[1]).context("the sizes cannot be used")?;
        let settings = settings.with_border(self.border()).context("the filter is too wide for so small a map")?;
        Ok(self.technique.settings(settings).with_clip(self.clip.into()).with_origin(stage.origin))
    }
}
