//! Points drawn into a map: the exact bounds of balls and discs in texels.

use crate::error::check;
use crate::input::numbers::vector;
use crate::map::shadow_map::ShadowMap;
use glam::{DVec2, DVec3};

/// The bounds of a ball or a disc in a map, for point clouds as casters: the axis-aligned rectangle that it just fits into,
/// in texels ([`ShadowMap::splat`], [`ShadowMap::disc_splat`]).
///
/// Coordinates are texture coordinates times the map's sides: the texel in column i and row j is the square from (i, j)
/// to (i + 1, j + 1). Each point of a cloud stands for a small disc of the surface it was taken from (Stamminger &
/// Drettakis 2002, §5). Where discs cover a surface in the world, their rectangles cover it in the map: a square grid of
/// points a distance s apart needs a radius of s/√2. A disc's depth is that of its plane, a ball's that of its centre.
/// `docs/depth.md` has the rest: how wires stay whole, and how a shader discards fragments in the rectangle but not in
/// the disc.
///
/// ```
#[doc = include_str!("../examples/sun.txt")]
/// let disc = map.disc_splat(ground, up, 0.25).expect("in the map");
/// let ball = map.splat(ground, 0.25).expect("in the map");
/// assert!(disc.half.cmple(ball.half).all());
/// assert!(disc.covering().half.min_element() > 0.5); // a texel or more across and down
/// assert_eq!(disc.diameter(), 2.0 * disc.half.max_element());
/// # Ok::<(), shadowfit::InputError>(())
/// ```
#[doc(alias = "point cloud")]
#[doc(alias = "gl_PointSize")]
#[doc(alias = "surfel")]
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Splat {
    /// The middle of the rectangle. In a perspective map the middle of the ball or disc falls elsewhere.
    pub centre: DVec2,
    /// Half of its width and height.
    pub half: DVec2,
}

impl Splat {
    /// Half of the least width and height of [`Self::covering`] rectangles: half a texel, and half a step of the grid of
    /// 256ths of a texel to which a rasteriser moves corners, twice: once for the grid and once for the rounding of clip
    /// coordinates to f32.
    const LEAST_HALF: f64 = 0.5 + 1.0 / 256.0;

    /// The spans of the values of two rows a over c, from where they begin to spread, and how.
    ///
    /// The planes a − t·c that touch a ball about P are those whose value at P is the radius ρ times the length of their
    /// normal. With t = `place` + s, `place` = a·P/c·P, and the normals of a − `place`·c and of c, times ρ/c·P, as
    /// `across` and `of_w`:
    ///
    /// ```text
    ///     s² = |across − s of_w|²      s² (1 − |of_w|²) + 2 s across·of_w − |across|² = 0
    /// ```
    ///
    /// The two roots are the ends of the values. For a disc, only the part of a normal in its plane counts. `rest` is
    /// 1 − |of_w|², and `sides` are the map's.
    fn of_spans([(x, across_x), (y, across_y)]: [(f64, DVec3); 2], of_w: DVec3, rest: f64, sides: DVec2) -> Self {
        let mixed = DVec2::new(across_x.dot(of_w), across_y.dot(of_w));
        let squared = DVec2::new(across_x.length_squared(), across_y.length_squared());
        let half = (mixed * mixed + squared * rest).sqrt();
        let scale = sides / rest;
        Self { centre: DVec2::new(x, y) * sides - mixed * scale, half: half * scale }
    }

    /// The rectangle grown to at least a texel across and down, so that it holds the middle of at least one texel wherever it
    /// falls, also after a rasteriser has moved its corners to a grid of 256ths of a texel or finer.
    #[must_use]
    pub fn covering(&self) -> Self {
        Self { half: self.half.max(DVec2::splat(Self::LEAST_HALF)), ..*self }
    }

    /// The size to draw a point with, where an API has points (`gl_PointSize`, Vulkan's `PointSize`): the side, in
    /// texels, of the square about [`Self::centre`] that holds the rectangle. A point of [`Self::covering`] size covers
    /// as the rectangle does.
    #[must_use]
    pub fn diameter(&self) -> f64 {
        2.0 * self.half.max_element()
    }
}

impl ShadowMap {
    /// The exact bounds in the map of a ball, given by its centre and radius in world space.
    ///
    /// `None` where the ball reaches a point with w ≤ 0, as next to a point light: a part of it is then infinitely far
    /// away in the map. Also `None` for numbers that are not finite and for a negative radius.
    ///
    /// ```
    #[doc = include_str!("../examples/spot.txt")]
    /// let ball = map.splat(floor, 0.1).expect("in front of the spot");
    /// let size = f64::from(settings.map_size());
    /// assert!(ball.half.cmpgt(DVec3::ZERO.truncate()).all() && ball.centre.max_element() < size);
    /// assert_eq!(map.splat(floor + 4.0 * up, 0.5), None); // around the spot
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn splat<F: Into<f64>>(&self, centre: impl Into<[F; 3]>, radius: f64) -> Option<Splat> {
        self.splat_across(vector(centre), radius, DVec3::ZERO)
    }

    /// The exact bounds in the map of a disc, given by its centre, normal and radius in world space. The normal may point to
    /// either side and need not be unit length.
    ///
    /// `None` as for [`Self::splat`], and where the normal has no direction.
    ///
    /// ```
    #[doc = include_str!("../examples/sun.txt")]
    /// let flat = map.disc_splat(ground, up, 0.25).expect("in the map");
    /// assert_eq!(Some(flat), map.disc_splat(ground, -2.0 * up, 0.25));
    /// assert_eq!(map.disc_splat(ground, DVec3::ZERO, 0.25), None);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn disc_splat<F: Into<f64>, G: Into<f64>>(
        &self,
        centre: impl Into<[F; 3]>,
        normal: impl Into<[G; 3]>,
        radius: f64,
    ) -> Option<Splat> {
        let normal = check::direction("normal", vector(normal)).ok()?;
        self.splat_across(vector(centre), radius, normal)
    }

    /// Bounds of the disc across a unit normal, or of the ball where the normal is zero.
    fn splat_across(&self, centre: DVec3, radius: f64, normal: DVec3) -> Option<Splat> {
        let [x, y, _, w] = self.settings().clip().texture_rows_from_wgpu(self.rows);
        let at = w.at(centre);
        // The farthest that the disc goes to along a covector is its radius times the part of the covector in its plane.
        let reach = |gradient: DVec3| (gradient - normal * normal.dot(gradient)) * (radius / at);
        let of_w = reach(w.normal);
        let rest = 1.0 - of_w.length_squared();
        if !(radius >= 0.0 && at > 0.0 && rest > 0.0) {
            return None;
        }
        let across = [x, y].map(|row| {
            let place = row.at(centre) / at;
            (place, reach(row.normal - w.normal * place))
        });
        let splat = Splat::of_spans(across, of_w, rest, self.settings().sides());
        (splat.centre.is_finite() && splat.half.is_finite()).then_some(splat)
    }
}
