//! The cases of a sweep, in groups.

use std::path::Path;

use anyhow::{Context, Result};
use clap::ValueEnum as _;
use shadowfit::glam::DVec3;
use shadowfit::{DepthFormat, Origin, View};

use super::IMAGE;
use super::faults::{far_off, faults, from_the_origin};
use super::lights::{NamedLight, lamps_through_the_plane, suns_across, through_the_back};
use super::surfaces::through_surfaces;
use crate::args::ClipArg;
use crate::framing::{Camera, choose_view};
use crate::gpu::{Filter, Points};
use crate::light::LightSpec;
use crate::run::Options;
use crate::scene::{self, LoadedScene};
use crate::slicing::{Slicing, SplitArg};
use crate::technique::Technique;
use crate::trace::{Faces, Tracer};

/// Texels a side of the maps, where their size is not what is swept.
pub(super) const MAP_SIZE: u32 = 512;

/// Cases that belong together.
pub struct Group {
    /// A name without spaces.
    pub name: &'static str,
    /// Makes the cases; an error when a scene has no camera that sees it.
    pub shots: fn() -> Result<Vec<Shot>>,
}

/// One camera before one scene, under some lights, each through some maps.
pub struct Shot {
    /// What is special about it.
    pub name: String,
    /// The scene.
    pub scene: LoadedScene,
    /// The camera.
    pub view: View,
    /// Width and height of the picture, in pixels.
    pub image: [u32; 2],
    /// What the maps' matrices take positions relative to.
    pub origin: Origin,
    /// The lights, and what is special about them.
    pub lights: Vec<NamedLight>,
    /// The maps.
    pub options: Vec<Options>,
}

impl Shot {
    /// How many runs it has.
    #[must_use]
    pub fn runs(&self) -> usize {
        self.lights.len() * self.options.len()
    }

    pub(super) fn with_options(self, options: Vec<Options>) -> Self {
        Self { options, ..self }
    }

    /// With every kind of warp.
    fn warped(self) -> Self {
        self.with_options(Technique::WARPS.map(|technique| Options::new(technique, MAP_SIZE)).to_vec())
    }

    /// And with texels that stay where they are.
    fn and_stable(mut self) -> Self {
        self.options.push(Options::new(Technique::Stable, MAP_SIZE));
        self
    }
}

/// All groups.
pub const GROUPS: [Group; 24] = [
    Group {
        name: "classes-of-suns",
        shots: || Ok(vec![chess_board()?.shot("arc", suns_across)?.warped().and_stable()]),
    },
    Group {
        name: "classes-of-lamps",
        shots: || Ok(vec![chess_board()?.shot("line", lamps_through_the_plane)?.warped()]),
    },
    Group {
        name: "through-the-back",
        shots: || Ok(vec![chess_board()?.shot("viewer's back", through_the_back)?.warped()]),
    },
    Group { name: "behind-the-eye", shots: || Ok(vec![Stand::built_in("behind")?.own_lights("figure")?.warped()]) },
    Group { name: "lights-inside", shots: lights_inside },
    Group { name: "paraboloids", shots: paraboloids },
    Group { name: "flat", shots: flat },
    Group { name: "stable", shots: stable },
    Group { name: "slices", shots: slices },
    Group { name: "far-planes", shots: far_planes },
    Group { name: "scales", shots: scales },
    Group { name: "clip-spaces", shots: || Ok(vec![lit_chess_board()?.with_options(clip_spaces())]) },
    Group { name: "sizes", shots: || Ok(vec![lit_chess_board()?.with_options(sizes())]) },
    Group { name: "filters", shots: || Ok(vec![lit_chess_board()?.with_options(filters())]) },
    Group { name: "street", shots: street },
    Group { name: "leaves", shots: || Ok(vec![Stand::built_in("leaves")?.own_lights("leaves")?]) },
    Group {
        name: "table",
        shots: || Ok(vec![Stand::built_in("table")?.own_lights("table")?.with_options(solids())]),
    },
    Group { name: "open-sheets", shots: open_sheets },
    Group { name: "virtual", shots: virtual_samples },
    Group {
        name: "points",
        shots: || Ok(vec![Stand::built_in("cloud")?.own_lights("cloud")?.with_options(points())]),
    },
    Group { name: "faults", shots: faults },
    Group { name: "far-off", shots: far_off },
    Group { name: "from-the-origin", shots: from_the_origin },
    Group { name: "through-surfaces", shots: through_surfaces },
];

fn chess_board() -> Result<Stand> {
    Stand::built_in("chess-board")
}

fn lit_chess_board() -> Result<Shot> {
    chess_board()?.own_lights("chess board")
}

/// A camera in a scene, before its planes are chosen.
pub(super) struct Stand {
    pub(super) scene: LoadedScene,
    camera: Camera,
}

impl Stand {
    pub(super) fn built_in(name: &str) -> Result<Self> {
        Self::before(scene::load(Path::new(name))?)
    }

    pub(super) fn before(scene: LoadedScene) -> Result<Self> {
        let camera = scene.camera.with_context(|| format!("the scene '{}' has no camera", scene.name))?;
        Ok(Self { scene, camera })
    }

    fn with_planes(mut self, near: f64, far: f64) -> Self {
        (self.camera.near, self.camera.far) = (Some(near), Some(far));
        self
    }

    pub(super) fn shot(self, name: &str, lights: impl FnOnce(&View) -> Vec<NamedLight>) -> Result<Shot> {
        let aspect = f64::from(IMAGE[0]) / f64::from(IMAGE[1]);
        let view = choose_view(&self.camera, aspect, &Tracer::new(&self.scene.mesh)?)?.0;
        let options = Technique::COMPARED.map(|technique| Options::new(technique, MAP_SIZE)).to_vec();
        let (name, lights) = (name.to_owned(), lights(&view));
        Ok(Shot { name, lights, scene: self.scene, view, image: IMAGE, origin: Origin::Eye, options })
    }

    pub(super) fn own_lights(self, name: &str) -> Result<Shot> {
        let lights = self.scene.lights.iter().map(|light| (light.kind().to_owned(), *light)).collect();
        self.shot(name, |_| lights)
    }
}

/// Lamps inside of the scene: out of view, in view, and on the way from one to the other; with one map and with those of
/// a cube's faces, nearest texels and wide filters, which read across the seams.
fn lights_inside() -> Result<Vec<Shot>> {
    let room = Stand::built_in("room")?;
    let own = Stand::built_in("room")?.own_lights("room")?;
    let across = room.shot("a lamp that comes into view", |view| {
        let ahead = view.eye() + 1.5 * view.forward();
        (0..=8)
            .map(|i| {
                let above = 0.25 * f64::from(i);
                let position = ahead + above * view.up();
                (format!("lamp {above} above the axis"), LightSpec::Point { position, range: f64::INFINITY })
            })
            .collect()
    })?;
    let mut options = own.options.clone();
    for filter in [Filter::Nearest, Filter::Pcf(5)] {
        options.extend(Technique::CUBES.map(|technique| Options { filter, ..Options::new(technique, MAP_SIZE) }));
    }
    Ok([own, across].map(|shot| shot.with_options(options.clone())).into())
}

/// Lamps with one paraboloid and with two, cut as they must be; all that reads a map reads across the seam between two.
fn paraboloids() -> Result<Vec<Shot>> {
    let mut options = Vec::new();
    for filter in [Filter::Nearest, Filter::Hardware2x2, Filter::Pcf(5)] {
        let paraboloid = |map_size| Options { filter, ..Options::new(Technique::Paraboloid, map_size) };
        options.extend([paraboloid(MAP_SIZE), paraboloid(2 * MAP_SIZE)]);
    }
    let plain = options[0];
    options.extend([
        Options { clip: ClipArg::VulkanReversed, format: DepthFormat::Float32, ..plain },
        Options { clip: ClipArg::OpenglReversed, format: DepthFormat::Unorm16, ..plain },
        Options { faces: Faces::Second, ..plain },
    ]);
    let lamp = |words: &str, position| (words.to_owned(), LightSpec::Point { position, range: f64::INFINITY });
    let room = Stand::built_in("room")?.shot("room", |_| {
        vec![
            lamp("in its shade", DVec3::new(0.9, 2.3, -1.9)),
            lamp("in view", DVec3::new(0.0, 1.5, -2.5)),
            lamp("level with the table", DVec3::new(-1.2, 0.78, -1.3)),
        ]
    })?;
    let board = chess_board()?.shot("chess board", |_| {
        let aimed = LightSpec::Spot {
            position: DVec3::new(0.0, 3.0, -4.0),
            target: DVec3::new(0.0, 0.0, -4.2),
            cone_degrees: 150.0,
            range: f64::INFINITY,
        };
        vec![lamp("lamp in its midst", DVec3::new(0.5, 1.2, -4.0)), ("wide spot".to_owned(), aimed)]
    })?;
    Ok([room, board].map(|shot| shot.with_options(options.clone())).into())
}

/// Maps that stay put: suns, a spot, a lamp's faces, about the eye and in world space, at home and far from it.
fn stable() -> Result<Vec<Shot>> {
    let wide = Filter::Pcf(5);
    let mut options = Vec::new();
    for technique in [Technique::Stable, Technique::CubeStable] {
        let plain = Options::new(technique, MAP_SIZE);
        options.extend([plain, Options { filter: wide, clip: ClipArg::OpenglReversed, ..plain }]);
    }
    let far = || chess_board().map(|stand| stand.scene.moved(1.0, 1e6 * DVec3::new(1.0, -0.3, 0.7)));
    let shots = [
        lit_chess_board()?,
        Shot { origin: Origin::World, ..chess_board()?.own_lights("chess board in world space")? },
        Stand::before(far()?)?.own_lights("a million away")?,
        Stand::built_in("street")?.own_lights("street")?,
        Stand::built_in("room")?.own_lights("room")?,
    ];
    Ok(shots.map(|shot| shot.with_options(options.clone())).into())
}

/// Two slices to eight, split in every way, of all that is wide and little that is high.
fn slices() -> Result<Vec<Shot>> {
    let mut options = Vec::new();
    for technique in [Technique::Uniform, Technique::Psm, Technique::Best, Technique::Stable] {
        for (count, split) in [
            (2, shadowfit::cascades::SplitScheme::Uniform),
            (3, shadowfit::cascades::SplitScheme::Practical(0.5)),
            (5, shadowfit::cascades::SplitScheme::Logarithmic),
            (8, shadowfit::cascades::SplitScheme::Logarithmic),
        ] {
            let slicing = Some(Slicing { count, split: SplitArg(split) });
            options.push(Options { slicing, ..Options::new(technique, MAP_SIZE / 2) });
        }
    }
    let wide = Filter::Pcf(5);
    options.push(Options { filter: wide, clip: ClipArg::VulkanReversed, ..options[3] });
    let shots = [lit_chess_board()?, Stand::built_in("street")?.own_lights("street")?];
    Ok(shots.map(|shot| shot.with_options(options.clone())).into())
}

/// A street with the near plane a step from the eye, where there is only air, and with it close before what is seen.
fn street() -> Result<Vec<Shot>> {
    let narrowed = || -> Result<Stand> {
        let mut stand = Stand::built_in("street")?;
        stand.camera.near = None;
        Ok(stand)
    };
    Ok(vec![
        Stand::built_in("street")?.own_lights("near plane in the air")?.warped(),
        narrowed()?.own_lights("near plane at what is seen")?.warped(),
    ])
}

/// A plate on which nothing casts, under a high sun, a low one, and a lamp.
fn flat() -> Result<Vec<Shot>> {
    let lights = |_: &View| {
        vec![
            ("high sun".to_owned(), LightSpec::Sun { direction_to_light: DVec3::new(0.2, 1.0, 0.1) }),
            ("low sun".to_owned(), LightSpec::Sun { direction_to_light: DVec3::new(1.0, 0.05, -0.4) }),
            ("sun from straight above".to_owned(), LightSpec::Sun { direction_to_light: DVec3::Y }),
            ("lamp".to_owned(), LightSpec::Point { position: DVec3::new(3.0, 5.0, -2.0), range: f64::INFINITY }),
        ]
    };
    Ok(vec![Stand::built_in("ground")?.shot("plate", lights)?])
}

/// Far planes at infinity and a million units off, near planes a thousandth off.
fn far_planes() -> Result<Vec<Shot>> {
    [("endless", 1.0, f64::INFINITY), ("a million", 1.0, 1e6), ("near and endless", 1e-3, f64::INFINITY)]
        .into_iter()
        .map(|(name, near, far)| chess_board()?.with_planes(near, far).own_lights(name))
        .collect()
}

/// The chess board small, large, and far from the origin.
fn scales() -> Result<Vec<Shot>> {
    let far_off = 1e6 * DVec3::new(1.0, -0.3, 0.7);
    [
        ("a thousandth", 1e-3, DVec3::ZERO),
        ("a million", 1e6, DVec3::ZERO),
        ("a million away", 1.0, far_off),
        ("a thousandth, a thousand away", 1e-3, 1e-3 * far_off),
    ]
    .into_iter()
    .map(|(name, scale, offset)| {
        let moved = chess_board()?.scene.moved(scale, offset);
        Stand::before(moved)?.own_lights(name)
    })
    .collect()
}

/// No warp, a warp along the view, and any warp in any window: enough where warps are not what is swept.
pub(super) const EXTREMES: [Technique; 3] = [Technique::Uniform, Technique::Psm, Technique::Best];

/// Every clip space, fixed and floating point.
fn clip_spaces() -> Vec<Options> {
    let mut all = Vec::new();
    for &clip in ClipArg::value_variants() {
        for format in [DepthFormat::Unorm16, DepthFormat::Unorm24, DepthFormat::Float32] {
            all.extend(EXTREMES.map(|technique| Options { clip, format, ..Options::new(technique, MAP_SIZE) }));
        }
    }
    all
}

/// From 256² to 4096² texels.
fn sizes() -> Vec<Options> {
    let of = |size| Technique::COMPARED.map(|technique| Options::new(technique, size));
    [256, 512, 1024, 2048, 4096].into_iter().flat_map(of).collect()
}

/// Every way to read a map, and to draw it.
fn filters() -> Vec<Options> {
    let mut all = Vec::new();
    for faces in [Faces::All, Faces::Front, Faces::Back] {
        for filter in [Filter::Nearest, Filter::Hardware2x2, Filter::Pcf(3), Filter::Pcf(5)] {
            all.extend(EXTREMES.map(|technique| Options { faces, filter, ..Options::new(technique, MAP_SIZE) }));
        }
    }
    all
}

/// Solids that stand on a floor: the first surface with a bias, the second without, and with virtual samples.
fn solids() -> Vec<Options> {
    let ways =
        [(Faces::All, Filter::Nearest), (Faces::Second, Filter::Nearest), (Faces::Second, Filter::Virtual(2))];
    let of = |map_size| {
        ways.map(|(faces, filter)| Options { faces, filter, ..Options::new(Technique::Uniform, map_size) })
    };
    [512, 256, 128].into_iter().flat_map(of).collect()
}

/// Sheets, which are their own second surface, without a bias: with virtual samples, and between two layers.
fn open_sheets() -> Result<Vec<Shot>> {
    let ways = [(Faces::Second, Filter::Virtual(2)), (Faces::Layers, Filter::Nearest)];
    let of = |technique| ways.map(|(faces, filter)| Options { faces, filter, ..Options::new(technique, MAP_SIZE) });
    let options: Vec<_> = EXTREMES.into_iter().flat_map(of).collect();
    ["ground", "leaves"]
        .into_iter()
        .map(|name| Ok(Stand::built_in(name)?.own_lights(name)?.with_options(options.clone())))
        .collect()
}

/// Virtual samples in every format, in clip spaces reversed and not, on the first surface and on the second.
fn virtual_samples() -> Result<Vec<Shot>> {
    let mut options = Vec::new();
    for clip in [ClipArg::Wgpu, ClipArg::OpenglReversed] {
        for format in [DepthFormat::Unorm16, DepthFormat::Unorm24, DepthFormat::Float32] {
            for (faces, taps) in [(Faces::All, 2), (Faces::All, 3), (Faces::Second, 2), (Faces::Second, 3)] {
                let filter = Filter::Virtual(taps);
                options.push(Options { clip, format, faces, filter, ..Options::new(Technique::Uniform, MAP_SIZE) });
            }
        }
    }
    ["chess-board", "street"]
        .into_iter()
        .map(|name| Ok(Stand::built_in(name)?.own_lights(name)?.with_options(options.clone())))
        .collect()
}

/// A cloud as hexagons and as splats.
fn points() -> Vec<Options> {
    let of = |points| EXTREMES.map(|technique| Options { points, ..Options::new(technique, MAP_SIZE) });
    [Points::Discs, Points::Splats].into_iter().flat_map(of).collect()
}
