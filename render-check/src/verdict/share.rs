//! Parts of a whole.

/// A part of a whole, 0 to 1; 0 where there is nothing.
#[must_use]
pub fn share(part: usize, whole: usize) -> f64 {
    if whole == 0 { 0.0 } else { part as f64 / whole as f64 }
}
