//! The command line.

use std::path::PathBuf;

use clap::builder::RangedU64ValueParser;
use clap::{Parser, Subcommand, ValueEnum};
use shadowfit::glam::DVec3;
use shadowfit::{ClipSpace, DepthFormat, cascades::Cascades};

use crate::ablation::AblationArgs;
use crate::cut::Cutting;
use crate::gpu::{Bias, Filter, Points};
use crate::help::{CHECK_HELP, DRAW_HELP, EXAMPLES, LIGHTS, SWEEP_HELP, WALK_HELP, scenes};
use crate::light::LightSpec;
use crate::picture::CloseUp;
use crate::plan::PlanArgs;
use crate::run::Options;
use crate::slicing::{Slicing, SplitArg};
use crate::technique::Technique;
use crate::trace::Faces;
use crate::values::{
    parse_angle, parse_bias, parse_distance, parse_field_of_view, parse_finite_distance, parse_vector,
};

/// Draws scenes with fitted shadow maps on a graphics card and compares every pixel with ray-traced truth.
///
/// Without a command it checks one scene: every light, with each technique and size of map.
#[derive(Clone, Debug, Parser)]
#[command(name = "render-check", version, max_term_width = 110, args_conflicts_with_subcommands = true)]
#[command(after_help = format!("{EXAMPLES}\n\n{}\n\n{LIGHTS}\n\n{CHECK_HELP}", scenes()))]
pub struct Args {
    /// What to do, if not to check a scene.
    #[command(subcommand)]
    pub command: Option<Command>,

    /// What to check.
    #[command(flatten)]
    pub check: CheckArgs,
}

/// What there is to do besides checking a scene.
#[derive(Clone, Debug, Subcommand)]
pub enum Command {
    /// Fits and draws by ray casting, without a graphics card: H, what the light sees, what the maps hold
    #[command(after_help = format!("{}\n\n{LIGHTS}\n\n{DRAW_HELP}", scenes()))]
    Draw(DrawArgs),
    /// Walks the camera and counts the pixels that flicker
    #[command(after_help = format!("{}\n\n{LIGHTS}\n\n{WALK_HELP}", scenes()))]
    Walk(WalkArgs),
    /// Checks the hard cases, all of them
    #[command(after_help = SWEEP_HELP)]
    Sweep(SweepArgs),
    /// Plans all lights, the least that is enough for each, draws what the plan says and checks it
    #[command(after_help = format!("{}\n\n{LIGHTS}\n\n{}", scenes(), crate::plan::HELP))]
    Plan(PlanArgs),
    /// Draws what a plan leaves out or asks for with it and without it, and holds both against the truth
    #[command(after_help = crate::ablation::HELP)]
    Ablation(AblationArgs),
}

/// A camera before a scene, and its lights.
#[derive(Clone, Debug, clap::Args)]
pub struct ViewArgs {
    /// A binary glTF file, or the name of a built-in scene, see below
    #[arg(value_name = "SCENE", default_value = "chess-board")]
    pub scene: PathBuf,

    /// A light: sun:…, point:… or spot:…, spelled as below; may be given several times
    #[arg(long = "light", value_name = "LIGHT")]
    pub lights: Vec<LightSpec>,

    /// Where the camera is
    #[arg(long, value_name = "X,Y,Z", value_parser = parse_vector, allow_hyphen_values = true)]
    pub eye: Option<DVec3>,

    /// The point the camera looks at; the middle of the scene without it
    #[arg(long, value_name = "X,Y,Z", value_parser = parse_vector, allow_hyphen_values = true, requires = "eye")]
    pub target: Option<DVec3>,

    /// The camera's vertical field of view, in degrees [default: the scene's, else 50]
    #[arg(long, value_name = "DEGREES", value_parser = parse_field_of_view)]
    pub fov: Option<f64>,

    /// The camera's near plane, in world units [default: the scene's, else close to what is in view]
    #[arg(long, value_name = "DISTANCE", value_parser = parse_finite_distance)]
    pub near: Option<f64>,

    /// The camera's far plane, in world units or inf [default: the scene's, else just behind the scene]
    #[arg(long, value_name = "DISTANCE", value_parser = parse_distance)]
    pub far: Option<f64>,

    /// The distance from a lamp at which its shadow map begins, in world units: inside any lampshade, but the smaller it
    /// is, the coarser is depth far from the lamp [default: half of the way to the nearest surface, and at least a thousandth of the scene's diagonal]
    #[arg(long, value_name = "DISTANCE", value_parser = parse_finite_distance)]
    pub lamp_near: Option<f64>,

    /// Width of the camera's image, in pixels
    #[arg(long, value_name = "PIXELS", default_value_t = 960, value_parser = RangedU64ValueParser::<u32>::new().range(16..=8192))]
    pub width: u32,

    /// Height of the camera's image, in pixels
    #[arg(long, value_name = "PIXELS", default_value_t = 600, value_parser = RangedU64ValueParser::<u32>::new().range(16..=8192))]
    pub height: u32,

    /// The directory for what is written, made where it is missing [default: out/SCENE]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

impl ViewArgs {
    /// Width over height of the camera's image.
    #[must_use]
    pub fn aspect(&self) -> f64 {
        f64::from(self.width) / f64::from(self.height)
    }
}

/// How maps are fitted, drawn and read.
#[derive(Clone, Debug, clap::Args)]
pub struct MapArgs {
    /// A way to spread the texels; may be given several times [default: uniform, psm, light-space, best]
    #[arg(long = "technique", value_name = "TECHNIQUE", value_enum)]
    pub techniques: Vec<Technique>,

    /// Texels along each side of a map; may be given several times [default: 1024]
    #[arg(long = "size", value_name = "TEXELS", value_parser = RangedU64ValueParser::<u32>::new().range(16..=16384))]
    pub sizes: Vec<u32>,

    /// Cut the view into so many slices in depth, each with a map of its own; may be given several times. Of stable maps
    /// between the camera's planes, of others between the depths of what may be seen
    #[arg(long, value_name = "COUNT", value_parser = RangedU64ValueParser::<u32>::new().range(1..=Cascades::MAX as u64))]
    pub slices: Vec<u32>,

    /// How depths are shared out among slices: uniform, log, or blended:PART with the logarithmic part
    #[arg(long, value_name = "SPLIT", default_value_t, requires = "slices")]
    pub split: SplitArg,

    /// Bits of depth
    #[arg(long, value_enum, default_value_t = FormatArg::Unorm24)]
    pub format: FormatArg,

    /// Which sides of triangles are drawn into the map, as the light sees them; second draws the far sides of solids and both
    /// sides of sheets, layers the first two surfaces, read halfway between them; neither is given a bias
    #[arg(long, value_enum, default_value_t = Faces::All)]
    pub faces: Faces,

    /// What is drawn into the map for a point of a cloud
    #[arg(long, value_enum, default_value_t = Points::Discs)]
    pub points: Points,

    /// How the map is read: nearest, hardware (2 x 2, blended), pcfN for the mean over N x N texels, or virtualN for the same
    /// with virtual samples, which need no bias on planes
    #[arg(long, value_name = "FILTER", default_value_t = Filter::Nearest)]
    pub filter: Filter,

    /// How casters are cut before they are drawn into paraboloids, which bend lines
    #[arg(long, value_enum, default_value_t = Cutting::Bound)]
    pub cut: Cutting,

    /// Whose clip space the matrix is for; what another API's driver does with it is imitated
    #[arg(long, value_enum, default_value_t = ClipArg::Wgpu)]
    pub clip: ClipArg,

    /// What is added to depth: steps of the format, and times the slope [default: what the filter needs]
    #[arg(long, value_name = "STEPS,SLOPE", value_parser = parse_bias, allow_hyphen_values = true)]
    pub bias: Option<Bias>,
}

impl MapArgs {
    /// The options of every map that is asked for, each drawn so many times.
    #[must_use]
    pub fn options(&self, frames: u32) -> Vec<Options> {
        let techniques = Technique::or_compared(&self.techniques);
        let sizes = if self.sizes.is_empty() { &[1024][..] } else { &self.sizes };
        let slicing = |&count: &u32| Some(Slicing { count: count as usize, split: self.split });
        let slicings = if self.slices.is_empty() { vec![None] } else { self.slices.iter().map(slicing).collect() };
        let of = |map_size: u32, slicing: Option<Slicing>, technique: Technique| Options {
            slicing,
            clip: self.clip,
            format: self.format.into(),
            faces: self.faces,
            filter: self.filter,
            points: self.points,
            cut: self.cut,
            bias: self.bias,
            frames,
            ..Options::new(technique, map_size)
        };
        let mut all = Vec::new();
        for &size in sizes {
            for &slicing in &slicings {
                all.extend(techniques.iter().map(|&technique| of(size, slicing, technique)));
            }
        }
        all
    }
}

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

/// Where to walk.
#[derive(Clone, Debug, clap::Args)]
pub struct WalkArgs {
    /// The camera, the scene, the lights.
    #[command(flatten)]
    pub view: ViewArgs,

    /// The maps.
    #[command(flatten)]
    pub map: MapArgs,

    /// Steps of the walk
    #[arg(long, default_value_t = 24, value_parser = RangedU64ValueParser::<u32>::new().range(1..=10000))]
    pub steps: u32,

    /// How far the camera goes in a step, ahead and half as far aside, in world units
    /// [default: a hundredth of the distance to what is in the middle of the picture]
    #[arg(long, value_name = "DISTANCE", value_parser = parse_finite_distance)]
    pub pace: Option<f64>,

    /// How far the camera turns in a step, in degrees
    #[arg(long, value_name = "DEGREES", default_value_t = 0.25, value_parser = parse_angle, allow_hyphen_values = true)]
    pub turn: f64,
}

/// What to sweep.
#[derive(Clone, Debug, clap::Args)]
pub struct SweepArgs {
    /// Only groups whose name contains this; may be given several times
    #[arg(value_name = "GROUP")]
    pub groups: Vec<String>,

    /// Instead of the groups: a lamp that goes through every object of this scene, at the middle of its largest triangle
    #[arg(long, value_name = "SCENE", conflicts_with = "groups")]
    pub through: Option<PathBuf>,

    /// The directory for sweep.json, made where it is missing
    #[arg(long, value_name = "DIR", default_value = "out/sweep")]
    pub out: PathBuf,
}

/// A depth format, as a word.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum FormatArg {
    /// 16 bits, fixed point
    Unorm16,
    /// 24 bits, fixed point
    Unorm24,
    /// 32 bits, floating point
    Float32,
}

impl From<FormatArg> for DepthFormat {
    fn from(format: FormatArg) -> Self {
        match format {
            FormatArg::Unorm16 => Self::Unorm16,
            FormatArg::Unorm24 => Self::Unorm24,
            FormatArg::Float32 => Self::Float32,
        }
    }
}

/// A clip space, as a word.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum ClipArg {
    /// Depth 0 to 1, y up
    Wgpu,
    /// Depth 1 to 0, y up
    WgpuReversed,
    /// Depth 0 to 1, y down
    Vulkan,
    /// Depth 1 to 0, y down
    VulkanReversed,
    /// Depth -1 to 1, y up, textures from the bottom
    Opengl,
    /// Depth 1 to -1, y up, textures from the bottom
    OpenglReversed,
}

impl From<ClipArg> for ClipSpace {
    fn from(clip: ClipArg) -> Self {
        match clip {
            ClipArg::Wgpu => Self::WGPU,
            ClipArg::WgpuReversed => Self::WGPU.reversed(),
            ClipArg::Vulkan => Self::VULKAN,
            ClipArg::VulkanReversed => Self::VULKAN.reversed(),
            ClipArg::Opengl => Self::OPENGL,
            ClipArg::OpenglReversed => Self::OPENGL.reversed(),
        }
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
        assert!(args.command.is_none());
        let CheckArgs { view, map, narrow, at, close_up, frames } = args.check;
        assert!(
            !narrow
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
            "--slices 0",
            "--slices 9",
            "--slices 2 --split blended",
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
