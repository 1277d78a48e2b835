//! Arguments, help texts and opening steps that the commands share.

mod help;
mod map_args;
mod opening;
pub(crate) mod values;
mod view;

pub(crate) use help::{LIGHTS, scenes};
pub use map_args::{FormatArg, MapArgs};
pub use opening::{choose_lights, open, output_directory, place_camera, sort};
pub use view::ViewArgs;
