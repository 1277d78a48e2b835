//! Triangles on the GPU.

use std::ops::Range;

use anyhow::{Result, ensure};
use shadowfit::glam::DVec3;
use shadowfit::mesh::Solidity;
use wgpu::util::{BufferInitDescriptor, DeviceExt as _};

use super::device::Gpu;
use crate::scene::{Disc, Mesh};

/// The triangles of a mesh in f32, unindexed, so that a vertex index tells the triangle.
#[derive(Debug)]
pub struct Geometry {
    pub(super) buffer: wgpu::Buffer,
    /// The unit normal of each triangle's front face, four floats each.
    pub(super) normals: wgpu::Buffer,
    objects: Vec<(Range<u32>, Solidity)>,
    vertex_count: u32,
    /// The discs that the last triangles belong to: centre, radius, normal, and one float of padding.
    pub(super) discs: wgpu::Buffer,
    first_disc_triangle: u32,
    origin: DVec3,
}

impl Geometry {
    /// The vertex attributes.
    pub(super) const ATTRIBUTES: [wgpu::VertexAttribute; 1] = wgpu::vertex_attr_array![0 => Float32x3];

    /// Uploads a mesh with positions relative to `origin`, in world space. The difference is taken in f64, so that
    /// positions near `origin` keep their precision wherever it is in the world.
    ///
    /// # Errors
    ///
    /// When the GPU cannot hold so many triangles.
    pub fn upload(gpu: &Gpu, mesh: &Mesh, origin: DVec3) -> Result<Self> {
        let corners = mesh.triangles.iter().flatten().map(|&i| mesh.vertices[i as usize] - origin);
        let numbers: Vec<f32> = corners.flat_map(|corner| corner.as_vec3().to_array()).collect();
        let contents: &[u8] = bytemuck::cast_slice(&numbers);
        let most = gpu.device.limits().max_buffer_size;
        ensure!(
            contents.len() as u64 <= most,
            "{} has room for {} triangles, not for {}",
            gpu.name(),
            most / 36,
            mesh.triangles.len()
        );
        let usage = wgpu::BufferUsages::VERTEX;
        let buffer = gpu.guarded("the triangles", || {
            Ok(gpu.device.create_buffer_init(&BufferInitDescriptor { label: None, contents, usage }))
        })?;
        let normals = (0..mesh.triangles.len()).map(|triangle| mesh.face_normal(triangle).as_vec3().extend(0.0));
        let normals: Vec<f32> = normals.flat_map(|normal| normal.to_array()).collect();
        let contents: &[u8] = bytemuck::cast_slice(&normals);
        let usage = wgpu::BufferUsages::STORAGE;
        let normals = gpu.guarded("the triangles' normals", || {
            Ok(gpu.device.create_buffer_init(&BufferInitDescriptor { label: None, contents, usage }))
        })?;
        let discs = mesh.discs.iter().map(|disc| {
            let (centre, normal) = ((disc.centre - origin).as_vec3(), disc.normal.as_vec3());
            [centre.extend(disc.radius as f32).to_array(), normal.extend(0.0).to_array()]
        });
        // A binding cannot be empty.
        let mut discs: Vec<[[f32; 4]; 2]> = discs.collect();
        discs.resize(discs.len().max(1), [[0.0; 4]; 2]);
        let contents = bytemuck::cast_slice(&discs);
        let discs = gpu.guarded("the discs", || {
            Ok(gpu.device.create_buffer_init(&BufferInitDescriptor { label: None, contents, usage }))
        })?;
        let objects = mesh.objects.iter().map(|object| (object.triangles.clone(), object.solidity)).collect();
        let vertex_count = 3 * mesh.triangles.len() as u32;
        let first_disc_triangle = mesh.first_disc_triangle() as u32;
        Ok(Self { buffer, normals, objects, vertex_count, discs, first_disc_triangle, origin })
    }

    /// Splits ranges of triangles into those of ordinary triangles and those of the discs.
    pub(super) fn without_discs(&self, triangles: &[Range<u32>]) -> (Vec<Range<u32>>, Vec<Range<u32>>) {
        let first = self.first_disc_triangle;
        let plain = triangles.iter().map(|range| range.start.min(first)..range.end.min(first));
        let disc = |triangle: u32| triangle.saturating_sub(first) / Disc::TRIANGLES.len() as u32;
        let discs = triangles.iter().map(|range| disc(range.start)..disc(range.end));
        (plain.filter(|range| !range.is_empty()).collect(), discs.filter(|range| !range.is_empty()).collect())
    }

    /// The origin of positions on the GPU, in world space.
    #[must_use]
    pub fn origin(&self) -> DVec3 {
        self.origin
    }

    /// All vertices.
    pub(super) fn vertices(&self) -> Range<u32> {
        0..self.vertex_count
    }

    /// Splits a range of triangles by object, with each object's solidity.
    pub(super) fn objects_in(&self, triangles: &Range<u32>) -> impl Iterator<Item = (Range<u32>, Solidity)> {
        let pieces = self.objects.iter().map(|(object, solidity)| {
            (object.start.max(triangles.start)..object.end.min(triangles.end), *solidity)
        });
        pieces.filter(|(piece, _)| !piece.is_empty())
    }

    /// The vertices of a range of triangles.
    pub(super) fn vertices_of(triangles: &Range<u32>) -> Range<u32> {
        3 * triangles.start..3 * triangles.end
    }
}
