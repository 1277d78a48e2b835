//! What to check.

use clap::builder::RangedU64ValueParser;
use shadowfit::glam::DVec3;

use crate::cli::{MapArgs, ViewArgs};
use crate::picture::CloseUp;
use crate::scene::parse_vector;

/// What a check compares, prints and writes.
pub(crate) const HELP: &str = "\
What is compared: every pixel that the light could reach, were nothing in its way. The card draws the map with the
crate's matrix and tests the pixel against it; a ray from the same point to the light says what is true.

The table:
  passes      maps drawn: one, or one for each slice or face of a cube that has anything to hold
  drawn       triangles that culling against H left to draw, over all passes, of those in the scene
  predicted   what the fit says of the longer side of a texel over that of a pixel: at worst over all that may be visible
  limit       what that would be at least, however the texels of all passes were spread
  aliasing    the same at the pixels: at worst among them, and the median
  missing     pixels lit because a caster was clipped or culled: must be none
  false       false shadow and false light, away from edges, in percent of what is compared
  edge        wrong within a texel's reach, or within a pixel, of the edge of a true shadow, in percent
  virtual     pixels where texels disagreed and virtual samples decided, in percent
  worst       the largest cluster of wrong pixels that are no edge: how many, and where
  fit, map, test   times of the fit on the processor and of the card's passes, medians over --frames

Written to --out, per light and map:
  check.json               everything, for programs
  N-KIND-truth.png         the camera's view with ray-traced shadows
  N-KIND-MAP-image.png     the same with the shadows of the map
  N-KIND-MAP-faults.png    false shadow red, false light blue, edges amber, missing casters magenta
  N-KIND-MAP-map.png       the shadow map; those of slices, the nearest first, or a cube's faces, +x first, from left to right
  N-KIND-MAP-aliasing.png  texel over pixel
  N-KIND-MAP-slices.png    with --slices: the truth, and the image in the colours of the slices
  N-KIND-close-up.png      with --close-up: a part of the truth and of each image, side by side";

/// What to check.
#[derive(Clone, Debug, clap::Args)]
pub struct CheckArgs {
    /// The camera, the scene, the lights.
    #[command(flatten)]
    pub view: ViewArgs,

    /// The maps.
    #[command(flatten)]
    pub map: MapArgs,

    /// Fit the maps to the depths that something is seen in, read back from the camera's depth buffer, and not to the
    /// camera's near and far planes
    #[arg(long)]
    pub narrow: bool,

    /// Move the scene, the camera and the lights by so much, to positions that f32 has there, and draw maps, casters and
    /// receivers in world space, not relative to the eye
    #[arg(long, value_name = "X,Y,Z", value_parser = parse_vector, allow_hyphen_values = true)]
    pub at: Option<DVec3>,

    /// A square of the picture to look at closely: the pixel in its middle, and pixels along its side
    #[arg(long, value_name = "X,Y,SIDE")]
    pub close_up: Option<CloseUp>,

    /// How often each map is drawn and read, for the median of the times
    #[arg(long, default_value_t = 3, value_parser = RangedU64ValueParser::<u32>::new().range(1..=1000))]
    pub frames: u32,
}
