//! Counts, times and exponents as they are written.

use std::fmt;

use super::cost::{Cost, Counted};
use crate::chapter::Figure;

/// A number of things; texels by the side of the map.
pub(super) fn count(cost: &Cost) -> String {
    match cost.counted {
        Counted::Texels => format!("{}²", cost.count.isqrt()),
        _ => cost.count.to_string(),
    }
}

/// A time in the unit that suits it.
pub(super) struct Seconds(pub(super) f64);

impl fmt::Display for Seconds {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (unit, name) = match self.0.abs() {
            size if size < 1e-6 => (1e-9, "ns"),
            size if size < 1e-3 => (1e-6, "µs"),
            size if size < 1.0 => (1e-3, "ms"),
            _ => (1.0, "s"),
        };
        write!(f, "{} {name}", Figure(self.0 / unit))
    }
}

/// An exponent, with two digits after the point.
pub(super) struct Exponent(pub(super) f64);

impl fmt::Display for Exponent {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // What rounds to nothing has no sign.
        write!(f, "{:.2}", (self.0 * 100.0).round() / 100.0 + 0.0)
    }
}
