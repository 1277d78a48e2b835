//! The camera pass: visible surfaces.

use std::time::Duration;

use anyhow::Result;
use shadowfit::View;
use shadowfit::glam::{DMat4, DVec3, DVec4};

use super::device::Gpu;
use super::geometry::Geometry;
use super::pass::{Pass, PipelineKind, depth_state};
use super::{read_back, shaders};

/// The visible surface of each pixel: positions are kept on the GPU, relative to the origin of the casters'
/// geometry; triangle indices are read back.
pub struct Surfaces {
    pub(super) size: [u32; 2],
    pub(super) positions: wgpu::TextureView,
    /// The triangle of each pixel, counted from 1; 0 where there is none.
    pub(super) numbers: wgpu::TextureView,
    /// The triangles' normals.
    pub(super) normals: wgpu::Buffer,
    /// The camera's depth buffer: 1 at its near plane, 0 at its far plane and in the sky.
    pub(super) depths: wgpu::TextureView,
    /// The triangle of each pixel, row by row from the top; [`Surfaces::SKY`] where there is none.
    pub triangles: Vec<u32>,
    /// GPU time, where timestamps are supported.
    pub time: Option<Duration>,
}

impl Surfaces {
    /// The triangle index of a pixel without a surface.
    pub const SKY: u32 = u32::MAX;

    /// Draws all triangles from a camera into an image of this size.
    ///
    /// # Errors
    ///
    /// When the GPU reports an error, as for images larger than it supports.
    pub fn draw(gpu: &Gpu, geometry: &Geometry, view: &View, size: [u32; 2]) -> Result<Self> {
        Self::draw_about(gpu, geometry, view, size, geometry.origin())
    }

    /// The same with positions relative to another origin, rounded to f32 there, for maps of geometry with that
    /// origin.
    ///
    /// # Errors
    ///
    /// As for [`Self::draw`].
    pub fn draw_about(gpu: &Gpu, geometry: &Geometry, view: &View, size: [u32; 2], origin: DVec3) -> Result<Self> {
        gpu.guarded("the camera's view", || Self::draw_unguarded(gpu, geometry, view, size, origin))
    }

    fn draw_unguarded(gpu: &Gpu, geometry: &Geometry, view: &View, size: [u32; 2], origin: DVec3) -> Result<Self> {
        // Reversed depth in f32 resolves far surfaces as well as near ones.
        let depth_format = wgpu::TextureFormat::Depth32Float;
        let formats = [wgpu::TextureFormat::Rgba32Float, wgpu::TextureFormat::R32Uint];
        let pipeline = PipelineKind {
            shader: shaders::SURFACES,
            constants: &[],
            takes_geometry: true,
            has_fragments: true,
            primitive: wgpu::PrimitiveState::default(),
            depth: Some(depth_state(depth_format, wgpu::CompareFunction::Greater, Default::default())),
            targets: &formats,
        }
        .build(gpu);
        let from_origin = DMat4::from_translation(geometry.origin());
        let to_tested = DMat4::from_translation(geometry.origin() - origin);
        let camera = gpu.uniforms(&[(reversed_clip_from_world(view) * from_origin).as_mat4(), to_tested.as_mat4()]);
        let [(_, positions), (triangles, triangles_view)] = formats.map(|format| gpu.target(size, format));
        let (_, depths) = gpu.target(size, depth_format);
        let pass = Pass {
            pipeline: &pipeline,
            bindings: &gpu.bindings(&pipeline, &[camera.as_entire_binding()]),
            colours: &[&positions, &triangles_view],
            depth: Some((&depths, wgpu::LoadOp::Clear(0.0))),
            geometry: Some(geometry),
            draws: &[geometry.vertices()],
        };
        let time = pass.run(gpu)?;
        // Cleared pixels hold zero, so triangle indices on the GPU are one higher.
        let numbers: Vec<u32> = read_back::texels(gpu, &triangles)?;
        let triangles = numbers.into_iter().map(|number| number.wrapping_sub(1)).collect();
        let normals = geometry.normals.clone();
        Ok(Self { size, positions, numbers: triangles_view, normals, depths, triangles, time })
    }
}

/// World space to a clip space with depth 1 at the near plane and 0 at the far plane.
fn reversed_clip_from_world(view: &View) -> DMat4 {
    let reverse = DMat4::from_translation(0.5 * DVec3::Z) * DMat4::from_diagonal(DVec4::new(1.0, 1.0, -0.5, 1.0));
    reverse * view.clip_from_world()
}
