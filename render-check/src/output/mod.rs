//! Output to the terminal and to files.

mod files;
mod lines;
pub mod progress;
pub mod table;

pub use files::{make_directory, write_json};
pub use lines::{complain, say};
