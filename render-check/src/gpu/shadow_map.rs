//! The shadow map: casters, drawn through the matrix that the crate gives.

use std::ops::Range;
use std::time::Duration;

use anyhow::{Result, ensure};
use shadowfit::glam::{Mat4, Vec3};
use shadowfit::{ClipSpace, DepthFormat, DepthRange, Map, YAxis};

use super::pass::{Pass, PipelineKind, depth_state};
use super::splats::{Points, SplatPass};
use super::{Geometry, Gpu, read_back, shaders};
use crate::trace::Faces;

/// What the rasteriser adds to depth, away from the light.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Bias {
    /// In steps of the format, see [`Bias::steps`].
    pub constant: i32,
    /// Times the greater change of depth from texel to texel, across and down.
    pub slope: f32,
}

impl Bias {
    /// No bias.
    pub const NONE: Self = Self { constant: 0, slope: 0.0 };

    /// The depth of one step. In fixed point a driver may take twice the format's own step for one (Mesa's software
    /// driver does); in floating point it is that of the greatest depth of the triangle, here between a quarter, below
    /// which a map holds little, and 2, which a triangle that reaches out of the map can have.
    #[must_use]
    pub fn steps(format: DepthFormat) -> Steps {
        match format {
            DepthFormat::Unorm16 | DepthFormat::Unorm24 => {
                Steps { least: format.step(1.0), most: 2.0 * format.step(1.0) }
            }
            DepthFormat::Float32 => Steps { least: 2_f64.powi(-25), most: 2_f64.powi(-23) },
        }
    }
}

/// What one step of bias may be, in depth, where the map's depth range is 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Steps {
    /// At least.
    pub least: f64,
    /// At most.
    pub most: f64,
}

/// How casters are drawn into a map.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct MapPass {
    /// The depth buffer's format.
    #[serde(serialize_with = "format_name")]
    pub format: DepthFormat,
    /// Which sides are drawn.
    pub faces: Faces,
    /// What is added to depth.
    pub bias: Bias,
    /// What is drawn for points. Splats and texels have no sides.
    pub points: Points,
}

fn format_name<S: serde::Serializer>(format: &DepthFormat, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(&format!("{format:?}").to_lowercase())
}

/// A shadow map on the card.
pub struct ShadowMap {
    pub(super) view: wgpu::TextureView,
    pub(super) map: Map,
    /// How long the card took, where it has a clock.
    pub time: Option<Duration>,
}

impl ShadowMap {
    /// Draws ranges of the geometry's triangles into a map.
    ///
    /// The map's matrix takes positions relative to what its settings say; the geometry must have been uploaded
    /// relative to the same.
    ///
    /// # Errors
    ///
    /// When the card refuses, as it does maps larger than it can hold.
    pub fn draw(
        gpu: &Gpu,
        geometry: &Geometry,
        casters: &[Range<u32>],
        map: &Map,
        options: &MapPass,
    ) -> Result<Self> {
        let (size, largest) = (map.settings().map_size(), gpu.largest_texture());
        ensure!(size <= largest, "{} holds maps of {largest} texels a side, not of {size}", gpu.name());
        gpu.guarded("the shadow map", || Self::draw_unguarded(gpu, geometry, casters, map, options))
    }

    fn draw_unguarded(
        gpu: &Gpu,
        geometry: &Geometry,
        casters: &[Range<u32>],
        map: &Map,
        options: &MapPass,
    ) -> Result<Self> {
        let clip = map.settings().clip();
        let reversed = clip.depth.is_reversed();
        let format = match options.format {
            DepthFormat::Unorm16 => wgpu::TextureFormat::Depth16Unorm,
            DepthFormat::Unorm24 => wgpu::TextureFormat::Depth24Plus,
            DepthFormat::Float32 => wgpu::TextureFormat::Depth32Float,
        };
        let (compare, sign) = match reversed {
            true => (wgpu::CompareFunction::Greater, -1),
            false => (wgpu::CompareFunction::Less, 1),
        };
        let bias = wgpu::DepthBiasState {
            constant: sign * options.bias.constant,
            slope_scale: sign as f32 * options.bias.slope,
            clamp: 0.0,
        };
        let depth = depth_state(format, compare, bias);
        let pipeline = PipelineKind {
            shader: shaders::SHADOW_MAP,
            constants: &[],
            takes_geometry: true,
            primitive: wgpu::PrimitiveState {
                // The meshes' fronts are counter-clockwise, and the crate's maps mirror nothing.
                front_face: wgpu::FrontFace::Ccw,
                cull_mode: match options.faces {
                    Faces::All => None,
                    Faces::Front => Some(wgpu::Face::Back),
                    Faces::Back => Some(wgpu::Face::Front),
                },
                ..Default::default()
            },
            depth: Some(depth.clone()),
            targets: &[],
        }
        .build(gpu);
        let light = gpu.uniforms(&[map.matrix(), raster_from_clip(clip)]);
        let size = map.settings().map_size();
        let (_, view) = gpu.target([size, size], format);
        let (triangles, discs) = match options.points {
            Points::Discs => (casters.to_vec(), Vec::new()),
            Points::Splats | Points::Texels => geometry.without_discs(casters),
        };
        let draws: Vec<Range<u32>> = triangles.iter().map(Geometry::vertices_of).collect();
        let pass = Pass {
            pipeline: &pipeline,
            bindings: &gpu.bindings(&pipeline, &[light.as_entire_binding()]),
            colours: &[],
            depth: Some((&view, wgpu::LoadOp::Clear(if reversed { 0.0 } else { 1.0 }))),
            geometry: Some(geometry),
            draws: &draws,
        };
        let mut time = pass.run(gpu)?;
        if !discs.is_empty() {
            let splats = SplatPass { points: options.points, size, light: &light, view: &view, depth };
            let more = splats.run(gpu, geometry, &discs)?;
            time = time.zip(more).map(|(triangles, discs)| triangles + discs);
        }
        Ok(Self { view, map: *map, time })
    }

    /// The depths as they are stored, row by row from the top of the map (y = 1 in wgpu's clip space).
    ///
    /// # Errors
    ///
    /// When the card refuses.
    pub fn depths(&self, gpu: &Gpu) -> Result<Vec<f32>> {
        gpu.guarded("the shadow map's depths", || {
            read_back::depths(gpu, &self.view, self.map.settings().map_size())
        })
    }
}

/// What the driver of another API does with its clip space: OpenGL's brings depth from −1…1 to 0…1, and where y points
/// down the rasteriser turns it round.
fn raster_from_clip(clip: ClipSpace) -> Mat4 {
    let halves_depth = matches!(clip.depth, DepthRange::NegativeOneToOne | DepthRange::NegativeOneToOneReversed);
    let depth = if halves_depth {
        Mat4::from_translation(0.5 * Vec3::Z) * Mat4::from_scale(Vec3::new(1.0, 1.0, 0.5))
    } else {
        Mat4::IDENTITY
    };
    match clip.y {
        YAxis::Up => depth,
        YAxis::Down => Mat4::from_scale(Vec3::new(1.0, -1.0, 1.0)) * depth,
    }
}
