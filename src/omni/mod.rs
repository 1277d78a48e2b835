//! Lights that shine all around: the faces of a cube map, and paraboloid maps.
//!
//! A face of a cube is a light like any other ([`Light::cube_face`](crate::Light::cube_face)), and is fitted like one. A paraboloid
//! map is no 4×4 projection: [`Focus::paraboloids`](crate::Focus::paraboloids) fits one or two.

mod paraboloid;

pub use crate::input::light::CubeFace;
pub use paraboloid::{Paraboloid, ParaboloidRounding, Paraboloids};
