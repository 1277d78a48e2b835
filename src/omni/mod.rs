//! Shadows all around a light: cube faces and paraboloid maps.
//!
//! A cube face is a light like any other ([`Light::cube_face`](crate::Light::cube_face)), and is fitted like one. A
//! paraboloid map is no 4×4 projection: [`Focus::paraboloids`](crate::Focus::paraboloids) fits one or two. The page
//! `docs/lights-all-around.md` of the package compares them.

mod paraboloid;

pub use crate::input::light::CubeFace;
pub use paraboloid::{Paraboloid, ParaboloidRounding, Paraboloids};
