//! The focus bodies of the crate against the exact ones.
//!
//! The exact bodies are those of the very `f64` planes that the crate hands out, and for each of
//! R = V ∩ S ∩ L, hull(V, l) ∩ S ∩ L and hull(R, l) ∩ S ∩ L two things are asserted:
//!
//! - **Nothing is lost.** No exact vertex lies outside any plane of the computed body, nor outside
//!   the hull of its vertices, by anything at all: in doubt a body grows. So whatever meets the exact
//!   body is kept by culling, and where the exact body is not empty the computed one is not.
//! - **Little is gained.** Every computed vertex lies inside the exact body's half-spaces moved
//!   outwards by δ, and there is none where that body is empty.
//!
//! A plane n·x + offset of V, S or L moves by 2 · 96 ε (|n|·extent + |offset|)/|n|: the core moves it
//! by half of that, and the other half is what its own argument allows for the rounding of vertices.
//! The planes of a hull follow. Elimination leaves Y in the computed hull exactly if some β ≥ 0 has
//! πᵢ(Y) + mᵢ ≥ β (πᵢ·l + eᵢ) for all planes, mᵢ their slack and eᵢ the rounding of πᵢ·l; so Y − βl is
//! in the body of planes moved by mᵢ + β|eᵢ|, and Y is no farther from hull(V, l) than that body's
//! vertices are from V's. δ is this displacement, of any three planes of V, and of hull(R, l) the
//! distance that the vertices of R so moved travel when they move as far again, twice over, since
//! towards the light other vertices may take over. It carries the conditioning of V and of R: for a
//! needle the vertices travel far. How far from the exact body a computed vertex is in the end has no
//! bound but this one: a light that grazes a flat scene turns a rounding into all of it.

use shadowfit::glam::{DVec3, Vec3};
use shadowfit::{
    Aabb, Focus, FocusForm, View,
    focus::{ConvexBody as Computed, Plane},
};

use crate::arbitrary::{Case, SceneParams, plane};
use crate::oracle::body::Body;
use crate::oracle::distance::outside;
use crate::oracle::homogeneous::{ExactPlane, ExactPoint, Homogeneous};
use crate::oracle::hull::{facets, hull};
use crate::oracle::loss::{Shape, losses};

/// What the core moves planes by, in units of the sum of the magnitudes of their terms.
const SLACK: f64 = 96.0 * f64::EPSILON;

/// Roundings of a plane's value at the light, in the same units.
const AT_LIGHT: f64 = 4.0 * f64::EPSILON;

/// The planes of a case, and how large its numbers are.
pub struct Input {
    view: View,
    pub v: Vec<Plane>,
    /// S and L.
    pub lit: Vec<Plane>,
    pub light: [f64; 4],
    /// The largest coordinates in S.
    pub extent: DVec3,
}

impl Input {
    /// None for scenes of lists, whose bounds are the crate's own choice.
    pub fn of(case: &Case) -> Option<Self> {
        let cuts = match &case.scene {
            SceneParams::Bounds { .. } => Vec::new(),
            SceneParams::Cut { planes, .. } => planes.iter().copied().map(plane).collect(),
            SceneParams::Lists { .. } => return None,
        };
        let (view, light) = case.build();
        let (min, max) = case.scene.bounds();
        let mut lit = Vec::new();
        for (axis, normal) in DVec3::AXES.into_iter().enumerate() {
            lit.extend([Plane::new(normal, -min[axis]), Plane::new(-normal, max[axis])]);
        }
        lit.extend(cuts);
        lit.extend_from_slice(light.planes().as_slice());
        let extent = DVec3::from(min).abs().max(DVec3::from(max).abs());
        Some(Self {
            view,
            v: view.planes().as_slice().to_vec(),
            lit,
            light: light.homogeneous().to_array(),
            extent,
        })
    }

    /// The crate's R, the paper's H and the tight H.
    pub fn computed(&self, case: &Case) -> [Computed; 3] {
        let (view, light) = case.build();
        let store = case.scene.store();
        let scene = store.scene().expect("the scene is accepted");
        let focus = Focus::new(&view, &light, &scene);
        [
            focus.receiver_volume(),
            focus.caster_volume(FocusForm::ViewHull),
            focus.caster_volume(FocusForm::ReceiverHull),
        ]
    }

    /// The exact body of one of these.
    pub fn exact_body(&self, index: usize) -> Body {
        let cut = |hull: &[ExactPlane]| {
            let lit: Vec<ExactPlane> = self.lit.iter().map(exact).collect();
            Body::from_exact_planes([&lit[..], hull].concat())
        };
        let visible = || Body::from_exact_planes(self.planes().iter().map(exact).collect());
        match index {
            0 => visible(),
            1 => {
                let v: Vec<[f64; 4]> = self.v.iter().map(|plane| plane.to_row().to_array()).collect();
                cut(&hull(&v, self.light))
            }
            _ => cut(&self.hull_of(&visible())),
        }
    }

    pub fn planes(&self) -> Vec<Plane> {
        [&self.lit[..], &self.v].concat()
    }

    /// The slack of a plane's value in S.
    fn slack(&self, plane: &Plane) -> f64 {
        SLACK * (plane.normal.abs().dot(self.extent) + plane.offset.abs())
    }

    /// The rounding of a plane's value at the light.
    fn at_light(&self, plane: &Plane) -> f64 {
        let [x, y, z, w] = self.light;
        AT_LIGHT * (plane.normal.abs().dot(DVec3::new(x, y, z).abs()) + plane.offset.abs() * w)
    }

    /// The half-spaces of S and L, or of all, with what they may be moved outwards by.
    fn half_spaces(&self, planes: &[Plane]) -> Vec<HalfSpace> {
        let bound = |plane: &Plane| 2.0 * self.slack(plane) / plane.normal.length();
        planes.iter().map(|plane| HalfSpace { plane: exact(plane), bound: bound(plane) }).collect()
    }

    /// The largest β that takes a point of something so large from the origin along with the light into S.
    fn largest_beta(&self, size: f64) -> f64 {
        let [x, y, z, w] = self.light;
        let distance = DVec3::new(x, y, z).length() - size;
        if w == 0.0 { 2.0 * size } else { (2.0 * size / distance.max(0.0)).min(1.0) }
    }

    /// δ for hull(V, l).
    fn displacement_of_view(&self) -> f64 {
        let depth = self.view.near() + 4.0 * (self.extent.length() + self.view.eye().length());
        let far = self.view.far().min(depth.max(2.0 * self.view.near()));
        let corners = self.view.narrowed(self.view.near(), far).ok().and_then(|view| view.corners());
        let corners = corners.expect("a depth range within the view's own");
        let beta =
            self.largest_beta(corners.iter().map(|corner| corner.length()).fold(self.extent.length(), f64::max));
        let by = |plane: &Plane| 3.0 * self.slack(plane) + beta * self.at_light(plane);
        displacement(&self.v.iter().map(|plane| (*plane, by(plane))).collect::<Vec<_>>())
    }

    /// R of planes moved outwards by `times` what the crate may have moved them by when it makes hull(R, l): once in R,
    /// again in the hull, and as much for the roundings of either.
    fn grown_visible(&self, times: f64) -> Body {
        let beta = self.largest_beta(self.extent.length());
        let moved = |plane: &Plane| {
            let by = (4.0 + beta * self.light[3]) * self.slack(plane) + beta * self.at_light(plane);
            exact(&Plane::new(plane.normal, (plane.offset + times * by).next_up()))
        };
        Body::from_exact_planes(self.planes().iter().map(moved).collect())
    }

    /// The half-spaces of hull(R, l); one that holds nothing where R is empty.
    fn hull_of(&self, visible: &Body) -> Vec<ExactPlane> {
        if visible.is_empty() {
            return vec![Homogeneous::from_f64([0.0, 0.0, 0.0, -1.0])];
        }
        let mut points: Vec<ExactPoint> = visible.vertices.iter().map(|vertex| vertex.point.clone()).collect();
        points.push(Homogeneous::from_f64(self.light));
        facets(&points)
    }
}

/// A half-space, and how far outside of it a computed vertex may be.
struct HalfSpace {
    plane: ExactPlane,
    bound: f64,
}

fn exact(plane: &Plane) -> ExactPlane {
    Homogeneous::from_f64(plane.to_row().to_array())
}

/// The farthest that a common point of three planes moves when their values change by as much as is given with each.
fn displacement(planes: &[(Plane, f64)]) -> f64 {
    let mut farthest: f64 = 0.0;
    for (i, (a, by_a)) in planes.iter().enumerate() {
        farthest = farthest.max(by_a / a.normal.length());
        for (j, (b, by_b)) in planes.iter().enumerate().skip(i + 1) {
            for (c, by_c) in planes.iter().skip(j + 1) {
                let [a, b, c] = [a, b, c].map(|plane| plane.normal);
                let volume = a.dot(b.cross(c)).abs();
                let sizes = a.length() * b.length() * c.length();
                // Planes through one line have no common point: a frustum's left, right and near.
                if volume > 1e-9 * sizes {
                    let sum = by_a * b.cross(c).length() + by_b * c.cross(a).length() + by_c * a.cross(b).length();
                    farthest = farthest.max(sum / volume);
                }
            }
        }
    }
    farthest
}

/// What was found for one of the three bodies.
#[derive(Default)]
pub struct Figures {
    empty: usize,
    flat: usize,
    solid: usize,
    /// Exactly empty, and computed as something within the bound.
    almost_empty: usize,
    /// Distances of the farthest computed vertex, in units of the largest coordinates of S.
    distances: Vec<f64>,
    /// Of the farthest computed vertex outside a half-space, in units of its bound.
    used: f64,
}

impl Figures {
    /// Prints them.
    pub fn print(&mut self, name: &str) {
        let Self { empty, flat, solid, almost_empty, distances, used } = self;
        distances.sort_by(f64::total_cmp);
        let at = |part: f64| distances.get((part * distances.len() as f64) as usize).or(distances.last());
        println!("{name}: {empty} empty ({almost_empty} of them within the bound), {flat} flat, {solid} solid");
        println!("    nothing lost; at most {used:.3} of the bound used; distances relative to the scene:");
        println!("    median {:?}, 99 % {:?}, worst {:?}", at(0.5), at(0.99), at(1.0));
    }
}

/// Asserts that a computed body holds the exact one and remains within half-spaces.
fn compare(name: &str, computed: &Computed, exact: &Body, outer: &[HalfSpace], scale: f64, figures: &mut Figures) {
    let points: Vec<ExactPoint> =
        computed.vertices().iter().map(|vertex| Homogeneous::from_position(vertex.to_array())).collect();

    if let Some(loss) = losses(&Shape::of(computed), exact).first() {
        panic!("{name}: {loss}");
    }

    for HalfSpace { plane, bound } in outer {
        for (point, vertex) in points.iter().zip(computed.vertices()) {
            let gained = outside(plane, point);
            assert!(gained <= *bound, "{name}: {vertex} is {gained:e} outside, more than {bound:e}");
            figures.used = figures.used.max(if gained > 0.0 { gained / bound } else { 0.0 });
        }
    }

    if exact.is_empty() {
        figures.empty += 1;
        figures.almost_empty += usize::from(!computed.is_empty());
        return;
    }
    let everywhere = |plane: usize| exact.vertices.iter().all(|vertex| vertex.tight.contains(&plane));
    let flat = (0..exact.planes.len()).any(everywhere);
    *if flat { &mut figures.flat } else { &mut figures.solid } += 1;
    let distance = |vertex: &DVec3| exact.distance(vertex.to_array());
    figures.distances.push(computed.vertices().iter().map(distance).fold(0.0, f64::max) / scale);
}

/// Asserts that culling keeps whatever touches a vertex of the exact body.
fn cull(name: &str, computed: &Computed, exact: &Body) {
    let culler = computed.culler();
    let (mut boxes, mut balls) = (Vec::new(), Vec::new());
    for (index, vertex) in exact.vertices_f64().into_iter().enumerate() {
        // The rounded vertex is a rounding away from the exact one.
        let vertex = DVec3::from(vertex);
        let (min, max) = (vertex.map(f64::next_down), vertex.map(f64::next_up));
        assert!(computed.intersects_aabb(min, max), "{name}: a box at {vertex} is dropped");
        boxes.push(Aabb::new(min.as_vec3().map(f32::next_down), max.as_vec3().map(f32::next_up)));

        let arm = DVec3::AXES[index % 3] * [0.0, 1.0, -100.0, 1e-6][index % 4];
        let radius =
            |centre: DVec3| (centre.distance(vertex) + f64::EPSILON * vertex.length()) * (1.0 + 4.0 * f64::EPSILON);
        let centre = vertex + arm;
        assert!(
            computed.intersects_sphere(centre, radius(centre)),
            "{name}: a ball that reaches {vertex} is dropped"
        );
        let centre: Vec3 = centre.as_vec3();
        balls.push(centre.extend((radius(centre.as_dvec3()) as f32).next_up()));
    }
    let mut meets = vec![false; boxes.len()];
    culler.boxes(&boxes, &mut meets);
    assert!(meets.iter().all(|&meets| meets), "{name}: of {boxes:?} the bulk keeps {meets:?}");
    culler.spheres(&balls, &mut meets);
    assert!(meets.iter().all(|&meets| meets), "{name}: of {balls:?} the bulk keeps {meets:?}");
}

/// Compares the three bodies of a case.
pub fn check(case: &Case, figures: &mut [Figures; 3]) {
    let Some(input) = Input::of(case) else { return };
    let (view, light) = case.build();
    let store = case.scene.store();
    let scene = store.scene().expect("the scene is accepted");
    let focus = Focus::new(&view, &light, &scene);
    let scale = input.extent.length();
    let lit: Vec<ExactPlane> = input.lit.iter().map(exact).collect();
    let cut = |hull: &[ExactPlane]| Body::from_exact_planes([&lit[..], hull].concat());
    let bounded = |hull: Vec<ExactPlane>, bound: f64| {
        let mut outer = input.half_spaces(&input.lit);
        outer.extend(hull.into_iter().map(|plane| HalfSpace { plane, bound }));
        outer
    };
    let [of_visible, of_paper, of_tight] = figures;

    let planes = input.planes();
    let visible = Body::from_exact_planes(planes.iter().map(exact).collect());
    compare("R", &focus.receiver_volume(), &visible, &input.half_spaces(&planes), scale, of_visible);

    let v: Vec<[f64; 4]> = input.v.iter().map(|plane| plane.to_row().to_array()).collect();
    let facets = hull(&v, input.light);
    let (paper, computed) = (cut(&facets), focus.caster_volume(FocusForm::ViewHull));
    compare("paper", &computed, &paper, &bounded(facets, input.displacement_of_view()), scale, of_paper);
    cull("paper", &computed, &paper);

    let (tight, computed) = (cut(&input.hull_of(&visible)), focus.caster_volume(FocusForm::ReceiverHull));
    let grown = input.grown_visible(1.0);
    let more = input.grown_visible(2.0).vertices_f64().into_iter().map(|vertex| grown.distance(vertex));
    let bound = if grown.is_empty() { 0.0 } else { 2.0 * more.fold(0.0, f64::max) };
    compare("tight", &computed, &tight, &bounded(input.hull_of(&grown), bound), scale, of_tight);
    cull("tight", &computed, &tight);
}

/// Compares the three bodies of one case, for the fuzz target and for what it has kept.
pub fn check_case(case: &Case) {
    check(case, &mut Default::default());
}
