//! Whether nothing is lost of a body, certified in floating point.
//!
//! Exact bodies are never made here. What is asked is whether the exact body is in the half-space of each computed plane,
//! and in the hull of the computed vertices, and both have short proofs that are easily checked with a bound on all
//! roundings, however they were found: a sum of the exact body's half-spaces, and a surface around it. Where no proof is
//! found the exact oracle decides, and only that may find that something is lost.
//!
//! - `precise`: numbers of twice the precision with a bound on their error.
//! - `half_spaces`: half-spaces that hold the exact body, and what their sums hold.
//! - `program`: linear programs that guess which sums to try.
//! - `enclosure`: from planes that the body is beyond to the hull of vertices.

pub mod enclosure;
pub mod half_spaces;
pub mod precise;
mod program;

use shadowfit::focus::Plane;
use shadowfit::glam::DVec3;

use enclosure::{Doubt, Enclosure, Side};
use half_spaces::HalfSpaces;
use precise::admits;

use crate::oracle::loss::Shape;

/// By how much nothing is lost, at least, in units of ε times the magnitude of a plane's terms.
#[derive(Clone, Copy, Debug)]
pub struct Margins {
    /// By how much the exact body is inside of the computed planes that are no sides of the box.
    pub planes: f64,
    /// How much of that is left beyond what is certain of the exact body at the vertices.
    pub vertices: f64,
}

/// Why nothing was certified.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Uncertain {
    /// Numbers too large or too small for the error bounds.
    Range,
    /// The computed body is empty.
    Empty,
    /// A computed plane.
    Plane,
    /// The hull of the computed vertices.
    Hull(Doubt),
}

/// How much of a plane's slack of 96 is enough, in ε times the magnitude of its terms: less is looked into more closely.
pub const ENOUGH: f64 = 95.0;

/// The margins of a computed body around an exact one, if nothing is certainly lost.
pub fn certify(computed: &Shape, exact: &HalfSpaces) -> Result<Margins, Uncertain> {
    if computed.is_empty() {
        let unlimited = Margins { planes: f64::INFINITY, vertices: f64::INFINITY };
        return if exact.is_certainly_empty() { Ok(unlimited) } else { Err(Uncertain::Empty) };
    }
    let in_range = computed.vertices.iter().all(|vertex| admits(&vertex.to_array()))
        && computed.planes.iter().all(|plane| admits(&plane.to_row().to_array()));
    if !in_range {
        return Err(Uncertain::Range);
    }
    let sides: Vec<Side> = computed.planes.iter().map(|plane| side(*plane, exact)).collect();
    if !sides.iter().all(|side| side.least >= 0.0) {
        return Err(Uncertain::Plane);
    }
    let moved = sides.iter().filter(|side| side.of_box.is_none());
    let planes = moved.map(|side| side.least / side.unit).fold(f64::INFINITY, f64::min);
    let vertices = Enclosure::new(computed, &sides, exact.bounds()).margin().map_err(Uncertain::Hull)?;
    Ok(Margins { planes, vertices })
}

/// Which side of a box a plane is: its axis, and whether it is the one of the largest coordinates.
pub fn side_of_box(plane: &Plane, (min, max): (DVec3, DVec3)) -> Option<(usize, bool)> {
    (0..3).find_map(|axis| {
        let normal = DVec3::AXES[axis];
        let lower = (*plane == Plane::new(normal, -min[axis])).then_some((axis, false));
        lower.or((*plane == Plane::new(-normal, max[axis])).then_some((axis, true)))
    })
}

/// ε times the largest magnitude of a plane's terms in a box: what its slack is measured in.
pub fn unit(plane: &Plane, (min, max): (DVec3, DVec3)) -> f64 {
    f64::EPSILON * (plane.normal.abs().dot(min.abs().max(max.abs())) + plane.offset.abs())
}

fn side(plane: Plane, exact: &HalfSpaces) -> Side {
    let (unit, of_box) = (unit(&plane, exact.bounds()), side_of_box(&plane, exact.bounds()));
    let least = if of_box.is_some() { 0.0 } else { exact.least(plane.to_row().to_array(), ENOUGH * unit) };
    Side { plane, least, of_box, unit }
}
