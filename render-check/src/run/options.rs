//! How a light's maps are fitted, drawn and read.

use anyhow::{Context, Result};
use shadowfit::{DepthFormat, Settings};

use super::cut::Cutting;
use crate::gpu::{Bias, Filter, MapPass, Points};
use crate::maps::{ClipConvention, Layout, Slicing, Technique};
use crate::stage::Stage;
use crate::trace::Faces;

/// How a light's maps are fitted, drawn and read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// How its texels are spread.
    pub technique: Technique,
    /// Texels along each side.
    pub map_size: u32,
    /// How the view is cut into slices with a map each; not at all without.
    pub slicing: Option<Slicing>,
    /// Whose clip space its matrix is for.
    pub clip: ClipConvention,
    /// The depth buffer's format.
    pub format: DepthFormat,
    /// Which sides of triangles are drawn.
    pub faces: Faces,
    /// How it is read.
    pub filter: Filter,
    /// What is drawn for the points of clouds.
    pub points: Points,
    /// How casters are cut for paraboloids.
    pub cut: Cutting,
    /// What is added to depth; `None` for what the map says that the filter needs, see [`Layout::bias`].
    pub bias: Option<Bias>,
    /// How often it is drawn and read, for the median of the times.
    pub frames: u32,
}

impl Options {
    /// An unwarped or warped map for wgpu's clip space, 24 bits deep, its nearest texel read, drawn once.
    #[must_use]
    pub fn new(technique: Technique, map_size: u32) -> Self {
        Self {
            technique,
            map_size,
            slicing: None,
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

    /// The technique and the size of its maps in words.
    #[must_use]
    pub fn name(&self) -> String {
        let times = self.slicing.map_or_else(String::new, |slicing| format!("{} x ", slicing.count));
        format!("{} {times}{}", self.technique, self.map_size)
    }

    /// How a map is drawn: without a bias for second depth, layers and virtual samples, which do without.
    ///
    /// # Errors
    ///
    /// When the filter reaches nowhere.
    pub fn pass(&self, map: &Layout) -> Result<MapPass> {
        let (bias, (receiver, relative)) = match (self.bias, self.faces, self.filter) {
            (Some(bias), ..) => (bias, (0.0, 0.0)),
            (None, Faces::Second | Faces::Layers, _) | (None, _, Filter::Virtual(_)) => (Bias::NONE, (0.0, 0.0)),
            _ => {
                let enough = map.bias(self.format, self.filter.reach())?;
                (Bias::away(&enough), (enough.receiver, enough.relative))
            }
        };
        Ok(MapPass { format: self.format, faces: self.faces, bias, receiver, relative, points: self.points })
    }

    /// As many texels around what is visible as the filter reaches.
    #[must_use]
    pub fn border(&self) -> u32 {
        self.filter.reach().ceil() as u32
    }

    /// How a map is fitted.
    ///
    /// # Errors
    ///
    /// When the sizes cannot be used, or the border leaves no room.
    pub fn settings(&self, stage: &Stage<'_>) -> Result<Settings> {
        let settings = Settings::new(self.map_size, stage.size[1]).context("the sizes cannot be used")?;
        let settings = settings.with_border(self.border()).context("the filter is too wide for so small a map")?;
        Ok(self.technique.settings(settings).with_clip(self.clip.into()).with_origin(stage.origin))
    }
}
