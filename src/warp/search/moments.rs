//! Weighted means and covariances of four numbers, gathered four points at a time.

use glam::{DMat4, DVec4, Mat4, Vec4};

/// Sums of weighted vectors of four numbers.
#[derive(Clone, Copy)]
pub(super) struct Moments {
    weight: Vec4,
    first: [Vec4; 4],
    /// The products of coordinates, each pair once.
    second: [Vec4; 10],
}

/// The pairs of coordinates.
const PAIRS: [(usize, usize); 10] =
    [(0, 0), (0, 1), (0, 2), (0, 3), (1, 1), (1, 2), (1, 3), (2, 2), (2, 3), (3, 3)];

/// A weighted mean and covariance.
#[derive(Clone, Copy)]
pub(super) struct Spread {
    pub(super) weight: f32,
    pub(super) mean: [f32; 4],
    /// For each pair of coordinates.
    pub(super) covariance: [f32; 10],
}

impl Moments {
    pub(super) const NONE: Self = Self { weight: Vec4::ZERO, first: [Vec4::ZERO; 4], second: [Vec4::ZERO; 10] };

    #[inline(always)]
    pub(super) fn include(&mut self, weight: Vec4, value: [Vec4; 4]) {
        let [a, b, c, d] = value;
        let [wa, wb, wc, wd] = [a * weight, b * weight, c * weight, d * weight];
        self.weight += weight;
        // Written out: loops over pairs take twice as long.
        let [sa, sb, sc, sd] = self.first;
        self.first = [sa + wa, sb + wb, sc + wc, sd + wd];
        let [aa, ab, ac, ad, bb, bc, bd, cc, cd, dd] = self.second;
        self.second = [
            aa + wa * a,
            ab + wa * b,
            ac + wa * c,
            ad + wa * d,
            bb + wb * b,
            bc + wb * c,
            bd + wb * d,
            cc + wc * c,
            cd + wc * d,
            dd + wd * d,
        ];
    }

    pub(super) fn spread(&self) -> Spread {
        let [a, b, c, d] = self.first;
        let [ab, ac, ad, bc] = [self.second[1], self.second[2], self.second[3], self.second[5]];
        let [aa, bb, cc, dd] = [self.second[0], self.second[4], self.second[7], self.second[9]];
        let [bd, cd] = [self.second[6], self.second[8]];
        let first = totals([a, b, c, d]);
        let squares = totals([aa, bb, cc, dd]);
        let [ab, ac, ad, bc] = totals([ab, ac, ad, bc]);
        let [bd, cd, weight, _] = totals([bd, cd, self.weight, Vec4::ZERO]);
        let scale = 1.0 / weight;
        let mean = first.map(|sum| sum * scale);
        let mut covariance = [squares[0], ab, ac, ad, squares[1], bc, bd, squares[2], cd, squares[3]];
        for (sum, (i, j)) in covariance.iter_mut().zip(PAIRS) {
            *sum = *sum * scale - mean[i] * mean[j];
        }
        Spread { weight, mean, covariance }
    }
}

/// The sums of the lanes of four vectors, in one order everywhere.
pub(super) fn totals([a, b, c, d]: [Vec4; 4]) -> [f32; 4] {
    let lanes = Mat4::from_cols(a, b, c, d).transpose();
    ((lanes.x_axis + lanes.y_axis) + (lanes.z_axis + lanes.w_axis)).to_array()
}

/// The symmetric matrix with these entries for pairs of coordinates, with so much added to the diagonal.
pub(super) fn matrix(entries: &[f32; 10], diagonal: f64) -> DMat4 {
    let [aa, ab, ac, ad, bb, bc, bd, cc, cd, dd] = entries.map(f64::from);
    DMat4::from_cols(
        DVec4::new(aa + diagonal, ab, ac, ad),
        DVec4::new(ab, bb + diagonal, bc, bd),
        DVec4::new(ac, bc, cc + diagonal, cd),
        DVec4::new(ad, bd, cd, dd + diagonal),
    )
}
