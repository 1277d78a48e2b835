//! Focus bodies, what is in them and what they are made of.
//!
//! - `casters`: which casters a fit draws.
//! - `lists`: scenes of lists.
//! - `oracle`: the crate's bodies against the exact ones, and the oracle itself.
//! - `parry`: bodies to and from parry3d.
//! - `polygons`: faces of bodies.

#![allow(clippy::disallowed_methods, reason = "angles and powers spread the cases, they are no part of a fit")]

mod casters;
mod lists;
mod oracle;
#[cfg(feature = "parry3d")]
mod parry;
mod polygons;
