//! Narrowing a view to its receivers.

use crate::convex::Polyhedron;
use crate::focus::{VIEW_IDS, clip_all, farthest_corner};
use crate::input::scene::{Bounds, Region, Scene};
use crate::input::view::View;
use crate::math::bounds::{Interval, least, most};
use glam::DVec3;

impl View {
    /// The view with near and far at its nearest and farthest receiver point; `None` without receivers in view.
    ///
    /// A warp follows the view from its near plane on: a near plane in the air, before the first receiver, wastes texels there
    /// (`docs/warps.md`). Boxes give the range of depths as a depth buffer read back does (Stamminger & Drettakis 2002, §6), less
    /// exactly. Of lists only receivers count, each clipped by the view, whether a light reaches them or not; of other scenes all.
    ///
    /// ```
    /// use shadowfit::{Aabb, Scene, View};
    ///
    /// let view = View::perspective((0.0, 2.0, 0.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.1, f64::INFINITY)?;
    /// // One in front of the eye, one beside the view.
    /// let receivers = [Aabb::new([-4.0, 0.0, -30.0], [4.0, 3.0, -20.0]), Aabb::new([50.0, 0.0, -9.0], [51.0, 1.0, -8.0])];
    /// let narrowed = view.narrowed_to(&Scene::new(&[], &receivers)?).expect("one is in view");
    /// assert!((narrowed.near() - 20.0).abs() < 1e-9 && (narrowed.far() - 30.0).abs() < 1e-9);
    /// assert_eq!(view.narrowed_to(&Scene::new(&[], &receivers[1..])?), None);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn narrowed_to(&self, scene: &Scene<'_>) -> Option<Self> {
        let mut search = Depths::of(self);
        match scene.bounds {
            Bounds::Nothing => {}
            Bounds::Box { min, max } => search.visit_box(min, max),
            Bounds::Convex(body) => search.visit(&Region::Convex(body)),
            Bounds::Lists { receivers, .. } => receivers.for_each(|_, one| search.visit_box(one.min, one.max)),
        }
        let Interval { min, max } = search.found()?;
        let (near, far) = (most(self.near(), min), least(self.far(), max));
        // Receivers of no extent in depth leave the view as it is.
        self.narrowed(near, far).ok().or(Some(*self))
    }
}

/// The search for the range of depths.
pub(super) struct Depths<'a> {
    view: &'a View,
    body: Polyhedron,
    found: Interval,
    /// The largest absolute coordinates of the receivers found.
    extent: DVec3,
}

impl<'a> Depths<'a> {
    pub(super) const fn of(view: &'a View) -> Self {
        Self { view, body: Polyhedron::EMPTY, found: Interval::EMPTY, extent: DVec3::ZERO }
    }

    /// The range found, with room for the rounding of depths and of planes there; `None` without receivers in view.
    pub(super) fn found(&self) -> Option<Interval> {
        let Self { view, found: Interval { min, max }, extent, .. } = *self;
        let slack = 64.0 * f64::EPSILON * (view.forward().abs().dot(extent) + view.eye().abs().element_sum());
        (min <= max).then_some(Interval { min: min - slack, max: max + slack })
    }

    /// Includes a box, unless it cannot widen the range.
    pub(super) fn visit_box(&mut self, min: DVec3, max: DVec3) {
        let forward = self.view.forward();
        let depth = |along| self.view.depth(farthest_corner(min, max, along));
        if depth(-forward) < self.found.min || depth(forward) > self.found.max {
            self.visit(&Region::Box { min, max });
        }
    }

    fn visit(&mut self, region: &Region<'_>) {
        let extent = region.extent();
        region.fill(&mut self.body);
        clip_all(&mut self.body, self.view.planes().as_slice(), VIEW_IDS, extent, |_, _| ());
        for point in self.body.positions() {
            self.found.include(self.view.depth(point));
            self.extent = self.extent.max(extent);
        }
    }
}
