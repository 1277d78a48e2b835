//! Options of the check.

use clap::builder::RangedU64ValueParser;
use shadowfit::glam::DVec3;

use crate::cli::{MapArgs, ViewArgs};
use crate::picture::CloseUp;
use crate::scene::parse_vector;

/// The help text after the options.
pub(crate) const HELP: &str = "\
What is compared: every pixel whose surface faces the light and is within its range. The GPU draws the map with the
crate's matrix and tests the pixel against it; the truth is a ray from the same surface point to the light.

The table:
  passes      maps drawn: one, or one for each cascade or cube face that has receivers and casters
  drawn       triangles left by culling against the caster volume H, over all passes, in percent of the scene's
  predicted   worst aliasing (longest side of a texel over that of a pixel) over the receiver volume, by the fit
  limit       lower bound on that for any parameterization with the same number of texels
  aliasing    measured aliasing of the compared pixels: the worst, and the median
  missing     pixels lit because a caster was clipped or culled: must be 0
  false       false shadow (acne) and false light (leaks) away from edges, in percent of the compared pixels
  edge        wrong within the filter's reach of a true shadow's edge, or next to one, in percent
  virtual     pixels where texels disagreed and virtual samples decided, in percent
  worst       the largest cluster of wrong pixels away from edges: how many, and where
  fit, map, test   CPU time of the fit and GPU times of the passes, medians over --frames

Written to --out, per light and map:
  check.json               all results
  N-KIND-truth.png         the camera's view with ray-traced shadows
  N-KIND-MAP-image.png     the same with the map's shadows
  N-KIND-MAP-faults.png    false shadow red, false light blue, edges amber, missing casters magenta
  N-KIND-MAP-map.png       the shadow map; cascades from left to right, nearest first; cube faces likewise, +x first
  N-KIND-MAP-aliasing.png  aliasing
  N-KIND-MAP-cascades.png    with --cascades: the truth, and the image tinted by cascade
  N-KIND-close-up.png      with --close-up: the same square of the truth and of each image, side by side";

/// Options of the check.
#[derive(Clone, Debug, clap::Args)]
pub struct CheckArgs {
    /// Scene, camera and lights.
    #[command(flatten)]
    pub view: ViewArgs,

    /// The maps.
    #[command(flatten)]
    pub map: MapArgs,

    /// Fit the maps to the depth range of the visible surfaces, read back from the camera's depth buffer, instead
    /// of the range between the near and far planes
    #[arg(long)]
    pub narrow: bool,

    /// Fit the maps to the visible surfaces, as the camera's depth buffer shows them
    #[arg(long, conflicts_with = "narrow")]
    pub seen: bool,

    /// Fit the maps to the boxes of all objects instead of one box around the scene
    #[arg(long)]
    pub boxes: bool,

    /// Translate scene, camera and lights by this vector, round positions to f32, and draw maps, casters and
    /// receivers in world space instead of relative to the eye
    #[arg(long, value_name = "X,Y,Z", value_parser = parse_vector, allow_hyphen_values = true)]
    pub at: Option<DVec3>,

    /// A square of the image to magnify: its centre pixel, and its side in pixels
    #[arg(long, value_name = "X,Y,SIDE")]
    pub close_up: Option<CloseUp>,

    /// Frames drawn per map; times are medians over them
    #[arg(long, default_value_t = 3, value_parser = RangedU64ValueParser::<u32>::new().range(1..=1000))]
    pub frames: u32,
}
