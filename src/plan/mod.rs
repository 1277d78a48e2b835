//! What a scene needs of its lights' shadows, and why.

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

/// Plans the shadows of all lights of a view: for each the least that is enough, and why.
///
/// ```
/// # fn main() -> Result<(), shadowfit::InputError> {
/// use shadowfit::glam::Vec3;
/// use shadowfit::{
///     Aabb, Light, Settings, View, mesh::Solidity, plan::{Budget, Object, Objects, Projection, Surface, plan},
/// };
///
/// let ground = Object::new(Aabb::new(Vec3::new(-50.0, -0.1, -50.0), Vec3::new(50.0, 0.0, 50.0)));
/// let tower = Object { surface: Surface::Mesh(Solidity::Watertight), ..Object::new(Aabb::new(Vec3::new(2.0, 0.0, -12.0), Vec3::new(4.0, 9.0, -10.0))) };
/// let objects = Objects::new(&[Object { casts: false, ..ground }, tower])?;
/// let view = View::perspective((0.0, 1.7, 0.0), (0.0, -0.2, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.1, 500.0)?;
/// let lights = [Light::directional((0.4, 1.0, 0.2))?, Light::point((3.0, 4.0, 40.0), 0.1, 6.0)?];
///
/// let plan = plan(&view, &lights, &objects, &Budget::new(Settings::new(2048, 1080)?));
/// for light in plan.lights() {
///     for reason in light.reasons() {
///         println!("{reason}"); // no map: nothing in view can be lit
///     }
///     for pass in light.passes() {
///         if let Projection::Frustum(map) = pass.projection() {
///             println!("draw {:?} with {}", plan.casters(pass), map.caster_matrix());
///         }
///     }
/// }
/// # Ok(())
/// # }
/// ```
///
/// What is chosen, and by what:
///
/// | what | by |
/// |---|---|
/// | no map | nothing that receives is in view and lit, or nothing casts on it |
/// | one uniform map or one warped map | the uniform one where it is fine enough; else the finer one, at worst and on the mean: never a warp that is coarser at worst |
/// | the warp's camera moved back or not | the finer of the two; not, where they are the same |
/// | one paraboloid instead of a frustum | the frustum is so wide that it is much coarser |
/// | one or two paraboloids, or a cube's faces | passes, and whether all casters are cut finely enough for a map that bends lines |
/// | second depth, first depth with a bias, or virtual samples | what the casters are made of, and how far the bias would move shadows |
/// | the filter | how large texels are in the image |
/// | the size | the least power of two that is fine enough, and the texels of all lights |
///
/// Fine or coarse is the longest side of a texel over that of a pixel, at its worst among the corners of the largest
/// receivers in view, cut by the view and by what the light reaches.
///
/// The view is first narrowed to the depths of the receivers in it, which is most of what a depth read-back would gain
/// (Stamminger & Drettakis 2002, §6).
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

/// The shadows of all lights of a view.
#[derive(Clone, Debug)]
pub struct Plan {
    view: View,
    lights: Vec<LightPlan>,
    casters: Vec<u32>,
}

impl Plan {
    /// The view, narrowed to the depths of the receivers in it. Everything that receives and is in the view that was
    /// given is in this one.
    #[must_use]
    pub const fn view(&self) -> &View {
        &self.view
    }

    /// The plans of the lights, in their order.
    #[must_use]
    pub fn lights(&self) -> &[LightPlan] {
        &self.lights
    }

    /// What a pass of this plan draws: indices into the objects that it was made for, in no order.
    #[must_use]
    pub fn casters(&self, pass: &Pass) -> &[u32] {
        self.casters.get(pass.casters.clone()).unwrap_or_default()
    }

    /// Passes of all lights.
    #[must_use]
    pub fn passes(&self) -> usize {
        self.lights.iter().map(|light| light.passes.len()).sum()
    }

    /// Texels of all maps.
    #[must_use]
    pub fn texels(&self) -> u64 {
        texels(&self.lights)
    }

    /// Triangles drawn in all passes.
    #[must_use]
    pub fn triangles(&self) -> u64 {
        self.lights.iter().flat_map(|light| &light.passes).map(|pass| pass.triangles).sum()
    }
}

/// The kind of a light's shadow.
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

/// The shadow of one light.
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

    /// What kind of map it has.
    #[must_use]
    pub const fn kind(&self) -> Kind {
        self.kind
    }

    /// What is drawn and how depths are tested: [`DepthTest::First`] with the bias of each pass, or
    /// [`DepthTest::Second`] without any.
    #[must_use]
    pub const fn test(&self) -> DepthTest {
        self.test
    }

    /// Whether its maps are read by virtual samples, see [`TangentPlane`](crate::depth::TangentPlane).
    #[must_use]
    pub const fn virtual_samples(&self) -> bool {
        self.virtual_samples
    }

    /// How its maps are read.
    #[must_use]
    pub const fn filter(&self) -> Filter {
        self.filter
    }

    /// The longest side of a texel over that of a pixel, at its worst where maps are compared; 0 without a map.
    #[must_use]
    pub const fn aliasing(&self) -> f64 {
        self.aliasing
    }

    /// What is drawn for it: one pass a map.
    #[must_use]
    pub fn passes(&self) -> &[Pass] {
        &self.passes
    }

    /// Why it is as it is, from the kind to the filter.
    #[must_use]
    pub fn reasons(&self) -> &[Reason] {
        &self.reasons
    }

    /// Texels of its maps.
    #[must_use]
    pub fn texels(&self) -> u64 {
        self.passes.iter().map(|pass| u64::from(pass.map_size()).pow(2)).sum()
    }
}

/// What one map is drawn through.
#[derive(Clone, Debug, PartialEq)]
pub enum Projection {
    /// A matrix.
    Frustum(ShadowMap),
    /// A matrix, for what lies in this face of the cube around the light.
    Face(CubeFace, ShadowMap),
    /// A paraboloid, for what lies in its hemisphere.
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
#[derive(Clone, Debug)]
pub struct Pass {
    projection: Projection,
    bias: Option<DepthBias>,
    casters: Range<usize>,
    triangles: u64,
}

impl Pass {
    /// What it is drawn through.
    #[must_use]
    pub const fn projection(&self) -> &Projection {
        &self.projection
    }

    /// The bias that a test of first depths needs; `None` for the others.
    #[must_use]
    pub const fn bias(&self) -> Option<&DepthBias> {
        self.bias.as_ref()
    }

    /// How many triangles it draws.
    #[must_use]
    pub const fn triangles(&self) -> u64 {
        self.triangles
    }

    /// Texels a side of its map.
    #[must_use]
    pub const fn map_size(&self) -> u32 {
        match &self.projection {
            Projection::Frustum(map) | Projection::Face(_, map) => map.settings().map_size(),
            Projection::Paraboloid(paraboloid) => paraboloid.settings().map_size(),
        }
    }
}
