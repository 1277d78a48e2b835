//! Plans: the least that is enough for each light.
//!
//! - `near`: near distances of lights at a position.
//! - `plans`: what holds for every plan.

#![allow(clippy::disallowed_methods, reason = "angles and powers spread the cases, they are no part of a fit")]

#[cfg(feature = "alloc")]
mod near;
#[cfg(feature = "alloc")]
mod plans;
