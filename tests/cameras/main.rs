//! Cameras as renderers hand them over: by matrices made in every way, with oblique near planes, and with jitter.

#![allow(clippy::disallowed_methods, reason = "angles and powers spread the cases, they are no part of a fit")]

mod jitter;
mod made;
mod named;
mod oblique;
mod shared;
