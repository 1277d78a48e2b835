//! Figures of this chapter in words.

use crate::chapter::Figure;

/// Seconds as microseconds.
pub(super) fn microseconds(seconds: f64) -> String {
    Figure(1e6 * seconds).to_string()
}

/// A share as a percentage, with more digits the smaller it is.
pub(super) fn percent(share: f64) -> String {
    match 100.0 * share {
        0.0 => "0".to_owned(),
        percent if percent >= 1.0 => format!("{percent:.1} %"),
        percent if percent >= 0.01 => format!("{percent:.2} %"),
        percent => format!("{percent:.0e} %"),
    }
}

/// A ratio with the range of most of its values.
pub(super) fn spread(ratio: f64, low: f64, high: f64) -> String {
    format!("{} ({}–{})", Figure(ratio), Figure(low), Figure(high))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_share_is_rounded_to_nothing() {
        let shares = [0.0, 0.000_002, 0.0002, 0.005, 0.5, 1.0].map(percent);
        assert_eq!(shares, ["0", "2e-4 %", "0.02 %", "0.50 %", "50.0 %", "100.0 %"]);
        assert_eq!(microseconds(1.5e-6), "1.50");
        assert_eq!(spread(1.0, 0.5, 20.0), "1.00 (0.500–20.0)");
    }
}
