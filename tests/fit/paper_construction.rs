//! The paper's own construction, class by class, against the one formula of the crate.
//!
//! Stamminger & Drettakis (2002, §3.2) take the visible body through the camera's perspective, find the light where
//! that perspective puts it (at λ/λw, or in the direction λ when λw = 0), look from there at the middle of the unit
//! cube, and reverse the depth test when the light is inverted. The crate never divides by λw and knows no cases. Here
//! the paper's matrix is built as the paper says, with its division and its cases, and compared row by row.
//!
//! Rows are compared as covectors, in units in which what is visible is about one in size. Every tolerance is the
//! number of roundings in a chain of operations times the magnitude of the terms that go into it, carried along with
//! the numbers ([`Traced`]); none is an absolute number.

use shadowfit::glam::{DMat4, DVec3, DVec4};
use shadowfit::{
    ClipSpace, Focus, FocusForm, Light, Outcome, Scene, Settings, ShadowMap, View, Warp,
    warp::{ClassKind, Shift, classify},
};

/// Roundings allowed for on either side. The longest chain is a sum of four products for each of five matrices in a
/// row (20 roundings of products, 15 of sums), and the few divisions that make their entries.
const ROUNDINGS: f64 = 64.0 * 0.5 * f64::EPSILON;

#[test]
fn point_lights() {
    agree_with_the_paper(ClassKind::Point, 1);
}

#[test]
fn inverted_lights() {
    agree_with_the_paper(ClassKind::Inverted, 2);
}

#[test]
fn directional_lights() {
    agree_with_the_paper(ClassKind::Directional, 3);
}

#[test]
fn lights_on_the_infinity_plane() {
    agree_with_the_paper(ClassKind::InfinityPlane, 4);
}

#[test]
fn inverted_lights_on_the_infinity_plane() {
    agree_with_the_paper(ClassKind::InfinityPlaneInverted, 5);
}

fn agree_with_the_paper(kind: ClassKind, seed: u64) {
    let mut random = Random(seed);
    for shift in [Shift::None, Shift::Back(FocusForm::ReceiverHull), Shift::Back(FocusForm::ViewHull)] {
        let (mut compared, mut weakened, mut depths) = (0, 0, 0);
        for _ in 0..4000 {
            if let Some(case) = Case::random(kind, shift, &mut random) {
                case.assert_same_rays();
                case.assert_same_warp();
                depths += case.assert_depth_order(&mut random);
                weakened += usize::from(case.map.weakening() > 0.0);
                compared += 1;
            }
        }
        // The paper's warp as it is, and weakened, are both among the cases.
        let pure = compared - weakened;
        assert!(weakened > 250 && pure > 250, "{kind} with {shift:?}: {weakened} weakened, {pure} not");
        assert!(depths > 2500, "{kind} with {shift:?}: only {depths} pairs of depths");
    }
}

/// A fit, its uniform twin, and the paper's construction for the same view, light and scene.
struct Case {
    light: Light,
    visible: Vec<DVec3>,
    map: ShadowMap,
    uniform: ShadowMap,
    paper: Paper,
    /// From units in which what is visible is about one in size.
    world_from_unit: DMat4,
}

impl Case {
    /// `None` where there is nothing to compare: no map, or a light that the virtual camera's perspective brings too
    /// near to a boundary between the paper's cases for its division to be meaningful.
    fn random(kind: ClassKind, shift: Shift, random: &mut Random) -> Option<Self> {
        let camera = Camera::random(kind, random);
        let view = camera.view();
        let light = camera.light(kind, random);
        let (min, max) = camera.scene_box(random);
        let scene = Scene::from_box(min, max).unwrap();
        assert_eq!(classify(&view, &light).kind, kind);

        let focus = Focus::new(&view, &light, &scene);
        let settings = Settings::default().with_warp(Warp::Perspective).with_shift(shift);
        let Outcome::Map(map) = focus.fit(&settings) else {
            return None;
        };
        let Outcome::Map(uniform) = focus.fit(&settings.with_warp(Warp::Uniform)) else {
            panic!("a warp decides whether there is a map");
        };
        let visible = focus.receiver_volume().vertices().to_vec();
        let paper = Paper::new(&camera, &view, &map, light.homogeneous(), &visible)?;
        let (low, high) = focus.receiver_volume().bounds()?;
        let size = (high - low).max_element();
        let world_from_unit = DMat4::from_translation((low + high) * 0.5) * DMat4::from_scale(DVec3::splat(size));
        Some(Self { light, visible, map, uniform, paper, world_from_unit })
    }

    fn paper_rows(&self) -> Rows {
        Rows::new(&self.paper.matrix.times(&Traced::exact(self.world_from_unit)))
    }

    /// The crate's rows are sums of covectors through the light and through the eye. Axes are turned, so that each
    /// component of a normal is off by roundings of its length.
    fn our_rows(&self, map: &ShadowMap) -> Rows {
        let matrix = map.clip_from_world_in(ClipSpace::WGPU);
        let position = self.light.position().unwrap_or(map.camera().eye).abs();
        let centre = self.world_from_unit.w_axis.truncate().abs();
        let far = position.max(map.camera().eye.abs()).max(centre);
        let terms = [0, 1, 2, 3].map(|row| {
            let normal = DVec3::splat(matrix.row(row).truncate().length());
            normal.extend(matrix.row(row).w.abs() + normal.dot(far))
        });
        let terms = DMat4::from_cols(terms[0], terms[1], terms[2], terms[3]).transpose();
        Rows::new(&Traced { value: matrix, terms }.times(&Traced::exact(self.world_from_unit)))
    }

    /// Our w without the part of it that weakens the warp.
    fn our_warp(&self) -> Row {
        let (ours, uniform) = (self.our_rows(&self.map).w, self.our_rows(&self.uniform));
        // The report counts that part on the ray in the middle of the uniform map, where its x and y are zero. Any
        // point of the ray will do: the one nearest to the middle of what is visible.
        let [x, y] = [uniform.x.value, uniform.y.value];
        let along = x.truncate().cross(y.truncate());
        let middle = (y.truncate().cross(along) * x.w + along.cross(x.truncate()) * y.w) / -along.length_squared();
        let middle = middle.extend(1.0);
        let uniform = uniform.w;
        let (at, uniform_at) = (ours.at(middle), uniform.at(middle));
        let part = self.map.weakening() * at.0 / uniform_at.0;
        let part_terms = part.abs() * (at.1 / at.0.abs() + uniform_at.1 / uniform_at.0.abs());
        Row {
            value: ours.value - uniform.value * part,
            terms: ours.terms + uniform.terms * part.abs() + uniform.value.abs() * part_terms,
        }
    }

    /// Both maps take rays from the light to points: rows x, y and w span the same covectors, those that vanish at l.
    fn assert_same_rays(&self) {
        let (ours, paper) = (self.our_rows(&self.map), self.paper_rows());
        let l = self.world_from_unit.inverse() * self.light.homogeneous();
        let basis = Basis::new([&paper.x, &paper.y, &paper.w]);
        for row in [&ours.x, &ours.y, &ours.w, &paper.x, &paper.y, &paper.w] {
            let (off, terms) = row.at(l);
            assert!(off.abs() <= ROUNDINGS * terms, "a row misses the light: {self}");
        }
        for row in [&ours.x, &ours.y, &ours.w, &self.our_warp()] {
            let (left, amplified) = basis.residual(row);
            assert!(left <= ROUNDINGS * amplified, "{left:e} of {amplified:e}: {self}");
        }
    }

    /// w is the paper's, but for the part of the uniform map's that the crate says it has added.
    fn assert_same_warp(&self) {
        let (ours, paper) = (self.our_warp(), self.paper_rows().w);
        let factor = ours.value.dot(paper.value) / paper.value.length_squared();
        let left = (ours.value - paper.value * factor).length();
        let tolerance = ROUNDINGS * (ours.terms.length() + factor.abs() * paper.terms.length());
        assert!(left <= tolerance, "w is off by {left:e}, not {tolerance:e}: {self}");
        // What is left of a warp that is weakened to nothing has no sign.
        if ours.value.length() > tolerance {
            assert!(factor > 0.0, "w has the wrong sign: {self}");
        }
    }

    /// Depth grows away from the light in our map, and in the paper's, unless the light is inverted. Returns how many
    /// pairs of points were compared.
    fn assert_depth_order(&self, random: &mut Random) -> usize {
        let ours = self.map.clip_from_world_in(ClipSpace::WGPU);
        let l = self.light.homogeneous();
        let size = self.world_from_unit.x_axis.x;
        let mut compared = 0;
        for _ in 0..8 {
            let receiver = random.inside(&self.visible);
            let towards = match self.light.position() {
                Some(position) => (position - receiver) * random.between(0.1, 0.9),
                None => l.truncate() * (size * random.between(0.1, 2.0)),
            };
            let caster = receiver + towards;
            let (behind, before) = (depth(&ours, receiver), depth(&ours, caster));
            assert!(before < behind, "a caster is not before its receiver: {self}");
            // The paper's map wraps around what is not before its virtual camera, nor before its image plane.
            let paper = &self.paper;
            let seen = |point: DVec3| {
                paper.camera.value.row(3).dot(point.extend(1.0)) > 0.0
                    && paper.matrix.value.row(3).dot(point.extend(1.0)) > 0.0
            };
            if paper.in_front && seen(caster) && seen(receiver) {
                let (behind, before) = (depth(&paper.matrix.value, receiver), depth(&paper.matrix.value, caster));
                assert_eq!(before > behind, paper.inverted, "{before} {behind}: {self}");
                compared += 1;
            }
        }
        compared
    }
}

impl core::fmt::Display for Case {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(
            f,
            "{:?}, camera {:?}, weakening {}, ratio {}",
            self.light,
            self.map.camera(),
            self.map.weakening(),
            self.map.warp_ratio()
        )
    }
}

/// z/w at a point.
fn depth(matrix: &DMat4, point: DVec3) -> f64 {
    let clip = *matrix * point.extend(1.0);
    clip.z / clip.w
}

/// The paper's shadow map, as the paper builds it.
struct Paper {
    /// World to the shadow map's clip space.
    matrix: Traced,
    /// The virtual camera's, world to clip.
    camera: Traced,
    /// λw < 0: the light's order is the other way round.
    inverted: bool,
    /// All of what is visible is before the light's image plane, so that the window is one around it.
    in_front: bool,
}

impl Paper {
    fn new(camera: &Camera, view: &View, map: &ShadowMap, l: DVec4, visible: &[DVec3]) -> Option<Self> {
        let camera = camera.matrix(view, map.camera().shift, map.camera().near, map.camera().far);
        let lambda = camera.on(l);
        let at_infinity = lambda.value.w == 0.0;
        let margin = lambda.value.w.abs() / lambda.value.abs().max_element();
        if !at_infinity && margin < 1e-3 {
            return None;
        }
        let look =
            if at_infinity { Traced::looking_along(&lambda) } else { Traced::looking_from(&lambda.divided()) };
        if look.value.row(2).truncate().is_nan() {
            return None;
        }
        // What is visible as the light's camera sees it: after the camera's perspective, and turned.
        let light_from_world = look.times(&camera);
        let seen: Vec<DVec3> = visible
            .iter()
            .map(|point| {
                let clip = light_from_world.value * point.extend(1.0);
                clip.truncate() / clip.w
            })
            .collect();
        let (projection, in_front) = if at_infinity {
            (parallel_around(&seen), true)
        } else {
            let nearest = seen.iter().map(|point| point.z).fold(f64::INFINITY, f64::min);
            if nearest > 0.0 {
                (perspective_around(&seen), true)
            } else {
                // The paper looks at the middle of the unit cube all the same, and something is beside the image.
                (perspective(DVec3::new(-1.0, -1.0, 0.5), DVec3::new(1.0, 1.0, 2.0)), false)
            }
        };
        let matrix = Traced::exact(projection).times(&light_from_world);
        Some(Self { matrix, camera, inverted: lambda.value.w < 0.0, in_front })
    }
}

/// A parallel projection, z from 0 to 1, that looks along +z at points.
fn parallel_around(points: &[DVec3]) -> DMat4 {
    let (min, max) = bounds(points);
    let (centre, half) = ((min + max) * 0.5, (max - min) * 0.5);
    DMat4::from_scale(DVec3::new(1.0, 1.0, 0.5) / half)
        * DMat4::from_translation(DVec3::new(-centre.x, -centre.y, -min.z))
}

/// A perspective projection, z from 0 to 1, that looks along +z from the origin at points before it.
fn perspective_around(points: &[DVec3]) -> DMat4 {
    let slopes: Vec<DVec3> =
        points.iter().map(|point| DVec3::new(point.x / point.z, point.y / point.z, point.z)).collect();
    let (min, max) = bounds(&slopes);
    perspective(min, max)
}

/// A perspective projection with slopes in x and y, and depths in z.
fn perspective(min: DVec3, max: DVec3) -> DMat4 {
    let (centre, half) = ((min + max) * 0.5, (max - min) * 0.5);
    let length = max.z - min.z;
    DMat4::from_cols(
        DVec4::new(1.0 / half.x, 0.0, 0.0, 0.0),
        DVec4::new(0.0, 1.0 / half.y, 0.0, 0.0),
        DVec4::new(-centre.x / half.x, -centre.y / half.y, max.z / length, 1.0),
        DVec4::new(0.0, 0.0, -max.z * min.z / length, 0.0),
    )
}

/// The least and largest coordinates, never quite the same, as a flat projection has no inverse.
fn bounds(points: &[DVec3]) -> (DVec3, DVec3) {
    let min = points.iter().fold(DVec3::INFINITY, |min, point| min.min(*point));
    let max = points.iter().fold(DVec3::NEG_INFINITY, |max, point| max.max(*point));
    (min, max.max(min + DVec3::splat(1e-9)))
}

/// A camera's own numbers: the axes come back from the [`View`], the frame is kept here.
struct Camera {
    eye: DVec3,
    right: DVec3,
    up: DVec3,
    forward: DVec3,
    /// Slopes of the frame's lower left and upper right corner.
    low: (f64, f64),
    high: (f64, f64),
    near: f64,
    far: f64,
}

impl Camera {
    /// Off axis, anywhere, looking anywhere; along an axis of the world where λw = 0 is to be exact.
    fn random(kind: ClassKind, random: &mut Random) -> Self {
        let eye = random.direction() * random.between(0.0, 20.0);
        let (forward, up) = if kind == ClassKind::Directional {
            let turn = random.below(3);
            let axes = [DVec3::X, DVec3::Y, DVec3::Z];
            let sign = if random.below(2) == 0 { 1.0 } else { -1.0 };
            (axes[turn] * sign, axes[(turn + 1) % 3])
        } else {
            (random.direction(), random.direction())
        };
        let right = forward.cross(up).normalize();
        let (width, height) = (random.between(0.2, 1.2), random.between(0.2, 1.2));
        let (x, y) = (random.between(-0.3, 0.3) * width, random.between(-0.3, 0.3) * height);
        let near = random.power_of_ten(-1.0, 0.0);
        Self {
            eye,
            right,
            up: right.cross(forward),
            forward,
            low: (x - width, y - height),
            high: (x + width, y + height),
            near,
            far: near * random.power_of_ten(1.0, 3.5),
        }
    }

    fn view(&self) -> View {
        let axes = [self.right, self.up, -self.forward].map(|axis| axis.extend(-axis.dot(self.eye)));
        let eye_from_world = DMat4::from_cols(axes[0], axes[1], axes[2], DVec4::W).transpose();
        let rows = self.frame_rows();
        let (near, far) = (self.near, self.far);
        let clip_from_eye = DMat4::from_cols(
            DVec4::new(rows.0.0, 0.0, -rows.0.1, 0.0),
            DVec4::new(0.0, rows.1.0, -rows.1.1, 0.0),
            DVec4::new(0.0, 0.0, -far / (far - near), -near * far / (far - near)),
            DVec4::new(0.0, 0.0, -1.0, 0.0),
        )
        .transpose();
        View::from_matrices(eye_from_world, clip_from_eye, ClipSpace::WGPU).unwrap()
    }

    /// For x and for y, what is multiplied by the offset from the axis and what by the depth.
    fn frame_rows(&self) -> ((f64, f64), (f64, f64)) {
        let row = |low: f64, high: f64| (2.0 / (high - low), -(high + low) / (high - low));
        (row(self.low.0, self.high.0), row(self.low.1, self.high.1))
    }

    /// The 4×4 of this camera moved back, between two depths, z from −1 to 1.
    fn matrix(&self, view: &View, shift: f64, near: f64, far: f64) -> Traced {
        let eye = view.eye() - view.forward() * shift;
        let clip_from_eye = {
            let (x, y) = self.frame_rows();
            let length = far - near;
            DMat4::from_cols(
                DVec4::new(x.0, 0.0, x.1, 0.0),
                DVec4::new(0.0, y.0, y.1, 0.0),
                DVec4::new(0.0, 0.0, (far + near) / length, -2.0 * far * near / length),
                DVec4::new(0.0, 0.0, 1.0, 0.0),
            )
            .transpose()
        };
        let rotation =
            DMat4::from_cols(view.right().extend(0.0), view.up().extend(0.0), view.forward().extend(0.0), DVec4::W)
                .transpose();
        Traced::exact(clip_from_eye)
            .times(&Traced::exact(rotation).times(&Traced::exact(DMat4::from_translation(-eye))))
    }

    fn light(&self, kind: ClassKind, random: &mut Random) -> Light {
        let across = loop {
            let direction = random.direction();
            let sine = direction.dot(self.forward);
            match kind {
                ClassKind::Point | ClassKind::InfinityPlane if sine > 0.05 => break direction,
                ClassKind::Inverted | ClassKind::InfinityPlaneInverted if sine < -0.05 => {
                    break direction;
                }
                // A camera along an axis of the world: no forward component at all.
                ClassKind::Directional if sine.abs() < 0.9 => {
                    break direction * (DVec3::ONE - self.forward.abs());
                }
                _ => {}
            }
        };
        let local = match kind {
            ClassKind::Point | ClassKind::Inverted => true,
            ClassKind::InfinityPlane | ClassKind::InfinityPlaneInverted => false,
            ClassKind::Directional => random.below(2) == 0,
        };
        if local {
            let position = self.eye + across * random.power_of_ten(0.0, 2.5);
            Light::point(position, 1e-3, f64::INFINITY).unwrap()
        } else {
            Light::directional(across).unwrap()
        }
    }

    /// A box that the camera looks at.
    fn scene_box(&self, random: &mut Random) -> (DVec3, DVec3) {
        let middle = self.eye + self.forward * random.power_of_ten(0.0, 2.0);
        let mut half = || random.power_of_ten(0.0, 1.7);
        let half = DVec3::new(half(), half(), half());
        (middle - half, middle + half)
    }
}

/// A matrix, and the magnitude of the terms that each of its entries was summed from: an entry is off by no more than
/// a number of roundings of it.
#[derive(Clone, Copy)]
struct Traced {
    value: DMat4,
    terms: DMat4,
}

impl Traced {
    /// Entries that were not summed from larger ones.
    fn exact(value: DMat4) -> Self {
        Self { value, terms: absolute(&value) }
    }

    fn times(&self, other: &Self) -> Self {
        Self { value: self.value * other.value, terms: self.terms * other.terms }
    }

    fn on(&self, point: DVec4) -> Row {
        Row { value: self.value * point, terms: self.terms * point.abs() }
    }

    /// From a point, with its uncertainty, towards the origin.
    fn looking_from(light: &Row) -> Self {
        let position = light.value.truncate();
        let axis = -position.normalize();
        let off = light.terms.truncate().length() / position.length();
        Self::turned(axis, off).times(&Self {
            value: DMat4::from_translation(-position),
            terms: DMat4 { w_axis: light.terms.truncate().extend(1.0), ..DMat4::IDENTITY },
        })
    }

    /// Along the rays of a light in a direction, with its uncertainty.
    fn looking_along(light: &Row) -> Self {
        let direction = light.value.truncate();
        let off = light.terms.truncate().length() / direction.length();
        Self::turned(-direction.normalize(), off)
    }

    /// Turned so that `axis`, each component of which is off by so many roundings, is +z.
    fn turned(axis: DVec3, off: f64) -> Self {
        let (x, y) = axis.any_orthonormal_pair();
        let value = DMat4::from_cols(x.extend(0.0), y.extend(0.0), axis.extend(0.0), DVec4::W).transpose();
        let off = DVec3::splat(off.max(1.0)).extend(0.0);
        Self { value, terms: DMat4::from_cols(off, off, off, DVec4::W) }
    }
}

fn absolute(matrix: &DMat4) -> DMat4 {
    DMat4::from_cols(matrix.x_axis.abs(), matrix.y_axis.abs(), matrix.z_axis.abs(), matrix.w_axis.abs())
}

/// A covector or a homogeneous point, and the magnitude of the terms that it was summed from.
struct Row {
    value: DVec4,
    terms: DVec4,
}

impl Row {
    /// The value at a homogeneous point, and the magnitude of its terms.
    fn at(&self, point: DVec4) -> (f64, f64) {
        (self.value.dot(point), self.terms.dot(point.abs()))
    }

    /// A homogeneous point divided by its w.
    fn divided(&self) -> Self {
        let w = self.value.w;
        Self { value: self.value / w, terms: self.terms / w.abs() + self.value.abs() * (self.terms.w / (w * w)) }
    }
}

/// The rows that take rays to points. Depth is compared by its order.
struct Rows {
    x: Row,
    y: Row,
    w: Row,
}

impl Rows {
    fn new(matrix: &Traced) -> Self {
        let row = |index| Row { value: matrix.value.row(index), terms: matrix.terms.row(index) };
        Self { x: row(0), y: row(1), w: row(3) }
    }
}

/// An orthonormal basis of the span of three covectors, made one after another.
struct Basis {
    directions: [DVec4; 3],
    /// How far the uncertainty of the three turns each direction.
    turns: [f64; 3],
}

impl Basis {
    fn new(rows: [&Row; 3]) -> Self {
        let mut basis = Self { directions: [DVec4::ZERO; 3], turns: [0.0; 3] };
        for (index, row) in rows.into_iter().enumerate() {
            let (mut left, mut off) = (row.value, row.terms.length());
            for before in 0..index {
                let along = left.dot(basis.directions[before]);
                left -= basis.directions[before] * along;
                off += along.abs() * basis.turns[before];
            }
            assert!(left.length() > ROUNDINGS * off, "the rows are not independent");
            basis.directions[index] = left.normalize();
            basis.turns[index] = off / left.length();
        }
        basis
    }

    /// What a row has beside the span, and the magnitude that its roundings are to be counted in.
    fn residual(&self, row: &Row) -> (f64, f64) {
        let (mut left, mut off) = (row.value, row.terms.length());
        for (direction, turn) in self.directions.iter().zip(self.turns) {
            let along = left.dot(*direction);
            left -= *direction * along;
            off += along.abs() * turn;
        }
        (left.length(), off)
    }
}

/// `SplitMix64`.
struct Random(u64);

impl Random {
    /// A number in [0, 1).
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((bits ^ (bits >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn below(&mut self, count: usize) -> usize {
        (self.unit() * count as f64) as usize
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// A number whose logarithm is even between two exponents.
    fn power_of_ten(&mut self, low: f64, high: f64) -> f64 {
        10_f64.powf(self.between(low, high))
    }

    fn direction(&mut self) -> DVec3 {
        loop {
            let mut signed = || self.between(-1.0, 1.0);
            let inside = DVec3::new(signed(), signed(), signed());
            if (0.01..=1.0).contains(&inside.length_squared()) {
                return inside.normalize();
            }
        }
    }

    /// A point in the hull of points.
    fn inside(&mut self, points: &[DVec3]) -> DVec3 {
        let weights: Vec<f64> = points.iter().map(|_| self.unit()).collect();
        let sum: f64 = weights.iter().sum();
        points.iter().zip(&weights).map(|(point, weight)| *point * (*weight / sum)).sum()
    }
}
