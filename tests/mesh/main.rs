//! Meshes: which are closed, and how finely they must be cut.
//!
//! - `solidity`: which meshes are closed.
//! - `tessellation`: meshes cut for paraboloid maps.

#![allow(clippy::disallowed_methods, reason = "angles and powers spread the cases, they are no part of a fit")]

#[cfg(feature = "alloc")]
mod solidity;
#[cfg(feature = "spade")]
mod tessellation;
