//! The vertices of R on the chart of rays, and the window that a homography makes of them.

use super::lanes::{greater, lesser, raised};
use super::moments::Moments;
use crate::focus::Focus;
use crate::math::bounds::most;
use crate::warp::rays::Functional;
use glam::{DVec2, Mat2, Vec2, Vec3, Vec4};

/// Vectors of four places.
const VECTORS: usize = Focus::MAX_SURFACES / 4;

/// A homography of the chart of rays: x, y and w.
pub(super) type Rows = [Functional; 3];

/// R on the chart, scaled so that it extends from −1 to 1.
pub(super) struct Chart {
    /// Where the middle of R is on the chart of rays, and half of its extent there.
    pub(super) middle: DVec2,
    pub(super) half: DVec2,
    places: [[Vec4; 2]; VECTORS],
    len: usize,
}

/// A map of R: a homography of the chart whose window, from −1 to 1, holds R.
#[derive(Clone, Copy, Debug)]
pub(super) struct Drawn {
    /// The rows x, y and w as functions (slope, constant) on the scaled chart.
    pub(super) rows: [Vec3; 3],
    pub(super) determinant: f32,
}

/// A change of a map, before its window is fitted again. A place s in the window moves to
///
/// ```text
///     axes · s / (1 + tilt · s)
/// ```
///
/// Such changes connect all single-pass maps of a light: two numbers for c and, of the four of the axes, two that turn and shear the
/// window. The other two scale it, which its fit undoes, as it does translation.
#[derive(Clone, Copy, Debug)]
pub(super) struct Change {
    pub(super) axes: Mat2,
    pub(super) tilt: Vec2,
}

/// The least w on R, relative to its value in the middle.
const LEAST_W: f32 = 1.0 / 1_048_576.0;

/// The least ratio of the sides of a window, for R without extent.
const THINNEST: f64 = 1.0 / 1_073_741_824.0;

impl Chart {
    /// The chart of R, which has its vertices at these places on the chart of rays, and this middle.
    pub(super) fn new(places: impl Iterator<Item = DVec2> + Clone, middle: DVec2) -> Self {
        let mut half = DVec2::ZERO;
        for place in places.clone() {
            half = half.max((place - middle).abs());
        }
        // A chart of any scale serves R without extent.
        let largest = if half.max_element() > 0.0 { half.max_element() } else { 1.0 };
        let half = half.max(DVec2::splat(THINNEST * largest));
        let mut chart = Self { middle, half, places: [[Vec4::ZERO; 2]; VECTORS], len: 0 };
        places.for_each(|place| chart.push(place));
        chart
    }

    /// The same chart without any places.
    pub(super) fn emptied(&self) -> Self {
        Self { len: 0, ..*self }
    }

    /// Adds a place that the window holds, if there is room.
    pub(super) fn push(&mut self, place: DVec2) {
        let scaled = ((place - self.middle) / self.half).as_vec2();
        let Some([u, v]) = self.places.get_mut(self.len / 4) else { return };
        // Lanes past the last place repeat it.
        for lane in self.len % 4..4 {
            (u[lane], v[lane]) = (scaled.x, scaled.y);
        }
        self.len += 1;
    }

    fn places(&self) -> &[[Vec4; 2]] {
        &self.places[..self.len.div_ceil(4)]
    }

    /// The map with the rows x, y and w on the chart of rays, its window fitted to R; `None` unless w > 0 on R.
    pub(super) fn fitted(&self, rows: &Rows) -> Option<Drawn> {
        let [x, y, w] = rows.map(|row| Functional { slope: row.slope * self.half, constant: row.at(self.middle) });
        if w.constant.is_nan() || w.constant <= 0.0 {
            return None;
        }
        let scale = w.constant.recip();
        let row = |row: Functional, size: f64| (row.slope.extend(row.constant) * size).as_vec3();
        // Whatever the size of x and y, f32 holds them.
        let unit = |row: &Functional| most(row.slope.abs().max_element(), f64::MIN_POSITIVE).recip();
        self.windowed([row(x, unit(&x)), row(y, unit(&y)), row(w, scale)])
    }

    /// A map after a change.
    pub(super) fn changed(&self, map: &Drawn, change: &Change) -> Option<Drawn> {
        let [x, y, w] = map.rows;
        let mixed = |along: Vec2| x * along.x + y * along.y;
        let w = w + mixed(change.tilt);
        let axes = change.axes;
        self.windowed([mixed(axes.row(0)), mixed(axes.row(1)), w * w.z.recip()])
    }

    /// The map with these rows up to its window.
    fn windowed(&self, [x, y, w]: [Vec3; 3]) -> Option<Drawn> {
        let mut least_w = Vec4::splat(f32::INFINITY);
        let (mut low, mut high) = ([Vec4::splat(f32::INFINITY); 2], [Vec4::splat(f32::NEG_INFINITY); 2]);
        for [u, v] in self.places() {
            let at = |row: &Vec3| *u * row.x + *v * row.y + row.z;
            let of_w = at(&w);
            least_w = lesser(least_w, of_w);
            let inverse = of_w.recip();
            for (axis, row) in [x, y].iter().enumerate() {
                let place = at(row) * inverse;
                (low[axis], high[axis]) = (lesser(low[axis], place), greater(high[axis], place));
            }
        }
        let ends = |axis: usize| (low[axis].min_element(), high[axis].max_element());
        let row =
            |row: Vec3, (low, high): (f32, f32)| (row - w * (0.5 * (low + high))) * (0.5 * (high - low)).recip();
        let rows = [row(x, ends(0)), row(y, ends(1)), w];
        let determinant = rows[0].dot(rows[1].cross(rows[2]));
        // NaN fails as well.
        let is_map = least_w.min_element() > LEAST_W && determinant.abs() > 0.0 && determinant.is_finite();
        (is_map && rows.iter().all(|row| row.is_finite())).then_some(Drawn { rows, determinant })
    }

    /// The rows x, y and w of a map on the chart of rays, w 1 in the middle.
    pub(super) fn rows(&self, map: &Drawn) -> Rows {
        map.rows.map(|row| {
            let slope = row.truncate().as_dvec2() / self.half;
            Functional { slope, constant: f64::from(row.z) - slope.dot(self.middle) }
        })
    }

    /// The largest move of a vertex of R from one map to another, where the window is 2 wide.
    pub(super) fn largest_move(&self, from: &Drawn, to: &Drawn) -> f32 {
        let mut largest = Vec4::ZERO;
        for [u, v] in self.places() {
            let at = |row: &Vec3| *u * row.x + *v * row.y + row.z;
            let place = |map: &Drawn, axis: usize| at(&map.rows[axis]) / at(&map.rows[2]);
            for axis in 0..2 {
                largest = greater(largest, (place(to, axis) - place(from, axis)).abs());
            }
        }
        largest.max_element()
    }

    /// How the width and the height of the window grow with a change, with sides that are maxima softened by the power 2ᵏ.
    ///
    /// Half of the outward moves of two sides, where a point at a side moves by `H s − (t · s) s`.
    pub(super) fn extents(&self, map: &Drawn, k: u32) -> [Extent; 2] {
        let mut sides = [Moments::NONE; 4];
        let [x, y, w] = &map.rows;
        for [u, v] in self.places() {
            let at = |row: &Vec3| *u * row.x + *v * row.y + row.z;
            let inverse = at(w).recip();
            let (x, y) = (at(x) * inverse, at(y) * inverse);
            let weight = |place: Vec4| raised((place + 1.0) * 0.5, k + 1);
            let across = [-x * x, -x * y, y, Vec4::ZERO];
            let upwards = [-x * y, -y * y, Vec4::ZERO, x];
            sides[0].include(weight(x), across);
            sides[1].include(weight(-x), across.map(|one| -one));
            sides[2].include(weight(y), upwards);
            sides[3].include(weight(-y), upwards.map(|one| -one));
        }
        let [right, left, top, bottom] = &sides;
        [Extent::between([right, left], k), Extent::between([top, bottom], k)]
    }
}

/// The growth of a half extent of the window with a change.
pub(super) struct Extent {
    pub(super) growth: [f32; 4],
    /// For each pair of coordinates.
    pub(super) curvature: [f32; 10],
}

impl Extent {
    fn between([one, other]: [&Moments; 2], k: u32) -> Self {
        let (one, other) = (one.spread(), other.spread());
        let power = 0.5 * (1_u32 << k) as f32;
        Self {
            growth: core::array::from_fn(|i| (one.mean[i] + other.mean[i]) * 0.5),
            curvature: core::array::from_fn(|i| (one.covariance[i] + other.covariance[i]) * power),
        }
    }
}
