//! Tables and numbers in a common format.

use comfy_table::presets::UTF8_FULL_CONDENSED;
use comfy_table::{CellAlignment, ContentArrangement, Table};

/// A table without rows. The columns in `numbers`, counted from 0, are right-aligned, the others left-aligned.
#[must_use]
pub fn new<const N: usize>(header: [&str; N], numbers: impl IntoIterator<Item = usize>) -> Table {
    let mut table = Table::new();
    table.load_style(UTF8_FULL_CONDENSED).set_content_arrangement(ContentArrangement::Disabled).set_header(header);
    for index in numbers {
        if let Some(column) = table.column_mut(index) {
            column.set_cell_alignment(CellAlignment::Right);
        }
    }
    table
}

/// A number with three digits.
#[must_use]
pub fn number(value: f64) -> String {
    let digits =
        if value.abs() >= 1.0 && value.is_finite() { (2.0 - value.abs().log10().floor()).max(0.0) } else { 3.0 };
    format!("{value:.*}", digits as usize)
}

/// A fraction, 0 to 1, in percent.
#[must_use]
pub fn percent(share: f64) -> String {
    format!("{} %", number(100.0 * share))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_three_digits() {
        assert_eq!([0.0, 0.1234, 1.234, 56.78, 1234.5].map(number), ["0.000", "0.123", "1.23", "56.8", "1234"]);
        assert_eq!(number(f64::INFINITY), "inf");
        assert_eq!([0.0, 0.000_12, 0.5].map(percent), ["0.000 %", "0.012 %", "50.0 %"]);
    }
}
