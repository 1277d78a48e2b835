//! What is claimed of every case, one concept a file: called by the property tests with cases at random, by the fuzz
//! targets with those that they find, and by the replay of what fuzzing has kept.
//!
//! - `anything`, `constructors`: raw bits in every public constructor, and what is made of them.
//! - `results`: nothing that the crate says of a fit is NaN.
//! - `rays`, `scaling`: where a map puts things in f64, and what powers of two do to it.
//! - `single_precision`: what f32 makes of a map.
//! - `shared`: one map for several views.
//! - `paraboloid`, `cascades`, `virtual_samples`, `town` and `planner`: the maps, tests and plans of those names.
//! - `targets`: all claims of a fuzz target, from its bytes.

#![allow(clippy::disallowed_methods, reason = "angles and powers spread the cases, they are no part of a fit")]

pub mod anything;
pub mod cascades;
pub mod constructors;
pub mod paraboloid;
#[cfg(feature = "alloc")]
pub mod planner;
pub mod rays;
pub mod results;
pub mod scaling;
pub mod shared;
pub mod single_precision;
pub mod targets;
#[cfg(feature = "alloc")]
pub mod town;
pub mod virtual_samples;
