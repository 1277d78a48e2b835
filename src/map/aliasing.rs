//! The worst and the mean aliasing of a map over all receivers.

use crate::convex::{ConvexBody, Plane, Polyhedron};
use crate::focus::Focus;
use crate::input::scene::{Aabb, Region};
use crate::map::integral::{Fineness, Grading, dimension, over, triangles};
use crate::map::shadow_map::ShadowMap;
use crate::math::bounds::most;
use glam::{DVec2, DVec3};

/// Aliasing of a map over all receivers or some of them ([`ShadowMap::aliasing_over`]); infinite where part of them lies
/// outside of the map.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Aliasing {
    /// The worst that was found, at [`Self::worst_at`].
    #[cfg_attr(feature = "serde", serde(with = "crate::math::infinity"))]
    pub worst: f64,
    /// Where the worst was found, in world space.
    pub worst_at: DVec3,
    /// Upper bound on the aliasing anywhere in R: 1 + 2⁻¹⁰ times the worst. Where that would take too long, as over a
    /// floor that has much the same aliasing all over, 1 + 2⁻⁴ times it or more.
    #[cfg_attr(feature = "serde", serde(with = "crate::math::infinity"))]
    pub upper_bound: f64,
    /// The mean over the volume of R, over the area of a flat R, or over the surfaces of listed receivers.
    #[cfg_attr(feature = "serde", serde(with = "crate::math::infinity"))]
    pub mean: f64,
}

impl ShadowMap {
    /// The worst aliasing anywhere in R, and the mean over its volume (over the area of a flat R, the length of a segment).
    /// `None` without receivers.
    ///
    /// `focus` is the one that the map was fitted from, or one of the same light whose R is a part of it: of a view that is
    /// [narrowed](crate::View::narrowed) to what a depth read-back found, say.
    ///
    /// ```
    #[doc = include_str!("../examples/sun.txt")]
    /// let aliasing = map.aliasing_over(&focus).expect("receivers");
    /// assert!(aliasing.mean < aliasing.worst && aliasing.worst <= aliasing.upper_bound);
    /// let there = map.aliasing(aliasing.worst_at).expect("in the map");
    /// assert!((there / aliasing.worst - 1.0).abs() < 1e-6);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    ///
    /// The worst need not be at a vertex of R, so R is searched; `docs/design.md` has the bound that the search relies
    /// on. The mean is by quadrature, with a relative error below 1e-3. All of this takes a thousand times as long as a
    /// fit, nearly all of it for the mean, and allocates nothing.
    #[must_use]
    pub fn aliasing_over(&self, focus: &Focus<'_>) -> Option<Aliasing> {
        let visible = focus.visible_beyond_light();
        let mut survey = Survey::new(self);
        survey.search(&visible);
        let (integral, measure) = survey.integral(&visible, dimension(&visible), Fineness::CHECKED);
        survey.found(integral / measure)
    }

    /// The same over listed receivers only, the part of each box that is in view and lit. `None` where there is none.
    ///
    /// The mean is over the surfaces of these parts. Boxes that are segments or points count for the worst, and for the
    /// mean, as one each, where there are no others.
    ///
    /// ```
    #[doc = include_str!("../examples/sun.txt")]
    /// use shadowfit::Aabb;
    ///
    /// let crates = [Aabb::new([-1.0, 0.0, -10.0], [1.0, 1.0, -9.0]), Aabb::new([0.0, 0.0, 90.0], [1.0, 1.0, 91.0])];
    /// let of_crates = map.aliasing_over_receivers(&focus, &crates).expect("one is in view");
    /// assert!(of_crates.worst <= map.aliasing_over(&focus).expect("receivers").upper_bound);
    /// assert_eq!(map.aliasing_over_receivers(&focus, &crates[1..]), None);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn aliasing_over_receivers(&self, focus: &Focus<'_>, receivers: &[Aabb]) -> Option<Aliasing> {
        let mut survey = Survey::new(self);
        let (mut integral, mut area, mut sum, mut count) = (0.0, 0.0, 0.0, 0.0);
        for one in receivers {
            let part = focus.visible_part(one);
            if part.is_empty() {
                continue;
            }
            survey.search(&part);
            match dimension(&part) {
                low @ (0 | 1) => {
                    let (integral, length) = survey.integral(&part, low, Fineness::CHECKED);
                    (sum, count) = (sum + integral / length, count + 1.0);
                }
                _ => {
                    let (of_part, area_of_part) = survey.integral(&part, 2, Fineness::CHECKED);
                    (integral, area) = (integral + of_part, area + area_of_part);
                }
            }
        }
        survey.found(if area > 0.0 { integral / area } else { sum / count })
    }
}

impl Focus<'_> {
    /// The part of a box that is in view and lit: V ∩ L ∩ box.
    fn visible_part(&self, part: &Aabb) -> ConvexBody {
        let (mut body, mut planes) = (Polyhedron::EMPTY, [Plane::ONE; Polyhedron::MAX_PLANES]);
        let region = Region::Box { min: part.min.as_dvec3(), max: part.max.as_dvec3() };
        self.cut_visible_part(&mut body, &region, |plane, id| planes[usize::from(id)] = plane);
        ConvexBody::new(&body, planes)
    }
}

/// A point of a body, and the factors of its aliasing.
#[derive(Clone, Copy, Debug)]
struct Corner {
    point: DVec3,
    /// c.
    w: f64,
    /// The columns of M.
    frame: [DVec3; 2],
    /// X − l, or the unit direction of all rays.
    arm: DVec3,
    pixel: f64,
}

/// The search for the worst.
struct Survey<'a> {
    map: &'a ShadowMap,
    worst: f64,
    worst_at: Option<DVec3>,
    upper_bound: f64,
}

/// How far the upper bound may lie above the worst that was found: first a cheap bound, then the wanted one.
const TOLERANCES: [f64; 2] = [1.0 + 1.0 / 16.0, 1.0 + 1.0 / 1024.0];

/// Triangles of a body that are halved at most.
const HALVED: u32 = 1 << 12;

impl<'a> Survey<'a> {
    const fn new(map: &'a ShadowMap) -> Self {
        Self { map, worst: 0.0, worst_at: None, upper_bound: 0.0 }
    }

    /// A corner, which may be the worst so far.
    fn visit(&mut self, point: DVec3) -> Corner {
        let map = self.map;
        let (texel, pixel, w) = (map.footprint(point), pixel(map, point), map.w_at(point));
        let aliasing = texel.map_or(f64::INFINITY, |texel| texel.longest() / pixel);
        if self.worst_at.is_none() || aliasing > self.worst {
            (self.worst, self.worst_at) = (aliasing, Some(point));
        }
        let position = map.light.position();
        let arm = position.map_or(-map.light.homogeneous().truncate(), |position| point - position);
        let sides = texel.map_or([DVec3::ZERO; 2], |texel| [texel.along_x, texel.along_y]);
        Corner { point, w, frame: sides.map(|side| side.cross(arm) / w), arm, pixel }
    }

    /// Searches a body for the worst.
    fn search(&mut self, body: &ConvexBody) {
        // The vertices first: with much found, little is left to search.
        for &point in body.vertices() {
            self.visit(point);
        }
        let mut bounds = f64::INFINITY;
        for tolerance in TOLERANCES {
            let (mut left, mut beyond) = (HALVED, 0.0);
            for triangle in triangles(body) {
                beyond = most(beyond, self.search_triangle(triangle, tolerance, &mut left));
            }
            if let &[a, b] = body.vertices() {
                beyond = most(beyond, self.search_triangle([a, b, b], tolerance, &mut left));
            }
            bounds = bounds.min(most(beyond, self.worst * tolerance));
            if beyond > 0.0 {
                break;
            }
        }
        self.upper_bound = most(self.upper_bound, bounds);
    }

    /// Halves a triangle until there can be no more in it than was found, but for the tolerance. Returns the bound of what
    /// of it was given up.
    fn search_triangle(&mut self, triangle: [DVec3; 3], tolerance: f64, left: &mut u32) -> f64 {
        /// Halves that may wait: one for each time that a triangle has been halved.
        const WAITING: usize = 64;
        let mut waiting = [triangle.map(|point| self.visit(point)); WAITING];
        let (mut len, mut beyond) = (1, 0.0);
        while len > 0 {
            len -= 1;
            let corners = waiting[len];
            let (bound, (i, j)) = bound(&corners);
            if bound <= self.worst * tolerance {
                continue;
            }
            if *left == 0 || len + 2 > WAITING {
                beyond = most(beyond, bound);
                continue;
            }
            *left -= 1;
            // Depths in both halves have the same ratio.
            let [a, b] = DVec2::new(corners[i].pixel, corners[j].pixel).sqrt().to_array();
            let between = self.visit(corners[i].point.lerp(corners[j].point, a / (a + b)));
            for slot in [i, j] {
                let mut half = corners;
                half[slot] = between;
                waiting[len] = half;
                len += 1;
            }
        }
        beyond
    }

    /// The integral of aliasing over a body in so many dimensions, and that of 1.
    fn integral(&self, body: &ConvexBody, dimension: usize, fineness: Fineness) -> (f64, f64) {
        let size = body.bounds().map_or(0.0, |(min, max)| (max - min).length());
        let grading = Grading::new(&self.map.view, self.map.light.position(), size, fineness);
        over(body, dimension, &grading, |point| aliasing(self.map, point))
    }

    fn found(&self, mean: f64) -> Option<Aliasing> {
        let &Self { worst, worst_at, upper_bound, .. } = self;
        worst_at.map(|worst_at| Aliasing { worst, worst_at, upper_bound, mean })
    }
}

/// The aliasing at a point, which may be before the near plane by rounding, where depth may be anything.
fn aliasing(map: &ShadowMap, point: DVec3) -> f64 {
    map.footprint(point).map_or(f64::INFINITY, |texel| texel.longest() / pixel(map, point))
}

/// The side of a pixel there.
fn pixel(map: &ShadowMap, point: DVec3) -> f64 {
    let view = &map.view;
    2.0 * view.half_height(most(view.depth(point), view.near())) / f64::from(map.settings.image_height())
}

/// Upper bound on the aliasing on a triangle, and the edge to halve if that is too much.
///
/// With l the light, c the covector that is w and M(X) the matrix, affine in X, whose largest singular value times c·X/|X
/// − l| is a texel's longest side: on a triangle with corners Xᵢ the square of aliasing is, for each direction t of
/// texels, a fraction of two polynomials of degree four. It is no more than the largest fraction of their Bernstein
/// coefficients, sums with the same weights of
///
/// ```text
///     cᵢ cⱼ (Mₖ t · Mₗ t)      and      pixelᵢ pixelⱼ (Xₖ − l) · (Xₗ − l)
/// ```
fn bound(corners: &[Corner; 3]) -> (f64, (usize, usize)) {
    // The coefficients of both sides of the fraction, each times the same multinomial, by how often the first and the
    // second corner are in them.
    let mut coefficients = [[(0.0, 0.0); 5]; 5];
    for k in 0..3 {
        for l in 0..3 {
            let (a, b) = (&corners[k], &corners[l]);
            let (frame, arms) = (largest_product(&a.frame, &b.frame), a.arm.dot(b.arm));
            for i in 0..3 {
                for j in 0..3 {
                    let often = |corner| [i, j, k, l].into_iter().filter(|&one| one == corner).count();
                    let (above, below) = &mut coefficients[often(0)][often(1)];
                    *above += corners[i].w * corners[j].w * frame;
                    *below += corners[i].pixel * corners[j].pixel * arms;
                }
            }
        }
    }
    let (mut found, mut of) = (0.0, [0; 3]);
    for (first, row) in coefficients.iter().enumerate() {
        for (second, &(above, below)) in row.iter().enumerate().take(5 - first) {
            let squared = if below > 0.0 { above / below } else { f64::INFINITY };
            if squared > found {
                (found, of) = (squared, [first, second, 4 - first - second]);
            }
        }
    }
    let width = |&(i, j): &(usize, usize)| {
        let (a, b) = (&corners[i], &corners[j]);
        let there = if of[i] > 0 && of[j] > 0 { 1.0 } else { 0.0 };
        there * a.point.distance_squared(b.point) / (a.arm.length() * b.arm.length())
    };
    let wider = |a, b| if width(&b) > width(&a) { b } else { a };
    (DVec2::splat(found).sqrt().x, [(0, 1), (0, 2), (1, 2)].into_iter().fold((0, 1), wider))
}

/// The largest (A t) · (B t) of all unit t, for A and B of two columns each.
fn largest_product([ax, ay]: &[DVec3; 2], [bx, by]: &[DVec3; 2]) -> f64 {
    let (x, y, mixed) = (ax.dot(*bx), ay.dot(*by), 0.5 * (ax.dot(*by) + ay.dot(*bx)));
    let half = 0.5 * (x - y);
    0.5 * (x + y) + DVec2::new(half, mixed).length()
}

#[cfg(test)]
mod tests {
    extern crate std;

    use super::*;
    use crate::{Light, Scene, Settings, View, Warp};
    use proptest::prelude::*;
    use proptest::test_runner::RngSeed;

    /// A map for any light in front of a camera, with its rows for x, y and w mixed: any matrix for that light.
    fn mixed(light: &Light, high: DVec3, mix: [[f64; 3]; 2], slope: [f64; 2]) -> Option<(ShadowMap, ConvexBody)> {
        let view =
            View::perspective((0.0, 2.0, 0.0), (0.3, -0.2, -1.0), (0.0, 1.0, 0.0), 1.2, 1.6, 0.5, 60.0).ok()?;
        let scene = Scene::from_box((-20.0, -1.0, -40.0), high).ok()?;
        let focus = Focus::new(&view, light, &scene);
        let mut map = focus.fit(&Settings::default().with_warp(Warp::Uniform)).into_map()?;
        let [x, y, z, w] = map.rows;
        let row = |[a, b, c]: [f64; 3]| x * a + y * b + w * c;
        // |x| and |y| are at most w, so that this is positive.
        map.rows = [row(mix[0]), row(mix[1]), z, w + (x * slope[0] + y * slope[1]) * 0.499];
        Some((map, focus.receiver_volume()))
    }

    fn lights() -> impl Strategy<Value = Light> {
        let place = || (-15.0..15.0, 5.0..30.0, -30.0..10.0);
        let sun = (-3.0..3.0, 0.1..1.0, -3.0..3.0)
            .prop_filter_map("a sun", |to: (f64, f64, f64)| Light::directional(to).ok());
        let point =
            place().prop_filter_map("a point light", |at: (f64, f64, f64)| Light::point(at, 0.1, 90.0).ok());
        let spot = (place(), 0.2..1.5).prop_filter_map("a spot", |(at, half): ((f64, f64, f64), f64)| {
            Light::spot(at, (0.1, -1.0, -0.2), half, 0.1, 90.0).ok()
        });
        prop_oneof![sun, point, spot]
    }

    /// A wire along the view from 10 to 0.1 under the sun, and a matrix made for it: c vanishes on a line that leaves the
    /// wire's far end by a tenth of its length sideways and meets it next to its near end, and texels point at where it
    /// is beside the far end, (x, s) = (1, 0), with s from the far end on. c is 1 − x − s/10, but for 1/1000, and depth 10
    /// − s, so that c/depth is the same all along, but for the near end, while a texel's length is √(1 + s²).
    #[test]
    fn under_the_sun_too_vertices_may_fall_short() {
        let view =
            View::perspective((0.0, 0.0, 0.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0), 1.0, 1.0, 0.05, 60.0).unwrap();
        let scene = Scene::from_box((0.0, 0.0, -10.0), (0.0, 0.0, -0.1)).unwrap();
        let focus = Focus::new(&view, &Light::directional((0.0, 1.0, 0.0)).unwrap(), &scene);
        let mut map = focus.fit(&Settings::default().with_warp(Warp::Uniform)).into_map().unwrap();
        let (x, s) = (Plane::new(DVec3::X, 0.0), Plane::new(DVec3::Z, 10.0));
        let c = Plane::ONE - x - s * (0.999 / 9.9);
        map.rows = [Plane::ONE, (x - Plane::ONE) * 1e6, map.rows[2], c];
        let found = map.aliasing_over(&focus).unwrap();
        let at_vertices =
            focus.receiver_volume().vertices().iter().map(|&end| map.aliasing(end).unwrap()).fold(0.0, f64::max);
        assert!(found.worst > 5.0 * at_vertices, "{found:?}, {at_vertices}");
        for step in 0..=1000 {
            let there = map.aliasing(DVec3::new(0.0, 0.0, -0.1 - 9.9 * f64::from(step) / 1000.0)).unwrap();
            assert!(there <= found.upper_bound, "{there}, {found:?}");
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig {
            cases: 2000,
            failure_persistence: None,
            rng_seed: RngSeed::Fixed(7),
            ..ProptestConfig::default()
        })]

        /// Of any matrix, warped, turned, sheared and stretched as it may be.
        #[test]
        fn no_point_has_more_aliasing_than_is_said(
            light in lights(),
            high in (1.0..20.0, -1.0..4.0, -30.0..5.0),
            mix in prop::array::uniform2(prop::array::uniform3(prop_oneof![-1.0..1.0, -0.01..0.01])),
            slope in prop::array::uniform2(-1.0..1.0),
            points in prop::collection::vec(prop::array::uniform4(0.001..1.0), 64),
        ) {
            let Some((map, visible)) = mixed(&light, high.into(), mix, slope) else { return Ok(()) };
            let [[a, b, _], [c, d, _]] = mix;
            // Rows that almost coincide make of a texel a line.
            prop_assume!((a * d - b * c).abs() > 1e-6);
            let mut survey = Survey::new(&map);
            survey.search(&visible);
            let found = survey.found(0.0).unwrap();
            // A vertex may be before the near plane, at 0.5, by three times 96 ε of the sum of its coordinates.
            let worst = map.aliasing(found.worst_at).unwrap();
            prop_assert!((worst - found.worst).abs() < 1e-10 * worst, "{worst}, {found:?}");
            let vertices = visible.vertices();
            for (at, parts) in (0..).zip(points) {
                // On a face or an edge, or inside.
                let corners: [DVec3; 4] = core::array::from_fn(|k| vertices[(at * 7 + k * (at + 1)) % vertices.len()]);
                let point = corners.iter().zip(parts).map(|(&corner, part)| corner * part).sum::<DVec3>()
                    / parts.iter().sum::<f64>();
                let there = map.aliasing(point).unwrap();
                // The determinant of two rows that are 1e-6 from each other, and so aliasing, keeps ten digits.
                prop_assert!(there <= found.upper_bound * (1.0 + 1e-9), "{there} at {point}, {found:?}");
            }
        }

        /// Against simplices that are cut until halves differ by no more than one part in a hundred thousand.
        #[test]
        fn means_are_right_to_one_part_in_a_thousand(
            light in lights(),
            high in (1.0..20.0, -1.0..4.0, -30.0..5.0),
            mix in prop::array::uniform2(prop::array::uniform3(-1.0..1.0)),
            slope in prop::array::uniform2(-1.0..1.0),
        ) {
            let Some((map, visible)) = mixed(&light, high.into(), mix, slope) else { return Ok(()) };
            let survey = Survey::new(&map);
            let dimension = dimension(&visible);
            let mean = |fineness| {
                let (integral, measure) = survey.integral(&visible, dimension, fineness);
                integral / measure
            };
            let (found, closer) = (mean(Fineness::CHECKED), mean(Fineness { depths: 1.3, angle: 0.5, error: 1e-5 }));
            prop_assert!((found - closer).abs() < 1e-3 * closer, "{found}, {closer}");
        }
    }
}
