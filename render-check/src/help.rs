//! What `--help` says besides the options.

use crate::scene::BUILT_IN;

/// Command lines, and what each is for.
pub(crate) const EXAMPLES: &str = "\
Examples:
  render-check
      the built-in chess board under a sun, a lamp and a spot: needs no file at all
  render-check street --technique uniform --technique psm --size 512 --size 2048
      another built-in scene, two techniques, two sizes of map
  render-check sponza.glb --eye -11.5,2,-0.3 --target 8,4.5,0 --fov 75 --light sun:0.15,1,0.25
      a file, a camera and a sun of your own
  render-check room.glb --light point:0,2.4,0/12 --light spot:3,3,0/0,0,0/50 --filter pcf3
      a lamp that reaches 12 units and a spot with a cone of 50 degrees, read with 3 x 3 texels
  render-check room --light point:0,1.5,-2.5 --technique cube --technique cube-psm
      a lamp among what it lights: a map for each face of the cube around it
  render-check draw city.glb --near 1 --far inf --size 2048
      only the fit and its pictures, by ray casting: needs no graphics driver
  render-check street --slices 1 --slices 4 --technique uniform --technique best
      a map for each slice of the view
  render-check walk street --steps 48
      a camera that walks, and the pixels that flicker
  render-check sweep
      the hard cases: lights through the camera's plane, every clip space, scenes of any size";

/// How lights and the camera are written.
pub(crate) const LIGHTS: &str = "\
Lights (parts are separated by '/'; all in world units, Y is up):
  sun:X,Y,Z                               directional; X,Y,Z points TOWARDS the light: sun:0,1,0 is noon
  point:X,Y,Z[/RANGE]                     a lamp at X,Y,Z; RANGE is how far it reaches, else without end
  spot:X,Y,Z/TX,TY,TZ/DEGREES[/RANGE]     a lamp at X,Y,Z aimed at TX,TY,TZ; DEGREES is the full cone angle
  Without --light: the lights of the scene, and where it has none, a sun.

The camera:
  --eye and --target; without them the first perspective camera of the scene; without one, a camera that shows
  the whole scene. Near and far planes that nobody gives are put close around what is in view.";

/// What a check compares, prints and writes.
pub(crate) const CHECK_HELP: &str = "\
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

/// What a drawing prints and writes.
pub(crate) const DRAW_HELP: &str = "\
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

/// What a walk counts.
pub(crate) const WALK_HELP: &str = "\
What is counted: pixels of each step that change between light and shadow when the map fitted for the next step takes
the place of this step's, though nothing moved but the camera, so that the truth is the same. Only points that both
cameras have in view count, and those apart that pass over a cut between slices and so to another map. A best map is also found from the one of the step before (warm), and then says when it left that
for another one, so that what is visible jumps about in the map. Written to --out: walk.json.";

/// What a sweep does.
pub(crate) const SWEEP_HELP: &str = "\
Each case is a small picture of a built-in scene, drawn with every technique and held against ray-traced truth. The
table has a line for each group of cases, with the worst that was found in it; --out gets all of it as sweep.json.
The command fails when a caster is missing anywhere.";

/// The built-in scenes, and what each shows.
pub(crate) fn scenes() -> String {
    let lines = BUILT_IN.map(|scene| format!("\n  {:12}{}", scene.name, scene.shows));
    format!("Built-in scenes:{}", lines.concat())
}
