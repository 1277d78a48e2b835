//! Fits shadow maps to real scenes and shows what came of it: a table, and pictures of the camera's view, of the
//! light's view and of the shadow maps themselves.
//!
//! The pictures are ray-cast on the processor, so the tool needs no graphics driver; the data flows down this list:
//!
//! | module | what it holds |
//! |---|---|
//! | [`args`] | the command line |
//! | [`light`] | a light as a person writes it, and as the fit takes it |
//! | [`scene`] | the triangles, cameras and lights of a `.glb` file, or of the built-in chess board |
//! | [`trace`] | rays against the triangles |
//! | [`framing`] | which camera looks at the scene, and its near and far planes |
//! | [`fitting`] | the calls into `shadowfit`, and their time |
//! | [`picture`] | what is written as PNG |
//! | [`table`] | what is printed |
//! | [`check`] | all of it, in order |

#![allow(
    clippy::disallowed_methods,
    reason = "the fitting path needs the same bits on every platform; pictures and default cameras do not"
)]

pub mod args;
pub mod check;
pub mod check_table;
pub mod draw;
pub mod fitting;
pub mod fitting_table;
pub mod framing;
pub mod gpu;
pub mod light;
pub mod opening;
pub mod picture;
pub mod progress;
pub mod report;
pub mod run;
pub mod scene;
pub mod stage;
pub mod sweep;
pub mod technique;
pub mod trace;
pub mod verdict;
pub mod walk;
