//! What to draw.

use clap::builder::RangedU64ValueParser;

use crate::cli::ViewArgs;
use crate::maps::Technique;

/// What a drawing prints and writes.
pub(crate) const HELP: &str = "\
Pictures, per light (N counts the lights from 1):
  N-KIND-camera.png   the camera's view with ray-traced shadows; the focus body H in orange, dim where hidden
  N-KIND-light.png    the scene as the light sees it: H in orange, the camera's frustum in blue; what lies
                      outside H, and so need not be in the shadow map, is darkened
  N-KIND-maps.png     the depths in each map, with H

The table:
  class       what the camera's perspective makes of the light (a point light, one on the infinity plane, …)
  s           how far the virtual camera of the PSM moves back for the whole of H, in world units
  H           vertices, faces and share of the scene's box, as in the paper; below, of its tight form
  map         the ways to spread its texels
  window      what a map would cover if it were everywhere as it is in its middle: world units for a sun, width over
              distance for a lamp
  aliasing    the longest side of a texel over that of a pixel, at its worst in view: 1 is ideal, above it shows
  limit       what that would be at least, however as many texels were spread
  fit         the median time of a fit, on this machine";

/// What to draw.
#[derive(Clone, Debug, clap::Args)]
pub struct DrawArgs {
    /// The camera, the scene, the lights.
    #[command(flatten)]
    pub view: ViewArgs,

    /// A way to spread the texels of a single map; may be given several times [default: uniform, psm, light-space, best]
    #[arg(long = "technique", value_name = "TECHNIQUE", value_enum)]
    pub techniques: Vec<Technique>,

    /// Texels along each side of a shadow map
    #[arg(long, value_name = "TEXELS", default_value_t = 1024, value_parser = RangedU64ValueParser::<u32>::new().range(16..=16384))]
    pub size: u32,
}
