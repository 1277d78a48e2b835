//! Values about a boundary.

/// ±10⁻ᵏ, k = 1 … 16.
pub(crate) fn powers() -> impl Iterator<Item = f64> {
    (1..=16).flat_map(|k| [10_f64.powi(-k), -10_f64.powi(-k)])
}

/// A number and its neighbours, four steps of f64 to either side; for zero, subnormal numbers.
pub(crate) fn steps(middle: f64) -> impl Iterator<Item = f64> {
    let walk = |step: fn(f64) -> f64| std::iter::successors(Some(middle), move |&x| Some(step(x))).take(5);
    walk(f64::next_down).chain(walk(f64::next_up).skip(1))
}

/// All about a boundary: `middle` moved by ±10⁻ᵏ, itself, and its neighbours.
pub(crate) fn about(middle: f64) -> impl Iterator<Item = f64> {
    powers().map(move |by| middle + by).chain(steps(middle))
}
