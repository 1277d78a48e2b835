//! Tables of the bits of results: `tests/bits` holds shadowfit to them under every feature, and `tests/bits/target.sh` on another
//! target.
//!
//! - `setups`: views, lights and scenes in fixed numbers.
//! - `table`: what every set-up comes to.
//! - `plans`: the plans of some of them.

#![allow(missing_docs, reason = "not published: what a name says is not said again")]

#[cfg(feature = "alloc")]
pub mod plans;
pub mod setups;
pub mod table;
