//! The chart of a light's rays.

use crate::convex::{Plane, Polyhedron};
use crate::focus::Focus;
use crate::focus::cone::{NoCone, leave_corner};
use crate::input::light::Light;
use crate::input::view::View;
use crate::math::frame;
use glam::{DVec2, DVec3};

/// A chart of the rays of a light: a plane that each of them meets once.
///
/// The lines through l form a projective plane. A covector that vanishes at l is a linear function of `(U, V, 1)` on
/// this chart, and every single-pass shadow matrix for l is a homography of it (`docs/design.md`, section 2). The chart itself is
/// the uniform map:
///
/// ```text
///     U = u · X / w · X      V = v · X / w · X      w = 1 on points (directional light), or the distance along the
///                                                   axis from the light
/// ```
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rays {
    /// Unit direction away from the light, in the middle of R.
    pub(crate) axis: DVec3,
    u_axis: DVec3,
    v_axis: DVec3,
    pub(crate) u: Plane,
    pub(crate) v: Plane,
    /// w, positive on R.
    pub(crate) w: Plane,
    /// Distance along `axis` from a local light; under a directional light from the eye, or from the world's origin in a stable map.
    pub(crate) along: Plane,
    /// The point where `u`, `v` and `along` are zero.
    origin: DVec3,
    /// Whether the light is local: at a position.
    pub(crate) local: bool,
    /// The least w on R beyond the light's near distance.
    pub(crate) least_w: f64,
}

impl Rays {
    /// The chart around R. A corner of R at the light is cut off up to the light's near distance.
    pub(crate) fn new(focus: &Focus<'_>, visible: &mut Polyhedron) -> Result<Self, NoCone> {
        let view = focus.view();
        let (axis, margin) = match focus.light().position() {
            None => (-focus.light().homogeneous().truncate(), 1.0),
            Some(position) => leave_corner(position, focus.light().near(), visible, |_, _| ())?,
        };
        let (u_axis, v_axis) = frame::across(axis, view.forward(), view.up());
        Ok(Self::about([u_axis, v_axis, axis], view.eye(), focus.light(), margin))
    }

    /// The chart with these axes, zero at a local light or else at `origin`; `margin` is the least cosine between the axis and a ray
    /// to R.
    pub(crate) fn about([u_axis, v_axis, axis]: [DVec3; 3], origin: DVec3, light: &Light, margin: f64) -> Self {
        let position = light.position();
        let origin = position.unwrap_or(origin);
        let along = Plane::through(axis, origin);
        Self {
            axis,
            u_axis,
            v_axis,
            u: Plane::through(u_axis, origin),
            v: Plane::through(v_axis, origin),
            w: if position.is_some() { along } else { Plane::ONE },
            along,
            origin,
            local: position.is_some(),
            least_w: light.near() * margin,
        }
    }

    /// The ray through a point, and w there.
    pub(crate) fn through(&self, point: DVec3) -> (DVec2, f64) {
        let w = self.w.at(point);
        let across = DVec2::new(self.u.at(point), self.v.at(point));
        (if self.local { across / w } else { across }, w)
    }

    /// The axes of u, v and depth.
    pub(crate) const fn axes(&self) -> [DVec3; 3] {
        [self.u_axis, self.v_axis, self.axis]
    }

    /// A point as (u, v, w); for w > 0 its ray is at (u, v)/w.
    pub(crate) fn homogeneous(&self, point: DVec3) -> DVec3 {
        DVec3::new(self.u.at(point), self.v.at(point), self.w.at(point))
    }

    /// The view's depth as the light sees it, as a function on the chart: eye depth where a ray meets the plane ρ across the axis, at
    /// the distance `along`. It is `C₃ − (C₃·l / ρ·l) ρ`, over w on ρ: the covector that vanishes at the light and equals the camera's
    /// depth row C₃ on ρ.
    pub(crate) fn depth_across(&self, view: &View, along: f64) -> Functional {
        let forward = view.forward();
        let slope = DVec2::new(forward.dot(self.u_axis), forward.dot(self.v_axis));
        let scale = if self.local { along } else { 1.0 };
        Functional { slope: slope * scale, constant: view.depth(self.origin + self.axis * along) }
    }

    /// The function on the chart of a covector that vanishes at the light.
    pub(crate) fn functional(&self, covector: &Plane) -> Functional {
        let constant = if self.local { covector.normal.dot(self.axis) } else { covector.at(self.origin) };
        let slope = DVec2::new(covector.normal.dot(self.u_axis), covector.normal.dot(self.v_axis));
        Functional { slope, constant }
    }

    /// The covector of a function on the chart.
    pub(crate) fn covector(&self, functional: &Functional) -> Plane {
        self.u * functional.slope.x + self.v * functional.slope.y + self.w * functional.constant
    }

    /// The world-space direction, away from the light, of the homogeneous chart point (`across`, `w`).
    pub(crate) fn direction(&self, across: DVec2, w: f64) -> DVec3 {
        self.u_axis * across.x + self.v_axis * across.y + self.axis * w
    }
}

/// A linear function of `(U, V, 1)` on the chart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Functional {
    pub(crate) slope: DVec2,
    pub(crate) constant: f64,
}

impl Functional {
    /// The uniform map's w.
    pub(crate) const ONE: Self = Self { slope: DVec2::ZERO, constant: 1.0 };
    /// The chart's coordinates.
    pub(crate) const U: Self = Self { slope: DVec2::X, constant: 0.0 };
    pub(crate) const V: Self = Self { slope: DVec2::Y, constant: 0.0 };

    pub(crate) fn at(&self, ray: DVec2) -> f64 {
        self.slope.dot(ray) + self.constant
    }

    pub(crate) fn scaled(&self, factor: f64) -> Self {
        Self { slope: self.slope * factor, constant: self.constant * factor }
    }
}
