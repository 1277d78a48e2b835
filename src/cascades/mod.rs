//! Cascaded shadow maps: the view cut in depth, and a map fitted to each cascade.

mod choice;
mod layout;
mod maps;
mod split;
mod uniform;

pub use choice::CascadeChoice;
pub use layout::{AtlasTile, CascadeLayout, TextureExtent};
pub use maps::{CascadeMaps, CascadesReport};
pub use split::{CascadeSplits, SplitScheme};
pub use uniform::CascadeUniform;

use crate::convex::Polyhedron;
use crate::error::{InputError, MAX_COORDINATE, check};
use crate::fit::{Empty, Outcome};
use crate::focus::Focus;
use crate::input::light::Light;
use crate::input::scene::Scene;
use crate::input::view::View;
use crate::math::bounds::{Interval, most};
use crate::math::list::list;
use crate::settings::Settings;
use glam::DVec3;
use split::{Depths, rounded};

/// A view cut into cascades in depth, each with a [`Focus`] of its own (cascaded or parallel-split shadow maps: Zhang et al.
/// 2006; Engel, *Cascaded Shadow Maps*, ShaderX5, 2006).
///
/// A cascade is a [narrowed](View::narrowed) view, so that its volumes, fit, culling, bias and report are those of any fit.
///
/// ```text
///     view's near                                                          view's far
///     ├─────────────────┼───────────────────────────┼─────────────────────────────────┤
///     │     cascade 0   ▒▒│         cascade 1       ▒▒▒▒│             cascade 2             │
///     └─────────────────┴───────────────────────────┴─────────────────────────────────┘
///                     ▒▒ here cascade 1 is blended in: its focus begins where this does
/// ```
///
/// ```
/// use shadowfit::{Light, Scene, Settings, View};
/// use shadowfit::cascades::{CascadeLayout, CascadeSplits, Cascades, SplitScheme};
///
/// let view = View::perspective((0.0, 1.7, 0.0), (0.0, -0.2, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.1, f64::INFINITY)?;
/// let sun = Light::directional((0.4, 1.0, 0.2))?;
/// let scene = Scene::from_box((-200.0, 0.0, -200.0), (200.0, 30.0, 200.0))?;
///
/// let splits = CascadeSplits::Visible { count: 4, split: SplitScheme::Practical(0.5) }; // λ = 0.5
/// let cascades = Cascades::new(&view, &sun, &scene, splits, 0.1)?;
/// let maps = cascades.fit(&Settings::new(1024, 1080)?);
/// assert_eq!(maps.maps().count(), 4);
/// assert!(cascades[0].far < cascades[1].far);
/// let atlas = maps.extent(CascadeLayout::Atlas);
/// assert_eq!((atlas.width, atlas.height, atlas.layers), (2048, 2048, 1));
/// # Ok::<(), shadowfit::InputError>(())
/// ```
///
/// # Guarantees
///
/// - Every depth is in exactly one cascade, [`Self::index_at`]. The first begins at the view's near plane and the last ends
///   at its far plane, so that one cascade is the view itself.
/// - Splits are numbers of f32, and a shader that compares in f32 finds the same cascade as the CPU.
/// - The focus of a cascade holds all of R in the cascade, in the zone where it is blended in, and as far beyond both ends as
///   f32 can be wrong about a depth that is computed from positions relative to the eye. From positions in the world a depth
///   is as wrong as these are, and where that is much, a zone to blend in covers it.
#[doc(alias = "CSM")]
#[doc(alias = "PSSM")]
#[doc(alias = "cascaded shadow maps")]
#[doc(alias = "parallel-split shadow maps")]
#[doc(alias = "z-partitioning")]
#[derive(Clone, Debug)]
pub struct Cascades<'a> {
    /// One at least; those past the number of cascades are copies of the first.
    cascades: [Cascade<'a>; Cascades::MAX],
    len: usize,
}

/// A part of a view between two depths.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Cascade<'a> {
    /// The view depth where it begins, in world units.
    pub near: f64,
    /// The view depth from which on the next cascade is blended in; where it ends, if none is.
    pub blend: f64,
    /// The view depth where it ends; infinite where the view's own is.
    pub far: f64,
    /// The receivers in it and in the zone where it is blended in, and their casters.
    pub focus: Focus<'a>,
}

/// The error of a view depth in f32, relative to the distance from the eye: eight roundings, of an axis, its products with
/// the position's coordinates, their sum, and of the coordinates themselves.
const DEPTH_ROUNDING: f64 = 8.0 / 16_777_216.0;

impl<'a> Cascades<'a> {
    /// The most cascades there can be.
    pub const MAX: usize = 8;

    /// Cuts a view into cascades.
    ///
    /// `overlap`, 0 to 1, is the part of each cascade but the last in which the next one is blended in; the next one's
    /// map covers it too. In a first cascade that begins before any receiver, it is a part of the range with receivers,
    /// if the splits are [`CascadeSplits::Visible`]. Of a scene of lists, each focus looks at all of them once.
    ///
    /// # Errors
    ///
    /// Names `"count"` or `"overlap"` when it is out of range, `"split"` when λ is outside 0 to 1, `"view"` when
    /// its planes are to be split and the far one is at infinity, and `"cuts"` when they are too many, not finite, not
    /// ascending as f32, or not between the view's planes.
    ///
    /// ```
    #[doc = include_str!("../examples/cascades.txt")]
    /// assert_eq!(cascades.len(), 4);
    /// assert!(cascades[0].blend < cascades[0].far);
    /// let fixed = Cascades::new(&view, &sun, &scene, CascadeSplits::At(&[10.0, 50.0]), 0.0)?;
    /// assert_eq!((fixed[0].far, fixed[1].far, fixed[2].far), (10.0, 50.0, f64::INFINITY));
    /// assert!(Cascades::new(&view, &sun, &scene, CascadeSplits::At(&[50.0, 10.0]), 0.0).is_err());
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    pub fn new(
        view: &View,
        light: &Light,
        scene: &Scene<'a>,
        cuts: CascadeSplits<'_>,
        overlap: f64,
    ) -> Result<Self, InputError> {
        let overlap = check::part("overlap", overlap, 1.0)?;
        let cuts = cuts.depths(view, || visible_depths(&Focus::new(view, light, scene)))?;
        Self::cut(view, light, scene, &cuts, overlap)
    }

    /// Cuts a view at these depths.
    fn cut(view: &View, light: &Light, scene: &Scene<'a>, cuts: &Depths, overlap: f64) -> Result<Self, InputError> {
        // Made one after another: each begins where the one before has its next one blended in.
        let (mut near, mut begin) = (view.near(), view.near());
        let mut cut_to = |far: f64, from: f64| -> Result<Cascade<'a>, InputError> {
            let is_last = far == view.far();
            let blend = if is_last { far } else { rounded(far - overlap * (far - from)).clamp(from, far) };
            let slack = if is_last { 0.0 } else { slack(view, far)? };
            // No finite plane may be farther than that.
            let end = (far + slack).min(view.far()).min(most(far, MAX_COORDINATE));
            let focus = Focus::new(&view.narrowed(begin, end)?, light, scene);
            let cascade = Cascade { near, blend, far, focus };
            (near, begin) = (far, most(blend - slack, view.near()));
            Ok(cascade)
        };
        let first = cut_to(cuts.first().copied().unwrap_or(view.far()), cuts.near)?;
        let mut cascades = [(); Self::MAX].map(|()| first.clone());
        let ends = cuts.iter().copied().skip(1).chain([view.far()]);
        for (index, far) in (1..=cuts.len()).zip(ends) {
            cascades[index] = cut_to(far, cascades[index - 1].far)?;
        }
        Ok(Self { cascades, len: cuts.len() + 1 })
    }

    /// The cascade of a view depth: the first that ends beyond it, or the last.
    ///
    /// ```
    #[doc = include_str!("../examples/cascades.txt")]
    /// assert_eq!(cascades.index_at(view.near()), 0);
    /// assert_eq!(cascades.index_at(cascades[0].far), 1); // a cascade ends before its far depth
    /// assert_eq!(cascades.index_at(1e9), 3);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn index_at(&self, depth: f64) -> usize {
        self.iter().take(self.len - 1).filter(|cascade| depth >= cascade.far).count()
    }

    /// The weight of the next cascade at a view depth, 0 to 1; 0 in the last one, wherever it ends.
    ///
    /// ```
    #[doc = include_str!("../examples/cascades.txt")]
    /// let middle = 0.5 * (cascades[0].blend + cascades[0].far);
    /// assert_eq!(cascades.blend_at(cascades[0].blend), 0.0);
    /// assert!((cascades.blend_at(middle) - 0.5).abs() < 1e-9);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[doc(alias = "cascade blending")]
    #[must_use]
    pub fn blend_at(&self, depth: f64) -> f64 {
        let index = self.index_at(depth);
        let cascade = &self[index];
        let is_last = index + 1 == self.len;
        if depth > cascade.blend && !is_last {
            (depth - cascade.blend) / (cascade.far - cascade.blend)
        } else {
            0.0
        }
    }

    /// Fits a map for each cascade that needs one, all with the same settings.
    ///
    /// ```
    #[doc = include_str!("../examples/cascades.txt")]
    /// let maps = cascades.fit(&settings);
    /// assert!(maps.outcomes().iter().all(|outcome| outcome.map().is_some()));
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn fit(&self, settings: &Settings) -> CascadeMaps<'_, 'a> {
        let mut outcomes = [const { Outcome::Empty(Empty::NoReceivers) }; Self::MAX];
        for (outcome, cascade) in outcomes.iter_mut().zip(self.iter()) {
            *outcome = cascade.focus.fit(settings);
        }
        CascadeMaps { cascades: self, outcomes, settings: *settings }
    }
}

list!(Cascades<'a>, Cascade<'a>, cascades, "cascades");

/// The view depths of the receivers.
fn visible_depths(focus: &Focus<'_>) -> Interval {
    let (mut body, mut depths) = (Polyhedron::EMPTY, Interval::EMPTY);
    focus.cut_visible(&mut body, |_, _| ());
    body.positions().for_each(|point| depths.include(focus.view().depth(point)));
    depths
}

/// How far f32 may be wrong about a depth, anywhere in view: by how far from the eye the frame's corners are there, and
/// by what f64 itself rounds of an eye far out.
fn slack(view: &View, depth: f64) -> Result<f64, InputError> {
    let frame = view.narrowed(view.near(), depth)?.corners();
    let distance = |corner: DVec3| (corner - view.eye()).length();
    let farthest = frame.into_iter().flatten().map(distance).fold(0.0, most);
    Ok(DEPTH_ROUNDING * farthest + 64.0 * f64::EPSILON * (view.eye().abs().element_sum() + farthest))
}
