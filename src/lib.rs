//! Fits shadow maps: from a camera, a light and a scene to the matrices that casters are drawn with and receivers are tested
//! with.
//!
//! ```
//! use shadowfit::{DepthFormat, Filter, Light, Outcome, Scene, Settings, View, fit};
//!
//! let view = View::perspective((0.0, 1.7, 0.0), (0.0, -0.2, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.1, 500.0)?;
//! let sun = Light::directional((0.4, 1.0, 0.2))?; // towards the light
//! let scene = Scene::from_box((-200.0, 0.0, -200.0), (200.0, 30.0, 200.0))?;
//! let Outcome::Map(map) = fit(&view, &sun, &scene, &Settings::default()) else { panic!("the ground is in view") };
//!
//! let bias = map.bias(DepthFormat::Float32, Filter::Hardware2x2.reach())?; // for the pipeline: constant and slope
//! let casters = map.caster_matrix(); // upload for drawing casters,
//! let receivers = map.receiver_matrix_with(&bias.offset()); // and for testing receivers
//! assert!(casters.is_finite() && receivers.is_finite());
//! # Ok::<(), shadowfit::InputError>(())
//! ```
//!
//! # A tour
//!
//! Examples share a set-up in hidden lines, which the button beside an example shows: a `view`, a light, a `scene`, their
//! `focus`, `settings`, and the `map` that was fitted.
//!
//! ## Camera
//!
//! A [`View`] is the part of the world that the camera shows: from numbers with [`View::perspective`], from the camera's
//! matrices with [`View::from_matrices`], which reads any [`ClipSpace`]. A far plane at infinity is fine. Where a depth
//! read-back says what is on screen, [`Focus::with_seen`] spends no texels on the rest.
//!
//! ```
#![doc = include_str!("examples/sun.txt")]
//! let ground_only = view.narrowed(4.0, 30.0)?;
//! assert_eq!((ground_only.near(), ground_only.far()), (4.0, 30.0));
//! assert!(View::perspective((0.0, 1.7, 0.0), (0.0, -0.2, -1.0), (0.0, 1.0, 0.0), 60.0, 1.6, 0.1, 50.0).is_err()); // radians
//! # Ok::<(), shadowfit::InputError>(())
//! ```
//!
//! ## Light
//!
//! A [`Light`] is directional, a point light, a spot, a hemisphere or a pyramid. Directions point **towards** a directional
//! light, and away from any other. Local lights have a near distance, within which nothing casts, and a range.
//!
//! ```
//! use shadowfit::Light;
//!
//! let sun = Light::directional((0.4, 1.0, 0.2))?;
//! let spot = Light::spot((0.0, 4.0, -5.0), (0.0, -1.0, -0.2), 0.7, 0.1, 30.0)?; // axis, half angle, near, range
//! assert!(sun.position().is_none() && spot.position().is_some());
//! # Ok::<(), shadowfit::InputError>(())
//! ```
//!
//! ## Scene
//!
//! A [`Scene`] is the bounds of casters and receivers: one box, a convex body, or lists of boxes. A [`Focus`] brings camera,
//! light and scene together: R, the receiver volume, and H, the caster volume.
//!
#![doc = include_str!("../docs/images/concepts-focus.svg")]
//!
//! ```
//! use shadowfit::{Aabb, Focus, Light, Scene, View};
//!
//! let view = View::perspective((0.0, 1.7, 0.0), (0.0, -0.2, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.1, 50.0)?;
//! let sun = Light::directional((0.4, 1.0, 0.2))?;
//! let ground = [Aabb::new([-50.0, -0.1, -50.0], [50.0, 0.0, 50.0])];
//! let trees = [Aabb::new([2.0, 0.0, -9.0], [4.0, 6.0, -7.0]), Aabb::new([2.0, 0.0, 40.0], [4.0, 6.0, 42.0])];
//! let scene = Scene::new(&trees, &ground)?;
//! let focus = Focus::new(&view, &sun, &scene);
//! assert_eq!(focus.casters().collect::<Vec<_>>(), [0]); // the tree behind the eye casts on nothing in view
//! # Ok::<(), shadowfit::InputError>(())
//! ```
//!
//! ## Fit
//!
//! [`fit`], or [`Focus::fit`], answers with a [`ShadowMap`], or that no map is needed ([`Empty`]), or that the light
//! stands among its receivers ([`Surrounded`]). [`Warp`] says how texels are spread: [`Warp::Best`] is the default,
//! [`Warp::Stable`] snaps to texels against shimmering, and there are PSM, LiSPSM and TSM. [`ShadowMap::aliasing`] says
//! how large texels are in pixels, [`Focus::aliasing_lower_bound`] how much is left to gain. See `docs/warps.md`.
//!
#![doc = include_str!("../docs/images/concepts-warp.svg")]
//!
//! ```
#![doc = include_str!("examples/sun.txt")]
//! let uniform = focus.fit(&settings.with_warp(Warp::Uniform)).into_map().expect("receivers");
//! let best = focus.fit(&settings).into_map().expect("receivers");
//! let [uniform, best] = [uniform, best].map(|map| map.report(&focus).aliasing);
//! assert!(focus.aliasing_lower_bound(&settings) < best && best < 0.5 * uniform);
//! # Ok::<(), shadowfit::InputError>(())
//! ```
//!
//! ## Draw casters
//!
//! The shadow pass draws with [`ShadowMap::caster_matrix`] the casters that touch H: [`Focus::casters`] lists them, and
//! [`Culler`](focus::Culler) tests objects in bulk. Depth grows away from the light, in the clip space of the settings.
//!
//! ```
#![doc = include_str!("examples/sun.txt")]
//! let volume = focus.caster_volume(FocusForm::ReceiverHull);
//! assert!(volume.intersects_aabb((3.0, 0.0, -9.0), (5.0, 4.0, -7.0))); // draw this tree
//! assert!(!volume.intersects_aabb((-9.0, 0.0, 9.0), (-8.0, 1.0, 10.0))); // behind the eye, its shadow out of view
//! # Ok::<(), shadowfit::InputError>(())
//! ```
//!
//! ## Test receivers
//!
//! [`ShadowMap::receiver_matrix`] takes a position to texture coordinates and the depth to compare there. The `wgsl` feature
//! has functions for shaders: filters, cascades, virtual samples, paraboloids.
//!
//! ```
#![doc = include_str!("examples/sun.txt")]
//! let place = map.receiver_matrix().project_point3(ground.as_vec3());
//! assert!((0.0..1.0).contains(&place.x) && (0.0..1.0).contains(&place.y)); // lit if place.z ≤ the stored depth
//! # Ok::<(), shadowfit::InputError>(())
//! ```
//!
//! ## Cascades
//!
//! [`Cascades`](cascades::Cascades) cut the view in depth and fit a map to each part, with any warp. See `docs/cascades.md`.
//!
#![doc = include_str!("../docs/images/concepts-cascades.svg")]
//!
//! ```
#![doc = include_str!("examples/cascades.txt")]
//! assert_eq!(maps.maps().count(), 4);
//! let block = maps.uniform(CascadeLayout::Array, |map| Some(map.bias(DepthFormat::Unorm24, 1.0).ok()?.offset()));
//! assert!(block.far[0] < block.far[1]); // `block.to_bytes()` is what the shader functions read
//! # Ok::<(), shadowfit::InputError>(())
//! ```
//!
//! ## Point lights
//!
//! A point light among its receivers has up to six [cube faces](Light::cube_face), each fitted like any light, or one or two
//! [paraboloids](Focus::paraboloids). See `docs/lights-all-around.md`.
//!
#![doc = include_str!("../docs/images/concepts-omni.svg")]
//!
//! ```
#![doc = include_str!("examples/room.txt")]
//! use shadowfit::omni::CubeFace;
//!
//! assert!(focus.fit(&settings).map().is_none()); // no single frustum
//! let down = lamp.cube_face(CubeFace::NegativeY, 0.1)?;
//! assert!(Focus::new(&view, &down, &scene).fit(&settings).map().is_some());
//! assert_eq!(focus.paraboloids(&settings).maps().len(), 2);
//! # Ok::<(), shadowfit::InputError>(())
//! ```
//!
//! ## Depth bias
//!
//! A texel stores the depth of its centre, so that a plane would shadow itself beside it: shadow acne.
//! [`ShadowMap::bias`] gives the least bias with which no plane does. Virtual samples
//! ([`TangentPlane`](depth::TangentPlane)) and second depth ([`DepthTest`](depth::DepthTest)) do without. See
//! `docs/depth.md`.
//!
#![doc = include_str!("../docs/images/concepts-bias.svg")]
//!
//! ```
#![doc = include_str!("examples/sun.txt")]
//! let bias = map.bias(DepthFormat::Unorm24, Filter::Hardware2x2.reach())?;
//! assert!(bias.constant > 0 && bias.slope_scale > 0.0); // `wgpu::DepthBiasState`
//! assert!(map.bias_distance(ground, up, &bias) < 0.5); // how far shadows detach, in world units
//! # Ok::<(), shadowfit::InputError>(())
//! ```
//!
//! ## Planner
//!
//! [`plan`](plan::plan()) chooses the cheapest sufficient technique for every light of a scene, and says why. See
//! `docs/planner.md`.
//!
//! ```
#![doc = include_str!("examples/plan.txt")]
//! let plan = plan(&view, &lights, &objects, &budget);
//! assert_eq!(plan.lights()[0].test(), DepthTest::Second);
//! let why: Vec<String> = plan.lights()[0].reasons().iter().map(ToString::to_string).collect();
//! assert!(why.contains(&"second depth, no bias: every caster is watertight".to_string()));
//! assert_eq!(plan.lights()[1].kind(), Kind::Nothing); // too far away to shadow anything
//! # Ok::<(), shadowfit::InputError>(())
//! ```
//!
//! # Conventions
//!
//! | what | is |
//! |---|---|
//! | handedness | either: a view's axes are its own; nothing else depends on it |
//! | vectors and matrices | columns: `clip = clip_from_world * position`; a name `b_from_a` takes a to b |
//! | planes | `normal · x + offset`, inside ≥ 0, normals point inwards |
//! | direction of light | points **towards** the light; axes of spots and hemispheres point away from it |
//! | angles, distances | radians, world units |
//! | clip space | the [`ClipSpace`] of the settings; wgpu's by default |
//! | depth | grows away from the light, 0 to 1, drawn with 'less', looked up with 'less or equal'; other ranges and reversed depth by the clip space |
//! | numbers | f64 inside; f32 in uploaded matrices, bulk culling and lists of boxes |
//!
//! # Other libraries
//!
//! Constructors take what converts into arrays, in f32 or f64: glam of any version (Bevy's, parry's), nalgebra, cgmath, mint,
//! tuples, arrays. Results are arrays in one call ([`IntoMatrix`](input::IntoMatrix) has the table for matrices).
//!
//! ```
//! # use shadowfit::Light;
//! # #[derive(Clone, Copy)] struct TheirVec3([f32; 3]); // bevy_math::Vec3, nalgebra::Vector3<f32>, ...
//! # impl From<TheirVec3> for [f32; 3] { fn from(vector: TheirVec3) -> Self { vector.0 } }
//! # let theirs = TheirVec3([0.4, 1.0, 0.2]);
//! let sun = Light::directional(theirs)?; // a vector of any library
//! assert_eq!(sun, Light::directional([0.4_f32, 1.0, 0.2])?);
//! # Ok::<(), shadowfit::InputError>(())
//! ```
//!
//! glam 0.33.12 to 0.34 are accepted, and the one in use is re-exported as [`glam`].
//!
//! # Features
//!
//! - `std` (default): square roots from the standard library; brings `alloc`. Without it, enable `libm`.
//! - `alloc`: what needs an allocator: the planner, and whether meshes are watertight ([`Solidity`](mesh::Solidity)).
//! - `libm`: square roots from the `libm` crate.
//! - `parry3d`: bodies, boxes and convex hulls from and to parry3d.
//! - `spade`: tessellation for paraboloid maps (`mesh::Tessellator`).
//! - `wgsl`: functions for a renderer's own shaders (module `wgsl`).
//! - `serde`: views, lights, settings and results can be stored; what is read is checked like any other input.
//!
//! # Sources
//!
//! - Perspective shadow maps: Stamminger & Drettakis, SIGGRAPH 2002.
//! - Light-space perspective: Wimmer, Scherzer & Purgathofer, EGSR 2004.
//! - Trapezoidal maps: Martin & Tan, *Anti-aliasing and Continuity with Trapezoidal Shadow Maps*, EGSR 2004.
//! - Aliasing of warped maps, and its lower bound: Lloyd, Tuft, Yoon & Manocha, EGSR 2006.
//! - Cascades: Zhang, Sun, Xu & Lun, *Parallel-Split Shadow Maps for Large-scale Virtual Environments*, VRCIA 2006.
//! - Paraboloid maps: Brabec, Annen & Seidel, *Shadow Mapping for Hemispherical and Omnidirectional Light Sources*, CGI 2002.
//! - Second depth, virtual samples: Wang & Molnar, *Second-Depth Shadow Mapping*, UNC TR94-019, 1994.
//! - Texture-space matrices, depth precision: Kilgard, *Shadow Mapping with Today's OpenGL Hardware*, GDC 2000.
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
pub mod seen;
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
    #[doc = include_str!("../docs/seen.md")]
    struct Seen;
    #[cfg(feature = "alloc")]
    #[doc = include_str!("../docs/planner.md")]
    struct Planner;
}
