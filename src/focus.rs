//! The focus body H: every point that must appear in the shadow map.

use crate::convex::{Bits, Body, Plane, PlaneSet, Polyhedron};
use crate::light::{Light, LightPlanes};
use crate::scene::{Aabb, Bounds, Region, Scene};
use crate::view::{FrustumPlanes, View};
use glam::{DVec3, DVec4};

/// Two forms of the focus body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Form {
    /// `hull(V, l) ∩ S ∩ L`, as the paper has it (Stamminger & Drettakis 2002, §4.1). Right even when S does not hold
    /// every receiver.
    Paper,
    /// `hull(V ∩ S ∩ L, l) ∩ S ∩ L`: only what can shadow something that is in S, lit and in view. A part of the
    /// paper's body, and a much smaller one when the far plane lies beyond the scene.
    #[default]
    Tight,
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
    /// Whether casters and receivers have bounds of their own.
    separate: bool,
}

/// The bits of L's planes begin here …
const LIGHT_BITS: u32 = Region::BITS;
/// … and those of V or of a hull here.
pub(crate) const VIEW_BITS: u32 = LIGHT_BITS + Light::MAX_PLANES as u32;

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
            separate: matches!(scene.bounds, Bounds::Lists { .. }),
        };
        match scene.bounds {
            Bounds::Box { min, max } => {
                focus.receivers = Some(Region::Box { min, max });
                focus.casters = focus.receivers;
            }
            Bounds::Convex(body) => {
                focus.receivers = Some(Region::Convex(body));
                focus.casters = focus.receivers;
            }
            Bounds::Lists { casters, receivers } => focus.gather(casters, receivers),
        }
        focus
    }

    /// Bounds, from the lists, the receivers that can be visible and lit, then the casters that can touch those.
    fn gather(&mut self, casters: &[Aabb], receivers: &[Aabb]) {
        let lit_view = || self.view_planes.iter().chain(self.light_planes.iter()).copied();
        self.receivers = union(receivers, lit_view);
        if let Some(hull) = self.hull_of_visible() {
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
    pub fn visible(&self) -> Body {
        let mut planes = [Plane::ONE; 64];
        let polyhedron = self.visible_polyhedron(|plane, bit| planes[bit.trailing_zeros() as usize] = plane);
        Body::new(&polyhedron, planes)
    }

    /// The focus body in one of its forms.
    ///
    /// It bounds the casters: with a scene of lists, S here is the bound of those casters that can touch what is
    /// visible.
    #[must_use]
    pub fn body(&self, form: Form) -> Body {
        let mut planes = [Plane::ONE; 64];
        let polyhedron = self.body_polyhedron(form, |plane, bit| planes[bit.trailing_zeros() as usize] = plane);
        Body::new(&polyhedron, planes)
    }

    /// R, telling `each` which planes made it.
    pub(crate) fn visible_polyhedron<const N: usize>(
        &self,
        mut each: impl FnMut(Plane, PlaneSet),
    ) -> Polyhedron<N> {
        let Some(region) = self.receivers else { return Polyhedron::from_vertices(&[]) };
        let extent = region.extent();
        let mut body = self.lit_polyhedron(&region, extent, &mut each);
        clip_all(&mut body, &self.view_planes, VIEW_BITS, extent, &mut each);
        body
    }

    /// H, telling `each` which planes made it.
    pub(crate) fn body_polyhedron<const N: usize>(
        &self,
        form: Form,
        mut each: impl FnMut(Plane, PlaneSet),
    ) -> Polyhedron<N> {
        let hull = match form {
            Form::Paper => PlaneList::hull_of_frustum(&self.view_planes, self.light.homogeneous()),
            Form::Tight => self.hull_of_visible(),
        };
        let (Some(region), Some(hull)) = (self.casters, hull) else { return Polyhedron::from_vertices(&[]) };
        let extent = region.extent();
        let mut body = self.lit_polyhedron(&region, extent, &mut each);
        clip_all(&mut body, &hull, VIEW_BITS, extent, &mut each);
        body
    }

    /// hull(R, l), or `None` when R is empty.
    fn hull_of_visible(&self) -> Option<PlaneList> {
        // Planes that bound the casters anyway need not bound them twice.
        let known = if self.separate { LIGHT_BITS..VIEW_BITS } else { 0..VIEW_BITS };
        PlaneList::hull_of_body(&self.visible(), self.light.homogeneous(), &known)
    }

    /// S ∩ L.
    pub(crate) fn lit_polyhedron<const N: usize>(
        &self,
        region: &Region<'_>,
        extent: DVec3,
        mut each: impl FnMut(Plane, PlaneSet),
    ) -> Polyhedron<N> {
        let mut body = region.polyhedron();
        region.for_each_plane(&mut each);
        clip_all(&mut body, &self.light_planes, LIGHT_BITS, extent, &mut each);
        body
    }
}

/// Clips by planes whose bits begin at `first`, each moved outwards by what rounding can do.
pub(crate) fn clip_all<const N: usize>(
    body: &mut Polyhedron<N>,
    planes: &[Plane],
    first: u32,
    extent: DVec3,
    each: &mut impl FnMut(Plane, PlaneSet),
) {
    for (plane, bit) in planes.iter().zip((first..).map(|bit| 1 << bit)) {
        let plane = plane.loosened(extent);
        body.clip(&plane, bit);
        each(plane, bit);
    }
}

/// The bound of those boxes that are not wholly outside one of the planes.
fn union<P: Iterator<Item = Plane>>(boxes: &[Aabb], planes: impl Fn() -> P) -> Option<Region<'static>> {
    let (mut lowest, mut highest) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for one in boxes {
        let (min, max) = (one.min.as_dvec3(), one.max.as_dvec3());
        let extent = min.abs().max(max.abs());
        let outside = |plane: Plane| plane.loosened(extent).at(farthest_corner(min, max, plane.normal)) < 0.0;
        if !planes().any(outside) {
            (lowest, highest) = (lowest.min(min), highest.max(max));
        }
    }
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
#[derive(Clone, Debug)]
struct PlaneList {
    planes: [Plane; Self::MAX],
    len: usize,
}

impl PlaneList {
    /// The bits left for a hull. Planes past them are left out, which makes the hull larger.
    const MAX: usize = (PlaneSet::BITS - VIEW_BITS) as usize;

    const EMPTY: Self = Self { planes: [Plane::ONE; Self::MAX], len: 0 };

    fn push(&mut self, plane: Plane) {
        if let Some(slot) = self.planes.get_mut(self.len) {
            *slot = plane;
            self.len += 1;
        }
    }

    fn push_silhouette(&mut self, towards: (Plane, f64), away: (Plane, f64)) {
        self.push(away.0 * towards.1 - towards.0 * away.1);
    }

    /// hull(V, l). A frustum's edges are known: planes 0 and 1, 2 and 3, 4 and 5 face each other and all others meet.
    fn hull_of_frustum(frustum: &FrustumPlanes, l: DVec4) -> Option<Self> {
        let mut hull = Self::EMPTY;
        let mut values = [0.0; 6];
        for (plane, value) in frustum.iter().zip(&mut values) {
            *value = plane.on(l);
            if *value >= 0.0 {
                hull.push(*plane);
            }
        }
        for (i, towards) in frustum.iter().enumerate() {
            for (j, away) in frustum.iter().enumerate() {
                if values[i] > 0.0 && values[j] < 0.0 && i / 2 != j / 2 {
                    hull.push_silhouette((*towards, values[i]), (*away, values[j]));
                }
            }
        }
        Some(hull)
    }

    /// hull(R, l), less the planes of R at the `known` bits, or `None` when R is empty.
    fn hull_of_body(body: &Body, l: DVec4, known: &core::ops::Range<u32>) -> Option<Self> {
        if body.is_empty() {
            return None;
        }
        let mut hull = Self::EMPTY;
        let (planes, used) = body.plane_table();
        let mut towards: PlaneSet = 0;
        let mut away: PlaneSet = 0;
        for bit in Bits(used) {
            let value = planes[bit].on(l);
            towards |= PlaneSet::from(value > 0.0) << bit;
            away |= PlaneSet::from(value < 0.0) << bit;
            if value >= 0.0 && !known.contains(&(bit as u32)) {
                hull.push(planes[bit]);
            }
        }
        for i in Bits(towards) {
            for j in Bits(away) {
                if body.meet(i, j) {
                    hull.push_silhouette((planes[i], planes[i].on(l)), (planes[j], planes[j].on(l)));
                }
            }
        }
        Some(hull)
    }
}

impl core::ops::Deref for PlaneList {
    type Target = [Plane];
    fn deref(&self) -> &[Plane] {
        &self.planes[..self.len]
    }
}
