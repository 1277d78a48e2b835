//! The planner: the cheapest sufficient shadow technique for every light of a view, with the reason.

mod budget;
mod groups;
mod light;
mod objects;
mod omni;
mod reason;
mod seen;

use crate::depth::bias::DepthBias;
use crate::depth::second_depth::DepthTest;
use crate::input::light::CubeFace;
use crate::input::light::Light;
use crate::input::view::View;
use crate::map::quality::DepthFormat;
use crate::map::shadow_map::ShadowMap;
use crate::omni::Paraboloid;
use crate::settings::filter::Filter;
use alloc::vec::Vec;
use core::ops::Range;
use glam::DVec3;
use light::{Planner, Reach};
use seen::Seen;

pub use budget::Budget;
pub use objects::{Object, Objects, Surface};
pub use reason::Reason;

/// Chooses the cheapest sufficient shadow technique for each light, given all lights and objects, with the reasons.
///
/// ```
#[doc = include_str!("../examples/plan.txt")]
/// let plan = plan(&view, &lights, &objects, &budget);
/// for light in plan.lights() {
///     assert!(!light.reasons().is_empty()); // "no map: nothing can cast on a receiver in view", …
///     for pass in light.passes() {
///         let Projection::Frustum(map) = pass.projection() else { panic!("the sun has a frustum") };
///         assert!(map.w_at(view.eye()) > 0.0); // draw `plan.casters(pass)` with `map.caster_matrix()`
///     }
/// }
/// assert_eq!(plan.lights()[1].reasons(), [Reason::NoCasters]); // too far away
/// # Ok::<(), shadowfit::InputError>(())
/// ```
///
/// | choice | criterion |
/// |---|---|
/// | no map | no receiver is in view and lit, or nothing casts on one |
/// | one uniform map or one warped map | the uniform one where it is fine enough; else the finer one, at worst and on the mean: never a warp that is coarser at worst |
/// | the warp's camera moved back or not | the finer of the two; not, where they are the same |
/// | one paraboloid instead of a frustum | the frustum is so wide that it is much coarser |
/// | one or two paraboloids, or cube faces | the number of passes, and whether the edges of all casters are short enough for paraboloid maps |
/// | second depth, first depth with a bias, or virtual samples | the surfaces of the casters, and how far the bias would move shadows |
/// | the filter | the size of texels in the image |
/// | the size | the least power of two that is fine enough, and the texels of all lights |
///
/// How fine a map is: the worst aliasing among the corners of the largest receivers in view, cut by the view and by the
/// light's reach. The view is first narrowed to the depths of the receivers in it, which is most of what a depth read-back
/// would gain (Stamminger & Drettakis 2002, §6). `docs/planner.md` has what each choice costs and gains.
#[doc(alias = "planner")]
#[doc(alias = "quality settings")]
#[must_use]
pub fn plan(view: &View, lights: &[Light], objects: &Objects, budget: &Budget) -> Plan {
    let seen = Seen::new(view, objects);
    let mut planner = Planner { seen: &seen, objects, budget, most: budget.settings().map_size() };
    let (mut reach, mut casters) = (Reach::default(), Vec::new());
    let mut plans: Vec<LightPlan> =
        lights.iter().map(|light| planner.plan(light, &mut reach, &mut casters)).collect();
    // All lights together: the largest maps are made smaller until the sum fits.
    while texels(&plans) > budget.texels() && planner.most / 2 >= Budget::SMALLEST_MAP {
        planner.most /= 2;
        for (light, plan) in lights.iter().zip(&mut plans) {
            if plan.passes.iter().any(|pass| pass.map_size() > planner.most) {
                *plan = planner.plan(light, &mut reach, &mut casters);
                plan.reasons.push(Reason::OverBudget(planner.most));
            }
        }
    }
    Plan { view: seen.view, lights: plans, casters }
}

fn texels(plans: &[LightPlan]) -> u64 {
    plans.iter().map(LightPlan::texels).sum()
}

/// The shadows of all lights of a view, as [`plan`](plan()) chose them.
///
/// ```
#[doc = include_str!("../examples/plan.txt")]
/// let plan = plan(&view, &lights, &objects, &budget);
/// assert_eq!(plan.lights().len(), lights.len());
/// assert_eq!(plan.passes(), 1); // the sun's
/// assert_eq!(plan.casters(&plan.lights()[0].passes()[0]), [1]); // the tower
/// assert_eq!((plan.triangles(), plan.texels()), (12, plan.lights()[0].texels()));
/// assert!(plan.view().near() > view.near() && plan.view().far() < view.far());
/// # Ok::<(), shadowfit::InputError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Plan {
    view: View,
    lights: Vec<LightPlan>,
    casters: Vec<u32>,
}

impl Plan {
    /// The view, narrowed to the depths of the receivers in it: it holds every receiver of the original view.
    #[must_use]
    pub const fn view(&self) -> &View {
        &self.view
    }

    /// The plans of the lights, in their order.
    #[must_use]
    pub fn lights(&self) -> &[LightPlan] {
        &self.lights
    }

    /// The casters that a pass of this plan draws: indices into the objects that it was made for, in no order.
    #[must_use]
    pub fn casters(&self, pass: &Pass) -> &[u32] {
        self.casters.get(pass.casters.clone()).unwrap_or_default()
    }

    /// The number of passes of all lights.
    #[must_use]
    pub fn passes(&self) -> usize {
        self.lights.iter().map(|light| light.passes.len()).sum()
    }

    /// The number of texels of all maps.
    #[must_use]
    pub fn texels(&self) -> u64 {
        texels(&self.lights)
    }

    /// The number of triangles drawn in all passes.
    #[must_use]
    pub fn triangles(&self) -> u64 {
        self.lights.iter().flat_map(|light| &light.passes).map(|pass| pass.triangles).sum()
    }
}

/// The shadow technique of a light.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Kind {
    /// No map.
    Nothing,
    /// One uniform map.
    Uniform,
    /// One map with the warp of the settings.
    Warped,
    /// One paraboloid.
    Paraboloid,
    /// Two paraboloids.
    DualParaboloid,
    /// Some faces of a cube.
    CubeFaces,
}

/// The plan of one light.
///
/// ```
#[doc = include_str!("../examples/plan.txt")]
/// let plan = plan(&view, &lights, &objects, &budget);
/// let (sun, far) = (&plan.lights()[0], &plan.lights()[1]);
/// assert!(matches!(sun.kind(), Kind::Uniform | Kind::Warped));
/// assert_eq!((sun.test(), sun.virtual_samples()), (DepthTest::Second, false)); // the tower is watertight
/// assert!(sun.aliasing() > 0.0 && sun.texels() > 0 && sun.passes().len() == 1);
/// assert!(sun.reasons().contains(&Reason::AllSolid));
/// assert_eq!((far.kind(), far.filter(), far.passes().len()), (Kind::Nothing, Filter::Nearest, 0));
/// # Ok::<(), shadowfit::InputError>(())
/// ```
#[derive(Clone, Debug)]
pub struct LightPlan {
    kind: Kind,
    test: DepthTest,
    virtual_samples: bool,
    filter: Filter,
    aliasing: f64,
    passes: Vec<Pass>,
    reasons: Vec<Reason>,
}

impl LightPlan {
    fn nothing(why: Reason) -> Self {
        Self {
            kind: Kind::Nothing,
            test: DepthTest::First,
            virtual_samples: false,
            filter: Filter::Nearest,
            aliasing: 0.0,
            passes: Vec::new(),
            reasons: alloc::vec![why],
        }
    }

    /// The technique.
    #[must_use]
    pub const fn kind(&self) -> Kind {
        self.kind
    }

    /// The depth test: [`DepthTest::First`] with the bias of each pass, or [`DepthTest::Second`] without any.
    #[must_use]
    pub const fn test(&self) -> DepthTest {
        self.test
    }

    /// Whether its maps are read with virtual samples, see [`TangentPlane`](crate::depth::TangentPlane).
    #[must_use]
    pub const fn virtual_samples(&self) -> bool {
        self.virtual_samples
    }

    /// The filter that its maps are read with.
    #[must_use]
    pub const fn filter(&self) -> Filter {
        self.filter
    }

    /// The worst aliasing where maps are compared; 0 without a map.
    #[must_use]
    pub const fn aliasing(&self) -> f64 {
        self.aliasing
    }

    /// The passes that draw it, one for each map.
    #[must_use]
    pub fn passes(&self) -> &[Pass] {
        &self.passes
    }

    /// The reasons for each choice, from the technique to the filter.
    #[must_use]
    pub fn reasons(&self) -> &[Reason] {
        &self.reasons
    }

    /// The number of texels of its maps.
    #[must_use]
    pub fn texels(&self) -> u64 {
        self.passes.iter().map(|pass| u64::from(pass.map_size()).pow(2)).sum()
    }
}

/// The projection that one map is drawn with.
#[derive(Clone, Debug, PartialEq)]
pub enum Projection {
    /// A matrix.
    Frustum(ShadowMap),
    /// A matrix, for receivers in this face of the cube around the light.
    Face(CubeFace, ShadowMap),
    /// A paraboloid, for receivers in its hemisphere.
    Paraboloid(Paraboloid),
}

impl Projection {
    /// The longest side of a texel over that of a pixel at a point; `None` where the map does not answer for it.
    fn aliasing(&self, point: DVec3) -> Option<f64> {
        match self {
            Self::Frustum(map) => map.aliasing(point),
            Self::Face(face, map) => {
                let position = map.light.position()?;
                if CubeFace::of(point - position) == *face { map.aliasing(point) } else { None }
            }
            Self::Paraboloid(paraboloid) if paraboloid.clip_plane().at(point) < 0.0 => None,
            Self::Paraboloid(paraboloid) => paraboloid.aliasing(point),
        }
    }

    /// The bias that a test of first depths needs.
    fn bias(&self, format: DepthFormat, reach: f64) -> Option<DepthBias> {
        match self {
            Self::Frustum(map) | Self::Face(_, map) => map.bias(format, reach).ok(),
            Self::Paraboloid(paraboloid) => paraboloid.bias(format, reach).ok(),
        }
    }
}

/// One map to draw.
///
/// ```
#[doc = include_str!("../examples/plan.txt")]
/// let open = Object { surface: Surface::default(), ..tower };
/// let plan = plan(&view, &lights, &Objects::new(&[ground, open])?, &budget);
/// let pass = &plan.lights()[0].passes()[0];
/// let Projection::Frustum(map) = pass.projection() else { panic!("the sun has a frustum") };
/// assert_eq!(pass.map_size(), map.settings().map_size());
/// assert!(pass.bias().is_some_and(|bias| bias.slope_scale > 0.0)); // an open mesh needs one
/// assert_eq!(pass.triangles(), 12);
/// # Ok::<(), shadowfit::InputError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Pass {
    projection: Projection,
    bias: Option<DepthBias>,
    casters: Range<usize>,
    triangles: u64,
}

impl Pass {
    /// The projection that it is drawn with.
    #[must_use]
    pub const fn projection(&self) -> &Projection {
        &self.projection
    }

    /// The depth bias for [`DepthTest::First`]; `None` for other tests.
    #[must_use]
    pub const fn bias(&self) -> Option<&DepthBias> {
        self.bias.as_ref()
    }

    /// The number of triangles it draws.
    #[must_use]
    pub const fn triangles(&self) -> u64 {
        self.triangles
    }

    /// The size of its map in texels a side.
    #[must_use]
    pub const fn map_size(&self) -> u32 {
        match &self.projection {
            Projection::Frustum(map) | Projection::Face(_, map) => map.settings().map_size(),
            Projection::Paraboloid(paraboloid) => paraboloid.settings().map_size(),
        }
    }
}
