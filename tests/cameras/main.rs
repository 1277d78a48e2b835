//! Cameras as renderers hand them over: by matrices made in every way, with oblique near planes, and with jitter.

#![allow(clippy::disallowed_methods, reason = "angles and powers spread the cases, they are no part of a fit")]

#[path = "../arbitrary/mod.rs"]
mod arbitrary;
#[path = "../claims/mod.rs"]
mod claims;
mod jitter;
mod made;
mod named;
mod oblique;
mod shared;
