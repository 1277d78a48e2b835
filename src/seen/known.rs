//! The surfaces that a camera sees.

use crate::convex::Plane;
use crate::error::{Expected, InputError, MAX_COORDINATE, check};
use crate::input::clip_space::DepthRange;
use crate::input::view::View;
use crate::math::bounds::{Interval, least, most};
use crate::seen::point::SeenPoint;
use crate::seen::tile::{DepthTile, Grid};
use glam::{DVec2, DVec3};

/// The surfaces that a camera sees, for [`Focus::with_seen`](crate::Focus::with_seen): points on them, or its depth buffer reduced to
/// tiles.
///
/// # What is promised
///
/// - All points, and all that showed in the pixels of the tiles, lie in the map of the focus where they are receivers in view now,
///   also when they have moved by the [margin](Self::with_margin) since.
/// - Between the frame of the tiles and the one that is fitted the camera may have moved and turned. What comes into view at the
///   borders of the image is taken to be as deep as what was next to it.
/// - What appears from behind something else is not known. It is in the map where it lies between other surfaces, as the light
///   sees them; elsewhere it is outside of the map: lit, or in the next cascade. [`Self::unseen`] bounds how much of the image comes in
///   from its borders.
/// - After a cut, where more than half of an image's width or height has come into view, the tiles say nothing and the focus stays as
///   it is.
#[doc(alias = "SDSM")]
#[doc(alias = "sample distribution shadow maps")]
#[doc(alias = "depth read-back")]
#[derive(Clone, Copy, Debug)]
pub struct Seen<'a> {
    source: Source<'a>,
    /// How far surfaces may have moved.
    pub(crate) margin: f64,
}

#[derive(Clone, Copy, Debug)]
#[expect(clippy::large_enum_variant, reason = "a box would need a heap")]
enum Source<'a> {
    Points(&'a [SeenPoint]),
    Tiles { view: View, range: DepthRange, grid: Grid, tiles: &'a [DepthTile] },
}

/// Corners of a part of the view: four at its nearest depth, four at its farthest.
pub(crate) type Cell = [DVec3; 8];

/// The relative error of depths read back: f32 depths are off by about a millionth, and by more at grazing angles, as rasterisers
/// snap vertices to a grid of 1/256 pixel.
const DEPTH_ERROR: f64 = 1.0 / 1024.0;

/// The part of an image that may come into view from one side; with more the camera has cut.
const MOST_UNSEEN: f64 = 0.5;

/// How many points stand for the tiles of an image.
const SAMPLES: usize = 128;

impl<'a> Seen<'a> {
    /// Points on all surfaces in view. What the hull of these points does not hold, as the light sees it, may lie outside of the map.
    ///
    /// ```
    #[doc = include_str!("../examples/sun.txt")]
    /// use shadowfit::seen::{Seen, SeenPoint};
    ///
    /// let at = |x: f64, z: f64| SeenPoint { position: DVec3::new(x, 0.0, z), normal: Some(up), pixels: 1.0 };
    /// let floor = [at(-2.0, -4.0), at(2.0, -4.0), at(-6.0, -12.0), at(6.0, -12.0)];
    /// let seen = Seen::from_points(&floor)?;
    /// let finer = focus.clone().with_seen(&seen).fit(&settings).into_map().expect("receivers");
    /// let point = DVec3::new(0.0, 0.0, -8.0);
    /// assert!(finer.aliasing(point) < map.aliasing(point));
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// Names `"points"`, with the index, when a position is not finite or too large, a normal has no direction, or `pixels` is not
    /// positive and finite.
    pub fn from_points(points: &'a [SeenPoint]) -> Result<Self, InputError> {
        points.iter().enumerate().try_for_each(|(index, point)| point.checked(index))?;
        Ok(Self { source: Source::Points(points), margin: 0.0 })
    }

    /// The depth buffer of `view`, `image` pixels across and down, reduced to tiles of `tile` pixels a side: on the card by
    /// `wgsl::DEPTH_TILES`, or by [`DepthTile::reduce`].
    ///
    /// ```
    #[doc = include_str!("../examples/sun.txt")]
    /// use shadowfit::{input::DepthRange, seen::{DepthTile, Seen}};
    ///
    /// // A wall across the whole image, as stored in reversed depth.
    /// let depths = [0.02; 160 * 100];
    /// let tiles: Vec<_> = DepthTile::reduce(&depths, [160, 100], 10, DepthRange::ZeroToOneReversed)?.collect();
    /// let seen = Seen::from_tiles(&view, DepthRange::ZeroToOneReversed, [160, 100], 10, &tiles)?;
    /// assert_eq!(seen.unseen(&view), 0.0);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// Names `"image"` and `"tile"` as [`DepthTile::reduce`] does, and `"tiles"` when there are not as many as the image has.
    pub fn from_tiles(
        view: &View,
        range: DepthRange,
        image: [u32; 2],
        tile: u32,
        tiles: &'a [DepthTile],
    ) -> Result<Self, InputError> {
        let grid = Grid::new(image, tile)?;
        let count = grid.len() as f64;
        check::within("tiles", tiles.len() as f64, Expected::Within { least: count, most: count })?;
        Ok(Self { source: Source::Tiles { view: *view, range, grid, tiles }, margin: 0.0 })
    }

    /// The same with a margin: how far any surface may have moved since, in world units.
    ///
    /// # Errors
    ///
    /// Names `"margin"` when it is negative, not finite or too large.
    pub fn with_margin(self, margin: f64) -> Result<Self, InputError> {
        let margin = check::within("margin", margin, Expected::Within { least: 0.0, most: MAX_COORDINATE })?;
        Ok(Self { margin, ..self })
    }

    /// Upper bound on the part of a view's image that came into view at its borders since the tiles were drawn, 0 to 1.
    #[must_use]
    pub fn unseen(&self, now: &View) -> f64 {
        let Source::Tiles { view, .. } = &self.source else { return 0.0 };
        let Some((min, max)) = self.frame(view, now) else { return 1.0 };
        let size = max - min;
        let kept = (max.min(DVec2::ONE) - min.max(DVec2::ZERO)).max(DVec2::ZERO) / size;
        1.0 - kept.x * kept.y
    }

    /// Points that stand for the surfaces, evenly chosen.
    pub(crate) fn for_each_sample(&self, count: usize, mut each: impl FnMut(SeenPoint)) {
        match self.source {
            Source::Points(points) => {
                let step = points.len().div_ceil(count).max(1);
                points.iter().step_by(step).for_each(|point| each(*point));
            }
            Source::Tiles { view, range, grid, tiles } => {
                let mut step = tiles.len().div_ceil(count.min(SAMPLES)).max(1);
                // Not column by column.
                while step > 1 && (grid.tiles()[0] as usize).is_multiple_of(step) {
                    step += 1;
                }
                let camera = Camera::new(&view, range, grid.image);
                tiles
                    .iter()
                    .step_by(step)
                    .filter(|tile| !tile.is_empty())
                    .for_each(|tile| each(camera.surface(tile)));
            }
        }
    }

    /// Calls `each` with cells that together hold all that is in view `now` as far as is known. Returns whether anything is.
    pub(crate) fn for_each_cell(&self, now: &View, mut each: impl FnMut(&[DVec3])) -> bool {
        match self.source {
            Source::Points(points) => {
                points.iter().for_each(|point| each(&[point.position]));
                true
            }
            Source::Tiles { view, range, grid, tiles } => {
                let Some((min, max)) = self.frame(&view, now) else { return false };
                if (-min).max(max - 1.0).max_element() > MOST_UNSEEN {
                    return false;
                }
                for (index, tile) in tiles.iter().enumerate().filter(|(_, tile)| !tile.is_empty()) {
                    let (low, high) = cell_frame(&grid, index, min, max);
                    let depth = |stored: f32| view.depth_of(stored.into(), range);
                    let (a, b) = (depth(tile.least), depth(tile.greatest));
                    let (near, far) = (least(a, b) * (1.0 - DEPTH_ERROR), most(a, b) * (1.0 + DEPTH_ERROR));
                    each(&cell(&view, low, high, near, far));
                }
                true
            }
        }
    }

    /// The part of the tiles' image that a view covers now, the whole image at least, from 0 to 1; `None` where part of it is behind
    /// that camera.
    fn frame(&self, then: &View, now: &View) -> Option<(DVec2, DVec2)> {
        let (mut min, mut max) = (DVec2::ZERO, DVec2::ONE);
        if then == now {
            return Some((min, max));
        }
        let Source::Tiles { range, tiles, .. } = self.source else { return Some((min, max)) };
        let mut depths = Interval::EMPTY;
        for tile in tiles.iter().filter(|tile| !tile.is_empty()) {
            depths.include(then.depth_of(tile.least.into(), range));
            depths.include(then.depth_of(tile.greatest.into(), range));
        }
        // The camera may have moved towards all surfaces or away from them.
        let moved = then.eye().distance(now.eye());
        let near = most(now.near(), least(depths.min - moved, depths.min * 0.5));
        let far = least(now.far(), depths.max + moved);
        for x in [0.0, 1.0] {
            for y in [0.0, 1.0] {
                let (from, step) = now.ray(DVec2::new(x, y));
                for depth in [near, far] {
                    let place = then.place(from + step * depth)?;
                    (min, max) = (min.min(place), max.max(place));
                }
            }
        }
        (min.is_finite() && max.is_finite()).then_some((min, max))
    }
}

/// The part of the frame that a tile stands for, y up: its own, and what is beyond the image's borders next to it.
fn cell_frame(grid: &Grid, index: usize, min: DVec2, max: DVec2) -> (DVec2, DVec2) {
    let [first, end] = grid.pixels(index);
    let part = |pixel: u32, axis: usize| {
        let image = grid.image[axis];
        if pixel == 0 {
            (axis, 0)
        } else if pixel == image {
            (axis, 2)
        } else {
            (axis, 1)
        }
    };
    let place = |pixel: u32, axis: usize| {
        let at = f64::from(pixel) / f64::from(grid.image[axis]);
        // Rows run from the top.
        match (part(pixel, axis), axis) {
            ((_, 0), 0) => min.x,
            ((_, 2), 0) => max.x,
            ((_, 0), _) => max.y,
            ((_, 2), _) => min.y,
            (_, 0) => at,
            _ => 1.0 - at,
        }
    };
    (DVec2::new(place(first[0], 0), place(end[1], 1)), DVec2::new(place(end[0], 0), place(first[1], 1)))
}

/// The corners of the part of a view between two places in its frame and two depths.
fn cell(view: &View, low: DVec2, high: DVec2, near: f64, far: f64) -> Cell {
    let mut corners = [DVec3::ZERO; 8];
    let places = [low, DVec2::new(high.x, low.y), DVec2::new(low.x, high.y), high];
    for (index, place) in places.into_iter().enumerate() {
        let (from, step) = view.ray(place);
        corners[index] = from + step * near;
        corners[index + 4] = from + step * far;
    }
    corners
}

/// A camera whose depth buffer was read.
struct Camera {
    view: View,
    range: DepthRange,
    image: DVec2,
    /// The rows of its matrix, with depth as stored.
    rows: [Plane; 4],
}

impl Camera {
    fn new(view: &View, range: DepthRange, image: [u32; 2]) -> Self {
        let [x, y, z, w] = view.rows(view.near(), view.far());
        let stored = if range.is_reversed() { w - z } else { w + z } * 0.5;
        Self { view: *view, range, image: DVec2::new(image[0].into(), image[1].into()), rows: [x, y, stored, w] }
    }

    /// The sample of a tile.
    fn surface(&self, tile: &DepthTile) -> SeenPoint {
        let middle = DVec2::from(tile.pixel.map(f64::from)) + 0.5;
        let place = middle / self.image;
        let (from, step) = self.view.ray(DVec2::new(place.x, 1.0 - place.y));
        let position = from + step * self.view.depth_of(tile.depth.into(), self.range);
        // Stored depth on the surface's plane: depth + slope · (pixel − middle), with pixels as functions in the image.
        let [x, y, z, w] = self.rows;
        let slope = DVec2::from(tile.slope.map(f64::from));
        let across = (x + w) * (0.5 * self.image.x) - w * middle.x;
        let down = (w - y) * (0.5 * self.image.y) - w * middle.y;
        let plane = z - w * f64::from(tile.depth) - across * slope.x - down * slope.y;
        let normal =
            plane.normal.try_normalize().map(|normal| if normal.dot(step) > 0.0 { -normal } else { normal });
        SeenPoint { position, normal, pixels: tile.pixels.into() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const IMAGE: [u32; 2] = [192, 108];

    fn views() -> [View; 4] {
        let (eye, forward) = (DVec3::new(3.0, 1.7, -2.0), DVec3::new(0.4, -0.3, -1.0));
        let perspective = |far| View::perspective(eye, forward, DVec3::Y, 1.0, 1.6, 0.1, far).expect("sound");
        [
            perspective(200.0),
            perspective(f64::INFINITY),
            View::orthographic(eye, forward, DVec3::Y, 9.0, 1.6, 0.1, 200.0).expect("sound"),
            // One side of a stereo pair.
            View::from_matrices(
                [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, -1.7, 0.0, 1.0]],
                [[1.1, 0.0, 0.0, 0.0], [0.0, 1.8, 0.0, 0.0], [0.2, -0.1, -1.0, -1.0], [0.0, 0.0, -0.1, 0.0]],
                crate::ClipSpace::WGPU,
            )
            .expect("sound"),
        ]
    }

    /// What a depth buffer holds of a plane at a pixel's centre, and the point of the plane that it shows.
    fn drawn(view: &View, range: DepthRange, plane: &Plane, pixel: DVec2) -> (f64, DVec3) {
        let place = (pixel + 0.5) / DVec2::new(IMAGE[0].into(), IMAGE[1].into());
        let (from, step) = view.ray(DVec2::new(place.x, 1.0 - place.y));
        let depth = -plane.at(from) / plane.normal.dot(step);
        let ratio = view.near() / view.far();
        let to_near = match view.lens() {
            crate::input::Lens::Perspective => (view.near() / depth - ratio) / (1.0 - ratio),
            crate::input::Lens::Orthographic => (view.far() - depth) / (view.far() - view.near()),
        };
        (if range.is_reversed() { to_near } else { 1.0 - to_near }, from + step * depth)
    }

    /// Position and normal come back from a tile's sample, in every depth range and under every camera.
    #[test]
    fn samples_give_back_the_plane() {
        let normals = [DVec3::Y, DVec3::new(-0.3, 0.2, 1.0), DVec3::new(0.7, 0.1, 0.6)].map(DVec3::normalize);
        let ranges = [
            DepthRange::ZeroToOne,
            DepthRange::ZeroToOneReversed,
            DepthRange::NegativeOneToOne,
            DepthRange::NegativeOneToOneReversed,
        ];
        let pixel = DVec2::new(70.0, 80.0);
        for view in views() {
            for normal in normals {
                for depth in [2.0, 12.0] {
                    let (from, step) = view.ray(DVec2::new(0.36, 0.26));
                    let plane = Plane::through(normal, from + step * depth);
                    for range in ranges {
                        let (stored, point) = drawn(&view, range, &plane, pixel);
                        let change = |step| (drawn(&view, range, &plane, pixel + step).0 - stored) as f32;
                        let tile = DepthTile {
                            depth: stored as f32,
                            slope: [change(DVec2::X), change(DVec2::Y)],
                            pixel: [70, 80],
                            pixels: 9,
                            ..DepthTile::EMPTY
                        };
                        let found = Camera::new(&view, range, IMAGE).surface(&tile);
                        // Depths near 1 are off by 2⁻²⁵, which counts depth / near times as much in a perspective.
                        let off = found.position.distance(point) / point.distance(view.eye());
                        assert!(off < 1e-5, "{range:?}: {} for {point}, {off:e}", found.position);
                        let towards_eye = if normal.dot(step) > 0.0 { -normal } else { normal };
                        let apart = found.normal.expect("a plane").distance(towards_eye);
                        assert!(apart < 1e-5, "{range:?}: {:?} for {towards_eye}, {apart:e}", found.normal);
                    }
                }
            }
        }
    }
}
