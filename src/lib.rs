//! Fits shadow maps: from a view, a light and a scene to the one matrix a renderer uploads.
//!
//! Given a **view** V (the camera's frustum), a **light** l with the region L it can light, and the bounds S of a
//! **scene**, this crate computes
//!
//! 1. the focus body `H = hull(V, l) ∩ S ∩ L`: every point that must appear in the shadow map ([`Focus`], [`ConvexBody`](focus::ConvexBody));
//! 2. the class of the light after the camera's perspective ([`classify`](warp::classify));
//! 3. the virtual camera and its back-shift ([`VirtualCamera`](warp::VirtualCamera));
//! 4. one 4×4 matrix, world → shadow clip space ([`fit`], [`ShadowMap`]): uniform, warped as one of three papers has it, or the best
//!    that a search finds ([`Warp`]);
//! 5. what the matrix costs and gives: texel footprints, aliasing, depth resolution ([`Report`](map::Report)), how much is left to gain
//!    ([`Focus::aliasing_lower_bound`]), and the casters to draw ([`ConvexBody::intersects_aabb`](focus::ConvexBody::intersects_aabb), [`Culler`](focus::Culler)).
//!
//! For lights that one frustum cannot serve there are the faces of a cube ([`Light::cube_face`]) and paraboloid maps
//! ([`Focus::paraboloids`]), and for views that one map is too coarse for, slices of them ([`Cascades`](cascades::Cascades)). How depth is tested is part of a shadow too: the bias that a map needs ([`ShadowMap::bias`]),
//! second depth, which needs none ([`DepthTest`](depth::DepthTest), [`Solidity`](mesh::Solidity)), virtual samples ([`TangentPlane`](depth::TangentPlane)), and splats for points
//! ([`ShadowMap::splat`]).
//!
//! And for those who would rather not choose, [`plan`](plan::plan()) says of every light of a scene the least that is enough,
//! and why.
//!
//! ```
//! use shadowfit::{Focus, FocusForm, Light, Outcome, Scene, Settings, View, fit, warp::classify};
//!
//! # fn main() -> Result<(), shadowfit::InputError> {
//! let view = View::perspective((0.0, 1.7, 0.0), (0.0, -0.2, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.1, 500.0)?;
//! let sun = Light::directional((0.4, 1.0, 0.2))?; // towards the light
//! let scene = Scene::from_box((-200.0, 0.0, -200.0), (200.0, 30.0, 200.0))?;
//!
//! // The common case is one call.
//! match fit(&view, &sun, &scene, &Settings::default()) {
//!     Outcome::Map(map) => println!("upload {}", map.caster_matrix()),
//!     Outcome::Empty(why) => println!("{why}"),
//!     Outcome::Surrounded(why) => println!("{why}"),
//! }
//!
//! // And each step is there for those who need one of them.
//! println!("{}", classify(&view, &sun)); // point, inverted, directional, infinity plane
//! let focus = Focus::new(&view, &sun, &scene);
//! let body = focus.caster_volume(FocusForm::ReceiverHull);
//! println!("draw the tree: {}", body.intersects_aabb((3.0, 0.0, -9.0), (5.0, 4.0, -7.0)));
//! let settings = Settings::new(4096, 1440)?; // texels and pixels; the rest as in the default
//! if let Some(map) = focus.fit(&settings).map() {
//!     let aliasing = map.report(&focus).aliasing;
//!     println!("a texel is at worst {aliasing} pixels long, and could be {}", focus.aliasing_lower_bound(&settings));
//! }
//! # Ok(())
//! # }
//! ```
//!
//! Data flows one way, and the modules in its order: view, light, scene → convex → focus → perspective → rays → warp → best →
//! homography → fit → map → aliasing, limit; paraboloid, slices → bias, virtual samples, splats → plan.
//!
//! # Conventions
//!
//! | what | is |
//! |---|---|
//! | handedness | either: a view's axes are its own; nothing else depends on it |
//! | vectors and matrices | columns: `clip = shadow_from_world * position`; names read `to_from` |
//! | planes | `normal · x + offset`, inside ≥ 0, normals point inwards |
//! | directions of light | point **towards** the light; axes of spots and hemispheres point away from it |
//! | angles, distances | radians, world units |
//! | clip space | as the [`ClipSpace`] of the settings says; wgpu's by default |
//! | numbers | f64 inside, f32 in [`ShadowMap::caster_matrix`], bulk culling and lists of boxes |
//!
//! # Sources
//!
//! Perspective shadow maps: Stamminger & Drettakis, SIGGRAPH 2002. Texture-space matrices, depth precision: Kilgard,
//! *Shadow Mapping with Today's OpenGL Hardware*, GDC 2000. Second depth and virtual samples: Wang & Molnar, *Second-Depth
//! Shadow Mapping*, UNC TR94-019, 1994. Light-space perspective: Wimmer, Scherzer & Purgathofer, EGSR 2004. Trapezoidal
//! maps: Martin & Tan, *Anti-aliasing and Continuity with Trapezoidal Shadow Maps*, EGSR 2004. Slices: Zhang, Sun, Xu & Lun,
//! *Parallel-Split Shadow Maps for Large-scale Virtual Environments*, VRCIA 2006. Paraboloid maps: Brabec, Annen & Seidel,
//! *Shadow Mapping for Hemispherical and Omnidirectional Light Sources*, CGI 2002. Aliasing of warped maps: Lloyd, Tuft, Yoon
//! & Manocha, EGSR 2006.
//!
//! # Features
//!
//! - `std` (on): square roots from the standard library; brings `alloc`. Without it, enable `libm`.
//! - `alloc`: what needs an allocator: the planner, and whether meshes are watertight ([`Solidity`](mesh::Solidity)).
//! - `libm`: square roots from the `libm` crate.
//! - `parry3d`: bodies, boxes and convex hulls from and to parry3d.
//! - `spade`: meshes cut finely enough for paraboloid maps (`Tessellator`).
//! - `wgsl`: functions for a renderer's own shaders (`wgsl`).
//! - `serde`: views, lights, settings and results can be stored; what is read is checked like any other input.
//!
//! # Other libraries
//!
//! Constructors take what converts into arrays, in f32 or f64: glam of any version (Bevy's, parry's), nalgebra, cgmath, mint,
//! tuples, arrays. Results are arrays in one call. No version is pinned ([`IntoMatrix`](input::IntoMatrix) has the table for matrices).
//!
//! ```
//! # use shadowfit::{Light, Scene, Settings, View, fit};
//! # #[derive(Clone, Copy)] struct TheirVec3([f32; 3]); // bevy_math::Vec3, nalgebra::Vector3<f32>, ...
//! # impl From<TheirVec3> for [f32; 3] { fn from(vector: TheirVec3) -> Self { vector.0 } }
//! # let theirs = TheirVec3([0.4, 1.0, 0.2]);
//! let sun = Light::directional(theirs)?; // a vector of any library
//! assert_eq!(sun, Light::directional([0.4_f32, 1.0, 0.2])?);
//! # let view = View::perspective((0.0, 1.7, 0.0), (0.0, -0.2, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.1, 500.0)?;
//! # let scene = Scene::from_box((-200.0, 0.0, -200.0), (200.0, 30.0, 200.0))?;
//! if let Some(map) = fit(&view, &sun, &scene, &Settings::default()).map() {
//!     let columns: [[f32; 4]; 4] = map.caster_matrix().to_cols_array_2d(); // what every library's matrix is made from
//!     assert_eq!(columns[3][3], map.caster_matrix().w_axis.w);
//! }
//! # Ok::<(), shadowfit::InputError>(())
//! ```
//!
//! glam 0.33.12 to 0.34 are accepted, and the one in use is re-exported as [`glam`].
#![no_std]

#[cfg(feature = "alloc")]
extern crate alloc;
#[cfg(any(feature = "std", test))]
extern crate std;

pub mod cascades;
mod convex;
pub mod depth;
mod error;
mod fit;
pub mod focus;
pub mod input;
pub mod map;
mod math;
#[cfg(feature = "alloc")]
pub mod mesh;
pub mod multiview;
pub mod omni;
#[cfg(feature = "parry3d")]
mod parry;
#[cfg(feature = "alloc")]
pub mod plan;
mod settings;
pub mod warp;
#[cfg(feature = "wgsl")]
pub mod wgsl;

pub use error::InputError;
pub use fit::{Empty, Outcome, fit};
pub use focus::surrounded::Surrounded;
pub use focus::{Focus, FocusForm};
pub use glam;
pub use input::clip_space::ClipSpace;
pub use input::light::Light;
pub use input::scene::{Aabb, Scene};
pub use input::view::View;
pub use map::quality::DepthFormat;
pub use map::shadow_map::ShadowMap;
pub use settings::fallback::WarpFallback;
pub use settings::filter::Filter;
pub use settings::{Effort, Origin, Settings, Warp};

/// The examples of the repository's pages, which are tests.
#[cfg(doctest)]
mod pages {
    #[doc = include_str!("../README.md")]
    struct Readme;
    #[doc = include_str!("../docs/cascades.md")]
    struct Cascades;
    #[doc = include_str!("../docs/depth.md")]
    struct Depth;
    #[doc = include_str!("../docs/lights-all-around.md")]
    struct LightsAllAround;
    #[doc = include_str!("../docs/migrating.md")]
    struct Migrating;
    #[cfg(feature = "alloc")]
    #[doc = include_str!("../docs/planner.md")]
    struct Planner;
}
