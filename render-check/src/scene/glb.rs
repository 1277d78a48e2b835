//! Binary glTF: triangles, points, node transforms, cameras and punctual lights. Textures, skins and animations are ignored.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result, anyhow, bail, ensure};
use gltf::json::validation::Checked;
use gltf::khr_lights_punctual::Kind;
use gltf::mesh::Mode;
use gltf::scene::Transform;
use gltf::{Document, Gltf, Node, Primitive, Semantic};
use shadowfit::glam::{DMat4, DQuat, DVec3, Vec3};

use super::accessor::{read_indices, read_vectors};
use super::loaded::LoadedScene;
use super::mesh::{MeshBuilder, Part};
use crate::scene::{Camera, LightSpec};

/// Loads a file.
pub(super) fn load(path: &Path) -> Result<LoadedScene> {
    let name = path.file_stem().map_or_else(|| "scene".into(), |stem| stem.to_string_lossy().into_owned());
    let bytes = fs::read(path).with_context(|| format!("cannot read the scene file '{}'", path.display()))?;
    parse(&bytes, name).with_context(|| format!("'{}' is not a scene that can be used", path.display()))
}

/// Reads the bytes of a file.
pub(super) fn parse(bytes: &[u8], name: String) -> Result<LoadedScene> {
    ensure!(bytes.starts_with(b"glTF"), "it is not binary glTF: export it as .glb");
    let stated_length = bytes.get(8..12).and_then(|b| b.try_into().ok()).map_or(0, u32::from_le_bytes) as usize;
    ensure!(
        (12..=bytes.len()).contains(&stated_length),
        "it should be {stated_length} bytes long but is {}: fetch or export it again",
        bytes.len()
    );
    let file = read_description(bytes).map_err(first_complaint)?;

    let mut loader = Loader {
        binary: file.blob.as_deref().unwrap_or_default(),
        lenses: camera_lenses(&file),
        seen: vec![false; file.nodes().len()],
        builder: MeshBuilder::default(),
        camera: None,
        lights: Vec::new(),
    };
    // A file without a default scene is a library: show all of it.
    let roots: Vec<Node> = match file.default_scene().or_else(|| file.scenes().next()) {
        Some(scene) => scene.nodes().collect(),
        None => file.nodes().collect(),
    };
    let is_child = children_of_others(&file);
    let mut to_visit: Vec<(Node, DMat4)> = match file.scenes().len() {
        0 => roots.into_iter().filter(|node| !is_child[node.index()]).map(|node| (node, DMat4::IDENTITY)).collect(),
        _ => roots.into_iter().map(|node| (node, DMat4::IDENTITY)).collect(),
    };
    to_visit.reverse();
    while let Some((node, world_from_parent)) = to_visit.pop() {
        let world_from_node = world_from_parent * local_matrix(&node);
        loader.visit(&node, world_from_node)?;
        let children: Vec<Node> = node.children().collect();
        to_visit.extend(children.into_iter().rev().map(|child| (child, world_from_node)));
    }

    let Loader { builder, camera, lights, .. } = loader;
    let (mesh, left_out) = builder.finish();
    Ok(LoadedScene { name, mesh, camera, lights, left_out })
}

/// Reads and validates a file. `Gltf::from_slice` would do both, but its validation panics on position accessors
/// that do not exist, so these are checked first.
fn read_description(bytes: &[u8]) -> Result<Gltf, gltf::Error> {
    let unchecked = Gltf::from_slice_without_validation(bytes)?;
    let description = unchecked.document.as_json();
    for (mesh, primitive) in
        description.meshes.iter().flat_map(|mesh| mesh.primitives.iter().map(move |p| (mesh, p)))
    {
        let position = primitive.attributes.get(&Checked::Valid(Semantic::Positions));
        if position.is_some_and(|accessor| accessor.value() >= description.accessors.len()) {
            let mesh = mesh.name.clone().unwrap_or_default();
            let path = gltf::json::Path::new().field("meshes").key(&mesh).field("POSITION");
            return Err(gltf::Error::Validation(vec![(path, gltf::json::validation::Error::IndexOutOfBounds)]));
        }
    }
    let blob = unchecked.blob;
    Ok(Gltf { document: Document::from_json(unchecked.document.into_json())?, blob })
}

/// A file that breaks one rule often breaks it thousands of times.
fn first_complaint(error: gltf::Error) -> anyhow::Error {
    match error {
        gltf::Error::Validation(all) => match all.first() {
            Some((path, complaint)) => {
                anyhow!("it breaks the rules of glTF: {complaint} at {path}")
            }
            None => anyhow!("it breaks the rules of glTF"),
        },
        gltf::Error::Deserialize(error) => anyhow!("its description is broken: {error}"),
        other => anyhow!("{other}"),
    }
}

fn children_of_others(file: &Gltf) -> Vec<bool> {
    let mut is_child = vec![false; file.nodes().len()];
    for child in file.nodes().flat_map(|node| node.children().collect::<Vec<_>>()) {
        is_child[child.index()] = true;
    }
    is_child
}

fn local_matrix(node: &Node) -> DMat4 {
    match node.transform() {
        Transform::Matrix { matrix } => DMat4::from_cols_array_2d(&matrix.map(|column| column.map(f64::from))),
        Transform::Decomposed { translation, rotation, scale } => {
            // Quaternions in files are only approximately of unit length; a zero quaternion counts as the identity.
            let [x, y, z, w] = rotation.map(f64::from);
            let length = DVec3::new(x, y, z).length().hypot(w);
            let rotation = if length > 0.0 { DQuat::from_xyzw(x, y, z, w) / length } else { DQuat::IDENTITY };
            DMat4::from_scale_rotation_translation(double(scale), rotation, double(translation))
        }
    }
}

fn double(v: [f32; 3]) -> DVec3 {
    Vec3::from_array(v).as_dvec3()
}

struct Loader<'a> {
    binary: &'a [u8],
    lenses: Vec<Option<CameraLens>>,
    /// A node visited twice has two parents, or is its own ancestor.
    seen: Vec<bool>,
    builder: MeshBuilder,
    camera: Option<Camera>,
    lights: Vec<LightSpec>,
}

impl Loader<'_> {
    fn visit(&mut self, node: &Node, world_from_node: DMat4) -> Result<()> {
        if std::mem::replace(&mut self.seen[node.index()], true) {
            bail!("its nodes are not a tree: node {} has more than one parent", node.index());
        }
        if let Some(mesh) = node.mesh() {
            for primitive in mesh.primitives() {
                self.add_primitive(&primitive, world_from_node)
                    .with_context(|| format!("mesh {}, primitive {}", mesh.index(), primitive.index()))?;
            }
        }
        if let Some(camera) = node.camera() {
            match (&self.camera, self.lenses[camera.index()].and_then(|lens| camera_at(world_from_node, lens))) {
                (None, Some(camera)) => self.camera = Some(camera),
                _ => self.builder.left_out.cameras += 1,
            }
        }
        if let Some(light) = node.light() {
            match light_at(world_from_node, &light) {
                Some(light) => self.lights.push(light),
                None => self.builder.left_out.lights += 1,
            }
        }
        Ok(())
    }

    fn add_primitive(&mut self, primitive: &Primitive, world_from_node: DMat4) -> Result<()> {
        let mode = primitive.mode();
        if !matches!(mode, Mode::Triangles | Mode::Points) {
            self.builder.left_out.other_primitives += 1;
            return Ok(());
        }
        let Some(positions) = primitive.get(&Semantic::Positions) else {
            bail!("it has no positions");
        };
        let positions: Vec<DVec3> =
            read_vectors(&positions, self.binary).context("positions")?.into_iter().map(double).collect();
        let [red, green, blue, _] = primitive.material().pbr_metallic_roughness().base_color_factor();
        let colour = [red, green, blue];
        let normals: Vec<Vec3> = match primitive.get(&Semantic::Normals) {
            Some(normals) => {
                read_vectors(&normals, self.binary).context("normals")?.into_iter().map(Vec3::from_array).collect()
            }
            None => Vec::new(),
        };
        ensure!(
            normals.is_empty() || normals.len() == positions.len(),
            "there are {} normals for {} positions",
            normals.len(),
            positions.len()
        );
        let indices: Vec<u32> = match primitive.indices() {
            Some(indices) => read_indices(&indices, self.binary).context("indices")?,
            None => (0..positions.len() as u32).collect(),
        };
        if mode == Mode::Points {
            let points: Vec<DVec3> = indices.iter().filter_map(|&i| positions.get(i as usize).copied()).collect();
            self.builder.left_out.points += indices.len() - points.len();
            self.builder.add_points(&points, colour, world_from_node);
            return Ok(());
        }
        let triangles: Vec<[u32; 3]> = indices.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect();
        let part = Part { positions: &positions, normals: &normals, triangles: &triangles, colour };
        self.builder.add(&part, world_from_node);
        Ok(())
    }
}

/// A perspective camera of a file: the vertical field of view in radians, the near and the far plane.
type CameraLens = (f64, f64, f64);

/// The perspective cameras of a file, `None` for others. Read from the JSON, as `Camera::projection` panics where
/// the type and the values disagree.
fn camera_lenses(file: &Gltf) -> Vec<Option<CameraLens>> {
    let cameras = file.as_json().cameras.iter();
    cameras
        .map(|camera| {
            let lens = camera.perspective.as_ref()?;
            Some((f64::from(lens.yfov), f64::from(lens.znear), lens.zfar.map_or(f64::INFINITY, f64::from)))
        })
        .collect()
}

/// A camera at a node looks along the node's −z axis; its up is +y. `None` where it is invalid.
fn camera_at(world_from_node: DMat4, (fov_y, near, far): CameraLens) -> Option<Camera> {
    let camera = Camera {
        eye: world_from_node.w_axis.truncate(),
        forward: (-world_from_node.z_axis.truncate()).try_normalize()?,
        up: world_from_node.y_axis.truncate().try_normalize()?,
        fov_y,
        near: Some(near),
        far: Some(far),
    };
    camera.view(1.0, near, far).is_ok().then_some(camera)
}

/// A light at a node shines along the node's −z axis.
fn light_at(world_from_node: DMat4, light: &gltf::khr_lights_punctual::Light) -> Option<LightSpec> {
    let position = world_from_node.w_axis.truncate();
    let direction_to_light = world_from_node.z_axis.truncate().try_normalize();
    let range = light.range().map_or(f64::INFINITY, f64::from);
    let usable = position.is_finite() && range > 0.0;
    match light.kind() {
        Kind::Directional => Some(LightSpec::Sun { direction_to_light: direction_to_light? }),
        Kind::Point => usable.then_some(LightSpec::Point { position, range }),
        Kind::Spot { outer_cone_angle, .. } => {
            let cone_degrees = 2.0 * f64::from(outer_cone_angle).to_degrees();
            let target = position - direction_to_light?;
            let usable = usable && cone_degrees > 0.0 && cone_degrees < 180.0;
            usable.then_some(LightSpec::Spot { position, target, cone_degrees, range })
        }
    }
}

#[cfg(test)]
mod tests;
