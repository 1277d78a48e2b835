//! The oracle's own tests: known bodies, and definitions it does not compute with.

mod body;
mod certified;
mod distance;
mod exact;
mod hull;
mod margin;
mod random;
mod scalar;
mod shapes;
