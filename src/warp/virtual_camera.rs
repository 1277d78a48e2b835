//! The light after the camera's perspective: its class and the virtual camera.

use crate::convex::{ConvexBody, Plane};
use crate::focus::Focus;
use crate::input::light::Light;
use crate::input::view::{Lens, View};
use crate::math::bounds::Interval;
use crate::settings::Shift;
use core::fmt;
use glam::{DVec3, DVec4};

/// The class of a light after the camera's projection (Stamminger & Drettakis 2002, §3.2, Fig. 4 and 5).
///
/// It explains a fit; no branch of the fit depends on it.
///
/// ```
/// use shadowfit::{Light, View, warp::{ClassKind, classify}};
///
/// let view = View::perspective((0.0, 0.0, 0.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.1, 50.0)?;
/// let kind = |light: Light| classify(&view, &light).kind;
/// assert_eq!(kind(Light::point((0.0, 3.0, -9.0), 0.1, 20.0)?), ClassKind::Point);
/// assert_eq!(kind(Light::point((0.0, 3.0, 9.0), 0.1, 20.0)?), ClassKind::Inverted);
/// assert_eq!(kind(Light::directional((0.0, 1.0, 0.0))?), ClassKind::Directional);
/// assert_eq!(kind(Light::directional((0.0, 1.0, -1.0))?), ClassKind::InfinityPlane);
/// assert_eq!(ClassKind::InfinityPlane.to_string(), "infinity plane");
/// # Ok::<(), shadowfit::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum ClassKind {
    /// A local light in front of the camera plane: a point light, λw > 0.
    Point,
    /// A local light behind the viewer: an inverted point light, λw < 0. The paper reverses the depth test; here depth grows away
    /// from the light in every class.
    Inverted,
    /// λw = 0: a local light in the camera plane becomes directional; a directional light parallel to the image plane stays so.
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

/// A special case that a light is close to ([`LightClass::is_near`]).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum NearCase {
    /// The light lies in the camera plane or shines parallel to it: the class is about to change.
    CameraPlane,
    /// The light shines along the view or against it (duelling frusta): no warp gains anything.
    #[doc(alias = "duelling frusta")]
    #[doc(alias = "dueling frusta")]
    AlongView,
    /// The light is at the eye, such as a headlamp: the viewer sees no shadows.
    Eye,
    /// The light is inside V.
    InsideView,
}

/// A light after the camera's perspective: its class and position, from [`classify`].
///
/// ```
/// use shadowfit::{Light, View, warp::{ClassKind, NearCase, classify}};
///
/// let view = View::perspective((0.0, 0.0, 0.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.1, 50.0)?;
/// let class = classify(&view, &Light::point((0.0, 0.5, -0.002), 0.1, 20.0)?);
/// assert_eq!((class.kind, class.inside_view), (ClassKind::Point, false));
/// assert!((class.position.w - 0.002).abs() < 1e-12 && (class.eye_distance - 5.0).abs() < 1e-3);
/// assert!(class.is_near(NearCase::CameraPlane) && class.is_near(NearCase::Eye));
/// assert!(class.near_cases().eq([NearCase::CameraPlane, NearCase::Eye]));
/// # Ok::<(), shadowfit::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct LightClass {
    /// The class.
    pub kind: ClassKind,
    /// λ = C·l, the homogeneous position of the light after perspective. Inside V, x/w, y/w and z/w lie in [−1, 1]; w is the light's
    /// depth before the eye in world units, or that of the unit direction of a directional light.
    pub position: DVec4,
    /// The sine of the angle between the camera plane and the ray from the eye to the light: 0 where classes meet, 1 for a light
    /// straight ahead, −1 for one straight behind.
    pub sine_to_camera_plane: f64,
    /// The distance from the eye to the light over the view's near distance; infinite for a directional light and for an
    /// orthographic view.
    #[cfg_attr(feature = "serde", serde(with = "crate::math::infinity"))]
    pub eye_distance: f64,
    /// Whether the light is inside V or on its boundary.
    pub inside_view: bool,
}

impl LightClass {
    /// Whether the light is close to a special case: the sine of its angle within 0.01, or its distance from the eye below ten near
    /// distances.
    #[must_use]
    pub fn is_near(&self, case: NearCase) -> bool {
        match case {
            NearCase::CameraPlane => self.sine_to_camera_plane.abs() < 0.01,
            NearCase::AlongView => self.sine_to_camera_plane.abs() > 0.99,
            NearCase::Eye => self.eye_distance < 10.0,
            NearCase::InsideView => self.inside_view,
        }
    }

    /// The special cases that the light is close to.
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

/// Classifies a light after the perspective of a view (Stamminger & Drettakis 2002, §3.2).
///
/// An orthographic view has λw = 0 for directional lights and λw = 1 for local ones, which keeps their kind.
///
/// ```
/// use shadowfit::{Light, View, warp::{ClassKind, classify}};
///
/// let view = View::perspective((0.0, 1.7, 0.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.1, 500.0)?;
/// let behind = classify(&view, &Light::directional((0.0, 1.0, 1.0))?);
/// assert_eq!(behind.kind, ClassKind::InfinityPlaneInverted);
/// assert!((behind.sine_to_camera_plane + 0.5_f64.sqrt()).abs() < 1e-12);
/// # Ok::<(), shadowfit::InputError>(())
/// ```
#[must_use]
pub fn classify(view: &View, light: &Light) -> LightClass {
    let rows = view.rows(view.near(), view.far());
    let l = light.homogeneous();
    let position = after_perspective(&rows, l);
    // The class alone has a threshold, the rounding of λw: nothing in a fit depends on it.
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

/// The virtual camera, whose perspective warps the map: the view's own, or moved back (Stamminger & Drettakis 2002, §4.2).
///
/// ```
/// use shadowfit::{Focus, FocusForm, Light, Scene, View, warp::{Shift, VirtualCamera}};
///
/// let view = View::perspective((0.0, 1.7, 0.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.1, 60.0)?;
/// let scene = Scene::from_box((-200.0, 0.0, -200.0), (200.0, 30.0, 200.0))?;
/// let focus = Focus::new(&view, &Light::directional((0.4, 1.0, 0.9))?, &scene); // from behind
/// let camera = VirtualCamera::new(&focus, Shift::Back(FocusForm::ViewHull)).expect("receivers");
/// assert!(camera.shift > 0.0 && camera.eye == view.eye() - view.forward() * camera.shift);
/// assert!(camera.near >= 0.1 && camera.far > camera.near);
/// assert_eq!(VirtualCamera::new(&focus, Shift::None).expect("receivers").shift, 0.0);
/// # Ok::<(), shadowfit::InputError>(())
/// ```
#[doc(alias = "back-shift")]
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct VirtualCamera {
    /// The back-shift s along the view axis, in world units; 0 for the view's own camera.
    pub shift: f64,
    /// The position in world space.
    pub eye: DVec3,
    /// The depth of the near plane before `eye`, in world units.
    pub near: f64,
    /// The depth of the far plane before `eye`, in world units.
    pub far: f64,
}

impl VirtualCamera {
    /// The virtual camera that [`Focus::fit`] uses with this back-shift; `None` without receivers, or without casters for
    /// [`Shift::Back`].
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

    /// The view's own camera with its depth range narrowed to that of the receivers: the warp ignores depths outside, and an
    /// infinite far plane is no special case.
    pub(crate) fn own(view: &View, visible: &Interval) -> Self {
        let (near, far) = match view.lens() {
            // Rounding may put a point of R just in front of the near plane.
            Lens::Perspective => (visible.min.max(view.near()), visible.max),
            Lens::Orthographic => (view.near(), view.far()),
        };
        Self { shift: 0.0, eye: view.eye(), near, far: beyond(near, far) }
    }

    /// The camera moved back by the least s that puts all of H beyond its near plane. The near distance and the angles of the frame
    /// stay; the far plane moves to hold H. An orthographic view has no perspective to weaken and does not move.
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

/// A far depth beyond the near one, also when all points have one depth.
fn beyond(near: f64, far: f64) -> f64 {
    const THICKNESS: f64 = 1.0 / 1024.0;
    far.max(near + near.abs() * THICKNESS)
}
