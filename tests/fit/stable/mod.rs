//! Stable maps: texels that stay where they are in the world, whatever the camera does.
//!
//! Each property runs some thousands of cases from a fixed seed; `SHADOWFIT_CASES=100000` in the environment runs that many
//! of each instead.

mod cameras;
mod depth;
mod grid;
mod refusals;
mod windows;
