//! Options of `plan`, and the budget.

use anyhow::{Context, Result};
use clap::builder::RangedU64ValueParser;
use shadowfit::{Origin, Settings, plan::Budget};

use crate::cli::{FormatArg, ViewArgs};
use crate::gpu::{Filter, Points};
use crate::maps::Technique;

/// The help text after the options.
pub(crate) const HELP: &str = "\
The plan: the cheapest sufficient technique for each light within a budget. It decides between a map and none, the kind
of map, its size, its casters, the depth test and the filter. Exactly the plan is drawn.

The table:
  aliasing    longest side of a texel over that of a pixel: the worst by the plan's estimate, the worst of all pixels
              as measured, and the median
  drawn       objects drawn, of all, over all passes; and triangles
  missing     pixels lit because a caster was clipped or culled, or because a map is missing: must be 0
  false       false shadow (acne) and false light (leaks) away from edges, in percent of the compared pixels
  edge        wrong within the filter's reach of a true shadow's edge, or next to one, in percent
  wrong       all of these together; coarse maps show at edges
  map, test   GPU times of the passes, medians over --frames

Written to --out: plan.json.";

/// Options of `plan`.
#[derive(Clone, Debug, clap::Args)]
pub struct PlanArgs {
    /// Scene, camera and lights.
    #[command(flatten)]
    pub view: ViewArgs,

    /// The budget.
    #[command(flatten)]
    pub budget: BudgetArgs,

    /// How points of a cloud are drawn into the map
    #[arg(long, value_enum, default_value_t = Points::Discs)]
    pub points: Points,

    /// Frames drawn per map; times are medians over them
    #[arg(long, default_value_t = 3, value_parser = RangedU64ValueParser::<u32>::new().range(1..=1000))]
    pub frames: u32,
}

/// The budget of a plan.
#[derive(Clone, Debug, clap::Args)]
pub struct BudgetArgs {
    /// Largest map resolution: texels per side
    #[arg(long, value_name = "TEXELS", default_value_t = 1024, value_parser = RangedU64ValueParser::<u32>::new().range(16..=16384))]
    pub size: u32,

    /// Depth format
    #[arg(long, value_enum, default_value_t = FormatArg::Unorm24)]
    pub format: FormatArg,

    /// The widest filter: nearest, hardware (2 x 2 bilinear PCF), or pcfN (PCF over N x N texels)
    #[arg(long, value_name = "FILTER", default_value = "hardware", value_parser = parse_filter)]
    pub filter: shadowfit::Filter,

    /// The warp that maps may use where it pays
    #[arg(long, value_enum, default_value_t = Technique::Best)]
    pub warp: Technique,

    /// Target aliasing: the longest side of a texel over that of a pixel
    #[arg(long, value_name = "RATIO", default_value_t = 1.0)]
    pub aliasing: f64,

    /// Limit on the texels of all maps together [default: none]
    #[arg(long, value_name = "TEXELS")]
    pub texels: Option<u64>,
}

impl BudgetArgs {
    /// The budget for an image of this height in pixels.
    ///
    /// # Errors
    ///
    /// When a value is out of range.
    pub fn budget(&self, image_height: u32) -> Result<Budget> {
        let settings = self.warp.settings(Settings::new(self.size, image_height)?.with_origin(Origin::Eye));
        let budget = Budget::new(settings).with_format(self.format.into()).with_filter(self.filter);
        let budget = budget.with_aliasing(self.aliasing).context("nothing can be so fine")?;
        Ok(self.texels.map_or(budget, |texels| budget.with_texels(texels)))
    }
}

/// Parses a filter for a plan, which decides itself where virtual samples are used.
fn parse_filter(text: &str) -> Result<shadowfit::Filter, String> {
    match text.parse()? {
        Filter::Nearest => Ok(shadowfit::Filter::Nearest),
        Filter::Hardware2x2 => Ok(shadowfit::Filter::Hardware2x2),
        // At most 15 by its own parser.
        Filter::Pcf(taps) => Ok(shadowfit::Filter::Pcf(taps as u8)),
        Filter::Virtual(_) => {
            Err("the plan says where virtual samples are needed: write nearest, hardware or pcfN".into())
        }
    }
}
