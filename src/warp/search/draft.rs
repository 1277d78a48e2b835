//! A draft of a map: the places of receiver points in its window, and the footprint of steps there.

use crate::convex::Polyhedron;
use crate::input::view::View;
use crate::math::bounds::{Interval, Rectangle, least, most};
use crate::warp::rays::{Functional, Rays};
use glam::{DMat2, DVec2, DVec3};

/// The squared length of steps across the window, in half heights of the image: a quadratic form. For steps of a texel it is the
/// square of [`ShadowMap::footprint`](crate::ShadowMap::footprint).
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch {
    pub(super) xx: f64,
    pub(super) xy: f64,
    pub(super) yy: f64,
}

impl Stretch {
    /// The form in coordinates whose unit steps are `right` and `up` in the old ones.
    fn of_steps(&self, right: DVec2, up: DVec2) -> Self {
        let times =
            |step: DVec2| DVec2::new(self.xx * step.x + self.xy * step.y, self.xy * step.x + self.yy * step.y);
        let along_right = times(right);
        Self { xx: along_right.dot(right), xy: along_right.dot(up), yy: times(up).dot(up) }
    }

    /// The form for steps of texels, up to a factor, in a map with width/height = `shape`: steps to the next texels are (2/width, 0)
    /// and (0, 2/height) in the window; times √(width · height)/2 they are (shape^-½, 0) and (0, shape^½).
    pub(super) fn of_texels(&self, shape: f64) -> Self {
        Self { xx: self.xx / shape, yy: self.yy * shape, ..*self }
    }

    /// Half of the difference between the eigenvalues.
    pub(super) fn difference(&self) -> f64 {
        let half = 0.5 * (self.xx - self.yy);
        DVec2::new(half, self.xy).length()
    }
}

/// A point of R.
#[derive(Clone, Copy, Debug)]
pub(super) struct Point {
    /// The place in the window, from −1 to 1.
    pub(super) place: DVec2,
    /// The squared length of steps across the window there.
    pub(super) stretch: Stretch,
    /// The larger eigenvalue of [`Stretch::of_texels`]: the longest side of a texel, squared, up to a factor.
    pub(super) longest: f64,
    /// [`Stretch::difference`] of that.
    pub(super) difference: f64,
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
    pub(super) axes: DMat2,
    pub(super) tilt: DVec2,
}

/// A draft of a map.
#[derive(Clone, Debug)]
pub(super) struct Draft {
    points: [Point; Polyhedron::MAX_VERTICES],
    len: usize,
    /// Width over height of the map, in texels.
    pub(super) shape: f64,
    /// The rows x, y and w of the place (x/w, y/w) in the window, as functions on the chart of rays.
    pub(super) rows: Rows,
    /// The longest side of all texels, squared likewise, which the search minimises.
    pub(super) worst: f64,
}

/// A homography of the chart: x, y and w.
pub(crate) type Rows = [Functional; 3];

/// The least ratio of the sides of a window, for R without extent.
const THINNEST: f64 = 1.0 / 1_073_741_824.0;

/// The least w after a change, relative to its value in the middle of the window.
const LEAST_W: f64 = 1.0 / 1_048_576.0;

impl Draft {
    pub(super) const EMPTY: Self = Self {
        points: [Point {
            place: DVec2::ZERO,
            stretch: Stretch { xx: 0.0, xy: 0.0, yy: 0.0 },
            longest: 0.0,
            difference: 0.0,
        }; Polyhedron::MAX_VERTICES],
        len: 0,
        shape: 1.0,
        rows: [Functional::U, Functional::V, Functional::ONE],
        worst: 0.0,
    };

    /// The chart itself with `middle` at its origin, for maps of this width over height: not a map, as its window is not fitted.
    pub(super) fn chart(middle: DVec2, shape: f64) -> Self {
        let moved = |row: Functional, by: f64| Functional { constant: -by, ..row };
        Self {
            rows: [moved(Functional::U, middle.x), moved(Functional::V, middle.y), Functional::ONE],
            shape,
            ..Self::EMPTY
        }
    }

    /// Adds a point of R, seen from no nearer than `nearest`; it is ignored where there is no room left.
    pub(super) fn include(&mut self, rays: &Rays, view: &View, nearest: f64, position: DVec3) {
        let (ray, w) = rays.through(position);
        // Across the ray of a local light, a step on the chart has the length w to the side, but only w/|(U, V, 1)| towards the
        // chart's origin or away from it.
        let (size, shorter) = if rays.local { (w, 1.0 / (1.0 + ray.length_squared())) } else { (1.0, 0.0) };
        let in_image = size / view.half_height(most(view.depth(position), nearest));
        let scale = in_image * in_image;
        let stretch = Stretch {
            xx: scale * (1.0 - ray.x * ray.x * shorter),
            xy: -scale * (ray.x * ray.y * shorter),
            yy: scale * (1.0 - ray.y * ray.y * shorter),
        };
        let place = DVec2::new(self.rows[0].at(ray), self.rows[1].at(ray));
        self.push(Point { place, stretch, longest: 0.0, difference: 0.0 });
    }

    /// Adds a point of another draft, likewise.
    pub(super) fn push(&mut self, new: Point) {
        if let Some(point) = self.points.get_mut(self.len) {
            *point = new;
            self.len += 1;
        }
    }

    pub(super) fn truncate(&mut self, len: usize) {
        self.len = self.len.min(len);
    }

    pub(super) fn points(&self) -> &[Point] {
        &self.points[..self.len]
    }

    /// Sets the draft to the map with the rows x, y and w on the chart; false unless w > 0 on R.
    pub(super) fn set_rows(&mut self, chart: &Self, [x, y, w]: &Rows) -> bool {
        let middle = DVec2::new(-chart.rows[0].constant, -chart.rows[1].constant);
        let in_middle = w.at(middle);
        let tilt = w.slope / in_middle;
        // A row without its part along w, which moves the middle.
        let axis = |row: &Functional| row.slope / in_middle - tilt * (row.at(middle) / in_middle);
        let axes = DMat2::from_cols(axis(x), axis(y)).transpose();
        in_middle > 0.0 && self.set_changed(chart, &Change { axes, tilt })
    }

    /// Sets the draft to `old` after a change, fitted to R; false, with an invalid draft, where w would not be positive on R or the
    /// window would have no extent.
    ///
    /// A step in the new window is
    ///
    /// ```text
    ///     (1 + tilt · s) (1 + s tiltᵀ) axes⁻¹
    /// ```
    ///
    /// in the old one: the inverse of the change's derivative at s, times the half extents of the new window.
    pub(super) fn set_changed(&mut self, old: &Self, change: &Change) -> bool {
        let Change { axes, tilt } = *change;
        (self.len, self.shape) = (old.len, old.shape);
        let (mut x, mut y) = (Interval::EMPTY, Interval::EMPTY);
        let mut least_w = f64::INFINITY;
        for (point, old) in self.points.iter_mut().zip(old.points()) {
            let w = 1.0 + tilt.dot(old.place);
            least_w = least(least_w, w);
            point.place = axes * old.place / w;
            x.include(point.place.x);
            y.include(point.place.y);
        }
        let window = Rectangle::over(&x, &y);
        let half = window.half.max(DVec2::splat(THINNEST * window.half.max_element()));
        let steps = axes.inverse() * DMat2::from_diagonal(half);
        // NaN fails as well.
        if !(least_w > LEAST_W && half.min_element() > 0.0 && steps.is_finite() && tilt.is_finite()) {
            return false;
        }
        let (right, up) = (steps.x_axis, steps.y_axis);
        let (tilt_right, tilt_up) = (tilt.dot(right), tilt.dot(up));
        let scale = half.recip();
        self.worst = 0.0;
        for (point, old) in self.points.iter_mut().zip(old.points()) {
            let s = old.place;
            let w = 1.0 + tilt.dot(s);
            point.place = (point.place - window.centre) * scale;
            point.stretch = old.stretch.of_steps((right + s * tilt_right) * w, (up + s * tilt_up) * w);
            let of_texels = point.stretch.of_texels(self.shape);
            point.difference = of_texels.difference();
            point.longest = 0.5 * (of_texels.xx + of_texels.yy) + point.difference;
            self.worst = most(self.worst, point.longest);
        }
        let [x, y, w] = &old.rows;
        let mixed = |along: DVec2| x.scaled(along.x).plus(&y.scaled(along.y));
        let w = w.plus(&mixed(tilt));
        let row = |row: Functional, centre: f64, scale: f64| row.plus(&w.scaled(-centre)).scaled(scale);
        self.rows = [
            row(mixed(axes.row(0)), window.centre.x, scale.x),
            row(mixed(axes.row(1)), window.centre.y, scale.y),
            w,
        ];
        self.worst > 0.0 && self.worst.is_finite()
    }
}
