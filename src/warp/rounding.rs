//! What f32 makes of a matrix: how far rounding can carry a point in clip space, and the padding that covers it.

use crate::convex::Plane;
use crate::math::bounds::{self, Interval, Rectangle, least, most};
use crate::warp::homography::Homography;
use crate::warp::rays::Rays;
use glam::{DMat4, DVec2, DVec3, DVec4};

/// Rounding of a row of an f32 matrix at a point, relative to the sum of the magnitudes of its four terms.
///
/// A clip coordinate is a sum of four products in f32: the coordinate and the entry are rounded on the way in, the
/// product once, the sum three times, so that an error is at most 6 units in the last place, 6 · 2⁻²⁴, of the sum of the
/// terms' magnitudes. Eight leave room for terms of second order and for a row that is the sum of two (depth −1 to 1).
pub(crate) const UNITS: f64 = 8.0 / 16_777_216.0;

/// What is no farther from a light at a position, along the axis, than this part of the way to the farthest of what is
/// visible is beside it: a bias answers there for depth, but not for places ([`DepthBias`](crate::depth::DepthBias)).
pub(crate) const AWAY_FROM_LAMP: f64 = 1.0 / 16.0;

/// The same in f64, for the dozen or two roundings between a point of the input and a row of the matrix.
const UNITS_F64: f64 = 32.0 * f64::EPSILON;

/// Rounding of a row of an f32 matrix over points no farther than `extent` from `origin` on each axis, which their
/// positions are relative to.
pub(crate) fn of_row(row: &Plane, origin: DVec3, extent: DVec3) -> f64 {
    UNITS * (row.normal.abs().dot(extent) + row.at(origin).abs())
}

/// Rounding of the rows a, b, e and c of a homography, relative to c, over what is visible and over what can cast on it.
///
/// With M the sum of magnitudes, a row is off by at most M/c. M is convex and c is linear, which makes two bounds of what
/// is found at the vertices of a body:
///
/// ```text
///     M(X)/c(X) ≤ max M / c(X)         M(X)/c(X) ≤ max (M/c)
/// ```
///
/// The first is the better one where positions round alike and c does not stay the same: next to a lamp c is small and M
/// is not. The second is the better one where M grows with c, as it may in a warp about the eye.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rounding {
    /// Magnitudes of the rows about the origin, as the columns of a matrix.
    magnitudes: DMat4,
    origin: DVec3,
    /// Least and largest c of what is visible and no nearer to the light than its near distance.
    c: Interval,
    /// The least c of what is not beside a lamp either.
    away: f64,
    /// By how much ratios at the vertices may be too small, see [`Self::include_visible`], with c no less than `c` and `away`.
    cut: [f64; 2],
    visible: Visible,
    /// The largest M/c of what can cast.
    casting: Rows,
    /// Whether the light is at a position, so that casters may come close to it.
    local: bool,
}

/// A number for each of the rows a, b, e and c.
#[derive(Clone, Copy, Debug, Default)]
struct Rows {
    across: DVec2,
    depth: f64,
    w: f64,
}

/// The largest M of what is visible, and the largest M/c, also where what is beside a lamp is left out.
#[derive(Clone, Copy, Debug, Default)]
struct Visible {
    magnitude: Rows,
    ratio: Rows,
    ratio_away: Rows,
}

impl Rows {
    fn include(&mut self, here: DVec4) {
        self.across = DVec2::new(most(self.across.x, here.x), most(self.across.y, here.y));
        self.depth = most(self.depth, here.z);
        self.w = most(self.w, here.w);
    }

    fn times(&self, factor: f64) -> Self {
        Self { across: self.across * factor, depth: self.depth * factor, w: self.w * factor }
    }

    fn min(&self, other: &Self) -> Self {
        let across = self.across.min(other.across);
        Self { across, depth: least(self.depth, other.depth), w: least(self.w, other.w) }
    }

    /// Rounding of depths in a range, whose row is e − min c or, where depth is reversed, max c − e.
    fn of_depth(&self, range: &Interval) -> f64 {
        self.depth + most(range.min.abs(), range.max.abs()) * self.w
    }

    /// What a range is padded by at an end for this: twice the rounding of z and of w.
    fn padding(&self, range: &Interval) -> f64 {
        2.0 * (self.of_depth(range) + (range.max - range.min) * self.w)
    }

    /// Rounding of positions across a window, whose rows are a and b less the centre times c.
    fn of_window(&self, window: &Rectangle) -> DVec2 {
        self.across + window.centre.abs() * self.w
    }

    /// What these make of depth after the division, relative to the range: z counts as it is and w by z/w ≤ 1.
    fn in_depth(&self, range: &Interval) -> f64 {
        self.of_depth(range) / (range.max - range.min) + self.w
    }

    /// The same of texture coordinates, across and down, relative to the window. w counts once in the row, which is half the
    /// sum of w's and another, and twice in the division: |x/w| ≤ 1 there, texture coordinates are half as large.
    fn in_window(&self, window: &Rectangle) -> DVec2 {
        self.of_window(window) / window.half + 3.0 * self.w
    }
}

/// How far f32 can carry a value at a point of a map where w is at most 1: no more than `over_w`/w, and than `most`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Noise {
    pub(crate) over_w: f64,
    pub(crate) most: f64,
}

impl Noise {
    /// Where w is that; infinite outside of the map.
    pub(crate) fn at(&self, w: f64) -> f64 {
        if w > 0.0 { least(self.over_w / w, self.most) } else { f64::INFINITY }
    }

    /// Numbers p and q with p/w + q no less than the noise anywhere: the line, over 1/w, through the corner that its two
    /// bounds make at w = `over_w`/`most`. It leans so that it is too large by the same factor at both ends, at `least_w`
    /// and at 1; with a corner at either end it is that end's bound, and exact.
    pub(crate) fn parts(&self, least_w: f64) -> (f64, f64) {
        let corner = (self.over_w / self.most).max(least_w).min(1.0);
        let (far, near) = (corner.recip() - 1.0, corner / least_w - 1.0);
        let constant = if far + near > 0.0 { near / (far + near) } else { 1.0 };
        ((1.0 - constant) * self.over_w, constant * self.most)
    }
}

/// What is visible beside a lamp may ask for this part of the window as padding and no more: most often it is air.
const MOST_BESIDE_LAMP: f64 = 1.0 / 64.0;

/// A caster next to a light at a position is seen from there through few bits. Such casters may ask for this part of the
/// window as padding and no more: beyond that the map is for what is visible.
const MOST_FOR_LOCAL_CASTERS: f64 = 1.0 / 1024.0;

/// A depth range is at least so many times as long as the rounding in it where c is largest. All that is visible of a flat
/// scene under a light from straight above has one depth; were its range no longer than needed, there would be nothing but
/// noise in it, and every point would shadow itself. With this the noise is 16 steps of 24 bits or a 16th of a step of 16,
/// and what f32 loses of w besides, while no range grows longer than about what the coordinates are large.
///
/// Elsewhere it is that over w, which bias and padding follow. It must not be where c is least that the range is measured
/// by: what is visible of a lamp in view begins in the air at its near distance, where noise is hundreds of times larger
/// than on anything that is seen, and a range so much longer is only coarser.
pub(crate) const QUIET: f64 = 1_048_576.0;

impl Rounding {
    /// No points yet; positions are taken relative to `origin`, c of what is visible is in `c`, of what is no nearer to
    /// the light than its near distance at least `least_c`, and of what is not beside a lamp at least `away_c`.
    pub(crate) fn new(
        map: &Homography,
        rays: &Rays,
        origin: DVec3,
        c: &Interval,
        [least_c, away_c]: [f64; 2],
    ) -> Self {
        let rows = map.rows;
        let about = rows.x_axis * origin.x + rows.y_axis * origin.y + rows.z_axis * origin.z + rows.w_axis;
        let [x, y, z, w] = [rows.x_axis, rows.y_axis, rows.z_axis, about].map(|column| column.abs() * UNITS);
        // Moving a matrix to an origin far away cancels terms in f64 that f32 then knows nothing of.
        let [away_x, away_y, away_z] = (origin.abs() * UNITS_F64).to_array();
        let cancelled = rows.x_axis.abs() * away_x
            + rows.y_axis.abs() * away_y
            + rows.z_axis.abs() * away_z
            + rows.w_axis.abs() * UNITS_F64;
        let w = w + cancelled;
        let counted = least(most(c.min, least_c), c.max);
        let away = least(most(counted, away_c), c.max);
        Self {
            magnitudes: DMat4::from_cols(x, y, z, w),
            origin,
            c: Interval { min: counted, max: c.max },
            away,
            cut: [counted, away].map(|counted| 2.0 - least(c.min / counted, 1.0)),
            visible: Visible::default(),
            casting: Rows::default(),
            local: rays.local,
        }
    }

    #[inline]
    fn at(&self, point: DVec3) -> DVec4 {
        let DVec3 { x, y, z } = (point - self.origin).abs();
        let m = &self.magnitudes;
        m.x_axis * x + m.y_axis * y + m.z_axis * z + m.w_axis
    }

    /// Takes in a visible point, with c there.
    ///
    /// Those nearer to the light than its near distance need not be right, but points beyond it lie between them and
    /// others. With Q the largest M/max(c, c₀) at the vertices and X = Σ μV among them, c(X) = c₀, the least that counts,
    ///
    /// ```text
    ///     M(X) ≤ Σ μ M(V) ≤ Q Σ μ max(c(V), c₀) ≤ Q (c(X) + c₀ − min c)
    /// ```
    ///
    /// so that M/c is at most Q (2 − min c/c₀) there, and where c is larger.
    #[inline]
    pub(crate) fn include_visible(&mut self, point: DVec3, c: f64) {
        let here = self.at(point);
        self.visible.magnitude.include(here);
        self.visible.ratio.include(here * most(c, self.c.min).recip());
        self.visible.ratio_away.include(here * most(c, self.away).recip());
    }

    /// Takes in a point that may cast, with c there.
    #[inline]
    pub(crate) fn include_casting(&mut self, point: DVec3, c: f64) {
        self.casting.include(self.at(point) * c.recip());
    }

    /// Rounding of what is visible, relative to c, at most.
    fn visible(&self) -> Rows {
        self.visible.ratio.times(self.cut[0]).min(&self.visible.magnitude.times(self.c.min.recip()))
    }

    /// The same of what is not beside a lamp.
    fn away(&self) -> Rows {
        self.visible.ratio_away.times(self.cut[1]).min(&self.visible.magnitude.times(self.away.recip()))
    }

    /// Half extents of a window that holds `window` after rounding in the `inner` part of a map of so many texels across and
    /// down, no smaller than `least`, nor, under a directional light, so small that a texel would be less than the rounding.
    pub(crate) fn padded_window(&self, window: &Rectangle, inner: DVec2, sides: DVec2, least: f64) -> DVec2 {
        let away = self.away();
        let (mut beside, mut casting) = (self.visible(), self.casting);
        let of_away = away.of_window(window);
        let (mut of_beside, mut of_casting) = (beside.of_window(window), casting.of_window(window));
        if self.local {
            of_beside = of_beside.min(window.half * MOST_BESIDE_LAMP);
            beside.w = beside.w.min(MOST_BESIDE_LAMP);
            of_casting = of_casting.min(window.half * MOST_FOR_LOCAL_CASTERS);
            casting.w = casting.w.min(MOST_FOR_LOCAL_CASTERS);
        }
        let w = away.w.max(beside.w).max(casting.w).min(0.5);
        let padded = (window.half + of_away.max(of_beside).max(of_casting)) / ((1.0 - w) * inner);
        // Next to a lamp coordinates are small and rounding is not; its map would be as coarse as that all over.
        let of_texels = if self.local { DVec2::ZERO } else { of_away * (0.5 * sides) };
        padded.max(of_texels).max(DVec2::splat(least))
    }

    /// How deep rounding may put a point that casts, with the depth e/c there, in a range before it is padded.
    ///
    /// (e + M)/c of a body is largest at a vertex, as M/c is. It is not enough to know M/c of what is visible: on a plane that a
    /// lamp grazes casters are as deep as that, and may be much farther from the origin.
    #[inline]
    pub(crate) fn deepest(&self, point: DVec3, e: f64, c: f64, range: &Interval) -> f64 {
        let mut rows = Rows::default();
        rows.include(self.at(point) * c.recip());
        e / c + rows.padding(range)
    }

    /// A depth range that holds `depth` after rounding, what casts down to `deepest`, no shorter than `least`, nor so short
    /// that the rounding of what is visible would be more than a millionth of it where c is largest.
    pub(crate) fn padded_depth(&self, depth: &Interval, deepest: f64, least: f64) -> Interval {
        let length = depth.max - depth.min;
        let far = self.visible().padding(depth);
        // Casters next to a light may at most double the range.
        let near = far.max(self.casting.padding(depth).min(length));
        let far = far.max((deepest - depth.max).min(length));
        // Of the row e − min c only what a longer range makes less of: the ends are no farther apart than it is long, so
        // that the rest is at most what f32 loses of w. Hyperbolic depth begins far below 0 and ends next to it.
        let Rows { depth: e, w, .. } = self.visible.magnitude;
        let quietest = (e + bounds::least(depth.min.abs(), depth.max.abs()) * w) / self.c.max;
        let shortest = least.max(QUIET * quietest);
        let missing = 0.5 * (shortest - (length + near + far)).max(0.0);
        Interval { min: depth.min - near - missing, max: depth.max + far + missing }
    }

    /// The same for a map whose w is 1 where c is `largest`, no less than the largest of what is visible.
    pub(crate) fn scaled_to(self, largest: f64) -> Self {
        Self { c: Interval { max: largest, ..self.c }, ..self }
    }

    /// What all this makes of a map of so many texels across and down, where −e·l is as said.
    pub(crate) fn in_map(
        &self,
        map: &Homography,
        window: &Rectangle,
        depth: &Interval,
        sides: DVec2,
        to_light: f64,
    ) -> MapNoise {
        // Where f32 loses half of w or more, a point is anywhere.
        let left = 1.0 - self.visible().w.min(0.5);
        let noise = |of: &dyn Fn(&Rows) -> f64| Noise {
            over_w: of(&self.visible.magnitude.times(self.c.max.recip())) / left,
            most: of(&self.visible()) / left,
        };
        MapNoise {
            depth: noise(&|rows| rows.in_depth(depth)),
            place: noise(&|rows| (0.5 * sides * rows.in_window(window)).max_element()),
            least_w: self.c.min / self.c.max,
            away_w: self.away / self.c.max,
            to_light: to_light / (depth.max - depth.min) / self.c.max,
            change: map.change_of_inverse_c(window, sides) / to_light * self.c.max,
        }
    }
}

/// Noise of what is visible in a map, whose w is 1 where it is largest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct MapNoise {
    /// Of depth, where its range is 1.
    pub(crate) depth: Noise,
    /// Of places, in texels across or down, read by texture coordinates.
    pub(crate) place: Noise,
    /// The least w of anything no nearer to the light than its near distance.
    pub(crate) least_w: f64,
    /// The least w of anything that is not beside a lamp.
    pub(crate) away_w: f64,
    /// −z·l, z the row of depth, more than 0: what an [`ReceiverOffset::relative`](crate::depth::ReceiverOffset::relative) of 1 takes off depth
    /// where w is 1. The matrix may have lost it where all this is far from the origin.
    pub(crate) to_light: f64,
    /// How much 1/w changes on a plane from a texel to the next one, across and down together, apart from the part
    /// 1/−z·l of how much depth does under a light at a position.
    ///
    /// With D the point on a ray, on the chart, where c is 1, a point X = l + t D has c·X = t and
    ///
    /// ```text
    ///     e·X/c·X = e·l/c·X + e·D         1/c·X = (e·D − z)/(−e·l)         for a light at a position,
    ///     1/c·X = w(D)                                                     for a directional one, X = (D + t l)/w(D),
    /// ```
    ///
    /// where w(D), which e·D is in the first case, is linear in the place in the map and the same for all planes.
    pub(crate) change: f64,
}

#[cfg(test)]
#[allow(clippy::disallowed_methods, reason = "powers spread the cases, they are no part of a fit")]
mod tests {
    use super::Noise;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig { cases: 5000, failure_persistence: None, ..ProptestConfig::default() })]

        /// The line of 1/w is nowhere below the noise, and no more above it at one end than at the other; with the corner at
        /// an end it is the noise.
        #[test]
        fn parts_are_no_less_than_the_noise(over_w in -9.0..0.0, most in 0.0..6.0, least_w in -6.0..-0.01) {
            let [over_w, most, least_w] =
                [over_w, most, least_w].map(|exponent: f64| (exponent * core::f64::consts::LN_10).exp());
            let noise = Noise { over_w, most: over_w * most };
            let (p, q) = noise.parts(least_w);
            prop_assert!(p >= 0.0 && q >= 0.0);
            let over = |w: f64| (p / w + q) / noise.at(w);
            for step in 0..=64 {
                let w = least_w + (1.0 - least_w) * f64::from(step * step) / 4096.0;
                prop_assert!(over(w) >= 1.0 - 1e-12, "at {} by {}", w, over(w));
            }
            let corner = over_w / noise.most;
            if corner > least_w && corner < 1.0 {
                prop_assert!((over(corner) - 1.0).abs() <= 1e-12, "at the corner by {}", over(corner));
                prop_assert!((over(least_w) / over(1.0) - 1.0).abs() <= 1e-9, "{} {}", over(least_w), over(1.0));
            } else {
                prop_assert!((over(least_w) - 1.0).abs() <= 1e-12 && (over(1.0) - 1.0).abs() <= 1e-12);
            }
        }
    }
}
