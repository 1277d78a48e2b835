//! What to plan, and what may be spent.

use anyhow::{Context, Result};
use clap::builder::RangedU64ValueParser;
use shadowfit::{Origin, Settings, plan::Budget};

use crate::cli::{FormatArg, ViewArgs};
use crate::gpu::{Filter, Points};
use crate::maps::Technique;

/// What is told after the options.
pub(crate) const HELP: &str = "\
What is planned: the least that is enough for each light, within a budget: a map or none, its kind, its size, what is
drawn into it, how depths are tested and how the map is read. What is drawn is that and no more.

The table:
  aliasing    the longest side of a texel over that of a pixel at its worst, as the plan estimates it; as it came out
              at its worst among the pixels; and the median
  drawn       objects drawn of all, over all passes; and triangles
  missing     pixels lit because a caster was clipped or culled, or because there is no map: must be none
  false       false shadow and false light, away from edges, in percent of what is compared
  edge        wrong within a texel's reach, or within a pixel, of the edge of a true shadow, in percent
  wrong       all of these together: how coarse a map is shows at edges
  map, test   times of the card's passes, medians over --frames

Written to --out: plan.json.";

/// What to plan.
#[derive(Clone, Debug, clap::Args)]
pub struct PlanArgs {
    /// The camera, the scene, the lights.
    #[command(flatten)]
    pub view: ViewArgs,

    /// What may be spent.
    #[command(flatten)]
    pub budget: BudgetArgs,

    /// What is drawn into the map for a point of a cloud
    #[arg(long, value_enum, default_value_t = Points::Discs)]
    pub points: Points,

    /// How often each map is drawn and read, for the median of the times
    #[arg(long, default_value_t = 3, value_parser = RangedU64ValueParser::<u32>::new().range(1..=1000))]
    pub frames: u32,
}

/// What a plan may spend.
#[derive(Clone, Debug, clap::Args)]
pub struct BudgetArgs {
    /// The most texels along each side of a map
    #[arg(long, value_name = "TEXELS", default_value_t = 1024, value_parser = RangedU64ValueParser::<u32>::new().range(16..=16384))]
    pub size: u32,

    /// Bits of depth
    #[arg(long, value_enum, default_value_t = FormatArg::Unorm24)]
    pub format: FormatArg,

    /// The widest filter: nearest, hardware (2 x 2, blended), or pcfN for the mean over N x N texels
    #[arg(long, value_name = "FILTER", default_value = "hardware", value_parser = parse_filter)]
    pub filter: shadowfit::Filter,

    /// What maps may be warped by, where that is worth it
    #[arg(long, value_enum, default_value_t = Technique::Best)]
    pub warp: Technique,

    /// What is fine enough: the longest side of a texel over that of a pixel
    #[arg(long, value_name = "RATIO", default_value_t = 1.0)]
    pub aliasing: f64,

    /// The most texels of all maps together [default: as many as they need]
    #[arg(long, value_name = "TEXELS")]
    pub texels: Option<u64>,
}

impl BudgetArgs {
    /// The budget for an image so many pixels high.
    ///
    /// # Errors
    ///
    /// When it makes no sense.
    pub fn budget(&self, image_height: u32) -> Result<Budget> {
        let settings = self.warp.settings(Settings::new(self.size, image_height)?.with_origin(Origin::Eye));
        let budget = Budget::new(settings).with_format(self.format.into()).with_filter(self.filter);
        let budget = budget.with_aliasing(self.aliasing).context("nothing can be so fine")?;
        Ok(self.texels.map_or(budget, |texels| budget.with_texels(texels)))
    }
}

/// Reads a filter that a plan can choose: whether by virtual samples is its own choice.
fn parse_filter(text: &str) -> Result<shadowfit::Filter, String> {
    match text.parse()? {
        Filter::Nearest => Ok(shadowfit::Filter::Nearest),
        Filter::Hardware2x2 => Ok(shadowfit::Filter::Hardware2x2),
        // The harness reads at most 15 of them.
        Filter::Pcf(taps) => Ok(shadowfit::Filter::Pcf(taps as u8)),
        Filter::Virtual(_) => {
            Err("the plan says where virtual samples are needed: write nearest, hardware or pcfN".into())
        }
    }
}
