//! What every contender is given: a view, a light, and the bounds of a scene.

use anyhow::{Context as _, Result};
use shadowfit::glam::{DVec3, Vec3};
use shadowfit::{Light, Scene, View, focus::Plane};

/// A view, a light and a scene, in all the forms that contenders ask for.
#[derive(Clone, Debug)]
pub(crate) struct Case<'a> {
    pub(crate) view: View,
    pub(crate) light: Light,
    /// The scene's bounds as the crate takes them: one box or convex body.
    pub(crate) scene: Scene<'a>,
    /// The same as lists of casters and of receivers, where there are any.
    pub(crate) lists: Option<Scene<'a>>,
    /// The box around the scene.
    pub(crate) bounds: (DVec3, DVec3),
    /// Planes that cut that box, inside ≥ 0.
    pub(crate) cuts: Vec<Plane>,
    /// The corners of the view, whose far plane, where it is infinite, stands at the scene's end: near then far, each left-bottom, right-bottom, left-top, right-top.
    pub(crate) corners: [DVec3; 8],
}

impl<'a> Case<'a> {
    /// A case of a scene inside a box, cut by planes.
    ///
    /// # Errors
    ///
    /// Where the view cannot be drawn in to the scene.
    pub(crate) fn new(
        view: View,
        light: Light,
        scene: Scene<'a>,
        bounds: (DVec3, DVec3),
        cuts: Vec<Plane>,
    ) -> Result<Self> {
        let last = corners_of(bounds).into_iter().map(|corner| view.depth(corner)).fold(0.0, f64::max);
        let far = if view.far().is_finite() { view.far() } else { last.max(2.0 * view.near()) };
        let drawn_in = view.narrowed(view.near(), far).context("the view cannot end behind the scene")?;
        let corners = drawn_in.corners().context("the view has no corners")?;
        Ok(Self { view, light, scene, lists: None, bounds, cuts, corners })
    }

    /// The same with lists.
    #[must_use]
    pub(crate) fn with_lists(self, lists: Scene<'a>) -> Self {
        Self { lists: Some(lists), ..self }
    }

    /// The unit direction towards a light that is infinitely far away.
    pub(crate) fn direction_to_light(&self) -> Option<DVec3> {
        self.light.position().is_none().then(|| self.light.homogeneous().truncate())
    }

    /// The planes of S, inside ≥ 0.
    pub(crate) fn scene_planes(&self) -> Vec<Plane> {
        [&box_planes(self.bounds)[..], &self.cuts].concat()
    }
}

/// The planes of a box, inside ≥ 0.
pub(crate) fn box_planes((min, max): (DVec3, DVec3)) -> [Plane; 6] {
    let [x, y, z] = DVec3::AXES;
    [
        Plane::new(x, -min.x),
        Plane::new(-x, max.x),
        Plane::new(y, -min.y),
        Plane::new(-y, max.y),
        Plane::new(z, -min.z),
        Plane::new(-z, max.z),
    ]
}

/// The corners of a box.
pub(crate) fn corners_of((min, max): (DVec3, DVec3)) -> [DVec3; 8] {
    std::array::from_fn(|corner| {
        let end = |axis: usize| if corner >> axis & 1 == 0 { min[axis] } else { max[axis] };
        DVec3::new(end(0), end(1), end(2))
    })
}

/// The corner of a box that lies farthest along a direction.
pub(crate) fn farthest_corner(min: DVec3, max: DVec3, direction: DVec3) -> DVec3 {
    DVec3::select(direction.cmpge(DVec3::ZERO), max, min)
}

/// A box in f64.
pub(crate) fn in_f64(one: &shadowfit::Aabb) -> (DVec3, DVec3) {
    let wide = |corner: Vec3| corner.as_dvec3();
    (wide(one.min), wide(one.max))
}
