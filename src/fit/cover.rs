//! Bounding the receivers by what the camera sees of them.

use crate::convex::{Plane, Polyhedron};
use crate::focus::Focus;
use crate::input::light::{Light, LightPlanes};
use crate::input::view::View;
use crate::math::bounds::{Interval, Rectangle};
use crate::seen::Seen;
use crate::warp::rays::{Functional, Rays};
use glam::{DVec2, DVec3};

/// Directions on the chart of rays, a twelfth of a turn apart: each bounds what is seen on both sides.
const DIRECTIONS: [DVec2; 6] = [
    DVec2::new(1.0, 0.0),
    DVec2::new(COS_30, 0.5),
    DVec2::new(0.5, COS_30),
    DVec2::new(0.0, 1.0),
    DVec2::new(-0.5, COS_30),
    DVec2::new(-COS_30, 0.5),
];

const COS_30: f64 = 0.866_025_403_784_438_6;

impl<'a> Focus<'a> {
    /// The focus with the surfaces that the camera sees: the receiver volume R is cut down to them, as the camera and the light see
    /// them, and texels are spent where they are.
    ///
    /// R is bounded by the nearest and the farthest depth of what is seen, and by twelve planes around it along the light's rays. What
    /// [`Seen`] promises is in the map. After a cut of the camera the focus stays as it is.
    ///
    /// ```
    #[doc = include_str!("../examples/sun.txt")]
    /// use shadowfit::seen::{Seen, SeenPoint};
    ///
    /// let at = |x: f64, z: f64| SeenPoint { position: DVec3::new(x, 0.0, z), normal: Some(up), pixels: 1.0 };
    /// let floor = [at(-2.0, -4.0), at(2.0, -4.0), at(-6.0, -12.0), at(6.0, -12.0)];
    /// let narrower = focus.clone().with_seen(&Seen::from_points(&floor)?);
    /// assert!(narrower.receiver_volume().volume() < 0.5 * focus.receiver_volume().volume());
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[doc(alias = "SDSM")]
    #[doc(alias = "sample distribution shadow maps")]
    #[must_use]
    pub fn with_seen(self, seen: &Seen<'a>) -> Self {
        let view = self.view;
        let mut body = Polyhedron::EMPTY;
        self.cut_visible(&mut body, |_, _| ());
        // Without a chart only depths bound R.
        let rays = if body.is_empty() { None } else { Rays::new(&self, &mut body).ok() };
        let mut bounds = Bounds::around(rays, &body, self.light());
        let range = Interval { min: view.near() - seen.margin, max: view.far() + seen.margin };
        let is_known = seen.for_each_cell(&view, |corners| bounds.include(corners, &view, &range));
        if !is_known {
            return self;
        }
        let mut focus = self;
        focus.seen = Some(*seen);
        focus.clear_cover();
        if bounds.depths.min > bounds.depths.max {
            // Nothing is seen: R is empty.
            focus.push_cover(-Plane::ONE);
            return focus;
        }
        let Interval { min, max } = bounds.depths;
        focus.cover_depths(&Interval { min: min - seen.margin, max: max + seen.margin });
        bounds.for_each_side(|side| {
            focus.push_cover(side + Plane::ONE * (seen.margin * side.normal.length()));
        });
        focus
    }
}

/// Bounds of what is seen, along the light's rays and in depth.
struct Bounds {
    rays: Option<Rays>,
    /// The planes of the light's region, where that tells which cells count.
    region: LightPlanes,
    /// The chart of rays, scaled so that R extends from −1 to 1.
    middle: DVec2,
    scale: DVec2,
    ends: [Interval; DIRECTIONS.len()],
    depths: Interval,
}

impl Bounds {
    fn around(rays: Option<Rays>, body: &Polyhedron, light: &Light) -> Self {
        let (mut u, mut v) = (Interval::EMPTY, Interval::EMPTY);
        if let Some(rays) = &rays {
            for point in body.positions() {
                let (ray, _) = rays.through(point);
                u.include(ray.x);
                v.include(ray.y);
            }
        }
        let Rectangle { centre, half } = Rectangle::over(&u, &v);
        Self {
            rays,
            region: light.planes(),
            middle: centre,
            scale: half.max(DVec2::splat(f64::MIN_POSITIVE)).recip(),
            ends: [Interval::EMPTY; DIRECTIONS.len()],
            depths: Interval::EMPTY,
        }
    }

    /// Includes a part of the view, unless all of it lies outside of a range of depths or of the light's region.
    fn include(&mut self, corners: &[DVec3], view: &View, range: &Interval) {
        let mut depths = Interval::EMPTY;
        corners.iter().for_each(|corner| depths.include(view.depth(*corner)));
        let outside = |plane: &Plane| corners.iter().all(|corner| plane.at(*corner) < 0.0);
        if depths.max < range.min || depths.min > range.max || self.region.iter().any(outside) {
            return;
        }
        self.depths.include(depths.min);
        self.depths.include(depths.max);
        let Some(rays) = &self.rays else { return };
        for corner in corners {
            let (ray, w) = rays.through(*corner);
            // Beside a local light or behind it, what is seen has no bounds on the chart.
            if rays.local && w <= 0.5 * rays.least_w {
                self.rays = None;
                return;
            }
            let place = (ray - self.middle) * self.scale;
            for (end, direction) in self.ends.iter_mut().zip(DIRECTIONS) {
                end.include(direction.dot(place));
            }
        }
    }

    /// Calls `each` with the planes along the light's rays.
    fn for_each_side(&self, mut each: impl FnMut(Plane)) {
        let Some(rays) = &self.rays else { return };
        let one = rays.covector(&Functional::ONE);
        for (end, direction) in self.ends.iter().zip(DIRECTIONS) {
            let slope = direction * self.scale;
            let across = rays.covector(&Functional { slope, constant: -slope.dot(self.middle) });
            each(across - one * end.min);
            each(one * end.max - across);
        }
    }
}
