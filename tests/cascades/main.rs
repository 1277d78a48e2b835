//! Several maps for one view, and one map for several views.
//!
//! - `shared`: one map for several views.
//! - `splits`: a view cut in depth.

#![allow(clippy::disallowed_methods, reason = "angles and powers spread the cases, they are no part of a fit")]

mod shared;
mod splits;
