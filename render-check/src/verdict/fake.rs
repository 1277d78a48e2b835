//! A ray-casting renderer for tests: triangles, maps and shadow tests from matrices alone, without the code under
//! test.

use std::f64::consts::PI;

use rayon::prelude::*;
use shadowfit::glam::{DMat4, DVec3};
use shadowfit::{Scene, Settings, ShadowMap, View, fit};

use super::{Bias, DrawnMap, Frustum, Rendered, TruthImage, Verdict, judge};
use crate::maps::Split;
use crate::scene::{LightSpec, Mesh, MeshBuilder, Part};
use crate::trace::{Faces, Hit, Lens, Ray, Tracer};

/// The image size, in pixels.
pub(crate) const SIZE: [u32; 2] = [192, 128];

/// The near plane of local lights.
pub(crate) const LAMP_NEAR: f64 = 0.05;

pub(crate) const SUN: LightSpec = LightSpec::Sun { direction_to_light: DVec3::new(0.5, 1.0, 0.3) };
pub(crate) const LAMP: LightSpec = LightSpec::Point { position: DVec3::new(0.4, 6.0, 0.7), range: f64::INFINITY };
pub(crate) const SPOT: LightSpec = LightSpec::Spot {
    position: DVec3::new(1.0, 6.0, 2.0),
    target: DVec3::new(0.0, 0.0, 0.1),
    cone_degrees: 70.0,
    range: 9.0,
};

/// A floor from −5 to 5 at height 0 with its front face up, a slab floating over its left half, and a ball with
/// visible facets over its right half; each is an object.
pub(crate) fn mesh() -> Mesh {
    let square = [(-1.0, 1.0), (1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)].map(|(x, z)| DVec3::new(x, 0.0, z));
    let part = |positions, triangles, colour| Part { positions, normals: &[], triangles, colour };
    let mut builder = MeshBuilder::default();
    builder.add(&part(&square, &[[0, 1, 2], [0, 2, 3]], [0.7; 3]), DMat4::from_scale(DVec3::splat(5.0)));

    let cube: Vec<DVec3> =
        [1.0, -1.0].into_iter().flat_map(|y| square.map(|corner| corner + y * DVec3::Y)).collect();
    let sides = [[0, 4, 5, 1], [1, 5, 6, 2], [2, 6, 7, 3], [3, 7, 4, 0], [0, 1, 2, 3], [4, 7, 6, 5]];
    let halves: Vec<[u32; 3]> = sides.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    let world_from_slab = DMat4::from_translation(DVec3::new(-1.2, 1.5, -0.1))
        * DMat4::from_rotation_z(0.15)
        * DMat4::from_scale(DVec3::new(1.1, 0.1, 0.9));
    builder.add(&part(&cube, &halves, [0.8, 0.4, 0.2]), world_from_slab);

    let (rings, sides) = (8_u32, 12_u32);
    let on_ball = |ring: u32, side: u32| {
        let (polar, turn) =
            (PI * f64::from(ring) / f64::from(rings), 2.0 * PI * f64::from(side) / f64::from(sides));
        DVec3::new(polar.sin() * turn.cos(), polar.cos(), polar.sin() * turn.sin())
    };
    let ball: Vec<DVec3> = (0..=rings).flat_map(|ring| (0..sides).map(move |side| on_ball(ring, side))).collect();
    let mut facets = Vec::new();
    for (ring, side) in (0..rings).flat_map(|ring| (0..sides).map(move |side| (ring, side))) {
        let corner = |ring: u32, side: u32| ring * sides + side % sides;
        let [a, b, c, d] =
            [corner(ring, side), corner(ring + 1, side), corner(ring + 1, side + 1), corner(ring, side + 1)];
        facets.extend((ring > 0).then_some([a, d, b]));
        facets.extend((ring + 1 < rings).then_some([d, c, b]));
    }
    let world_from_ball = DMat4::from_translation(DVec3::new(1.7, 1.1, 0.3)) * DMat4::from_scale(DVec3::splat(0.8));
    builder.add(&part(&ball, &facets, [0.25, 0.5, 0.8]), world_from_ball);
    builder.finish().0
}

/// The mesh without one of its objects.
pub(crate) fn mesh_without(object: usize) -> Mesh {
    let mut mesh = mesh();
    let gone = mesh.objects[object].triangles.clone();
    let gone = gone.start as usize..gone.end as usize;
    mesh.triangles.drain(gone.clone());
    mesh.colours.drain(gone);
    mesh
}

/// The floor alone.
pub(crate) fn floor() -> Mesh {
    let mut mesh = mesh_without(2);
    mesh.triangles.truncate(2);
    mesh
}

/// The floor below a fence whose bars are a fifth of a texel wide.
pub(crate) fn fence() -> Mesh {
    let bar = [(-0.004, 1.0), (0.004, 1.0), (0.004, -1.0), (-0.004, -1.0)].map(|(x, z)| DVec3::new(x, 1.0, z));
    let triangles = [[0, 1, 2], [0, 2, 3]];
    let part = Part { positions: &bar, normals: &[], triangles: &triangles, colour: [0.5; 3] };
    let floor = floor();
    let corners: Vec<DVec3> =
        floor.triangles.iter().flatten().map(|&corner| floor.vertices[corner as usize]).collect();
    let mut builder = MeshBuilder::default();
    builder.add(&Part { positions: &corners, triangles: &[[0, 1, 2], [3, 4, 5]], ..part }, DMat4::IDENTITY);
    for i in -10..=10 {
        let turn = DMat4::from_rotation_y(0.2 + 0.01 * f64::from(i));
        builder.add(&part, DMat4::from_translation(0.237 * f64::from(i) * DVec3::X) * turn);
    }
    builder.finish().0
}

/// Looks down on the middle of the floor.
pub(crate) fn view() -> View {
    let (eye, target) = (DVec3::new(0.3, 4.2, 6.0), DVec3::new(-0.2, 0.3, -0.2));
    let aspect = f64::from(SIZE[0]) / f64::from(SIZE[1]);
    View::perspective(eye, target - eye, DVec3::Y, 0.75, aspect, 1.0, 30.0).expect("a sound view")
}

/// Settings for a map of 256² texels.
pub(crate) fn settings() -> Settings {
    Settings::new(256, SIZE[1]).expect("sound sizes").with_border(4).expect("room for a border")
}

pub(crate) fn fitted(light: &LightSpec, settings: &Settings) -> ShadowMap {
    let (min, max) = mesh().bounds();
    let scene = Scene::from_box(min, max).expect("a sound box");
    let light = light.to_light(LAMP_NEAR).expect("a sound light");
    fit(&view(), &light, &scene, settings).into_map().expect("one frustum does")
}

/// The triangle of each pixel.
pub(crate) fn triangles(view: &View, tracer: &Tracer) -> Vec<u32> {
    let lens = Lens::of_view(view).expect("invertible");
    let ray = |x, y| lens.ray_through_pixel(x, y, SIZE[0], SIZE[1]).expect("in front");
    (0..SIZE[1])
        .flat_map(|y| (0..SIZE[0]).map(move |x| (x, y)))
        .map(|(x, y)| tracer.first_hit(&ray(x, y)).map_or(u32::MAX, |hit| hit.triangle as u32))
        .collect()
}

/// The truth about the default view of the mesh.
pub(crate) fn truth(light: &LightSpec, tracer: &Tracer) -> TruthImage {
    let triangles = triangles(&view(), tracer);
    TruthImage::trace(&view(), SIZE, &triangles, light, LAMP_NEAR, tracer).expect("sound inputs")
}

/// How a map is drawn and tested, with its faults.
#[derive(Clone, Copy)]
pub(crate) struct Fake {
    pub(crate) faces: Faces,
    /// The depth bias in the map.
    pub(crate) bias: Bias,
    /// The receiver offset of the shadow test.
    pub(crate) look_up_bias: f64,
    /// An additional offset, times the receiver's depth change within the filter.
    pub(crate) look_up_slope: f64,
    /// The filter's texels a side: an odd number.
    pub(crate) filter: i64,
}

impl Default for Fake {
    /// Without a depth bias, and with the smallest receiver offset that suffices.
    fn default() -> Self {
        let bias = Bias { constant: 0.0, slope: 0.0 };
        Self { faces: Faces::All, bias, look_up_bias: 1e-5, look_up_slope: 1.0, filter: 1 }
    }
}

impl Fake {
    /// The map's depths as a renderer would hold them.
    pub(crate) fn draw(&self, map: &ShadowMap, casters: &Tracer) -> Vec<f32> {
        let (lens, size) = (lens_of(map), map.settings().map_size());
        let is_reversed = map.settings().clip().depth.is_reversed();
        let texel = |x: u32, y: u32| {
            let ray = lens.ray_through_pixel(x, y, size, size);
            let depth = ray.and_then(|ray| casters.first_hit_of(&ray, self.faces)).map_or(1.0, |hit| {
                let steps = depth_steps(&lens, size, &hit);
                lens.project(hit.point).z + self.bias.constant + self.bias.slope * steps[0].max(steps[1])
            });
            let depth = depth.clamp(0.0, 1.0) as f32;
            if is_reversed { 1.0 - depth } else { depth }
        };
        (0..size * size).into_par_iter().map(|i| texel(i % size, i / size)).collect()
    }

    /// The lit fraction of each pixel.
    pub(crate) fn light(&self, map: &ShadowMap, depths: &[f32], truth: &TruthImage, mesh: &Mesh) -> Vec<f32> {
        let (lens, size) = (lens_of(map), map.settings().map_size());
        let is_reversed = map.settings().clip().depth.is_reversed();
        let stored = |x: i64, y: i64| {
            let [x, y] = [x, y].map(|i| i.clamp(0, i64::from(size) - 1) as usize);
            let depth = depths[y * size as usize + x];
            f64::from(if is_reversed { 1.0 - depth } else { depth })
        };
        let share = |point: DVec3, triangle: usize| {
            let place = lens.project(point);
            let ray = Ray { origin: point, direction: DVec3::Y, length: 0.0 };
            let steps = depth_steps(&lens, size, &Hit::along(&ray, 0.0, mesh, triangle));
            let reach = 0.5 * self.filter as f64 * (steps[0] + steps[1]);
            let depth = place.z - self.look_up_bias - self.look_up_slope * reach;
            let texel = |at: f64| (0.5 * (at + 1.0) * f64::from(size)).floor() as i64;
            let (x, y, half) = (texel(place.x), texel(-place.y), self.filter / 2);
            let taps = (-half..=half).flat_map(|dy| (-half..=half).map(move |dx| (x + dx, y + dy)));
            let lit = taps.filter(|&(x, y)| depth <= stored(x, y)).count();
            lit as f32 / (self.filter * self.filter) as f32
        };
        let pixels = truth.pixels().iter().map(|pixel| pixel.surface());
        pixels.map(|surface| surface.map_or(0.0, |surface| share(surface.point, surface.triangle))).collect()
    }

    /// Judges a map that was drawn and tested like this.
    pub(crate) fn judge(
        &self,
        map: &ShadowMap,
        depths: &[f32],
        lit: &[f32],
        truth: &TruthImage,
        tracer: &Tracer,
    ) -> anyhow::Result<Verdict> {
        let frustum = Frustum::new(map);
        let is_reversed = map.settings().clip().depth.is_reversed();
        let drawn = DrawnMap { projection: &frustum, depths, is_reversed, bias: self.bias, derived: None };
        judge(truth, &self.hand_over(&Split::whole(), &[Some(drawn)], lit), tracer)
    }

    /// The input to judge.
    pub(crate) fn hand_over<'a>(
        &self,
        split: &'a Split,
        maps: &'a [Option<DrawnMap<'a>>],
        lit: &'a [f32],
    ) -> Rendered<'a> {
        let reach = 0.5 * self.filter as f64;
        Rendered { split, maps, lit, faces: self.faces, depth_step: 1e-7, reach }
    }

    /// Draws `casters` into a map, shadows the default mesh with it and compares.
    pub(crate) fn verdict(&self, light: &LightSpec, map: &ShadowMap, casters: &Mesh) -> Verdict {
        self.verdict_on(&mesh(), light, map, casters)
    }

    /// The same with another mesh of receivers.
    pub(crate) fn verdict_on(&self, mesh: &Mesh, light: &LightSpec, map: &ShadowMap, casters: &Mesh) -> Verdict {
        let tracer = Tracer::new(mesh).expect("it has triangles");
        let truth = truth(light, &tracer);
        let depths = self.draw(map, &Tracer::new(casters).expect("it has triangles"));
        let lit = self.light(map, &depths, &truth, mesh);
        self.judge(map, &depths, &lit, &truth, &tracer).expect("sound inputs")
    }
}

fn lens_of(map: &ShadowMap) -> Lens {
    Lens::new(map.clip_from_world_in(shadowfit::ClipSpace::WGPU)).expect("invertible")
}

/// The depth slopes of the plane that was hit, per column and per row.
fn depth_steps(lens: &Lens, size: u32, hit: &Hit) -> [f64; 2] {
    let place = lens.project(hit.point);
    [DVec3::X, DVec3::Y].map(|axis| {
        let next = place + axis * 2.0 / f64::from(size);
        let ray = lens.ray(next.truncate()).expect("within the map");
        let distance = hit.face_normal.dot(hit.point - ray.origin) / hit.face_normal.dot(ray.direction);
        (lens.project(ray.origin + distance * ray.direction).z - place.z).abs()
    })
}
