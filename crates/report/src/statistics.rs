//! Medians, quantiles, and exponents of growth.

/// The value below which so large a part of the values lies, the nearest one; NaN of none.
#[must_use]
pub fn quantile(values: &[f64], part: f64) -> f64 {
    let mut values = values.to_vec();
    values.sort_by(f64::total_cmp);
    let last = values.len().saturating_sub(1) as f64;
    values.get((last * part).round() as usize).copied().unwrap_or(f64::NAN)
}

/// The value in the middle; NaN of none.
#[must_use]
pub fn median(values: &[f64]) -> f64 {
    quantile(values, 0.5)
}

/// The geometric mean of positive values; NaN of none.
#[must_use]
pub fn geometric_mean(values: &[f64]) -> f64 {
    (values.iter().map(|value| value.ln()).sum::<f64>() / values.len() as f64).exp()
}

/// The exponent k of the power law a·xᵏ that is nearest to some points with positive coordinates: the slope of the line of least
/// squares through their logarithms. NaN of fewer than two different x.
#[must_use]
pub fn exponent(points: &[(f64, f64)]) -> f64 {
    let logs: Vec<(f64, f64)> = points.iter().map(|(x, y)| (x.ln(), y.ln())).collect();
    let count = logs.len() as f64;
    let [x_mean, y_mean] =
        [logs.iter().map(|p| p.0).sum::<f64>() / count, logs.iter().map(|p| p.1).sum::<f64>() / count];
    let square = logs.iter().map(|(x, _)| (x - x_mean) * (x - x_mean)).sum::<f64>();
    logs.iter().map(|(x, y)| (x - x_mean) * (y - y_mean)).sum::<f64>() / square
}

/// y at some x on the power law through two points with positive coordinates: on the line through their logarithms.
#[must_use]
pub fn between((x_a, y_a): (f64, f64), (x_b, y_b): (f64, f64), x: f64) -> f64 {
    y_a * (y_b / y_a).powf((x / x_a).ln() / (x_b / x_a).ln())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_values() {
        let values = [5.0, 1.0, 4.0, 2.0, 3.0];
        assert_eq!([0.0, 0.25, 0.5, 1.0].map(|part| quantile(&values, part)), [1.0, 2.0, 3.0, 5.0]);
        assert!(median(&[]).is_nan());
    }

    #[test]
    fn powers_have_their_exponents() {
        let points = [1.0, 2.0, 5.0, 100.0].map(|x: f64| (x, 3.0 * x.powf(1.5)));
        assert!((exponent(&points) - 1.5).abs() < 1e-12);
        assert!(exponent(&points[..1]).is_nan());
        assert!((between(points[0], points[2], 2.0) - points[1].1).abs() < 1e-12);
        assert!((between(points[0], points[1], 100.0) / points[3].1 - 1.0).abs() < 1e-12, "beyond both");
        assert!((geometric_mean(&[1.0, 4.0, 16.0]) - 4.0).abs() < 1e-12);
    }
}
