//! The command line.

use std::path::PathBuf;

use clap::Parser;
use clap::builder::RangedU64ValueParser;
use shadowfit::glam::DVec3;

use crate::light::LightSpec;

const AFTER_HELP: &str = "\
Examples:
  render-check
      the built-in chess board under a sun, a lamp and a spot: needs no file at all
  render-check sponza.glb --eye -11.5,2,-0.3 --target 8,4.5,0 --fov 75 --light sun:0.15,1,0.25
      a file, a camera and a sun of your own
  render-check room.glb --light point:0,2.4,0/12 --light spot:3,3,0/0,0,0/50
      a lamp that reaches 12 units and a spot with a cone of 50 degrees, each fitted on its own
  render-check city.glb --near 1 --far inf --size 2048 --out /tmp/city
      an infinite far plane, maps of 2048 x 2048 texels, pictures in /tmp/city

Lights (parts are separated by '/'; all in world units, Y is up):
  sun:X,Y,Z                               directional; X,Y,Z points TOWARDS the light: sun:0,1,0 is noon
  point:X,Y,Z[/RANGE]                     a lamp at X,Y,Z; RANGE is how far it reaches, else without end
  spot:X,Y,Z/TX,TY,TZ/DEGREES[/RANGE]     a lamp at X,Y,Z aimed at TX,TY,TZ; DEGREES is the full cone angle
  Without --light: the lights of the file, and where it has none, a sun.

The camera:
  --eye and --target; without them the first perspective camera of the file; without one, a camera that shows
  the whole scene. Near and far planes that nobody gives are put close around what is in view.

Pictures, per light (N counts the lights from 1):
  N-KIND-camera.png   the camera's view with ray-traced shadows; the focus body H in orange, dim where hidden
  N-KIND-light.png    the scene as the light sees it: H in orange, the camera's frustum in blue; what lies
                      outside H, and so need not be in the shadow map, is darkened
  N-KIND-maps.png     the depths in the uniform map (left) and in the perspective shadow map (right), with H

The table:
  class       what the camera's perspective makes of the light (a point light, one on the infinity plane, …)
  s           how far the virtual camera of the PSM moves back for the whole of H, in world units
  H           vertices, faces and share of the scene's box, as in the paper; below, of its tight form
  map         uniform; PSM, the perspective shadow map; and the PSM without the move back
  window      what a map would cover if it were everywhere as it is in its middle: world units for a sun, width over
              distance for a lamp
  aliasing    the longest side of a texel over that of a pixel, at its worst in view: 1 is ideal, above it shows
  fit         the median time of one PSM fit, on this machine";

/// Fits shadow maps to a scene and shows what came of it.
///
/// For every light it computes the focus body H (all that must be in the shadow map), the light's class and the
/// matrices of a uniform and of a perspective shadow map (PSM), prints them as a table and draws pictures of them.
#[derive(Clone, Debug, Parser)]
#[command(name = "render-check", version, after_help = AFTER_HELP, max_term_width = 110)]
pub struct Args {
    /// A binary glTF file; without it, a chess board made by code
    #[arg(value_name = "SCENE.GLB")]
    pub scene: Option<PathBuf>,

    /// A light: sun:…, point:… or spot:…, spelled as below; may be given several times
    #[arg(long = "light", value_name = "LIGHT")]
    pub lights: Vec<LightSpec>,

    /// Where the camera is
    #[arg(long, value_name = "X,Y,Z", value_parser = parse_vector, allow_hyphen_values = true)]
    pub eye: Option<DVec3>,

    /// The point the camera looks at; the middle of the scene without it
    #[arg(long, value_name = "X,Y,Z", value_parser = parse_vector, allow_hyphen_values = true, requires = "eye")]
    pub target: Option<DVec3>,

    /// The camera's vertical field of view, in degrees [default: the file's, else 50]
    #[arg(long, value_name = "DEGREES", value_parser = parse_field_of_view)]
    pub fov: Option<f64>,

    /// The camera's near plane, in world units [default: the file's, else close to what is in view]
    #[arg(long, value_name = "DISTANCE", value_parser = parse_distance)]
    pub near: Option<f64>,

    /// The camera's far plane, in world units or inf [default: the file's, else just behind the scene]
    #[arg(long, value_name = "DISTANCE", value_parser = parse_distance)]
    pub far: Option<f64>,

    /// Texels along each side of a shadow map
    #[arg(long, value_name = "TEXELS", default_value_t = 1024, value_parser = RangedU64ValueParser::<u32>::new().range(16..=16384))]
    pub size: u32,

    /// Width of the camera's image and of the view pictures, in pixels
    #[arg(long, value_name = "PIXELS", default_value_t = 960, value_parser = RangedU64ValueParser::<u32>::new().range(16..=8192))]
    pub width: u32,

    /// Height of the camera's image and of the view pictures, in pixels
    #[arg(long, value_name = "PIXELS", default_value_t = 600, value_parser = RangedU64ValueParser::<u32>::new().range(16..=8192))]
    pub height: u32,

    /// The directory for the pictures, made where it is missing [default: out/SCENE]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

/// Reads `X,Y,Z`: three finite numbers.
///
/// # Errors
///
/// A sentence that names what is wrong.
pub fn parse_vector(text: &str) -> Result<DVec3, String> {
    let numbers = text
        .split(',')
        .map(|part| match part.trim().parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(number),
            _ => Err(format!("'{part}' in '{text}' is not a number")),
        })
        .collect::<Result<Vec<f64>, String>>()?;
    match numbers[..] {
        [x, y, z] => Ok(DVec3::new(x, y, z)),
        _ => Err(format!("'{text}' should be three numbers with commas between: X,Y,Z")),
    }
}

fn parse_field_of_view(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(degrees) if degrees > 0.0 && degrees < 180.0 => Ok(degrees),
        _ => Err("a field of view is an angle between 0 and 180 degrees".into()),
    }
}

fn parse_distance(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(distance) if distance > 0.0 => Ok(distance),
        _ => Err("a distance is a number greater than zero".into()),
    }
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::*;

    #[test]
    fn the_command_is_sound() {
        Args::command().debug_assert();
    }

    #[test]
    fn no_argument_is_enough() {
        let args = Args::parse_from(["render-check"]);
        assert!(args.scene.is_none() && args.lights.is_empty() && args.eye.is_none());
        assert_eq!((args.size, args.width, args.height), (1024, 960, 600));
    }

    #[test]
    fn negative_numbers_are_values_not_options() {
        let args = Args::parse_from([
            "render-check",
            "a.glb",
            "--eye",
            "-1,2,-3",
            "--target",
            "-4,5,6",
            "--light",
            "sun:-1,1,0",
            "--far",
            "inf",
        ]);
        assert_eq!(args.eye, Some(DVec3::new(-1.0, 2.0, -3.0)));
        assert_eq!(args.target, Some(DVec3::new(-4.0, 5.0, 6.0)));
        assert_eq!(args.far, Some(f64::INFINITY));
        assert_eq!(args.lights.len(), 1);
    }

    #[test]
    fn every_example_in_the_help_is_a_command() {
        let commands: Vec<_> = AFTER_HELP.lines().filter(|line| line.starts_with("  render-check")).collect();
        assert_eq!(commands.len(), 4);
        for command in commands {
            Args::try_parse_from(command.split_whitespace()).expect(command);
        }
    }

    #[test]
    fn wrong_values_are_refused() {
        for wrong in [
            &["--eye", "1,2"][..],
            &["--target", "1,2,3"],
            &["--fov", "180"],
            &["--near", "0"],
            &["--far", "-3"],
            &["--size", "1"],
            &["--light", "sun"],
        ] {
            let line = [&["render-check"], wrong].concat();
            assert!(Args::try_parse_from(line).is_err(), "{wrong:?}");
        }
    }
}
