//! A map in the making: where visible points fall in its window, and how far a step goes there.

use crate::convex::Polyhedron;
use crate::input::view::View;
use crate::math::bounds::{Interval, Rectangle, least, most};
use crate::warp::rays::{Functional, Rays};
use glam::{DMat2, DVec2, DVec3};

/// The squared length, in half heights of the image, of steps across the window: a quadratic form. Of steps of a texel it is
/// the square of the footprint that [`ShadowMap::footprint`](crate::ShadowMap::footprint) tells.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch {
    pub(super) xx: f64,
    pub(super) xy: f64,
    pub(super) yy: f64,
}

impl Stretch {
    /// The same for steps that go `right` and `up` where they went (1, 0) and (0, 1).
    fn of_steps(&self, right: DVec2, up: DVec2) -> Self {
        let times =
            |step: DVec2| DVec2::new(self.xx * step.x + self.xy * step.y, self.xy * step.x + self.yy * step.y);
        let along_right = times(right);
        Self { xx: along_right.dot(right), xy: along_right.dot(up), yy: times(up).dot(up) }
    }

    /// The same of steps of texels in a map so many times as wide as high, but for a factor: to the next texels the steps are
    /// (2/width, 0) and (0, 2/height) in the window, and times √(width · height)/2 they are (shape^-½, 0) and (0, shape^½).
    pub(super) fn of_texels(&self, shape: f64) -> Self {
        Self { xx: self.xx / shape, yy: self.yy * shape, ..*self }
    }

    /// Half of the difference between the eigenvalues.
    pub(super) fn difference(&self) -> f64 {
        let half = 0.5 * (self.xx - self.yy);
        DVec2::new(half, self.xy).length()
    }
}

/// A visible point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Point {
    /// Where it is in the window, whose sides are at −1 and 1.
    pub(super) place: DVec2,
    /// How far steps across the window go there.
    pub(super) stretch: Stretch,
    /// The larger eigenvalue of [`Stretch::of_texels`]: the longest side of a texel, squared, but for a factor.
    pub(super) longest: f64,
    /// [`Stretch::difference`] of that.
    pub(super) difference: f64,
}

/// What a map is changed by, before its window is made to fit again: a place s in the window moves to
///
/// ```text
///     axes · s / (1 + tilt · s)
/// ```
///
/// Every single-pass map of a light comes of every other by such changes: two numbers for c, and of the four of the axes
/// two that turn and shear the window. The others scale it, and moving and scaling are left to its fit.
#[derive(Clone, Copy, Debug)]
pub(super) struct Change {
    pub(super) axes: DMat2,
    pub(super) tilt: DVec2,
}

/// A map in the making.
#[derive(Clone, Debug)]
pub(super) struct Draft {
    points: [Point; Polyhedron::MAX_VERTICES],
    len: usize,
    /// How many times as wide as high the map is, in texels.
    pub(super) shape: f64,
    /// x, y and w of the place (x/w, y/w) in the window, as functions on the chart of rays.
    pub(super) rows: Rows,
    /// The longest side of all texels, squared likewise: what the search is for the least of.
    pub(super) worst: f64,
}

/// A homography of the chart: x, y and w.
pub(crate) type Rows = [Functional; 3];

/// A window is at least this part as wide as it is high, and the other way round: what is visible may have no extent of
/// its own.
const THINNEST: f64 = 1.0 / 1_073_741_824.0;

/// The least of w, over what it is in the middle of the window, that a change may leave.
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

    /// The chart itself, moved so that `middle` is in the middle, for maps so many times as wide as high: no map yet, as its
    /// window is not made to fit.
    pub(super) fn chart(middle: DVec2, shape: f64) -> Self {
        let moved = |row: Functional, by: f64| Functional { constant: -by, ..row };
        Self {
            rows: [moved(Functional::U, middle.x), moved(Functional::V, middle.y), Functional::ONE],
            shape,
            ..Self::EMPTY
        }
    }

    /// Puts a visible point on the chart, seen as if from no nearer than `nearest`; where there is no room left for it, it counts
    /// for nothing.
    pub(super) fn include(&mut self, rays: &Rays, view: &View, nearest: f64, position: DVec3) {
        let (ray, w) = rays.through(position);
        // Across the ray of a light at a position, a step on the chart goes w far to the side, but only w/|(U, V, 1)|
        // towards the chart's origin or away from it.
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

    /// Puts a point of another draft here, likewise.
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

    /// Becomes the map with the rows x, y and w made of the chart; false unless w is positive on all that is visible.
    pub(super) fn set_rows(&mut self, chart: &Self, [x, y, w]: &Rows) -> bool {
        let middle = DVec2::new(-chart.rows[0].constant, -chart.rows[1].constant);
        let in_middle = w.at(middle);
        let tilt = w.slope / in_middle;
        // What is left of a row where w times its value in the middle is taken off.
        let axis = |row: &Functional| row.slope / in_middle - tilt * (row.at(middle) / in_middle);
        let axes = DMat2::from_cols(axis(x), axis(y)).transpose();
        in_middle > 0.0 && self.set_changed(chart, &Change { axes, tilt })
    }

    /// Becomes `old` after a change, fitted to what is visible; false where w would not be positive on all of that, or the
    /// window have no extent, and what it becomes is of no use.
    ///
    /// A step in the new window is one of
    ///
    /// ```text
    ///     (1 + tilt · s) (1 + s tiltᵀ) axes⁻¹
    /// ```
    ///
    /// in the old one, the inverse of the change's derivative at s, times the new window's half extents.
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
        // Not so of what is not a number, either.
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
