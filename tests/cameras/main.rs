//! Cameras as renderers hand them over: by matrices made in every way, with oblique near planes, and with jitter.

#[path = "../arbitrary/mod.rs"]
mod arbitrary;
mod jitter;
mod made;
mod named;
mod oblique;
