//! One map for several views: two eyes, a split screen, a mirror beside the main view.

use crate::convex::{ConvexBody, Polyhedron};
use crate::error::{InputError, InputErrorKind, check};
use crate::fit::{Empty, Outcome, fit_receivers};
use crate::focus::{Focus, FocusForm};
use crate::input::light::Light;
use crate::input::scene::{Region, Scene};
use crate::input::view::View;
use crate::map::aliasing::Aliasing;
use crate::map::shadow_map::ShadowMap;
use crate::math::bounds::{Interval, most};
use crate::math::list::list;
use crate::settings::{Settings, Shift, Warp};
use crate::warp::virtual_camera::VirtualCamera;
use glam::DVec3;

/// Several views, a light and a scene brought together, for one map that serves all of the views.
///
/// R is the receiver volume of any of them, H the caster volume of any. The map's window and depth range hold all of it,
/// the convex hull of the parts of R on the light's rays, so that views which overlap share texels, and views far apart
/// waste those between them; [`Self::sharing`] says which it is. Each view's own [`Focus`] is an element of this.
///
/// ```
/// use shadowfit::{FocusForm, Light, Outcome, Scene, Settings, View, multiview::SharedFocus};
///
/// let eye = |x: f64| View::perspective((x, 1.7, 0.0), (x, 0.0, -1.0), (0.0, 1.0, 0.0), 1.5, 0.9, 0.1, 60.0);
/// let sun = Light::directional((0.4, 1.0, 0.2))?;
/// let scene = Scene::from_box((-50.0, 0.0, -50.0), (50.0, 20.0, 50.0))?;
/// let eyes = SharedFocus::new(&[eye(-0.032)?, eye(0.032)?], &sun, &scene)?;
/// let settings = Settings::default();
/// assert!(eyes.sharing(&settings).is_worth_it());
/// if let Outcome::Map(map) = eyes.fit(&settings) {
///     // Draw the casters of either eye.
///     let draws = eyes.bodies(FocusForm::ReceiverHull).any(|body| body.intersects_aabb((0.0, 0.0, -9.0), (1.0, 1.0, -8.0)));
///     assert!(draws && eyes.aliasing_over(&map).is_some());
/// }
/// # Ok::<(), shadowfit::InputError>(())
/// ```
#[doc(alias = "stereo")]
#[doc(alias = "VR")]
#[doc(alias = "split screen")]
#[derive(Clone, Debug)]
pub struct SharedFocus<'a> {
    parts: [Focus<'a>; SharedFocus::MAX],
    len: usize,
}

/// The cost of one map for several views beside that of one for each ([`SharedFocus::sharing`]), as the number of texels that
/// would bring texels to the size of pixels, over that of a map of the settings' size.
///
/// ```
/// use shadowfit::multiview::Sharing;
///
/// assert!(Sharing { shared: 3.0, separate: 5.5 }.is_worth_it());
/// assert!(!Sharing { shared: f64::INFINITY, separate: 5.5 }.is_worth_it()); // no frustum holds all receivers
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Sharing {
    /// Of one map for all views; infinite where no frustum holds all receivers, 0 where no map is needed.
    #[cfg_attr(feature = "serde", serde(with = "crate::math::infinity"))]
    pub shared: f64,
    /// Of one map for each view, together.
    #[cfg_attr(feature = "serde", serde(with = "crate::math::infinity"))]
    pub separate: f64,
}

impl Sharing {
    /// Whether one map for all views is the cheaper way. It has to save a tenth of the texels: less is not worth it, as each
    /// view's texels then depend on where the others look.
    #[must_use]
    pub fn is_worth_it(&self) -> bool {
        const WORTH: f64 = 1.1;
        self.shared.is_finite() && self.shared * WORTH <= self.separate
    }
}

/// Receivers nearer to the first view's camera plane than this part of the least near distance make the views too different
/// for its perspective.
const BEFORE: f64 = 0.5;

impl<'a> SharedFocus<'a> {
    /// The most views.
    pub const MAX: usize = 4;

    /// Brings one to [`Self::MAX`] views, a light and a scene together.
    ///
    /// # Errors
    ///
    /// Names `"views"` when there are none or too many.
    ///
    /// ```
    #[doc = include_str!("examples/sun.txt")]
    /// use shadowfit::multiview::SharedFocus;
    ///
    /// let shared = SharedFocus::new(&[view, view.narrowed(0.1, 20.0)?], &sun, &scene)?;
    /// assert_eq!((shared.len(), shared[0].view()), (2, &view));
    /// assert!(SharedFocus::new(&[], &sun, &scene).is_err());
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    pub fn new(views: &[View], light: &Light, scene: &Scene<'a>) -> Result<Self, InputError> {
        let Some((first, others)) = views.split_first() else {
            return check::fail("views", InputErrorKind::Empty);
        };
        if views.len() > Self::MAX {
            return check::fail("views", InputErrorKind::TooMany);
        }
        let first = Focus::new(first, light, scene);
        let mut parts = [(); Self::MAX].map(|()| first.clone());
        for (part, view) in parts[1..].iter_mut().zip(others) {
            *part = Focus::new(view, light, scene);
        }
        Ok(Self { parts, len: views.len() })
    }

    /// Fits one map to the receivers of all views.
    ///
    /// Warps follow the first view where all receivers lie before its camera; otherwise all pixels count the same.
    /// [`Origin::Eye`](crate::Origin::Eye) is the first view's; [`ShadowMap::aliasing`] and the like are for the first view,
    /// [`Self::aliasing_over`] for all. A stable map has room for all views as they stand to each other, and keeps its grid
    /// while that stays the same.
    ///
    /// ```
    #[doc = include_str!("examples/sun.txt")]
    /// use shadowfit::multiview::SharedFocus;
    ///
    /// let other = View::perspective((6.0, 1.7, 0.0), (0.0, -0.2, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.1, 50.0)?;
    /// let map = SharedFocus::new(&[view, other], &sun, &scene)?.fit(&settings).into_map().expect("receivers");
    /// for ground in [ground, ground + 6.0 * DVec3::X] {
    ///     let place = map.texture_from_world().project_point3(ground);
    ///     assert!(place.min_element() > 0.0 && place.max_element() < 1.0);
    /// }
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn fit(&self, settings: &Settings) -> Outcome {
        if let [one] = self.as_slice() {
            return one.fit(settings);
        }
        let mut visible = self.visible();
        if visible.is_empty() {
            return Outcome::Empty(Empty::NoReceivers);
        }
        let Some(casters) = self.casters() else {
            return Outcome::Empty(Empty::NoCasters);
        };
        let first = *self[0].view();
        let around = Some(self.ball(settings.image_height()));
        let regions = [self.region(|part| part.receivers), Some(casters)];
        let whole = self[0].standing_for(self.carrier(&visible), regions, around);
        let depths = match (settings.warp(), settings.shift()) {
            (Warp::Perspective | Warp::Best(_), Shift::Back(form)) => Some(self.depths(form, whole.view())),
            _ => None,
        };
        match fit_receivers(&whole, &mut visible, &casters, depths, None, settings) {
            Outcome::Map(map) => Outcome::Map(ShadowMap { view: first, ..map }),
            other => other,
        }
    }

    /// The caster volumes of the views, in one of their forms: a caster that touches none of them need not be drawn.
    ///
    /// ```
    #[doc = include_str!("examples/sun.txt")]
    /// use shadowfit::multiview::SharedFocus;
    ///
    /// let shared = SharedFocus::new(&[view, view], &sun, &scene)?;
    /// assert_eq!(shared.bodies(FocusForm::ReceiverHull).count(), 2);
    /// assert!(shared.bodies(FocusForm::ReceiverHull).all(|body| body.contains(ground + 0.1 * up)));
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    pub fn bodies(&self, form: FocusForm) -> impl Iterator<Item = ConvexBody> {
        self.iter().map(move |part| part.caster_volume(form))
    }

    /// The worst aliasing of a map of [`Self::fit`] over the receivers of all views, each point in the pixels of the view
    /// that sees it, and the mean of the views' means. `None` without receivers. See [`ShadowMap::aliasing_over`].
    ///
    /// ```
    #[doc = include_str!("examples/sun.txt")]
    /// use shadowfit::multiview::SharedFocus;
    ///
    /// let shared = SharedFocus::new(&[view, view], &sun, &scene)?;
    /// let map = shared.fit(&settings).into_map().expect("receivers");
    /// let (both, one) = (shared.aliasing_over(&map).expect("receivers"), map.aliasing_over(&shared[0]).expect("receivers"));
    /// assert_eq!(both.worst, one.worst); // the same view twice
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn aliasing_over(&self, map: &ShadowMap) -> Option<Aliasing> {
        let (mut found, mut sum, mut count): (Option<Aliasing>, _, _) = (None, 0.0, 0.0);
        for part in self.iter() {
            let Some(one) = seen_by(part, map).aliasing_over(part) else { continue };
            (sum, count) = (sum + one.mean, count + 1.0);
            let upper_bound = most(one.upper_bound, found.map_or(0.0, |found| found.upper_bound));
            let worst = found.filter(|found| found.worst >= one.worst).unwrap_or(one);
            found = Some(Aliasing { upper_bound, ..worst });
        }
        found.map(|found| Aliasing { mean: sum / count, ..found })
    }

    /// The cost of one map for all views beside that of one for each.
    ///
    /// Texels are compared as the planner compares them, by the geometric mean of the worst and the mean aliasing over the
    /// vertices of each R; their number goes with its square. It fits one map more than there are views.
    ///
    /// ```
    #[doc = include_str!("examples/sun.txt")]
    /// use shadowfit::multiview::SharedFocus;
    ///
    /// let sharing = SharedFocus::new(&[view, view], &sun, &scene)?.sharing(&settings);
    /// assert!(sharing.is_worth_it() && sharing.shared < 0.51 * sharing.separate); // the same view twice
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn sharing(&self, settings: &Settings) -> Sharing {
        let cost = |outcome: &Outcome, parts: &[Focus<'_>]| match outcome {
            Outcome::Map(map) => cost(map, parts),
            Outcome::Empty(_) => 0.0,
            Outcome::Surrounded(_) => f64::INFINITY,
        };
        Sharing {
            shared: cost(&self.fit(settings), self.as_slice()),
            separate: self.as_slice().chunks(1).map(|part| cost(&part[0].fit(settings), part)).sum(),
        }
    }

    /// The receiver volumes of the views, each as a body of its own. Where they have more vertices than there is room
    /// for, the largest count as their bounding boxes.
    fn visible(&self) -> Polyhedron {
        const EACH: u32 = (Polyhedron::MAX_VERTICES / SharedFocus::MAX) as u32;
        let (mut all, mut one) = (Polyhedron::EMPTY, Polyhedron::EMPTY);
        let fits = self.iter().all(|part| {
            part.cut_visible(&mut one, |_, _| ());
            all.append(&one)
        });
        if fits {
            return all;
        }
        all.clear();
        for part in self.iter() {
            part.cut_visible(&mut one, |_, _| ());
            if one.len() > EACH {
                let (mut min, mut max) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
                one.positions().for_each(|point| (min, max) = (min.min(point), max.max(point)));
                one.set_box(min, max);
            }
            all.append(&one);
        }
        all
    }

    fn region(&self, of: impl Fn(&Focus<'a>) -> Option<Region<'a>>) -> Option<Region<'a>> {
        self.iter().filter_map(of).reduce(|one, other| match (one, other) {
            (Region::Box { min, max }, Region::Box { min: low, max: high }) => {
                Region::Box { min: min.min(low), max: max.max(high) }
            }
            // Of a convex scene it is all of it, whatever the view.
            (convex, _) => convex,
        })
    }

    /// The region of all casters.
    fn casters(&self) -> Option<Region<'a>> {
        self.region(|part| part.casters)
    }

    /// The depths of H before a view, of all views together.
    fn depths(&self, form: FocusForm, view: &View) -> Interval {
        let (mut body, mut depths) = (Polyhedron::EMPTY, Interval::EMPTY);
        for part in self.iter() {
            part.cut_body(&mut body, form, |_, _| ());
            let of_part = VirtualCamera::depths(view, body.positions());
            if of_part.min <= of_part.max {
                depths.include(of_part.min);
                depths.include(of_part.max);
            }
        }
        depths
    }

    /// The view that stands for all: the first, where all receivers lie before it, or one in whose image everything has
    /// the same size.
    fn carrier(&self, visible: &Polyhedron) -> View {
        let first = self[0].view();
        let depths = VirtualCamera::depths(first, visible.positions());
        let near = self.iter().map(|part| part.view().near()).fold(f64::INFINITY, f64::min);
        if self.len == 1 || depths.min >= BEFORE * near {
            return *first;
        }
        first.without_perspective(&depths)
    }

    /// A ball around all views; of infinite radius where one has no end.
    fn ball(&self, image_height: u32) -> (DVec3, f64) {
        let balls = self.iter().map(|part| part.view().ball(image_height).unwrap_or((DVec3::ZERO, f64::INFINITY)));
        balls.reduce(around).unwrap_or((DVec3::ZERO, f64::INFINITY))
    }
}

/// The smallest ball around two.
fn around((centre, radius): (DVec3, f64), (other, its): (DVec3, f64)) -> (DVec3, f64) {
    let apart = centre.distance(other);
    if apart + its <= radius || radius.is_infinite() {
        (centre, radius)
    } else if apart + radius <= its || its.is_infinite() {
        (other, its)
    } else {
        let both = 0.5 * (apart + radius + its);
        (centre.lerp(other, (both - radius) / apart), both)
    }
}

/// A map in the pixels of a view.
fn seen_by(part: &Focus<'_>, map: &ShadowMap) -> ShadowMap {
    ShadowMap { view: *part.view(), ..*map }
}

/// The number of texels that would bring those of a map to the size of pixels, over the number that it has.
fn cost(map: &ShadowMap, parts: &[Focus<'_>]) -> f64 {
    let (mut worst, mut sum, mut count) = (0.0, 0.0, 0.0);
    for part in parts {
        let map = seen_by(part, map);
        for &point in part.receiver_volume().vertices() {
            // Points nearer to a light than anything casts need not be right.
            if map.light.position().is_some_and(|position| position.distance(point) < map.light.near()) {
                continue;
            }
            let aliasing = map.aliasing(point).unwrap_or(f64::INFINITY);
            (worst, sum, count) = (most(worst, aliasing), sum + aliasing, count + 1.0);
        }
    }
    if count > 0.0 { worst * (sum / count) } else { 0.0 }
}

list!(SharedFocus<'a>, Focus<'a>, parts, "focuses, one for each view,");
