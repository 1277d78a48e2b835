//! The table: what every set-up comes to, to the last bit.
//!
//! The matrix to upload is there in full; of everything else there is, group by group, how many numbers it is and a digest
//! of their bits, so that a difference shows which group it is in. `cargo run -p bits -- full` prints the numbers.

use crate::setups::{SetUp, casters, setups};
use shadowfit::glam::{DMat4, DVec2, DVec3, DVec4, Mat4, Vec4};
use shadowfit::{
    ClipSpace, DepthFormat, Filter, Focus, FocusForm, Light, Outcome, ShadowMap, View,
    depth::{ComparisonTolerance, DepthBias, ReceiverOffset, ShadowSample, Splat, TangentPlane},
    focus::{ConvexBody, Plane},
    map::{DepthResolution, Footprint},
    omni::Paraboloid,
    warp::{VirtualCamera, classify},
};
use std::fmt::Write;

const FORMATS: [DepthFormat; 4] =
    [DepthFormat::Unorm8, DepthFormat::Unorm16, DepthFormat::Unorm24, DepthFormat::Float32];

/// The whole table, one block a set-up; with every number if it is to be `full`.
pub fn table(full: bool) -> String {
    setups().iter().map(|setup| block(setup, full)).collect::<Vec<_>>().join("\n")
}

/// Numbers on their way into one line of the table.
pub struct Numbers {
    count: usize,
    digest: u64,
    /// All of them, where they are wanted.
    text: Option<String>,
}

impl Numbers {
    pub const fn new(full: bool) -> Self {
        // FNV-1a, 64 bits, eight bytes at a time.
        Self { count: 0, digest: 0xcbf2_9ce4_8422_2325, text: if full { Some(String::new()) } else { None } }
    }

    fn word(&mut self, bits: u64) {
        self.count += 1;
        self.digest = (self.digest ^ bits).wrapping_mul(0x0000_0100_0000_01b3);
        // A multiplication carries upwards only.
        self.digest ^= self.digest >> 29;
        if let Some(text) = &mut self.text {
            write!(text, "\n    {bits:016x} {}", f64::from_bits(bits)).expect("a string");
        }
    }

    pub fn line(self, name: &str) -> String {
        let Self { count, digest, text } = self;
        format!("{name:<12} {count:>4} {digest:016x}{}\n", text.unwrap_or_default())
    }
}

/// What numbers are made of.
pub trait Bits {
    fn put(&self, numbers: &mut Numbers);
}

impl Bits for f64 {
    fn put(&self, numbers: &mut Numbers) {
        // IEEE 754 does not say which NaN an operation makes; nothing here is one.
        assert!(!self.is_nan(), "a result is not a number");
        numbers.word(self.to_bits());
    }
}

impl Bits for f32 {
    fn put(&self, numbers: &mut Numbers) {
        f64::from(*self).put(numbers);
    }
}

impl Bits for bool {
    fn put(&self, numbers: &mut Numbers) {
        numbers.word(u64::from(*self));
    }
}

impl Bits for usize {
    fn put(&self, numbers: &mut Numbers) {
        numbers.word(*self as u64);
    }
}

impl<T: Bits> Bits for Option<T> {
    fn put(&self, numbers: &mut Numbers) {
        self.is_some().put(numbers);
        self.iter().for_each(|value| value.put(numbers));
    }
}

impl<T: Bits, const N: usize> Bits for [T; N] {
    fn put(&self, numbers: &mut Numbers) {
        self.iter().for_each(|value| value.put(numbers));
    }
}

/// Types that are put as what an expression makes of them.
macro_rules! put_as {
    ($($type:ty: $value:ident => $parts:expr;)*) => {
        $(impl Bits for $type {
            fn put(&self, numbers: &mut Numbers) {
                let $value = self;
                $parts.iter().for_each(|part| part.put(numbers));
            }
        })*
    };
}

put_as! {
    DVec2: v => v.to_array();
    DVec3: v => v.to_array();
    DVec4: v => v.to_array();
    Vec4: v => v.to_array();
    DMat4: m => m.to_cols_array();
    Mat4: m => m.to_cols_array();
    Plane: plane => plane.to_row().to_array();
    Footprint: f => [f.along_x.x, f.along_x.y, f.along_x.z, f.along_y.x, f.along_y.y, f.along_y.z, f.area(), f.longest(),
        f.shortest()];
    VirtualCamera: c => [c.shift, c.eye.x, c.eye.y, c.eye.z, c.near, c.far];
    DepthResolution: r => [r.unorm8, r.unorm16, r.unorm24, r.float32];
    DepthBias: b => [f64::from(b.constant), b.slope_scale.into(), b.receiver, b.relative, b.most, b.places];
    Splat: s => [s.centre, s.half, s.covering().half, DVec2::splat(s.diameter())];
    ShadowSample: s => [s.share, f64::from(s.rule as u8)];
}

impl Bits for ConvexBody {
    fn put(&self, numbers: &mut Numbers) {
        self.vertices().len().put(numbers);
        self.vertices().iter().for_each(|vertex| vertex.put(numbers));
        for face in self.faces() {
            face.plane().put(numbers);
            face.indices().for_each(|index| index.put(numbers));
        }
        self.bounds().map(|(min, max)| [min, max]).put(numbers);
        self.volume().put(numbers);
    }
}

fn block(setup: &SetUp, full: bool) -> String {
    let SetUp { name, view, light, scene, settings } = setup;
    let scene = scene.scene();
    let focus = Focus::new(view, light, &scene);
    let line = |name: &str, fill: &dyn Fn(&mut Numbers)| {
        let mut numbers = Numbers::new(full);
        fill(&mut numbers);
        numbers.line(name)
    };
    let outcome = focus.fit(settings);
    let mut text = format!("{name}\n");
    text += &line("view", &|numbers| put_view(view, numbers));
    text += &line("light", &|numbers| put_light(view, light, numbers));
    text += &line("bodies", &|numbers| put_bodies(&focus, numbers));
    match &outcome {
        Outcome::Map(map) => {
            for column in map.caster_matrix().to_cols_array_2d() {
                let [x, y, z, w] = column.map(f32::to_bits);
                text += &format!("matrix       {x:08x} {y:08x} {z:08x} {w:08x}\n");
            }
            text += &line("matrices", &|numbers| put_matrices(map, numbers));
            text += &line("figures", &|numbers| put_figures(map, &focus, numbers));
            text += &line("bias", &|numbers| put_bias(map, &focus, numbers));
            text += &line("points", &|numbers| put_points(map, &focus, numbers));
        }
        Outcome::Empty(why) => text += &format!("{why:?}\n"),
        Outcome::Surrounded(_) => text += "Surrounded\n",
    }
    let paraboloids = focus.paraboloids(settings);
    for (number, map) in (1..).zip(paraboloids.maps()) {
        let put = |numbers: &mut Numbers| put_paraboloid(map, &focus, numbers);
        text += &line(&format!("paraboloid {number}"), &put);
    }
    text
}

fn put_view(view: &View, numbers: &mut Numbers) {
    [view.eye(), view.right(), view.up(), view.forward()].put(numbers);
    [view.near(), view.far()].put(numbers);
    view.planes().iter().for_each(|plane| plane.put(numbers));
    view.corners().put(numbers);
    view.clip_from_world().put(numbers);
}

fn put_light(view: &View, light: &Light, numbers: &mut Numbers) {
    light.homogeneous().put(numbers);
    light.planes().iter().for_each(|plane| plane.put(numbers));
    let class = classify(view, light);
    class.position.put(numbers);
    [class.sine_to_camera_plane, class.eye_distance, f64::from(class.kind as u8)].put(numbers);
    class.inside_view.put(numbers);
}

fn put_bodies(focus: &Focus<'_>, numbers: &mut Numbers) {
    focus.receiver_volume().put(numbers);
    focus.caster_volume(FocusForm::ViewHull).put(numbers);
    let body = focus.caster_volume(FocusForm::ReceiverHull);
    body.put(numbers);
    let (boxes, balls) = casters(focus.view());
    let culler = body.culler();
    let mut meets = vec![false; boxes.len()];
    culler.boxes(&boxes, &mut meets);
    meets.iter().for_each(|meets| meets.put(numbers));
    culler.spheres(&balls.into_iter().map(Vec4::from).collect::<Vec<_>>(), &mut meets);
    meets.iter().for_each(|meets| meets.put(numbers));
}

fn put_matrices(map: &ShadowMap, numbers: &mut Numbers) {
    map.clip_from_world().put(numbers);
    map.receiver_matrix().put(numbers);
    map.texture_from_world().put(numbers);
    map.linear_depth().put(numbers);
    for clip in [ClipSpace::WGPU, ClipSpace::VULKAN, ClipSpace::OPENGL] {
        [clip, clip.reversed()].map(|clip| map.clip_from_world_in(clip)).put(numbers);
    }
    let offsets = [
        ReceiverOffset::world(0.0625),
        ReceiverOffset::relative(0.015_625),
        ReceiverOffset::depth(0.000_976_562_5),
    ];
    for offset in offsets {
        let offset = offset.expect("an offset");
        map.receiver_matrix_with(&offset).put(numbers);
        map.texture_from_world_with(&offset).put(numbers);
    }
}

fn put_figures(map: &ShadowMap, focus: &Focus<'_>, numbers: &mut Numbers) {
    let (window, depth) = (map.window(), map.depth());
    [window.width, window.height, window.padding.0, window.padding.1, window.rounding].put(numbers);
    [depth.near, depth.far, depth.rounding].put(numbers);
    map.camera().put(numbers);
    [map.warp_ratio(), map.weakening()].put(numbers);
    let report = map.report(focus);
    [report.texel, report.aliasing].put(numbers);
    [report.depth_resolution, report.linear_depth_resolution].put(numbers);
}

/// A plane that is neither level nor upright, and one that most lights graze.
const NORMALS: [DVec3; 2] = [DVec3::new(0.25, 1.0, -0.5), DVec3::new(1.0, 0.007_812_5, 0.0)];

fn put_bias(map: &ShadowMap, focus: &Focus<'_>, numbers: &mut Numbers) {
    for (format, filter) in
        FORMATS.into_iter().zip([Filter::Nearest, Filter::Hardware2x2, Filter::Pcf(3), Filter::Pcf(8)])
    {
        let bias = map.bias(format, filter.reach()).expect("a bias");
        bias.put(numbers);
        map.texture_from_world_with(&bias.offset()).put(numbers);
        let tolerance = map.comparison_tolerance(format, filter.reach()).expect("a tolerance");
        [tolerance.constant, tolerance.over_w, tolerance.most, tolerance.slope].put(numbers);
        for point in focus.receiver_volume().vertices() {
            NORMALS.map(|normal| map.bias_distance(*point, normal, &bias)).put(numbers);
        }
    }
}

fn put_points(map: &ShadowMap, focus: &Focus<'_>, numbers: &mut Numbers) {
    let visible = focus.receiver_volume();
    let size = map.window().width.min(map.depth().near.abs() + 1.0);
    for &point in visible.vertices() {
        map.footprint(point).put(numbers);
        map.aliasing(point).put(numbers);
        [map.pixel_size(point), map.depth_rounding(point), map.place_rounding(point)].put(numbers);
        FORMATS.map(|format| map.depth_resolution(point, format)).put(numbers);
        FORMATS.map(|format| map.linear_depth_resolution(point, format)).put(numbers);
        map.splat(point, size / 1024.0).put(numbers);
        for normal in NORMALS {
            map.depth_slopes(point, normal).put(numbers);
            map.disc_splat(point, normal, size / 1024.0).put(numbers);
            let Some(plane) = TangentPlane::new(map, point, normal) else { continue };
            plane.place().put(numbers);
            plane.slopes().put(numbers);
            let stored = |x: u32, y: u32| plane.depth() + (f64::from(x % 3) - f64::from(y % 2)) / 4096.0;
            let tolerance = ComparisonTolerance::constant(0.0);
            [plane.depth(), plane.tolerance(&tolerance)].put(numbers);
            [plane.blended(&tolerance, stored), plane.mean(3, &tolerance, stored)].put(numbers);
        }
    }
}

fn put_paraboloid(map: &Paraboloid, focus: &Focus<'_>, numbers: &mut Numbers) {
    map.caster_matrix().put(numbers);
    map.paraboloid_from_world().put(numbers);
    map.clip_scale().to_array().put(numbers);
    map.texture_scale().put(numbers);
    [map.near(), map.far()].put(numbers);
    map.clip_plane().put(numbers);
    [0.5, 4.0].map(|texels| map.largest_edge(texels)).put(numbers);
    [0.125, 1.5].map(|angle| map.edge_error(angle)).put(numbers);
    let bias = map.bias(DepthFormat::Unorm24, 1.5).expect("a bias");
    bias.put(numbers);
    map.receiver_matrix_with(&bias.offset()).put(numbers);
    for &point in focus.receiver_volume().vertices() {
        let place = map.project(point);
        place.put(numbers);
        place.map(|place| map.unproject(place)).put(numbers);
        map.footprint(point).put(numbers);
        map.aliasing(point).put(numbers);
        let rounding = map.rounding(point);
        [rounding.texels, rounding.depth].put(numbers);
        FORMATS.map(|format| map.depth_resolution(point, format)).put(numbers);
        NORMALS.map(|normal| map.bias_distance(point, normal, &bias)).put(numbers);
        NORMALS.map(|normal| map.distance_slopes(point, normal)).put(numbers);
        map.edge_depth_error(point, focus.view().eye()).put(numbers);
    }
}
