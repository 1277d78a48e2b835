//! The exact focus body, and how far a computed one is from it.

use std::cmp::Ordering;

use dashu_ratio::RBig;
use shadowfit::glam::DVec3;

use super::cases::Case;
use testkit::oracle::body::Body;
use testkit::oracle::cone::generators;
use testkit::oracle::exact::sqrt_ratio;
use testkit::oracle::homogeneous::{ExactPlane, ExactPoint, Homogeneous};
use testkit::oracle::hull::hull;

/// The exact body of a case, by the oracle.
pub(crate) struct Truth {
    body: Body,
    /// What distances are measured in.
    size: f64,
}

/// How far a computed body is from the exact one, in parts of the scene's size.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Errors {
    /// The farthest that a vertex of the exact body is outside of a face of the hull of the computed vertices; zero only where
    /// nothing is, not by any amount. At most 1, which is all: also of a body that is computed as empty and is not.
    pub(crate) lost: f64,
    /// The farthest that a computed vertex is from the exact body or, where that is empty, from one of its half-spaces.
    pub(crate) gained: f64,
    /// Whether it was computed as empty, and is not.
    pub(crate) emptied: bool,
    /// Whether it is no body: a vertex that is not finite, or a surface that is not closed.
    pub(crate) failed: bool,
}

impl Errors {
    /// Of what is no body: all is lost, whatever there was.
    pub(crate) const FAILED: Self = Self { lost: 1.0, gained: 0.0, emptied: false, failed: true };
}

impl Truth {
    pub(crate) fn new(case: &Case) -> Self {
        let row = |plane: &shadowfit::focus::Plane| plane.to_row().to_array();
        let mut rows: Vec<[f64; 4]> = Vec::new();
        for (axis, normal) in DVec3::AXES.into_iter().enumerate() {
            rows.push(normal.extend(-case.min[axis]).to_array());
            rows.push((-normal).extend(case.max[axis]).to_array());
        }
        rows.extend(case.cuts.iter().map(row));
        rows.extend(case.light.planes().iter().map(row));
        let mut planes: Vec<ExactPlane> = rows.into_iter().map(Homogeneous::from_f64).collect();
        let view: Vec<[f64; 4]> = case.view.planes().iter().map(row).collect();
        planes.extend(hull(&view, case.light.homogeneous().to_array()));
        Self { body: Body::from_exact_planes(planes), size: case.size() }
    }

    /// Of the hull of some vertices.
    pub(crate) fn errors(&self, vertices: &[[f64; 3]]) -> Errors {
        if vertices.iter().flatten().any(|x| !x.is_finite()) {
            return Errors::FAILED;
        }
        if vertices.is_empty() {
            let emptied = !self.body.is_empty();
            return Errors { lost: f64::from(u8::from(emptied)), emptied, ..Errors::default() };
        }
        let mut points: Vec<[f64; 3]> = Vec::new();
        for vertex in vertices {
            if !points.contains(vertex) {
                points.push(*vertex);
            }
        }
        let exact: Vec<ExactPoint> = points.iter().copied().map(Homogeneous::from_position).collect();
        if self.body.is_empty() {
            return Errors { gained: farthest_outside(&self.body.planes, &exact) / self.size, ..Errors::default() };
        }
        let has_normal = |plane: &ExactPlane| plane.xyz().iter().any(|component| !component.is_zero());
        let facets: Vec<ExactPlane> =
            generators(&exact).into_iter().map(|ray| ray.vector).filter(has_normal).collect();
        let corners: Vec<ExactPoint> = self.body.vertices.iter().map(|vertex| vertex.point.clone()).collect();
        let lost = (farthest_outside(&facets, &corners) / self.size).min(1.0);
        let distances = points.iter().map(|point| self.body.distance(*point));
        Errors { lost, gained: distances.fold(0.0, f64::max) / self.size, ..Errors::default() }
    }

    /// Whether exact vertices are those of the body, all of them and no others.
    pub(crate) fn has_vertices(&self, vertices: &[[RBig; 3]]) -> bool {
        let found: Vec<ExactPoint> = vertices.iter().map(homogeneous).collect();
        let known = |point: &ExactPoint| self.body.vertices.iter().any(|vertex| same(&vertex.point, point));
        // Cuts through edges that pass through one point leave vertices between those of the body, on its edges and faces.
        let all = self.body.vertices.iter().all(|vertex| found.iter().any(|point| same(point, &vertex.point)));
        all && found.iter().all(|point| known(point) || self.body.contains_exact(point))
    }
}

/// The farthest that any point is outside of any of some half-spaces.
fn farthest_outside(planes: &[ExactPlane], points: &[ExactPoint]) -> f64 {
    let outside = |plane: &ExactPlane, point: &ExactPoint| {
        if plane.side(point) != Ordering::Less {
            return 0.0;
        }
        let [x, y, z] = plane.xyz().map(|component| component.sqr());
        sqrt_ratio(plane.dot(point).sqr(), point.w().sqr() * (x + y + z))
    };
    planes.iter().flat_map(|plane| points.iter().map(move |point| outside(plane, point))).fold(0.0, f64::max)
}

/// A position over one denominator.
fn homogeneous([x, y, z]: &[RBig; 3]) -> ExactPoint {
    let [a, b, c] = [x, y, z].map(|x| x.denominator().clone());
    let coords = [x.numerator() * &b * &c, y.numerator() * &a * &c, z.numerator() * &a * &b, (a * b * c).into()];
    Homogeneous::new(coords).reduced()
}

/// Whether two points without common divisors are one.
fn same(a: &ExactPoint, b: &ExactPoint) -> bool {
    a.coords() == b.coords()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arithmetic::bodies::vertices;
    use crate::arithmetic::cases::{hard, random};

    #[test]
    fn rationals_make_the_oracles_body() {
        let cases = random(6).into_iter().chain(hard(60));
        let mut solid = 0;
        for (index, case) in cases.enumerate() {
            let found = vertices::<RBig>(&case, false).expect("an exact body is closed");
            assert!(Truth::new(&case).has_vertices(&found), "{index}");
            solid += usize::from(found.len() >= 4);
        }
        assert!(solid > 20, "{solid} solid bodies");
    }

    #[test]
    fn losses_and_gains_are_distances() {
        let side = |corner: u32, bit: u32, size: f64| if corner >> bit & 1 == 0 { 0.0 } else { size };
        let corner = |corner| [side(corner, 0, 4.0), side(corner, 1, 2.0), side(corner, 2, 8.0)];
        let corners: Vec<[f64; 3]> = (0..8).map(corner).collect();
        let points: Vec<ExactPoint> = corners.iter().copied().map(Homogeneous::from_position).collect();
        let facets: Vec<ExactPlane> = generators(&points).into_iter().map(|ray| ray.vector).collect();
        let truth = Truth { body: Body::from_exact_planes(facets), size: 10.0 };
        assert_eq!(truth.errors(&corners), Errors::default());

        // A side moved by one, and by the least there is.
        let moved = |to: f64| -> Vec<[f64; 3]> {
            corners.iter().map(|&[x, y, z]| [if x == 4.0 { to } else { x }, y, z]).collect()
        };
        let close = |found: f64, expected: f64| (found - expected).abs() < 1e-15;
        let smaller = truth.errors(&moved(3.0));
        assert!(close(smaller.lost, 0.1) && smaller.gained == 0.0, "{smaller:?}");
        let larger = truth.errors(&moved(5.0));
        assert!(close(larger.gained, 0.1) && larger.lost == 0.0, "{larger:?}");
        let least = truth.errors(&moved(4.0_f64.next_down()));
        assert!(least.lost > 0.0 && least.lost < 1e-14, "{least:?}");

        assert_eq!(truth.errors(&[]), Errors { lost: 1.0, emptied: true, ..Errors::default() });
        assert_eq!(truth.errors(&[[f64::NAN, 0.0, 0.0]]), Errors::FAILED);
    }
}
