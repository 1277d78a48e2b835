//! shadowfit
#![no_std]
mod axis; mod bounds; mod clip_space; mod convex; mod error; mod fit; mod focus; mod frame; mod homography; mod light; mod map; mod perspective; mod quality; mod rays; mod rounding; mod scene; mod settings; mod view; mod warp;
#[cfg(feature="serde")] mod infinity;
pub use clip_space::*; pub use convex::*; pub use error::*; pub use focus::*; pub use light::*; pub use scene::*; pub use view::*;
pub use fit::*; pub use map::*; pub use perspective::*; pub use quality::*; pub use settings::*;
pub use glam;
