//! Fits: the matrix and what is said of it.
//!
//! - `aliasing`: the aliasing that is reported.
//! - `best`: the search for the best matrix.
//! - `closed_forms`: figures that have closed forms.
//! - `continuity`: the matrix as a function of every input.
//! - `figures`: figures that follow from others.
//! - `limit`: the least aliasing that any map could have.
//! - `paper_construction`: the paper's construction, class by class.
//! - `properties`: what holds for every fit.
//! - `snapshots`: matrices as they are uploaded.
//! - `stable`: texels that stay where they are.

#![allow(clippy::disallowed_methods, reason = "angles and powers spread the cases, they are no part of a fit")]

mod aliasing;
mod best;
mod closed_forms;
mod continuity;
mod figures;
mod limit;
mod paper_construction;
mod properties;
mod seen;
mod snapshots;
mod stable;
