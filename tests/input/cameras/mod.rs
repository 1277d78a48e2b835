//! Cameras as renderers hand them over: by matrices made in every way, with oblique near planes, and with jitter.

mod jitter;
mod made;
mod named;
mod oblique;
