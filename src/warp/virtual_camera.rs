//! The light after the camera's perspective: its class, and the virtual camera.

use crate::convex::{ConvexBody, Plane};
use crate::focus::Focus;
use crate::input::light::Light;
use crate::input::view::{Lens, View};
use crate::math::bounds::Interval;
use crate::settings::Shift;
use core::fmt;
use glam::{DVec3, DVec4};

/// What becomes of a light under the camera's projection (Stamminger & Drettakis 2002, §3.2 and Fig. 4 and 5).
///
/// The class explains a fit; no branch of it depends on the class.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum ClassKind {
    /// A light at a position before the camera plane: a point light, λw > 0.
    Point,
    /// A light at a position behind the viewer: a point light that depths grow *towards*, λw < 0. The paper reverses
    /// the depth test; here depth grows away from the light all the same.
    Inverted,
    /// λw = 0: a light at a position in the camera plane becomes directional, a directional light parallel to the
    /// image plane stays so.
    Directional,
    /// A directional light shining towards the viewer: a point light on the infinity plane, λw > 0.
    InfinityPlane,
    /// A directional light shining from behind the viewer: a point light on the infinity plane, inverted, λw < 0.
    InfinityPlaneInverted,
}

impl fmt::Display for ClassKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Point => "point",
            Self::Inverted => "inverted",
            Self::Directional => "directional",
            Self::InfinityPlane => "infinity plane",
            Self::InfinityPlaneInverted => "infinity plane, inverted",
        })
    }
}

/// A special case that a light and a view come close to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum NearCase {
    /// The light lies in the camera plane, or shines parallel to it: the class is about to change.
    CameraPlane,
    /// The light shines along the view or against it: a warp has nothing to gain.
    AlongView,
    /// The light is at the eye, as a miner's lamp: shadows are hidden from the viewer.
    Eye,
    /// The light is inside V.
    InsideView,
}

/// The class of a light, with its position after perspective.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct LightClass {
    /// The class.
    pub kind: ClassKind,
    /// λ = C·l, the homogeneous position of the light after perspective: x, y and z are −1 to 1 inside V after
    /// division by w, which is the light's depth before the eye (for a directional light, that of its unit direction).
    pub position: DVec4,
    /// Sine of the angle between the camera plane and the ray from the eye to the light: 0 where classes meet, 1 for a
    /// light along the view, −1 against it.
    pub sine_to_camera_plane: f64,
    /// Distance from the eye to the light in units of the near distance; infinite for a directional light and for an
    /// orthographic view, which has no eye.
    #[cfg_attr(feature = "serde", serde(with = "crate::math::infinity"))]
    pub eye_distance: f64,
    /// Whether the light is inside V, its planes included.
    pub inside_view: bool,
}

impl LightClass {
    /// Whether the light comes close to a case: within 1 % of the sine of the angle, or of ten near distances around
    /// the eye.
    #[must_use]
    pub fn is_near(&self, case: NearCase) -> bool {
        match case {
            NearCase::CameraPlane => self.sine_to_camera_plane.abs() < 0.01,
            NearCase::AlongView => self.sine_to_camera_plane.abs() > 0.99,
            NearCase::Eye => self.eye_distance < 10.0,
            NearCase::InsideView => self.inside_view,
        }
    }

    /// The cases that the light comes close to.
    pub fn near_cases(&self) -> impl Iterator<Item = NearCase> + '_ {
        [NearCase::CameraPlane, NearCase::AlongView, NearCase::Eye, NearCase::InsideView]
            .into_iter()
            .filter(|&case| self.is_near(case))
    }
}

impl fmt::Display for LightClass {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.kind.fmt(f)
    }
}

/// The class of a light after the perspective of a view.
///
/// An orthographic view has λw = 0 for every directional light and λw = 1 for every other: they keep their kind.
#[must_use]
pub fn classify(view: &View, light: &Light) -> LightClass {
    let rows = view.rows(view.near(), view.far());
    let l = light.homogeneous();
    let position = after_perspective(&rows, l);
    // Only the name of the class has a threshold: the rounding of λw itself.
    let magnitude = rows[3].normal.abs().dot(l.truncate().abs()) + (rows[3].offset * l.w).abs();
    let on_plane = position.w.abs() <= 4.0 * f64::EPSILON * magnitude;
    let kind = match (light.position().is_some(), on_plane, position.w > 0.0) {
        (_, true, _) => ClassKind::Directional,
        (true, _, true) => ClassKind::Point,
        (true, _, false) => ClassKind::Inverted,
        (false, _, true) => ClassKind::InfinityPlane,
        (false, _, false) => ClassKind::InfinityPlaneInverted,
    };
    let to_light = light.direction_from(view.eye());
    let eye_distance = match (light.position(), view.lens()) {
        (Some(position), Lens::Perspective) => position.distance(view.eye()) / view.near(),
        _ => f64::INFINITY,
    };
    LightClass {
        kind,
        position,
        sine_to_camera_plane: view.forward().dot(to_light),
        eye_distance,
        inside_view: light.position().is_some() && view.planes().iter().all(|plane| plane.on(l) >= 0.0),
    }
}

/// λ = C·l.
pub(crate) fn after_perspective(rows: &[Plane; 4], l: DVec4) -> DVec4 {
    DVec4::new(rows[0].on(l), rows[1].on(l), rows[2].on(l), rows[3].on(l))
}

/// The camera whose perspective warps the map: the view's own, or the view's moved back (Stamminger & Drettakis 2002,
/// §4.2).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct VirtualCamera {
    /// s, how far the eye is moved back along the view axis, in world units; 0 for the view's own camera.
    pub shift: f64,
    /// Where it is, in world space.
    pub eye: DVec3,
    /// Depth of its near plane before `eye`, in world units.
    pub near: f64,
    /// Depth of its far plane before `eye`, in world units.
    pub far: f64,
}

impl VirtualCamera {
    /// The camera for what is visible, or `None` when nothing is; moved back by [`Shift::Back`] as [`Focus::fit`] does.
    #[must_use]
    pub fn new(focus: &Focus<'_>, shift: Shift) -> Option<Self> {
        let (view, visible) = (focus.view(), focus.receiver_volume());
        let depths = |body: &ConvexBody| Self::depths(view, body.vertices().iter().copied());
        if visible.is_empty() {
            return None;
        }
        match shift {
            Shift::None => Some(Self::own(view, &depths(&visible))),
            Shift::Back(form) => {
                let body = focus.caster_volume(form);
                (!body.is_empty()).then(|| Self::moved_back(view, &depths(&body)))
            }
        }
    }

    /// The depths, before the eye of a view, of points.
    pub(crate) fn depths(view: &View, points: impl Iterator<Item = DVec3>) -> Interval {
        let mut depths = Interval::EMPTY;
        points.for_each(|point| depths.include(view.depth(point)));
        depths
    }

    /// The view's own camera, its depth range drawn in to that of the visible points: what lies before the first and
    /// beyond the last of them does not matter to the warp, and an infinite far plane needs no special case.
    pub(crate) fn own(view: &View, visible: &Interval) -> Self {
        let (near, far) = match view.lens() {
            // Rounding may leave a point of R just before the near plane.
            Lens::Perspective => (visible.min.max(view.near()), visible.max),
            Lens::Orthographic => (view.near(), view.far()),
        };
        Self { shift: 0.0, eye: view.eye(), near, far: beyond(near, far) }
    }

    /// The camera moved back until every point of H lies beyond its near plane: by the least s that brings the nearest
    /// one to the near distance. The near distance stays, the frame keeps its angle, and the far plane grows with s to
    /// hold H, and with it what is visible of the old frustum.
    ///
    /// An orthographic view has no perspective to weaken and does not move.
    pub(crate) fn moved_back(view: &View, body: &Interval) -> Self {
        if view.lens() == Lens::Orthographic {
            return Self { shift: 0.0, eye: view.eye(), near: view.near(), far: view.far() };
        }
        let shift = (view.near() - body.min).max(0.0);
        let (near, far) = (body.min.max(view.near()), body.max + shift);
        Self { shift, eye: view.eye() - view.forward() * shift, near, far: beyond(near, far) }
    }

    /// The rows of the camera's matrix.
    pub(crate) fn rows(&self, view: &View) -> [Plane; 4] {
        view.moved_back(self.shift).rows(self.near, self.far)
    }
}

/// A far depth that is beyond the near one even when all points lie at one depth.
fn beyond(near: f64, far: f64) -> f64 {
    const THICKNESS: f64 = 1.0 / 1024.0;
    far.max(near + near.abs() * THICKNESS)
}
