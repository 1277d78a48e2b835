//! Scenes damaged in the ways that files are.

use shadowfit::glam::{DMat4, DVec3, Vec3};

use super::loaded::LoadedScene;
use super::mesh::{Mesh, MeshBuilder, Object, Part};

/// A kind of damage.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// Degenerate triangles among the others: a corner three times, a corner twice, and three collinear corners.
    WithoutArea,
    /// Every fifth triangle is duplicated, starting at another corner.
    Twice,
    /// Triangles with indices beyond the vertices.
    BeyondVertices,
    /// Parts without triangles, and parts without vertices.
    Empty,
    /// Copies of parts that node transforms collapse to a point and to a line.
    Shrunk,
    /// Five vertices are NaN.
    NotANumber,
    /// Five vertices are infinite.
    Infinite,
    /// Five vertices are 10³⁰ units away.
    FarAway,
    /// Every third part is inverted.
    InsideOut,
    /// In every third part, every fourth triangle is flipped.
    PartlyReversed,
}

impl Fault {
    /// All kinds.
    pub const ALL: [Self; 10] = [
        Self::WithoutArea,
        Self::Twice,
        Self::BeyondVertices,
        Self::Empty,
        Self::Shrunk,
        Self::NotANumber,
        Self::Infinite,
        Self::FarAway,
        Self::InsideOut,
        Self::PartlyReversed,
    ];

    /// A description.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::WithoutArea => "triangles without area",
            Self::Twice => "triangles twice",
            Self::BeyondVertices => "indices beyond the vertices",
            Self::Empty => "empty parts",
            Self::Shrunk => "parts without size",
            Self::NotANumber => "vertices that are not a number",
            Self::Infinite => "infinite vertices",
            Self::FarAway => "vertices at 1e30",
            Self::InsideOut => "parts inside out",
            Self::PartlyReversed => "triangles turned round",
        }
    }

    /// Whether the undamaged scene remains complete and unchanged, so that its image must be unchanged too.
    #[must_use]
    pub fn leaves_all(self) -> bool {
        matches!(self, Self::WithoutArea | Self::Twice | Self::BeyondVertices | Self::Empty | Self::Shrunk)
    }

    /// The value of the five damaged vertices, for damage of that kind.
    fn vertex(self) -> Option<DVec3> {
        match self {
            Self::NotANumber => Some(DVec3::new(0.0, f64::NAN, 0.0)),
            Self::Infinite => Some(DVec3::new(f64::NEG_INFINITY, 0.0, 1.0)),
            Self::FarAway => Some(DVec3::new(1.0, 1e30, -1e30)),
            _ => None,
        }
    }
}

/// A damaged copy of a scene of triangles, built as from a file.
#[must_use]
pub fn damaged(scene: &LoadedScene, fault: Fault) -> LoadedScene {
    /// The number of damaged vertices.
    const WRONG: usize = 5;
    let objects = &scene.mesh.objects;
    let mut builder = MeshBuilder::default();
    for (i, object) in objects.iter().enumerate() {
        let mut piece = Piece::of(&scene.mesh, object);
        // In objects spread evenly over the list.
        let is_struck = (0..WRONG).any(|wrong| i == wrong * objects.len() / WRONG);
        if let Some(vertex) = fault.vertex().filter(|_| is_struck) {
            let middle = piece.triangles[piece.triangles.len() / 2];
            piece.positions[middle[0] as usize] = vertex;
        }
        let one_reversed_of = match fault {
            Fault::InsideOut => Some(1),
            Fault::PartlyReversed => Some(4),
            _ => None,
        };
        if let Some(of) = one_reversed_of.filter(|_| i % 3 == 0) {
            piece.triangles.iter_mut().step_by(of).for_each(|triangle| triangle.swap(1, 2));
        }
        piece.spoil(fault);
        builder.add(&piece.part(), DMat4::IDENTITY);
        if fault == Fault::Empty {
            builder.add(&Part { triangles: &[], ..piece.part() }, DMat4::IDENTITY);
            builder.add(&Part { positions: &[], normals: &[], triangles: &[], colour: [1.0; 3] }, DMat4::IDENTITY);
        }
        if fault == Fault::Shrunk {
            builder.add(&piece.part(), DMat4::from_scale(DVec3::ZERO));
            builder.add(&piece.part(), DMat4::from_scale(DVec3::X));
        }
    }
    rebuilt(scene, builder)
}

/// A scene with positions of vertices, camera and lights rounded to f32, as in files. Triangles that become
/// degenerate are left out.
#[must_use]
pub fn in_single_precision(scene: &LoadedScene) -> LoadedScene {
    let rounded = |position: DVec3| position.as_vec3().as_dvec3();
    let mut builder = MeshBuilder::default();
    for object in &scene.mesh.objects {
        let mut piece = Piece::of(&scene.mesh, object);
        piece.positions.iter_mut().for_each(|position| *position = rounded(*position));
        builder.add(&piece.part(), DMat4::IDENTITY);
    }
    let mut scene = rebuilt(scene, builder);
    if let Some(camera) = &mut scene.camera {
        camera.eye = rounded(camera.eye);
    }
    for light in &mut scene.lights {
        *light = light.with_position(rounded);
    }
    scene
}

fn rebuilt(scene: &LoadedScene, builder: MeshBuilder) -> LoadedScene {
    let (mesh, left_out) = builder.finish();
    LoadedScene { name: scene.name.clone(), mesh, camera: scene.camera, lights: scene.lights.clone(), left_out }
}

/// A part of a scene, to be damaged.
struct Piece {
    positions: Vec<DVec3>,
    normals: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
    colour: [f32; 3],
}

impl Piece {
    /// The part that an object was made of: its vertices are consecutive.
    fn of(mesh: &Mesh, object: &Object) -> Self {
        let range = object.triangles.start as usize..object.triangles.end as usize;
        let triangles = &mesh.triangles[range.clone()];
        let used = || triangles.iter().flatten().map(|&i| i as usize);
        let vertices = used().min().unwrap_or(0)..used().max().map_or(0, |last| last + 1);
        let first = vertices.start as u32;
        Self {
            positions: mesh.vertices[vertices.clone()].to_vec(),
            normals: mesh.normals[vertices].to_vec(),
            triangles: triangles.iter().map(|triangle| triangle.map(|i| i - first)).collect(),
            colour: mesh.colours[range.start],
        }
    }

    fn part(&self) -> Part<'_> {
        Part { positions: &self.positions, normals: &self.normals, triangles: &self.triangles, colour: self.colour }
    }

    /// Adds unusable triangles.
    fn spoil(&mut self, fault: Fault) {
        match fault {
            Fault::WithoutArea => {
                let [a, b, _] = self.triangles[0];
                let middle = self.positions.len() as u32;
                let [from, to] = [a, b].map(|i| self.positions[i as usize]);
                self.positions.push(0.5 * (from + to));
                self.normals.push(Vec3::ZERO);
                self.triangles.splice(1..1, [[a, a, a], [a, a, b], [a, middle, b]]);
            }
            Fault::Twice => {
                let again: Vec<_> = self.triangles.iter().step_by(5).map(|&[a, b, c]| [b, c, a]).collect();
                self.triangles.extend(again);
            }
            Fault::BeyondVertices => {
                let beyond = self.positions.len() as u32;
                self.triangles.splice(0..0, [[0, 1, beyond], [u32::MAX, 0, 1]]);
            }
            _ => {}
        }
    }
}
