//! The focus: view, light and scene brought together, the receiver volume R and the caster volume H (the focus body).
//!
//! [`Focus`] and [`FocusForm`] are at the root of the crate; this module has the bodies, planes and
//! cullers that they answer with, and [`SharedFocus`](crate::multiview::SharedFocus) serves several views. `docs/concepts.md`
//! explains R and H.

use crate::convex::{Bits, PlaneId, Polyhedron};
pub(crate) mod cone;
mod cull;
mod narrow;
mod standing;
mod surfaces;
pub(crate) mod surrounded;

pub use crate::convex::{ConvexBody, Face, Plane};
use crate::focus::cone::leave_corner;
use crate::input::light::{Light, LightPlanes};
use crate::input::scene::{Bounds, Boxes, DAabb, Region, Scene};
use crate::input::view::{FrustumPlanes, View};
use crate::math::bounds::Interval;
use crate::seen::Seen;
pub use cull::Culler;
use glam::{DVec3, DVec4};
use standing::Standing;

/// The two forms of the caster volume H.
///
/// ```
/// use shadowfit::{Focus, FocusForm, Light, Scene, View};
///
/// let view = View::perspective((0.0, 1.7, 0.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.1, 500.0)?;
/// let scene = Scene::from_box((-50.0, 0.0, -50.0), (50.0, 10.0, 50.0))?;
/// let focus = Focus::new(&view, &Light::directional((0.4, 1.0, 0.2))?, &scene);
/// let [view_hull, receiver_hull] =
///     [FocusForm::ViewHull, FocusForm::ReceiverHull].map(|form| focus.caster_volume(form).volume());
/// assert!(receiver_hull < view_hull);
/// # Ok::<(), shadowfit::InputError>(())
/// ```
#[doc(alias = "focus body")]
#[doc(alias = "intersection body")]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum FocusForm {
    /// `hull(V, l) ∩ S ∩ L` (Stamminger & Drettakis 2002, §4.1): correct also where S does not hold every receiver.
    ViewHull,
    /// `hull(R, l) ∩ S ∩ L` with R = V ∩ S ∩ L: casters of shadows on receivers only. It is contained in [`Self::ViewHull`], and
    /// much smaller where the far plane lies beyond the scene.
    #[default]
    ReceiverHull,
}

/// The focus: a view, a light and a scene brought together, with the volumes of their receivers and casters.
///
/// ```text
///                l            R = V ∩ S ∩ L             the receiver volume
///                ∗            H = hull(R, l) ∩ S ∩ L    the caster volume, which the map must hold
///               ╱ ╲
///     ┌────────╱───╲──── S
///     │       ╱  H  ╲  │
///   eye ◁────╱───────╲─┤
///     │     ╲    R    ╲│
///     └──────╲─────────┘
/// ```
///
/// # What a focus can do
///
/// | topic | methods | source |
/// |---|---|---|
/// | build it | [`Focus::new`], [`view`](Focus::view), [`light`](Focus::light) | `src/focus/mod.rs` |
/// | volumes | [`receiver_volume`](Focus::receiver_volume) (R), [`caster_volume`](Focus::caster_volume) (H) | `src/focus/mod.rs` |
/// | casters to draw | [`casters`](Focus::casters); for other lists [`ConvexBody::intersects_aabb`], [`ConvexBody::culler`] | `src/focus/cull.rs` |
/// | shadow map | [`fit`](Focus::fit), [`fit_warm`](Focus::fit_warm) from the previous frame's map | `src/fit/mod.rs` |
/// | quality | [`aliasing_lower_bound`](Focus::aliasing_lower_bound) | `src/map/lower_bound.rs` |
/// | quality of a map | [`ShadowMap::aliasing_over`](crate::ShadowMap::aliasing_over), [`ShadowMap::aliasing_over_receivers`](crate::ShadowMap::aliasing_over_receivers) | `src/map/aliasing.rs` |
/// | lights all around | [`paraboloids`](Focus::paraboloids), [`paraboloids_about`](Focus::paraboloids_about) | `src/omni/paraboloid/fit.rs` |
/// | virtual camera | [`VirtualCamera::new`](crate::warp::VirtualCamera::new) | `src/warp/virtual_camera.rs` |
///
/// ```
/// use shadowfit::{Focus, FocusForm, Light, Scene, Settings, View};
///
/// let view = View::perspective((0.0, 1.7, 0.0), (0.0, -0.2, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.1, 500.0)?;
/// let sun = Light::directional((0.4, 1.0, 0.2))?;
/// let scene = Scene::from_box((-200.0, 0.0, -200.0), (200.0, 30.0, 200.0))?;
/// let focus = Focus::new(&view, &sun, &scene);
/// assert_eq!((focus.view(), focus.light()), (&view, &sun));
///
/// let (receivers, casters) = (focus.receiver_volume(), focus.caster_volume(FocusForm::ReceiverHull));
/// assert!(receivers.vertices().iter().all(|&point| casters.intersects_sphere(point, 1e-9)));
/// let map = focus.fit(&Settings::default()).into_map().expect("receivers and casters");
/// assert!(map.clip_from_world().is_finite());
/// # Ok::<(), shadowfit::InputError>(())
/// ```
///
/// [`Focus::new`] copies its arguments; for a scene of lists it also passes once over the receivers and once over the casters.
/// Bodies are built when asked for.
#[doc(alias = "PSR")]
#[doc(alias = "potential shadow receivers")]
#[doc(alias = "focusing")]
#[doc(alias = "fit to scene")]
#[doc(alias = "fit to view")]
#[derive(Clone, Debug)]
pub struct Focus<'a> {
    pub(crate) view: View,
    pub(crate) light: Light,
    view_planes: FrustumPlanes,
    light_planes: LightPlanes,
    /// `None`: no receiver is in view and within reach of the light.
    pub(crate) receivers: Option<Region<'a>>,
    /// `None`: no caster can shadow a receiver.
    pub(crate) casters: Option<Region<'a>>,
    /// The list of casters, where casters and receivers have bounds of their own.
    pub(crate) caster_list: Option<Boxes<'a>>,
    /// Centre and radius of a ball around several views, where this focus stands for them.
    around: Option<(DVec3, f64)>,
    /// The listed receivers that take most of the image.
    standing: Standing,
    /// The surfaces that the camera sees, where they are known.
    pub(crate) seen: Option<Seen<'a>>,
    /// Planes around the receivers in view, which bound R besides those of V, S and L.
    cover: Cover,
}

/// Planes around the receivers in view.
#[derive(Clone, Copy, Debug)]
struct Cover {
    planes: [Plane; Self::MAX],
    len: usize,
}

impl Cover {
    const MAX: usize = 14;
    const NONE: Self = Self { planes: [Plane::ONE; Self::MAX], len: 0 };

    fn as_slice(&self) -> &[Plane] {
        &self.planes[..self.len]
    }

    fn push(&mut self, plane: Plane) {
        if let Some(slot) = self.planes.get_mut(self.len) {
            *slot = plane;
            self.len += 1;
        }
    }
}

/// The first name for planes of V, or of a window. Planes of L are named after those of the region, and planes of a hull after
/// those of L, which leaves as many names as possible.
pub(crate) const VIEW_IDS: PlaneId = Region::MAX_PLANES + Light::MAX_PLANES as PlaneId;

/// The first name for planes around what is seen.
const COVER_IDS: PlaneId = VIEW_IDS + FrustumPlanes::MAX as PlaneId;

impl<'a> Focus<'a> {
    /// Brings a view, a light and a scene together. For a scene of lists, bounds the receivers in view and within the light's
    /// reach, and the casters that can shadow them.
    ///
    /// ```
    /// use shadowfit::{Focus, Light, Scene, View};
    ///
    /// let view = View::perspective((0.0, 1.7, 0.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.1, 500.0)?;
    /// let behind = Scene::from_box((-5.0, 0.0, 10.0), (5.0, 3.0, 20.0))?;
    /// let focus = Focus::new(&view, &Light::directional((0.4, 1.0, 0.2))?, &behind);
    /// assert!(focus.receiver_volume().is_empty());
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn new(view: &View, light: &Light, scene: &Scene<'a>) -> Self {
        let mut focus = Self {
            view: *view,
            light: *light,
            view_planes: view.planes(),
            light_planes: light.planes(),
            receivers: None,
            casters: None,
            caster_list: None,
            around: None,
            standing: Standing::NONE,
            seen: None,
            cover: Cover::NONE,
        };
        match scene.bounds {
            Bounds::Nothing => {}
            Bounds::Box { min, max } => {
                focus.receivers = Some(Region::Box { min, max });
                focus.casters = focus.receivers;
            }
            Bounds::Convex(body) => {
                focus.receivers = Some(Region::Convex(body));
                focus.casters = focus.receivers;
            }
            Bounds::Lists { casters, receivers, extent } => {
                focus.caster_list = Some(casters);
                focus.gather(&casters, &receivers, extent);
            }
        }
        focus
    }

    /// Bounds the receivers in view and within the light's reach, then the casters that can shadow them; `extent` holds the largest
    /// absolute coordinates of the casters.
    fn gather(&mut self, casters: &Boxes<'_>, receivers: &Boxes<'_>, extent: DVec3) {
        let (view, view_planes, light_planes) = (self.view, self.view_planes, self.light_planes);
        let lit_view = || view_planes.iter().chain(light_planes.iter()).copied();
        let mut depths = narrow::Depths::of(&view);
        self.receivers = union(receivers, lit_view, |one| {
            depths.visit_box(one.min, one.max);
            self.standing.include(&view, one);
        });
        // A near plane in the air before the first receiver would waste texels there.
        if let Some(depths) = depths.found() {
            self.cover_depths(&depths);
        }
        if let Some(hull) = self.hull_of_visible(extent) {
            self.casters = union(casters, || hull.iter().chain(light_planes.iter()).copied(), |_| ());
        }
    }

    /// Removes all planes around what is seen.
    pub(crate) const fn clear_cover(&mut self) {
        self.cover = Cover::NONE;
    }

    /// Bounds R by a plane.
    pub(crate) fn push_cover(&mut self, plane: Plane) {
        self.cover.push(plane);
    }

    /// Bounds R by these depths before the eye.
    pub(crate) fn cover_depths(&mut self, depths: &Interval) {
        let depth = self.view.depth_row();
        if depths.min > self.view.near() {
            self.cover.push(depth - Plane::ONE * depths.min);
        }
        if depths.max < self.view.far() {
            self.cover.push(Plane::ONE * depths.max - depth);
        }
    }

    /// The view V.
    #[must_use]
    pub const fn view(&self) -> &View {
        &self.view
    }

    /// The light l, with its region L.
    #[must_use]
    pub const fn light(&self) -> &Light {
        &self.light
    }

    /// The receiver volume `R = V ∩ S ∩ L`, in world space: the part of the scene in view and within the light's reach. Empty
    /// without receivers; the map's window is fitted to it.
    ///
    /// ```
    /// use shadowfit::{Focus, Light, Scene, View};
    ///
    /// let view = View::orthographic((0.0, 50.0, 0.0), (0.0, -1.0, 0.0), (0.0, 0.0, -1.0), 10.0, 1.0, 0.0, 100.0)?;
    /// let scene = Scene::from_box((-200.0, 0.0, -200.0), (200.0, 5.0, 200.0))?;
    /// let focus = Focus::new(&view, &Light::directional((0.4, 1.0, 0.2))?, &scene);
    /// assert!((focus.receiver_volume().volume() - 20.0 * 20.0 * 5.0).abs() < 1e-6);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[doc(alias = "PSR")]
    #[doc(alias = "potential shadow receivers")]
    #[must_use]
    pub fn receiver_volume(&self) -> ConvexBody {
        let (mut body, mut planes) = (Polyhedron::EMPTY, [Plane::ONE; Polyhedron::MAX_PLANES]);
        self.cut_visible(&mut body, |plane, id| planes[usize::from(id)] = plane);
        ConvexBody::new(&body, planes)
    }

    /// R without the points within the near distance of a light that stands in a corner of R: the map holds no more.
    pub(crate) fn visible_beyond_light(&self) -> ConvexBody {
        let (mut body, mut planes) = (Polyhedron::EMPTY, [Plane::ONE; Polyhedron::MAX_PLANES]);
        self.cut_visible(&mut body, |plane, id| planes[usize::from(id)] = plane);
        if let Some(position) = self.light.position() {
            // Without such a corner, or without a map, R stays as it is.
            let _ =
                leave_corner(position, self.light.near(), &mut body, |plane, id| planes[usize::from(id)] = plane);
        }
        ConvexBody::new(&body, planes)
    }

    /// The caster volume H, the focus body, in world space: all casters whose shadow can fall on R touch it. Empty without
    /// receivers.
    ///
    /// With a scene of lists, S is here the bounds of the casters that can shadow R.
    ///
    /// ```
    /// use shadowfit::{Focus, FocusForm, Light, Scene, View};
    ///
    /// let view = View::perspective((0.0, 1.7, 0.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.1, 40.0)?;
    /// let scene = Scene::from_box((-200.0, 0.0, -200.0), (200.0, 30.0, 200.0))?;
    /// let focus = Focus::new(&view, &Light::directional((0.0, 1.0, 1.0))?, &scene);
    /// let casters = focus.caster_volume(FocusForm::ReceiverHull);
    /// assert!(casters.intersects_aabb((-1.0, 20.0, 10.0), (1.0, 25.0, 12.0))); // behind the eye, towards the sun
    /// assert!(!casters.intersects_aabb((-1.0, 0.0, 10.0), (1.0, 5.0, 12.0)));
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[doc(alias = "focus body")]
    #[doc(alias = "intersection body")]
    #[must_use]
    pub fn caster_volume(&self, form: FocusForm) -> ConvexBody {
        let (mut body, mut planes) = (Polyhedron::EMPTY, [Plane::ONE; Polyhedron::MAX_PLANES]);
        self.cut_body(&mut body, form, |plane, id| planes[usize::from(id)] = plane);
        ConvexBody::new(&body, planes)
    }

    /// A focus that stands for several, of one light and one scene: with one view, the bounds of all their receivers and casters,
    /// and a ball around all their views.
    pub(crate) fn standing_for(
        &self,
        view: View,
        [receivers, casters]: [Option<Region<'a>>; 2],
        around: Option<(DVec3, f64)>,
    ) -> Self {
        let (standing, seen, cover) = (Standing::NONE, None, Cover::NONE);
        Self { view, receivers, casters, around, standing, seen, cover, ..self.clone() }
    }

    /// A ball around V, or around all views that this focus stands for; `None` for an infinite far plane.
    pub(crate) fn ball(&self, image_height: u32) -> Option<(DVec3, f64)> {
        let around = self.around.filter(|(_, radius)| radius.is_finite());
        if self.around.is_some() { around } else { self.view.ball(image_height) }
    }

    /// S, unless the scene comes as lists: their bounds change with the view.
    pub(crate) fn scene(&self) -> Option<&Region<'a>> {
        if self.caster_list.is_some() { None } else { self.receivers.as_ref() }
    }

    /// Calls `each` with the planes of S and L, which bound R besides the view's own.
    pub(crate) fn for_each_plane(&self, mut each: impl FnMut(Plane)) {
        if let Some(region) = &self.receivers {
            region.for_each_plane(|plane, _| each(plane));
        }
        self.light_planes.iter().for_each(|plane| each(*plane));
        self.cover.as_slice().iter().for_each(|plane| each(*plane));
    }

    /// Sets a body to R and calls `each` with the planes that cut it.
    pub(crate) fn cut_visible(&self, body: &mut Polyhedron, each: impl FnMut(Plane, PlaneId)) {
        body.clear();
        if let Some(region) = &self.receivers {
            self.cut_visible_part(body, region, each);
        }
    }

    /// Sets a body to V ∩ L ∩ `region`.
    pub(crate) fn cut_visible_part(
        &self,
        body: &mut Polyhedron,
        region: &Region<'_>,
        mut each: impl FnMut(Plane, PlaneId),
    ) {
        let extent = self.cut_lit(body, region, &mut each);
        clip_all(body, self.view_planes.as_slice(), VIEW_IDS, extent, &mut each);
        clip_all(body, self.cover.as_slice(), COVER_IDS, extent, &mut each);
    }

    /// Sets a body to H and calls `each` with the planes that cut it.
    pub(crate) fn cut_body(&self, body: &mut Polyhedron, form: FocusForm, mut each: impl FnMut(Plane, PlaneId)) {
        body.clear();
        let Some(region) = &self.casters else { return };
        let hull = match form {
            FocusForm::ViewHull => {
                let l = self.light.homogeneous();
                Some(PlaneList::hull_of_frustum(&self.view_planes, l, region.extent()))
            }
            FocusForm::ReceiverHull => self.hull_of_visible(region.extent()),
        };
        if let Some(hull) = hull {
            let extent = self.cut_lit(body, region, &mut each);
            // Planes without a name are left out, which makes the hull larger.
            let first = self.light_ids(region).end;
            let named = hull.len().min(Polyhedron::MAX_PLANES - usize::from(first));
            clip_all(body, &hull[..named], first, extent, &mut each);
        }
    }

    /// Sets a body to S ∩ L. Returns the largest absolute coordinates in S.
    pub(crate) fn cut_lit(
        &self,
        body: &mut Polyhedron,
        region: &Region<'_>,
        mut each: impl FnMut(Plane, PlaneId),
    ) -> DVec3 {
        let extent = region.extent();
        region.fill(body);
        region.for_each_plane(&mut each);
        clip_all(body, self.light_planes.as_slice(), self.light_ids(region).start, extent, &mut each);
        extent
    }

    /// The names of L's planes where a region is cut by them.
    fn light_ids(&self, region: &Region<'_>) -> core::ops::Range<PlaneId> {
        let first = region.plane_count();
        first..first + self.light_planes.len() as PlaneId
    }

    /// hull(R, l) within `extent`, or `None` when R is empty.
    fn hull_of_visible(&self, extent: DVec3) -> Option<PlaneList> {
        // Planes that bound the casters anyway are left out.
        let of_light = self.light_ids(self.receivers.as_ref()?);
        let known = if self.caster_list.is_some() { of_light } else { 0..of_light.end };
        PlaneList::hull_of_body(&self.receiver_volume(), self.light.homogeneous(), extent, &known)
    }
}

/// Clips by planes with names from `first` on, each moved outwards by the bound on rounding.
pub(crate) fn clip_all(
    body: &mut Polyhedron,
    planes: &[Plane],
    first: PlaneId,
    extent: DVec3,
    mut each: impl FnMut(Plane, PlaneId),
) {
    for (id, plane) in (first..).zip(planes) {
        let plane = plane.loosened(extent);
        body.clip(&plane, id);
        each(plane, id);
    }
}

/// The bounds of all boxes that no plane excludes; `each` is called with them.
fn union<P: Iterator<Item = Plane>>(
    boxes: &Boxes<'_>,
    planes: impl Fn() -> P,
    mut each: impl FnMut(DAabb),
) -> Option<Region<'static>> {
    let (mut lowest, mut highest) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    boxes.for_each(|_, DAabb { min, max }| {
        let extent = min.abs().max(max.abs());
        let outside = |plane: Plane| plane.loosened(extent).at(farthest_corner(min, max, plane.normal)) < 0.0;
        if !planes().any(outside) {
            (lowest, highest) = (lowest.min(min), highest.max(max));
            each(DAabb { min, max });
        }
    });
    lowest.is_finite().then_some(Region::Box { min: lowest, max: highest })
}

/// The corner of a box that lies farthest along a direction.
pub(crate) fn farthest_corner(min: DVec3, max: DVec3, direction: DVec3) -> DVec3 {
    DVec3::select(direction.cmpge(DVec3::ZERO), max, min)
}

/// The planes of a hull with the light, as half-spaces without topology (`docs/design.md`, section 3).
///
/// Keep each plane π of the body with π·l ≥ 0; for each pair that meets in an edge with πᵢ·l > 0 > πⱼ·l add
///
/// ```text
///     πⱼ (πᵢ·l) − πᵢ (πⱼ·l)
/// ```
///
/// which passes through their edge and through l (Fourier–Motzkin elimination of the ray's parameter). Both factors are positive,
/// so that the sum contains the body whatever their rounding: a light in the plane of a face, on an edge or at the eye of a
/// frustum is no special case. For the sum to pass l, and so to contain the hull, the *relative* error of the factors counts
/// (`docs/numerics.md`): they are computed to [a few roundings of themselves](Plane::exactly_on), which the slack of the planes
/// covers.
#[derive(Clone, Debug)]
struct PlaneList {
    planes: [Plane; Self::MAX],
    len: usize,
}

impl PlaneList {
    /// More planes than hulls have; any beyond are left out, which makes the hull larger.
    const MAX: usize = 39;

    const EMPTY: Self = Self { planes: [Plane::ONE; Self::MAX], len: 0 };

    fn push(&mut self, plane: Plane) {
        if let Some(slot) = self.planes.get_mut(self.len) {
            *slot = plane;
            self.len += 1;
        }
    }

    fn push_silhouette(&mut self, towards: (Plane, f64), away: (Plane, f64)) {
        // Divided by their sum, against overflow and underflow.
        let sum = towards.1 - away.1;
        self.push(away.0 * (towards.1 / sum) - towards.0 * (away.1 / sum));
    }

    /// Adds silhouette planes: one for every pair of planes that `meet`, one facing the light and the other not.
    fn push_silhouettes(
        &mut self,
        planes: &[(Plane, f64)],
        towards: u64,
        away: u64,
        meet: impl Fn(usize, usize) -> bool,
    ) {
        for i in Bits(towards) {
            for j in Bits(away) {
                if meet(i, j) {
                    self.push_silhouette(planes[i], planes[j]);
                }
            }
        }
    }

    /// hull(V, l) within S, with largest absolute coordinates `extent`. Of a frustum's planes 0 and 1, 2 and 3, 4 and 5 are opposite
    /// and all other pairs meet. With oblique planes any two may meet; a pair that does not only adds a plane around the hull. An
    /// infinite far plane is the plane at infinity, with local lights inside: hull(V, l) then holds V translated to l.
    fn hull_of_frustum(frustum: &FrustumPlanes, l: DVec4, extent: DVec3) -> Self {
        let mut hull = Self::EMPTY;
        let all = frustum.with_infinity();
        let mut planes = [(Plane::ONE, 0.0); FrustumPlanes::MAX];
        for (slot, plane) in planes.iter_mut().zip(all) {
            *slot = with_value(*plane, l, extent);
        }
        for (plane, value) in &planes[..frustum.len()] {
            if *value >= 0.0 {
                hull.push(*plane);
            }
        }
        let side = |sign: f64| {
            (0..).zip(&planes[..all.len()]).fold(0, |set, (i, (_, value))| set | u64::from(sign * value > 0.0) << i)
        };
        let oblique = all.len() > 6;
        hull.push_silhouettes(&planes, side(1.0), side(-1.0), |i, j| oblique || i / 2 != j / 2);
        hull
    }

    /// hull(R, l) within `extent`, less the planes of R with `known` names, or `None` when R is empty.
    fn hull_of_body(body: &ConvexBody, l: DVec4, extent: DVec3, known: &core::ops::Range<PlaneId>) -> Option<Self> {
        if body.is_empty() {
            return None;
        }
        let mut hull = Self::EMPTY;
        let (planes, used) = body.plane_table();
        let mut with_values = [(Plane::ONE, 0.0); Polyhedron::MAX_PLANES];
        let (mut towards, mut away) = (0_u64, 0_u64);
        for bit in Bits(used) {
            let (plane, value) = with_value(planes[bit], l, extent);
            with_values[bit] = (plane, value);
            towards |= u64::from(value > 0.0) << bit;
            away |= u64::from(value < 0.0) << bit;
            if value >= 0.0 && !known.contains(&(bit as PlaneId)) {
                hull.push(plane);
            }
        }
        // The end planes of a segment share no edge, but bound its hull with a light in line with it.
        let is_segment = body.vertices().len() == 2;
        hull.push_silhouettes(&with_values, towards, away, |i, j| is_segment || body.meet(i, j));
        Some(hull)
    }
}

/// A plane moved outwards by the bound on rounding within `extent`, and the value at l of the plane itself.
fn with_value(plane: Plane, l: DVec4, extent: DVec3) -> (Plane, f64) {
    (plane.loosened(extent), plane.exactly_on(l))
}

impl core::ops::Deref for PlaneList {
    type Target = [Plane];
    fn deref(&self) -> &[Plane] {
        &self.planes[..self.len]
    }
}
