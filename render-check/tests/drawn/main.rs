//! What is drawn on the graphics card against ray-traced truth.

mod ablation;
mod cameras;
mod cascades;
mod common;
mod faults;
mod sweep;
mod verdicts;
