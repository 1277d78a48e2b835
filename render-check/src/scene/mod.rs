//! Scenes: triangles in world space, cameras and lights, from a `.glb` file or made by code.

mod accessor;
mod builtin;
mod camera;
mod cloud;
pub mod damage;
mod glb;
mod left_out;
mod light;
mod load;
mod loaded;
mod mesh;
mod vector;

pub use builtin::{BUILT_IN, BuiltIn};
pub use camera::Camera;
pub use cloud::Disc;
pub use left_out::LeftOut;
pub use light::LightSpec;
pub use load::load;
pub use loaded::LoadedScene;
pub use mesh::{Mesh, MeshBuilder, Object, Part};
pub use vector::parse_vector;
