//! The commands, one module each with its options, and the command line as a whole.

pub mod ablation;
pub mod check;
pub mod draw;
pub mod plan;
pub mod sweep;
pub mod walk;

use anyhow::Result;
use clap::{Parser, Subcommand};

use ablation::AblationArgs;
use check::CheckArgs;
use draw::DrawArgs;
use plan::PlanArgs;
use sweep::SweepArgs;
use walk::WalkArgs;

use crate::cli::{LIGHTS, scenes};

/// Example command lines.
const EXAMPLES: &str = "\
Examples:
  render-check
      the built-in chess board under a sun, a point light and a spot: needs no file
  render-check street --technique uniform --technique psm --size 512 --size 2048
      another built-in scene, two techniques, two map sizes
  render-check sponza.glb --eye -11.5,2,-0.3 --target 8,4.5,0 --fov 75 --light sun:0.15,1,0.25
      a file, with your own camera and sun
  render-check room.glb --light point:0,2.4,0/12 --light spot:3,3,0/0,0,0/50 --filter pcf3
      a point light with a range of 12 units and a spot with a cone of 50 degrees, filtered over 3 x 3 texels
  render-check room --light point:0,1.5,-2.5 --technique cube --technique cube-psm
      a point light inside the scene: a map for each cube face
  render-check draw city.glb --near 1 --far inf --size 2048
      only the fit and its pictures, by ray casting: needs no graphics driver
  render-check street --cascades 1 --cascades 4 --technique uniform --technique best
      one cascade, then four
  render-check walk street --steps 48
      moves the camera and counts the pixels that flicker
  render-check sweep
      the hard cases: lights crossing the camera's plane, every clip space, scenes of any size";

/// Draws scenes with fitted shadow maps on a GPU and compares every pixel with ray-traced truth.
///
/// Without a command it checks one scene: every light, with each technique and size of map.
#[derive(Clone, Debug, Parser)]
#[command(name = "render-check", version, max_term_width = 110, args_conflicts_with_subcommands = true)]
#[command(after_help = format!("{EXAMPLES}\n\n{}\n\n{LIGHTS}\n\n{}", scenes(), check::HELP))]
pub struct Args {
    /// The command; none checks a scene.
    #[command(subcommand)]
    pub command: Option<Command>,

    /// Options of the check.
    #[command(flatten)]
    pub check: CheckArgs,
}

/// The commands besides the check.
#[derive(Clone, Debug, Subcommand)]
pub enum Command {
    /// Fits and draws by ray casting, without a GPU: the caster volume H, the light's view, the maps' depths
    #[command(after_help = format!("{}\n\n{LIGHTS}\n\n{}", scenes(), draw::HELP))]
    Draw(DrawArgs),
    /// Moves the camera and counts the pixels that flicker
    #[command(after_help = format!("{}\n\n{LIGHTS}\n\n{}", scenes(), walk::HELP))]
    Walk(WalkArgs),
    /// Checks all hard cases
    #[command(after_help = sweep::HELP)]
    Sweep(SweepArgs),
    /// Plans the cheapest sufficient technique for each light, draws the plan and checks it
    #[command(after_help = format!("{}\n\n{LIGHTS}\n\n{}", scenes(), plan::HELP))]
    Plan(PlanArgs),
    /// Draws with and without each effect that a plan uses or omits, and compares both with the truth
    #[command(after_help = ablation::HELP)]
    Ablation(AblationArgs),
}

impl Args {
    /// Runs the command.
    ///
    /// # Errors
    ///
    /// As the command reports them.
    pub fn run(&self) -> Result<()> {
        match &self.command {
            None => check::check(&self.check),
            Some(Command::Draw(args)) => draw::draw(args),
            Some(Command::Walk(args)) => walk::walk(args),
            Some(Command::Sweep(args)) => sweep::sweep(args),
            Some(Command::Plan(args)) => plan::plan(args),
            Some(Command::Ablation(args)) => ablation::ablation(args),
        }
    }
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;
    use shadowfit::ClipSpace;
    use shadowfit::glam::DVec3;

    use super::*;
    use crate::cli::FormatArg;
    use crate::gpu::{Bias, Filter};
    use crate::maps::Technique;
    use crate::trace::Faces;

    #[test]
    fn the_command_is_sound() {
        Args::command().debug_assert();
    }

    #[test]
    fn no_argument_is_enough() {
        let args = Args::parse_from(["render-check"]);
        assert!(args.command.is_none());
        let CheckArgs { view, map, narrow, seen, boxes, at, close_up, frames } = args.check;
        assert!(
            !narrow
                && !seen
                && !boxes
                && at.is_none()
                && close_up.is_none()
                && view.lights.is_empty()
                && view.eye.is_none()
                && map.techniques.is_empty()
        );
        assert_eq!((view.scene, view.width, view.height, frames), ("chess-board".into(), 960, 600, 3));
    }

    #[test]
    fn negative_numbers_are_values_not_options() {
        let line = "render-check a.glb --eye -1,2,-3 --target -4,5,6 --light sun:-1,1,0 --far inf --bias -2,-0.5";
        let args = Args::parse_from(line.split_whitespace()).check;
        assert_eq!(args.view.eye, Some(DVec3::new(-1.0, 2.0, -3.0)));
        assert_eq!(args.view.target, Some(DVec3::new(-4.0, 5.0, 6.0)));
        assert_eq!(args.view.far, Some(f64::INFINITY));
        assert_eq!(args.view.lights.len(), 1);
        assert_eq!(args.map.bias, Some(Bias { constant: -2, slope: -0.5 }));
    }

    #[test]
    fn every_example_in_the_help_is_a_command() {
        let commands: Vec<_> = EXAMPLES.lines().filter(|line| line.starts_with("  render-check")).collect();
        assert_eq!(commands.len(), 9);
        for command in commands {
            Args::try_parse_from(command.split_whitespace()).expect(command);
        }
    }

    #[test]
    fn maps_are_described_by_words() {
        let line = "render-check --technique psm --technique uniform --size 256 --size 512 --format unorm16 \
                    --faces back --filter pcf5 --clip opengl-reversed";
        let map = Args::parse_from(line.split_whitespace()).check.map;
        assert_eq!(map.techniques, [Technique::Psm, Technique::Uniform]);
        assert_eq!(map.sizes, [256, 512]);
        assert_eq!((map.format, map.faces), (FormatArg::Unorm16, Faces::Back));
        assert_eq!(map.filter, Filter::Pcf(5));
        assert_eq!(ClipSpace::from(map.clip), ClipSpace::OPENGL.reversed());
    }

    #[test]
    fn depth_tests_are_described_by_words() {
        let line = "render-check table --faces second --filter virtual3";
        let map = Args::parse_from(line.split_whitespace()).check.map;
        assert_eq!((map.faces, map.filter), (Faces::Second, Filter::Virtual(3)));
        assert_eq!(map.filter.to_string(), "virtual3");
    }

    #[test]
    fn wrong_values_are_refused() {
        for wrong in [
            "--eye 1,2",
            "--target 1,2,3",
            "--fov 180",
            "--near 0",
            "--far -3",
            "--size 1",
            "--light sun",
            "--filter pcf1",
            "--filter pcf",
            "--filter virtual0",
            "--bias 3",
            "--bias 1,NaN",
            "--technique lispsm",
            "--cascades 0",
            "--cascades 9",
            "--cascades 2 --split practical",
            "--split log",
            "--close-up 1,2",
            "--close-up 1,2,0",
            "draw --technique lispsm",
            "--near inf",
            "--lamp-near inf",
            "walk --pace inf",
            "walk --turn nan",
        ] {
            let line = format!("render-check {wrong}");
            assert!(Args::try_parse_from(line.split_whitespace()).is_err(), "{wrong:?}");
        }
    }
}
