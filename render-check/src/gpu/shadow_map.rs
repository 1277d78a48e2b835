//! The shadow maps of a light: casters drawn through the crate's matrices, one texture layer per map.

use std::ops::Range;
use std::time::Duration;

use anyhow::{Context, Result, bail, ensure};
use shadowfit::glam::{DVec3, Mat4, Vec2, Vec3, Vec4};
use shadowfit::{
    ClipSpace, DepthFormat,
    depth::{Culling, ReceiverOffset},
    input::{DepthRange, YAxis},
    omni::Paraboloid,
};

use super::device::Gpu;
use super::geometry::Geometry;
use super::pass::{Pass, PipelineKind, depth_state};
use super::splats::{Points, SplatPass};
use super::{depth_copy, shaders};
use crate::maps::{Layout, Split};
use crate::trace::Faces;

/// The rasteriser's depth bias, away from the light.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Bias {
    /// Constant, in units of the format, see [`DepthFormat::bias_unit`].
    pub constant: i32,
    /// Slope scale: times the larger of the depth's derivatives along rows and columns.
    pub slope: f32,
}

impl Bias {
    /// No bias.
    pub const NONE: Self = Self { constant: 0, slope: 0.0 };

    /// A map's bias as a bias away from the light; the sign for its clip space is applied where it is drawn.
    #[must_use]
    pub const fn away(bias: &shadowfit::depth::DepthBias) -> Self {
        Self { constant: bias.constant.abs(), slope: bias.slope_scale.abs() }
    }
}

/// How casters are drawn into a map.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct MapPass {
    /// The depth buffer's format.
    #[serde(serialize_with = "format_name")]
    pub format: DepthFormat,
    /// Which faces are drawn.
    pub faces: Faces,
    /// The depth bias.
    pub bias: Bias,
    /// The receiver offset towards the light, relative to the map's depth range.
    pub receiver: f64,
    /// Its relative part, see [`ReceiverOffset::relative`].
    pub relative: f64,
    /// How points are drawn. Splats and texels have no faces.
    pub points: Points,
}

impl MapPass {
    /// The same with a bias derived from a map, the receiver's part included.
    #[must_use]
    pub const fn with(self, bias: &shadowfit::depth::DepthBias) -> Self {
        Self { bias: Bias::away(bias), receiver: bias.receiver, relative: bias.relative, ..self }
    }
}

fn format_name<S: serde::Serializer>(format: &DepthFormat, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(&format!("{format:?}").to_lowercase())
}

/// A map to draw.
#[derive(Clone, Copy, Debug)]
pub struct MapDraw<'a> {
    /// The map; the geometry must have been uploaded relative to the origin in its settings.
    pub map: &'a Layout,
    /// The casters, as ranges of the geometry's triangles.
    pub casters: &'a [Range<u32>],
    /// How they are drawn.
    pub pass: MapPass,
}

/// The shadow maps of a light on the GPU, the layers of one array texture.
pub struct ShadowMaps {
    /// The array texture's view.
    pub(super) view: wgpu::TextureView,
    /// The views of its layers.
    layers: Vec<wgpu::TextureView>,
    /// The second surfaces, for maps that are tested between layers.
    pub(super) behind: Option<LayerArray>,
    /// The map of each layer, and its receiver offset.
    pub(super) maps: Vec<(Layout, ReceiverOffset)>,
    pub(super) format: DepthFormat,
    texture_format: wgpu::TextureFormat,
    /// `Split` of `shadow_test.wgsl`, row by row.
    pub(super) split: Vec<Vec4>,
    /// GPU time of all of them when last drawn, where timestamps are supported.
    pub time: Option<Duration>,
}

impl ShadowMaps {
    /// Draws the map of each part of a split; `None` for a part without a map.
    ///
    /// # Errors
    ///
    /// When there is no map; when the maps differ in kind, size, format or clip space, as layers of a texture
    /// cannot; when points are to be splats in a paraboloid; or when the GPU reports an error, as for maps larger
    /// than it supports.
    pub fn draw(gpu: &Gpu, geometry: &Geometry, split: &Split, maps: &[Option<MapDraw<'_>>]) -> Result<Self> {
        ensure!(split.parts() == maps.len(), "a light in {} parts has {} maps", split.parts(), maps.len());
        let drawn: Vec<&MapDraw<'_>> = maps.iter().flatten().collect();
        let first = drawn.first().context("none of the parts of the light needs a map")?;
        let of = |draw: &MapDraw<'_>| {
            let is_frustum = matches!(draw.map, Layout::Frustum(_));
            let has_second = draw.pass.faces == Faces::Layers;
            let settings = draw.map.settings();
            (is_frustum, settings.map_size(), draw.pass.format, settings.clip(), has_second)
        };
        ensure!(
            drawn.iter().all(|draw| of(draw) == of(first)),
            "the maps of a light differ in kind, size or format"
        );
        let (size, largest) = (first.map.settings().map_size(), gpu.largest_texture());
        ensure!(size <= largest, "{} holds maps of {largest} texels a side, not of {size}", gpu.name());
        gpu.guarded("the shadow map", || {
            let format = match first.pass.format {
                DepthFormat::Unorm8 => bail!("no card has a depth buffer of 8 bits"),
                DepthFormat::Unorm16 => wgpu::TextureFormat::Depth16Unorm,
                DepthFormat::Unorm24 => wgpu::TextureFormat::Depth24Plus,
                DepthFormat::Float32 => wgpu::TextureFormat::Depth32Float,
            };
            let array = || LayerArray::new(gpu, size, drawn.len() as u32, format);
            let (nearest, behind) = (array(), (first.pass.faces == Faces::Layers).then(array));
            let receiver = |draw: &MapDraw<'_>| {
                let offset =
                    ReceiverOffset::relative(draw.pass.relative).and_then(|it| it.and_depth(draw.pass.receiver));
                let offset = offset.context("receivers cannot be moved so")?;
                Ok((draw.map.clone(), offset))
            };
            let mut shadow_maps = Self {
                view: nearest.all,
                split: split_rows(split, maps, geometry.origin()),
                layers: nearest.one_by_one,
                behind,
                texture_format: format,
                format: first.pass.format,
                maps: drawn.iter().map(|draw| receiver(draw)).collect::<Result<_>>()?,
                time: None,
            };
            shadow_maps.draw_layers(gpu, geometry, maps)?;
            Ok(shadow_maps)
        })
    }

    /// Draws the same maps again into the same memory, as a renderer does every frame.
    ///
    /// # Errors
    ///
    /// When the number of maps differs, or the GPU reports an error.
    pub fn draw_again(&mut self, gpu: &Gpu, geometry: &Geometry, maps: &[Option<MapDraw<'_>>]) -> Result<()> {
        gpu.guarded("the shadow map", || self.draw_layers(gpu, geometry, maps))
    }

    fn draw_layers(&mut self, gpu: &Gpu, geometry: &Geometry, maps: &[Option<MapDraw<'_>>]) -> Result<()> {
        let (drawn, layers) = (maps.iter().flatten().count(), self.layers.len());
        ensure!(drawn == layers, "{drawn} maps do not go into {layers} layers");
        let mut time = Some(Duration::ZERO);
        for (index, draw) in maps.iter().flatten().enumerate() {
            let target = &self.layers[index];
            let took = draw_layer(gpu, geometry, draw, target, self.texture_format, None)?;
            let again = self.behind.as_ref().map(|layers| &layers.one_by_one[index]);
            let took_again = match again {
                Some(second) => draw_layer(gpu, geometry, draw, second, self.texture_format, Some(target))?,
                None => Some(Duration::ZERO),
            };
            time = time.zip(took).zip(took_again).map(|((sum, took), again)| sum + took + again);
        }
        self.time = time;
        Ok(())
    }

    /// The stored depths of each map's first layer, row by row from the top of the map (y = 1 in wgpu's clip
    /// space).
    ///
    /// # Errors
    ///
    /// When the GPU reports an error.
    pub fn depths(&self, gpu: &Gpu) -> Result<Vec<Vec<f32>>> {
        let depths =
            |(layer, (map, _)): (_, &(Layout, _))| depth_copy::depths(gpu, layer, map.settings().map_size());
        gpu.guarded("the shadow map's depths", || self.layers.iter().zip(&self.maps).map(depths).collect())
    }
}

/// The uniform that selects a point's layer, relative to an origin; −1 for a part without a map.
fn split_rows(split: &Split, maps: &[Option<MapDraw<'_>>], origin: DVec3) -> Vec<Vec4> {
    let (light, ends) = ((split.position() - origin).as_vec3(), split.ends());
    let mut rows = vec![light.extend(if ends.is_some() { 1.0 } else { 0.0 }), split.depth_row(origin).as_vec4()];
    rows.extend(ends.unwrap_or_default().as_chunks().0.iter().copied().map(Vec4::from_array));
    let mut layer = -1.0;
    rows.extend(maps.iter().enumerate().map(|(part, map)| {
        layer += f32::from(u8::from(map.is_some()));
        split.axis(part).as_vec3().extend(if map.is_some() { layer } else { -1.0 })
    }));
    rows
}

/// A texture with a layer for each map.
pub(super) struct LayerArray {
    pub(super) all: wgpu::TextureView,
    pub(super) one_by_one: Vec<wgpu::TextureView>,
}

impl LayerArray {
    fn new(gpu: &Gpu, size: u32, count: u32, format: wgpu::TextureFormat) -> Self {
        let texture = gpu.layers([size, size], count, format);
        let view = |dimension, base_array_layer, array_layer_count| {
            texture.create_view(&wgpu::TextureViewDescriptor {
                dimension: Some(dimension),
                base_array_layer,
                array_layer_count: Some(array_layer_count),
                ..Default::default()
            })
        };
        Self {
            all: view(wgpu::TextureViewDimension::D2Array, 0, count),
            one_by_one: (0..count).map(|layer| view(wgpu::TextureViewDimension::D2, layer, 1)).collect(),
        }
    }
}

/// Draws a map into a layer; where a first layer is given, without its fragments. Returns the GPU time.
fn draw_layer(
    gpu: &Gpu,
    geometry: &Geometry,
    draw: &MapDraw<'_>,
    layer: &wgpu::TextureView,
    format: wgpu::TextureFormat,
    first_layer: Option<&wgpu::TextureView>,
) -> Result<Option<Duration>> {
    let clip = draw.map.settings().clip();
    let reversed = clip.depth.is_reversed();
    let (compare, sign) = match reversed {
        true => (wgpu::CompareFunction::Greater, -1),
        false => (wgpu::CompareFunction::Less, 1),
    };
    let raster_from_clip = raster_from_clip(clip);
    let (mut shader, light, bias): (String, _, _) = match &draw.map {
        Layout::Frustum(map) => {
            let bias = wgpu::DepthBiasState {
                constant: sign * draw.pass.bias.constant,
                slope_scale: sign as f32 * draw.pass.bias.slope,
                clamp: 0.0,
            };
            (shaders::SHADOW_MAP.into(), gpu.uniforms(&[map.caster_matrix(), raster_from_clip]), bias)
        }
        Layout::Paraboloid(map) => {
            let light = gpu.uniforms(&[map.caster_matrix(), raster_from_clip, in_fragments(map, &draw.pass)]);
            (shaders::paraboloid_map(), light, wgpu::DepthBiasState::default())
        }
    };
    let depth = depth_state(format, compare, bias);
    let mut resources = vec![light.as_entire_binding()];
    let mut constants = Vec::new();
    if let Some(first_layer) = first_layer {
        let Layout::Frustum(map) = &draw.map else { bail!("paraboloids have no second layer") };
        ensure!(draw.pass.points == Points::Discs, "between layers points are drawn as discs");
        shader = shaders::second_layer();
        let tolerance = map.comparison_tolerance(draw.pass.format, 0.5)?;
        constants.extend([
            ("constant_tolerance", tolerance.constant),
            ("tolerance_over_w", tolerance.over_w),
            ("most_over_w", tolerance.most),
            ("reversed", f64::from(u8::from(reversed))),
        ]);
        resources.push(wgpu::BindingResource::TextureView(first_layer));
    }
    let (triangles, discs) = match draw.pass.points {
        Points::Discs => (draw.casters.to_vec(), Vec::new()),
        Points::Splats | Points::Texels => geometry.without_discs(draw.casters),
    };
    let mut load = wgpu::LoadOp::Clear(if reversed { 0.0 } else { 1.0 });
    let mut time = Some(Duration::ZERO);
    let mut add = |took: Option<Duration>| time = time.zip(took).map(|(sum, took)| sum + took);
    for (cull_mode, draws) in batches(geometry, &triangles, draw.pass.faces) {
        let pipeline = PipelineKind {
            shader: &shader,
            constants: &constants,
            takes_geometry: true,
            has_fragments: matches!(draw.map, Layout::Paraboloid(_)) || first_layer.is_some(),
            // Front faces of the meshes are counter-clockwise, and the crate's maps do not mirror.
            primitive: wgpu::PrimitiveState { front_face: wgpu::FrontFace::Ccw, cull_mode, ..Default::default() },
            depth: Some(depth.clone()),
            targets: &[],
        }
        .build(gpu);
        let pass = Pass {
            pipeline: &pipeline,
            bindings: &gpu.bindings(&pipeline, &resources),
            colours: &[],
            depth: Some((layer, load)),
            geometry: Some(geometry),
            draws: &draws,
        };
        load = wgpu::LoadOp::Load;
        add(pass.run(gpu)?);
    }
    if !discs.is_empty() {
        ensure!(
            matches!(draw.map, Layout::Frustum(_)),
            "splats are drawn into frusta only: draw the points as discs"
        );
        let size = draw.map.settings().map_size();
        let splats = SplatPass { points: draw.pass.points, size, light: &light, view: layer, depth };
        add(splats.run(gpu, geometry, &discs)?);
    }
    Ok(time)
}

/// The uniforms of a paraboloid's fragments besides its matrix: texture scale, clip scale and bias.
fn in_fragments(map: &Paraboloid, pass: &MapPass) -> Mat4 {
    // As in `DepthBias::in_shader`, for a bias that may come from the command line.
    let constant = f64::from(pass.bias.constant) * *pass.format.bias_unit(1.0).end();
    let (scale, bias) = (map.clip_scale(), Vec2::new(constant as f32, pass.bias.slope));
    Mat4::from_cols(map.texture_scale(), scale.extend(bias.x).extend(bias.y), Vec4::ZERO, Vec4::ZERO)
}

/// The vertices to draw with each kind of culling; at least one batch, perhaps empty, so that the map is cleared.
fn batches(
    geometry: &Geometry,
    casters: &[Range<u32>],
    faces: Faces,
) -> Vec<(Option<wgpu::Face>, Vec<Range<u32>>)> {
    let objects: Vec<_> = casters.iter().flat_map(|triangles| geometry.objects_in(triangles)).collect();
    let kinds =
        [(Culling::None, None), (Culling::Front, Some(wgpu::Face::Front)), (Culling::Back, Some(wgpu::Face::Back))];
    let of = |(culling, cull_mode)| {
        let drawn = objects.iter().filter(|(_, solidity)| faces.culling(*solidity) == culling);
        (cull_mode, drawn.map(|(triangles, _)| Geometry::vertices_of(triangles)).collect::<Vec<_>>())
    };
    let mut batches = Vec::from(kinds.map(of));
    batches.sort_by_key(|(_, draws)| draws.is_empty());
    let needed = batches.iter().filter(|(_, draws)| !draws.is_empty()).count().max(1);
    batches.truncate(needed);
    batches
}

/// The viewport transform of other APIs: OpenGL maps depth from −1…1 to 0…1, and where y points down the rasteriser
/// flips it.
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
