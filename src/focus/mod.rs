//! The focus body H: every point that must appear in the shadow map.

use crate::convex::{Bits, PlaneId, Polyhedron};
pub(crate) mod cone;
mod cull;
mod narrow;
pub(crate) mod surrounded;

pub use crate::convex::{ConvexBody, Face, Plane};
use crate::focus::cone::leave_corner;
use crate::input::light::{Light, LightPlanes};
use crate::input::scene::{Bounds, Boxes, DAabb, Region, Scene};
use crate::input::view::{FrustumPlanes, View};
pub use cull::Culler;
use glam::{DVec3, DVec4};

/// Two forms of the focus body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum FocusForm {
    /// `hull(V, l) ∩ S ∩ L`, as the paper has it (Stamminger & Drettakis 2002, §4.1). Right even when S does not hold
    /// every receiver.
    ViewHull,
    /// `hull(V ∩ S ∩ L, l) ∩ S ∩ L`: only what can shadow something that is in S, lit and in view. A part of the
    /// paper's body, and a much smaller one when the far plane lies beyond the scene.
    #[default]
    ReceiverHull,
}

/// A view, a light and a scene brought together: what is visible and lit, and what can cast on it.
///
/// ```text
///                l            R = V ∩ S ∩ L      what is visible and can be lit
///                ∗            H = hull(R, l) ∩ S ∩ L
///               ╱ ╲           what must be in the map
///     ┌────────╱───╲──── S
///     │       ╱  H  ╲  │
///   eye ◁────╱───────╲─┤
///     │     ╲    R    ╲│
///     └──────╲─────────┘
/// ```
///
/// Making one costs a few copies, or, for a scene of lists, one pass over the receivers and one over the casters.
/// Bodies are made when asked for.
#[derive(Clone, Debug)]
pub struct Focus<'a> {
    pub(crate) view: View,
    pub(crate) light: Light,
    view_planes: FrustumPlanes,
    light_planes: LightPlanes,
    /// `None`: nothing that receives is in view and lit.
    pub(crate) receivers: Option<Region<'a>>,
    /// `None`: nothing can cast on what is visible.
    pub(crate) casters: Option<Region<'a>>,
    /// The list of casters, where casters and receivers have bounds of their own.
    pub(crate) caster_list: Option<Boxes<'a>>,
    /// A ball around all that several views see, where this stands for them: its middle and its radius.
    around: Option<(DVec3, f64)>,
}

/// The names of the planes of V, or of a window, begin here. Those of L follow those of the region, and those of a hull those of
/// L, so that as many as can be have one.
pub(crate) const VIEW_IDS: PlaneId = Region::MAX_PLANES + Light::MAX_PLANES as PlaneId;

impl<'a> Focus<'a> {
    /// Brings a view, a light and a scene together.
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

    /// Bounds, from the lists, the receivers that can be visible and lit, then the casters, with coordinates no larger than
    /// `extent`, that can touch those.
    fn gather(&mut self, casters: &Boxes<'_>, receivers: &Boxes<'_>, extent: DVec3) {
        let lit_view = || self.view_planes.iter().chain(self.light_planes.iter()).copied();
        self.receivers = union(receivers, lit_view);
        if let Some(hull) = self.hull_of_visible(extent) {
            self.casters = union(casters, || hull.iter().chain(self.light_planes.iter()).copied());
        }
    }

    /// The view that was brought in.
    #[must_use]
    pub const fn view(&self) -> &View {
        &self.view
    }

    /// The light that was brought in.
    #[must_use]
    pub const fn light(&self) -> &Light {
        &self.light
    }

    /// `R = V ∩ S ∩ L`: what is visible and can be lit.
    #[must_use]
    pub fn receiver_volume(&self) -> ConvexBody {
        let (mut body, mut planes) = (Polyhedron::EMPTY, [Plane::ONE; Polyhedron::MAX_PLANES]);
        self.cut_visible(&mut body, |plane, id| planes[usize::from(id)] = plane);
        ConvexBody::new(&body, planes)
    }

    /// R, less what is nearer to a light in a corner of it than the light's near distance: the map is for no more.
    pub(crate) fn visible_beyond_light(&self) -> ConvexBody {
        let (mut body, mut planes) = (Polyhedron::EMPTY, [Plane::ONE; Polyhedron::MAX_PLANES]);
        self.cut_visible(&mut body, |plane, id| planes[usize::from(id)] = plane);
        if let Some(position) = self.light.position() {
            // Where there is no such corner, or no map, R is as it was.
            let _ =
                leave_corner(position, self.light.near(), &mut body, |plane, id| planes[usize::from(id)] = plane);
        }
        ConvexBody::new(&body, planes)
    }

    /// The focus body in one of its forms.
    ///
    /// It bounds the casters: with a scene of lists, S here is the bound of those casters that can touch what is
    /// visible.
    #[must_use]
    pub fn caster_volume(&self, form: FocusForm) -> ConvexBody {
        let (mut body, mut planes) = (Polyhedron::EMPTY, [Plane::ONE; Polyhedron::MAX_PLANES]);
        self.cut_body(&mut body, form, |plane, id| planes[usize::from(id)] = plane);
        ConvexBody::new(&body, planes)
    }

    /// What stands for several of its kind, of one light and one scene: seen by one view, with all of their receivers and
    /// casters, and a ball around all that they see.
    pub(crate) fn standing_for(
        &self,
        view: View,
        [receivers, casters]: [Option<Region<'a>>; 2],
        around: Option<(DVec3, f64)>,
    ) -> Self {
        Self { view, receivers, casters, around, ..self.clone() }
    }

    /// A ball around V, or around all views that this stands for; none without an end.
    pub(crate) fn ball(&self, image_height: u32) -> Option<(DVec3, f64)> {
        let around = self.around.filter(|(_, radius)| radius.is_finite());
        if self.around.is_some() { around } else { self.view.ball(image_height) }
    }

    /// S itself, unless casters and receivers have lists: what is known of those changes with the view.
    pub(crate) fn scene(&self) -> Option<&Region<'a>> {
        if self.caster_list.is_some() { None } else { self.receivers.as_ref() }
    }

    /// Calls `each` with the planes of S and L that bound what is visible besides the view's own.
    pub(crate) fn for_each_plane(&self, mut each: impl FnMut(Plane)) {
        if let Some(region) = &self.receivers {
            region.for_each_plane(|plane, _| each(plane));
        }
        self.light_planes.iter().for_each(|plane| each(*plane));
    }

    /// Makes R of any body, telling `each` which planes bound it.
    pub(crate) fn cut_visible(&self, body: &mut Polyhedron, each: impl FnMut(Plane, PlaneId)) {
        body.clear();
        if let Some(region) = &self.receivers {
            self.cut_visible_part(body, region, each);
        }
    }

    /// Makes V ∩ L ∩ `region` of any body.
    pub(crate) fn cut_visible_part(
        &self,
        body: &mut Polyhedron,
        region: &Region<'_>,
        mut each: impl FnMut(Plane, PlaneId),
    ) {
        let extent = self.cut_lit(body, region, &mut each);
        clip_all(body, self.view_planes.as_slice(), VIEW_IDS, extent, &mut each);
    }

    /// Makes H of any body, telling `each` which planes bound it.
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

    /// Makes S ∩ L of any body. Returns the largest absolute coordinates in S.
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
        // Planes that bound the casters anyway need not bound them twice.
        let of_light = self.light_ids(self.receivers.as_ref()?);
        let known = if self.caster_list.is_some() { of_light } else { 0..of_light.end };
        PlaneList::hull_of_body(&self.receiver_volume(), self.light.homogeneous(), extent, &known)
    }
}

/// Clips by planes whose names begin at `first`, each moved outwards by what rounding can do.
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

/// The bound of those boxes that are not wholly outside one of the planes.
fn union<P: Iterator<Item = Plane>>(boxes: &Boxes<'_>, planes: impl Fn() -> P) -> Option<Region<'static>> {
    let (mut lowest, mut highest) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    boxes.for_each(|_, DAabb { min, max }| {
        let extent = min.abs().max(max.abs());
        let outside = |plane: Plane| plane.loosened(extent).at(farthest_corner(min, max, plane.normal)) < 0.0;
        if !planes().any(outside) {
            (lowest, highest) = (lowest.min(min), highest.max(max));
        }
    });
    lowest.is_finite().then_some(Region::Box { min: lowest, max: highest })
}

/// The corner of a box that lies farthest along a direction.
pub(crate) fn farthest_corner(min: DVec3, max: DVec3, direction: DVec3) -> DVec3 {
    DVec3::select(direction.cmpge(DVec3::ZERO), max, min)
}

/// The planes of a hull with the light, as half-spaces without topology.
///
/// Keep each plane π of the body with π·l ≥ 0; for each pair that meets in an edge with πᵢ·l > 0 > πⱼ·l add
///
/// ```text
///     πⱼ (πᵢ·l) − πᵢ (πⱼ·l)
/// ```
///
/// which passes through their edge and through l (Fourier–Motzkin elimination of the ray's parameter). No division, no
/// walk around the silhouette, point and directional lights alike. Both factors are positive, so that the sum contains
/// the body whatever rounding did to them: a light in the plane of a face, on an edge, or at the eye of a frustum needs
/// no care.
///
/// It contains the hull if it passes l too, and what counts there is how exact the factors are in themselves. A factor
/// that is off by ρ of itself moves the sum at a point Y by no more than ρ times its term at Y; one off by so much in
/// absolute terms turns the sum about the edge, which may be as far from Y as the far plane is, and misses Y by any
/// amount. So the values are [right to a few roundings of themselves](Plane::exactly_on), and the slack that each plane
/// brings along covers them at Y; where a sum of planes cancels, their slack does not.
#[derive(Clone, Debug)]
struct PlaneList {
    planes: [Plane; Self::MAX],
    len: usize,
}

impl PlaneList {
    /// More than hulls have: planes past them are left out, which makes the hull larger.
    const MAX: usize = 39;

    const EMPTY: Self = Self { planes: [Plane::ONE; Self::MAX], len: 0 };

    fn push(&mut self, plane: Plane) {
        if let Some(slot) = self.planes.get_mut(self.len) {
            *slot = plane;
            self.len += 1;
        }
    }

    fn push_silhouette(&mut self, towards: (Plane, f64), away: (Plane, f64)) {
        // By their sum, so that factors of any size keep their digits.
        let sum = towards.1 - away.1;
        self.push(away.0 * (towards.1 / sum) - towards.0 * (away.1 / sum));
    }

    /// The silhouettes between the planes of a body that face the light and those that do not, where they `meet`.
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

    /// hull(V, l) within S, whose largest absolute coordinates are `extent`. A frustum's edges are known: planes 0 and 1,
    /// 2 and 3, 4 and 5 face each other and all others meet. With oblique planes any two may meet; a pair that does not adds
    /// a plane around the hull. An infinite far plane is the plane at infinity, which a
    /// light at a position is inside of: hull(V, l) then holds all of V moved to begin at l.
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
        // A segment's ends have no edge in common, and bound its hull with a light in line with it all the same.
        let is_segment = body.vertices().len() == 2;
        hull.push_silhouettes(&with_values, towards, away, |i, j| is_segment || body.meet(i, j));
        Some(hull)
    }
}

/// A plane, moved outwards by what rounding can do inside of `extent`, and its value at l before that.
fn with_value(plane: Plane, l: DVec4, extent: DVec3) -> (Plane, f64) {
    (plane.loosened(extent), plane.exactly_on(l))
}

impl core::ops::Deref for PlaneList {
    type Target = [Plane];
    fn deref(&self) -> &[Plane] {
        &self.planes[..self.len]
    }
}
