//! What goes in: accepted in every convention, refused with a reason.
//!
//! - `cameras`: cameras as renderers hand them over.
//! - `conventions`: one camera in every convention.
//! - `depth_buffer`: values of the camera's depth buffer.
//! - `depth_tiles`: depth buffers reduced to tiles.
//! - `doors`: spots of renderers, lights within planes, scenes of many planes.
//! - `errors`: what is refused.
//! - `projections`: what a matrix may hold.
//! - `serde`: what is stored and read again.

#![allow(clippy::disallowed_methods, reason = "angles and powers spread the cases, they are no part of a fit")]

mod cameras;
mod conventions;
mod depth_buffer;
mod depth_tiles;
mod doors;
mod errors;
mod projections;
#[cfg(feature = "serde")]
mod serde;
