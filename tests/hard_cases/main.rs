//! The hard cases of shadow fitting, one named test each: what breaks elsewhere, and what must come out instead.
//!
//! Boundaries are swept from both sides by 10⁻ᵏ, k = 1 … 16, and by single steps of f64. Errors of matrices are against the
//! same formulas in numbers of 512 bits (`tables`, which `cargo run --release -p testkit --bin stability` prints too). Where
//! another test shows a row over cases at random, the test here is the short, exact one, and says which the other is.
//!
//! - `light_and_view`: rows 1 to 8, 15 and 16.
//! - `light_and_scene`: rows 9 to 14.
//! - `bodies`: rows 17 to 25.
//! - `camera`: rows 26 to 28.
//! - `output`: rows 29 to 35.
//! - `input`: row 36.
//! - `figures`: the tables keep their bounds.

#![allow(clippy::disallowed_methods, reason = "angles and powers make the sweeps, they are no part of a fit")]

mod bodies;
mod camera;
mod corners;
mod empty;
mod far_lists;
mod figures;
mod input;
mod light_and_scene;
mod light_and_view;
mod output;
mod place;
mod sweep;
// The example prints what the tests here hold.
