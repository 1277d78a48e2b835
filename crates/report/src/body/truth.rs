//! What is true of a case: what is visible, what must be in the map, and which casters are needed, decided in integers.

use anyhow::{Context as _, Result};
use dashu_int::IBig;
use shadowfit::glam::DVec3;
use shadowfit::{Aabb, Focus, Light, Scene, View, focus::Plane};

use super::case::{Case, box_planes, farthest_corner, in_f64};
use super::town::{Town, bounds};
use testkit::oracle::body::Body;
use testkit::oracle::cone::generators;
use testkit::oracle::exact::ratio;
use testkit::oracle::homogeneous::{ExactPlane, ExactPoint, Homogeneous};

/// A part of the scene that lies so much nearer to a plane than this part of the scene's size is left to the integers.
const DOUBT: f64 = 1e-7;

/// A convex body, exactly, with its rounded planes for the many questions that need no integers.
pub(crate) struct Exact {
    pub(crate) body: Body,
    /// Those of its planes that a vertex lies on: the others change nothing.
    planes: Vec<ExactPlane>,
    /// The same in f64, of unit length.
    rounded: Vec<Plane>,
    /// The box around it in f64.
    pub(crate) bounds: (DVec3, DVec3),
    /// How near to a plane f64 is not trusted.
    doubt: f64,
}

impl Exact {
    /// The intersection of half-spaces, or `None` where it is empty.
    pub(crate) fn new(planes: Vec<ExactPlane>) -> Option<Self> {
        let body = Body::from_exact_planes(planes);
        let mut used: Vec<usize> = body.vertices.iter().flat_map(|vertex| vertex.tight.iter().copied()).collect();
        used.sort_unstable();
        used.dedup();
        let planes: Vec<ExactPlane> = used.into_iter().map(|index| body.planes[index].clone()).collect();
        let rounded = planes.iter().map(rounded).collect();
        let (mut min, mut max) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for vertex in body.vertices_f64() {
            (min, max) = (min.min(vertex.into()), max.max(vertex.into()));
        }
        let doubt = DOUBT * (min.abs().max(max.abs()).length() + (max - min).length());
        min.is_finite().then_some(Self { body, planes, rounded, bounds: (min, max), doubt })
    }

    /// Whether a box meets it, boundaries included.
    pub(crate) fn meets(&self, one: &Aabb) -> bool {
        self.surely_meets(in_f64(one)).unwrap_or_else(|| !self.part_in(one).is_empty())
    }

    /// The part of it in a box, exactly.
    pub(crate) fn part_in(&self, one: &Aabb) -> Body {
        let (min, max) = in_f64(one);
        // A plane that leaves all of the box inside takes nothing away.
        let cuts = |plane: &Plane| plane.at(farthest_corner(min, max, -plane.normal)) <= self.doubt;
        let mut planes: Vec<ExactPlane> = box_planes((min, max)).iter().map(exact).collect();
        let cutting = self.planes.iter().zip(&self.rounded).filter(|(_, rounded)| cuts(rounded));
        planes.extend(cutting.map(|(plane, _)| plane.clone()));
        Body::from_exact_planes(planes)
    }

    /// Whether a box meets it, where f64 can tell.
    fn surely_meets(&self, (min, max): (DVec3, DVec3)) -> Option<bool> {
        const STEPS: usize = 24;
        let (low, high) = self.bounds;
        let outside = |plane: &Plane| plane.at(farthest_corner(min, max, plane.normal)) < -self.doubt;
        let apart = (low - max).max(min - high).max_element() > self.doubt;
        if apart || self.rounded.iter().any(outside) {
            return Some(false);
        }
        // From one plane and back into the box: where there is room in both, this soon finds a point.
        let mut point = (0.5 * (low + high)).clamp(min, max);
        for _ in 0..STEPS {
            let worst = self.rounded.iter().min_by(|a, b| a.at(point).total_cmp(&b.at(point)))?;
            let value = worst.at(point);
            if value > self.doubt {
                return Some(true);
            }
            point = (point + worst.normal * (4.0 * self.doubt - value)).clamp(min, max);
        }
        None
    }
}

/// What is true of a case.
pub(crate) struct Truth {
    /// R: what is visible and lit, within the bounds of all receivers that are.
    pub(crate) visible: Exact,
    /// H: what can cast on it, within the scene.
    pub(crate) body: Exact,
}

impl Truth {
    /// Of a view and a light where what receives and what casts lies in convex bodies; `None` where nothing is visible or
    /// nothing can cast on it.
    pub(crate) fn new(view: &View, light: &Light, receiving: &[Plane], casting: &[Plane]) -> Option<Self> {
        let lit = light.planes();
        let of = |planes: &[Plane]| planes.iter().map(exact).collect::<Vec<_>>();
        let visible = Exact::new([of(receiving), of(view.planes().as_slice()), of(lit.as_slice())].concat())?;
        let mut points: Vec<ExactPoint> = visible.body.vertices.iter().map(|vertex| vertex.point.clone()).collect();
        points.push(Homogeneous::from_f64(light.homogeneous().to_array()));
        let has_normal = |plane: &ExactPlane| plane.xyz().iter().any(|component| !component.is_zero());
        let hull = generators(&points).into_iter().map(|ray| ray.vector).filter(has_normal).collect();
        let body = Exact::new([hull, of(casting), of(lit.as_slice())].concat())?;
        Some(Self { visible, body })
    }
}

/// What is true of a case in a town.
pub(crate) struct TownTruth {
    pub(crate) truth: Truth,
    /// Which casters meet H.
    pub(crate) needed: Vec<bool>,
    /// The corners of those parts of receivers that are visible and lit.
    pub(crate) seen: Vec<Vec<DVec3>>,
}

impl TownTruth {
    /// `None` where no receiver is visible and lit.
    ///
    /// # Errors
    ///
    /// Where a box of the town is no box.
    pub(crate) fn new(case: &Case<'_>, town: &Town) -> Result<Option<Self>> {
        let scene = case.scene_planes();
        let lit_view: Vec<ExactPlane> = [&scene[..], case.view.planes().as_slice(), case.light.planes().as_slice()]
            .concat()
            .iter()
            .map(exact)
            .collect();
        let Some(lit_view) = Exact::new(lit_view) else { return Ok(None) };
        let receivers: Vec<Aabb> = town.receivers.iter().copied().filter(|one| lit_view.meets(one)).collect();
        if receivers.is_empty() {
            return Ok(None);
        }
        let corners = |one: &Aabb| -> Result<Vec<DVec3>> {
            let scene = Scene::from_box(one.min, one.max).context("a receiver is no box")?;
            Ok(Focus::new(&case.view, &case.light, &scene).receiver_volume().vertices().to_vec())
        };
        let seen: Vec<Vec<DVec3>> = receivers.iter().map(corners).collect::<Result<_>>()?;
        // Besides the box around them all, R ends at the nearest and the farthest depth of any receiver in view.
        let view = &case.view;
        let in_view = receivers.iter().map(|one| -> Result<Vec<DVec3>> {
            let scene = Scene::from_box(one.min, one.max).context("a receiver is no box")?;
            let everywhere = Light::directional(DVec3::Y).context("a direction")?;
            Ok(Focus::new(view, &everywhere, &scene).receiver_volume().vertices().to_vec())
        });
        let in_view: Vec<Vec<DVec3>> = in_view.collect::<Result<_>>()?;
        let depths = in_view.iter().flatten().map(|point| view.depth(*point));
        let (near, far) =
            depths.fold((f64::INFINITY, f64::NEG_INFINITY), |(near, far), depth| (near.min(depth), far.max(depth)));
        let depth = Plane::new(view.forward(), -view.forward().dot(view.eye()));
        let ends = [depth - Plane::new(DVec3::ZERO, near), Plane::new(DVec3::ZERO, far) - depth];
        let receiving = [&box_planes(bounds(&receivers))[..], &ends].concat();
        let Some(truth) = Truth::new(&case.view, &case.light, &receiving, &scene) else { return Ok(None) };
        let needed = town.casters.iter().map(|caster| truth.body.meets(caster)).collect();
        Ok(Some(Self { truth, needed, seen }))
    }
}

/// A plane, exactly.
fn exact(plane: &Plane) -> ExactPlane {
    Homogeneous::from_f64(plane.to_row().to_array())
}

/// An exact plane in f64, of unit length.
fn rounded(plane: &ExactPlane) -> Plane {
    let size = |value: &IBig| if *value < IBig::ZERO { -value } else { value.clone() };
    let largest = plane.xyz().into_iter().map(size).max().unwrap_or(IBig::ONE);
    let [x, y, z, offset] = plane.coords().each_ref().map(|coord| ratio(coord, &largest, 0));
    Plane::new(DVec3::new(x, y, z), offset).normalized()
}

#[cfg(test)]
mod tests {
    use super::*;
    use shadowfit::glam::Vec3;

    /// A view along −z from the origin, at boxes in front of it, lit from straight above.
    fn truth() -> Truth {
        let view =
            View::perspective(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 1.0, 1.0, 1.0, 100.0).expect("a legal view");
        let light = Light::directional(DVec3::Y).expect("a legal light");
        let all = box_planes((DVec3::splat(-50.0), DVec3::splat(50.0)));
        Truth::new(&view, &light, &all, &all).expect("much is visible")
    }

    fn cube(middle: Vec3, half: f32) -> Aabb {
        Aabb::new(middle - half, middle + half)
    }

    #[test]
    fn what_stands_between_the_light_and_what_is_visible_is_needed() {
        let body = truth().body;
        assert!(body.meets(&cube(Vec3::new(0.0, 45.0, -10.0), 1.0)), "above the view");
        assert!(!body.meets(&cube(Vec3::new(0.0, -45.0, -10.0), 1.0)), "below the view");
        assert!(!body.meets(&cube(Vec3::new(0.0, 45.0, 10.0), 1.0)), "behind the eye");
    }

    #[test]
    fn a_box_that_touches_meets_and_one_an_ulp_away_does_not() {
        let body = truth().body;
        // The near plane of the view is at z = −1, and what is above it needs nothing behind it.
        let at = |near_end: f32| Aabb::new(Vec3::new(-1.0, 30.0, near_end), Vec3::new(1.0, 31.0, 5.0));
        assert!(body.surely_meets(in_f64(&at(-1.0))).is_none(), "only integers can tell");
        assert!(body.meets(&at(-1.0)));
        assert!(!body.meets(&at((-1.0_f32).next_up())));
    }

    #[test]
    fn a_part_is_in_both() {
        let body = truth().body;
        let one = cube(Vec3::new(0.0, 0.0, -1.0), 0.25);
        let part = body.part_in(&one);
        assert!(!part.is_empty());
        assert!(part.vertices_f64().into_iter().all(|[x, y, z]| {
            (-1.25..=-1.0).contains(&z) && x.abs() <= 0.25 && y.abs() <= 0.25 && body.body.contains([x, y, z])
        }));
    }
}
