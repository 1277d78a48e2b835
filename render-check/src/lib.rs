//! Draws scenes with the matrices of `shadowfit` on a graphics card and compares every pixel with ray-traced truth.
//!
//! What the card does is what a renderer does: it draws the casters that culling against H leaves, through the matrix as
//! the crate gives it, and tests the pixels of a camera's image against the map. What is true is found by rays in f64.
//! The data flows down this list:
//!
//! | module | what it holds |
//! |---|---|
//! | [`args`], `values`, `help` | the command line |
//! | [`light`] | a light as a person writes it, and as the fit takes it |
//! | [`scene`] | the triangles, cameras and lights of a `.glb` file, or of a scene made by code |
//! | [`trace`] | rays against the triangles |
//! | [`framing`] | which camera looks at the scene, and its near and far planes |
//! | [`opening`] | all of the above, as every command begins |
//! | [`gpu`] | the passes on the card: camera, shadow map, shadow test |
//! | [`verdict`] | the truth about every pixel, and what is wrong with a rendered one |
//! | [`stage`] | one camera before one scene, drawn |
//! | [`split`], [`slicing`] | which of a light's maps answers for a point, and the view cut into slices |
//! | [`layout`], [`cut`] | the kinds of maps, and triangles cut for those that bend lines |
//! | [`technique`], [`fitted_maps`], [`run`] | one light through one kind of map: fitted, culled, drawn, tested, judged |
//! | [`frames`] | frame after frame of the same maps, to be timed |
//! | [`prediction`] | what the fit says of the maps beforehand |
//! | [`report`], [`table`], [`check_table`] | what is written and printed of it |
//! | [`picture`] | what is written as PNG |
//!
//! and into the commands:
//!
//! | module | what it does |
//! |---|---|
//! | [`check`] | one scene: every light, every technique, every size |
//! | [`sweep`] | the hard cases |
//! | [`walk`] | a camera that moves, and what flickers |
//! | [`plan`] | all lights of a scene, planned ([`planned`]), drawn as planned and checked |
//! | [`ablation`] | what a plan leaves out and asks for, drawn with and without |
//! | [`draw`] | the fit alone ([`fitting`], [`fitting_table`]) and pictures of H, by ray casting: needs no card |

#![allow(
    clippy::disallowed_methods,
    reason = "the fitting path needs the same bits on every platform; pictures and default cameras do not"
)]

pub mod ablation;
pub mod args;
pub mod check;
pub mod check_table;
pub mod cut;
pub mod draw;
pub mod fitted_maps;
pub mod fitting;
pub mod fitting_table;
pub mod frames;
pub mod framing;
pub mod gpu;
pub(crate) mod help;
pub mod layout;
pub mod light;
pub mod opening;
pub mod picture;
pub mod plan;
pub mod planned;
pub mod prediction;
pub mod progress;
pub mod report;
pub mod run;
pub mod scene;
pub mod slicing;
pub mod split;
pub mod stage;
pub mod sweep;
pub mod table;
pub mod technique;
pub mod trace;
pub(crate) mod values;
pub mod verdict;
pub mod walk;
