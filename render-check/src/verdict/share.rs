//! Fractions of counts.

/// `part` over `whole`, 0 to 1; 0 where both are zero.
#[must_use]
pub fn share(part: usize, whole: usize) -> f64 {
    if whole == 0 { 0.0 } else { part as f64 / whole as f64 }
}
