//! Help texts that several commands share.

use crate::scene::BUILT_IN;

/// The syntax of lights, and the defaults of lights and camera.
pub(crate) const LIGHTS: &str = "\
Lights (parts are separated by '/'; world units, Y is up):
  sun:X,Y,Z                               directional; X,Y,Z points TOWARDS the light: sun:0,1,0 is noon
  point:X,Y,Z[/RANGE]                     a point light at X,Y,Z; RANGE defaults to infinity
  spot:X,Y,Z/TX,TY,TZ/DEGREES[/RANGE]     a spot light at X,Y,Z aimed at TX,TY,TZ; DEGREES is the full cone angle
  Without --light: the lights of the scene; if it has none, a sun.

The camera:
  --eye and --target; else the first perspective camera of the scene; else a camera that shows the whole scene.
  By default the near plane is close in front of the nearest visible surface, and the far plane just beyond the scene.";

/// The built-in scenes with a line on each.
pub(crate) fn scenes() -> String {
    let lines = BUILT_IN.map(|scene| format!("\n  {:12}{}", scene.name, scene.shows));
    format!("Built-in scenes:{}", lines.concat())
}
