//! Linear programs in a box: a guess at which half-spaces decide, by the dual simplex method.
//!
//! Nothing here is certain, and nothing needs to be: what comes out are non-negative multipliers, and whether they prove
//! anything is for `half_spaces` to certify.

use shadowfit::glam::{DMat3, DVec3};

/// What the multipliers are expected to prove.
pub(super) enum Guess {
    /// f − Σ λᵢ hᵢ is, over the box, about the least value of f in the half-spaces.
    Least(Vec<(usize, f64)>),
    /// Σ λᵢ hᵢ is negative all over the box: the half-spaces have no point in it in common.
    Empty(Vec<(usize, f64)>),
}

/// Pivots before it gives up: a vertex is reached by a few.
const PIVOTS: usize = 50;

/// How far outside of a half-space, in units of the box, a point counts as outside.
const OUTSIDE: f64 = 1e-15;

/// The half-spaces and a box in coordinates in which the box is about the unit cube.
pub(super) struct Program {
    /// Unit normals with offsets, the six sides of the box first.
    rows: Vec<(DVec3, f64)>,
    /// The lengths that the half-spaces were divided by.
    lengths: Vec<f64>,
    middle: DVec3,
    size: f64,
}

/// The sides of the box among the rows.
const SIDES: usize = 6;

impl Program {
    /// Of half-spaces `[nx, ny, nz, offset]` and a box, which may be flat or a point.
    pub(super) fn new(half_spaces: impl Iterator<Item = [f64; 4]>, min: DVec3, max: DVec3) -> Self {
        let (middle, half) = ((min + max) * 0.5, (max - min) * 0.5);
        let size = if half == DVec3::ZERO { 1.0 } else { half.max_element() };
        let mut program = Self { rows: Vec::new(), lengths: Vec::new(), middle, size };
        for axis in 0..3 {
            program.rows.extend([(DVec3::AXES[axis], half[axis] / size), (-DVec3::AXES[axis], half[axis] / size)]);
        }
        for row in half_spaces {
            let (row, length) = program.row(row);
            program.rows.push(row);
            program.lengths.push(length);
        }
        program
    }

    fn row(&self, [x, y, z, offset]: [f64; 4]) -> ((DVec3, f64), f64) {
        let normal = DVec3::new(x, y, z);
        let length = normal.length();
        let scale = if length > 0.0 { length.recip() } else { 0.0 };
        ((normal * scale, (normal.dot(self.middle) + offset) * scale / self.size), length)
    }

    /// The multipliers of the half-spaces among these rows, for f of a length.
    fn multipliers(&self, rows: impl Iterator<Item = (usize, f64)>, length: f64) -> Vec<(usize, f64)> {
        rows.filter(|&(row, factor)| row >= SIDES && factor > 0.0)
            .map(|(row, factor)| (row - SIDES, factor * length / self.lengths[row - SIDES]))
            .filter(|(_, factor)| factor.is_finite())
            .collect()
    }

    /// The least value of f.
    pub(super) fn least(&self, f: [f64; 4]) -> Option<Guess> {
        let ((normal, _), length) = self.row(f);
        // The corner of the box where f is least.
        let mut basis: [usize; 3] = std::array::from_fn(|axis| 2 * axis + usize::from(normal[axis] < 0.0));
        for _ in 0..PIVOTS {
            let normals = DMat3::from_cols_array_2d(&basis.map(|row| self.rows[row].0.to_array()));
            let inverse = normals.inverse();
            if !inverse.is_finite() {
                return None;
            }
            let point = inverse.transpose() * -DVec3::from(basis.map(|row| self.rows[row].1));
            let factors = inverse * normal;
            let at = |(n, offset): &(DVec3, f64)| n.dot(point) + offset;
            let (entering, value) = self
                .rows
                .iter()
                .map(at)
                .enumerate()
                .filter(|(row, _)| !basis.contains(row))
                .min_by(|a, b| a.1.total_cmp(&b.1))?;
            if value >= -OUTSIDE {
                return Some(Guess::Least(self.multipliers(basis.into_iter().zip(factors.to_array()), length)));
            }
            let parts = inverse * self.rows[entering].0;
            let ratio = |k: usize| factors[k].max(0.0) / parts[k];
            let leaving = (0..3).filter(|&k| parts[k] > 1e-12).min_by(|&a, &b| ratio(a).total_cmp(&ratio(b)));
            let Some(leaving) = leaving else {
                let rows = basis.into_iter().zip((-parts).to_array()).chain([(entering, 1.0)]);
                return Some(Guess::Empty(self.multipliers(rows, 1.0)));
            };
            basis[leaving] = entering;
        }
        None
    }

    /// Multipliers that are expected to prove that the half-spaces have no point in common.
    pub(super) fn empty(&self) -> Option<Vec<(usize, f64)>> {
        // The half-space that least of the box is in.
        let reach = |row: usize| {
            let (normal, offset) = self.rows[row];
            (0..3).map(|axis| normal[axis].abs() * self.rows[2 * axis].1).sum::<f64>() + offset
        };
        let least = (SIDES..self.rows.len()).min_by(|&a, &b| reach(a).total_cmp(&reach(b)))?;
        let one = (least - SIDES, self.lengths[least - SIDES].recip());
        if reach(least) < 0.0 {
            return Some(vec![one]);
        }
        let (normal, offset) = self.rows[least];
        let offset = offset * self.size - normal.dot(self.middle);
        let opposite = [-normal.x, -normal.y, -normal.z, -offset];
        match self.least(opposite)? {
            Guess::Empty(multipliers) => Some(multipliers),
            Guess::Least(multipliers) => Some([multipliers, vec![one]].concat()),
        }
    }
}
