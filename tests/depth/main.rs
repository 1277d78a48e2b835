//! How depth is tested.
//!
//! - `bias`: the bias that a map needs.
//! - `splat`: points drawn as balls and discs.
//! - `virtual_samples`: depths of planes between samples.

#![allow(clippy::disallowed_methods, reason = "angles and powers spread the cases, they are no part of a fit")]

mod bias;
mod splat;
mod virtual_samples;
