//! Arithmetic on four numbers at a time, with the same bits everywhere.

use glam::Vec4;

/// value^(2^k).
pub(super) fn raised(mut value: Vec4, k: u32) -> Vec4 {
    for _ in 0..k {
        value *= value;
    }
    value
}

/// The larger of two, lane by lane; the second where one is NaN.
pub(super) fn greater(a: Vec4, b: Vec4) -> Vec4 {
    Vec4::select(a.cmpgt(b), a, b)
}

/// The smaller of two, lane by lane; the second where one is NaN.
pub(super) fn lesser(a: Vec4, b: Vec4) -> Vec4 {
    Vec4::select(a.cmplt(b), a, b)
}

/// The sum of all lanes, in one order everywhere.
pub(super) fn total(sum: Vec4) -> f64 {
    let [a, b, c, d] = sum.to_array().map(f64::from);
    (a + b) + (c + d)
}
