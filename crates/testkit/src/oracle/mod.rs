//! The exact oracle: the focus body by exhaustive vertex enumeration.
//!
//! The crate under test clips polyhedra in floating point and finds the hull of the view and the
//! light by elimination. This oracle shares neither the arithmetic nor the method. It takes the
//! very `f64` planes, which are dyadic rationals and so integers up to a power of two, tries every
//! triple of planes for a vertex and every triple of vertices for a facet, and decides each sign
//! exactly. What it answers is the body those planes mean, so a difference is the crate's error.
//!
//! - `exact`: integers from `f64` and correctly rounded `f64` from ratios of integers.
//! - `scalar`, `homogeneous`: planes and points as exact 4-vectors, with a certified sign filter.
//! - `cone`: the generators of an intersection of half-spaces, by brute force.
//! - `hull`, `body`: the half-spaces of conv(V ∪ {l}), and the vertices of a body.
//! - `distance`, `margin`: how far a point is from a body, and a body from being empty.
//! - `loss`: what a computed body leaves out of an exact one.
//! - `focus`: the crate's bodies against the exact ones.
//! - `certified`: proofs, checked in floating point with certain bounds, that nothing is left out; most cases have one.

pub mod body;
pub mod certified;
pub mod cone;
pub mod distance;
pub mod exact;
pub mod focus;
pub mod homogeneous;
pub mod hull;
pub mod loss;
pub mod margin;
pub mod scalar;
