//! The best single matrix by brute force: what the crate's search is held against.
//!
//! Nothing here is the crate's but the vertices of R. A map is a covector c and two sides of a window, and what it makes of a
//! vertex is measured by pushing the vertex and two points beside it, across its ray, through the map. The search is
//! Nelder & Mead's simplex from many places, begun again around what it finds.

use glam::{DMat2, DVec2, DVec3};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use shadowfit::{Light, View};
use std::f64::consts::FRAC_PI_2;

/// A vertex: its place on a plane across the light, and the two rays that pass it at right angles to each other, half a
/// pixel away, on that plane.
struct Vertex {
    place: DVec2,
    beside: [DVec2; 2],
}

/// Vertices on a plane that all rays of the light to them meet.
pub(super) struct Plane {
    vertices: Vec<Vertex>,
    /// Texels across and down of a map whose area is one texel.
    sides: DVec2,
}

/// Where the sides of a window are, and c: the numbers that are searched over. c is 1 + tilt · place, x runs along (1, lean)
/// and y along (lean, 1), turned by an angle, on a plane where the uniform window is [−1, 1]².
#[derive(Clone, Copy, Debug)]
struct Candidate([f64; 5]);

/// The part of a pixel that is stepped beside a vertex.
const BESIDE: f64 = 1e-6;

/// The depth from which on points count by their own depth: nearer ones, in the air before all that is seen, count as if they
/// stood there.
pub(super) fn nearest(view: &View, points: &[DVec3]) -> f64 {
    points.iter().map(|&point| view.depth(point)).fold(0.0, f64::max) / 256.0
}

impl Plane {
    /// `None` where the light has some vertex beside it or behind. The map is so many times as wide as high.
    pub(super) fn new(view: &View, light: &Light, vertices: &[DVec3], shape: f64) -> Option<Self> {
        let ray = |point: DVec3| -light.direction_from(point);
        let axis = vertices.iter().map(|&vertex| ray(vertex)).sum::<DVec3>().try_normalize()?;
        let (right, up) = axis.any_orthonormal_pair();
        let onto = |point: DVec3| match light.position() {
            None => Some(DVec2::new(right.dot(point), up.dot(point))),
            Some(position) => {
                let arm = point - position;
                let along = axis.dot(arm);
                (along > 0.05 * arm.length()).then(|| DVec2::new(right.dot(arm), up.dot(arm)) / along)
            }
        };
        let nearest = nearest(view, vertices);
        let on_plane = |&point: &DVec3| {
            let (side, other) = ray(point).any_orthonormal_pair();
            let pixel = 2.0 * view.half_height(view.depth(point).max(nearest));
            let place = onto(point)?;
            let beside = [side, other]
                .map(|across| onto(point + across * (pixel * BESIDE)).map(|beside| (beside - place) / BESIDE));
            Some(Vertex { place, beside: [beside[0]?, beside[1]?] })
        };
        let mut vertices = vertices.iter().map(on_plane).collect::<Option<Vec<_>>>()?;
        let (min, max) = bounds(vertices.iter().map(|vertex| vertex.place));
        let (centre, half) = ((min + max) * 0.5, (max - min) * 0.5);
        if half.min_element() <= 0.0 {
            return None;
        }
        for vertex in &mut vertices {
            vertex.place = (vertex.place - centre) / half;
            vertex.beside = vertex.beside.map(|step| step / half);
        }
        Some(Self { vertices, sides: DVec2::new(shape, shape.recip()).sqrt() })
    }

    /// The worst side of a texel, in pixels, of a map whose area is one texel; infinite where c is not positive.
    fn worst(&self, Candidate([tilt_x, tilt_y, turn, lean_x, lean_y]): Candidate) -> f64 {
        let tilt = DVec2::new(tilt_x, tilt_y);
        let axes = DMat2::from_cols(DVec2::new(1.0, lean_y), DVec2::new(lean_x, 1.0)) * DMat2::from_angle(turn);
        let seen = |place: DVec2| {
            let c = 1.0 + tilt.dot(place);
            (axes * place / c, c)
        };
        if axes.determinant().abs() < 1e-3 || self.vertices.iter().any(|vertex| seen(vertex.place).1 <= 1e-9) {
            return f64::INFINITY;
        }
        let (min, max) = bounds(self.vertices.iter().map(|vertex| seen(vertex.place).0));
        let size = max - min;
        let texel = |Vertex { place, beside }: &Vertex| {
            // What a pixel covers of the map, by the derivative of the place in it.
            let (at, c) = seen(*place);
            let covered = beside.map(|step| (axes * step - at * tilt.dot(step)) / (c * size) * self.sides);
            let [x, y] = covered;
            // The pixel is a circle in the plane across the ray, the texel a square: one over the smaller singular value.
            let (sum, product) = (x.length_squared() + y.length_squared(), x.perp_dot(y).abs());
            let larger = (0.5 * sum + (0.25 * sum * sum - product * product).max(0.0).sqrt()).sqrt();
            larger / product
        };
        self.vertices.iter().map(texel).fold(0.0, f64::max)
    }

    /// The least worst side that is found, in pixels, of a map whose area is one texel.
    pub(super) fn least_worst(&self, starts: usize, seed: u64) -> f64 {
        let mut random = StdRng::seed_from_u64(seed);
        let mut best = f64::INFINITY;
        for _ in 0..starts {
            // A strong warp has c near zero at a corner: strengths are spread evenly in what is left there.
            let direction = DVec2::from_angle(random.random_range(0.0..std::f64::consts::TAU));
            let nearest = self.vertices.iter().map(|vertex| direction.dot(vertex.place)).fold(0.0, f64::min);
            let strength = (1.0 - 10.0_f64.powf(random.random_range(-3.5..0.0))) / -nearest.min(-1e-9);
            let tilt = direction * strength;
            let mut lean = || random.random_range(-0.7..0.7);
            // Half a turn is none, and in a square map a quarter of one is none.
            let (turn, lean_x, lean_y) = (lean(), lean(), lean());
            let is_square = self.sides.x == self.sides.y;
            let turn = if is_square || random.random_range(0.0..1.0) < 0.5 { turn } else { turn + FRAC_PI_2 };
            let start = Candidate([tilt.x, tilt.y, turn, lean_x, lean_y]);
            best = best.min(self.simplex(start, &mut random));
        }
        best
    }

    /// Nelder & Mead's simplex, begun again around its best corner, smaller each time.
    fn simplex(&self, start: Candidate, random: &mut StdRng) -> f64 {
        let mut best = (start.0, self.worst(start));
        for size in [0.3, 0.1, 0.1, 0.03, 0.01, 0.003] {
            let mut corners = vec![best];
            for axis in 0..5 {
                let mut corner = best.0;
                // Steps of the tilt as large as c is at its least.
                let tilt = DVec2::new(best.0[0], best.0[1]);
                let least = self.vertices.iter().map(|vertex| 1.0 + tilt.dot(vertex.place)).fold(1.0, f64::min);
                let step = if axis < 2 { size * least.max(1e-6) } else { size };
                corner[axis] += if random.random_range(0.0..1.0) < 0.5 { step } else { -step };
                corners.push((corner, self.worst(Candidate(corner))));
            }
            for _ in 0..160 {
                corners.sort_by(|a, b| a.1.total_cmp(&b.1));
                let (worst, rest) = (corners[5], &corners[..5]);
                let middle: [f64; 5] =
                    std::array::from_fn(|i| rest.iter().map(|corner| corner.0[i]).sum::<f64>() / 5.0);
                let at = |part: f64| {
                    let place = std::array::from_fn(|i| middle[i] + part * (worst.0[i] - middle[i]));
                    (place, self.worst(Candidate(place)))
                };
                let reflected = at(-1.0);
                corners[5] = if reflected.1 < corners[0].1 {
                    let further = at(-2.0);
                    if further.1 < reflected.1 { further } else { reflected }
                } else if reflected.1 < corners[4].1 {
                    reflected
                } else {
                    let nearer = at(if reflected.1 < worst.1 { -0.5 } else { 0.5 });
                    if nearer.1 < worst.1.min(reflected.1) {
                        nearer
                    } else {
                        let first = corners[0].0;
                        for corner in &mut corners[1..] {
                            let place = std::array::from_fn(|i| 0.5 * (first[i] + corner.0[i]));
                            *corner = (place, self.worst(Candidate(place)));
                        }
                        continue;
                    }
                };
            }
            best = corners.into_iter().min_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or(best);
        }
        best.1
    }
}

fn bounds(places: impl Iterator<Item = DVec2>) -> (DVec2, DVec2) {
    places.fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(min, max), place| (min.min(place), max.max(place)))
}
