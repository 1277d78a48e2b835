//! What a matrix's window covers, measured as the light sees it.

use shadowfit::glam::{DMat4, DVec2, DVec3, DVec4};

/// Cells a side of the grid that areas of overlapping polygons are counted on.
const CELLS: usize = 128;

/// A window of a uniform map: world units across a light that is infinitely far away, tangents about the map's own axis
/// for any other.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Window {
    x: DVec4,
    y: DVec4,
    w: DVec4,
    /// Half of its width and height.
    half: DVec2,
}

/// Areas within a window, over the window's own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Shares {
    /// The least rectangle around all of R, whichever way it is turned, whether in the window or not.
    pub(crate) least: f64,
    /// What R covers.
    pub(crate) visible: f64,
    /// What receivers cover that are in R.
    pub(crate) receivers: f64,
}

impl Window {
    /// Of a matrix from the world to clip space, x and y from −1 to 1; `None` where it is not finite or has no width.
    pub(crate) fn new(shadow_from_world: &DMat4) -> Option<Self> {
        let [x, y, w] = [0, 1, 3].map(|row| shadow_from_world.row(row));
        let axis = w.truncate();
        // What is across the axis; the rest of a row moves the window about and does not widen it.
        let [across_x, across_y] = [x, y].map(|row| across(row.truncate(), axis));
        let unit = if axis == DVec3::ZERO { w.w } else { axis.length() };
        let half = DVec2::new(unit / across_x.length(), unit / across_y.length());
        let sound = half.is_finite() && half.cmpgt(DVec2::ZERO).all() && shadow_from_world.is_finite();
        sound.then_some(Self { x, y, w, half })
    }

    /// Where a point lies, from the window's middle; `None` where it is beside or behind the light.
    fn at(&self, point: DVec3) -> Option<DVec2> {
        let point = point.extend(1.0);
        let w = self.w.dot(point);
        let place = DVec2::new(self.x.dot(point), self.y.dot(point)) / w * self.half;
        (w > 0.0 && place.is_finite()).then_some(place)
    }

    /// How much of it is used, by R's vertices and the corners of visible parts of receivers; `None` where R has no area,
    /// or part of it is beside or behind the light.
    pub(crate) fn shares(&self, visible: &[DVec3], receivers: &[Vec<DVec3>]) -> Option<Shares> {
        let project = |points: &[DVec3]| -> Option<Vec<DVec2>> {
            points.iter().map(|&point| self.at(point)).collect::<Option<Vec<_>>>().map(hull)
        };
        let area = 4.0 * self.half.x * self.half.y;
        let visible = project(visible)?;
        let within = clipped(&visible, self.half);
        let receivers: Vec<Vec<DVec2>> = receivers
            .iter()
            .filter_map(|points| project(points))
            .map(|polygon| clipped(&polygon, self.half))
            .collect();
        let shares = Shares {
            least: least_rectangle(&visible) / area,
            visible: polygon_area(&within) / area,
            receivers: union_area(&receivers) / area,
        };
        (shares.least > 0.0).then_some(shares)
    }
}

/// The part of a normal across an axis; all of it where there is no axis.
fn across(normal: DVec3, axis: DVec3) -> DVec3 {
    if axis == DVec3::ZERO { normal } else { normal.reject_from(axis) }
}

/// The convex hull of points, counter-clockwise (Andrew's monotone chain).
fn hull(mut points: Vec<DVec2>) -> Vec<DVec2> {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    points.dedup();
    if points.len() < 3 {
        return points;
    }
    let mut around: Vec<DVec2> = Vec::with_capacity(2 * points.len());
    let mut grow = |point: DVec2, first: usize| {
        while let [.., a, b] = around[first..] {
            if (b - a).perp_dot(point - b) > 0.0 {
                break;
            }
            around.pop();
        }
        around.push(point);
        around.len()
    };
    let mut len = 0;
    for &point in &points {
        len = grow(point, 0);
    }
    for &point in points.iter().rev().skip(1) {
        grow(point, len - 1);
    }
    around.pop();
    around
}

/// The area of a convex polygon, its corners counter-clockwise.
fn polygon_area(polygon: &[DVec2]) -> f64 {
    0.5 * sides(polygon).map(|(a, b)| a.perp_dot(b)).sum::<f64>()
}

/// The sides of a polygon, in turn.
fn sides(polygon: &[DVec2]) -> impl Iterator<Item = (DVec2, DVec2)> + '_ {
    polygon.iter().copied().zip(polygon.iter().copied().cycle().skip(1))
}

/// The area of the least rectangle around a convex polygon: one of its sides lies along one of the polygon's.
fn least_rectangle(polygon: &[DVec2]) -> f64 {
    let area = |(a, b): (DVec2, DVec2)| {
        let along = (b - a).normalize_or_zero();
        let extent = |axis: DVec2| {
            let places = polygon.iter().map(|point| point.dot(axis));
            places.clone().fold(f64::NEG_INFINITY, f64::max) - places.fold(f64::INFINITY, f64::min)
        };
        extent(along) * extent(along.perp())
    };
    if polygon.len() < 3 { 0.0 } else { sides(polygon).map(area).fold(f64::INFINITY, f64::min) }
}

/// The part of a convex polygon within ±half.
fn clipped(polygon: &[DVec2], half: DVec2) -> Vec<DVec2> {
    let mut polygon = polygon.to_vec();
    for (inwards, limit) in [(DVec2::X, half.x), (DVec2::NEG_X, half.x), (DVec2::Y, half.y), (DVec2::NEG_Y, half.y)]
    {
        let value = |point: DVec2| inwards.dot(point) + limit;
        let mut kept = Vec::with_capacity(polygon.len() + 1);
        for (a, b) in sides(&polygon) {
            let (at_a, at_b) = (value(a), value(b));
            if at_a >= 0.0 {
                kept.push(a);
            }
            if (at_a >= 0.0) != (at_b >= 0.0) {
                kept.push(a.lerp(b, at_a / (at_a - at_b)));
            }
        }
        polygon = kept;
    }
    polygon
}

/// The area that convex polygons cover together, counted on a grid around them.
fn union_area(polygons: &[Vec<DVec2>]) -> f64 {
    let corners = || polygons.iter().flatten().copied();
    let (min, max) = (corners().fold(DVec2::INFINITY, DVec2::min), corners().fold(DVec2::NEG_INFINITY, DVec2::max));
    let cell = (max - min) / CELLS as f64;
    if !min.is_finite() || !cell.cmpgt(DVec2::ZERO).all() {
        return 0.0;
    }
    let mut covered = vec![false; CELLS * CELLS];
    for polygon in polygons.iter().filter(|polygon| polygon.len() >= 3) {
        for (row, cells) in covered.chunks_exact_mut(CELLS).enumerate() {
            let y = min.y + (row as f64 + 0.5) * cell.y;
            // Where the row's middle crosses the polygon.
            let crossings = sides(polygon).filter(|(a, b)| (a.y <= y) != (b.y <= y));
            let places = crossings.map(|(a, b)| a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y));
            let (from, to) =
                places.fold((f64::INFINITY, f64::NEG_INFINITY), |(from, to), x| (from.min(x), to.max(x)));
            if from <= to {
                let index = |x: f64| ((x - min.x) / cell.x - 0.5).ceil().max(0.0) as usize;
                let (from, to) = (index(from).min(CELLS), index(to).min(CELLS));
                cells[from..to].fill(true);
            }
        }
    }
    let count = covered.iter().filter(|&&covered| covered).count();
    count as f64 * cell.x * cell.y
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(min: f64, max: f64) -> Vec<DVec2> {
        hull(vec![DVec2::new(min, min), DVec2::new(max, min), DVec2::new(min, max), DVec2::new(max, max)])
    }

    #[test]
    fn areas_of_polygons() {
        let diamond = hull([DVec2::X, DVec2::Y, DVec2::NEG_X, DVec2::NEG_Y, DVec2::ZERO].to_vec());
        assert_eq!(diamond.len(), 4);
        assert!((polygon_area(&diamond) - 2.0).abs() < 1e-12);
        assert!((least_rectangle(&diamond) - 2.0).abs() < 1e-12, "turned by 45°");
        assert!((polygon_area(&clipped(&diamond, DVec2::splat(0.5))) - 1.0).abs() < 1e-12);
        assert!(clipped(&square(2.0, 3.0), DVec2::ONE).is_empty());
    }

    #[test]
    fn what_overlaps_counts_once() {
        let area = union_area(&[square(0.0, 2.0), square(1.0, 3.0), square(1.5, 1.75)]);
        assert!((area - 7.0).abs() < 0.05, "{area}");
        assert_eq!(union_area(&[]), 0.0);
    }

    #[test]
    fn windows_are_measured_across_the_light() {
        // Along −z, 8 wide and 4 high about (1, 0).
        let matrix =
            DMat4::from_scale(DVec3::new(0.25, 0.5, 0.01)) * DMat4::from_translation(DVec3::new(-1.0, 0.0, 0.0));
        let window = Window::new(&matrix).expect("it is sound");
        let near = [
            DVec3::new(0.0, -1.0, 5.0),
            DVec3::new(2.0, -1.0, 5.0),
            DVec3::new(0.0, 1.0, 5.0),
            DVec3::new(2.0, 1.0, 9.0),
        ];
        let shares = window.shares(&near, &[near[..3].to_vec()]).expect("all is in front");
        assert!(
            (shares.least - 4.0 / 32.0).abs() < 1e-12 && (shares.visible - 4.0 / 32.0).abs() < 1e-12,
            "{shares:?}"
        );
        assert!((shares.receivers - 2.0 / 32.0).abs() < 1e-3, "{shares:?}");

        // From the origin along −z with tangents of 1: at distance 10 the window is 20 wide.
        let matrix = DMat4::from_cols(DVec4::X, DVec4::Y, DVec4::NEG_Z, DVec4::NEG_Z).transpose();
        let window = Window::new(&matrix).expect("it is sound");
        let half = [
            DVec3::new(0.0, -10.0, -10.0),
            DVec3::new(10.0, -10.0, -10.0),
            DVec3::new(0.0, 10.0, -10.0),
            DVec3::new(10.0, 10.0, -10.0),
        ];
        let shares = window.shares(&half, &[]).expect("all is in front");
        assert!((shares.visible - 0.5).abs() < 1e-9, "{shares:?}");
        assert!(window.shares(&[DVec3::Z], &[]).is_none(), "behind the light");
        assert!(Window::new(&(matrix * f64::NAN)).is_none());
    }
}
