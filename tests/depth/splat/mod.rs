//! Balls and discs in a map, over views, lights and scenes at random: their bounds hold them and touch them, in f64 and
//! as the shader computes them in f32.

mod bounds;
mod rounds;
mod shader;
