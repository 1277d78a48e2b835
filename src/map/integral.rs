//! Integrals over bodies of functions that vary with the distances from the eye and from the light.
//!
//! A body is cut into simplices, those into smaller ones until distances vary little over each, and a rule of degree five
//! does the rest.

use crate::convex::{ConvexBody, Plane};
use crate::input::view::{Lens, View};
use crate::math::bounds::{least, most};
use glam::{DVec2, DVec3};

/// A point, segment, triangle or tetrahedron, by its 1 to 4 corners; those past them are not looked at.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Simplex {
    corners: [DVec3; 4],
    dimension: usize,
}

impl Simplex {
    /// The triangle with these corners.
    pub(crate) const fn triangle([a, b, c]: [DVec3; 3]) -> Self {
        Self { corners: [a, b, c, DVec3::ZERO], dimension: 2 }
    }

    /// Length, area or volume; 1 for a point.
    fn measure(&self) -> f64 {
        let [a, b, c, d] = self.corners;
        match self.dimension {
            0 => 1.0,
            1 => (b - a).length(),
            2 => 0.5 * (b - a).cross(c - a).length(),
            _ => (b - a).cross(c - a).dot(d - a).abs() / 6.0,
        }
    }

    /// The point with these barycentric coordinates.
    fn at(&self, parts: &[f64; 4]) -> DVec3 {
        let used = self.corners.iter().zip(parts).take(self.dimension + 1);
        used.map(|(&corner, &part)| corner * part).sum()
    }

    /// The integral of a function by the rule of degree 5.
    fn by_rule(&self, mut function: impl FnMut(DVec3) -> f64) -> f64 {
        let rule = RULES[self.dimension];
        let mean: f64 = rule.iter().map(|(parts, weight)| weight * function(self.at(parts))).sum();
        mean * self.measure()
    }

    /// An upper estimate of the integral: the function's largest value at a corner, times the measure.
    fn at_most(&self, function: impl FnMut(DVec3) -> f64) -> f64 {
        let corners = self.corners.iter().copied().take(self.dimension + 1);
        corners.map(function).fold(0.0, most) * self.measure()
    }

    /// The cut through the middle of the longest edge.
    fn middle(&self) -> Cut {
        let (mut edge, mut longest) = ((0, 0), 0.0);
        for j in 1..=self.dimension {
            for i in 0..j {
                let length = self.corners[i].distance_squared(self.corners[j]);
                if length > longest {
                    (edge, longest) = ((i, j), length);
                }
            }
        }
        Cut { edge, part: 0.5 }
    }

    /// The two parts that a point of the edge between two corners cuts it into.
    fn cut(&self, Cut { edge: (i, j), part }: Cut) -> [Self; 2] {
        let between = self.corners[i].lerp(self.corners[j], part);
        let with = |slot: usize| {
            let mut corners = self.corners;
            corners[slot] = between;
            Self { corners, ..*self }
        };
        [with(j), with(i)]
    }
}

/// Where to cut an edge.
struct Cut {
    edge: (usize, usize),
    /// Which part of the way from the first corner to the second.
    part: f64,
}

/// The most that distances may vary by over one simplex.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fineness {
    /// The largest ratio of depths before the eye.
    pub(crate) depths: f64,
    /// The longest edge, in distances of the edge from the light.
    pub(crate) angle: f64,
    /// The difference between the rule over a simplex and that over its halves, relative; infinite for smooth functions.
    pub(crate) error: f64,
}

impl Fineness {
    /// For smooth functions that go with 1/depth², to one part in a hundred thousand.
    ///
    /// The function 1/x on [1, 3/2] is analytic within an ellipse whose axes sum to 9.9 times its half length, so that
    /// polynomials of degree 5 come within 9.9⁻⁶ or so of it, one part in a million; on [1, 2] it is 5.8⁻⁶, one in forty
    /// thousand.
    pub(crate) const FINE: Self = Self { depths: 1.5, angle: 1.0, error: f64::INFINITY };
    /// For functions with edges, as the longer of two lengths has, to one part in a thousand.
    pub(crate) const CHECKED: Self = Self { depths: 3.0, angle: 1.5, error: 1.0 / 2048.0 };
}

/// How finely a body is cut.
pub(crate) struct Grading {
    /// The linear function that a pixel's side is a multiple of.
    unit: Plane,
    /// The least unit; rounding alone brings it below that.
    least_unit: f64,
    perspective: bool,
    light: Option<DVec3>,
    /// The size of the body.
    size: f64,
    fineness: Fineness,
}

impl Grading {
    /// The part of the whole that is not worth cutting.
    const NEGLIGIBLE: f64 = 1.0 / 1_048_576.0;
    /// The error of one simplex, of the whole, that is small enough whatever it is of its own.
    const UNSEEN: f64 = 1.0 / 131_072.0;
    /// How near to the light that matters, in sizes of the body and in depths before the eye. Nearer parts are a
    /// 65,536th part, or less, of an area that counts as one.
    const NEXT_TO_LIGHT: f64 = 1.0 / 256.0;

    pub(crate) fn new(view: &View, light: Option<DVec3>, size: f64, fineness: Fineness) -> Self {
        let perspective = view.lens() == Lens::Perspective;
        let (unit, least_unit) = if perspective { (view.depth_row(), view.near()) } else { (Plane::ONE, 1.0) };
        Self { unit, least_unit, perspective, light, size, fineness }
    }

    /// Where to cut a simplex, unless it is small enough.
    fn cut(&self, simplex: &Simplex) -> Option<Cut> {
        let (mut found, mut excess) = (None, 1.0);
        let units = simplex.corners.map(|corner| self.unit_at(corner));
        for j in 1..=simplex.dimension {
            for i in 0..j {
                let ratio = most(units[i], units[j]) / (least(units[i], units[j]) * self.fineness.depths);
                if ratio > excess {
                    // Both halves have the same ratio.
                    let [a, b] = DVec2::new(units[i], units[j]).sqrt().to_array();
                    (found, excess) = (Some(Cut { edge: (i, j), part: a / (a + b) }), ratio);
                }
                let angle = self.angle(simplex.corners[i], simplex.corners[j], least(units[i], units[j]));
                if angle > excess {
                    (found, excess) = (Some(Cut { edge: (i, j), part: 0.5 }), angle);
                }
            }
        }
        found
    }

    /// The unit of a pixel's side at a point.
    fn unit_at(&self, point: DVec3) -> f64 {
        most(self.unit.at(point), self.least_unit)
    }

    /// The length of an edge over its limit for the light.
    fn angle(&self, a: DVec3, b: DVec3, unit: f64) -> f64 {
        let Some(position) = self.light else { return 0.0 };
        let edge = b - a;
        let squared = edge.length_squared();
        let part = if squared > 0.0 { ((position - a).dot(edge) / squared).clamp(0.0, 1.0) } else { 0.0 };
        let distance = (a + edge * part).distance(position);
        let matters = if self.perspective { least(self.size, unit) } else { self.size };
        DVec2::splat(squared).sqrt().x / (self.fineness.angle * most(distance, matters * Self::NEXT_TO_LIGHT))
    }

    /// The integral of a function over a simplex, of a body over which it is about `whole`.
    pub(crate) fn integral(&self, simplex: Simplex, whole: f64, mut function: impl FnMut(DVec3) -> f64) -> f64 {
        /// Parts that may wait: one for each time that a part has been halved. Were there more, they would be taken as they
        /// are.
        const WAITING: usize = 64;
        /// Cuts at most: where coordinates are so large that rounding alone makes halves differ there would be no end.
        const CUTS: u32 = 1 << 12;
        let mut waiting = [simplex; WAITING];
        let (mut len, mut sum, mut left) = (1, 0.0, CUTS);
        while len > 0 {
            len -= 1;
            let part = waiting[len];
            let halves = match self.cut(&part) {
                Some(cut) if part.at_most(&mut function) > Self::NEGLIGIBLE * whole => part.cut(cut),
                // A point has no halves.
                None if part.dimension > 0 && self.fineness.error < f64::INFINITY => {
                    let (value, halves) = (part.by_rule(&mut function), part.cut(part.middle()));
                    let by_halves = halves[0].by_rule(&mut function) + halves[1].by_rule(&mut function);
                    // It is NaN where both are infinite: part of it is outside of the map.
                    if (by_halves - value).abs() > most(self.fineness.error * value, Self::UNSEEN * whole) {
                        halves
                    } else {
                        sum += by_halves;
                        continue;
                    }
                }
                _ => {
                    sum += part.by_rule(&mut function);
                    continue;
                }
            };
            if left > 0 && len + 2 <= WAITING {
                left -= 1;
                waiting[len..len + 2].copy_from_slice(&halves);
                len += 2;
            } else {
                sum += part.by_rule(&mut function);
            }
        }
        sum
    }
}

/// The triangles of the faces of a body, each face a fan; counter-clockwise as seen from outside.
pub(crate) fn triangles(body: &ConvexBody) -> impl Iterator<Item = [DVec3; 3]> + '_ {
    body.faces().flat_map(|face| {
        let mut order = [0; crate::convex::Polyhedron::MAX_VERTICES];
        let mut len = 0;
        for (slot, index) in order.iter_mut().zip(face.indices()) {
            (*slot, len) = (index, len + 1);
        }
        let vertices = body.vertices();
        (2..len).map(move |at| [order[0], order[at - 1], order[at]].map(|index| vertices[index]))
    })
}

/// The dimension of a body, with what rounding alone makes of a flat one or of a segment counted as nothing.
pub(crate) fn dimension(body: &ConvexBody) -> usize {
    /// A thickness this small, against the largest coordinate, may be rounding.
    const ROUNDING: f64 = 1024.0 * f64::EPSILON;
    let Some((min, max)) = body.bounds() else { return 0 };
    let size = (max - min).length();
    let thickness = ROUNDING * most(min.abs().max_element(), max.abs().max_element());
    let area: f64 = triangles(body).map(|corners| Simplex::triangle(corners).measure()).sum();
    if body.volume() > thickness * area {
        3
    } else if area > thickness * size {
        2
    } else {
        usize::from(size > thickness)
    }
}

/// The simplices of so many dimensions that a body is made of: all of it, its faces, its length or a point of it.
pub(crate) fn for_each_simplex(body: &ConvexBody, dimension: usize, mut each: impl FnMut(Simplex)) {
    let vertices = body.vertices();
    let Some(&first) = vertices.first() else { return };
    let farthest = |from: DVec3| {
        let farther = |a: DVec3, &b: &DVec3| if b.distance(from) > a.distance(from) { b } else { a };
        vertices.iter().fold(from, farther)
    };
    // A measure of zero times infinity, outside of the map, would be NaN.
    let mut some = |simplex: Simplex| {
        if simplex.measure() > 0.0 {
            each(simplex);
        }
    };
    match dimension {
        3 => triangles(body)
            .filter(|corners| !corners.contains(&first))
            .for_each(|[a, b, c]| some(Simplex { corners: [first, a, b, c], dimension })),
        2 => triangles(body).for_each(|corners| some(Simplex::triangle(corners))),
        _ => {
            let one = farthest(first);
            some(Simplex { corners: [one, farthest(one), one, one], dimension });
        }
    }
}

/// The integral of a function over all of a body in so many dimensions, and that of 1.
pub(crate) fn over(
    body: &ConvexBody,
    dimension: usize,
    grading: &Grading,
    mut function: impl FnMut(DVec3) -> f64,
) -> (f64, f64) {
    let (mut whole, mut integral, mut measure) = (0.0, 0.0, 0.0);
    for_each_simplex(body, dimension, |simplex| whole += simplex.by_rule(&mut function));
    for_each_simplex(body, dimension, |simplex| {
        integral += grading.integral(simplex, whole, &mut function);
        measure += simplex.measure();
    });
    (integral, measure)
}

/// Points in barycentric coordinates, and weights that sum to 1.
type Rule = &'static [([f64; 4], f64)];

/// Rules of degree 5, by dimension: Gauss, Radon (1948), Walkington (2000).
const RULES: [Rule; 4] = [&[([1.0, 0.0, 0.0, 0.0], 1.0)], &GAUSS, &RADON, &WALKINGTON];

const GAUSS: [([f64; 4], f64); 3] = {
    // (1 ± √(3/5))/2.
    const A: f64 = 0.887_298_334_620_741_7;
    const B: f64 = 0.112_701_665_379_258_31;
    [([A, B, 0.0, 0.0], 5.0 / 18.0), ([0.5, 0.5, 0.0, 0.0], 4.0 / 9.0), ([B, A, 0.0, 0.0], 5.0 / 18.0)]
};

const RADON: [([f64; 4], f64); 7] = {
    // (6 ∓ √15)/21 and (155 ∓ √15)/1200.
    const A: f64 = 0.101_286_507_323_456_34;
    const B: f64 = 0.470_142_064_105_115_1;
    const AT_A: f64 = 0.125_939_180_544_827_14;
    const AT_B: f64 = 0.132_394_152_788_506_2;
    const THIRD: f64 = 1.0 / 3.0;
    const FAR_A: f64 = 1.0 - 2.0 * A;
    const FAR_B: f64 = 1.0 - 2.0 * B;
    [
        ([THIRD, THIRD, THIRD, 0.0], 0.225),
        ([FAR_A, A, A, 0.0], AT_A),
        ([A, FAR_A, A, 0.0], AT_A),
        ([A, A, FAR_A, 0.0], AT_A),
        ([FAR_B, B, B, 0.0], AT_B),
        ([B, FAR_B, B, 0.0], AT_B),
        ([B, B, FAR_B, 0.0], AT_B),
    ]
};

const WALKINGTON: [([f64; 4], f64); 14] = {
    const A: f64 = 0.310_885_919_263_300_6;
    const B: f64 = 0.092_735_250_310_891_23;
    const C: f64 = 0.045_503_704_125_649_65;
    const AT_A: f64 = 0.112_687_925_718_015_85;
    const AT_B: f64 = 0.073_493_043_116_361_95;
    const AT_C: f64 = 0.042_546_020_777_081_466;
    const FAR_A: f64 = 1.0 - 3.0 * A;
    const FAR_B: f64 = 1.0 - 3.0 * B;
    const D: f64 = 0.5 - C;
    [
        ([FAR_A, A, A, A], AT_A),
        ([A, FAR_A, A, A], AT_A),
        ([A, A, FAR_A, A], AT_A),
        ([A, A, A, FAR_A], AT_A),
        ([FAR_B, B, B, B], AT_B),
        ([B, FAR_B, B, B], AT_B),
        ([B, B, FAR_B, B], AT_B),
        ([B, B, B, FAR_B], AT_B),
        ([C, C, D, D], AT_C),
        ([C, D, C, D], AT_C),
        ([C, D, D, C], AT_C),
        ([D, C, C, D], AT_C),
        ([D, C, D, C], AT_C),
        ([D, D, C, C], AT_C),
    ]
};

#[cfg(test)]
mod tests {
    use super::*;

    /// Barycentric monomials have the mean (∏ kᵢ!) n!/(n + Σ kᵢ)! over a simplex of n dimensions.
    #[test]
    fn rules_are_of_degree_five() {
        let factorial = |n: usize| (1..=n).map(|k| k as f64).product::<f64>();
        for (dimension, rule) in RULES.iter().enumerate() {
            for code in 0..6_usize.pow(4) {
                let powers = [code % 6, code / 6 % 6, code / 36 % 6, code / 216];
                let degree: usize = powers.iter().sum();
                if degree > 5 || powers[dimension + 1..].iter().any(|&power| power > 0) {
                    continue;
                }
                let top: f64 = powers.iter().map(|&power| factorial(power)).product();
                let exact = top * factorial(dimension) / factorial(dimension + degree);
                let power = |(part, &times): (&f64, &usize)| (0..times).map(|_| *part).product::<f64>();
                let value = |parts: &[f64; 4]| parts.iter().zip(&powers).map(power).product::<f64>();
                let found: f64 = rule.iter().map(|(parts, weight)| weight * value(parts)).sum();
                // The constants are rounded to f64, and so are the sums of at most 14 terms of 1 or less.
                assert!((found - exact).abs() < 32.0 * f64::EPSILON, "{dimension}, {powers:?}: {found}, {exact}");
            }
        }
    }
}
