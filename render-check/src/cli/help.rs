//! What `--help` says besides the options.

use crate::scene::BUILT_IN;

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

/// The built-in scenes, and what each shows.
pub(crate) fn scenes() -> String {
    let lines = BUILT_IN.map(|scene| format!("\n  {:12}{}", scene.name, scene.shows));
    format!("Built-in scenes:{}", lines.concat())
}
