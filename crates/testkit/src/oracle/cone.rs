//! The generators of a polyhedral cone in four dimensions, by brute force.
//!
//! In homogeneous coordinates the intersection of half-spaces is a cone of 4-vectors, and its
//! vertices and directions at infinity are the cone's extreme rays. The hull of points and
//! directions is the dual problem: its facets are the extreme rays of the cone of half-spaces that
//! hold all of them. One enumeration serves both.

use std::cmp::Ordering;

use dashu_int::IBig;

use super::homogeneous::Homogeneous;
use super::scalar::{Bounded, cross, dot, minors};

/// A generator of the cone of all x with h · x ≥ 0 for every given h.
pub struct Ray {
    /// Its direction, without a common divisor.
    pub vector: Homogeneous,
    /// Which of the given vectors h have h · x = 0, in ascending order.
    pub tight: Vec<usize>,
}

/// Finitely many rays whose non-negative combinations are exactly the cone of all x with
/// h · x ≥ 0 for every h in `half_spaces`.
///
/// A cone that contains whole lines has no extreme rays of its own; it is split into those lines,
/// given in both directions, and the rest of it orthogonal to them.
pub fn generators(half_spaces: &[Homogeneous]) -> Vec<Ray> {
    let lines: Vec<Homogeneous> =
        orthogonal_complement(half_spaces).into_iter().flat_map(|line| [line.clone(), line.negated()]).collect();
    let constraints = [half_spaces, &lines].concat();
    let mut rays = extreme_rays(&constraints);
    for ray in &mut rays {
        ray.tight.retain(|&index| index < half_spaces.len());
    }
    rays.extend(lines.into_iter().map(|vector| Ray { vector, tight: (0..half_spaces.len()).collect() }));
    rays
}

/// The extreme rays of a cone that contains no line: every one is where three independent
/// constraints are tight, so every triple is tried.
fn extreme_rays(constraints: &[Homogeneous]) -> Vec<Ray> {
    let count = constraints.len();
    let mut rays: Vec<Ray> = Vec::new();
    for i in 0..count {
        for j in i + 1..count {
            let (a, b) = (&constraints[i], &constraints[j]);
            let rounded = a.rounded().zip(b.rounded()).map(|(a, b)| minors(a, b));
            let mut exact = None;
            for (k, c) in constraints.iter().enumerate().skip(j + 1) {
                let candidate = rounded.as_ref().zip(c.rounded()).map(|(minors, c)| cross(minors, c));
                if candidate.is_some_and(|x| certainly_outside(&x, constraints)) {
                    continue;
                }
                // Three constraints tight on a known ray meet in that ray or are dependent.
                let known = |ray: &Ray| [i, j, k].iter().all(|t| ray.tight.contains(t));
                if rays.iter().any(known) {
                    continue;
                }
                let minors = exact.get_or_insert_with(|| minors(a.coords(), b.coords()));
                let x = Homogeneous::new(cross(minors, c.coords()));
                rays.extend(oriented_ray(x, [i, j, k], constraints));
            }
        }
    }
    rays
}

/// Whether both the rounded candidate `x` and its opposite certainly violate a constraint.
fn certainly_outside(x: &[Bounded; 4], constraints: &[Homogeneous]) -> bool {
    let (mut above, mut below) = (false, false);
    for sign in constraints.iter().filter_map(|constraint| dot(constraint.rounded()?, x).sign()) {
        above |= sign == Ordering::Greater;
        below |= sign == Ordering::Less;
        if above && below {
            return true;
        }
    }
    false
}

/// The one of `x` and `-x` that satisfies all constraints, if any, `triple` being tight on it.
fn oriented_ray(x: Homogeneous, triple: [usize; 3], constraints: &[Homogeneous]) -> Option<Ray> {
    if x.is_zero() {
        return None;
    }
    let mut tight = Vec::new();
    // Some constraint is not tight: a cone without lines has four independent ones.
    let mut orientation = Ordering::Equal;
    for (index, constraint) in constraints.iter().enumerate() {
        let side = if triple.contains(&index) { Ordering::Equal } else { constraint.side(&x) };
        if side == Ordering::Equal {
            tight.push(index);
        } else if orientation == Ordering::Equal {
            orientation = side;
        } else if side != orientation {
            return None;
        }
    }
    let vector = if orientation == Ordering::Less { x.negated() } else { x };
    Some(Ray { vector: vector.reduced(), tight })
}

/// A basis of all x with v · x = 0 for every v in `vectors`.
fn orthogonal_complement(vectors: &[Homogeneous]) -> Vec<Homogeneous> {
    let mut rows = Vec::new();
    extend_independent(&mut rows, vectors, 4);
    let rank = rows.len();
    while rows.len() < 4 {
        let mut triple = rows.clone();
        extend_independent(&mut triple, &axes(), 3);
        // Orthogonal to all rows, so independent of them, and among the rows the next one is
        // orthogonal to.
        rows.push(common(&triple[0], &triple[1], &triple[2]).reduced());
    }
    rows.split_off(rank)
}

/// Adds those of the candidates that are independent of the rows, up to a number of rows.
fn extend_independent(rows: &mut Vec<Homogeneous>, candidates: &[Homogeneous], limit: usize) {
    for candidate in candidates {
        if rows.len() < limit && is_independent(rows, candidate) {
            rows.push(candidate.clone());
        }
    }
}

/// Whether a vector is independent of at most three independent rows.
fn is_independent(rows: &[Homogeneous], x: &Homogeneous) -> bool {
    match rows {
        [] => !x.is_zero(),
        [a] => minors(a.coords(), x.coords()).iter().any(|minor| !minor.is_zero()),
        [a, b] => !common(a, b, x).is_zero(),
        [a, b, c] => !common(a, b, c).dot(x).is_zero(),
        _ => false,
    }
}

/// The vector orthogonal to three vectors, zero when they are dependent.
fn common(a: &Homogeneous, b: &Homogeneous, c: &Homogeneous) -> Homogeneous {
    Homogeneous::new(cross(&minors(a.coords(), b.coords()), c.coords()))
}

/// The four coordinate axes.
fn axes() -> [Homogeneous; 4] {
    std::array::from_fn(|axis| Homogeneous::new(std::array::from_fn(|i| IBig::from(u8::from(i == axis)))))
}
