//! Draws scenes with the matrices of `shadowfit` on a graphics card and compares every pixel with ray-traced truth.
//!
//! What the card does is what a renderer does: it draws the casters that culling against H leaves, through the matrix as
//! the crate gives it, and tests the pixels of a camera's image against the map. What is true is found by rays in f64.
//! The modules, each built on those above it:
//!
//! | module | what it holds |
//! |---|---|
//! | [`scene`] | triangles, cameras and lights: of a `.glb` file, or of a scene made by code |
//! | [`output`] | progress bars, tables, JSON |
//! | [`trace`] | rays against the triangles, in f64 |
//! | [`maps`] | the techniques, the kinds of maps, and which of a light's maps covers a point |
//! | [`gpu`] | the passes on the card: camera, shadow map, shadow test |
//! | [`verdict`] | the ray-traced truth about every pixel, and what is wrong with a rendered one |
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
//! | [`cmd::ablation`] | draws each thing that a plan leaves out or asks for, with and without it |
//! | [`cmd::draw`] | the fit alone and pictures of H, by ray casting: needs no card |

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
