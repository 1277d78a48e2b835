//! The shadow test of every pixel.

use std::fmt;
use std::str::FromStr;
use std::time::Duration;

use anyhow::{Result, bail};
use shadowfit::glam::{Mat4, Vec3};
use shadowfit::{
    ClipSpace,
    depth::ReceiverOffset,
    input::{TextureOrigin, YAxis},
};

use super::device::Gpu;
use super::pass::{FULL_SCREEN, Pass, PipelineKind};
use super::read_back;
use super::shaders::{self, LayoutText};
use super::shadow_map::ShadowMaps;
use super::surfaces::Surfaces;
use crate::maps::Layout;

/// The filter of a shadow map.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Filter {
    /// The nearest texel.
    Nearest,
    /// 2 × 2 texels, compared and interpolated by the comparison sampler.
    Hardware2x2,
    /// The mean over N × N texels, each compared.
    Pcf(u32),
    /// N × N virtual samples: each texel is compared with the depth of the receiver's plane at its centre; 2 × 2
    /// are interpolated, more are averaged.
    Virtual(u32),
}

impl Filter {
    /// The reach of the filter: the largest distance of a texel centre it reads from the point, along each axis, in
    /// texels.
    #[must_use]
    pub fn reach(self) -> f64 {
        match self {
            Self::Nearest => 0.5,
            Self::Hardware2x2 => 1.0,
            Self::Pcf(taps) | Self::Virtual(taps) => 0.5 * f64::from(taps),
        }
    }
}

/// The command line's spelling.
impl fmt::Display for Filter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Nearest => f.write_str("nearest"),
            Self::Hardware2x2 => f.write_str("hardware"),
            Self::Pcf(taps) => write!(f, "pcf{taps}"),
            Self::Virtual(taps) => write!(f, "virtual{taps}"),
        }
    }
}

/// The same spelling: `nearest`, `hardware`, `pcfN` or `virtualN`.
impl FromStr for Filter {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "nearest" => Ok(Self::Nearest),
            "hardware" => Ok(Self::Hardware2x2),
            _ => {
                let taps = |word| text.strip_prefix(word).and_then(|taps| taps.parse().ok());
                match (taps("pcf"), taps("virtual")) {
                    (Some(taps @ 2..=15), _) => Ok(Self::Pcf(taps)),
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

/// The result of a shadow test.
pub struct Shadows {
    /// The lit fraction of each pixel, row by row from the top: 0 in shadow, 1 in light or in the sky.
    pub lit: Vec<f32>,
    /// Pixels where texels disagreed and virtual samples decided.
    pub used_plane: Vec<bool>,
    /// GPU time, where timestamps are supported.
    pub time: Option<Duration>,
}

/// Tests every pixel of a camera's image against the shadow maps of a light. All must have been drawn from geometry
/// with the same origin.
///
/// # Errors
///
/// When the GPU reports an error, for virtual samples of paraboloids, and for filters that cannot test between
/// layers.
pub fn shadow_test(gpu: &Gpu, surfaces: &Surfaces, shadow_maps: &ShadowMaps, filter: Filter) -> Result<Shadows> {
    gpu.guarded("the shadow test", || shadow_test_unguarded(gpu, surfaces, shadow_maps, filter))
}

fn shadow_test_unguarded(
    gpu: &Gpu,
    surfaces: &Surfaces,
    shadow_maps: &ShadowMaps,
    filter: Filter,
) -> Result<Shadows> {
    // The layers of a texture agree in this.
    let reversed = shadow_maps.maps.iter().any(|(map, _)| map.settings().clip().depth.is_reversed());
    let layout = match shadow_maps.maps.first() {
        Some((Layout::Paraboloid(_), _)) => LayoutText::Paraboloid,
        _ => LayoutText::Frustum,
    };
    let behind = shadow_maps.behind.as_ref().map(|behind| &behind.all);
    let (shader, taps) = match (filter, behind) {
        (Filter::Nearest, None) => (shaders::nearest(layout), None),
        (Filter::Hardware2x2, None) => (shaders::hardware(layout), None),
        (Filter::Pcf(taps), None) => (shaders::percentage_closer(layout), Some(taps)),
        (Filter::Virtual(_), None) if layout == LayoutText::Paraboloid => {
            bail!("paraboloids have no virtual samples")
        }
        (Filter::Virtual(taps), None) => (shaders::virtual_samples(), Some(taps)),
        (Filter::Nearest, Some(_)) => (shaders::between_layers(), Some(1)),
        (Filter::Pcf(taps), Some(_)) => (shaders::between_layers(), Some(taps)),
        (Filter::Hardware2x2 | Filter::Virtual(_), Some(_)) => {
            bail!("the middle of two layers is read with nearest or pcfN, not with {filter}")
        }
    };
    let taps = taps.map(|taps| ("taps", f64::from(taps)));
    let mut constants = vec![];
    // Hardware filtering compares in the sampler.
    if filter != Filter::Hardware2x2 {
        constants.push(("reversed", f64::from(u8::from(reversed))));
    }
    constants.extend(taps);
    let format = wgpu::TextureFormat::Rg32Float;
    let pipeline = PipelineKind {
        shader: &shader,
        constants: &constants,
        takes_geometry: false,
        has_fragments: true,
        primitive: wgpu::PrimitiveState::default(),
        depth: None,
        targets: &[format],
    }
    .build(gpu);

    let split = gpu.storage(shadow_maps.split.iter().flat_map(|row| row.to_array()));
    let layers = shadow_maps.maps.iter().map(|(map, receiver)| layer(map, receiver, shadow_maps, filter));
    let layers = gpu.storage(layers.collect::<Result<Vec<_>>>()?.into_iter().flatten());
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
        wgpu::BindingResource::TextureView(&surfaces.positions),
        wgpu::BindingResource::TextureView(&shadow_maps.view),
        split.as_entire_binding(),
        layers.as_entire_binding(),
    ];
    resources.extend(behind.map(wgpu::BindingResource::TextureView));
    match filter {
        Filter::Nearest | Filter::Pcf(_) => {}
        Filter::Hardware2x2 => resources.push(wgpu::BindingResource::Sampler(&sampler)),
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

/// The uniforms of a layer.
fn layer(map: &Layout, receiver: &ReceiverOffset, shadow_maps: &ShadowMaps, filter: Filter) -> Result<Vec<f32>> {
    let sampled = sampled_from_texture(map.settings().clip());
    Ok(match map {
        Layout::Frustum(map) => {
            let matrices = [map.receiver_matrix_with(receiver), sampled];
            let tolerance = map.comparison_tolerance(shadow_maps.format, filter.reach())?;
            matrices.iter().flat_map(Mat4::to_cols_array).chain(tolerance.to_array()).collect()
        }
        Layout::Paraboloid(map) => {
            let mut scale = map.texture_scale();
            // The centre of the disc is the centre of the map, whichever row comes first.
            scale.y *= sampled.y_axis.y;
            map.receiver_matrix_with(receiver).to_cols_array().into_iter().chain(scale.to_array()).collect()
        }
    })
}

/// Converts texture coordinates of an API that counts rows from the bottom to wgpu, which counts them from the top:
/// v becomes 1 − v. If such an API draws with y down, its image is upside down in memory, so that the first row is
/// the top row as in wgpu.
fn sampled_from_texture(clip: ClipSpace) -> Mat4 {
    match (clip.y, clip.texture_origin) {
        (YAxis::Up, TextureOrigin::BottomLeft) => {
            Mat4::from_translation(Vec3::Y) * Mat4::from_scale(Vec3::new(1.0, -1.0, 1.0))
        }
        _ => Mat4::IDENTITY,
    }
}
