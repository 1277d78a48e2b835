//! Draws scenes with fitted shadow maps on the GPU and compares every pixel with ray-traced ground truth.
//!
//! The GPU side is a minimal renderer: it culls casters against the caster volume H, draws them through the crate's
//! matrix, and tests each pixel of a camera's image against the map. The ground truth ("the truth" in short) is computed
//! by rays in f64. A "local light" is a point or spot light.
//!
//! The modules, each built on those above it:
//!
//! | module | contents |
//! |---|---|
//! | [`scene`] | triangles, cameras and lights: of a `.glb` file, or of a scene made by code |
//! | [`output`] | progress bars, tables, JSON |
//! | [`trace`] | rays against the triangles, in f64 |
//! | [`maps`] | the techniques, the kinds of maps, and which of a light's maps covers a point |
//! | [`gpu`] | the passes on the GPU: camera, shadow map, shadow test |
//! | [`verdict`] | the ray-traced truth about every pixel, and the verdict on a rendered image |
//! | [`stage`] | one camera in front of one scene, drawn; its near and far planes |
//! | [`run`] | one light with one technique: fitted, culled, drawn, tested, judged, reported |
//! | [`picture`] | PNG files |
//! | [`cli`] | arguments, help and opening steps that the commands share |
//! | [`cmd`] | the commands |
//!
//! and the commands:
//!
//! | module | what it does |
//! |---|---|
//! | [`cmd::check`] | one scene: every light, every technique, every size |
//! | [`cmd::sweep`] | the hard cases |
//! | [`cmd::walk`] | moves the camera and counts pixels that flicker |
//! | [`cmd::plan`] | plans all lights of a scene, draws them as planned and checks the result |
//! | [`cmd::ablation`] | draws with and without each effect that a plan uses or omits |
//! | [`cmd::draw`] | the fit alone and pictures of H, by ray casting: needs no GPU |

#![allow(
    clippy::disallowed_methods,
    reason = "the fitting path needs the same bits on every platform; pictures and default cameras do not"
)]

pub mod cli;
pub mod cmd;
pub mod gpu;
pub mod maps;
pub mod output;
pub mod picture;
pub mod run;
pub mod scene;
pub mod stage;
pub mod trace;
pub mod verdict;
