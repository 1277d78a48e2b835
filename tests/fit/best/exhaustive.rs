//! The best single matrix by brute force: what the crate's search is held against.
//!
//! Nothing here is the crate's but the vertices of R and the uniform map, which serves as the chart of the light's rays. A map is a
//! covector c and two sides of a window. What it makes of a surface is measured by small steps along it, pushed through the map and
//! through the camera. The search is Nelder & Mead's simplex from many places, begun again around what it finds.

use glam::{DMat2, DVec2, DVec3};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use shadowfit::warp::Objective;
use shadowfit::{Focus, ShadowMap, Warp, seen::SeenPoint};
use std::f64::consts::FRAC_PI_2;

/// The weight of a bias against the side of a texel, and the bias for each texel of a step: as the crate documents them.
const BIAS: f64 = 0.5;
const SLOPE: f64 = 1.125;

/// The part of a pixel that is stepped on a surface.
const BESIDE: f64 = 1e-5;

/// A point of a surface, and what two small steps along it change, in units of a step.
struct Surface {
    /// The place in the uniform map.
    place: DVec2,
    moved: [DVec2; 2],
    /// Depth along the axis over w of the uniform map.
    depth: f64,
    deeper: [f64; 2],
    /// The change of depth with a step along the ray, as long as the other two.
    along: f64,
    /// The moves in the image, in pixels.
    seen: [DVec2; 2],
    /// A step along the ray, in pixels.
    step: f64,
    /// Besides what w makes of depth, a slope of 45°.
    is_slope: bool,
    pixels: f64,
}

/// R and the surfaces in it, in the uniform map.
pub(super) struct Chart {
    vertices: Vec<DVec2>,
    surfaces: Vec<Surface>,
    sides: DVec2,
    objective: Objective,
}

/// Where the sides of a window are, and c: the numbers that are searched over. c is 1 + tilt · place, x runs along (1, lean)
/// and y along (lean, 1), turned by an angle, on a plane where the uniform window is [−1, 1]².
#[derive(Clone, Copy, Debug)]
struct Candidate([f64; 5]);

impl Chart {
    /// `None` where there is no uniform map or no lit surface.
    pub(super) fn new(focus: &Focus<'_>, map: &ShadowMap, points: &[SeenPoint]) -> Option<Self> {
        let uniform = focus.fit(&map.settings().with_warp(Warp::Uniform)).into_map()?;
        let (view, light) = (focus.view(), focus.light());
        let matrix = uniform.clip_from_world();
        let [x, y, w] = [0, 1, 3].map(|row| matrix.row(row));
        let of_w = |point: DVec3| w.dot(point.extend(1.0));
        let place = |point: DVec3| DVec2::new(x.dot(point.extend(1.0)), y.dot(point.extend(1.0))) / of_w(point);
        let vertices: Vec<DVec3> = focus.receiver_volume().vertices().to_vec();
        let axis = match light.position() {
            None => -light.direction_from(DVec3::ZERO),
            Some(_) => w.truncate().normalize(),
        };
        let from = light.position().unwrap_or(view.eye());
        let along = |point: DVec3| axis.dot(point - from);
        let (low, high) = vertices
            .iter()
            .map(|&point| along(point))
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), one| (low.min(one), high.max(one)));
        let depth = |point: DVec3| (along(point) - 0.5 * (low + high)) / of_w(point);
        let camera = view.clip_from_world();
        let frame = view.corners()?;
        let aspect = frame[0].distance(frame[1]) / frame[0].distance(frame[2]);
        let height = 0.5 * f64::from(map.settings().image_height());
        let image = |point: DVec3| camera.project_point3(point).truncate() * DVec2::new(height * aspect, height);
        let surface = |point: &SeenPoint| {
            let ray = -light.direction_from(point.position);
            if point.normal.is_some_and(|normal| -normal.normalize().dot(ray) < 0.05) {
                return None;
            }
            let (a, b) = point.normal.map_or(ray, DVec3::normalize).any_orthonormal_pair();
            let pixel = 2.0 * view.half_height(view.depth(point.position)) / (2.0 * height);
            let size = pixel * BESIDE;
            let change = |step: DVec3| {
                let (before, after) = (point.position - step * size, point.position + step * size);
                let moved = (place(after) - place(before)) / (2.0 * BESIDE);
                let deeper = (depth(after) - depth(before)) / (2.0 * BESIDE);
                (moved, deeper, (image(after) - image(before)) / (2.0 * BESIDE))
            };
            let [(moved_a, deeper_a, seen_a), (moved_b, deeper_b, seen_b)] = [a, b].map(change);
            let seen = if point.normal.is_some() { [seen_a, seen_b] } else { [DVec2::X, DVec2::Y] };
            Some(Surface {
                place: place(point.position),
                moved: [moved_a, moved_b],
                depth: depth(point.position),
                deeper: [deeper_a, deeper_b],
                along: change(ray).1,
                seen,
                step: 1.0,
                is_slope: point.normal.is_none(),
                pixels: point.pixels,
            })
        };
        let surfaces: Vec<Surface> = points.iter().filter_map(surface).collect();
        let (width, height) = map.settings().map_sides();
        let chart = Self {
            vertices: vertices.into_iter().map(place).collect(),
            surfaces,
            sides: DVec2::new(width.into(), height.into()),
            objective: map.settings().objective(),
        };
        (!chart.surfaces.is_empty()).then_some(chart)
    }

    /// The error of a map; infinite where c is not positive.
    fn error(&self, Candidate([tilt_x, tilt_y, turn, lean_x, lean_y]): Candidate) -> f64 {
        let tilt = DVec2::new(tilt_x, tilt_y);
        let axes = DMat2::from_cols(DVec2::new(1.0, lean_y), DVec2::new(lean_x, 1.0)) * DMat2::from_angle(turn);
        let c = |place: DVec2| 1.0 + tilt.dot(place);
        if axes.determinant().abs() < 1e-3 || self.vertices.iter().any(|&vertex| c(vertex) <= 1e-6) {
            return f64::INFINITY;
        }
        let (low, high) = self
            .vertices
            .iter()
            .map(|&vertex| axes * vertex / c(vertex))
            .fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(low, high), place| (low.min(place), high.max(place)));
        let texel = (high - low) / self.sides;
        let (mut sum, mut pixels, mut worst) = (0.0, 0.0, 0.0_f64);
        for surface in &self.surfaces {
            let of_c = c(surface.place);
            let at = axes * surface.place / of_c;
            // What a step along the surface changes in the map.
            let moved = surface.moved.map(|moved| (axes * moved - at * tilt.dot(moved)) / of_c);
            let deeper = [0, 1]
                .map(|i| surface.deeper[i] / of_c - surface.depth * tilt.dot(surface.moved[i]) / (of_c * of_c));
            let steps = DMat2::from_cols(moved[0], moved[1]).inverse() * DMat2::from_diagonal(texel);
            let mut error = 0.0;
            for step in [steps.x_axis, steps.y_axis] {
                let side = (surface.seen[0] * step.x + surface.seen[1] * step.y).length();
                let change =
                    (deeper[0] * step.x + deeper[1] * step.y).abs() / (surface.along / of_c) * surface.step;
                let bias = SLOPE * (change + if surface.is_slope { side } else { 0.0 });
                error += 0.5 * side + BIAS * bias;
            }
            sum += error * surface.pixels;
            pixels += surface.pixels;
            worst = worst.max(error);
        }
        match self.objective {
            Objective::Worst => worst,
            _ => sum / pixels,
        }
    }

    /// The least error that is found.
    pub(super) fn least_error(&self, starts: usize, seed: u64) -> f64 {
        let mut random = StdRng::seed_from_u64(seed);
        let mut best = f64::INFINITY;
        for _ in 0..starts {
            // A strong warp has c near zero at a corner: strengths are spread evenly in what is left there.
            let direction = DVec2::from_angle(random.random_range(0.0..std::f64::consts::TAU));
            let nearest = self.vertices.iter().map(|vertex| direction.dot(*vertex)).fold(0.0, f64::min);
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
        let mut best = (start.0, self.error(start));
        for size in [0.3, 0.1, 0.1, 0.03, 0.01, 0.003] {
            let mut corners = vec![best];
            for axis in 0..5 {
                let mut corner = best.0;
                // Steps of the tilt as large as c is at its least.
                let tilt = DVec2::new(best.0[0], best.0[1]);
                let least = self.vertices.iter().map(|vertex| 1.0 + tilt.dot(*vertex)).fold(1.0, f64::min);
                let step = if axis < 2 { size * least.max(1e-6) } else { size };
                corner[axis] += if random.random_range(0.0..1.0) < 0.5 { step } else { -step };
                corners.push((corner, self.error(Candidate(corner))));
            }
            for _ in 0..160 {
                corners.sort_by(|a, b| a.1.total_cmp(&b.1));
                let (worst, rest) = (corners[5], &corners[..5]);
                let middle: [f64; 5] =
                    std::array::from_fn(|i| rest.iter().map(|corner| corner.0[i]).sum::<f64>() / 5.0);
                let at = |part: f64| {
                    let place = std::array::from_fn(|i| middle[i] + part * (worst.0[i] - middle[i]));
                    (place, self.error(Candidate(place)))
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
                            *corner = (place, self.error(Candidate(place)));
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
