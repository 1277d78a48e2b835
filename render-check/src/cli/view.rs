//! Options for scene, lights and camera.

use std::path::PathBuf;

use clap::builder::RangedU64ValueParser;
use shadowfit::glam::DVec3;

use super::values::{parse_distance, parse_field_of_view, parse_finite_distance};
use crate::scene::{LightSpec, parse_vector};
use crate::stage::CameraRequest;

/// Scene, lights and camera.
#[derive(Clone, Debug, clap::Args)]
pub struct ViewArgs {
    /// A binary glTF file, or the name of a built-in scene (see below)
    #[arg(value_name = "SCENE", default_value = "chess-board")]
    pub scene: PathBuf,

    /// A light: sun:…, point:… or spot:… (see below); may be given several times
    #[arg(long = "light", value_name = "LIGHT")]
    pub lights: Vec<LightSpec>,

    /// Position of the camera
    #[arg(long, value_name = "X,Y,Z", value_parser = parse_vector, allow_hyphen_values = true)]
    pub eye: Option<DVec3>,

    /// The point the camera looks at [default: the middle of the scene]
    #[arg(long, value_name = "X,Y,Z", value_parser = parse_vector, allow_hyphen_values = true, requires = "eye")]
    pub target: Option<DVec3>,

    /// The camera's vertical field of view, in degrees [default: the scene's, else 50]
    #[arg(long, value_name = "DEGREES", value_parser = parse_field_of_view)]
    pub fov: Option<f64>,

    /// The camera's near plane, in world units [default: the scene's, else half the depth of the nearest surface in
    /// view]
    #[arg(long, value_name = "DISTANCE", value_parser = parse_finite_distance)]
    pub near: Option<f64>,

    /// The camera's far plane, in world units or inf [default: the scene's, else just beyond the scene]
    #[arg(long, value_name = "DISTANCE", value_parser = parse_distance)]
    pub far: Option<f64>,

    /// Near plane of point and spot lights, in world units; it must be nearer than any caster, but the smaller it
    /// is, the coarser is depth far from the light [default: half the distance to the nearest surface, and at least
    /// a thousandth of the scene's diagonal]
    #[arg(long, value_name = "DISTANCE", value_parser = parse_finite_distance)]
    pub lamp_near: Option<f64>,

    /// Width of the camera's image, in pixels
    #[arg(long, value_name = "PIXELS", default_value_t = 960, value_parser = RangedU64ValueParser::<u32>::new().range(16..=8192))]
    pub width: u32,

    /// Height of the camera's image, in pixels
    #[arg(long, value_name = "PIXELS", default_value_t = 600, value_parser = RangedU64ValueParser::<u32>::new().range(16..=8192))]
    pub height: u32,

    /// Output directory, created where it is missing [default: out/SCENE]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

impl ViewArgs {
    /// Width over height of the camera's image.
    #[must_use]
    pub fn aspect(&self) -> f64 {
        f64::from(self.width) / f64::from(self.height)
    }

    /// The camera options.
    #[must_use]
    pub fn camera(&self) -> CameraRequest {
        let Self { eye, target, fov, near, far, .. } = *self;
        CameraRequest { eye, target, fov, near, far }
    }
}
