//! Techniques, kinds of maps, and how a light is split among several maps.

mod cascading;
mod clip;
mod layout;
mod no_map;
mod split;
mod technique;

pub use cascading::{Cascading, Cuts, SplitArg, cascades};
pub use clip::ClipConvention;
pub use layout::{BENT, Layout};
pub use no_map::{NoMap, map_or_reason};
pub use split::Split;
pub use technique::Technique;
