//! The shadow test of every pixel.

use std::fmt;
use std::str::FromStr;
use std::time::Duration;

use anyhow::Result;
use shadowfit::glam::{Mat4, Vec3};
use shadowfit::{ClipSpace, TextureOrigin, YAxis};

use super::pass::{FULL_SCREEN, Pass, PipelineKind};
use super::{Gpu, ShadowMap, Surfaces, read_back, shaders};

/// How a shadow map is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Filter {
    /// The one texel that a point lies in.
    Nearest,
    /// The four texels around it, compared and blended by the sampler.
    Hardware,
    /// The mean over so many texels across and down, each compared.
    PercentageCloser(u32),
    /// So many texels across and down, each compared with the depth of the surface's own plane at its middle; two are
    /// blended, of more it is the mean.
    Virtual(u32),
}

impl Filter {
    /// How far from a point the middles of the texels lie that are read for it, at most, across and down, in texels.
    #[must_use]
    pub fn reach(self) -> f64 {
        match self {
            Self::Nearest => 0.5,
            Self::Hardware => 1.0,
            Self::PercentageCloser(taps) | Self::Virtual(taps) => 0.5 * f64::from(taps),
        }
    }
}

/// The word that the command line takes.
impl fmt::Display for Filter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Nearest => f.write_str("nearest"),
            Self::Hardware => f.write_str("hardware"),
            Self::PercentageCloser(taps) => write!(f, "pcf{taps}"),
            Self::Virtual(taps) => write!(f, "virtual{taps}"),
        }
    }
}

/// The same word: `nearest`, `hardware`, or `pcfN` or `virtualN` for N × N texels.
impl FromStr for Filter {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "nearest" => Ok(Self::Nearest),
            "hardware" => Ok(Self::Hardware),
            _ => {
                let taps = |word| text.strip_prefix(word).and_then(|taps| taps.parse().ok());
                match (taps("pcf"), taps("virtual")) {
                    (Some(taps @ 2..=15), _) => Ok(Self::PercentageCloser(taps)),
                    (_, Some(taps @ 1..=15)) => Ok(Self::Virtual(taps)),
                    _ => {
                        Err("write nearest, hardware, pcfN with N from 2 to 15, or virtualN with N from 1 to 15"
                            .into())
                    }
                }
            }
        }
    }
}

impl serde::Serialize for Filter {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

/// What came of a shadow test.
pub struct Shadows {
    /// The share of light that reaches each pixel, row by row from the top: 0 in shadow, 1 in light or in the sky.
    pub lit: Vec<f32>,
    /// Where virtual samples decided, as the texels disagreed.
    pub used_plane: Vec<bool>,
    /// How long the card took, where it has a clock.
    pub time: Option<Duration>,
}

/// Tests every pixel of a camera's image against a shadow map. Both must have been drawn from the same geometry, or
/// from geometries with the same origin.
///
/// # Errors
///
/// When the card refuses.
pub fn shadow_test(gpu: &Gpu, surfaces: &Surfaces, shadow_map: &ShadowMap, filter: Filter) -> Result<Shadows> {
    gpu.guarded("the shadow test", || shadow_test_unguarded(gpu, surfaces, shadow_map, filter))
}

fn shadow_test_unguarded(
    gpu: &Gpu,
    surfaces: &Surfaces,
    shadow_map: &ShadowMap,
    filter: Filter,
) -> Result<Shadows> {
    let clip = shadow_map.map.settings().clip();
    let reversed = clip.depth.is_reversed();
    let (shader, taps) = match filter {
        Filter::Nearest => (shaders::nearest(), None),
        Filter::Hardware => (shaders::hardware(), None),
        Filter::PercentageCloser(taps) => (shaders::percentage_closer(), Some(("taps", f64::from(taps)))),
        Filter::Virtual(taps) => (shaders::virtual_samples(), Some(("taps", f64::from(taps)))),
    };
    let mut constants = vec![];
    // The hardware's comparison is the sampler's own.
    if filter != Filter::Hardware {
        constants.push(("reversed", f64::from(u8::from(reversed))));
    }
    constants.extend(taps);
    if let Filter::Virtual(_) = filter {
        constants.push(("tolerance", shadow_map.map.comparison_tolerance(shadow_map.format)));
    }
    let format = wgpu::TextureFormat::Rg32Float;
    let pipeline = PipelineKind {
        shader: &shader,
        constants: &constants,
        takes_geometry: false,
        primitive: wgpu::PrimitiveState::default(),
        depth: None,
        targets: &[format],
    }
    .build(gpu);

    let receiver = gpu.uniforms(&[shadow_map.map.texture_matrix(), sampled_from_texture(clip)]);
    let sampler = gpu.device.create_sampler(&wgpu::SamplerDescriptor {
        mag_filter: wgpu::FilterMode::Linear,
        min_filter: wgpu::FilterMode::Linear,
        compare: Some(match reversed {
            true => wgpu::CompareFunction::GreaterEqual,
            false => wgpu::CompareFunction::LessEqual,
        }),
        ..Default::default()
    });
    let mut resources = vec![
        receiver.as_entire_binding(),
        wgpu::BindingResource::TextureView(&surfaces.positions),
        wgpu::BindingResource::TextureView(&shadow_map.view),
    ];
    match filter {
        Filter::Nearest | Filter::PercentageCloser(_) => {}
        Filter::Hardware => resources.push(wgpu::BindingResource::Sampler(&sampler)),
        Filter::Virtual(_) => resources
            .extend([wgpu::BindingResource::TextureView(&surfaces.numbers), surfaces.normals.as_entire_binding()]),
    }
    let (lit, lit_view) = gpu.target(surfaces.size, format);
    let pass = Pass {
        pipeline: &pipeline,
        bindings: &gpu.bindings(&pipeline, &resources),
        colours: &[&lit_view],
        depth: None,
        geometry: None,
        draws: &[FULL_SCREEN],
    };
    let time = pass.run(gpu)?;
    let texels: Vec<[f32; 2]> = read_back::texels(gpu, &lit)?;
    let (lit, used_plane) = texels.into_iter().map(|[lit, used_plane]| (lit, used_plane > 0.0)).unzip();
    Ok(Shadows { lit, used_plane, time })
}

/// From an API that counts texture rows from the bottom to wgpu, which counts them from the top: there the same row of
/// the map is read at 1 − v. An image that such an API draws with y down is upside down in its memory, where the first
/// row then is the top one, as in wgpu's.
fn sampled_from_texture(clip: ClipSpace) -> Mat4 {
    match (clip.y, clip.texture_origin) {
        (YAxis::Up, TextureOrigin::BottomLeft) => {
            Mat4::from_translation(Vec3::Y) * Mat4::from_scale(Vec3::new(1.0, -1.0, 1.0))
        }
        _ => Mat4::IDENTITY,
    }
}
