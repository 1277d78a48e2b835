//! Converts a scene to the planner's objects, and a light's plan to maps to draw.

use anyhow::{Context, Result};
use shadowfit::{
    Aabb, DepthFormat, Light,
    depth::DepthTest,
    omni::CubeFace,
    plan::{Kind, LightPlan, Object, Objects, Plan, Projection},
};

use super::cut::Cutting;
use super::fitted_maps::{FittedMap, FittedMaps};
use super::options::Options;
use crate::gpu::{Bias, Filter, MapPass, Points};
use crate::maps::{Layout, Split, Technique};
use crate::scene::{self, Mesh};
use crate::stage::Stage;
use crate::trace::Faces;

/// The bounding box of an object, rounded outwards to f32.
#[must_use]
pub fn bounds(object: &scene::Object) -> Aabb {
    Aabb::new(object.min, object.max)
}

/// The objects of a mesh for the planner, in their order. All of them are casters and receivers.
///
/// # Errors
///
/// When the scene is too large.
pub fn objects(mesh: &Mesh) -> Result<Objects> {
    let of = |object: &scene::Object| {
        let edges = object.triangles.clone().flat_map(|triangle| {
            let [a, b, c] = mesh.corners(triangle as usize);
            [a.distance(b), b.distance(c), c.distance(a)]
        });
        Object {
            surface: object.surface,
            triangles: object.triangles.len() as u32,
            longest_edge: (edges.fold(0.0, f64::max) as f32).next_up(),
            ..Object::new(bounds(object))
        }
    };
    let objects: Vec<Object> = mesh.objects.iter().map(of).collect();
    Objects::new(&objects).context("the scene's extent cannot be used")
}

/// The faces to draw for a depth test.
#[must_use]
pub fn faces(test: DepthTest) -> Faces {
    match test {
        DepthTest::Second => Faces::Second,
        // The planner never chooses to test between layers.
        DepthTest::First | DepthTest::BetweenLayers => Faces::All,
    }
}

/// The corresponding filter of this crate, with virtual samples or without.
#[must_use]
pub fn filter(filter: shadowfit::Filter, virtual_samples: bool) -> Filter {
    use shadowfit::Filter as Planned;
    match (filter, virtual_samples) {
        (Planned::Nearest, false) => Filter::Nearest,
        (Planned::Nearest, true) => Filter::Virtual(1),
        (Planned::Hardware2x2, false) => Filter::Hardware2x2,
        (Planned::Hardware2x2, true) => Filter::Virtual(2),
        (Planned::Pcf(taps), false) => Filter::Pcf(taps.max(1).into()),
        (Planned::Pcf(taps), true) => Filter::Virtual(taps.max(1).into()),
        (other, _) => unreachable!("the harness has no filter {other:?}"),
    }
}

/// The options of a planned light, for this number of frames.
#[must_use]
pub fn options(of_light: &LightPlan, format: DepthFormat, points: Points, frames: u32) -> Options {
    let map_size = of_light.passes().iter().map(|pass| pass.map_size()).max().unwrap_or(0);
    Options {
        format,
        faces: faces(of_light.test()),
        filter: filter(of_light.filter(), of_light.virtual_samples()),
        points,
        frames,
        // A plan uses paraboloids only for casters that need no tessellation.
        cut: Cutting::None,
        ..Options::new(technique(of_light), map_size)
    }
}

/// The technique closest to a plan.
fn technique(of_light: &LightPlan) -> Technique {
    let of_pass = |pass: &shadowfit::plan::Pass| match pass.projection() {
        Projection::Frustum(map) => Technique::of(map.settings()),
        // Faces may have different warps, as the plan chooses one for each.
        Projection::Face(_, map) => match Technique::of(map.settings()) {
            Technique::Uniform => Technique::Cube,
            Technique::Stable => Technique::CubeStable,
            _ => Technique::CubePsm,
        },
        Projection::Paraboloid(_) => Technique::Paraboloid,
    };
    let of_passes = of_light.passes().iter().map(of_pass);
    of_passes.reduce(|one, other| if one == Technique::Cube { other } else { one }).unwrap_or(Technique::Uniform)
}

/// How a pass of a plan is drawn: with the plan's bias, and otherwise by `options`.
fn drawn(pass: &shadowfit::plan::Pass, options: &Options) -> MapPass {
    let Options { format, faces, points, .. } = *options;
    let none = MapPass { format, faces, bias: Bias::NONE, receiver: 0.0, relative: 0.0, points };
    pass.bias().map_or(none, |bias| none.with(bias))
}

impl FittedMaps {
    /// The maps of a planned light, with the plan's matrices, casters and bias, and otherwise by `options`; `None`
    /// where the plan has no map.
    ///
    /// # Errors
    ///
    /// When a cube face cannot be built, or GPU memory does not suffice.
    pub fn planned(
        stage: &Stage<'_>,
        plan: &Plan,
        light: &Light,
        of_light: &LightPlan,
        options: &Options,
    ) -> Result<Option<Self>> {
        let axes = of_light.passes().iter().filter_map(|pass| match pass.projection() {
            Projection::Paraboloid(paraboloid) => Some(paraboloid.axis()),
            Projection::Frustum(_) | Projection::Face(..) => None,
        });
        let first_axis = axes.clone().next();
        let (split, lights) = match (of_light.kind(), light.position(), first_axis) {
            (Kind::CubeFaces, Some(position), _) => {
                (Split::cube(position), cube_faces(light, options.filter, options.map_size, options.border())?)
            }
            (Kind::DualParaboloid, Some(position), Some(axis)) => (Split::halves(position, axis), vec![*light]),
            _ => (Split::whole(), vec![*light]),
        };
        let mut maps = vec![None; split.parts()];
        for pass in of_light.passes() {
            let (part, map) = match pass.projection() {
                Projection::Frustum(map) => (0, Layout::Frustum(map.clone())),
                Projection::Face(face, map) => (*face as usize, Layout::Frustum(map.clone())),
                Projection::Paraboloid(map) => {
                    (usize::from(Some(map.axis()) != first_axis), Layout::Paraboloid(map.clone()))
                }
            };
            let objects = plan.casters(pass).iter().map(|&id| id as usize).collect();
            maps[part] = Some(FittedMap { map, pass: drawn(pass, options), bias: pass.bias().copied(), objects });
        }
        if maps.iter().all(Option::is_none) {
            return Ok(None);
        }
        Self::of(stage, split, lights, maps, options.cut).map(Some)
    }
}

/// The cube faces of a point light, each as a light of its own.
///
/// # Errors
///
/// When the light is not a point light.
pub fn cube_faces(light: &Light, filter: Filter, map_size: u32, border: u32) -> Result<Vec<Light>> {
    let overlap = CubeFace::overlap(filter.reach(), map_size, border);
    let faces = CubeFace::ALL.map(|face| light.cube_face(face, overlap));
    faces.into_iter().collect::<Result<_, _>>().context("the light has no faces")
}

/// A kind in words.
#[must_use]
pub fn kind_in_words(kind: Kind) -> &'static str {
    match kind {
        Kind::Nothing => "no map",
        Kind::Uniform => "uniform",
        Kind::Warped => "warped",
        Kind::Paraboloid => "paraboloid",
        Kind::DualParaboloid => "two paraboloids",
        Kind::CubeFaces => "cube faces",
        other => unreachable!("the harness has no word for {other:?}"),
    }
}

/// How depths are tested, in words.
#[must_use]
pub fn test_in_words(of_light: &LightPlan) -> &'static str {
    match (of_light.kind(), of_light.test(), of_light.virtual_samples()) {
        (Kind::Nothing, ..) => "-",
        (_, DepthTest::First, _) => "first depth, bias",
        (_, DepthTest::Second, false) => "second depth",
        (_, DepthTest::Second, true) => "virtual samples",
        (_, DepthTest::BetweenLayers, _) => "between layers",
    }
}
