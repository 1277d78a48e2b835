//! Measures what accuracy costs in time, and writes it down: `cargo run --release -p report`.
//!
//! Each chapter measures, in one run and turn by turn, all that it compares; what it found becomes tables, plots and
//! sentences by rules, so that nothing in a report is typed in. The data flows down this list:
//!
//! | module | what it holds |
//! |---|---|
//! | [`args`] | the command line |
//! | [`size`] | how much is measured: all of it, or little, to see that it works |
//! | [`timing`] | contenders timed in turn |
//! | [`statistics`] | medians, quantiles, exponents of growth |
//! | [`front`] | what nothing else beats in both time and error |
//! | [`arithmetic`] | the same body and matrix in f32, f64, f64 with bounds, and exactly |
//! | [`body`] | what is drawn and what is wasted, by the body that is fitted to; the crate and its peers |
//! | [`map`] | wrong pixels and aliasing over time, by warp, cascades, size, kind of map and test |
//! | [`growth`] | how cost grows with lights, casters, planes, texels and triangles |
//! | [`advice`] | the settings that follow from it |
//! | [`chapter`] | what a chapter is: findings, tables, plots, raw figures |
//! | [`plot`] | plots as SVG and PNG |
//! | [`machine`] | what it ran on |
//! | [`write`](mod@write) | the report's files |
//! | [`contents`] | what is in a report |
//! | [`run`](mod@run) | a report made: part by part, then written |

#![allow(
    clippy::disallowed_methods,
    reason = "the fitting path needs the same bits on every platform; statistics and plots do not"
)]

pub mod advice;
pub mod args;
pub mod arithmetic;
pub mod body;
pub mod chapter;
pub mod contents;
pub mod front;
pub mod growth;
pub mod machine;
pub mod map;
pub mod plot;
pub mod run;
pub mod size;
pub mod statistics;
pub mod timing;
pub mod write;
