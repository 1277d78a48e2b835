//! Options of `draw`.

use clap::builder::RangedU64ValueParser;

use crate::cli::ViewArgs;
use crate::maps::Technique;

/// The help text after the options.
pub(crate) const HELP: &str = "\
Pictures, per light (N counts the lights from 1):
  N-KIND-camera.png   the camera's view with ray-traced shadows; the caster volume H in orange, dim where hidden
  N-KIND-light.png    the scene from the light: H in orange, the camera's frustum in blue; surfaces outside H, which
                      need not be in the shadow map, are darkened
  N-KIND-maps.png     the depths of each map, with H

The table:
  class       the light's class: where the camera's perspective maps it (a point light, one on the infinity plane, …)
  s           back-shift of the PSM's virtual camera for the whole of H, in world units
  H           vertices, faces and volume relative to the scene's box: H as in the paper; below, its tight form
  map         the technique
  window      extent of a uniform map with the texel size of this map's middle: world units for a sun, width over
              distance for point and spot lights
  aliasing    worst aliasing in view, longest side of a texel over that of a pixel: above 1 texels are visible
  limit       lower bound on that for any parameterization with the same number of texels
  fit         median CPU time of a fit";

/// Options of `draw`.
#[derive(Clone, Debug, clap::Args)]
pub struct DrawArgs {
    /// Scene, camera and lights.
    #[command(flatten)]
    pub view: ViewArgs,

    /// A warp for a single map; may be given several times [default: uniform, psm, light-space, best]
    #[arg(long = "technique", value_name = "TECHNIQUE", value_enum)]
    pub techniques: Vec<Technique>,

    /// Map resolution: texels per side
    #[arg(long, value_name = "TEXELS", default_value_t = 1024, value_parser = RangedU64ValueParser::<u32>::new().range(16..=16384))]
    pub size: u32,
}
