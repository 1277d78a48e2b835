//! What f32 makes of maps.
//!
//! - `precision`: tiny near planes and large worlds.
//! - `single_precision`: everything in a map that must be.

#![allow(clippy::disallowed_methods, reason = "angles and powers spread the cases, they are no part of a fit")]

#[cfg(feature = "alloc")]
mod precision;
mod single_precision;
