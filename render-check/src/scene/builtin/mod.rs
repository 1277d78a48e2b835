//! Built-in scenes, made by code.

mod behind;
mod chess_board;
mod cloud;
mod ground;
mod leaves;
mod room;
mod solids;
mod street;
mod table;

use super::loaded::LoadedScene;

/// A built-in scene.
#[derive(Clone, Copy)]
pub struct BuiltIn {
    /// Its name on the command line.
    pub name: &'static str,
    /// A description.
    pub shows: &'static str,
    /// Builds it.
    pub make: fn() -> LoadedScene,
}

/// All built-in scenes.
pub const BUILT_IN: [BuiltIn; 8] = [
    BuiltIn {
        name: "chess-board",
        shows: "a long board with pieces from a low camera, as in the paper's Fig. 1",
        make: chess_board::make,
    },
    BuiltIn {
        name: "street",
        shows: "a street of nearly 400 m from a person's height: much depth in one picture",
        make: street::make,
    },
    BuiltIn {
        name: "behind",
        shows: "a square in a low sun, with the shadows of things that stand behind the viewer",
        make: behind::make,
    },
    BuiltIn {
        name: "leaves",
        shows: "a tree of single leaf sheets over a bench: casters that are thin, dense and open",
        make: leaves::make,
    },
    BuiltIn {
        name: "room",
        shows: "a room from inside, with a lamp above the view and the sun in the window",
        make: room::make,
    },
    BuiltIn {
        name: "table",
        shows: "a table with thin legs on a floor, all of it solid: where shadows leave what casts them",
        make: table::make,
    },
    BuiltIn {
        name: "cloud",
        shows: "points alone, as a scanner takes them: an undulating ground and a ball over it",
        make: cloud::make,
    },
    BuiltIn { name: "ground", shows: "a flat plate without any height and nothing on it", make: ground::make },
];

#[cfg(test)]
mod tests;
