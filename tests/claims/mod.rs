//! What is claimed of every case, one concept a file: called by the property tests with cases at random, by the fuzz
//! targets with those that they find, and by the replay of what fuzzing has kept.
//!
//! - `anything`, `constructors`: raw bits in every public constructor, and what is made of them.
//! - `results`: nothing that the crate says of a fit is NaN.
//! - `rays`, `scaling`: where a map puts things in f64, and what powers of two do to it.
//! - `single_precision`: what f32 makes of a map.
//! - `shared`: one map for several views.
//! - `paraboloid`, `slices`, `virtual_samples`, `town` and `planner`: the maps, tests and plans of those names.
//! - `targets`: all claims of a fuzz target, from its bytes.

#![allow(dead_code, unused_imports, reason = "every target that takes this module in uses a part of it")]
#![allow(clippy::disallowed_methods, reason = "angles and powers spread the cases, they are no part of a fit")]

pub(crate) mod anything;
pub(crate) mod constructors;
pub(crate) mod paraboloid;
#[cfg(feature = "std")]
pub(crate) mod planner;
pub(crate) mod rays;
pub(crate) mod results;
pub(crate) mod scaling;
pub(crate) mod shared;
pub(crate) mod single_precision;
pub(crate) mod slices;
pub(crate) mod targets;
#[cfg(feature = "std")]
pub(crate) mod town;
pub(crate) mod virtual_samples;
