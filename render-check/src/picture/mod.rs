//! The pictures that are written as PNG.

mod canvas;
mod cascade_view;
mod close_up;
mod light_view;
mod lines;
mod map_view;
mod shade;
mod text;
mod verdict_view;
mod view;

pub use canvas::{Canvas, Colour, Sample, save};
pub use cascade_view::tinted;
pub use close_up::CloseUp;
pub use light_view::{light_lens, light_view};
pub use lines::{Line, Pen, draw_lines};
pub use map_view::{DepthMap, TitledMap, maps_view};
pub use shade::Lighting;
pub use verdict_view::{aliasing_map, difference, shaded, side_by_side, stored_map};
pub use view::camera_view;

#[cfg(test)]
mod tests;
