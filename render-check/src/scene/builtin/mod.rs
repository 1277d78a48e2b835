//! The scenes that need no file: made by code, each showing one thing.

mod chess_board;
mod solids;

use super::LoadedScene;

/// A built-in scene.
#[derive(Clone, Copy)]
pub struct BuiltIn {
    /// What the command line calls it.
    pub name: &'static str,
    /// What it shows.
    pub shows: &'static str,
    /// Makes it.
    pub make: fn() -> LoadedScene,
}

/// All of them.
pub const BUILT_IN: [BuiltIn; 1] = [BuiltIn {
    name: "chess-board",
    shows: "a long board with pieces from a low camera, as in the paper's Fig. 1",
    make: chess_board::make,
}];
