//! f32 rounding: how far it can move a point in clip space, and the padding that covers it (`docs/numerics.md`).

use crate::convex::Plane;
use crate::math::bounds::{self, Interval, Rectangle, least, most};
use crate::warp::homography::Homography;
use crate::warp::rays::Rays;
use glam::{DMat4, DVec2, DVec3, DVec4};

/// Rounding of a row of an f32 matrix at a point, relative to the sum of the magnitudes of its four terms.
///
/// A clip coordinate is a sum of four products in f32. Coordinate and entry are rounded once each, the product once, the sum three
/// times: an error of at most 6 · 2⁻²⁴ of the sum of magnitudes. Eight leave room for second-order terms and for a row that is the
/// sum of two (depth −1 to 1).
pub(crate) const UNITS: f64 = 8.0 / 16_777_216.0;

/// Points closer to a local light than this part of the farthest receiver's axial distance count as beside the light: there the
/// bias covers depth error only, not errors of place ([`DepthBias`](crate::depth::DepthBias)).
pub(crate) const AWAY_FROM_LIGHT: f64 = 1.0 / 16.0;

/// The rounding in f64, for the dozen or two operations between an input point and a row of the matrix.
const UNITS_F64: f64 = 32.0 * f64::EPSILON;

/// Rounding of a row of an f32 matrix over points within `extent` of `origin` on each axis, with positions relative to `origin`.
pub(crate) fn of_row(row: &Plane, origin: DVec3, extent: DVec3) -> f64 {
    UNITS * (row.normal.abs().dot(extent) + row.at(origin).abs())
}

/// Rounding of the rows a, b, e and c of a homography, relative to c, over the receiver volume and the caster volume.
///
/// With M the sum of magnitudes, a row is off by at most M/c. M is convex and c linear, which gives two bounds from the vertices of
/// a body:
///
/// ```text
///     M(X)/c(X) ≤ max M / c(X)         M(X)/c(X) ≤ max (M/c)
/// ```
///
/// The first is tighter where M is constant and c varies, as next to a local light; the second where M grows with c, as it may in a
/// warp about the eye.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rounding {
    /// Magnitudes of the rows about the origin, as the columns of a matrix.
    magnitudes: DMat4,
    origin: DVec3,
    /// The least and the largest c of receivers beyond the light's near distance.
    c: Interval,
    /// The least c of receivers not beside a local light.
    away: f64,
    /// The factors by which ratios at the vertices may be too small, see [`Self::include_visible`], for c ≥ `c` and c ≥ `away`.
    cut: [f64; 2],
    visible: Visible,
    /// The largest M/c of casters.
    casting: Rows,
    /// Whether the light is local, so that casters may come close to it.
    local: bool,
}

/// A number for each of the rows a, b, e and c.
#[derive(Clone, Copy, Debug, Default)]
struct Rows {
    across: DVec2,
    depth: f64,
    w: f64,
}

/// The largest M and M/c of receivers, and the largest M/c of those not beside a local light.
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

    /// The padding at each end of a depth range: twice the rounding of z and of w.
    fn padding(&self, range: &Interval) -> f64 {
        2.0 * (self.of_depth(range) + (range.max - range.min) * self.w)
    }

    /// Rounding of positions across a window, whose rows are a and b less the centre times c.
    fn of_window(&self, window: &Rectangle) -> DVec2 {
        self.across + window.centre.abs() * self.w
    }

    /// Rounding of depth after the division, relative to the range: that of z, and that of w times z/w ≤ 1.
    fn in_depth(&self, range: &Interval) -> f64 {
        self.of_depth(range) / (range.max - range.min) + self.w
    }

    /// Rounding of texture coordinates, across and down, relative to the window. w counts once in the row, which is half the sum of
    /// w and another row, and twice in the division: |x/w| ≤ 1, and texture coordinates are half as large.
    fn in_window(&self, window: &Rectangle) -> DVec2 {
        self.of_window(window) / window.half + 3.0 * self.w
    }
}

/// A bound on f32 noise at a point of a map with w ≤ 1: the smaller of `over_w`/w and `most`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Noise {
    pub(crate) over_w: f64,
    pub(crate) most: f64,
}

impl Noise {
    /// The bound at a given w; infinite outside of the map.
    pub(crate) fn at(&self, w: f64) -> f64 {
        if w > 0.0 { least(self.over_w / w, self.most) } else { f64::INFINITY }
    }

    /// Numbers p and q with p/w + q no less than the noise anywhere: a line in 1/w through the corner of the two bounds at w =
    /// `over_w`/`most`. Its slope makes it too large by the same factor at both ends, `least_w` and 1; with the corner at an end it is
    /// exact.
    pub(crate) fn parts(&self, least_w: f64) -> (f64, f64) {
        let corner = (self.over_w / self.most).max(least_w).min(1.0);
        let (far, near) = (corner.recip() - 1.0, corner / least_w - 1.0);
        let constant = if far + near > 0.0 { near / (far + near) } else { 1.0 };
        ((1.0 - constant) * self.over_w, constant * self.most)
    }
}

/// Padding for receivers beside a local light, at most this part of the window: most often they are air.
const MOST_BESIDE_LIGHT: f64 = 1.0 / 64.0;

/// Padding for casters of a local light, at most this part of the window: a caster next to the light has few bits, and the map is
/// for the receivers.
const MOST_FOR_LOCAL_CASTERS: f64 = 1.0 / 1024.0;

/// The least length of a depth range, in multiples of its rounding where c is largest. The receivers of a flat scene under light from
/// straight above have one depth: a range fitted to them alone would hold nothing but noise, and be shadow acne all over. This
/// makes the noise 16 steps of 24 bits, or a 16th of a step of 16 bits, besides the rounding of w; no range becomes longer than
/// about the size of the coordinates.
///
/// Elsewhere noise grows with 1/w, and bias and padding with it. The range is not measured where c is least: R of a local light in
/// view begins in the air at its near distance, where noise is hundreds of times larger than at any receiver, and a range so much
/// longer is only coarser.
pub(crate) const QUIET: f64 = 1_048_576.0;

impl Rounding {
    /// Without points yet. Positions are relative to `origin`; `c` is the range of c over R, `least_c` its bound beyond the light's near
    /// distance, `away_c` its bound for points not beside a local light.
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
        // Moving the matrix to a far origin cancels terms in f64, a loss that f32 magnitudes do not show.
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

    /// Includes a vertex of R, with c there.
    ///
    /// Vertices within the light's near distance need no precision, but points beyond it lie between them and others. With Q the
    /// largest M/max(c, c₀) at the vertices, and X = Σ μV a point with c(X) = c₀, the least c that counts,
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

    /// Includes a vertex of the caster volume, with c there.
    #[inline]
    pub(crate) fn include_casting(&mut self, point: DVec3, c: f64) {
        self.casting.include(self.at(point) * c.recip());
    }

    /// The bound on rounding over R, relative to c.
    fn visible(&self) -> Rows {
        self.visible.ratio.times(self.cut[0]).min(&self.visible.magnitude.times(self.c.min.recip()))
    }

    /// The bound for receivers not beside a local light.
    fn away(&self) -> Rows {
        self.visible.ratio_away.times(self.cut[1]).min(&self.visible.magnitude.times(self.away.recip()))
    }

    /// Half extents of a window that holds `window` after rounding, within the `inner` part of a map of `sides` texels: no smaller than
    /// `least` and, under a directional light, with texels no smaller than the rounding.
    pub(crate) fn padded_window(&self, window: &Rectangle, inner: DVec2, sides: DVec2, least: f64) -> DVec2 {
        let away = self.away();
        let (mut beside, mut casting) = (self.visible(), self.casting);
        let of_away = away.of_window(window);
        let (mut of_beside, mut of_casting) = (beside.of_window(window), casting.of_window(window));
        if self.local {
            of_beside = of_beside.min(window.half * MOST_BESIDE_LIGHT);
            beside.w = beside.w.min(MOST_BESIDE_LIGHT);
            of_casting = of_casting.min(window.half * MOST_FOR_LOCAL_CASTERS);
            casting.w = casting.w.min(MOST_FOR_LOCAL_CASTERS);
        }
        let w = away.w.max(beside.w).max(casting.w).min(0.5);
        let padded = (window.half + of_away.max(of_beside).max(of_casting)) / ((1.0 - w) * inner);
        // Next to a local light rounding is large against coordinates; it must not coarsen all of the map.
        let of_texels = if self.local { DVec2::ZERO } else { of_away * (0.5 * sides) };
        padded.max(of_texels).max(DVec2::splat(least))
    }

    /// The largest depth, after rounding, of a caster point with depth e/c, in a range before padding.
    ///
    /// (e + M)/c of a body is largest at a vertex, as M/c is. M/c of the receivers does not suffice: on a plane that a local light
    /// grazes casters are as deep as receivers, and may be much farther from the origin.
    #[inline]
    pub(crate) fn deepest(&self, point: DVec3, e: f64, c: f64, range: &Interval) -> f64 {
        let mut rows = Rows::default();
        rows.include(self.at(point) * c.recip());
        e / c + rows.padding(range)
    }

    /// A depth range that holds `depth` after rounding and casters down to `deepest`: no shorter than `least`, and than a million
    /// times the rounding over R where c is largest.
    pub(crate) fn padded_depth(&self, depth: &Interval, deepest: f64, least: f64) -> Interval {
        let length = depth.max - depth.min;
        let far = self.visible().padding(depth);
        // Casters next to a light may at most double the range.
        let near = far.max(self.casting.padding(depth).min(length));
        let far = far.max((deepest - depth.max).min(length));
        // Of the row e − min c, only the part that shrinks against a longer range: the rest is at most the rounding of w, as the ends
        // are no farther apart than the range is long. Hyperbolic depth begins far below 0 and ends next to it.
        let Rows { depth: e, w, .. } = self.visible.magnitude;
        let quietest = (e + bounds::least(depth.min.abs(), depth.max.abs()) * w) / self.c.max;
        let shortest = least.max(QUIET * quietest);
        let missing = 0.5 * (shortest - (length + near + far)).max(0.0);
        Interval { min: depth.min - near - missing, max: depth.max + far + missing }
    }

    /// The rounding of a map whose w is 1 where c is `largest`, at least the largest c of R.
    pub(crate) fn scaled_to(self, largest: f64) -> Self {
        Self { c: Interval { max: largest, ..self.c }, ..self }
    }

    /// The noise of a map of `sides` texels, with −e·l = `to_light`.
    pub(crate) fn in_map(
        &self,
        map: &Homography,
        window: &Rectangle,
        depth: &Interval,
        sides: DVec2,
        to_light: f64,
    ) -> MapNoise {
        // Where f32 loses half of w or more, a place is undetermined.
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

/// f32 noise of receivers in a map whose largest w is 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct MapNoise {
    /// Noise of depth, for a range of 1.
    pub(crate) depth: Noise,
    /// Noise of places, in texels across or down, read by texture coordinates.
    pub(crate) place: Noise,
    /// The least w beyond the light's near distance.
    pub(crate) least_w: f64,
    /// The least w of points not beside a local light.
    pub(crate) away_w: f64,
    /// −z·l > 0, with z the row of depth: the decrease of depth, where w is 1, by a
    /// [`ReceiverOffset::relative`](crate::depth::ReceiverOffset::relative) of 1. Far from the origin the matrix itself may have lost it.
    pub(crate) to_light: f64,
    /// The change of 1/w on a plane from a texel to the next, across and down together, without the part 1/−z·l times the change of
    /// depth under a local light.
    ///
    /// With D the point on a ray, on the chart, where c is 1, a point X = l + t D has c·X = t and
    ///
    /// ```text
    ///     e·X/c·X = e·l/c·X + e·D         1/c·X = (e·D − z)/(−e·l)         for a local light,
    ///     1/c·X = w(D)                                                     for a directional one, X = (D + t l)/w(D),
    /// ```
    ///
    /// with w(D), equal to e·D for a local light, linear in the place in the map and the same for all planes.
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
