//! Lights that shine all around.
//!
//! - `faces`: the faces of a cube.
//! - `paraboloid`: paraboloid maps.

#![allow(clippy::disallowed_methods, reason = "angles and powers spread the cases, they are no part of a fit")]

mod faces;
mod paraboloid;
