//! Techniques, kinds of maps, and how a light is split among several maps.

mod clip;
mod layout;
mod no_map;
mod slicing;
mod split;
mod technique;

pub use clip::ClipConvention;
pub use layout::{BENT, Layout};
pub use no_map::{NoMap, map_or_reason};
pub use slicing::{Slicing, SplitArg, slices};
pub use split::Split;
pub use technique::Technique;
